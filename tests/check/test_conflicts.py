"""The judge of two robots: one vertex, headway, swaps, rotations, in both ways of booking."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway.check import Report, check
from rightofway.model import Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.report.judgement import write_fault
from rightofway.report.quantities import Quantities
from rightofway.site import Edge, VertexId, make_roadmap
from rightofway.units import Units
from tests.builders.fleets import grid_fleet

Trip = tuple[Sequence[int], Sequence[int]]
"""Vertices and enter of a track."""

# 0 1 2
# 3 4 5
# 6 7 8
OPEN = ["...", "...", "..."]
SQUARE = ["..", ".."]


def judged(
    *trips: Trip,
    grid: Sequence[str] = OPEN,
    speeds: Sequence[Fraction] = (Fraction(1),),
    **rules: Any,
) -> Report:
    """Judge robots that go one way, from the first to the last vertex of their tracks."""
    ends = [(f"N{vertices[0]}", f"N{vertices[-1]}") for vertices, _ in trips]
    rules = {"ends": "none"} | rules
    return check(make_plan(grid_fleet(grid, ends, rules=Rules(**rules), speeds=speeds), trips))


def make_plan(scenario: Scenario, trips: Sequence[Trip]) -> Plan:
    tracks = tuple(Track.of(vertices, enter) for vertices, enter in trips)
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))


def told(report: Report) -> list[tuple[str, tuple[int, ...], tuple[int, ...], int]]:
    return [(fault.kind, fault.robots, fault.vertices, fault.tick) for fault in report.faults]


def test_two_robots_in_one_vertex_are_a_conflict() -> None:
    # R1 is in N4 in [1, 3), R2 in [2, 3).
    report = judged(([3, 4, 5], [0, 1, 3]), ([1, 4, 7], [0, 2, 3]))
    assert told(report) == [("vertex conflict", (0, 1), (4,), 2)]
    assert report.faults[0].message == (
        "R1 books N4 from time 1 to 3 and R2 from time 2 to 3"
        " (let one come when the other has left)"
    )


def test_entering_as_the_other_leaves_is_allowed() -> None:
    assert judged(([3, 4, 5], [0, 1, 2]), ([1, 4, 7], [0, 2, 3])).ok


def test_headway_keeps_a_vertex_empty() -> None:
    # R1 leaves N4 at tick 2; with a headway of 2 it is free from tick 4.
    first = ([3, 4, 5], [0, 1, 2])
    assert judged(first, ([1, 4, 7], [0, 4, 5]), headway=Fraction(2)).ok
    report = judged(first, ([1, 4, 7], [0, 3, 4]), headway=Fraction(2))
    assert told(report) == [("headway", (0, 1), (4,), 3)]
    assert report.faults[0].message == (
        "R2 comes to N4 at time 3, 1 time unit after R1 left, the headway is 2 time units"
        " (come at time 4 or later)"
    )


def test_bookings_that_overlap_anyway_are_no_matter_of_headway() -> None:
    report = judged(([3, 4, 5], [0, 1, 3]), ([1, 4, 7], [0, 2, 3]), headway=Fraction(2))
    assert [fault.kind for fault in report.faults] == ["vertex conflict"]


def test_where_robots_book_both_vertices_the_approach_counts() -> None:
    # R1 leaves N4 at tick 2, so R2 may start to drive there at tick 2, and be there at 3.
    first = ([3, 4, 5], [0, 1, 2])
    assert judged(first, ([1, 4, 7], [0, 3, 4]), occupancy="both").ok
    report = judged(first, ([1, 4, 7], [0, 2, 3]), occupancy="both")
    assert told(report) == [("vertex conflict", (0, 1), (4,), 1)]


def test_the_approach_lasts_as_long_as_the_robots_own_drive() -> None:
    # R2 needs two ticks: it may start at tick 2, and be there at 4.
    first, speeds = ([3, 4, 5], [0, 1, 2]), [Fraction(1), Fraction(1, 2)]
    assert judged(first, ([1, 4, 7], [0, 4, 6]), occupancy="both", speeds=speeds).ok
    report = judged(first, ([1, 4, 7], [0, 3, 5]), occupancy="both", speeds=speeds)
    assert told(report) == [("vertex conflict", (0, 1), (4,), 1)]


def test_headway_and_approach_add_up() -> None:
    first = ([3, 4, 5], [0, 1, 2])
    both: dict[str, Any] = {"occupancy": "both", "headway": Fraction(1)}
    assert judged(first, ([1, 4, 7], [0, 4, 5]), **both).ok
    assert told(judged(first, ([1, 4, 7], [0, 3, 4]), **both)) == [("headway", (0, 1), (4,), 2)]


def test_home_is_booked_without_an_approach() -> None:
    # R2 starts to drive to R1's home when R1 has left it at tick 1.
    assert judged(([3, 4, 5], [0, 1, 2]), ([0, 3], [0, 2]), occupancy="both").ok
    report = judged(([3, 4, 5], [0, 1, 2]), ([0, 3], [0, 1]), occupancy="both")
    assert told(report) == [("vertex conflict", (0, 1), (3,), 0)]


def test_the_last_vertex_is_kept_for_ever() -> None:
    report = judged(([3, 4], [0, 1]), ([1, 4, 7], [0, 10**9, 10**9 + 1]))
    assert told(report) == [("vertex conflict", (0, 1), (4,), 10**9)]
    assert "R1 books N4 from time 1 permanently" in report.faults[0].message


def test_two_robots_cannot_end_in_one_vertex() -> None:
    assert told(judged(([3, 4], [0, 1]), ([1, 4], [0, 8]))) == [
        ("vertex conflict", (0, 1), (4,), 8)
    ]


def test_a_home_may_be_passed_while_its_robot_is_away() -> None:
    """R1 is away from N3 in [1, 5); R2 passes there in [1, 2) and [4, 5): both limits are met."""
    scenario = grid_fleet(OPEN, [("N3", "N5"), ("N0", "N6")])
    away = ([3, 4, 5, 4, 3], [0, 1, 2, 4, 5])
    assert check(make_plan(scenario, [away, ([0, 3, 6, 3, 0], [0, 1, 2, 4, 5])])).ok
    late = check(make_plan(scenario, [away, ([0, 3, 6, 3, 0], [0, 1, 2, 5, 6])]))
    assert told(late) == [("vertex conflict", (0, 1), (3,), 5)]


@pytest.mark.parametrize("occupancy", ["one", "both"])
def test_a_robots_own_bookings_never_conflict(occupancy: str) -> None:
    """With approach and headway it books N3 anew before its first booking has ended."""
    scenario = grid_fleet(
        OPEN,
        [("N3", "N4")],
        rules=Rules(headway=Fraction(3), occupancy=occupancy),  # type: ignore[arg-type]
    )
    assert check(make_plan(scenario, [([3, 4, 3], [0, 1, 3])])).ok


CROWD = (
    ([3, 4, 5], [0, 1, 4]),
    ([1, 4, 7], [0, 2, 4]),
    ([7, 4, 3], [0, 3, 4]),
)
"""All three are in N4 from tick 3 to 4."""


def test_each_pair_in_a_crowd_is_told() -> None:
    assert told(judged(*CROWD)) == [
        ("vertex conflict", (0, 1), (4,), 2),
        ("vertex conflict", (0, 2), (4,), 3),
        ("vertex conflict", (1, 2), (4,), 3),
    ]


def test_all_faults_are_counted_but_only_the_earliest_listed() -> None:
    ends = [("N3", "N5"), ("N1", "N7"), ("N7", "N3")]
    report = check(make_plan(grid_fleet(OPEN, ends, rules=Rules(ends="none")), CROWD), limit=1)
    assert told(report) == [("vertex conflict", (0, 1), (4,), 2)]
    assert (report.ok, report.total, report.counts) == (False, 3, {"vertex conflict": 3})
    assert report.summary == "3 faults: 3 vertex conflicts"
    assert str(report).splitlines()[-1] == "and 2 more (raise the limit to list them)"


def test_a_swap_is_forbidden() -> None:
    report = judged(([3, 4], [0, 1]), ([4, 3], [0, 1]))
    assert told(report) == [("swap conflict", (0, 1), (3, 4), 1)]
    assert report.faults[0].message == (
        "R1 and R2 exchange N3 and N4 (let one wait aside until the other is by)"
    )


def test_a_swap_is_told_in_the_order_of_the_robots() -> None:
    assert told(judged(([4, 3], [0, 1]), ([3, 4], [0, 1]))) == [
        ("swap conflict", (0, 1), (4, 3), 1)
    ]


def test_robots_of_different_speeds_swap_if_they_arrive_at_one_instant() -> None:
    report = judged(([3, 4], [0, 2]), ([4, 3], [0, 2]), speeds=[Fraction(1), Fraction(1, 2)])
    assert told(report) == [("swap conflict", (0, 1), (3, 4), 2)]


def test_a_tick_apart_it_is_a_vertex_conflict_and_no_swap() -> None:
    report = judged(([3, 4], [0, 1]), ([4, 3], [0, 2]))
    assert told(report) == [("vertex conflict", (0, 1), (4,), 1)]


def test_robots_that_book_both_vertices_conflict_in_each_when_they_swap() -> None:
    assert told(judged(([3, 4], [0, 1]), ([4, 3], [0, 1]), occupancy="both")) == [
        ("vertex conflict", (0, 1), (3,), 0),
        ("vertex conflict", (0, 1), (4,), 0),
        ("swap conflict", (0, 1), (3, 4), 1),
    ]


def test_each_swap_of_a_crowd_is_told() -> None:
    """R1 and R2, which are in one vertex, both swap with R3."""
    report = judged(([0, 3, 4], [0, 1, 2]), ([6, 3, 4], [0, 1, 2]), ([4, 3], [0, 2]))
    assert [item for item in told(report) if item[0] == "swap conflict"] == [
        ("swap conflict", (0, 2), (3, 4), 2),
        ("swap conflict", (1, 2), (3, 4), 2),
    ]


# Each corner of the square moves on to the next one, clockwise, at tick 1.
ROUND = (([0, 1], [0, 1]), ([1, 3], [0, 1]), ([3, 2], [0, 1]), ([2, 0], [0, 1]))


def test_a_rotation_is_allowed_unless_the_rules_forbid_it() -> None:
    assert judged(*ROUND, grid=SQUARE).ok
    report = judged(*ROUND, grid=SQUARE, rotations=False)
    assert told(report) == [("rotation", (0, 1, 2, 3), (0, 1, 3, 2), 1)]
    assert report.faults[0].message == (
        "R1, R2, R3 and R4 move round N0, N1, N3 and N2 at once"
        " (let one wait until its place is empty)"
    )


def test_where_robots_book_both_vertices_no_rotation_is_possible() -> None:
    report = judged(*ROUND, grid=SQUARE, occupancy="both")
    assert report.counts == {"vertex conflict": 4}


@pytest.mark.parametrize("rotations", [True, False])
def test_three_robots_are_enough_for_a_rotation(*, rotations: bool) -> None:
    corners = {"A": (0.0, 0.0), "B": (1.0, 0.0), "C": (0.0, 1.0)}
    edges = [Edge(tail=a, head=b, length=Fraction(1)) for a, b in ("AB", "BC", "CA")]
    scenario = Scenario(
        roadmap=make_roadmap(corners, edges),
        robots=tuple(
            Robot(name=f"R{k}", home=VertexId(k), stops=(Stop(at=VertexId((k + 1) % 3)),))
            for k in range(3)
        ),
        rules=Rules(ends="none", rotations=rotations),
    )
    report = check(make_plan(scenario, [([k, (k + 1) % 3], [0, 1]) for k in range(3)]))
    assert told(report) == ([] if rotations else [("rotation", (0, 1, 2), (0, 1, 2), 1)])


def test_two_circles_at_one_instant_are_two_rotations() -> None:
    # 0 1 @ 3 4      ids 0 1 . 2 3
    # 5 6 @ 8 9          4 5 . 6 7
    grid = ["..@..", "..@.."]
    ends = [("N0", "N1"), ("N1", "N6"), ("N6", "N5"), ("N5", "N0")]
    ends += [("N3", "N4"), ("N4", "N9"), ("N9", "N8"), ("N8", "N3")]
    scenario = grid_fleet(grid, ends, rules=Rules(ends="none", rotations=False))
    vertex = scenario.roadmap.get_vertex
    report = check(make_plan(scenario, [([vertex(a), vertex(b)], [0, 1]) for a, b in ends]))
    assert [fault.robots for fault in report.faults] == [(0, 1, 2, 3), (4, 5, 6, 7)]


def test_a_train_is_no_rotation() -> None:
    assert judged(([0, 1, 2], [0, 1, 2]), ([3, 0, 1], [0, 1, 2]), rotations=False).ok


def test_a_swap_is_no_rotation() -> None:
    report = judged(([3, 4], [0, 1]), ([4, 3], [0, 1]), rotations=False)
    assert report.counts == {"swap conflict": 1}


def test_faults_come_by_tick_then_by_robots() -> None:
    late_conflict = ([0, 1, 4, 5], [0, 1, 2, 4])
    report = judged(([3, 4, 7], [0, 3, 5]), late_conflict, ([6, 8], [0, 3]))
    assert [(fault.tick, fault.robots, fault.kind) for fault in report.faults] == [
        (3, (0, 1), "vertex conflict"),
        (3, (2,), "jump"),
    ]
    assert report.summary == "2 faults: 1 jump, 1 vertex conflict"
    assert str(report.faults[1]) == (
        "time 3: jump: R3 goes from N6 to N8, no edge leads there (use edges)"
    )


def test_the_earliest_faults_are_listed_whoever_makes_them() -> None:
    """R1 jumps at tick 3, R2 at tick 2, R3 at tick 1."""
    ends = [("N0", "N2"), ("N3", "N5"), ("N6", "N8")]
    trips = [([0, 2], [0, 3]), ([3, 5], [0, 2]), ([6, 8], [0, 1])]
    plan = make_plan(grid_fleet(OPEN, ends, rules=Rules(ends="none")), trips)
    assert told(check(plan, limit=2)) == [("jump", (2,), (6, 8), 1), ("jump", (1,), (3, 5), 2)]


def test_a_limit_holds_for_all_kinds_together() -> None:
    ends = [("N3", "N7"), ("N0", "N5"), ("N6", "N8")]
    trips = [([3, 4, 7], [0, 3, 5]), ([0, 1, 4, 5], [0, 1, 2, 4]), ([6, 8], [0, 3])]
    report = check(make_plan(grid_fleet(OPEN, ends, rules=Rules(ends="none")), trips), limit=1)
    assert told(report) == [("vertex conflict", (0, 1), (4,), 3)]
    assert report.counts == {"jump": 1, "vertex conflict": 1}


def test_a_visit_without_length_books_nothing() -> None:
    """R2 enters N4 and leaves it at tick 2, which is too fast already."""
    report = judged(([3, 4, 5], [0, 1, 4]), ([1, 4, 7], [0, 2, 2]))
    assert told(report) == [("too fast", (1,), (4, 7), 2)]


def test_a_robot_does_not_swap_with_itself() -> None:
    report = judged(([3, 4, 3], [0, 1, 1]))
    assert told(report) == [("too fast", (0,), (4, 3), 1)]


def test_a_plan_without_fault_says_so() -> None:
    assert str(judged(([0, 1], [0, 1]))) == "no fault"


def test_robots_without_a_roadmap_vertex_are_judged_all_the_same() -> None:
    scenario = grid_fleet(OPEN, [("N0", "N1"), ("N2", "N1")], rules=Rules(ends="none"))
    report = check(make_plan(scenario, [([99, 98], [0, 1]), ([98, 99], [0, 1])]))
    assert report.counts == {"unknown vertex": 4, "wrong end": 2, "wrong home": 2}


def test_faults_are_in_the_units_of_the_scenario_or_in_ticks_on_request() -> None:
    """A tick is half a second: R2 comes to N1 as R1 is there."""
    fleet = grid_fleet(["..."], [("N0", "N2"), ("N2", "N0")], speeds=[Fraction(2)] * 2)
    scenario = replace(fleet, units=Units(time="s"))
    tracks = (Track.of([0, 1, 2], [0, 1, 3]), Track.of([2, 1, 0], [0, 2, 4]))
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun())
    fault = check(plan).faults[0]
    assert str(fault).startswith("1 s: vertex conflict: R1 books N1 from 0.5 s to 1.5 s and R2")
    ticks = replace(Quantities.of(scenario), in_ticks=True)
    assert write_fault(fault, ticks).startswith(
        "tick 2: vertex conflict: R1 books N1 from tick 1 to 3 and R2"
    )
