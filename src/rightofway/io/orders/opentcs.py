"""Transport orders of openTCS: JSON of its web API, and XML of its older host interface.

JSON is what ``GET /v1/transportOrders`` returns, a list of orders; or the body of ``POST
/v1/transportOrders/NAME``, one or several by their names. XML is a ``tcsOrderSet``.

A destination is a location or a point. Operations that load or unload change the load by 1, and the
robot does its usual action for loads, or that of the place; other operations are its actions.
Orders of one sequence are done in turn. Orders that are done or failed are left out, as are those
to park and to charge; of an order in work, the destinations that are left.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rightofway.io.layouts.opentcs import is_work
from rightofway.io.layouts.xml_tree import Element
from rightofway.io.orders.draft import (
    ForeignOrder,
    OrderFile,
    OrderStop,
    balance_loads,
    read_instant,
)
from rightofway.io.source import Source
from rightofway.model.actions import find_load_change

NO_TYPES = {"-", "*"}
"""Types of orders for any robot."""

IDLE_TYPES = {"Charge", "Park"}
"""Types of orders that are no work."""

ENDED = {"FINISHED", "FAILED", "UNROUTABLE", "WITHDRAWN"}
"""States of orders that nobody does any more."""


def recognizes(data: Any) -> bool:
    """Return whether plain data are orders: with destinations, or drive orders."""
    return any(
        isinstance(order, dict) and ("destinations" in order or "driveOrders" in order)
        for order in _list_values(data)[:1]
    )


def _list_values(data: Any) -> Sequence[Any]:
    if isinstance(data, list):
        return data
    is_one = not isinstance(data, dict) or "destinations" in data or "driveOrders" in data
    return [data] if is_one else list(data.values())


def read_json(data: Any, stem: str) -> OrderFile:
    """Return the orders of JSON data; ``stem`` is the name of an order without one."""
    file, source = OrderFile(), Source(data)
    sequences: dict[str, str] = {}
    for name, order in _list_orders(source, stem):
        file.faults.attempt("", _read_order, name, order, file, sequences)
    return file


def _list_orders(source: Source, stem: str) -> Iterator[tuple[str | None, Source]]:
    """Yield orders, each with its name in the file if it has one outside of itself."""
    if isinstance(source.value, list):
        yield from ((None, order) for order in source.read_items())
    elif len(_list_values(source.value)) == 1 and recognizes([source.value]):
        yield stem, source
    else:
        yield from source.read_entries()


def _read_order(
    given: str | None, order: Source, file: OrderFile, sequences: dict[str, str]
) -> None:
    named = order.get("name") if given else order.need("name")
    name = named.read_text() if named else str(given)
    if _is_left_out(order, name, file):
        return
    job = ForeignOrder(source=order, name=name, stops=list(_list_stops(order)))
    if not job.stops:
        file.leave_out(name, "order without destinations")
        return
    creation, due = order.get("creationTime"), order.get("deadline")
    job.known = read_instant(creation) if creation else None
    if due:
        job.due, job.keys["due"] = read_instant(due), due
    vehicle = order.get("processingVehicle", "intendedVehicle")
    if vehicle:
        job.robot, job.keys["robot"] = vehicle.read_text(), vehicle
    kind = order.get("type")
    if kind and kind.read_text() not in NO_TYPES:
        job.kind, job.keys["kind"] = kind.read_text(), kind
    dependencies = order.get("dependencies")
    if dependencies:
        job.after = [item.read_text() for item in dependencies.read_items()]
        job.keys["after"] = dependencies
    _follow_sequence(order.get("wrappingSequence"), job, sequences)
    balance_loads(job, file)
    file.orders.append(job)


def _is_left_out(order: Source, name: str, file: OrderFile) -> bool:
    state, kind = order.get("state"), order.get("type")
    if state and state.read_text() in ENDED:
        file.leave_out(name, "order has ended")
    elif kind and kind.read_text() in IDLE_TYPES:
        file.leave_out(name, "order is no work")
    else:
        return False
    return True


def _list_stops(order: Source) -> Iterator[OrderStop]:
    """Yield the destinations that are not done yet."""
    drives = order.get("destinations", "driveOrders")
    for drive in drives.read_items() if drives else ():
        state, inner = drive.get("state"), drive.get("destination")
        if state and state.read_text() in ENDED:
            continue
        target = inner if inner and isinstance(inner.value, dict) else drive
        place = target.need("locationName", "destination")
        operation = target.get("operation")
        yield _make_stop(place, operation.read_text() if operation else "")


def _make_stop(place: Source, operation: str) -> OrderStop:
    place.read_text()
    load = find_load_change(operation)
    actions = (operation,) if is_work(operation) and not load else ()
    return OrderStop(at=place, load=load, actions=actions)


def _follow_sequence(sequence: Source | None, job: ForeignOrder, sequences: dict[str, str]) -> None:
    """Let an order begin after the order before it in its sequence."""
    if sequence is None:
        return
    before = sequences.get(sequence.read_text())
    if before is not None and before not in job.after:
        job.after.append(before)
        job.keys.setdefault("after", sequence)
    sequences[sequence.read_text()] = job.name


def recognizes_xml(root: Element) -> bool:
    """Return whether an XML file is a set of orders."""
    return root.name == "tcsOrderSet"


def read_xml(root: Element) -> OrderFile:
    """Return the orders of a set."""
    file = OrderFile()
    for number, order in enumerate(root.list_all("order"), 1):
        file.faults.attempt("", _read_element, order, number, file)
    return file


def _read_element(order: Element, number: int, file: OrderFile) -> None:
    named = order.get("id")
    name = named.read_text() if named else f"order {number}"
    job = ForeignOrder(source=order, name=name)
    for destination in order.list_all("destination"):
        operation = destination.get("operation")
        place = destination.need("locationName")
        job.stops.append(_make_stop(place, operation.read_text() if operation else ""))
    if not job.stops:
        file.leave_out(name, "order without destinations")
        return
    due, vehicle = order.get("deadline"), order.get("intendedVehicle")
    if due:
        job.due, job.keys["due"] = read_instant(due), due
    if vehicle:
        job.robot, job.keys["robot"] = vehicle.read_text(), vehicle
    job.after = [dependency.content.strip() for dependency in order.list_all("dependency")]
    job.keys |= dict.fromkeys(["after"] if job.after else [], order)
    balance_loads(job, file)
    file.orders.append(job)
