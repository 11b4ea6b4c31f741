"""A strict AGV at a broker: it has its own map and actions, and refuses all orders beyond them.

It is written from the norm alone, without the models of the package. What it refuses is kept in
`faults`, besides the error of its states: a control that it can drive with leaves none.
"""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot
from typing import Any

import paho.mqtt.client as paho
from paho.mqtt.enums import CallbackAPIVersion

from tests.builders.schemas import validator

__all__ = ["AgvMap", "StrictAgv"]

NEAR = 1e-3
"""How far a position may be from that of the map [m]."""

PAUSE = 0.02
"""Seconds for a drive or an action."""

INSTANT = {"stateRequest", "factsheetRequest", "cancelOrder", "startPause", "stopPause"}


@dataclass(frozen=True, slots=True, kw_only=True)
class AgvMap:
    """All that an AGV knows.

    Attributes
    ----------
    map_id
        The id of its map.
    nodes
        The position of each node in its frame [m].
    edges
        Ends of each edge, by its id.
    actions
        Types of its actions, with the names of the parameters that each must have.
    turned
        Nodes at which its actions need a heading, with it [rad].
    """

    map_id: str
    nodes: Mapping[str, tuple[float, float]]
    edges: Mapping[str, Sequence[tuple[str, str]]]
    actions: Mapping[str, frozenset[str]]
    turned: Mapping[str, float] = field(default_factory=dict)


class StrictAgv:
    """One AGV.

    Parameters
    ----------
    port
        Of the broker.
    identity
        Manufacturer, serial number and version of the norm.
    own_map
        Its map.
    node
        Where it is.
    has_nulls
        Whether its states have null in optional fields, as some AGVs write them.
    """

    def __init__(
        self,
        port: int,
        identity: tuple[str, str, str],
        own_map: AgvMap,
        node: str,
        *,
        has_nulls: bool = False,
    ) -> None:
        self.faults: list[str] = []
        self.done: list[tuple[str, str]] = []  # nodes and types of actions, as they ended
        self._manufacturer, self._serial, self._version = identity
        self._map, self._node, self._has_nulls = own_map, node, has_nulls
        self._order, self._update, self._sequence = "", 0, 0
        self._nodes: list[dict[str, Any]] = []  # of the order, the last node reached included
        self._edges: list[dict[str, Any]] = []
        self._end = ("", 0)  # id and sequence id of the last node of the base
        self._states: dict[str, dict[str, Any]] = {}
        self._is_driving, self._is_paused, self._errors = False, False, list[dict[str, Any]]()
        self._counts: dict[str, int] = {}
        self._lock, self._news = threading.RLock(), threading.Event()
        is_new = self._version >= "3"
        self._prefix = (
            f"{'vda5050/v3' if is_new else 'uagv/v2'}/{self._manufacturer}/{self._serial}"
        )
        self._client = paho.Client(CallbackAPIVersion.VERSION2)
        self._client.on_connect = self._connected
        self._client.on_message = self._heard
        self._client.connect("127.0.0.1", port)
        self._client.loop_start()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._drive, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End it."""
        self._ended.set()
        self._news.set()
        self._thread.join(5)
        self._client.disconnect()
        self._client.loop_stop()

    def _connected(self, client: paho.Client, *_: Any) -> None:
        client.subscribe([(f"{self._prefix}/{name}", 0) for name in ("order", "instantActions")])
        self._send("connection", {"connectionState": "ONLINE"}, qos=1, retain=True)
        self._report()

    def _send(self, topic: str, body: dict[str, Any], **options: Any) -> None:
        self._counts[topic] = self._counts.get(topic, -1) + 1
        now = time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime())
        document = {
            "headerId": self._counts[topic],
            "timestamp": f"{now}.000Z",
            "version": self._version,
            "manufacturer": self._manufacturer,
            "serialNumber": self._serial,
            **body,
        }
        self._client.publish(f"{self._prefix}/{topic}", json.dumps(document), **options)

    def _heard(self, _client: paho.Client, _data: Any, message: paho.MQTTMessage) -> None:
        topic = message.topic.rpartition("/")[2]
        take = self._take_order if topic == "order" else self._take_actions
        try:
            document = json.loads(message.payload)
            validator(self._version, topic).validate(document)
            own = (self._manufacturer, self._serial, self._version)
            keys = ("manufacturer", "serialNumber", "version")
            if tuple(document[key] for key in keys) != own:
                self._refuse("validationError", f"a message to another robot: {document}")
            with self._lock:
                take(document)
        except Exception as error:  # noqa: BLE001 (whatever it is, it is a fault)
            self.faults.append(f"{self._serial}: {topic}: {error}")

    def _refuse(self, kind: str, what: str) -> None:
        self.faults.append(f"{self._serial}: {kind}: {what}")
        self._errors = [{"errorType": kind, "errorLevel": "WARNING", "errorDescription": what}]

    def _take_order(self, order: dict[str, Any]) -> None:
        refused = next(self._list_refusals(order), None)
        if refused is not None:
            self._refuse(*refused)
        elif (order["orderId"], order["orderUpdateId"]) != (self._order, self._update):
            nodes, edges = order["nodes"], order["edges"]
            self._nodes = nodes if self._is_new(order) else [*self._nodes, *nodes[1:]]
            self._edges = edges if self._is_new(order) else [*self._edges, *edges]
            if self._is_new(order):
                self._states, self._sequence = {}, nodes[0]["sequenceId"]
            self._order, self._update = order["orderId"], order["orderUpdateId"]
            self._end = nodes[-1]["nodeId"], nodes[-1]["sequenceId"]
            for part in (*nodes, *edges):
                for action in part["actions"]:
                    self._states.setdefault(
                        action["actionId"],
                        {"actionId": action["actionId"], "actionStatus": "WAITING"},
                    )
        self._report()
        self._news.set()

    def _is_new(self, order: dict[str, Any]) -> bool:
        return bool(order["orderId"] != self._order)

    def _list_refusals(self, order: dict[str, Any]) -> Iterator[tuple[str, str]]:
        """Yield each reason to refuse an order, as the norm has them."""
        nodes, edges = order["nodes"], order["edges"]
        yield from self._list_refusals_of_place(order)
        first = nodes[0]
        numbers = [part["sequenceId"] for part in _zip_parts(nodes, edges)]
        if numbers != list(range(first["sequenceId"], first["sequenceId"] + len(numbers))):
            yield "validationError", f"sequence ids {numbers}"
        if first["sequenceId"] % 2 or len(edges) != len(nodes) - 1:
            yield "validationError", f"{len(nodes)} nodes and {len(edges)} edges from {numbers[0]}"
        for node in nodes:
            yield from self._list_refusals_of_node(node)
        for number, edge in enumerate(edges):
            ends = (nodes[number]["nodeId"], nodes[number + 1]["nodeId"])
            if ends not in self._map.edges.get(edge["edgeId"], ()):
                yield "validationError", f"no edge {edge['edgeId']} leads along {ends}"
            yield from self._list_refusals_of_actions(edge, "")
            yield from self._list_refusals_of_lane(edge)

    def _list_refusals_of_place(self, order: dict[str, Any]) -> Iterator[tuple[str, str]]:
        """Yield the reasons for which an order does not follow upon what came before."""
        first, update = order["nodes"][0], order["orderUpdateId"]
        if self._is_new(order):
            if self._is_busy():
                yield "orderError", "a new order while another one is not finished"
            if first["nodeId"] != self._node:
                yield "noRouteError", f"it begins at {first['nodeId']}, the AGV is at {self._node}"
        elif update < self._update:
            yield "orderUpdateError", f"update {update} after {self._update}"
        elif update > self._update and (first["nodeId"], first["sequenceId"]) != self._end:
            yield "orderUpdateError", f"it begins at {first}, the base ends at {self._end}"

    def _list_refusals_of_node(self, node: dict[str, Any]) -> Iterator[tuple[str, str]]:
        name, position = node["nodeId"], node.get("nodePosition")
        if name not in self._map.nodes:
            yield "validationError", f"no node {name}"
        elif not node["released"]:
            return
        elif position is not None:
            x, y = self._map.nodes[name]
            if position["mapId"] != self._map.map_id:
                yield "validationError", f"{name} on the map {position['mapId']}"
            if hypot(position["x"] - x, position["y"] - y) > NEAR:
                yield "validationError", f"{name} at {position}, and it is at {x}, {y}"
        if node["actions"] and name in self._map.turned:
            theta = (position or {}).get("theta")
            if theta is None or abs(theta - self._map.turned[name]) > NEAR:
                yield "validationError", f"theta {theta} at {name}"
        yield from self._list_refusals_of_actions(node, name)

    def _list_refusals_of_actions(
        self, part: dict[str, Any], name: str
    ) -> Iterator[tuple[str, str]]:
        for action in part["actions"]:
            needed = self._map.actions.get(action["actionType"])
            given = {own["key"] for own in action.get("actionParameters", ())}
            if needed is None or not name:
                yield "orderError", f"no action {action['actionType']} at {name or part['edgeId']}"
            elif not needed <= given:
                yield "orderError", f"{action['actionType']} without {needed - given}"

    def _list_refusals_of_lane(self, edge: dict[str, Any]) -> Iterator[tuple[str, str]]:
        speed: float = edge.get("maxSpeed", edge.get("maximumSpeed", 0.0))
        if not 0 < speed < 10:
            yield "validationError", f"a speed of {speed} on {edge['edgeId']}"

    def _take_actions(self, document: dict[str, Any]) -> None:
        for action in document["actions"]:
            kind = action["actionType"]
            if kind not in INSTANT:
                self._refuse("instantActionError", f"no instant action {kind}")
                continue
            if kind == "cancelOrder":
                self._nodes, self._edges = self._nodes[:1], []
            if kind.endswith("Pause"):
                self._is_paused = kind == "startPause"
            if kind != "stateRequest":
                own = {"actionId": action["actionId"], "actionStatus": "FINISHED"}
                self._states[action["actionId"]] = own
        self._report()
        self._news.set()

    def _is_busy(self) -> bool:
        ended = {"FINISHED", "FAILED"}
        return len(self._nodes) > 1 or any(
            state["actionStatus"] not in ended for state in self._states.values()
        )

    def _report(self) -> None:
        """Send a state."""
        left = self._nodes[1:]
        x, y = self._map.nodes[self._node]
        is_new = self._version >= "3"
        position = {"x": x, "y": y, "theta": self._map.turned.get(self._node, 0.0),
                    "mapId": self._map.map_id}  # fmt: skip
        charge = {"stateOfCharge" if is_new else "batteryCharge": 80.0, "charging": False}
        state = {
            "orderId": self._order,
            "orderUpdateId": self._update,
            "lastNodeId": self._node,
            "lastNodeSequenceId": self._sequence,
            "nodeStates": [_pick(node, "nodeId", "sequenceId", "released") for node in left],
            "edgeStates": [_pick(edge, "edgeId", "sequenceId", "released") for edge in self._edges],
            "actionStates": list(self._states.values()),
            "driving": self._is_driving,
            "paused": self._is_paused,
            "operatingMode": "AUTOMATIC",
            "errors": self._errors,
            "mobileRobotPosition" if is_new else "agvPosition": {
                **position, "localized" if is_new else "positionInitialized": True
            },
            "powerSupply" if is_new else "batteryState": charge,
            "safetyState": {
                "activeEmergencyStop" if is_new else "eStop": "NONE", "fieldViolation": False
            },
        }  # fmt: skip
        if is_new:
            state |= {"instantActionStates": [], "zoneActionStates": []}
        if self._has_nulls:
            optional = ("zoneSetId", "loads", "newBaseRequest", "distanceSinceLastNode", "velocity",
                        "information", "maps", "paused")  # fmt: skip
            state |= dict.fromkeys(optional)
        else:
            validator(self._version, "state").validate({**_HEADER, **state})
        self._send("state", state)

    def _drive(self) -> None:
        """Do what the order has: drive one edge or do one action at a time."""
        while not self._ended.is_set():
            self._news.wait(0.5)
            self._news.clear()
            while not self._ended.is_set() and self._do_next():
                pass

    def _do_next(self) -> bool:
        """Do the next step; return whether there was one."""
        with self._lock:
            if self._is_paused or not self._nodes:
                return False
            waiting = [
                action
                for action in self._nodes[0]["actions"]
                if self._states[action["actionId"]]["actionStatus"] == "WAITING"
            ]
            begin: Callable[[], None] = (
                (lambda: self._set(waiting[0], "RUNNING")) if waiting else self._set_out
            )
            if not waiting and len(self._nodes) == 1:
                return False
            begin()
            self._report()
        self._ended.wait(PAUSE)
        with self._lock:
            if waiting:
                self._set(waiting[0], "FINISHED")
                self.done.append((self._node, waiting[0]["actionType"]))
            elif len(self._nodes) > 1:
                self._nodes, self._edges = self._nodes[1:], self._edges[1:]
                self._node, self._sequence = (
                    self._nodes[0][key] for key in ("nodeId", "sequenceId")
                )
            self._is_driving = False
            self._report()
        return True

    def _set(self, action: dict[str, Any], status: str) -> None:
        self._states[action["actionId"]]["actionStatus"] = status

    def _set_out(self) -> None:
        self._is_driving = True


_HEADER = {"headerId": 0, "timestamp": "2026-11-28T06:00:00.000Z", "version": "2.1.0",
           "manufacturer": "any", "serialNumber": "any"}  # fmt: skip


def _pick(part: dict[str, Any], *keys: str) -> dict[str, Any]:
    return {key: part[key] for key in keys}


def _zip_parts(
    nodes: Sequence[dict[str, Any]], edges: Sequence[dict[str, Any]]
) -> Iterator[dict[str, Any]]:
    """Yield nodes and edges in turn."""
    for number, node in enumerate(nodes):
        yield node
        if number < len(edges):
            yield edges[number]
