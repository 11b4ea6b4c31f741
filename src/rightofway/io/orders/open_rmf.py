"""Task requests of Open-RMF, JSON: dispatched to any robot, or to one, or as they are.

Categories of tasks: ``delivery``, ``patrol``, ``clean``, and ``compose`` of phases with the
activities ``go_to_place``, ``pickup``, ``dropoff``, ``clean``, ``perform_action`` and ``sequence``.
A pickup loads 1, and a dropoff unloads 1; the last one unloads all that is left. An action is work
at the place where the robot is, for as long as it is estimated to take.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from rightofway.errors import quote
from rightofway.io.orders.draft import ForeignOrder, OrderFile, OrderStop, balance_loads
from rightofway.io.source import Source

REQUESTS = ("dispatch_task_request", "robot_task_request")
"""Types of messages that contain a request."""

URGENT = Fraction(10)
"""The weight of a task whose binary priority is 1."""

LATEST = 10**15
"""Milliseconds of an instant or of an action, at most."""

MOST_STOPS = 10_000
"""Stops of a task, at most."""


def recognizes(data: Any) -> bool:
    """Return whether plain data are requests: messages of these types, or tasks as such."""
    first = data[0] if isinstance(data, list) and data else data
    if not isinstance(first, dict):
        return False
    return first.get("type") in REQUESTS or {"category", "description"} <= first.keys()


def read_json(data: Any) -> OrderFile:
    """Return the orders of one request, or of a list of them; names are made of categories."""
    file, source, counts = OrderFile(), Source(data), Counter[str]()
    items = source.read_items() if isinstance(data, list) else [source]
    for item in items:
        file.faults.attempt("", _read_request, item, file, counts)
    return file


def _read_request(item: Source, file: OrderFile, counts: Counter[str]) -> None:
    kind = item.get("type")
    if kind and kind.value not in REQUESTS:
        raise kind.make_fault(f"{quote(kind.value)} is no request (give {' or '.join(REQUESTS)})")
    request = item.need("request") if kind else item
    category = request.need("category").read_text()
    description = request.need("description")
    title = description.get("category") if category == "compose" else None
    noun = title.read_text() if title else category
    counts[noun] += 1
    order = ForeignOrder(source=item, name=f"{noun} {counts[noun]}")
    _read_times(request, order)
    priority = request.get("priority")
    if priority:
        order.weight = _read_weight(priority)
    robot = item.get("robot") if kind else None
    if robot:
        order.robot, order.keys["robot"] = robot.read_text(), robot
    _read_activity(request, category, description, order)
    if not order.stops:
        raise description.make_fault("has no place to go to (give one)")
    _unload_the_rest(order)
    balance_loads(order, file)
    file.orders.append(order)


def _read_times(request: Source, order: ForeignOrder) -> None:
    requested = request.get("unix_millis_request_time")
    begins = request.get("unix_millis_earliest_start_time")
    if requested:
        order.known = Fraction(requested.read_whole(0, LATEST), 1000)
    if begins:
        order.earliest = Fraction(begins.read_whole(0, LATEST), 1000)
        order.keys["earliest"] = begins


def _read_weight(priority: Source) -> Fraction:
    """Return the weight of a priority: of the type binary, or one that grows from 0 on."""
    kind, value = priority.need("type"), priority.need("value").read_whole(0, 10**6)
    return (URGENT if value else Fraction(1)) if kind.value == "binary" else Fraction(1 + value)


def _read_activity(owner: Source, category: str, description: Source, order: ForeignOrder) -> None:
    """Add the stops of a task or an activity."""
    read = _ACTIVITIES.get(category)
    if read is None:
        known = ", ".join(_ACTIVITIES)
        message = f"{quote(category)} is not read (known: {known})"
        raise owner.need("category").make_fault(message)
    read(description, order)
    if len(order.stops) > MOST_STOPS:
        raise owner.make_fault(f"it has more than {MOST_STOPS} stops (divide it)")


def _add_stop(place: Source, order: ForeignOrder, load: int = 0) -> None:
    """Add a stop at a place: a name, or a waypoint with an orientation."""
    waypoint = place.need("waypoint") if isinstance(place.value, dict) else place
    if not isinstance(waypoint.value, str):
        remedy = "give the name of the waypoint"
        raise waypoint.make_fault(f"{quote(waypoint.value)} is no name of a place ({remedy})")
    order.stops.append(OrderStop(at=waypoint, load=load))


def _go_to_place(description: Source, order: ForeignOrder) -> None:
    """Add the place to go to; of several to choose from, the first."""
    given = description
    if isinstance(given.value, dict) and "waypoint" not in given.value:
        given = given.need("place", "one_of")
    if isinstance(given.value, list):
        choices = given.read_items()
        if len(choices) != 1:
            message = f"has {len(choices)} places to choose from (give one: jobs have no choice)"
            raise given.make_fault(message)
        given = choices[0]
    _add_stop(given, order)


def _read_patrol(description: Source, order: ForeignOrder) -> None:
    rounds = description.get("rounds")
    places = description.need("places").read_items()
    for _ in range(rounds.read_whole(1, MOST_STOPS) if rounds else 1):
        for place in places if len(order.stops) <= MOST_STOPS else ():
            _add_stop(place, order)


def _read_delivery(description: Source, order: ForeignOrder) -> None:
    _add_stop(description.need("pickup").need("place"), order, 1)
    _add_stop(description.need("dropoff").need("place"), order, -1)


def _read_action(description: Source, order: ForeignOrder) -> None:
    """Add the estimated time of an action to the work at the last place."""
    end = description.get("expected_finish_location")
    takes = description.get("unix_millis_action_duration_estimate")
    if not order.stops and end is None:
        raise description.make_fault("has no place (give a go_to_place before it)")
    if not order.stops and end is not None:
        _add_stop(end, order)
    last = order.stops[-1]
    seconds = Fraction(takes.read_whole(0, LATEST), 1000) if takes else Fraction(0)
    last.work = (last.work or Fraction(0)) + seconds
    if end is not None and end.value not in (last.at.value, {"waypoint": last.at.value}):
        _add_stop(end, order)


def _read_sequence(description: Source, order: ForeignOrder) -> None:
    is_list = isinstance(description.value, list)
    activities = description if is_list else description.need("activities")
    for activity in activities.read_items():
        _read_activity(activity, activity.need("category").read_text(),
                       activity.need("description"), order)  # fmt: skip


def _read_phases(description: Source, order: ForeignOrder) -> None:
    for phase in description.need("phases").read_items():
        activity = phase.need("activity")
        category = activity.need("category").read_text()
        _read_activity(activity, category, activity.need("description"), order)


_ACTIVITIES: dict[str, Callable[[Source, ForeignOrder], None]] = {
    "delivery": _read_delivery,
    "patrol": _read_patrol,
    "clean": lambda description, order: _add_stop(description.need("zone"), order),
    "compose": _read_phases,
    "sequence": _read_sequence,
    "go_to_place": _go_to_place,
    "pickup": lambda description, order: _add_stop(description.need("place"), order, 1),
    "dropoff": lambda description, order: _add_stop(description.need("place"), order, -1),
    "perform_action": _read_action,
}
"""The readers of tasks and activities by category."""


def _unload_the_rest(order: ForeignOrder) -> None:
    """Let the last dropoff unload all that is left, and those without a load nothing."""
    load = 0
    last = None
    for stop in order.stops:
        if stop.load < 0:
            stop.load = -min(load, 1)
            last = stop
        load += stop.load
    if last is not None and load > 0:
        last.load -= load
