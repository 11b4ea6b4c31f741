"""Vertices that robots only drive through: every planner keeps them, and proofs are true."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rightofway import FleetBuilder, check, solve
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import OutcomeKind, Scenario, compute_cost
from rightofway.planners import Feature, find_all
from tests.builders.tiny import KINDS, least_cost

PLANNERS = sorted(name for name, spec in find_all().items() if Feature.SIZES in spec.features)

SEEDS = range(20)


def build_crossing() -> Scenario:
    """Return two robots whose ways cross at a vertex that they drive through: A to B, C to D."""
    fleet = FleetBuilder(ends="none")
    for name, x, y in [("A", 0, 0), ("B", 4, 0), ("C", 2, 3), ("D", 2, -2)]:
        fleet.add_vertex(name, x, y)
    fleet.add_vertex("P", 2, 0, is_passed=True)
    for name in "ABCD":
        fleet.add_edge(name, "P")
    fleet.add_robot("R1", home="A", target="B").add_robot("R2", home="C", target="D")
    return fleet.build_scenario()


@pytest.mark.parametrize("planner", PLANNERS)
def test_robots_wait_before_they_drive_through(planner: str) -> None:
    plan = solve(build_crossing(), planner)
    assert check(plan).ok
    # 4 and 5 ticks long; the second drive begins when the first one has ended.
    first, second = sorted(plan.completions)
    assert (first, second) in {(4, 9), (5, 9)}
    for robot in ("R1", "R2"):
        _, passed, arrived = plan[robot].enter
        assert arrived - passed == 2
    assert all(plan.scenario.roadmap.name(wait.vertex) != "P" for wait in plan.waits)


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize("seed", SEEDS)
def test_plans_keep_the_rules_and_proofs_are_true(planner: str, seed: int) -> None:
    scenario = KINDS["passed"](seed)
    if Feature.CLOSURES not in find_all()[planner].features:
        scenario = replace(scenario, closures=())
    least = least_cost("passed", scenario)
    options = {"nodes": 300} if planner == "cbs" else {}
    try:
        plan = solve(scenario, planner, time_limit=None, options=options)
    except NoPlanExists:
        assert least is None
        return
    except GaveUp:
        return
    assert check(plan).ok
    assert least is not None
    outcome = plan.run.outcome
    assert outcome is not None
    assert (outcome.bound or 0) <= least <= compute_cost(scenario, plan.tracks)
    if outcome.kind is OutcomeKind.OPTIMAL:
        assert compute_cost(scenario, plan.tracks) == least


def test_the_published_method_refuses_them_by_name() -> None:
    with pytest.raises(InputError, match="planner paper does not know vertices with pass"):
        solve(build_crossing(), "paper")
    with pytest.raises(InputError, match="swaps=leave does not know vertices with pass"):
        solve(build_crossing(), "two-level", swaps="leave")
