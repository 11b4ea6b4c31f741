"""Messages with null in optional fields are read as those without these fields."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from copy import deepcopy
from typing import Any

from hypothesis import strategies as st

from rightofway.control.conformance import find_schema
from rightofway.control.endpoints import RobotEnd
from rightofway.control.identities import VERSIONS, Identity
from rightofway.control.messages import Condition, Load, Order, RobotError
from rightofway.control.order_map import OrderMap
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.control.stop_actions import ActionToDo
from rightofway.control.vda5050 import (
    Body,
    ConnectionMessage,
    Factsheet,
    Header,
    OrderMessage,
    StateMessage,
    read,
    write_message,
)
from rightofway.model import StopAction
from tests.builders.laws import law
from tests.builders.plans import door

ORDER = Order.of_document(
    {
        "robot": 0,
        "order_id": "o",
        "update_id": 0,
        "nodes": [
            {"place": "N0", "sequence_id": 0, "actions": ["a"]},
            {"place": "N1", "sequence_id": 2, "actions": ["b"]},
        ],
    }
)

# The schema of instant actions of 2.0.0 requires nothing at all.
MODELS: dict[str, type[Body]] = {
    "order": OrderMessage,
    "state": StateMessage,
    "connection": ConnectionMessage,
    "factsheet": Factsheet,
}


def make_message(version: str, topic: str) -> dict[str, Any]:
    """Return a message with as many fields as this project writes."""
    identity = Identity(manufacturer="ACME", serial_number="A-001", version=version)
    robot = SimulatedRobot("N0")
    end = RobotEnd(robot, 0, identity, lambda: "2026-01-31T12:00:00.000Z")
    task = ActionToDo(action=StopAction(action="scan", parameters={"near": 1}))  # type: ignore[arg-type]
    order_map = OrderMap(door().scenario, 0, identity)
    order = OrderMessage.of(ORDER, order_map, {"a": "job0"}, {"b": task.to_document()})
    if topic == "state":
        robot.take_order(ORDER)
        robot.loads.append(Load(load_id="L"))
        error = RobotError(kind="blocked", level="FATAL", description="a box")
        end.condition = Condition(errors=(error,))
        end._keep_order(order)
    written: dict[str, Callable[[], Any]] = {
        "state": end.report_state,
        "connection": lambda: end.report_connection("ONLINE"),
        "factsheet": end.report_factsheet,
    }
    if topic in written:
        document: dict[str, Any] = json.loads(written[topic]().payload)
        return document
    header = Header(headerId=0, timestamp="", version=version,  # type: ignore[arg-type]
                    manufacturer="ACME", serialNumber="A-001")  # fmt: skip
    return write_message(order, header)


def list_optional(
    value: Any, schema: dict[str, Any], root: dict[str, Any], steps: tuple[Any, ...] = ()
) -> Iterator[tuple[Any, ...]]:
    """Yield the paths of all fields of a message that its schema does not require."""
    while "$ref" in schema:
        known: Any = root
        for step in schema["$ref"].removeprefix("#/").split("/"):
            known = known[step]
        schema = known
    if isinstance(value, list):
        for index, item in enumerate(value):
            yield from list_optional(item, schema.get("items", {}), root, (*steps, index))
    elif isinstance(value, dict):
        for key, own in schema.get("properties", {}).items():
            if key not in schema.get("required", ()):
                yield (*steps, key)
            if key in value:
                yield from list_optional(value[key], own, root, (*steps, key))


def replace_fields(document: Any, paths: list[tuple[Any, ...]], *, drops: bool) -> Any:
    """Return a message in which fields are null, or are dropped."""
    changed = deepcopy(document)
    for path in sorted(paths, key=len, reverse=True):
        owner = changed
        for step in path[:-1]:
            owner = owner[step]
        if drops:
            owner.pop(path[-1], None)
        else:
            owner[path[-1]] = None
    return changed


@law(st.sampled_from(VERSIONS), st.sampled_from(sorted(MODELS)), st.randoms(use_true_random=False))
def test_null_in_optional_fields_is_read_as_if_they_were_missing(
    version: str, topic: str, draw: Any
) -> None:
    schema = find_schema(version, topic)
    document = make_message(version, topic)
    if schema is None:  # version 2.0.0 has no schema of the factsheet: its fields are those of 2.1
        schema = find_schema("2.1.0", topic)
    assert schema is not None
    root: Any = schema.schema
    optional = list(list_optional(document, root, root))
    share = draw.random()
    chosen = [path for path in optional if draw.random() < share]
    model = MODELS[topic]
    nulled = read(model, replace_fields(document, chosen, drops=False), topic)
    missing = read(model, replace_fields(document, chosen, drops=True), topic)
    if isinstance(nulled, StateMessage) and isinstance(missing, StateMessage):
        assert nulled.to_robot_state() == missing.to_robot_state()
    else:
        assert nulled == missing
