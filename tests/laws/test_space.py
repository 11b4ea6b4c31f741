"""Robots with a size: the judge agrees with the oracle, and plans pass both."""

from __future__ import annotations

from math import sqrt

import pytest

from rightofway import check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Plan, PlannerRun, Scenario
from rightofway.planners import registered
from rightofway.planners.routing import shortest_routes
from rightofway.precedence import PrecedenceGraph
from rightofway.search import Distances
from tests.builders.seeds import seeds
from tests.builders.sizes import sized, sized_on_lanes
from tests.oracles.space import encounters, overlaps

KNOW_SIZES = sorted(spec.name for spec in registered().values() if spec.knows_sizes)
STEPS: dict[str, dict[str, int]] = {name: {"iterations": 30} for name in ("auto", "lns")}


def heedless(scenario: Scenario) -> Plan:
    """Return a plan in which each robot drives its shortest route as if it were alone."""
    routes = shortest_routes(scenario, Distances(scenario.roadmap))
    graph = PrecedenceGraph(routes, headway=scenario.problem.headway, books_ahead=True)
    run = PlannerRun(name="by hand")
    return Plan(scenario=scenario, tracks=tuple(graph.tracks()), run=run)


@pytest.mark.parametrize("seed", seeds(60, 6))
def test_the_judge_finds_the_pairs_that_the_oracle_finds(seed: int) -> None:
    """Same-vertex conflicts are kinds of their own; the oracle has all bookings in one."""
    scenario = (sized if seed % 2 else sized_on_lanes)(seed)
    try:
        plan = heedless(scenario)
    except NoPlanExists:
        pytest.skip("a robot has no way")
    faults = check(plan).faults
    booked = {
        f.robots for f in faults if f.kind in {"space conflict", "vertex conflict", "headway"}
    }
    assert booked == overlaps(scenario, list(plan.tracks))
    met = encounters(scenario, list(plan.tracks))
    too_close = [fault for fault in faults if fault.kind == "too close"]
    assert {fault.robots for fault in too_close} == set(met)
    for robots, square in met.items():
        within = f"come within {scenario.quantities.length(sqrt(square))} ("
        assert any(f.robots == robots and within in f.message for f in too_close)


@pytest.mark.parametrize("planner", KNOW_SIZES)
@pytest.mark.parametrize("seed", seeds(30, 2))
def test_plans_of_robots_with_sizes_keep_them_apart(planner: str, seed: int) -> None:
    scenario = (sized if seed % 2 else sized_on_lanes)(seed + 100)
    try:
        plan = solve(scenario, planner, options=STEPS.get(planner))
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    assert check(plan).ok
    assert not overlaps(scenario, list(plan.tracks))
    assert not encounters(scenario, list(plan.tracks))


def test_a_planner_that_does_not_know_sizes_refuses_them() -> None:
    others = set(registered()) - set(KNOW_SIZES) - {"paper"}
    for planner in others:
        with pytest.raises(ValueError, match=f"planner {planner} does not know robots with a size"):
            solve(sized_on_lanes(0), planner)


def test_the_published_method_is_for_points() -> None:
    with pytest.raises(ValueError, match="planner paper is for points: it leaves swaps"):
        solve(sized_on_lanes(0), "paper")
    with pytest.raises(ValueError, match=r"swaps=leave does not know .* \(choose swaps=resolve\)"):
        solve(sized_on_lanes(0), "two-level", swaps="leave")
