"""Faults of robots with a size: places booked too near each other, discs that meet."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from rightofway import check
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Track
from rightofway.units import Units
from tests.builders.fleets import grid_fleet
from tests.builders.sizes import crossing, with_radii


def make_plan(scenario: Scenario, *tracks: tuple[list[int], list[int]]) -> Plan:
    return Plan(
        scenario=scenario,
        tracks=tuple(Track.of(*track) for track in tracks),
        run=PlannerRun(name="by hand"),
    )


def row(radii: list[str], trips: list[tuple[str, str]]) -> Scenario:
    """Return robots on eight cells in a row, with one way trips."""
    fleet = grid_fleet(["........"], trips, rules=Rules(ends="none"))
    return with_radii(fleet, [Fraction(radius) for radius in radii])


def test_discs_that_meet_where_lanes_cross_are_found_with_place_time_and_distance() -> None:
    """Both are at the crossing after 2 s: distance 0. R2 is 1 s late in the second plan, so that
    the positions are (t, 0) and (2, t - 3): nearest at t = 2.5, at sqrt(0.5) = 0.71."""
    scenario = replace(crossing(), units=Units(length="m", time="s"))
    report = check(make_plan(scenario, ([0, 1], [0, 4]), ([2, 3], [0, 4])))
    assert report.counts == {"space conflict": 1, "too close": 1}
    assert str(report.faults[1]) == (
        "2 s: too close: R1 and R2 come within 0 m (0.9 needed) at 2 s, R1 between A and B,"
        " R2 between C and D (let one wait until the other is by)"
    )
    report = check(make_plan(scenario, ([0, 1], [0, 4]), ([2, 3], [0, 5])))
    assert [fault.kind for fault in report.faults] == ["space conflict", "too close"]
    assert report.faults[0].message == (
        "R1 books the edge from A to B and R2 books the edge from C to D, which are too near"
        " to be booked at one time (let one come when the other has left)"
    )
    assert "come within 0.71 m (0.9 needed) at 2.5 s" in report.faults[1].message


def test_bookings_that_overlap_are_told_from_discs_that_meet() -> None:
    """R2 starts 2 s later: when R1 is 1.41 away at the least, but still on its edge."""
    report = check(make_plan(crossing(), ([0, 1], [0, 4]), ([2, 3], [0, 6])))
    assert report.counts == {"space conflict": 1}
    assert check(make_plan(crossing(), ([0, 1], [0, 4]), ([2, 3], [0, 8]))).ok


def test_points_may_cross() -> None:
    points = with_radii(crossing(), [Fraction(0)])
    assert check(make_plan(points, ([0, 1], [0, 4]), ([2, 3], [0, 4]))).ok


def test_two_points_beside_a_robot_with_a_size_are_judged_as_points() -> None:
    """Two points pass at 1, less than the clearance; the robot with a size is 2.2 away, not 2."""
    fleet = grid_fleet(
        ["....", "....", "...."],
        [("N0", "N1"), ("N5", "N4"), ("N11", "N11")],
        rules=Rules(ends="none"),
    )
    mixed = with_radii(fleet, [Fraction(0), Fraction(0), Fraction(1, 2)], Fraction(3, 2))
    assert check(make_plan(mixed, ([0, 1], [0, 1]), ([5, 4], [0, 1]), ([11], [0]))).ok


def test_a_robot_that_stands_beside_a_lane_is_in_the_way() -> None:
    """Cells are 1 apart, discs of radius 0.6 need 1.2: R1 may come as near as two cells."""
    fleet = row(["0.6", "0.6"], [("N0", "N3"), ("N4", "N4")])
    report = check(make_plan(fleet, ([0, 1, 2, 3], [0, 1, 2, 3]), ([4], [0])))
    assert report.counts == {"space conflict": 1, "too close": 1}
    assert [fault.vertices for fault in report.faults] == [(3, 4), (2, 3, 4)]
    fleet = row(["0.6", "0.6"], [("N0", "N2"), ("N4", "N4")])
    assert check(make_plan(fleet, ([0, 1, 2], [0, 1, 2]), ([4], [0]))).ok


def test_discs_may_touch() -> None:
    fleet = row(["0.5", "0.5"], [("N0", "N3"), ("N4", "N4")])
    assert check(make_plan(fleet, ([0, 1, 2, 3], [0, 1, 2, 3]), ([4], [0]))).ok
    wider = with_radii(fleet, [Fraction(1, 2)], Fraction(1, 10**9))
    assert not check(make_plan(wider, ([0, 1, 2, 3], [0, 1, 2, 3]), ([4], [0]))).ok


def test_the_sizes_of_both_robots_count() -> None:
    """0.9 and 0.3 need 1.2, twice 0.3 need 0.6 only."""
    tracks = ([0, 1], [0, 1]), ([2], [0]), ([5], [0])
    trips = [("N0", "N1"), ("N2", "N2"), ("N5", "N5")]
    assert check(make_plan(row(["0.3", "0.3", "0.9"], trips), *tracks)).ok
    assert check(make_plan(row(["0.9", "0.3", "0.3"], trips), *tracks)).counts == {
        "space conflict": 1,
        "too close": 1,
    }


def test_a_convoy_of_discs_that_needs_two_cells_drives_two_cells_apart() -> None:
    """R2 starts to drive to N1 when R1 has left N2, at tick 2."""
    fleet = row(["0.6", "0.6"], [("N2", "N5"), ("N0", "N3")])
    ahead = ([2, 3, 4, 5], [0, 1, 2, 3])
    assert check(make_plan(fleet, ahead, ([0, 1, 2, 3], [0, 2, 3, 4]))).ok
    assert not check(make_plan(fleet, ahead, ([0, 1, 2, 3], [0, 1, 2, 3]))).ok


@pytest.mark.parametrize("headway", [0, 1])
def test_headway_lengthens_bookings_of_neighbours_as_well(headway: int) -> None:
    fleet = row(["0.6", "0.6"], [("N2", "N5"), ("N0", "N3")])
    fleet = replace(fleet, rules=replace(fleet.rules, headway=Fraction(headway)))
    plan = make_plan(fleet, ([2, 3, 4, 5], [0, 1, 2, 3]), ([0, 1, 2, 3], [0, 2, 3, 4]))
    assert check(plan).counts == ({"space conflict": 1} if headway else {})


def test_every_meeting_of_two_robots_is_one_fault() -> None:
    """R1 passes R2 on its way there, and again on its way back."""
    fleet = row(["0.6", "0.2"], [("N0", "N0"), ("N7", "N7")])
    there_and_back = [0, 1, 2, 3, 4, 5, 6, 5, 4, 5, 6, 5]
    report = check(make_plan(fleet, (there_and_back, list(range(12))), ([7], [0])))
    assert report.counts.get("too close", 0) == 0
    wider = with_radii(fleet, [Fraction("0.9"), Fraction("0.2")])
    report = check(make_plan(wider, (there_and_back, list(range(12))), ([7], [0])))
    assert report.counts["too close"] == 2
