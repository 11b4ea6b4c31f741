"""The judge on closures and barred edges, case by case."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway import FleetBuilder, check
from rightofway.model import Closure, Plan, PlannerRun, Scenario, Track


def corridor(occupancy: str = "one", headway: int = 0) -> Scenario:
    """Return a robot from A to D at speed 1; heavy ones are barred from the way by E."""
    fleet = FleetBuilder(occupancy=occupancy, headway=headway, ends="none")
    for name, x, y in [("A", 0, 0), ("B", 2, 0), ("C", 4, 0), ("D", 6, 0), ("E", 2, 2)]:
        fleet.add_vertex(name, x, y)
    fleet.add_edge("A", "B").add_edge("B", "C").add_edge("C", "D")
    fleet.add_edge("A", "E", 4, barred=["heavy"]).add_edge("E", "C", 4)
    return fleet.add_robot("R1", home="A", target="D", type="heavy").build_scenario()


def plan(scenario: Scenario, names: str = "ABCD", enter: Any = (0, 2, 4, 6)) -> Plan:
    """Return a plan; the tick is 2 time units, so times are given in time units."""
    vertices = [scenario.roadmap.get_vertex(name) for name in names]
    tick = scenario.problem.clock.tick
    track = Track.of(vertices, [int(time / tick) for time in enter])
    return Plan(scenario=scenario, tracks=(track,), run=PlannerRun())


def closure(scenario: Scenario, *names: str, **times: Any) -> Closure:
    """Return a closure of a vertex or an edge."""
    ends = tuple(scenario.roadmap.get_vertex(name) for name in names)
    place = {"at": ends[0]} if len(ends) == 1 else {"edge": ends}
    given = {key: Fraction(value) for key, value in times.items() if value is not None}
    return Closure(**place, **given)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("occupancy", "headway", "names", "times", "is_free"),
    [
        ("one", 0, "B", {"from_": 4, "until": 9}, True),  # left as it closes
        ("one", 0, "B", {"from_": 3, "until": 9}, False),  # rounded down to 2
        ("one", 0, "B", {"until": 2}, True),  # entered as it opens
        ("one", 0, "B", {"until": "2.1"}, False),  # rounded up to 4
        ("both", 0, "B", {"until": 2}, False),  # booked ahead
        ("one", 2, "B", {"from_": 4, "until": 9}, False),  # the robot's headway
        ("one", 2, "B", {"until": 2}, True),  # the closure has none
        ("one", 0, "CB", {"from_": 2, "until": 4}, False),  # the drive from B to C
        ("one", 0, "CB", {"from_": 4}, True),
        ("one", 0, "CB", {"until": 2}, True),
        ("one", 0, "D", {"from_": 90}, False),  # the last visit never ends
        ("one", 0, "D", {"until": 6}, True),
        ("one", 0, "A", {"until": 2}, False),
        ("one", 0, "E", {}, True),
    ],
)
def test_bookings_of_what_is_closed_are_found(
    occupancy: str, headway: int, names: str, times: dict[str, Any], is_free: bool
) -> None:
    """R1 is at A until 2, at B until 4, at C until 6, then at D; it drives all the time."""
    scenario = corridor(occupancy, headway)
    closed = replace(scenario, closures=(closure(scenario, *names, **times),))
    assert scenario.problem.clock.tick == 2
    report = check(plan(closed))
    assert dict(report.counts) == ({} if is_free else {"closed": 1})


def test_a_fault_names_robot_place_and_times() -> None:
    scenario = corridor()
    closures = (closure(scenario, "C", until=8), closure(scenario, "B", "A", from_=1))
    first, second = check(plan(replace(scenario, closures=closures))).faults
    assert str(first) == (
        "time 0: closed: R1 books the edge between A and B at time 0, which is closed permanently"
        " (come after that, or leave before it begins)"
    )
    assert str(second) == (
        "time 4: closed: R1 books C at time 4, which is closed until 8"
        " (come after that, or leave before it begins)"
    )


def test_a_drive_along_a_barred_edge_is_found() -> None:
    scenario = corridor()
    report = check(plan(scenario, "AECD", (0, 4, 8, 10)))
    (fault,) = report.faults
    assert fault.message == (
        "R1 drives from A to E, which is barred for type heavy (choose another way)"
    )
    light = replace(scenario, robots=(replace(scenario.robots[0], type=None),))
    assert check(plan(light, "AECD", (0, 4, 8, 10))).ok
