"""What goes wrong: what this robot does, what the others do, what is reported; a test for each row.

The cases are those of docs/failures.md. R1 works at N1, and R2
comes by there twice; there is another way for it as long as R1 is not at its home N5.

    N0  N1  N2  N3
    N4  N5  N6  N7
"""

from __future__ import annotations

import ast
import asyncio
import json
import sqlite3
from collections import deque
from collections.abc import AsyncIterator, Collection
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

import rightofway
from rightofway.control import (
    Condition,
    FleetControl,
    InstantAction,
    JournalFailed,
    RobotError,
    SimulatedRobot,
    StateReport,
)
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.driver import Driver
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.identities import Identity, make_simulated_identities
from rightofway.control.names import list_jobs
from rightofway.control.notices import EVERY_KIND, Notices, make_notice
from rightofway.control.operator import Operator
from rightofway.control.order_map import make_order_maps
from rightofway.control.supervisor import Supervisor
from rightofway.errors import GaveUp, InputError
from rightofway.io import parse_scenario
from rightofway.model import Plan
from tests.builders.chaos import MemoryJournal
from tests.builders.pages import ROOT
from tests.builders.plans import door

NOW = "2026-01-31T12:00:00.000Z"


def hall() -> Plan:
    """Return a plan of two robots."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["....", "...."]},
        "rules": {"rotations": False},
        "robots": [
            {"name": "R1", "home": "N5", "target": "N1", "work": 3},
            {"name": "R2", "home": "N0", "target": "N2", "work": 1},
        ],
    }
    return rightofway.solve(parse_scenario(document), "prioritized")


class Floor:
    """Robots and their control, with all that is said between them."""

    def __init__(self) -> None:
        self.plan, self.journal, self.said = hall(), MemoryJournal(), list[str]()
        self.sent: list[Letter] = []
        names = [robot.name for robot in self.plan.scenario.robots]
        self.identities = [Identity(manufacturer="maker", serial_number=name) for name in names]
        self._begin()
        self.robots = [
            RobotEnd(SimulatedRobot(own.route.places[0]), k, self.identities[k], lambda: NOW)
            for k, own in enumerate(self.ledger.robots)
        ]
        self.deliver(self.end.make_letters(self.dispatcher.control.start()))

    def _begin(self) -> None:
        notices = Notices(
            [one.serial_number for one in self.identities], lambda fact: self.said.append(str(fact))
        )
        control = FleetControl(self.journal, look_ahead=1, report=notices.report_on)
        self.dispatcher = Dispatcher(control, self.plan, planner="prioritized")
        self.operator = Operator(self.dispatcher)
        if not self.journal.written:
            self.dispatcher.begin("run")
        maps = make_order_maps(self.plan.scenario, self.identities)
        self.end = ControlEnd(control, maps, lambda: NOW, notices)
        self.ledger = control.ledger

    def kill(self) -> None:
        """Kill the control, and start it again on its journal."""
        self._begin()
        self.deliver(self.end.make_letters(self.dispatcher.control.start()))

    def deliver(self, letters: list[Letter], refused: Collection[int] = ()) -> None:
        """Bring letters where they belong, and all that is answered; robots may refuse orders."""
        queue = deque(letters)
        while queue:
            letter = queue.popleft()
            letter = Letter(letter.topic, letter.payload)  # as over a network
            self.sent.append(letter)
            for number, robot in enumerate(self.robots):
                if letter.topic in robot.topics and number not in refused:
                    robot.receive(letter)
                    queue.extend(self.end.receive(robot.report_state()))

    def send(self, messages: Any) -> None:
        """Deliver messages of the control."""
        self.deliver(self.end.make_letters(messages))

    def hear(self, robot: int, **changes: Any) -> None:
        """Let a robot send its state with changes."""
        letter = self.robots[robot].report_state()
        document = {**json.loads(letter.payload), **changes}
        self.deliver(self.end.receive(Letter(letter.topic, json.dumps(document).encode())))

    def drive(self, steps: int, still: Collection[int] = ()) -> None:
        """Have robots do the next things, but those that stand still; they send their states."""
        for _ in range(steps):
            for number, robot in enumerate(self.robots):
                if number not in still:
                    robot.robot.step()
                self.deliver(self.end.receive(robot.report_state()))
            self.send(self.dispatcher.control.remind())

    def drive_to(self, robot: int, place: str) -> None:
        """Have robots drive until one is at a place, without what it may drive on."""
        while self.robots[robot].robot.place != place:
            self.drive(1)

    def wait(self, still: Collection[int] = ()) -> None:
        """Let so much time go by that others pass a robot that is stuck."""
        for _ in range(60):
            self.send(self.dispatcher.pass_stuck())
            self.drive(1, still)

    @property
    def places(self) -> list[str]:
        """Where robots are."""
        return [robot.robot.place for robot in self.robots]

    @property
    def done(self) -> list[int]:
        """How many jobs each robot has done."""
        return [sum(robot.robot.done.values()) for robot in self.robots]

    def ends_well(self) -> bool:
        """Return whether all robots come home with their jobs done once."""
        self.drive(80)
        return self.places == ["N5", "N0"] and self.done == [1, 1]


@pytest.fixture
def floor() -> Floor:
    """Return robots of which R1 is at N1, in the way of R2."""
    made = Floor()
    made.drive_to(0, "N1")
    made.said.clear()
    return made


def test_a_robot_that_is_late_or_stops(floor: Floor) -> None:
    floor.drive(60, still=[0])
    assert floor.places[1] in {"N0", "N2"}  # waits before N1
    assert floor.done[1] + (floor.places[1] == "N0") < 2
    assert floor.said == []
    assert floor.ends_well()


TROUBLES = {
    "error": Condition(errors=(RobotError(kind="laser", level="FATAL"),)),
    "mode": Condition(mode="MANUAL"),
    "pause": Condition(is_paused=True),
    "stop": Condition(emergency_stop="MANUAL"),
}


@pytest.mark.parametrize("kind", TROUBLES)
def test_a_robot_that_is_not_fit(floor: Floor, kind: str) -> None:
    """R2 goes round it, and R1 goes on when it is fit again."""
    floor.robots[0].condition = TROUBLES[kind]
    floor.drive(5)
    assert len(floor.said) == 1
    released = floor.ledger.robots[0].released
    floor.wait()
    assert floor.ledger.robots[0].released == released
    assert floor.places[1] == "N0"
    assert floor.done[1] == 1
    floor.robots[0].condition = Condition()
    assert floor.ends_well()
    assert len(floor.said) <= 2  # that it has ended


def test_a_robot_that_is_lost_and_comes_back(floor: Floor) -> None:
    """It has driven on to the end of what it holds meanwhile."""
    topic = floor.identities[0].get_topic("connection")
    broken = {"connectionState": "CONNECTIONBROKEN"}
    for _ in range(3):
        floor.deliver(floor.end.receive(Letter(topic, json.dumps(broken).encode())))
    assert floor.said == [
        "R1 is not connected: it keeps its released nodes and gets no further ones"
    ]
    away, floor.robots[0:1] = floor.robots[0], []
    for _ in range(20):
        away.robot.step()
    floor.wait()
    assert floor.places == ["N0"]
    floor.robots.insert(0, away)
    assert floor.ends_well()
    assert floor.said[1:] == ["R1 is connected again"]


def test_a_robot_that_forgets_its_order(floor: Floor) -> None:
    assert floor.robots[0].robot.forget()
    floor.drive(3)
    assert len(floor.ledger.robots[0].orders) > 1
    assert floor.ends_well()
    assert floor.said == []


def test_a_robot_that_is_elsewhere_when_it_comes_back(floor: Floor) -> None:
    """It was pushed to N3, which it says; a person has control take it in again from there."""
    robot = floor.robots[0].robot
    assert robot.forget()
    robot.place = "N3"
    floor.drive(3)
    sentence = "it is at N3, which it does not hold; a person has to look after it"
    assert floor.said == [f"R1 is faulty: {sentence}"]
    with pytest.raises(InputError, match=r"R1 is on the floor .*remove R1"):
        floor.operator.place_robot("R1")
    floor.send(floor.operator.operate("remove", "R1"))
    floor.send(floor.operator.place_robot("R1"))
    assert floor.ledger.robots[0].held[0] == "N3"
    assert floor.ends_well()
    assert len(floor.said) == 1


def test_a_robot_is_placed_where_nobody_is_and_not_with_an_old_order(floor: Floor) -> None:
    floor.send(floor.operator.operate("remove", "R1"))
    others = floor.places[1]
    with pytest.raises(GaveUp):
        floor.operator.place_robot("R1", others)
    with pytest.raises(InputError, match="no vertex is named 'N9'"):
        floor.operator.place_robot("R1", "N9")
    robot = floor.robots[0].robot
    old = robot.report_state().order_id
    assert robot.forget()
    robot.place = "N7"
    floor.send(floor.operator.place_robot("R1", "N7"))
    assert floor.said == []
    floor.hear(0, orderId=old, nodeStates=[{"nodeId": "N5", "sequenceId": 4, "released": True}])
    sentence = "it still has an order from before it was placed"
    assert floor.said == [f"R1 is faulty: {sentence}; a person has to look after it"]


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"orderId": "others"}, "it has order others, which is not ours"),
        ({"orderUpdateId": 99}, "it has update 99 of an order with"),
        (
            {"nodeStates": [{"nodeId": "N3", "sequenceId": 40, "released": True}]},
            "it drives to node 40, which was not released",
        ),
        ({"lastNodeId": "N7"}, "it is at N7, off its way"),
    ],
)
def test_a_robot_that_is_off_its_way(floor: Floor, changes: dict[str, Any], fault: str) -> None:
    """It is reported once; nobody gets the place that it names, until a person has looked."""
    for _ in range(4):
        floor.hear(0, **changes)
    assert len(floor.said) == 1
    assert fault in floor.said[0]
    released = floor.ledger.robots[0].released
    floor.drive(20)
    assert floor.ledger.robots[0].released == released
    floor.send(floor.operator.operate("clear", "R1"))
    assert floor.ends_well()


def test_states_that_are_doubled_old_or_wrong() -> None:
    """R1 sends each state twice, one of long ago with each, and each with one wrong field.

    Where a wrong field looks like a fault, a person confirms that the robot is where it is.
    """
    floor, earlier = Floor(), list[Letter]()
    wrong: list[dict[str, Any]] = [
        {"lastNodeSequenceId": 8},
        {"lastNodeId": "N2"},
        {"nodeStates": [], "edgeStates": []},
        {"orderId": ""},
        {"orderUpdateId": 0},
    ]
    for step in range(120):
        for robot in floor.robots:
            robot.robot.step()
            floor.deliver(floor.end.receive(robot.report_state()))
        earlier.append(floor.robots[0].report_state())
        for letter in (earlier[-1], earlier[step // 2]):
            floor.deliver(floor.end.receive(letter))
        if step % 2:
            floor.hear(0, **wrong[step // 2 % len(wrong)])
        floor.send(floor.dispatcher.control.remind())
        if floor.ledger.robots[0].fault:
            floor.send(floor.operator.operate("clear", "R1"))
        held = {*floor.ledger.robots[0].held} & {*floor.ledger.robots[1].held}
        assert not held
    assert floor.ends_well()


def fail_work(floor: Floor, patch: pytest.MonkeyPatch) -> str:
    """Have the work of R1 fail; return the job."""
    state, failed = floor.robots[0].robot.report_state, "run-0-job0-1"

    def fail(*arguments: Any) -> StateReport:
        said = state(*arguments)
        return replace(said, actions={**said.actions, failed: "FAILED"})

    patch.setattr(floor.robots[0].robot, "report_state", fail)
    floor.robots[0].robot._waiting.clear()
    floor.drive(3)
    return "R1/job0"


def test_work_that_fails_is_done_again(floor: Floor, monkeypatch: pytest.MonkeyPatch) -> None:
    name = fail_work(floor, monkeypatch)
    assert floor.said == ["R1 has failed in job0: it goes no further"]
    assert list_jobs(floor.dispatcher.ledger)[0]["state"] == "failed"
    floor.wait()
    assert floor.places == ["N1", "N0"]
    assert floor.done == [0, 1]
    floor.send(floor.operator.retry_job(name))
    assert floor.ends_well()
    with pytest.raises(InputError, match="'R1/job0' has not failed"):
        floor.operator.retry_job(name)


def test_failed_work_is_done_again_though_a_withdrawal_is_just_ending(
    floor: Floor, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The order of one node after the withdrawal, which has no failed work, is on its way."""
    name = fail_work(floor, monkeypatch)
    robot = floor.robots[0].robot
    [withdrawal] = floor.operator.operate("cancel", "R1")
    assert isinstance(withdrawal, InstantAction)
    robot.take_action(withdrawal)
    on_its_way = floor.dispatcher.control.receive(0, robot.report_state())
    floor.send([*floor.operator.retry_job(name), *on_its_way])
    assert floor.ends_well()


def test_work_that_fails_is_skipped(floor: Floor, monkeypatch: pytest.MonkeyPatch) -> None:
    floor.send(floor.operator.skip_job(fail_work(floor, monkeypatch)))
    floor.drive(80)
    assert floor.places == ["N5", "N0"]
    assert floor.done == [0, 1]
    assert [own.jobs_done for own in floor.ledger.robots] == [0, 1]


def test_an_order_that_is_refused(floor: Floor, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is sent again until the robot takes it, and the refusal is reported once."""
    refusal = RobotError(kind="orderUpdateError", level="WARNING", description="not now")
    floor.robots[0].condition = Condition(errors=(refusal,))
    monkeypatch.setattr(floor.robots[0].robot, "take_order", lambda _: False)
    floor.drive(30)
    assert floor.places[0] == "N1"
    assert floor.said == ["R1 reports WARNING orderUpdateError: not now"]
    assert not floor.ledger.robots[0].is_acknowledged
    monkeypatch.undo()
    floor.robots[0].condition = Condition()
    assert floor.ends_well()


def test_a_control_that_is_killed(floor: Floor) -> None:
    """The same orders are sent again, word for word; no robot does anything twice."""
    orders = [json.loads(one.payload) for one in floor.sent if one.name == "order"]
    count = len(orders)
    for _ in range(60):
        floor.kill()
        floor.drive(1)
    contents: dict[tuple[str, int], Any] = {}
    for letter in floor.sent:
        if letter.name == "order":
            document = json.loads(letter.payload)
            content = (document["nodes"], document["edges"])
            key = (document["orderId"], document["orderUpdateId"])
            assert contents.setdefault(key, content) == content
    assert len(contents) > count // 2
    assert floor.ends_well()


def test_a_journal_that_cannot_be_written() -> None:
    """Nothing is sent until it can, which is reported once; then robots get what was decided."""
    plan, said, published = door(), list[str](), list[str]()
    journal, names = MemoryJournal(), [robot.name for robot in door().scenario.robots]
    driver = Driver(
        plan, make_simulated_identities(names), journal, report=lambda fact: said.append(str(fact))
    )

    async def publish(topic: str, *_: Any, **__: Any) -> None:
        published.append(topic)

    client = cast(Any, SimpleNamespace(publish=publish))

    def fail() -> bool:
        raise JournalFailed("the disk is full")

    journal.kill = fail
    letters = driver.end.make_letters(driver.control.start())
    asyncio.run(driver._turn(client, letters))
    for _ in range(3):
        asyncio.run(driver._turn(client, []))
    assert published == []
    begins = "the journal cannot be written: the disk is full; nothing is sent until it can"
    assert said == [begins]
    journal.kill = lambda: False
    asyncio.run(driver._turn(client, []))
    assert len(published) == len(letters)
    about = [sentence for sentence in said if "journal" in sentence]
    assert about == [begins, "the journal can be written again"]


def test_commands_that_cannot_be_read_stop_no_robot(tmp_path: Path) -> None:
    """The control reports it once, and carries out commands once it can read them again."""
    plan, said = door(), list[str]()
    commands, people = Commands(tmp_path / "run.journal"), Commands(tmp_path / "run.journal")
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), plan)
    notices = Notices(
        [robot.name for robot in plan.scenario.robots], lambda fact: said.append(str(fact))
    )
    supervisor = Supervisor(dispatcher, notices, lambda: 0, commands)
    people.ask({"kind": "unknown"})
    supervisor.obey()
    said.clear()
    with closing(sqlite3.connect(tmp_path / "run.journal-commands")) as database:
        database.execute("ALTER TABLE commands RENAME TO lost")
        supervisor.answer()
        assert supervisor.obey() == []
        assert supervisor.obey() == []
        with pytest.raises(InputError, match="cannot be used for commands: no such table"):
            people.ask({"kind": "hold"})
        database.execute("ALTER TABLE lost RENAME TO commands")
    supervisor.obey()
    supervisor.answer()
    told = [line for line in said if "commands" in line]
    assert len(told) == 2
    assert told[0].startswith("no command can be read: ")
    assert told[0].endswith("; robots drive on")
    assert told[1] == "commands can be read again"
    assert people.wait_for(1, 0) is not None


def test_a_flood_of_states_fills_no_memory() -> None:
    """Of 10 000 states that come within a turn the latest is looked at, and those of others."""
    plan = door()
    names = [robot.name for robot in plan.scenario.robots]
    driver = Driver(plan, make_simulated_identities(names), MemoryJournal(), report=lambda _: None)
    topics = [topic for topic in driver.end.topics if topic.endswith("/state")]

    async def flood() -> AsyncIterator[Any]:
        for number in range(10_000):
            yield SimpleNamespace(topic=topics[0], payload=b"%d" % number)
            if number == 5_000:
                yield SimpleNamespace(topic=topics[1], payload=b"another")

    asyncio.run(driver._read(cast(Any, SimpleNamespace(messages=flood()))))
    waiting = [letter.payload for _, letter in driver._inbox.values()]
    assert waiting == [b"9999", b"another"]


def test_a_start_on_a_journal_ends_the_alarms_of_before() -> None:
    journal, names = MemoryJournal(), [robot.name for robot in door().scenario.robots]
    identities, said = make_simulated_identities(names), list[str]()
    for _ in range(2):
        driver = Driver(door(), identities, journal, report=lambda fact: said.append(str(fact)))
        driver._flush()
    told = [entry for entry in journal.written if entry["kind"] == "notice"]
    assert told == [make_notice(None, kind=EVERY_KIND, is_over=True)]


def test_a_robot_on_hold(floor: Floor) -> None:
    floor.send(floor.operator.operate("hold", "R1"))
    floor.wait()
    assert floor.places == ["N1", "N0"]
    assert floor.said == []
    floor.send(floor.operator.operate("go", "R1"))
    assert floor.ends_well()


@pytest.mark.parametrize("can_pause", [True, False])
def test_a_robot_that_is_stopped_pauses_if_its_factsheet_has_that(
    floor: Floor, can_pause: bool
) -> None:
    """Without startPause it drives to the end of its released nodes, as on hold."""
    if can_pause:
        floor.dispatcher.control.can_pause.add(1)
    before = floor.places[1]
    floor.send(floor.operator.operate("stop", "R2"))
    floor.wait()
    assert floor.robots[1].robot.is_paused == can_pause
    assert (floor.places[1] == before) == can_pause
    floor.send(floor.operator.operate("go", "R2"))
    floor.wait()
    assert not floor.robots[1].robot.is_paused
    assert floor.dispatcher.ledger.robots[1].pause is None
    assert floor.ends_well()


def test_a_robot_that_is_passed_no_longer_is_planned_with_again(
    floor: Floor, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The rest is replanned once when others begin to wait, and once when R1 is fit again."""
    replans = list[object]()
    plan_rest = floor.dispatcher._rest.plan

    def count(*arguments: Any) -> Any:
        replans.append(arguments[-1])
        return plan_rest(*arguments)

    monkeypatch.setattr(floor.dispatcher._rest, "plan", count)
    floor.robots[0].condition = TROUBLES["error"]
    floor.drive(1)
    floor.wait()
    floor.wait()
    floor.robots[0].condition = Condition()
    floor.drive(1)
    floor.wait()
    floor.wait()
    assert replans == [[0], []]
    assert floor.ends_well()


# --- the table ------------------------------------------------------------------------------------


TESTS = {
    "late, stopped": (
        "test_a_robot_that_is_late_or_stops",
        "test_a_robot_that_stands_on_a_free_way_has_an_alarm_until_it_moves",
        "test_rights_of_way_are_switched_where_robots_are_late",
    ),
    "in error, emergency stop, paused, in manual mode": (
        "test_a_robot_that_is_not_fit",
        "test_a_robot_that_is_passed_no_longer_is_planned_with_again",
    ),
    "lost: disconnected or silent": (
        "test_a_robot_that_is_lost_and_comes_back",
        "test_each_loss_of_a_robot_is_reported_also_by_silence",
    ),
    "the header of a message contradicts its topic": (
        "test_a_message_whose_header_contradicts_its_topic_is_not_used",
    ),
    "its position is far from its last node": (
        "test_a_robot_far_from_the_node_that_it_names_is_reported_until_it_is_there",
    ),
    "back without its order": ("test_a_robot_that_forgets_its_order",),
    "back at another position": (
        "test_a_robot_that_is_elsewhere_when_it_comes_back",
        "test_a_robot_is_placed_where_nobody_is_and_not_with_an_old_order",
    ),
    "off its route, with the order of another control": ("test_a_robot_that_is_off_its_way",),
    "states doubled, old, with a wrong field": (
        "test_states_that_are_doubled_old_or_wrong",
        "test_broken_states_do_no_harm_and_are_reported_once",
    ),
    "action FAILED or RETRIABLE": (
        "test_work_that_fails_is_done_again",
        "test_failed_work_is_done_again_though_a_withdrawal_is_just_ending",
        "test_an_action_that_fails_is_sent_again_without_those_that_are_done",
        "test_work_that_fails_is_skipped",
    ),
    "order or action rejected": ("test_an_order_that_is_refused",),
    "cancelled its order because a withdrawal came late": (
        "test_a_withdrawal_that_comes_after_the_next_order_costs_one_more_order",
    ),
    "broker lost": ("test_control_and_broker_are_killed_and_everything_goes_on",),
    "control killed": (
        "test_a_control_that_is_killed",
        "test_a_start_on_a_journal_ends_the_alarms_of_before",
        "test_control_and_broker_are_killed_and_everything_goes_on",
    ),
    "states arrive faster than the control reads them": ("test_a_flood_of_states_fills_no_memory",),
    "journal cannot be written, for example on a full disk": (
        "test_a_journal_that_cannot_be_written",
    ),
    "file of commands cannot be read or written": (
        "test_commands_that_cannot_be_read_stop_no_robot",
    ),
    "lane closed (`close --to`)": (
        "test_robots_drive_round_what_is_closed",
        "test_a_closed_lane_is_closed_with_its_pieces",
    ),
    "vertex closed (`close`)": (
        "test_what_is_closed_can_be_left",
        "test_a_robot_whose_work_is_closed_waits_and_the_others_go_on",
        "test_laps_are_driven_round_what_is_closed",
    ),
    "no new plan found": ("test_replanning_that_fails_is_reported_once_until_it_succeeds",),
    "on hold (`hold R1`)": ("test_a_robot_on_hold",),
    "all on hold (`hold`)": ("test_all_robots_are_held_and_let_go",),
    "all stopped (`stop`)": (
        "test_a_robot_that_is_stopped_pauses_if_its_factsheet_has_that",
        "test_all_robots_stop_at_once_where_they_are_and_go_on",
    ),
    "battery too low for the way to a charging place": (
        "test_a_robot_that_reaches_no_charging_place_has_an_alarm_and_gets_no_more",
    ),
    "a round of jobs finds no plan": (
        "test_the_old_plan_goes_on_where_a_round_finds_none_and_this_is_reported_once",
    ),
    "a job that no robot can do": ("test_a_job_that_no_robot_can_do_is_reported_once",),
    "removed from the map (`remove`)": ("test_a_robot_taken_off_the_floor_is_in_nobodys_way",),
}
"""The tests of each case of the page."""


def list_cases() -> list[str]:
    """Return the first cells of the table of the page, without its head."""
    page = (ROOT / "docs/failures.md").read_text(encoding="utf-8")
    section = page.partition("## Failures\n")[2].partition("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("| ")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]
    assert all(len(row) == 4 for row in rows)
    return [row[0] for row in rows]


def names_of_tests(path: Path) -> list[str]:
    """Return the names of the tests of a file."""
    nodes = ast.parse(path.read_text(encoding="utf-8")).body
    names = (node.name for node in nodes if isinstance(node, ast.FunctionDef))
    return [name for name in names if name.startswith("test_")]


def test_each_case_of_the_page_has_its_tests() -> None:
    """And each test of this file has its case."""
    files = (ROOT / "tests/control").glob("test_*.py")
    known = {name for path in files for name in names_of_tests(path)}
    assert list_cases() == list(TESTS)
    named = {name for names in TESTS.values() for name in names}
    assert named <= known
    own = {*names_of_tests(Path(__file__))} - {"test_each_case_of_the_page_has_its_tests"}
    assert own <= named
