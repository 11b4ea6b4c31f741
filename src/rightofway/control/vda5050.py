"""Messages of VDA 5050 (2.0, 2.1 and 3.0), written and read.

There is one model for each kind of message, in both directions, with the names of version 2.1.
`written` gives keys and values the names of another version; a reader takes both. A message that is
read may have more keys than are looked at; one that lacks a key that counts is refused with its
place.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from itertools import pairwise
from math import isfinite
from typing import Annotated, Any, Literal, TypeVar

from pydantic import AliasChoices, BaseModel, ConfigDict, Field, ValidationError

from rightofway.control.identities import Identity
from rightofway.control.messages import (
    Condition,
    InstantAction,
    Load,
    Order,
    OrderNode,
    RobotError,
    StateReport,
)
from rightofway.control.order_map import OrderLane, OrderMap, Place
from rightofway.control.stop_actions import ActionToDo
from rightofway.errors import InputError, InputFault, quote
from rightofway.model.actions import thaw_value

__all__ = [
    "ActionState",
    "ConnectionMessage",
    "ErrorState",
    "Factsheet",
    "Header",
    "InstantActions",
    "OrderMessage",
    "StateMessage",
    "read",
    "write_message",
]

# The names of fields are the norm's.
# ruff: noqa: N815

LOAD_ACTIONS = frozenset({"pick", "drop"})
"""Actions of the norm with the parameters ``loadId`` and ``loadType``."""

Sequence = Annotated[int, Field(ge=0, le=2**32 - 1)]


class Header(BaseModel):
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

    model_config = ConfigDict(frozen=True)

    headerId: Annotated[int, Field(ge=0)]
    timestamp: str
    version: Literal["2.0.0", "2.1.0", "3.0.0"]
    manufacturer: str
    serialNumber: str


class _Model(BaseModel):
    # Readers take any number as a float: Python's JSON has 1 for 1.0.
    model_config = ConfigDict(extra="ignore", frozen=True, strict=True)


class _Parameter(_Model):
    key: str
    value: Any


class _Action(_Model):
    actionId: str
    actionType: str
    actionDescription: str | None = None
    blockingType: str = "HARD"
    retriable: bool | None = None  # from 3.0 on
    actionParameters: tuple[_Parameter, ...] | None = Field(default=None, strict=False)


class _NodePosition(_Model):
    x: float
    y: float
    mapId: str
    # A circle's radius, which 3.0 writes as an ellipse.
    allowedDeviationXY: Any = None
    theta: float | None = None


class _Node(_Model):
    nodeId: str
    sequenceId: Sequence
    released: bool
    nodePosition: _NodePosition | None = None
    actions: tuple[_Action, ...] = Field(strict=False)


class _ControlPoint(_Model):
    x: float
    y: float
    weight: float = 1.0


class _Trajectory(_Model):
    degree: int
    knotVector: tuple[float, ...] = Field(strict=False)
    controlPoints: tuple[_ControlPoint, ...] = Field(strict=False)


class _Edge(_Model):
    edgeId: str
    sequenceId: Sequence
    released: bool
    startNodeId: str | None = None  # 3.0 does without
    endNodeId: str | None = None
    maxSpeed: float | None = Field(
        default=None, validation_alias=AliasChoices("maxSpeed", "maximumSpeed")
    )
    length: float | None = None
    orientation: float | None = None  # against the direction of driving
    rotationAllowed: bool | None = None  # before 3.0
    trajectory: _Trajectory | None = None
    actions: tuple[_Action, ...] = Field(default=(), strict=False)


class OrderMessage(_Model):
    """An order or an update."""

    orderId: str
    orderUpdateId: Sequence
    nodes: Annotated[tuple[_Node, ...], Field(min_length=1, strict=False)]
    edges: tuple[_Edge, ...] = Field(default=(), strict=False)

    @classmethod
    def of(
        cls,
        order: Order,
        order_map: OrderMap,
        items: Mapping[str, str] | None = None,
        tasks: Mapping[str, Any] | None = None,
    ) -> OrderMessage:
        """Return the message of an order.

        Parameters
        ----------
        order
            An order or update.
        order_map
            Where places and lanes lie for the robot, and its work.
        items
            The item of work of each action, see `rightofway.control.work_items`.
        tasks
            What actions are to do that are not usual, as a journal has it, by their ids.
        """
        # An update is released when the work of its first node is finished.
        done, known, unusual = set[str](), items or {}, tasks or {}
        identity = order_map.identity
        if order.update_id and not identity.repeats_work:
            done = set(order.nodes[0].actions)
        nodes = tuple(
            _Node(
                nodeId=order_map.name_node(node.place),
                sequenceId=node.sequence_id,
                released=True,
                nodePosition=_make_position(
                    order_map.get_place(node.place), is_work=bool(node.actions)
                ),
                actions=tuple(
                    _make_work(
                        action,
                        known.get(action, ""),
                        ActionToDo.of_document(unusual.get(action)),
                        identity,
                    )
                    for action in node.actions
                    if action not in done
                ),
            )
            for node in order.nodes
        )
        edges = tuple(
            _make_edge(tail.place, head.place, head.sequence_id - 1, order_map)
            for tail, head in pairwise(order.nodes)
        )
        return cls(orderId=order.order_id, orderUpdateId=order.update_id, nodes=nodes, edges=edges)

    def to_order(self, robot: int) -> Order:
        """Return the released part of the order.

        Parameters
        ----------
        robot
            The robot that it was sent to.
        """
        nodes = tuple(
            OrderNode(
                place=node.nodeId,
                sequence_id=node.sequenceId,
                actions=tuple(action.actionId for action in node.actions),
            )
            for node in self.nodes
            if node.released
        )
        return Order(robot=robot, order_id=self.orderId, update_id=self.orderUpdateId, nodes=nodes)


def _make_position(place: Place | None, *, is_work: bool) -> _NodePosition | None:
    """Return where a node is; with the heading there, if the robot works at the node."""
    if place is None:
        return None
    x, y = place.point
    return _NodePosition(
        x=x,
        y=y,
        mapId=place.map_id,
        allowedDeviationXY=place.deviation,
        theta=place.theta if is_work else None,
    )


def _make_work(action_id: str, item: str, task: ActionToDo, identity: Identity) -> _Action:
    """Return an action of an item of work; that of a load has the load as parameters."""
    own = task.action or identity.find_action(item, task.use)
    handles_load = task.action is None or own.action in LOAD_ACTIONS
    given: dict[str, Any] = thaw_value(own.parameters)
    parameters = {**(task.load if handles_load else {}), **given}
    blocking = own.blocking.upper()
    is_new = identity.version >= "3"
    if blocking == "SINGLE" and not is_new:
        blocking = "HARD"  # the nearest type before 3.0 that allows no other action
    if identity.version == "2.0.0":  # its parameters are no objects
        parameters = {
            key: json.dumps(value) if isinstance(value, dict) else value
            for key, value in parameters.items()
        }
    return _Action(
        actionId=action_id,
        actionType=own.action,
        actionDescription=own.description or None,
        blockingType=blocking,
        retriable=True if own.retriable and is_new else None,
        actionParameters=tuple(
            _Parameter(key=key, value=value) for key, value in parameters.items()
        )
        or None,
    )


def _make_edge(tail: str, head: str, sequence_id: int, order_map: OrderMap) -> _Edge:
    lane = order_map.find_lane(tail, head)
    start, end = order_map.name_node(tail), order_map.name_node(head)
    return _Edge(
        edgeId=name_edge(start, end, lane),
        sequenceId=sequence_id,
        released=True,
        startNodeId=start,
        endNodeId=end,
        maxSpeed=None if lane is None else lane.max_speed,
        length=None if lane is None else lane.length,
        orientation=None if lane is None else lane.orientation,
        rotationAllowed=None if lane is None else lane.turning,
        trajectory=_make_trajectory(lane),
    )


def _make_trajectory(lane: OrderLane | None) -> _Trajectory | None:
    """Return the shape of a lane as a clamped NURBS: straight pieces, or one Bézier curve."""
    if lane is None or not lane.points:
        return None
    degree = len(lane.points) - 1 if lane.is_bezier else 1
    inner = len(lane.points) - degree
    knots = (*[0.0] * degree, *(k / inner for k in range(inner + 1)), *[1.0] * degree)
    return _Trajectory(
        degree=degree,
        knotVector=knots,
        controlPoints=tuple(_ControlPoint(x=x, y=y) for x, y in lane.points),
    )


def name_edge(tail: str, head: str, lane: OrderLane | None) -> str:
    """Return the id of the edge between two places."""
    return f"{tail}-{head}" if lane is None or lane.edge_id is None else lane.edge_id


class _InstantAction(_Model):
    actionId: str
    actionType: Literal[
        "stateRequest", "cancelOrder", "factsheetRequest", "startPause", "stopPause"
    ]
    blockingType: str = "NONE"
    # The schema of instant actions of 2.0 asks for the type under another name than its text.
    actionName: str | None = None


class InstantActions(_Model):
    """An action to do at once."""

    actions: tuple[_InstantAction, ...] = Field(strict=False)

    @classmethod
    def of(cls, action: InstantAction) -> InstantActions:
        """Return the message of an instant action.

        Parameters
        ----------
        action
            The action.
        """
        kind = action.kind
        return cls(
            actions=(_InstantAction(actionId=action.action_id, actionType=kind, actionName=kind),)
        )

    def to_instant_actions(self, robot: int) -> tuple[InstantAction, ...]:
        """Return the action.

        Parameters
        ----------
        robot
            The robot that it was sent to.
        """
        return tuple(
            InstantAction(robot=robot, action_id=action.actionId, kind=action.actionType)
            for action in self.actions
        )


class _NodeState(_Model):
    nodeId: str = ""
    sequenceId: Sequence
    released: bool = True


class _EdgeState(_Model):
    edgeId: str = ""
    sequenceId: Sequence
    released: bool = True


class ActionState(_Model):
    """The state of an action."""

    actionId: str
    actionStatus: str


class ErrorState(_Model):
    """An error of a robot."""

    errorType: str
    errorLevel: str
    errorDescription: str | None = None


class _Position(_Model):
    x: float
    y: float
    theta: float = 0.0
    mapId: str
    positionInitialized: bool = Field(
        default=True, validation_alias=AliasChoices("positionInitialized", "localized")
    )


class _Battery(_Model):
    batteryCharge: float = Field(
        validation_alias=AliasChoices("batteryCharge", "stateOfCharge"),
    )
    charging: bool = False


class _Safety(_Model):
    eStop: str = Field(
        default="NONE", validation_alias=AliasChoices("eStop", "activeEmergencyStop")
    )
    fieldViolation: bool = False


class _Load(_Model):
    loadId: str | None = None
    loadType: str | None = None


class StateMessage(_Model):
    """The state of a robot; its keys without a default are those that count."""

    orderId: str
    orderUpdateId: Sequence
    lastNodeId: str
    lastNodeSequenceId: Sequence
    nodeStates: tuple[_NodeState, ...] = Field(strict=False)
    edgeStates: tuple[_EdgeState, ...] = Field(strict=False)
    actionStates: tuple[ActionState, ...] = Field(strict=False)
    instantActionStates: tuple[ActionState, ...] = Field(default=(), strict=False)
    driving: bool
    paused: bool = False
    newBaseRequest: bool = False
    operatingMode: str = "AUTOMATIC"
    errors: tuple[ErrorState, ...] = Field(default=(), strict=False)
    safetyState: _Safety = _Safety()
    # No release depends on these, and a robot may send anything.
    loads: Any = None
    agvPosition: Any = Field(
        default=None, validation_alias=AliasChoices("agvPosition", "mobileRobotPosition")
    )
    batteryState: Any = Field(
        default=None, validation_alias=AliasChoices("batteryState", "powerSupply")
    )

    @classmethod
    def of(
        cls,
        state: StateReport,
        places: Iterable[str],
        instant: frozenset[str],
        position: Place | None = None,
        *,
        lanes: Mapping[tuple[str, str], OrderLane],
        is_charging: bool = False,
    ) -> StateMessage:
        """Return the message of a state.

        Parameters
        ----------
        state
            The robot's message about itself.
        places
            The places of the nodes that are still to be driven.
        instant
            Ids of instant actions, which 3.0 keeps apart.
        position
            Where the robot is, if that is to be said.
        lanes
            The edges of its orders, by the places at their ends.
        is_charging
            Whether its battery is charged.
        """
        ahead = tuple(places)
        actions = {
            action_id: ActionState(actionId=action_id, actionStatus=status)
            for action_id, status in state.actions.items()
        }
        condition = state.condition
        return cls(
            orderId=state.order_id,
            orderUpdateId=state.update_id,
            lastNodeId=state.last_place,
            lastNodeSequenceId=state.last_sequence_id,
            nodeStates=tuple(
                _NodeState(nodeId=place, sequenceId=number)
                for place, number in zip(ahead, state.nodes, strict=True)
            ),
            edgeStates=tuple(
                _EdgeState(edgeId=name_edge(tail, head, lanes.get((tail, head))), sequenceId=number)
                for (tail, head), number in zip(
                    pairwise((state.last_place, *ahead)), state.edges, strict=True
                )
            ),
            actionStates=tuple(actions[key] for key in actions if key not in instant),
            instantActionStates=tuple(actions[key] for key in actions if key in instant),
            driving=state.is_driving,
            paused=condition.is_paused,
            newBaseRequest=condition.wants_more,
            operatingMode=condition.mode,
            errors=tuple(
                ErrorState(
                    errorType=error.kind,
                    errorLevel=error.level,
                    errorDescription=error.description,
                )
                for error in condition.errors
            ),
            safetyState=_Safety(eStop=condition.emergency_stop),
            loads=state.loads
            and tuple(_Load(loadId=own.load_id, loadType=own.load_type) for own in state.loads),
            batteryState=_Battery(
                batteryCharge=100.0 if state.charge is None else 100 * state.charge,
                charging=is_charging,
            ),
            agvPosition=position
            and _Position(
                x=position.point[0],
                y=position.point[1],
                theta=state.theta or 0.0,
                mapId=position.map_id,
            ),
        )

    def to_robot_state(self) -> StateReport:
        """Return the robot's message about itself."""
        actions = (*self.actionStates, *self.instantActionStates)
        return StateReport(
            order_id=self.orderId,
            update_id=self.orderUpdateId,
            last_place=self.lastNodeId,
            last_sequence_id=self.lastNodeSequenceId,
            nodes=tuple(node.sequenceId for node in self.nodeStates),
            edges=tuple(edge.sequenceId for edge in self.edgeStates),
            actions={action.actionId: action.actionStatus for action in actions},
            is_driving=self.driving,
            condition=Condition(
                mode=self.operatingMode,
                is_paused=self.paused,
                emergency_stop=self.safetyState.eStop,
                errors=tuple(
                    RobotError(
                        kind=error.errorType,
                        level=error.errorLevel,
                        description=error.errorDescription or "",
                    )
                    for error in self.errors
                ),
                wants_more=self.newBaseRequest,
            ),
            position=_read_position(self.agvPosition),
            theta=_read_theta(self.agvPosition),
            charge=_read_charge(self.batteryState),
            loads=_read_loads(self.loads),
        )


def _read_position(given: Any) -> tuple[float, float, str] | None:
    """Return the position of a robot, None where it has none or it cannot be read."""
    position = _validate_position(given)
    if position is None or not (isfinite(position.x) and isfinite(position.y)):
        return None
    return position.x, position.y, position.mapId


def _read_theta(given: Any) -> float | None:
    """Return where a robot heads, None where it does not say or it cannot be read."""
    position = _validate_position(given)
    if position is None or "theta" not in position.model_fields_set or not isfinite(position.theta):
        return None
    return position.theta


def _validate_position(given: Any) -> _Position | None:
    """Return the position of a localized robot, None where it has none or it cannot be read."""
    try:
        position = given if isinstance(given, _Position) else _Position.model_validate(given)
    except ValidationError:
        return None
    return position if position.positionInitialized else None


def _read_charge(given: Any) -> float | None:
    """Return a state of charge, from 0 to 1; None where there is none or it cannot be read."""
    try:
        battery = given if isinstance(given, _Battery) else _Battery.model_validate(given)
    except ValidationError:
        return None
    charge = battery.batteryCharge / 100
    return charge if 0 <= charge <= 1 else None


def _read_loads(given: Any) -> tuple[Load, ...] | None:
    """Return the loads of a robot; None where it does not say, or they cannot be read."""
    if not isinstance(given, list | tuple):
        return None
    try:
        loads = [own if isinstance(own, _Load) else _Load.model_validate(own) for own in given]
    except ValidationError:
        return None
    return tuple(Load(load_id=own.loadId, load_type=own.loadType) for own in loads)


class ConnectionMessage(_Model):
    """Whether a robot is connected."""

    connectionState: str

    @property
    def is_online(self) -> bool:
        """Whether messages reach it."""
        return self.connectionState == "ONLINE"


class _Physical(_Model):
    speedMax: float | None = Field(
        default=None, validation_alias=AliasChoices("speedMax", "maximumSpeed")
    )
    width: float | None = None
    length: float | None = None


class _KnownAction(_Model):
    actionType: str


class _Features(_Model):
    agvActions: tuple[_KnownAction, ...] = Field(
        default=(), strict=False, validation_alias=AliasChoices("agvActions", "mobileRobotActions")
    )


class Factsheet(_Model):
    """The kind of a robot: how fast and how large it is [m/s, m], and its actions."""

    physicalParameters: _Physical = _Physical()
    protocolFeatures: _Features = _Features()

    @property
    def can_pause(self) -> bool:
        """Whether it knows the actions that begin and end a pause."""
        known = {action.actionType for action in self.protocolFeatures.agvActions}
        return {"startPause", "stopPause"} <= known


Body = OrderMessage | InstantActions | StateMessage | ConnectionMessage | Factsheet

_NAMES: dict[str, dict[str, str]] = {
    "2.0.0": {"allowedDeviationXY": "allowedDeviationXy"},
    "2.1.0": {},
    "3.0.0": {
        "accelerationMax": "maximumAcceleration",
        "actionDescription": "actionDescriptor",
        "agvActions": "mobileRobotActions",
        "agvClass": "mobileRobotClass",
        "agvGeometry": "mobileRobotGeometry",
        "agvKinematic": "mobileRobotKinematics",
        "agvPosition": "mobileRobotPosition",
        "batteryCharge": "stateOfCharge",
        "batteryState": "powerSupply",
        "decelerationMax": "maximumDeceleration",
        "eStop": "activeEmergencyStop",
        "heightMax": "maximumHeight",
        "heightMin": "minimumHeight",
        "maxArrayLens": "maximumArrayLengths",
        "maxLoadMass": "maximumLoadMass",
        "maxSpeed": "maximumSpeed",
        "maxStringLens": "maximumStringLengths",
        "minOrderInterval": "minimumOrderInterval",
        "minStateInterval": "minimumStateInterval",
        "positionInitialized": "localized",
        "speedMax": "maximumSpeed",
        "speedMin": "minimumSpeed",
    },
}
"""How versions name keys of 2.1."""

_LEFT_OUT: dict[str, dict[str, Any]] = {
    "2.0.0": {},
    "2.1.0": {"actions": {"__all__": {"actionName"}}},
    "3.0.0": {
        "actions": {"__all__": {"actionName"}},
        "edges": {"__all__": {"startNodeId", "endNodeId", "rotationAllowed"}},
    },
}
"""Keys that a version does not have, as pydantic leaves them out."""


def write_message(body: Body | Mapping[str, Any], header: Header) -> dict[str, Any]:
    """Return a message as JSON has it, in the words of the version of its head.

    Parameters
    ----------
    body
        The content; a mapping has the names of version 2.1.
    header
        The head of the message.
    """
    names, is_new = _NAMES[header.version], header.version >= "3"
    document = (
        body.model_dump(mode="json", exclude_none=True, exclude=_LEFT_OUT[header.version])
        if isinstance(body, BaseModel)
        else dict(body)
    )
    if not is_new:
        if isinstance(body, StateMessage):  # the lists of 3.0 are one before
            document["actionStates"] += document.pop("instantActionStates")
        if isinstance(body, ConnectionMessage):
            document["connectionState"] = body.connectionState.replace("_", "")
    if header.version == "2.0.0" and isinstance(body, InstantActions):
        # Robots of 2.0 read either name: that of its schema, or that of version 1.1.
        document["instantActions"] = document["actions"]

    def renamed(value: Any) -> Any:
        if isinstance(value, list):
            return [renamed(item) for item in value]
        if not isinstance(value, dict):
            return value
        return {
            names.get(key, key): {"a": item, "b": item, "theta": 0.0}
            if is_new and key == "allowedDeviationXY"
            else renamed(item)
            if isinstance(item, dict | list)
            else item
            for key, item in value.items()
        }

    return {**header.model_dump(), **(renamed(document) if names else document)}


_AnyModel = TypeVar("_AnyModel", bound=_Model)


def read(model: type[_AnyModel], document: Mapping[str, Any], name: str) -> _AnyModel:
    """Return a message that has all keys that count.

    Parameters
    ----------
    model
        The kind of message.
    document
        The message as JSON has it, of any of `VERSIONS`.
    name
        How a fault names the message.

    Raises
    ------
    InputError
        If a key that counts is missing or has a wrong value; the place says which.
    """
    try:
        return model.model_validate(document)
    except ValidationError:
        pass
    try:  # robots write null for what they do not have, against the schemas
        return model.model_validate(_drop_nulls(document))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        message = f"{first['msg'].lower()}: {quote(first['input'])} (the sender has to send it)"
        raise InputError([InputFault((name, *first["loc"]), message)]) from error


def _drop_nulls(value: Any) -> Any:
    """Return a message without the keys that are null."""
    if isinstance(value, list):
        return [_drop_nulls(item) for item in value]
    if not isinstance(value, Mapping):
        return value
    return {key: _drop_nulls(item) for key, item in value.items() if item is not None}
