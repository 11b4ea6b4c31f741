"""Both ends of the wire: messages of control and robots as topics and payloads of VDA 5050.

No network is here: an end takes a topic and a payload in and gives letters out, whatever carries
them.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import cached_property, partial
from math import atan2, hypot, remainder, tau
from typing import Any, TypeVar

from rightofway.control import vda5050
from rightofway.control.fleet_control import UNSOUND, FleetControl
from rightofway.control.identities import Identity
from rightofway.control.messages import (
    Condition,
    InstantAction,
    Load,
    Message,
    Order,
    RobotError,
    StateReport,
)
from rightofway.control.notices import Notices
from rightofway.control.order_map import OrderLane, OrderMap, Place
from rightofway.control.simulated_battery import SimulatedBattery
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.errors import InputError, describe_defect, escape_text, quote
from rightofway.facts import Fact
from rightofway.model import Scenario

__all__ = [
    "ControlEnd",
    "Letter",
    "LetterWriter",
    "RobotEnd",
    "compare_size",
    "compare_speed",
    "format_timestamp",
    "make_timestamp",
]

READ = ("state", "connection", "factsheet")
"""Topics that a control listens to."""

LOST = "lost"
"""The kind of trouble of a robot that no message reaches."""

OWN_DEVIATION = 1.0
"""The distance from a node at which a robot without a deviation may report its arrival [m]."""

LONGEST_MESSAGE = 1_000_000
"""Bytes of a message that is read: to refuse a longer one field by field takes seconds."""

LONGEST_EXCERPT = 200
"""Bytes of a message that its report shows."""

ROUNDING = 1e-3
"""By how much a factsheet may miss the plan [m, m/s]: its numbers are rounded."""

FACTSHEET: dict[str, dict[str, Any]] = {
    "typeSpecification": {
        "seriesName": "simulated",
        "agvKinematic": "DIFF",
        "agvClass": "CARRIER",
        "maxLoadMass": 100.0,
        "localizationTypes": ["NATURAL"],
        "navigationTypes": ["VIRTUAL_LINE_GUIDED"],
    },
    "physicalParameters": {
        "speedMin": 0.0,
        "speedMax": 100.0,
        "accelerationMax": 100.0,
        "decelerationMax": 100.0,
        "heightMin": 0.1,
        "heightMax": 0.1,
        "width": 0.1,
        "length": 0.1,
    },
    "protocolLimits": {
        "maxStringLens": {},
        "maxArrayLens": {},
        "timing": {"minOrderInterval": 0.0, "minStateInterval": 0.0},
    },
    "protocolFeatures": {
        "optionalParameters": [],
        "agvActions": [
            {
                "actionType": kind,
                "actionScopes": ["INSTANT"],
                "pauseAllowed": True,
                "cancelAllowed": False,
            }
            for kind in (
                "cancelOrder",
                "factsheetRequest",
                "startPause",
                "stateRequest",
                "stopPause",
            )
        ],
    },
    "agvGeometry": {},
    "loadSpecification": {},
}
"""The factsheet of a simulated robot: small, and faster than any plan."""


_AnyBody = TypeVar("_AnyBody", bound=vda5050.Body)


class Letter:
    """A message on its way.

    A letter that is made here has the body of the message, too: within one process the other end
    takes that, and the payload is written only if somebody asks for it.

    Parameters
    ----------
    topic
        Where it goes.
    payload
        The message as it is sent, or a function that writes it.
    body
        The message; None where only the payload is known.
    """

    def __init__(
        self,
        topic: str,
        payload: bytes | Callable[[], bytes],
        body: vda5050.Body | None = None,
    ) -> None:
        self.topic, self.body, self._payload = topic, body, payload

    @cached_property
    def payload(self) -> bytes:
        """The message as it is sent."""
        return self._payload if isinstance(self._payload, bytes) else self._payload()

    @property
    def name(self) -> str:
        """The last part of its topic."""
        return self.topic.rpartition("/")[2]


def make_timestamp() -> str:
    """Return the time of the clock as messages have it."""
    return format_timestamp(datetime.now(UTC))


def format_timestamp(moment: datetime) -> str:
    """Return a time as messages have it.

    Parameters
    ----------
    moment
        The time, in UTC.
    """
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")


class LetterWriter:
    """A writer of messages of one end with their headers.

    Parameters
    ----------
    now
        Returns the time as messages have it.
    """

    def __init__(self, now: Callable[[], str]) -> None:
        self._now, self._sent = now, Counter[str]()

    def make_letter(
        self, identity: Identity, name: str, body: vda5050.Body | Mapping[str, Any]
    ) -> Letter:
        """Return a message with the next header of its topic.

        Parameters
        ----------
        identity
            The robot that sends it or receives it.
        name
            The last part of its topic.
        body
            The content; a mapping has the names of version 2.1.
        """
        topic = identity.get_topic(name)
        number, moment = self._sent[topic], self._now()
        self._sent[topic] += 1
        payload = partial(_write, identity, number, moment, body)
        return Letter(topic, payload, None if isinstance(body, Mapping) else body)


class ControlEnd:
    """The end of the control.

    Parameters
    ----------
    control
        Takes states and returns the messages to send.
    maps
        The map of each robot, in the order of the plan.
    now
        Returns the time as messages have it.
    notices
        Receives faults of robots and of their messages.
    """

    def __init__(
        self,
        control: FleetControl,
        maps: Sequence[OrderMap],
        now: Callable[[], str],
        notices: Notices,
    ) -> None:
        self.control, self.notices = control, notices
        self._maps = maps
        self._heard = set[int]()
        self._writer = LetterWriter(now)
        self._robots = {
            order_map.identity.get_topic(name): (robot, name)
            for robot, order_map in enumerate(maps)
            for name in READ
        }

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics that control listens to."""
        return tuple(self._robots)

    def find_robot(self, topic: str) -> int | None:
        """Return the robot of a topic, None for a topic of nobody.

        Parameters
        ----------
        topic
            Of a message that came.
        """
        robot, _ = self._robots.get(topic, (None, ""))
        return robot

    def receive(self, letter: Letter) -> list[Letter]:
        """Take in a message of a robot; return the messages to send because of it.

        Parameters
        ----------
        letter
            A state, a connection or a factsheet, which may be broken: then it proves nothing.
        """
        robot, name = self._robots[letter.topic]
        try:
            letters = self._take(robot, name, letter)
        except InputError as error:
            self._refuse(robot, name, Fact("unused message", error=str(error)))
        except UNSOUND:
            raise
        except Exception as error:  # noqa: BLE001 (the guard: no message ends the control)
            excerpt = escape_text(letter.payload[:LONGEST_EXCERPT].decode(errors="replace"))
            defect = describe_defect(error)
            self._refuse(robot, name, Fact("message with defect", error=defect, message=excerpt))
        else:
            self.notices.end(robot, f"message {name}")
            return letters
        return []

    def _refuse(self, robot: int, name: str, begin: Fact) -> None:
        """Report messages of a robot that are not used, until one is."""
        self.notices.begin(robot, f"message {name}", begin, Fact("usable messages", topic=name))

    def _take(self, robot: int, name: str, letter: Letter) -> list[Letter]:
        """Take in a message of a robot; return the messages to send because of it."""
        if name == "state":
            state = self._read(robot, vda5050.StateMessage, letter).to_robot_state()
            state = replace(state, last_place=self._find_vertex(robot, state))
            self._heard.add(robot)
            self.notices.take(robot, state.condition)
            self.notices.end(robot, LOST)
            if state.theta is not None:
                self.control.headings[robot] = self._maps[robot].find_heading(state.theta)
            messages = self.control.receive(robot, state)
            self._compare_position(robot, state)
            return self.make_letters(messages)
        if name == "connection":
            is_online = self._read(robot, vda5050.ConnectionMessage, letter).is_online
            return self.connect(robot, is_connected=is_online)
        self._compare(robot, self._read(robot, vda5050.Factsheet, letter))
        return []

    def _read(self, robot: int, model: type[_AnyBody], letter: Letter) -> _AnyBody:
        """Return the content of a letter; refuse one whose header is that of another robot."""
        if isinstance(letter.body, model):
            return letter.body
        document = _parse_document(letter.payload)
        _refuse_header(document, self._maps[robot].identity, letter.name)
        return vda5050.read(model, document, letter.name)

    def _find_vertex(self, robot: int, state: StateReport) -> str:
        """Return the vertex of the node that a robot names, in the direction in which it came."""
        vertices = self._maps[robot].list_vertices(state.last_place)
        if len(vertices) == 1:
            return state.last_place
        own = self.control.ledger.robots[robot]
        if state.order_id in own.orders:
            visit = own.orders[state.order_id].offset + state.last_sequence_id // 2
            if own.route.first <= visit < own.route.end and own.route.get_place(visit) in vertices:
                return own.route.get_place(visit)
        return next((place for place in own.held if place in vertices), state.last_place)

    def take_heard(self) -> set[int]:
        """Return the robots of which a state was used since the last call."""
        heard, self._heard = self._heard, set()
        return heard

    def _compare_position(self, robot: int, state: StateReport) -> None:
        """Report a robot that is further from the node that it names than it may be.

        Between two nodes it may be as far away as the lane to the next one is long.
        """
        own, order_map = self.control.ledger.robots[robot], self._maps[robot]
        visit = own.find_held(state.last_place) if state.order_id == own.order_id else None
        place = None if visit is None else order_map.get_place(state.last_place)
        if visit is None or place is None or state.position is None:
            return
        x, y, map_id = state.position
        limit = ROUNDING + (OWN_DEVIATION if place.deviation is None else place.deviation)
        if not state.is_idle and visit + 1 < own.route.end:
            lane = order_map.find_lane(state.last_place, own.route.get_place(visit + 1))
            limit += 0.0 if lane is None else lane.length
        apart = hypot(x - place.point[0], y - place.point[1])
        if map_id != place.map_id or apart <= limit:
            self.notices.end(robot, "position")
            return
        place_name = escape_text(state.last_place)
        begin = Fact("far from node", apart=apart, place=place_name, limit=limit)
        self.notices.begin(robot, "position", begin, Fact("near node"))

    def connect(self, robot: int, *, is_connected: bool, why: Fact | None = None) -> list[Letter]:
        """Note whether messages reach a robot; return the messages to send because of it.

        Parameters
        ----------
        robot
            The robot.
        is_connected
            Whether it is there.
        why
            How it is known that it is not; None by a message.
        """
        if is_connected:
            self.notices.end(robot, LOST)
        else:
            begin = Fact("lost", reason=why or Fact("not connected"))
            self.notices.begin(robot, LOST, begin, Fact("connected"))
        return self.make_letters(self.control.connect(robot, is_connected=is_connected))

    def _compare(self, robot: int, sheet: vda5050.Factsheet) -> None:
        """Report where a robot is slower or larger than the plan takes it to be."""
        scenario = self._maps[robot].scenario
        if sheet.can_pause:
            self.control.can_pause.add(robot)
        if (begin := compare_speed(scenario, robot, sheet)) is not None:
            self.notices.begin(robot, "speed", begin, Fact("fast enough"))
        else:
            self.notices.end(robot, "speed")
        if (begin := compare_size(scenario, robot, sheet)) is not None:
            self.control.refuse(robot)
            # The control refuses it as long as it runs, so this trouble does not end.
            self.notices.begin(robot, "size", begin, None)

    def make_letters(self, messages: Iterable[Message]) -> list[Letter]:
        """Return messages of the control as they are sent.

        Parameters
        ----------
        messages
            Orders and instant actions.
        """
        letters = []
        for message in messages:
            order_map = self._maps[message.robot]
            if isinstance(message, Order):
                own = self.control.ledger.robots[message.robot]
                body: vda5050.Body = vda5050.OrderMessage.of(
                    message, order_map, own.jobs_of, own.tasks
                )
                name = "order"
            else:
                body, name = vda5050.InstantActions.of(message), "instantActions"
            letters.append(self._writer.make_letter(order_map.identity, name, body))
        return letters

    def ask_for_factsheets(self) -> list[Letter]:
        """Return the messages that ask each robot how fast and how large it is."""
        return self.make_letters(
            InstantAction(robot=robot, action_id=f"factsheet{robot}", kind="factsheetRequest")
            for robot in range(len(self._maps))
        )


def compare_speed(scenario: Scenario, robot: int, sheet: vda5050.Factsheet) -> Fact | None:
    """Return that a robot is slower than in its scenario, None if it is not known to be."""
    metre, second = scenario.units.metres or 1, scenario.units.seconds or 1
    speed, top = (
        float(scenario.robots[robot].speed * metre / second),
        sheet.physicalParameters.speedMax,
    )
    if top is None or top >= speed - ROUNDING:
        return None
    return Fact("slower than planned", top=top, speed=speed)


def compare_size(scenario: Scenario, robot: int, sheet: vda5050.Factsheet) -> Fact | None:
    """Return that a robot is larger than in its scenario, None if it is not known to be."""
    physical = sheet.physicalParameters
    radius = float(scenario.robots[robot].radius * (scenario.units.metres or 1))
    if not radius or physical.length is None or physical.width is None:
        return None
    needed = hypot(physical.length, physical.width) / 2
    if needed <= radius + ROUNDING:
        return None
    return Fact(
        "larger than planned",
        length=physical.length,
        width=physical.width,
        radius=radius,
        needed=needed,
    )


class RobotEnd:
    """The end of a simulated robot.

    Parameters
    ----------
    robot
        Takes orders and instant actions.
    number
        Its number in the plan.
    identity
        As messages name it.
    now
        Returns the time as messages have it.

    Attributes
    ----------
    condition
        The parts of its states that are not about its order.
    lanes
        How the edges of its orders are driven, by their ends.
    battery
        Its battery; None where it has none.
    """

    def __init__(
        self,
        robot: SimulatedRobot,
        number: int,
        identity: Identity,
        now: Callable[[], str],
        battery: SimulatedBattery | None = None,
    ) -> None:
        self.robot, self._number, self._identity = robot, number, identity
        self.battery = battery
        self.condition = Condition()
        self.lanes: dict[tuple[str, str], OrderLane] = {}
        self._places: dict[str, Place] = {}
        self._came, self._theta = robot.place, 0.0
        self._writer = LetterWriter(now)
        self._charges = {
            identity.start_charging.action: True,
            identity.stop_charging.action: False,
        }
        pick, drop = (identity.find_action("", use).action for use in ("pick", "drop"))
        self._picks = {"pick": True, "drop": False}
        if pick != drop:
            self._picks |= {pick: True, drop: False}

    @property
    def topics(self) -> tuple[str, str]:
        """The topics that it listens to."""
        return self._identity.get_topic("order"), self._identity.get_topic("instantActions")

    def receive(self, letter: Letter) -> list[Letter]:
        """Take in an order or instant actions; return the answers except its state.

        Parameters
        ----------
        letter
            The message that it received.

        Raises
        ------
        InputError
            If it is not as the norm has it.
        """
        if letter.topic == self._identity.get_topic("order"):
            message = _read(vda5050.OrderMessage, letter)
            self._keep_order(message)
            self.robot.take_order(message.to_order(self._number))
            return []
        actions = _read(vda5050.InstantActions, letter).to_instant_actions(self._number)
        for action in actions:
            self.robot.take_action(action)
        return [self.report_factsheet() for action in actions if action.kind == "factsheetRequest"]

    def _keep_order(self, message: vda5050.OrderMessage) -> None:
        """Keep how long and how fast the edges of an order are, and where its nodes are."""
        actions = [action for node in message.nodes for action in node.actions]
        for action in actions:
            if action.actionType in self._charges:
                self.robot.charging[action.actionId] = self._charges[action.actionType]
            elif action.actionType in self._picks:
                given = {own.key: own.value for own in action.actionParameters or ()}
                load = Load(load_id=given.get("loadId"), load_type=given.get("loadType"))
                picks = self._picks[action.actionType]
                self.robot.handling[action.actionId] = picks, load
        names = {node.sequenceId: node.nodeId for node in message.nodes}
        for node in message.nodes:
            if node.nodePosition is not None:
                at = node.nodePosition
                point = at.x, at.y
                place = Place(point=point, map_id=at.mapId, theta=at.theta)
                self._places[node.nodeId] = place
        for edge in message.edges:
            tail, head = names.get(edge.sequenceId - 1), names.get(edge.sequenceId + 1)
            is_known = edge.length is not None and edge.maxSpeed is not None
            if is_known and tail is not None and head is not None:
                length, speed = edge.length or 0.0, edge.maxSpeed or 1.0
                self.lanes[tail, head] = OrderLane(
                    length=length,
                    max_speed=speed,
                    orientation=edge.orientation,
                    edge_id=edge.edgeId,
                )

    def report_state(self) -> Letter:
        """Return its state as it is sent."""
        robot, condition = self.robot, self.condition
        if robot.is_paused:
            condition = replace(condition, is_paused=True)
        if robot.refusal is not None:
            error = RobotError(kind=robot.refusal, level="WARNING")
            condition = replace(condition, errors=(*condition.errors, error))
        state = robot.report_state(condition, self.battery.soc if self.battery else None)
        body = vda5050.StateMessage.of(
            replace(state, theta=self._find_theta()),
            [node.place for node in robot.ahead],
            frozenset(robot.instant_actions),
            self._places.get(robot.place),
            lanes=self.lanes,
            is_charging=robot.is_charging,
        )
        return self._writer.make_letter(self._identity, "state", body)

    def _find_theta(self) -> float:
        """Return the heading of the robot [rad]: that of its place, where it works in a heading.

        Else it is that of the straight line of its last drive, turned by its orientation there.
        """
        before, at = self._places.get(self._came), self._places.get(self.robot.place)
        lane = self.lanes.get((self._came, self.robot.place))
        turn = 0.0 if lane is None or lane.orientation is None else lane.orientation
        self._came = self.robot.place
        if before and at and before.point != at.point:
            (x, y), (x_before, y_before) = at.point, before.point
            self._theta = remainder(atan2(y - y_before, x - x_before) + turn, tau)
        if at and at.theta is not None:
            self._theta = at.theta
        return self._theta

    def report_connection(self, state: str) -> Letter:
        """Return whether it is connected, as it is sent.

        Parameters
        ----------
        state
            ``ONLINE``, ``OFFLINE`` or ``CONNECTION_BROKEN``.
        """
        body = vda5050.ConnectionMessage(connectionState=state)
        return self._writer.make_letter(self._identity, "connection", body)

    def report_factsheet(self) -> Letter:
        """Return its identity, as it is sent."""
        sheet: dict[str, Any] = FACTSHEET
        if self._identity.version >= "3":
            # The schema of the tag 3.0.0 requires this key without an s, that of main with one.
            kinds = FACTSHEET["typeSpecification"]
            own = {**kinds, "mobileRobotKinematic": kinds["agvKinematic"]}
            sheet = {**FACTSHEET, "typeSpecification": own}
        return self._writer.make_letter(self._identity, "factsheet", sheet)


def _write(
    identity: Identity, number: int, moment: str, body: vda5050.Body | Mapping[str, Any]
) -> bytes:
    """Return a message as it is sent."""
    header = vda5050.Header(
        headerId=number,
        timestamp=moment,
        version=identity.version,  # type: ignore[arg-type]  # an identity has a known one
        manufacturer=identity.manufacturer,
        serialNumber=identity.serial_number,
    )
    return json.dumps(vda5050.write_message(body, header), separators=(",", ":")).encode()


def _read(model: type[_AnyBody], letter: Letter) -> _AnyBody:
    """Return the content of a letter."""
    if isinstance(letter.body, model):
        return letter.body
    return vda5050.read(model, _parse_document(letter.payload), letter.name)


def _refuse_header(document: Mapping[str, Any], identity: Identity, name: str) -> None:
    """Refuse a message with a header of another robot than that of its topic.

    Keys may be missing; a topic has the first number of the version.
    """
    expected = {
        "manufacturer": identity.manufacturer,
        "serialNumber": identity.serial_number,
        "version": identity.version[0],
    }
    for key, value in expected.items():
        given = document.get(key, value)
        said = str(given).partition(".")[0] if key == "version" else given
        if said != value:
            message = f"{quote(given)} contradicts the topic, {quote(value)} (correct the sender)"
            raise InputError.at((name, key), message)


def _parse_document(payload: bytes) -> dict[str, Any]:
    """Return a payload as JSON has it."""
    if len(payload) > LONGEST_MESSAGE:
        message = f"has {len(payload)} bytes (the sender has to send {LONGEST_MESSAGE} at most)"
        raise InputError.at("message", message)
    try:
        document = json.loads(payload)
    except (ValueError, RecursionError) as error:
        message = (
            f"{quote(payload[:200].decode(errors='replace'))} is no JSON"
            " (the sender has to send it)"
        )
        raise InputError.at("message", message) from error
    if not isinstance(document, dict):
        message = f"{quote(document)} is no JSON object (the sender has to send one)"
        raise InputError.at("message", message)
    return document
