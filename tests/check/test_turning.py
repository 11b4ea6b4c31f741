"""The judge and turns on the spot: planted faults, with angle, time and remedy."""

from __future__ import annotations

from fractions import Fraction

import pytest

from rightofway import check
from rightofway.model import Plan, PlannerRun, Robot, Rules, Scenario, Stop, Track
from rightofway.site import Edge, VertexId, make_roadmap
from tests.builders.fleets import grid_fleet

NAMES = ("N0", "N1", "N3", "N1", "N0")
"""Out along a corner and home again: turns of 90, 180 and 90 degrees."""


def judged(enter: list[int], *, rules: Rules, work: int = 0) -> list[str]:
    """Return the faults of a robot on the way out and home."""
    scenario = grid_fleet(["..", "@."], [("N0", "N3")], rules=rules, work=[work])
    vertices = [scenario.roadmap.get_vertex(name) for name in NAMES]
    plan = Plan(
        scenario=scenario, tracks=(Track.of(vertices, enter),), run=PlannerRun(name="by hand")
    )
    return [f"{fault.kind}: {fault.message}" for fault in check(plan).faults]


def test_a_robot_that_gives_each_turn_its_time_has_no_fault() -> None:
    """At 45 degrees per time unit: 2 for a corner, 4 for the U-turn; each drive takes 1."""
    assert judged([0, 1, 4, 9, 12], rules=Rules(turn_rate=Fraction(45))) == []


def test_the_same_plan_one_tick_faster_at_a_corner_is_a_fault() -> None:
    assert judged([0, 1, 3, 8, 11], rules=Rules(turn_rate=Fraction(45))) == [
        (
            "turn cut short: R1 turns 90 degrees at N1 in 1 time unit, it needs 2 time units"
            " (enter N3 at time 4 or later)"
        )
    ]


def test_a_stop_needs_the_turn_beside_its_work() -> None:
    """Work of 3 and a U-turn of 4 do not fit into 6 before the drive."""
    rules = Rules(turn_rate=Fraction(45))
    assert judged([0, 1, 4, 12, 15], rules=rules, work=3) == []
    assert judged([0, 1, 4, 11, 14], rules=rules, work=3) == [
        (
            "work cut short: R1 has 2 time units at N3, it needs 3 time units working"
            " (stay 1 time unit longer)"
        )
    ]


def test_a_first_drive_needs_no_turn_and_nobody_turns_at_the_end() -> None:
    assert judged([0, 1, 2, 3, 4], rules=Rules(turn=Fraction(0))) == []
    faults = judged([0, 1, 2, 3, 4], rules=Rules(turn_rate=Fraction(180)))
    assert [fault[: fault.index(" (")] for fault in faults] == [
        f"turn cut short: R1 turns {turn} time unit"
        for turn in (
            "90 degrees at N1 in 0 time units, it needs 1",
            "180 degrees at N3 in 0 time units, it needs 1",
            "90 degrees at N1 in 0 time units, it needs 1",
        )
    ]


@pytest.mark.parametrize(("stay", "kinds"), [(2, ["turn cut short"]), (3, [])])
def test_a_slanted_turn_is_rounded_up(stay: int, kinds: list[str]) -> None:
    """135 degrees at 90 per time unit take 1.5, so 2 ticks; the drive takes one more."""
    at = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (2.0, 2.0)}
    edges = [Edge(tail=tail, head=head, length=Fraction(4)) for tail, head in ("AB", "BC")]
    robot = Robot(
        name="R1",
        home=VertexId(0),
        stops=(Stop(at=VertexId(2)),),
        speed=Fraction(4),
        turn_rate=Fraction(90),
    )
    scenario = Scenario(roadmap=make_roadmap(at, edges), robots=(robot,), rules=Rules(ends="none"))
    tracks = (Track.of([0, 1, 2], [0, 1, 1 + stay]),)
    report = check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand")))
    assert [fault.kind for fault in report.faults] == kinds
