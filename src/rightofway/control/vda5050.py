"""Messages of VDA 5050 (2.0, 2.1 and 3.0): orders and instant actions written, states read.

A message that is written has the keys that all three versions ask for. A state that is read may
have more keys than are looked at; one that lacks a key that counts is refused with its place.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from rightofway.control.messages import Message, Order, RobotState
from rightofway.errors import InputError, shown

__all__ = ["VERSIONS", "Header", "read_state", "written"]

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
            edgeId=f"{tail.nodeId}-{head_.nodeId}",
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
    try:
        state = _State.model_validate(document)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join(map(str, ("state", *first["loc"])))
        message = f"{first['msg'].lower()}: {shown(first['input'])} (the robot has to send it)"
        raise InputError.at(place, message) from error
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
