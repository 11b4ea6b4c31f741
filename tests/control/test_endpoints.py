"""The end of the control: what it takes from messages of robots, and what it says of them."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from rightofway.control import Order
from rightofway.control.endpoints import Letter
from rightofway.control.identities import VERSIONS, Identity
from rightofway.facts import Fact
from tests.builders.plans import door
from tests.builders.schemas import validator
from tests.builders.sites import Site
from tests.campaigns.states import fuzz_states

UNFIT: dict[str, tuple[dict[str, Any], str]] = {
    "mode": (
        {"operatingMode": "MANUAL"},
        "R2 is in mode MANUAL: no further nodes are released until it is in AUTOMATIC again",
    ),
    "pause": ({"paused": True}, "R2 is paused: no further nodes are released until the pause ends"),
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


def test_each_begin_and_each_end_of_trouble_is_reported() -> None:
    site = Site()
    for _ in range(20):
        site.say(1, paused=True)
        site.say(1, paused=True)
        site.say(1, paused=False)
    assert site.said == 20 * [
        "R2 is paused: no further nodes are released until the pause ends",
        "R2 is paused no longer",
    ]


def test_each_loss_of_a_robot_is_reported_also_by_silence() -> None:
    """Whatever brings it back: its connection, or a state."""
    site = Site()
    for number in range(15):
        site.send(1, "connection", {"connectionState": "CONNECTIONBROKEN"})
        site.end.connect(1, is_connected=False, why=Fact("silent", seconds=35.0))
        if number % 2:
            site.send(1, "connection", {"connectionState": "ONLINE"})
        site.say(1)
    assert site.said == 15 * [
        "R2 is not connected: it keeps its released nodes and gets no further ones",
        "R2 is connected again",
    ]


def test_a_robot_may_not_make_up_trouble_without_end() -> None:
    """Of kinds that follow each other 100 sentences are reported, of one state 50 kinds."""
    site = Site()
    for number in range(1000):
        site.say(1, errors=[{"errorType": f"kind {number}", "errorLevel": "WARNING"}])
    assert len(site.said) == 101
    assert site.said[-1] == "R2 has trouble that begins and ends too often: it is reported in part"
    more = Site()
    kinds = [{"errorType": f"kind {number}", "errorLevel": "WARNING"} for number in range(1000)]
    more.say(1, errors=kinds)
    assert len(more.said) == 51
    assert more.said[-1] == "R2 reports further kinds of trouble, which are left out here"
    more.say(1, errors=kinds[:1])
    assert more.said[51:-1] == [
        f"R2 no longer reports WARNING kind {number}" for number in range(1, 50)
    ]


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
    assert site.said == [
        "R2 is not connected: it keeps its released nodes and gets no further ones"
    ]
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
        document, official = json.loads(answer.payload), validator(version, "factsheet")
        official.validate(document)
        # The schema of the tag 3.0.0 requires a key that it does not describe.
        schema: Any = official.schema
        required = schema["properties"]["typeSpecification"]["required"]
        as_in_tag = {key.replace("Kinematics", "Kinematic") for key in required}
        assert as_in_tag <= document["typeSpecification"].keys()
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
    assert all(
        sentence.startswith("R2 sent a message that is not used: ") for sentence in site.said
    )
    assert len(site.said) == 1
    assert site.control.ledger.arrived == [0, 0]


def test_broken_states_do_no_harm_and_are_reported_once() -> None:
    """A few hundred; `just fuzz-states 100000` sends more."""
    assert fuzz_states(300, 1)


@pytest.mark.parametrize("digits", ["9" * 4301, "1-" + "9" * 10_000, "0" * 5000, "²", "٣"])
def test_an_order_of_any_length_is_one_of_others(digits: str) -> None:
    """Python refuses to read a number of more than 4300 digits."""
    site = Site()
    site.say(0)
    for _ in range(3):
        site.say(0, orderId=f"run-0-{digits}")
    assert len(site.said) == 1
    assert site.said[0].startswith("R1 is faulty: it has order run-0-")
    site.say(1)
    assert site.released[1] > 0


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


CONTRADICTIONS = {"serialNumber": "R9", "manufacturer": "others", "version": "3.0.0"}


@pytest.mark.parametrize("key", CONTRADICTIONS)
@pytest.mark.parametrize("name", ["state", "connection", "factsheet"])
def test_a_message_whose_header_contradicts_its_topic_is_not_used(key: str, name: str) -> None:
    site = Site()
    site.send(1, "connection", {"connectionState": "CONNECTIONBROKEN"})
    documents = {
        "state": json.loads(site.robots[1].report_state().payload),
        "connection": {"connectionState": "ONLINE"},
        "factsheet": sheet(0.1, 9, 9),
    }
    before = len(site.said)
    site.send(1, name, {**documents[name], key: CONTRADICTIONS[key]})
    [sentence] = site.said[before:]
    assert f"{name}.{key}: '{CONTRADICTIONS[key]}' contradicts the topic" in sentence
    assert site.control.lost == {1}
    assert site.end.take_heard() == set()
    site.say(1)
    assert site.released[1] > 0
    assert site.end.take_heard() == {1}


def test_a_robot_far_from_the_node_that_it_names_is_reported_until_it_is_there() -> None:
    """R2 is at N2, at (2.5, -0.5), and may be 1 m away as it has no deviation."""
    site = Site()
    position = {"x": 2.5, "y": -0.5, "mapId": "map", "positionInitialized": True}
    site.say(1, agvPosition=position)
    assert site.said == []
    for x in (18.5, 18.5, 3.6):
        site.say(1, nodeStates=[], edgeStates=[], driving=False, agvPosition={**position, "x": x})
    begin = "R2 reports a position 16 m from N2, its last node: at most 1 m fit (look where it is)"
    assert site.said == [begin]
    site.say(1, nodeStates=[], edgeStates=[], driving=False, agvPosition={**position, "x": 3.4})
    assert site.said == [begin, "R2 is near its last node again"]


@pytest.mark.parametrize(
    "position",
    [
        None,
        {},
        {"x": 99.0, "y": 0.0, "mapId": "another"},
        {"x": 99.0, "y": 0.0, "mapId": "map", "positionInitialized": False},
        {"x": float("nan"), "y": 0.0, "mapId": "map"},
        {"x": "far", "y": 0.0, "mapId": "map"},
        [1, 2],
    ],
)
def test_a_position_that_nobody_can_compare_is_none(position: Any) -> None:
    site = Site()
    site.say(1, agvPosition=position)
    assert site.said == []
    assert site.released[1] > 0


@pytest.mark.parametrize(("along", "is_reported"), [(0.0, False), (1.9, False), (2.1, True)])
def test_a_robot_between_two_nodes_may_be_as_far_as_the_lane_is_long(
    along: float, is_reported: bool
) -> None:
    """The lane from N2 is 1 m long."""
    site = Site()
    site.say(1)
    position = {"x": 2.5 - along, "y": -0.5, "mapId": "map"}
    site.say(1, driving=True, agvPosition=position)
    assert bool(site.said) == is_reported
