"""What would happen if nobody waited: the paper's Tables 1 to 3, and where bookings overlap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway.deadline import Deadline, limit_work
from rightofway.errors import GaveUp, InputError
from rightofway.metrics import (
    Collision,
    Swap,
    find_collisions,
    find_near_misses,
    find_swaps,
    free_running,
)
from rightofway.metrics import collisions as room
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Tick, Track
from rightofway.repair.routing import free_running_tracks
from rightofway.site import VertexId
from tests.builders.fleets import grid_fleet

DOOR = ["...", "@.@", "..."]
OPEN = ["...", "...", "..."]

R1_ROUTE = ["N0", "N1", "N4", "N7", "N6", "N7", "N4", "N1", "N0"]
R2_ROUTE = ["N2", "N1", "N4", "N7", "N8", "N7", "N4", "N1", "N2"]


def door(speeds: Sequence[int], work: Sequence[int]) -> list[tuple[str, int, int]]:
    """Return (node, first tick, ticks) of the collisions if both robots drive freely."""
    scenario = grid_fleet(
        DOOR, [("N0", "N6"), ("N2", "N8")], speeds=[Fraction(v) for v in speeds], work=work
    )
    vertex = scenario.roadmap.get_vertex
    # Times so late that every robot has time for its work; free running takes them back.
    tracks = tuple(
        Track.of([vertex(name) for name in route], range(0, 900, 100))
        for route in (R1_ROUTE, R2_ROUTE)
    )
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    met = find_collisions(scenario, free_running(plan))
    return [(scenario.roadmap.name(c.vertex), c.start, (c.end or 0) - c.start) for c in met]


def test_robots_of_equal_speed_meet_at_the_door_there_and_back() -> None:
    """Rows 0 1 4 7 6 6 7 4 1 0 and 2 1 4 7 8 8 7 4 1 2 share nodes at ticks 1 2 3 6 7 8."""
    assert door([1, 1], [0, 0]) == [
        ("N1", 1, 1),
        ("N4", 2, 1),
        ("N7", 3, 1),
        ("N7", 6, 1),
        ("N4", 7, 1),
        ("N1", 8, 1),
    ]


def test_a_robot_three_times_as_fast_meets_the_other_only_on_its_way_back() -> None:
    """R1 has rows 0 1 4 7 6 6 7 4 1 0; R2 enters N1 at tick 3, N4 at 6, N7 at 9."""
    assert door([3, 1], [0, 0]) == [("N4", 7, 1)]


def test_with_longer_work_they_never_meet() -> None:
    """R1 works 6 ticks (2 units of time): it leaves N6 at tick 12, as R2 comes to N8."""
    assert door([3, 1], [2, 0]) == []


def make_plan(scenario: Scenario, *trips: tuple[Sequence[int], Sequence[int]]) -> Plan:
    tracks = tuple(Track.of(vertices, enter) for vertices, enter in trips)
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))


def test_free_running_keeps_routes_and_work_and_drops_all_waits() -> None:
    scenario = grid_fleet(OPEN, [("N0", "N1")], work=[3])
    plan = make_plan(scenario, ([0, 3, 4, 1, 0], [2, 5, 9, 10, 40]))
    # Three edges to N1, 3 of work, 1 of turning, 1 edge home.
    assert free_running(plan) == (Track.of([0, 3, 4, 1, 0], [0, 1, 2, 3, 8]),)


def test_free_running_leaves_the_plan_alone() -> None:
    scenario = grid_fleet(OPEN, [("N0", "N1")])
    plan = make_plan(scenario, ([0, 1, 0], [0, 4, 9]))
    free_running(plan)
    assert plan.tracks == (Track.of([0, 1, 0], [0, 4, 9]),)


def met(*trips: tuple[Sequence[int], Sequence[int]], **rules: Any) -> list[Collision]:
    ends = [(f"N{vertices[0]}", f"N{vertices[-1]}") for vertices, _ in trips]
    scenario = grid_fleet(OPEN, ends, rules=Rules(ends="none", **rules))
    return list(find_collisions(scenario, make_plan(scenario, *trips).tracks))


def spans(found: list[Collision]) -> list[tuple[tuple[int, int], int, int, int | None]]:
    return [(one.robots, one.vertex, one.start, one.end) for one in found]


def test_robots_that_end_in_one_vertex_collide_for_ever() -> None:
    assert spans(met(([3, 4], [0, 1]), ([1, 4], [0, 5]))) == [((0, 1), 4, 5, None)]


def test_each_pair_of_a_crowd_collides() -> None:
    # In N4: R1 in [1, 4), R2 in [2, 5), R3 in [3, 6).
    crowd = (([3, 4, 5], [0, 1, 4]), ([1, 4, 7], [0, 2, 5]), ([7, 4, 3], [0, 3, 6]))
    assert spans(met(*crowd)) == [((0, 1), 4, 2, 4), ((0, 2), 4, 3, 4), ((1, 2), 4, 3, 5)]


def test_approach_and_headway_are_booked_too() -> None:
    # R1 leaves N4 at tick 2; R2 enters then, and drives there from tick 1.
    following = (([3, 4, 5], [0, 1, 2]), ([1, 4, 7], [0, 2, 3]))
    assert spans(met(*following)) == []
    assert spans(met(*following, occupancy="both")) == [((0, 1), 4, 1, 2)]
    assert spans(met(*following, headway=Fraction(2))) == [((0, 1), 4, 2, 4)]


def test_a_robot_does_not_collide_with_itself() -> None:
    assert met(([3, 4, 3, 0], [0, 1, 2, 3]), headway=Fraction(4)) == []


def test_a_swap_names_the_vertices_that_the_robots_leave() -> None:
    tracks = (Track.of([3, 4, 5], [0, 2, 4]), Track.of([5, 4, 3], [0, 1, 2]))
    assert find_swaps(tracks) == (
        Swap(robots=(0, 1), vertices=(VertexId(3), VertexId(4)), tick=Tick(2)),
    )


def test_robots_that_follow_or_come_later_do_not_swap() -> None:
    ahead, behind = Track.of([3, 4, 5], [0, 2, 4]), Track.of([3, 4], [1, 2])
    later = Track.of([5, 4, 3], [0, 1, 3])
    assert find_swaps((ahead, behind, later)) == ()


def sized(grid: Sequence[str], *tracks: Track, clearance: Fraction = Fraction(0)) -> Scenario:
    """Return robots of radius 0.4 on cells of 1, at home where their tracks begin."""
    trips = [(f"N{track.vertices[0]}", f"N{track.vertices[-1]}") for track in tracks]
    rules = Rules(occupancy="both", ends="none")
    fleet = grid_fleet(grid, trips, rules=rules)
    return replace(
        fleet,
        robots=tuple(replace(robot, radius=Fraction(2, 5)) for robot in fleet.robots),
        rules=replace(rules, clearance=clearance),
    )


def test_robots_on_neighbouring_cells_are_too_near_for_a_wide_clearance() -> None:
    """0.8 between two centres is enough on cells of 1; with a clearance of 0.3 they need 1.1.

    Both drive right, one row apart, and book the next cell while they drive, to the end.
    """
    tracks = (Track.of([0, 1], [0, 1]), Track.of([3, 4], [0, 2]))
    assert find_near_misses(sized(OPEN, *tracks), tracks) == ()
    found = find_near_misses(sized(OPEN, *tracks, clearance=Fraction(3, 10)), tracks)
    assert [(each.robots, each.places, each.start, each.end) for each in found] == [
        ((0, 1), ((0,), (3,)), 0, None)
    ]


def test_a_robot_that_drives_by_is_too_near_while_it_books_the_cell() -> None:
    """R2 stands in N4; R1 passes N1 in [1, 2), and books it from tick 0 until it is in N2."""
    tracks = (Track.of([0, 1, 2], [0, 1, 2]), Track.of([4], [0]))
    found = find_near_misses(sized(OPEN, *tracks, clearance=Fraction(3, 10)), tracks)
    assert [(each.places, each.start, each.end) for each in found] == [(((1,), (4,)), 0, 2)]


def test_robots_without_a_size_are_never_too_near() -> None:
    tracks = (Track.of([0], [0]), Track.of([1], [0]))
    assert find_near_misses(grid_fleet(OPEN, [("N0", "N0"), ("N1", "N1")]), tracks) == ()


def test_more_meetings_than_a_list_may_have_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """R1 and R2 collide in N1, N4 and N7 on their ways out and back."""
    monkeypatch.setattr(room, "MOST_MEETINGS", 2)
    scenario = grid_fleet(DOOR, [("N0", "N6"), ("N2", "N8")])
    tracks = free_running_tracks(scenario)
    with pytest.raises(InputError, match=r"robots: robots meet more than 2 times \(take fewer"):
        find_collisions(scenario, tracks)


def test_finding_collisions_keeps_the_limit_of_the_work() -> None:
    scenario = grid_fleet(DOOR, [("N0", "N6"), ("N2", "N8")])
    tracks = free_running_tracks(scenario)
    with limit_work(Deadline.after(0)), pytest.raises(GaveUp, match="while finding collisions"):
        find_collisions(scenario, tracks)
