"""Paths of one's own algorithm, as a plan."""

from typing import Any

import pytest

import rightofway
from rightofway.errors import InputError
from rightofway.model import Scenario


def two_on_a_line(**robot: Any) -> Scenario:
    """R1 drives from the left to the right of three cells, R2 back, past it on the row below."""
    fleet = rightofway.FleetBuilder(grid=["...", "..."], ends="none", turn=0)
    fleet = fleet.add_robot("R1", home=(0, 0), target=(0, 2), **robot)
    return fleet.add_robot("R2", home=(0, 2), target=(0, 0)).build_scenario()


GOOD: dict[str, list[Any]] = {
    "R1": ["N0", (0, 1), (0, 1), {"x": 2.5, "y": 0.5}],
    "R2": [(0, 2), (1, 2), (1, 1), (1, 0), (0, 0)],
}


def test_cells_names_and_points_at_each_time_become_visits() -> None:
    """R1 waits at N1 from 1 to 3 and is at N2 at 3; R2 takes four moves: 3 + 4 ticks."""
    plan = rightofway.plan_of_paths(two_on_a_line(), GOOD)
    assert plan["R1"].vertices == ("N0", "N1", "N2")
    assert plan.tracks[0].enter.tolist() == [0, 1, 3]
    assert rightofway.check(plan).ok
    assert plan.flowtime == 7
    assert rightofway.improve(plan, time_limit=1).flowtime == 6


def test_ticks_may_be_given_with_each_place() -> None:
    scenario = two_on_a_line()
    timed = {**GOOD, "R1": [((0, 0), 0), ("N1", 1), ("N2", 3)]}
    assert rightofway.plan_of_paths(scenario, timed) == rightofway.plan_of_paths(scenario, GOOD)


def test_time_units_are_several_ticks_where_the_tick_is_short() -> None:
    """R1 drives a cell in half a unit, so a tick is 1/2: times 0, 1 and 2 are ticks 0, 2, 4."""
    scenario = two_on_a_line(speed=2)
    plan = rightofway.plan_of_paths(scenario, {**GOOD, "R1": [(0, 0), (0, 1), (0, 2)]})
    assert plan.tracks[0].enter.tolist() == [0, 2, 4]


def test_paths_that_collide_are_a_plan_that_the_judge_refuses() -> None:
    paths = {**GOOD, "R2": [(0, 2), (0, 1), (0, 0)]}
    report = rightofway.check(rightofway.plan_of_paths(two_on_a_line(), paths))
    assert set(report.counts) == {"vertex conflict"}


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"R3": ["N0"]}, r"paths: no robot is named 'R3' \(robots are R1, R2\)"),
        ({"R1": []}, "paths: R1 has no path"),
        ({"R1": ["N0", (7, 1)]}, r"paths\.R1\[1\]: "),
        ({"R1": ["N0", 3.5]}, r"paths\.R1\[1\]: "),
        ({"R1": ["N0", ("N1", 2)]}, "give a tick to all or none"),
    ],
)
def test_what_is_no_path_is_refused_with_its_place(change: dict[str, Any], fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        rightofway.plan_of_paths(two_on_a_line(), {**GOOD, **change})
