"""An observer at a broker: what robots say they hold, and whether all messages are valid."""

from __future__ import annotations

import json
import threading
from collections import Counter
from functools import cache
from typing import Any

import paho.mqtt.client as paho
from jsonschema import Draft202012Validator
from paho.mqtt.enums import CallbackAPIVersion

from tests.builders.schemas import validator

__all__ = ["Observer"]

TOPICS = ("order", "instantActions", "state", "connection")

_validator = cache(validator)


def _schema(document: dict[str, Any], name: str) -> Draft202012Validator:
    return _validator(document["version"], name)


class Observer:
    """Listens to all that is said, and keeps what is wrong in `faults`.

    A robot holds, by its own words, the node that it was at last and all that it may still drive
    to. States come in the order in which the broker got them, so a place that two robots hold was
    given to one of them too early.

    Parameters
    ----------
    port
        Of the broker.
    validates
        Whether each message is held against the schema of its version.
    """

    def __init__(self, port: int, *, validates: bool = True) -> None:
        self.faults: list[str] = []
        self.counts = Counter[str]()
        self.finished = set[tuple[str, str]]()  # robots and what they have done
        self.orders: dict[tuple[str, str, int], Any] = {}
        self._held: dict[str, set[str]] = {}
        self._validates, self._lock = validates, threading.Lock()
        self._client = paho.Client(CallbackAPIVersion.VERSION2)
        self._client.on_connect = self._connected
        self._client.on_message = self._heard
        self._client.reconnect_delay_set(1, 1)
        self._client.connect("127.0.0.1", port)
        self._client.loop_start()

    def _connected(self, client: paho.Client, *_: Any) -> None:
        with self._lock:
            self._held.clear()  # what was said meanwhile is not known
        client.subscribe([(f"+/+/+/+/{name}", 0) for name in TOPICS])

    def _heard(self, _client: paho.Client, _data: Any, message: paho.MQTTMessage) -> None:
        robot, name = message.topic.split("/")[3:]
        try:
            document = json.loads(message.payload)
            with self._lock:
                self.counts[name] += 1
                if self._validates:
                    _schema(document, name).validate(document)
                if name == "state":
                    self._take_state(robot, document)
                if name == "order":
                    self._take_order(robot, document)
        except Exception as error:  # noqa: BLE001 (whatever it is, it is a fault)
            self.faults.append(f"{message.topic}: {error}")

    def _take_state(self, robot: str, document: dict[str, Any]) -> None:
        held = {document["lastNodeId"], *(node["nodeId"] for node in document["nodeStates"])}
        for other, theirs in self._held.items():
            if other != robot and held & theirs:
                self.faults.append(f"{robot} and {other} hold {sorted(held & theirs)}")
        self._held[robot] = held
        self.finished |= {
            (robot, action["actionId"].rpartition("-")[0])
            for action in document["actionStates"]
            if action["actionStatus"] == "FINISHED" and "-job" in action["actionId"]
        }

    def _take_order(self, robot: str, document: dict[str, Any]) -> None:
        key = (robot, document["orderId"], document["orderUpdateId"])
        content = (document["nodes"], document["edges"])
        if self.orders.setdefault(key, content) != content:
            self.faults.append(f"{key} has two contents")

    def close(self) -> None:
        """End it; raise what was wrong."""
        self._client.disconnect()
        self._client.loop_stop()
        assert self.faults == [], self.faults[:5]
