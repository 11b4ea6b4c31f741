"""Messages of the norm: all that is sent is valid by the official schemas, and states are read."""

from __future__ import annotations

from typing import Any

import pytest

from rightofway.control import FleetControl, InstantAction, Message, Order, SimulatedRobot
from rightofway.control.routes import routes_to_drive
from rightofway.control.vda5050 import VERSIONS, Header, read_state, written
from rightofway.errors import InputError
from rightofway.precedence import ReleaseGraph
from tests.builders.chaos import MemoryJournal
from tests.builders.plans import door
from tests.builders.schemas import validator


def header(version: str) -> Header:
    """Return the head of a message."""
    return Header(
        headerId=1,
        timestamp="2026-01-31T12:00:00.000Z",
        version=version,  # type: ignore[arg-type]
        manufacturer="maker",
        serialNumber="R1",
    )


def all_sent() -> list[Message]:
    """Return all that is sent to the robots of the door, with a withdrawal on the way."""
    plan = door()
    control, sent = FleetControl(MemoryJournal()), list[Message]()
    control.begin("run", routes_to_drive(plan), ReleaseGraph.of(plan.scenario, plan.tracks))
    robots = [SimulatedRobot(route.places[0]) for route in routes_to_drive(plan)]
    fresh = control.start()
    for number in range(300):
        sent += fresh
        for message in fresh:
            robot = robots[message.robot]
            if isinstance(message, Order):
                robot.take_order(message)
            else:
                robot.take_action(message)
        fresh = control.cancel(1) if number == 5 else control.remind()
        for k, robot in enumerate(robots):
            robot.step()
            fresh += control.receive(k, robot.state())
    assert [robot.place for robot in robots] == ["N0", "N2"]
    return sent


@pytest.mark.parametrize("version", VERSIONS)
def test_every_message_is_valid_by_the_official_schemas(version: str) -> None:
    orders, actions = validator(version, "order"), validator(version, "instantActions")
    sent = all_sent()
    assert {type(message) for message in sent} == {Order, InstantAction}
    for message in sent:
        schema = orders if isinstance(message, Order) else actions
        schema.validate(written(message, header(version)))


def test_work_at_a_stop_is_an_action_that_nothing_else_happens_beside() -> None:
    document = next(
        written(message, header("2.1.0"))
        for message in all_sent()
        if isinstance(message, Order) and message.nodes[-1].actions
    )
    action = document["nodes"][-1]["actions"][0]
    assert action["blockingType"] == "HARD"
    edges = [(edge["sequenceId"], edge["released"]) for edge in document["edges"]]
    assert edges == [(node["sequenceId"] - 1, True) for node in document["nodes"][1:]]


STATE: dict[str, Any] = {
    "orderId": "run-0-0",
    "orderUpdateId": 1,
    "lastNodeId": "N0",
    "lastNodeSequenceId": 0,
    "nodeStates": [{"nodeId": "N1", "sequenceId": 2, "released": True}],
    "edgeStates": [{"edgeId": "N0-N1", "sequenceId": 1, "released": True}],
    "actionStates": [{"actionId": "a", "actionStatus": "RUNNING"}],
    "instantActionStates": [{"actionId": "token", "actionStatus": "FINISHED"}],
    "driving": True,
    "batteryState": {"batteryCharge": 80, "charging": False},
}


def test_a_state_is_read_with_its_instant_actions() -> None:
    """Version 3.0 has instant actions in a list of their own."""
    state = read_state(STATE)
    assert (state.order_id, state.update_id, state.last_place) == ("run-0-0", 1, "N0")
    assert (state.nodes, state.edges, state.is_driving) == ((2,), (1,), True)
    assert state.actions == {"a": "RUNNING", "token": "FINISHED"}


@pytest.mark.parametrize(
    ("key", "value", "place"),
    [
        ("orderUpdateId", -1, "state.orderUpdateId"),
        ("lastNodeSequenceId", "2", "state.lastNodeSequenceId"),
        ("nodeStates", [{"nodeId": "N1"}], r"state.nodeStates.0.sequenceId"),
        ("driving", None, "state.driving"),
    ],
)
def test_a_broken_state_is_refused_with_its_place(key: str, value: object, place: str) -> None:
    with pytest.raises(InputError, match=place):
        read_state({**STATE, key: value})
