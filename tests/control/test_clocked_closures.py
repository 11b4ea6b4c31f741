"""Closures of the scenario while robots drive: kept by the clock of the run, as in a simulation."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from fractions import Fraction
from pathlib import Path

import pytest

import rightofway
from rightofway.control import SimulatedRobot, SqliteJournal
from rightofway.control.demo import drive_demo
from rightofway.control.driver import Driver
from rightofway.control.endpoints import RobotEnd
from rightofway.control.identities import make_simulated_identities
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.execution.drive_result import DriveResult
from rightofway.io import parse_scenario
from rightofway.model import Plan
from rightofway.report.quantities import Quantities
from tests.builders.closures import closed_fleet


def lane(*closures: dict[str, object], start: str | None = None) -> Plan:
    """Return the plan of a robot that drives along A, B, C, D and back; a lane takes 8 s."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {"A": [0, 0], "B": [8, 0], "C": [16, 0], "D": [24, 0]},
                "edges": [["A", "B"], ["B", "C"], ["C", "D"]],
            }
        },
        "units": {"length": "m", "time": "s"},
        "rules": {"rotations": False},
        "robots": [{"name": "R1", "home": "A", "target": "D", "work": 60}],
        "closures": list(closures),
        **({"start": start} if start else {}),
    }
    return rightofway.solve(parse_scenario(document), "prioritized")


def driven(plan: Plan, delays: str | tuple[()] = ()) -> tuple[DriveResult, list[str]]:
    """Return how a plan was driven, and what was said."""
    lines = list[str]()
    result = drive_demo(plan, delays, report=lambda _, fact: lines.append(str(fact)))
    return result, lines


def find_entries(result: DriveResult, place: str) -> list[Fraction]:
    """Return when the robot begins to drive to a place [s]."""
    assert result.trace is not None
    [track], [drive] = result.trace.tracks, result.trace.drive
    clock = result.plan.scenario.problem.clock
    rows = zip(track.vertices.tolist(), track.enter.tolist(), drive.tolist(), strict=True)
    name = result.plan.scenario.roadmap.name
    return [
        clock.convert_to_time(enter - ticks)
        for vertex, enter, ticks in rows
        if name(vertex) == place
    ]


def driver_of(
    plan: Plan, journal: SqliteJournal, seconds: float | None, robot: RobotEnd
) -> tuple[Driver, list[str]]:
    """Return a control some seconds after the begin of its run, and what it has said.

    None stands for the begin that the journal or the scenario has.

    The robot has got what it was sent, and drives as far as it may.
    """
    said = list[str]()
    identities = make_simulated_identities(["R1"])
    began = journal.read_begin() if seconds is None else time.time() - seconds
    driver = Driver(
        plan, identities, journal, report=lambda fact: said.append(str(fact)), began=began
    )
    letters = deque(driver.end.make_letters(driver.control.start()))
    for _ in range(12):
        letters.extend(driver._run_round())
        while letters:
            robot.receive(letters.popleft())
            letters.extend(driver.end.receive(robot.report_state()))
        robot.robot.step()
        letters.extend(driver.end.receive(robot.report_state()))
    return driver, said


def test_a_control_keeps_closures_from_the_begin_of_its_run_on_also_after_a_start(
    tmp_path: Path,
) -> None:
    plan, journal = lane(CLOSED), SqliteJournal(tmp_path / "run.journal")
    assert journal.read_begin() is None
    [identity] = make_simulated_identities(["R1"])
    robot = RobotEnd(SimulatedRobot("A"), 0, identity, lambda: "2026-01-31T12:00:00.000Z")
    driver, said = driver_of(plan, journal, 30, robot)
    driver._flush()
    line = "R1 waits at B: the way to C is closed from 20 s to 1 min 20 s"
    assert (robot.robot.place, said) == ("B", [line])
    assert journal.read_begin() == pytest.approx(time.time(), abs=30)
    driver, said = driver_of(plan, journal, 90, robot)
    assert (driver.control.is_done, said) == (True, [])
    journal.close()


def test_a_run_of_a_scenario_with_a_start_keeps_closures_by_the_wall_clock(tmp_path: Path) -> None:
    """The journal begins 30 s after the start: the lane is closed from 10 s ago for 50 s more."""
    start = (datetime.now(UTC) - timedelta(seconds=30)).replace(microsecond=0)
    begin, end = (f"{start + timedelta(seconds=late):%Y-%m-%dT%H:%M:%S}Z" for late in (20, 80))
    closure: dict[str, object] = {"edge": ["B", "C"], "from": begin, "until": end}
    plan, journal = lane(closure, start=start.isoformat()), SqliteJournal(tmp_path / "run.journal")
    [identity] = make_simulated_identities(["R1"])
    robot = RobotEnd(SimulatedRobot("A"), 0, identity, lambda: "2026-01-31T12:00:00.000Z")
    driver, said = driver_of(plan, journal, None, robot)
    driver._flush()
    closed, opened = map(Quantities.of(plan.scenario).format_moment, (5, 20))  # ticks of 4 s
    line = f"R1 waits at B: the way to C is closed from {closed} to {opened}"
    clock = f"the clock of the run counts from {start:%Y-%m-%dT%H:%M:%S}Z, and it is "
    assert said[0].startswith(clock.replace(":00Z", "Z"))
    assert (robot.robot.place, said[1:]) == ("B", [line])
    assert journal.read_begin() == start.timestamp()
    # The next start has the begin from the journal.
    driver, said = driver_of(plan, journal, None, robot)
    assert (robot.robot.place, driver.control.is_done) == ("B", False)
    journal.close()


def test_a_control_that_begins_before_the_start_of_the_scenario_waits_with_its_clock(
    tmp_path: Path,
) -> None:
    start = (datetime.now(UTC) + timedelta(hours=1)).isoformat(timespec="minutes")
    journal = SqliteJournal(tmp_path / "run.journal")
    said = list[str]()
    driver = Driver(lane(start=start), make_simulated_identities(["R1"]), journal,
                    report=lambda fact: said.append(str(fact)))  # fmt: skip
    assert driver._read_ticks() == 0
    journal.close()


CLOSED = {"edge": ["B", "C"], "from": 20, "until": 80}


def test_a_robot_that_is_late_waits_until_a_lane_is_open_and_the_log_says_so() -> None:
    result, lines = driven(lane(CLOSED), "stop:R1@2+30")
    assert find_entries(result, "C")[0] == 80
    assert "R1 waits at B: the way to C is closed from 20 s to 1 min 20 s" in lines


def test_a_robot_that_is_in_time_goes_first() -> None:
    """It is through at 16 s, four seconds before the lane is closed, and comes back at 92 s."""
    result, lines = driven(lane(CLOSED))
    assert find_entries(result, "C")[0] == 8
    assert find_entries(result, "B")[-1] == 92
    assert not [line for line in lines if "closed" in line]


@pytest.mark.parametrize("delay", range(0, 120, 4))
@pytest.mark.parametrize(
    "closure",
    [CLOSED, {"at": "C", "from": 28, "until": 84}, {"edge": ["C", "D"], "from": 30, "until": 44}],
    ids=["lane", "place", "last lane"],
)
def test_nobody_drives_into_what_is_closed_however_late_it_is(
    closure: dict[str, object], delay: int
) -> None:
    """The robot stops at once, before it gets what is closed soon."""
    plan = lane(closure)
    result, _ = driven(plan, f"stop:R1@0+{delay}" if delay else ())
    assert result.jobs == (1,)
    assert list(list_entries_into_closed(result)) == []


def list_entries_into_closed(result: DriveResult) -> Iterator[str]:
    """Yield where a robot begins to drive into an edge or a vertex that is closed for it."""
    assert result.trace is not None
    scenario, closures = result.plan.scenario, result.plan.scenario.problem.closures
    assert closures is not None
    for robot, (track, drives) in enumerate(
        zip(result.trace.tracks, result.trace.drive, strict=True)
    ):
        vertices, enter = track.vertices.tolist(), track.enter.tolist()
        for visit in range(1, len(vertices)):
            begin = enter[visit] - int(drives[visit])
            edge = scenario.roadmap.find_edge(vertices[visit - 1], vertices[visit])
            assert edge is not None
            intervals = [
                *closures.list_along_edge(robot, edge),
                *closures.list_at_vertex(robot, vertices[visit]),
            ]
            for start, end in intervals:
                if start <= begin < end:
                    yield f"{robot} at {begin} to {vertices[visit]}, closed {start} to {end}"


def test_fleets_keep_closures_of_any_kind() -> None:
    """Places, lanes, with a radius, for robots with sizes; they drive as planned, but for waits."""
    judged = 0
    for seed in range(30):
        fleet = closed_fleet(seed)
        try:
            plan = rightofway.solve(fleet, "prioritized", time_limit=None)
            result = drive_demo(plan)
        except (NoPlanExists, GaveUp, InputError):
            continue
        if result.trace is not None:
            judged += 1
            assert list(list_entries_into_closed(result)) == [], seed
    assert judged > 10


def test_a_lane_that_is_closed_for_good_is_driven_round() -> None:
    """R1 is late, finds its way back closed, and takes the other one."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["...", ".@.", "..."]},
        "rules": {"rotations": False},
        "robots": [{"name": "R1", "home": "N0", "target": "N2", "work": 1}],
        "closures": [{"at": "N1", "from": 9}],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    result, _ = driven(plan, "stop:R1@0+6")
    assert (result.jobs, result.trace) == ((1,), None)
