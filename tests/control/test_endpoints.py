"""The end of the control: what it takes from messages of robots, and what it says of them."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway.control import FleetControl, Order, SimulatedRobot
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.identities import VERSIONS, Identity
from rightofway.control.notices import Notices
from rightofway.control.order_map import make_order_maps
from rightofway.control.routes import make_routes_to_drive
from rightofway.model import Plan
from rightofway.precedence import ReleaseGraph
from tests.builders.chaos import MemoryJournal
from tests.builders.plans import door
from tests.builders.schemas import validator
from tests.campaigns.states import fuzz_states

NOW = "2026-01-31T12:00:00.000Z"


class Site:
    """The door with both ends of its wires, and what is said of its robots."""

    def __init__(self, plan: Plan | None = None, version: str = "2.1.0") -> None:
        plan = plan or door()
        self.said: list[str] = []
        self.time = 0.0
        names = [robot.name for robot in plan.scenario.robots]
        notices = Notices(names, self.said.append, lambda: self.time)
        self.control = FleetControl(MemoryJournal(), report=notices.report_on)
        routes = make_routes_to_drive(plan)
        self.control.begin("run", routes, ReleaseGraph.of(plan.scenario, plan.tracks))
        self.identities = [
            Identity(manufacturer="maker", serial_number=name, version=version) for name in names
        ]
        maps = make_order_maps(plan.scenario, self.identities)
        self.end = ControlEnd(self.control, maps, lambda: NOW, notices)
        self.robots = [
            RobotEnd(SimulatedRobot(route.places[0]), k, self.identities[k], lambda: NOW)
            for k, route in enumerate(routes)
        ]
        self.deliver(self.end.make_letters(self.control.start()))

    def deliver(self, letters: list[Letter]) -> None:
        """Bring letters to robots, and nothing back."""
        for letter in letters:
            for robot in self.robots:
                if letter.topic in robot.topics:
                    robot.receive(letter)

    def say(self, robot: int, **changes: Any) -> None:
        """Let a robot send its state with changes, and deliver what is answered."""
        letter = self.robots[robot].report_state()
        document = {**json.loads(letter.payload), **changes}
        self.deliver(self.end.receive(Letter(letter.topic, json.dumps(document).encode())))

    def send(self, robot: int, name: str, document: Any) -> None:
        """Let a robot send a message."""
        topic = self.identities[robot].get_topic(name)
        self.end.receive(Letter(topic, json.dumps(document).encode()))

    @property
    def released(self) -> list[int]:
        """The last released part of each robot."""
        return [own.released for own in self.control.ledger.robots]


UNFIT: dict[str, tuple[dict[str, Any], str]] = {
    "mode": (
        {"operatingMode": "MANUAL"},
        "R2 is in mode MANUAL: it gets nothing more until it is in AUTOMATIC again",
    ),
    "pause": ({"paused": True}, "R2 is paused: it gets nothing more until it goes on"),
    "stop": (
        {"safetyState": {"eStop": "REMOTE", "fieldViolation": False}},
        "R2 is in emergency stop (REMOTE): a person has to look",
    ),
    "error": (
        {"errors": [{"errorType": "laser", "errorLevel": "FATAL", "errorDescription": "dirty"}]},
        "R2 reports FATAL laser: dirty",
    ),
}


@pytest.mark.parametrize("trouble", UNFIT)
def test_a_robot_that_is_not_fit_gets_nothing_more_until_it_is(trouble: str) -> None:
    """It is reported once, however often the robot says so."""
    site = Site()
    changes, sentence = UNFIT[trouble]
    for _ in range(5):
        site.say(1, **changes)
    assert site.released == [0, 0]
    assert site.said == [sentence]
    site.say(1)
    assert site.released[1] > 0


def test_an_error_that_does_no_harm_is_reported_and_holds_nothing_back() -> None:
    site = Site()
    warning = {"errorType": "battery", "errorLevel": "WARNING"}
    site.say(1, errors=[warning])
    site.say(1, errors=[warning, {**warning, "errorType": "wheel"}])
    assert site.said == ["R2 reports WARNING battery", "R2 reports WARNING wheel"]
    assert site.released[1] > 0


def test_trouble_that_comes_and_goes_is_reported_again_after_a_while() -> None:
    site = Site()
    for _ in range(20):
        site.say(1, paused=True)
        site.say(1, paused=False)
    assert site.said == [
        "R2 is paused: it gets nothing more until it goes on",
        "R2 is paused no longer",
    ]
    site.time = 1000.0
    site.say(1, paused=True)
    assert len(site.said) == 3


def test_a_robot_may_not_make_up_trouble_without_end() -> None:
    site = Site()
    for number in range(1000):
        site.say(1, errors=[{"errorType": f"kind {number}", "errorLevel": "WARNING"}])
    assert len(site.said) == 51
    assert site.said[-1] == "R2 reports further kinds of trouble, which are left out here"


def test_a_robot_that_asks_for_more_gets_more() -> None:
    """R2 may go to its end: 2 stops there, so what is ahead is at most 4 parts, or 8."""
    usual, more = Site(), Site()
    usual.control._look_ahead = more.control._look_ahead = 1
    usual.say(1)
    more.say(1, newBaseRequest=True)
    assert (usual.released[1], more.released[1]) == (1, 2)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_robot_that_is_lost_keeps_what_it_holds_and_gets_nothing_more(version: str) -> None:
    site = Site(version=version)
    broken = "CONNECTION_BROKEN" if version == "3.0.0" else "CONNECTIONBROKEN"
    for _ in range(3):
        site.send(1, "connection", {"connectionState": broken})
    assert site.said == ["R2 is not connected: it keeps what it holds and gets nothing more"]
    assert site.control.lost == {1}
    site.send(1, "connection", {"connectionState": "ONLINE"})
    site.say(1)
    assert site.said[1:] == ["R2 is connected again"]
    assert site.released[1] > 0


def sheet(speed: float, length: float, width: float) -> dict[str, Any]:
    """Return a factsheet of version 2.1."""
    return {"physicalParameters": {"speedMax": speed, "length": length, "width": width}}


def test_a_slow_robot_is_reported() -> None:
    site = Site()
    for _ in range(2):
        site.send(0, "factsheet", sheet(0.5, 9, 9))
    assert site.said == ["R1 drives at most 0.5 m/s, and the plan takes 1 m/s: it will be late"]
    site.say(0)
    assert not site.control.refused


def test_a_robot_that_is_larger_than_planned_gets_nothing() -> None:
    """A robot of 0.8 m by 0.6 m reaches 0.5 m round its centre."""
    plan = door()
    robots = tuple(replace(robot, radius=Fraction(2, 5)) for robot in plan.scenario.robots)
    rules = replace(plan.scenario.rules, occupancy="both")
    sized = replace(plan, scenario=replace(plan.scenario, robots=robots, rules=rules))
    site = Site(sized)
    site.send(1, "factsheet", sheet(2, 0.8, 0.6))
    size = "R2 is 0.8 m long and 0.6 m wide, and the plan takes a radius of 0.4 m"
    assert site.said == [f"{size}: it gets nothing more (plan with a radius of 0.5 m)"]
    site.say(1)
    assert site.released[1] == 0


@pytest.mark.parametrize("version", VERSIONS)
def test_a_simulated_robot_answers_with_its_factsheet(version: str) -> None:
    site = Site(version=version)
    [asked, _] = site.end.ask_for_factsheets()
    validator(version, "instantActions").validate(json.loads(asked.payload))
    [answer] = site.robots[0].receive(asked)
    if version != "2.0.0":  # its schema of factsheets describes no object
        validator(version, "factsheet").validate(json.loads(answer.payload))
    site.end.receive(answer)
    assert site.said == []


def test_a_robot_learns_its_lanes_from_orders() -> None:
    site = Site()
    site.say(1)
    robot = site.robots[1]
    tail, head = robot.robot.place, robot.robot.ahead[0].place
    lane = robot.lanes[tail, head]
    assert (lane.length, lane.max_speed) == (1.0, 1.0)


def test_a_broken_state_proves_nothing_and_is_reported_once() -> None:
    site = Site()
    broken = (b"{", b"{", b"[]", b"{}", b"\xff", b'{"orderId": 1}', b"[" * 100_000)
    for payload in broken:
        assert site.end.receive(Letter("uagv/v2/maker/R2/state", payload)) == []
    assert all(sentence.startswith("R2 sent what cannot be read: ") for sentence in site.said)
    assert len(site.said) == 2  # no JSON, and no order
    assert site.control.ledger.arrived == [0, 0]


def test_broken_states_do_no_harm_and_are_reported_once() -> None:
    """A few hundred; `just fuzz-states 100000` sends more."""
    assert fuzz_states(300, 1)


@pytest.mark.parametrize(
    ("key", "value"), [("serial_number", "a/b"), ("manufacturer", ""), ("version", "1.1")]
)
def test_an_identity_that_cannot_be_a_topic_is_refused(key: str, value: str) -> None:
    with pytest.raises(ValueError, match=f"^{key}: "):
        Identity(**{"manufacturer": "maker", "serial_number": "R1", key: value})  # type: ignore[arg-type]


def test_orders_say_nothing_else_than_the_journal() -> None:
    """What is sent again is the same, word for word, but for its head."""
    site = Site()
    orders = [m for m in site.control.remind() if isinstance(m, Order)]
    first, again = (
        [json.loads(letter.payload) for letter in site.end.make_letters(orders)] for _ in range(2)
    )
    for one, other in zip(first, again, strict=True):
        assert {**one, "headerId": 0} == {**other, "headerId": 0}
