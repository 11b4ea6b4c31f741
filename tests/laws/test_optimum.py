"""Tiny fleets against a search over all joint states: what is proven is true."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import strategies as st

from rightofway import OutcomeKind, check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Scenario, compute_cost
from rightofway.model.outcome import choose_objective
from tests.builders.any_plan import QUICK, STRICT, knows
from tests.builders.laws import law, leave
from tests.builders.tiny import KINDS, least_cost

kinds, seeds = st.sampled_from(sorted(KINDS)), st.integers(0, 10**6)


PROVEN = "optimal"
"""The part of a planner's status that claims the optimum."""


@law(kinds, seeds, st.sampled_from(STRICT))
def test_no_plan_is_below_the_optimum_and_what_a_planner_proves_is_true(
    kind: str, seed: int, planner: str
) -> None:
    scenario = KINDS[kind](seed)
    if not knows(planner, scenario):
        leave("the planner does not know such fleets")
    least = least_cost(kind, scenario)
    try:
        plan = solve(scenario, planner, options=QUICK.get(planner), time_limit=None)
    except NoPlanExists:
        assert least is None
        return
    except GaveUp:
        leave("the planner gave up")
    assert check(plan).ok
    assert least is not None
    cost = compute_cost(scenario, plan.tracks)
    assert plan.lower_bound <= least <= cost
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    assert plan.lower_bound <= outcome.bound <= least
    is_of_cost = outcome.objective is choose_objective(scenario)  # else of the time alone
    if PROVEN in str(plan.run.status) or (is_of_cost and outcome.kind is OutcomeKind.OPTIMAL):
        assert cost == least


@law(st.integers(0, 10**6))
def test_without_its_closures_a_fleet_is_at_least_as_quick(seed: int) -> None:
    scenario = KINDS["closures"](seed)
    free = least_cost("closures", replace(scenario, closures=()))
    among = least_cost("closures", scenario)
    assert among is None or (free is not None and free <= among)


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(KINDS))
def test_auto_finds_the_optimum_of_tiny_fleets_or_proves_that_there_is_no_plan(kind: str) -> None:
    """All of twenty: seeds 0 to 19 of each kind."""
    assert all(_is_optimum_proven(kind, KINDS[kind](seed)) for seed in range(20))


@law(kinds, seeds)
def test_auto_proves_the_optimum_of_tiny_fleets(kind: str, seed: int) -> None:
    if not _is_optimum_proven(kind, KINDS[kind](seed)):
        leave("the tree has more nodes than auto expands")


def _is_optimum_proven(kind: str, scenario: Scenario) -> bool:
    """Compare what auto proves with the least cost; whether it is the optimum, or no plan."""
    least = least_cost(kind, scenario)
    try:
        plan = solve(scenario, options={"iterations": 50}, time_limit=None)
    except NoPlanExists:
        assert least is None
        return True
    except GaveUp:
        return False
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    assert least is not None
    assert outcome.bound <= least <= compute_cost(scenario, plan.tracks)
    return outcome.kind is OutcomeKind.OPTIMAL
