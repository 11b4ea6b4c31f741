"""Robots that no plan has join robots that drive."""

from __future__ import annotations

import json
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.control import FleetControl, SimulatedRobot
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.identities import make_simulated_identities
from rightofway.control.joins import Joins, grow_identities, grow_plan
from rightofway.control.journal import Entry, JournalRow, SqliteJournal
from rightofway.control.notices import Notices
from rightofway.control.recording import Recording
from rightofway.control.round_worker import RoundsAtOnce
from rightofway.errors import GaveUp, InputError
from rightofway.io import parse_scenario
from rightofway.model import Plan
from rightofway.studio.watching import Watched
from tests.builders.chaos import MemoryJournal
from tests.builders.floor_jobs import floor_document
from tests.builders.floors import Floor


def plan_of(**changes: Any) -> Plan:
    """Return a plan of two like robots without batteries."""
    document = floor_document()
    robots = [{"name": "R1", "home": "N0"}, {"name": "R2", "home": "N4"}]
    scenario = parse_scenario({**document, "robots": robots, **changes})
    return rightofway.solve(scenario, "prioritized")


class Fleet:
    """A control whose fleet grows, built anew as a driver does it; and robots at their places."""

    def __init__(self, plan: Plan | None = None) -> None:
        self.given = plan or plan_of()
        self.now, self.journal, self.said = 0, MemoryJournal(), list[str]()
        self.robots = list[SimulatedRobot]()
        self.build()

    def build(self) -> None:
        """Build all anew from the journal, as after a kill."""
        roadmap = self.given.scenario.roadmap
        control = FleetControl(self.journal, roadmap=roadmap, snapshot_every=20)
        if control.ledger.grows:
            control.commit({"kind": "fleet grown"})
        names = [robot.name for robot in self.given.scenario.robots]
        identities = make_simulated_identities(names)
        joined = control.ledger.joined.values()
        plan = grow_plan(self.given, joined)
        self.identities = grow_identities(names, identities, joined)
        self.dispatcher = Dispatcher(control, plan, rounds=RoundsAtOnce(None))
        self.dispatcher.keep_time(lambda: self.now)
        self.joins = Joins(self.given, identities, self.dispatcher)
        if not control.ledger.run:
            self.dispatcher.begin("run")
        names = [*control.ledger.names]
        self.notices = Notices(names, lambda fact: self.said.append(str(fact)))
        own = control.ledger.robots[len(self.robots) :]
        self.robots += (SimulatedRobot(robot.route.places[0]) for robot in own)
        self.floor = Floor(self.dispatcher, robots=self.robots, joins=self.joins)

    def join(self, name: str = "R3", at: str = "N2", serial: str = "new", **more: Any) -> str:
        """Ask for a robot to join; return the answer."""
        command = {"kind": "join", "name": name, "serial": serial, "at": at, **more}
        messages, answer = self.floor.operator._run_command(command)
        self.floor.send(messages)
        if self.dispatcher.ledger.grows:
            self.build()
        return str(self.dispatcher.ledger.answer or answer)

    def add_job(self, name: str, **values: Any) -> None:
        """Add a job."""
        command = {"kind": "add", "name": name, **values}
        self.floor.send(self.floor.operator._run_command(command)[0])

    def drive(self, seconds: int) -> None:
        """Have robots drive, and the control look after those that join."""
        for _ in range(seconds):
            self.now += 1
            self.floor.drive(1)
            self.floor.send(self.dispatcher.follow_time())
            self.floor.send(self.joins.look(self.notices))

    @property
    def ends(self) -> dict[str, str]:
        """The robot that has done each job."""
        ledger = self.dispatcher.ledger
        ends = ledger.pool.ends.items()
        return {name: ledger.names[end.robot] for name, end in ends if end.robot is not None}


def test_a_robot_that_joins_gets_jobs_and_leaves_again() -> None:
    fleet = Fleet()
    fleet.drive(3)
    fleet.join()
    fleet.drive(2)
    assert "R3 has joined at N2" in fleet.said
    fleet.add_job("A1", pickup="N12", dropoff="N14", robot="R3")
    fleet.drive(60)
    assert fleet.ends["A1"] == "R3"
    assert not fleet.dispatcher.ledger.pool.jobs
    fleet.floor.send(fleet.floor.operator.operate("remove", "R3"))
    fleet.add_job("A2", at="N12")
    fleet.drive(40)
    assert fleet.ends["A2"] in {"R1", "R2"}
    assert fleet.dispatcher.ledger.robots[2].is_off


@pytest.mark.parametrize(
    ("given", "fault"),
    [
        ({"name": "R1"}, "'R1' is a robot already"),
        ({"serial": "robot1"}, "'robot1' is the serial number of R2 already"),
        ({"serial": "a/b"}, "cannot be part of a topic"),
        ({"serial": ""}, "serial: is missing"),
        ({"at": ""}, "at: is missing"),
        ({"at": "N9x"}, "N9x"),
        ({"at": "N4"}, "home: N4 is the home of R2 already"),
        ({"set": {"home": "N0"}}, "home: N0 is the home of R1 already"),
        ({"set": {"sped": 2}}, "sped: unknown key .did you mean speed"),
        ({"set": {"speed": 0}}, "speed"),
        ({"set": {"version": "4.0.0"}}, "version"),
        ({"set": {"start": {"at": "N2"}}}, "cannot be set"),
        ({"set": {"name": "R9"}}, "cannot be set"),
        ({"set": {"battery": "none"}}, "battery"),
        ({"set": {"radius": 1}}, "radius"),
        ({"like": "R9"}, "R9"),
        ({"like": "R3"}, "R3"),
    ],
)  # fmt: skip
def test_a_robot_that_may_not_join_is_refused_and_changes_nothing(
    given: dict[str, Any], fault: str
) -> None:
    fleet = Fleet()
    before = [*fleet.journal.written]
    with pytest.raises(InputError, match=fault):
        fleet.join(**given)
    assert fleet.journal.written == before


def test_robots_that_differ_need_one_that_is_named() -> None:
    robots = [{"name": "R1", "home": "N0", "speed": 2}, {"name": "R2", "home": "N4"}]
    fleet = Fleet(plan_of(robots=robots))
    with pytest.raises(InputError, match="R1 and R2 differ"):
        fleet.join()
    fleet.join(like="R1", set={"capacity": 3, "version": "3.0.0"})
    robot, identity = fleet.dispatcher.plan.scenario.robots[2], fleet.identities[2]
    assert robot.speed == 2
    assert robot.capacity == 3
    assert identity.get_topic("state") == "vda5050/v3/rightofway/new/state"


def test_a_plan_without_jobs_has_its_robots_for_good() -> None:
    fleet = Fleet()
    fleet.floor.operator._joins = None
    with pytest.raises(InputError, match="plan with jobs"):
        fleet.join()


def test_a_place_that_another_robot_holds_is_refused() -> None:
    fleet = Fleet()
    fleet.drive(1)
    held = fleet.dispatcher.ledger.robots[0].held
    with pytest.raises(GaveUp, match="R1 holds"):
        fleet.join(at=held[-1])


def test_a_robot_waits_until_its_state_shows_it_and_the_reason_is_reported_once() -> None:
    fleet = Fleet()
    fleet.join()
    fleet.robots[2].place = "N12"
    fleet.drive(40)
    assert fleet.said.count("R3 cannot join at N2 yet: its state names N12") == 1
    assert fleet.dispatcher.ledger.robots[2].is_off
    fleet.robots[2].place = "N2"
    fleet.drive(1)
    assert "R3 has joined at N2" in fleet.said
    assert not fleet.dispatcher.ledger.robots[2].is_off


def test_a_wrong_serial_number_is_corrected_by_the_same_command() -> None:
    fleet = Fleet()
    fleet.join(serial="wrong")
    fleet.robots[2].place = ""
    fleet.drive(1)
    fleet.join(serial="right")
    assert [identity.serial_number for identity in fleet.identities] == [
        "robot0",
        "robot1",
        "right",
    ]
    fleet.robots[2].place = "N2"
    fleet.drive(1)
    assert "R3 has joined at N2" in fleet.said
    with pytest.raises(InputError, match="is a robot already"):
        fleet.join(serial="other")


def test_what_is_killed_at_any_entry_goes_on_with_the_same_fleet() -> None:
    fleet = Fleet()
    fleet.join()
    fleet.join("R4", "N7", "newer", like="R1")
    fleet.drive(30)
    for count in range(2, len(fleet.journal.written)):
        again = Fleet.__new__(Fleet)
        again.given, again.now, again.said = fleet.given, fleet.now, []
        again.journal, again.robots = MemoryJournal(), []
        again.journal.written = json.loads(json.dumps(fleet.journal.written[:count]))
        joined = {entry["name"] for entry in again.journal.written if entry["kind"] == "joined"} | {
            own["name"] for own in again.journal.written[0].get("joined", ())
        }
        again.build()
        assert {*again.dispatcher.ledger.names} == {"R1", "R2"} | joined


class Rows:
    """Rows of entries, one in each second."""

    is_written = False

    def __init__(self, entries: list[Entry]) -> None:
        self.rows = [JournalRow(k, float(k), entry) for k, entry in enumerate(entries, 1)]
        self.end = 0

    def read_rows(self, after: int = 0) -> list[JournalRow]:
        return self.rows[after : self.end]


def test_a_recording_has_the_robots_that_have_joined() -> None:
    """Read entry by entry, and from a snapshot on."""
    fleet = Fleet()
    fleet.join()
    fleet.add_job("A1", pickup="N12", dropoff="N14", robot="R3")
    fleet.drive(60)
    rows = Rows(fleet.journal.written)
    recording = Recording(fleet.given, rows)
    while rows.end < len(rows.rows):
        rows.end += 1
        recording.read_on()
    assert [robot.name for robot in recording.plan.scenario.robots] == ["R1", "R2", "R3"]
    assert {row[1] for row in recording.take_frame()["rows"]} >= {0, 1, 2}
    assert recording.result.jobs[2] == 1


def test_a_page_has_the_robots_that_have_joined_and_no_faults_of_their_places(
    tmp_path: Path,
) -> None:
    """N2 is on the route of R1: the plan of both robots does not know that R3 is there."""
    fleet = Fleet()
    fleet.join()
    fleet.drive(10)
    with closing(SqliteJournal(tmp_path / "plan.journal")) as journal:
        journal.commit(fleet.journal.written)
    page = Watched(fleet.given, tmp_path / "plan.journal", title="plan", takes_orders=False)
    text = page.make_page(is_whole=True)
    assert "<title>plan: 3 robots" in text
    assert '"faults":{"count":0' in text
