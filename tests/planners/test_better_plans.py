"""Plans that a planner hands over while it goes on."""

from __future__ import annotations

import pytest

from rightofway import Plan, check, improve, solve
from tests.builders.fleets import random_fleet

FLEET = random_fleet(seed=3, size=16, robots=20, walls=0)
"""A fleet whose first plans can be improved."""


ENDS = {
    "auto": {"iterations": 100, "nodes": 30},
    "lns": {"iterations": 100},
    "local-search": {"rounds": 5},
    "priority-search": {"rounds": 5},
}
"""Where planners end, on any machine."""


@pytest.mark.parametrize("planner", ENDS)
def test_each_plan_is_better_than_the_one_before_and_none_than_the_last(planner: str) -> None:
    handed: list[Plan] = []
    last = solve(FLEET, planner, None, options=ENDS[planner], on_plan=handed.append)
    flowtimes = [plan.flowtime for plan in handed]
    assert flowtimes
    assert flowtimes == sorted(set(flowtimes), reverse=True)
    assert flowtimes[-1] >= last.flowtime
    assert all(check(plan).ok for plan in handed)
    assert {plan.lower_bound for plan in handed} == {last.lower_bound}


def test_an_improvement_begins_with_the_plan_given() -> None:
    given = solve(FLEET, "prioritized")
    handed: list[Plan] = []
    improve(given, time_limit=0.5, on_plan=handed.append)
    assert handed[0].tracks == given.tracks


def test_watching_changes_nothing() -> None:
    options = {"iterations": 200}
    watched = solve(FLEET, "lns", None, options=options, on_plan=lambda _: None)
    assert watched.tracks == solve(FLEET, "lns", None, options=options).tracks


def test_a_planner_of_one_plan_hands_over_none() -> None:
    handed: list[Plan] = []
    solve(FLEET, "prioritized", on_plan=handed.append)
    assert handed == []
