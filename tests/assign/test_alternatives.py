"""What a job would cost on each robot, by hand."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest

from rightofway.assign import list_job_costs
from rightofway.io import parse_scenario
from rightofway.solve import solve

CORRIDOR: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {"grid": ["..........", ".........."]},
    "robots": [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N9"}],
    "rules": {"turn": 0},
}


def _list_costs(jobs: Sequence[dict[str, Any]], **changes: Any) -> list[list[tuple[int, Any]]]:
    plan = solve(parse_scenario({**CORRIDOR, "jobs": [*jobs], **changes}), seed=1)
    return [[(cost.robot, cost.cost) for cost in costs] for costs in list_job_costs(plan)]


def test_a_job_costs_its_service_time_and_the_delay_of_the_other_jobs_of_the_robot() -> None:
    # R1 ends J1 at 3, R2 ends J2 at 9 - 6 = 3. J1 on R2, after J2 at N6: another 3 ticks, at 6; J2
    # on R1 after J1: at 6 as well.
    costs = _list_costs([{"name": "J1", "at": "N3"}, {"name": "J2", "at": "N6"}])
    assert costs == [[(0, 3), (1, 6)], [(0, 6), (1, 3)]]


def test_a_weight_counts_and_the_unit_is_a_tick_of_a_job_of_weight_1() -> None:
    jobs = [{"name": "J1", "at": "N3", "weight": "3/2"}, {"name": "J2", "at": "N6"}]
    assert _list_costs(jobs)[0] == [(0, Fraction(9, 2)), (1, 9)]


def test_a_robot_that_would_be_too_late_has_no_cost() -> None:
    assert _list_costs([{"name": "J1", "at": "N3", "latest": 4}]) == [[(0, 3), (1, None)]]


def test_only_robots_that_may_do_a_job_are_compared() -> None:
    assert _list_costs([{"name": "J1", "at": "N3", "robot": "R2"}]) == [[(1, 6)]]


@pytest.mark.parametrize(
    ("objective", "costs"),
    # There and home again: 2 * 3 and 2 * 6 ticks; `both` counts the makespan for both robots.
    [("flowtime", [6, 12]), ("makespan", [6, 12]), ("both", [18, 36])],
)
def test_the_cost_is_of_the_objective_of_the_rules(objective: str, costs: list[int]) -> None:
    found = _list_costs([{"name": "J1", "at": "N3"}], rules={"turn": 0, "objective": objective})
    assert found == [[*enumerate(costs)]]


def test_jobs_that_come_after_a_job_do_not_count() -> None:
    jobs: list[dict[str, Any]] = [
        {"name": "J1", "at": "N3"},
        {"name": "J2", "at": "N4", "after": ["J1"]},
    ]
    assert _list_costs(jobs)[0] == [(0, 3), (1, 6)]
