"""Plans of every planner, on any fleet: two judges that share no code pass them, or none exists."""

from __future__ import annotations

import random

from hypothesis import strategies as st

import rightofway
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Scenario
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import ALL, QUICK, STRICT, broken, by_both_judges, knows, planned
from tests.builders.laws import law, leave

seeds = st.integers(0, 2**32 - 1)


@law(any_fleet(), st.sampled_from(STRICT), seeds)
def test_a_plan_passes_both_judges_and_is_not_below_its_bound(
    fleet: Scenario, planner: str, seed: int
) -> None:
    plan = planned(fleet, planner, seed)
    assert by_both_judges(plan) == (set(), set())
    assert plan.flowtime >= plan.lower_bound


@law(any_fleet(), st.lists(st.sampled_from(STRICT), min_size=2, max_size=2, unique=True))
def test_where_one_planner_proves_that_no_plan_exists_no_other_one_finds_a_plan(
    fleet: Scenario, planners: list[str]
) -> None:
    ends = {_end(fleet, planner) for planner in planners}
    if None in ends:
        leave("a planner does not know such fleets")
    assert ends != {"none exists", "a plan"}


def _end(fleet: Scenario, planner: str) -> str | None:
    if not knows(planner, fleet):
        return None
    try:
        rightofway.solve(fleet, planner, None, options=QUICK.get(planner))
    except NoPlanExists:
        return "none exists"
    except GaveUp:
        return "gave up"
    return "a plan"


@law(any_fleet(), st.sampled_from(ALL), seeds)
def test_both_judges_find_the_same_faults(fleet: Scenario, planner: str, seed: int) -> None:
    plan, draw = planned(fleet, planner, seed), random.Random(seed)  # noqa: S311
    for _ in range(8):
        by_check, by_the_other = by_both_judges(broken(plan, draw))
        assert by_check == by_the_other


@law(any_fleet(robots=(1, 3)), st.sampled_from(STRICT), seeds)
def test_the_same_seed_gives_the_same_plan(fleet: Scenario, planner: str, seed: int) -> None:
    assert planned(fleet, planner, seed).tracks == planned(fleet, planner, seed).tracks
