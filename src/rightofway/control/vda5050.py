"""Messages of VDA 5050 (2.0, 2.1 and 3.0), written and read.

Control writes orders and instant actions and reads states; simulated robots do the reverse. A
message that is read may have more keys than are looked at; one that lacks a key that counts is
refused with its place.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from rightofway.control.messages import InstantAction, Message, Order, OrderNode, RobotState
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.errors import InputError, shown

__all__ = [
    "VERSIONS",
    "Header",
    "read_instant_actions",
    "read_order",
    "read_state",
    "written",
    "written_state",
]

VERSIONS = ("2.0.0", "2.1.0", "3.0.0")
"""Versions of the norm that a robot may speak."""

JOB = "rightofway.job"
"""The type of the action at a stop."""

Sequence = Annotated[int, Field(ge=0, le=2**32 - 1)]


class _Written(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Header(_Written):
    """The head of each message.

    Attributes
    ----------
    headerId
        Counts the messages of a topic.
    timestamp
        ISO 8601, UTC, as ``2026-01-31T12:00:00.000Z``.
    version
        Of the norm.
    manufacturer, serialNumber
        The robot.
    """

    headerId: Annotated[int, Field(ge=0)]  # noqa: N815 (the norm's names)
    timestamp: str
    version: Literal["2.0.0", "2.1.0", "3.0.0"]
    manufacturer: str
    serialNumber: str  # noqa: N815


class _Action(_Written):
    actionId: str  # noqa: N815
    actionType: str  # noqa: N815
    blockingType: Literal["NONE", "HARD"]  # noqa: N815
    # The schema of instant actions of 2.0 asks for the type under another name than its text.
    actionName: str | None = None  # noqa: N815


class _Node(_Written):
    nodeId: str  # noqa: N815
    sequenceId: Sequence  # noqa: N815
    released: bool
    actions: tuple[_Action, ...]


class _Edge(_Written):
    edgeId: str  # noqa: N815
    sequenceId: Sequence  # noqa: N815
    released: bool
    startNodeId: str  # noqa: N815
    endNodeId: str  # noqa: N815
    actions: tuple[_Action, ...] = ()


class _OrderMessage(Header):
    orderId: str  # noqa: N815
    orderUpdateId: Sequence  # noqa: N815
    nodes: tuple[_Node, ...]
    edges: tuple[_Edge, ...]


class _InstantActions(Header):
    actions: tuple[_Action, ...]


def _edge_id(tail: str, head: str) -> str:
    return f"{tail}-{head}"


def written(message: Message, header: Header) -> dict[str, Any]:
    """Return a message as JSON has it.

    Parameters
    ----------
    message
        An order, an update or an instant action.
    header
        The head of the message.
    """
    head = header.model_dump()
    if not isinstance(message, Order):
        action = _Action(
            actionId=message.action_id,
            actionType=message.kind,
            blockingType="NONE",
            actionName=message.kind if header.version == "2.0.0" else None,
        )
        actions = _InstantActions(**head, actions=(action,))
        return actions.model_dump(mode="json", exclude_none=True)
    nodes = tuple(
        _Node(
            nodeId=node.place,
            sequenceId=node.sequence_id,
            released=True,
            actions=tuple(
                _Action(actionId=action, actionType=JOB, blockingType="HARD")
                for action in node.actions
            ),
        )
        for node in message.nodes
    )
    edges = tuple(
        _Edge(
            edgeId=_edge_id(tail.nodeId, head_.nodeId),
            sequenceId=head_.sequenceId - 1,
            released=True,
            startNodeId=tail.nodeId,
            endNodeId=head_.nodeId,
        )
        for tail, head_ in pairwise(nodes)
    )
    order = _OrderMessage(
        **head,
        orderId=message.order_id,
        orderUpdateId=message.update_id,
        nodes=nodes,
        edges=edges,
    )
    return order.model_dump(mode="json", exclude_none=True)


def written_state(robot: SimulatedRobot, header: Header) -> dict[str, Any]:
    """Return the state of a simulated robot as JSON has it.

    Parameters
    ----------
    robot
        The robot.
    header
        The head of the message.
    """
    state = robot.state()
    places = [node.place for node in robot.ahead]
    actions, instant = list[_ActionState](), list[_ActionState]()
    is_new = header.version >= "3"
    for action_id, status in state.actions.items():
        is_apart = is_new and action_id in robot.instant_actions
        kept = instant if is_apart else actions
        kept.append(_ActionState(actionId=action_id, actionStatus=status))
    power = {"stateOfCharge" if is_new else "batteryCharge": 100.0, "charging": False}
    emergency = "activeEmergencyStop" if is_new else "eStop"
    message = _WrittenState(
        **header.model_dump(),
        orderId=state.order_id,
        orderUpdateId=state.update_id,
        lastNodeId=state.last_place,
        lastNodeSequenceId=state.last_sequence_id,
        nodeStates=tuple(
            _NodeState(nodeId=place, sequenceId=number)
            for place, number in zip(places, state.nodes, strict=True)
        ),
        edgeStates=tuple(
            _EdgeState(edgeId=_edge_id(tail, head), sequenceId=number)
            for (tail, head), number in zip(
                pairwise((state.last_place, *places)), state.edges, strict=True
            )
        ),
        actionStates=tuple(actions),
        instantActionStates=tuple(instant) if is_new else None,
        driving=state.is_driving,
        powerSupply=power if is_new else None,
        batteryState=None if is_new else power,
        safetyState={emergency: "NONE", "fieldViolation": False},
    )
    return message.model_dump(mode="json", exclude_none=True)


class _Read(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True, strict=True)


class _Ahead(_Read):
    sequenceId: Sequence  # noqa: N815


class _ActionState(_Read):
    actionId: str  # noqa: N815
    actionStatus: str  # noqa: N815


class _State(_Read):
    orderId: str  # noqa: N815
    orderUpdateId: Sequence  # noqa: N815
    lastNodeId: str  # noqa: N815
    lastNodeSequenceId: Sequence  # noqa: N815
    nodeStates: list[_Ahead]  # noqa: N815
    edgeStates: list[_Ahead]  # noqa: N815
    actionStates: list[_ActionState]  # noqa: N815
    instantActionStates: list[_ActionState] = []  # noqa: N815 (3.0 keeps them apart)
    driving: bool


class _NodeState(_Written):
    nodeId: str  # noqa: N815
    sequenceId: Sequence  # noqa: N815
    released: Literal[True] = True


class _EdgeState(_Written):
    edgeId: str  # noqa: N815
    sequenceId: Sequence  # noqa: N815
    released: Literal[True] = True


class _WrittenState(Header):
    orderId: str  # noqa: N815
    orderUpdateId: Sequence  # noqa: N815
    lastNodeId: str  # noqa: N815
    lastNodeSequenceId: Sequence  # noqa: N815
    nodeStates: tuple[_NodeState, ...]  # noqa: N815
    edgeStates: tuple[_EdgeState, ...]  # noqa: N815
    actionStates: tuple[_ActionState, ...]  # noqa: N815
    instantActionStates: tuple[_ActionState, ...] | None  # noqa: N815
    driving: bool
    powerSupply: dict[str, float | bool] | None  # noqa: N815
    batteryState: dict[str, float | bool] | None  # noqa: N815
    operatingMode: Literal["AUTOMATIC"] = "AUTOMATIC"  # noqa: N815
    errors: tuple[()] = ()
    safetyState: dict[str, str | bool]  # noqa: N815


class _ReadAction(_Read):
    actionId: str  # noqa: N815
    actionType: str  # noqa: N815


class _ReadNode(_Read):
    nodeId: str  # noqa: N815
    sequenceId: Sequence  # noqa: N815
    released: bool
    actions: list[_ReadAction]


class _ReadOrder(_Read):
    orderId: str  # noqa: N815
    orderUpdateId: Sequence  # noqa: N815
    nodes: Annotated[list[_ReadNode], Field(min_length=1)]


class _ReadInstantAction(_Read):
    actionId: str  # noqa: N815
    actionType: Literal["stateRequest", "cancelOrder"]  # noqa: N815


class _ReadInstantActions(_Read):
    actions: list[_ReadInstantAction]


_Model = TypeVar("_Model", bound=_Read)


def _read(model: type[_Model], document: Mapping[str, Any], name: str) -> _Model:
    """Return a message that has all keys that count, or refuse it with the place of the fault."""
    try:
        return model.model_validate(document)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join(map(str, (name, *first["loc"])))
        message = f"{first['msg'].lower()}: {shown(first['input'])} (the sender has to send it)"
        raise InputError.at(place, message) from error


def read_order(document: Mapping[str, Any], robot: int) -> Order:
    """Return the released part of an order that a simulated robot is sent.

    Parameters
    ----------
    document
        The message as JSON has it, of any of `VERSIONS`.
    robot
        The robot that it was sent to.

    Raises
    ------
    InputError
        If a key that counts is missing or has a wrong value; the place says which.
    """
    order = _read(_ReadOrder, document, "order")
    nodes = tuple(
        OrderNode(
            place=node.nodeId,
            sequence_id=node.sequenceId,
            actions=tuple(action.actionId for action in node.actions),
        )
        for node in order.nodes
        if node.released
    )
    return Order(robot=robot, order_id=order.orderId, update_id=order.orderUpdateId, nodes=nodes)


def read_instant_actions(document: Mapping[str, Any], robot: int) -> tuple[InstantAction, ...]:
    """Return the instant actions that a simulated robot is sent.

    Parameters
    ----------
    document
        The message as JSON has it, of any of `VERSIONS`.
    robot
        The robot that it was sent to.

    Raises
    ------
    InputError
        If a key that counts is missing or has a wrong value; the place says which.
    """
    actions = _read(_ReadInstantActions, document, "instantActions").actions
    return tuple(
        InstantAction(robot=robot, action_id=action.actionId, kind=action.actionType)
        for action in actions
    )


def read_state(document: Mapping[str, Any]) -> RobotState:
    """Return the state that a robot has sent.

    Parameters
    ----------
    document
        The message as JSON has it, of any of `VERSIONS`.

    Raises
    ------
    InputError
        If a key that counts is missing or has a wrong value; the place says which.
    """
    state = _read(_State, document, "state")
    actions = (*state.actionStates, *state.instantActionStates)
    return RobotState(
        order_id=state.orderId,
        update_id=state.orderUpdateId,
        last_place=state.lastNodeId,
        last_sequence_id=state.lastNodeSequenceId,
        nodes=tuple(node.sequenceId for node in state.nodeStates),
        edges=tuple(edge.sequenceId for edge in state.edgeStates),
        actions={action.actionId: action.actionStatus for action in actions},
        is_driving=state.driving,
    )
