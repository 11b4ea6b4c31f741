"""Who waits where, how long and for whom."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest

from rightofway.metrics import waits
from rightofway.model import Plan, PlannerRun, Rules, Track
from tests.builders.fleets import grid_fleet

OPEN = ["...", "...", "..."]

Trip = tuple[Sequence[int], Sequence[int]]


Told = tuple[int, int, int, int, int | None]
"""Robot, vertex, tick and ticks of a wait, and whom it is for."""


def told(*trips: Trip, to: int | None = None, work: int = 0, **rules: Any) -> list[Told]:
    """Return the waits on trips that go one way to their last vertex, or else to another one."""
    ends = [(f"N{vertices[0]}", f"N{vertices[-1] if to is None else to}") for vertices, _ in trips]
    rules = {"ends": "none"} | rules
    scenario = grid_fleet(OPEN, ends, rules=Rules(**rules), work=[work])
    tracks = tuple(Track.of(vertices, enter) for vertices, enter in trips)
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    return [
        (wait.robot, wait.vertex, wait.tick, wait.ticks, wait.for_robot) for wait in waits(plan)
    ]


STRAIGHT = ([3, 4, 5], [0, 1, 2])
"""R1 is in N4 in [1, 2)."""


def test_a_robot_waits_for_the_one_that_leaves_where_it_goes() -> None:
    # R2 might be in N4 at tick 1; it comes at 2, as R1 leaves.
    assert told(STRAIGHT, ([1, 4, 7], [0, 2, 3])) == [(1, 1, 0, 1, 0)]


def test_a_robot_that_comes_later_than_it_might_waits_for_nobody() -> None:
    assert told(STRAIGHT, ([1, 4, 7], [0, 3, 4])) == [(1, 1, 0, 2, None)]


def test_with_headway_a_robot_waits_until_that_is_over() -> None:
    assert told(STRAIGHT, ([1, 4, 7], [0, 3, 4]), headway=Fraction(1)) == [(1, 1, 0, 2, 0)]


def test_where_robots_book_both_vertices_it_waits_for_its_start() -> None:
    # N4 is free from tick 2; R2 starts then and is there at 3.
    assert told(STRAIGHT, ([1, 4, 7], [0, 3, 4]), occupancy="both") == [(1, 1, 0, 2, 0)]


def test_without_waits_there_is_nothing_to_tell() -> None:
    assert told(STRAIGHT) == []


@pytest.mark.parametrize(("leave", "wait"), [(5, []), (7, [(0, 4, 4, 2, None)])])
def test_a_wait_begins_when_the_work_is_done(leave: int, wait: list[Told]) -> None:
    # In N4 from tick 1: 2 of work, 1 of turning; then it might drive, and be in N3 at tick 5.
    assert told(([3, 4, 3], [0, 1, leave]), ends="home", to=4, work=2) == wait


def test_a_stay_too_short_for_work_and_turning_is_waiting() -> None:
    # 2 ticks in N4 at first, but work and turning take 3; so they are done the second time.
    trip = ([3, 4, 5, 4, 3], [0, 1, 4, 5, 9])
    assert told(trip, ends="home", to=4, work=2) == [(0, 4, 1, 2, None)]


def test_nobody_waits_for_himself() -> None:
    """R1 comes back as the headway it left behind is over."""
    assert told(([3, 4, 3], [0, 1, 3]), headway=Fraction(2)) == [(0, 4, 1, 1, None)]


def test_waits_come_by_tick_then_by_robot() -> None:
    found = told(([3, 4, 5], [0, 3, 5]), ([0, 1, 2], [0, 2, 4]))
    assert [(robot, tick) for robot, _, tick, *_ in found] == [(0, 0), (1, 0), (1, 2), (0, 3)]


def test_a_wait_tells_where_the_robot_goes_next() -> None:
    scenario = grid_fleet(OPEN, [("N3", "N5")], rules=Rules(ends="none"))
    track = Track.of([3, 4, 5], [0, 1, 3])
    plan = Plan(scenario=scenario, tracks=(track,), run=PlannerRun(name="by hand"))
    assert [wait.towards for wait in waits(plan)] == [5]
