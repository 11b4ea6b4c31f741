"""Plans as transport orders of openTCS: each job is an order for the vehicle of its robot.

JSON has for each name of an order the body of ``POST /v1/transportOrders/NAME``. A vehicle does the
orders of its tour in turn, so each order depends on the one before it; and a job on those that it
is `after`. Without jobs, the trip of each robot is an order. Times are left to the kernel.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rightofway.io.json_text import format_json_line
from rightofway.model import Plan
from rightofway.site import VertexId

LOAD, UNLOAD = "Load cargo", "Unload cargo"
"""Operations of vehicles, as the demonstration plant of openTCS has them."""

AT_LOCATION, AT_POINT = "NOP", "MOVE"
"""Operations of vehicles that do nothing there."""

Stops = Sequence[tuple[VertexId, int]]
"""Vertices, each with the change of load there."""


def write_orders(plan: Plan) -> str:
    """Return the transport orders of a plan as JSON, one on a line."""
    orders = _list_orders_of_jobs(plan) if plan.tours is not None else _list_orders_of_trips(plan)
    lines = (f"  {format_json_line(name)}: {format_json_line(body)}" for name, body in orders)
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _list_orders_of_trips(plan: Plan) -> list[tuple[str, dict[str, Any]]]:
    return [
        (robot.name, _make_body(plan, [(stop.at, 0) for stop in robot.stops], robot.name, []))
        for robot in plan.scenario.robots
        if robot.stops
    ]


def _list_orders_of_jobs(plan: Plan) -> list[tuple[str, dict[str, Any]]]:
    """Return the orders of each robot in the order in which its jobs begin."""
    jobs, orders = plan.scenario.jobs or (), list[tuple[str, dict[str, Any]]]()
    served = {
        jobs[item.job].name for tour in plan.tours or () for item in tour if item.job is not None
    }
    for robot, tour in zip(plan.scenario.robots, plan.tours or (), strict=True):
        first = {item.job: item.stop for item in reversed(tour) if item.job is not None}
        before: list[str] = []
        for index in dict.fromkeys(item.job for item in tour if item.job is not None):
            job = jobs[index]
            stops = [(stop.at, stop.load) for stop in job.stops[first[index] or 0 :]]
            after = dict.fromkeys([*before, *(name for name in job.after if name in served)])
            orders.append((job.name, _make_body(plan, stops, robot.name, [*after])))
            before = [job.name]
    return orders


def _make_body(plan: Plan, stops: Stops, vehicle: str, after: list[str]) -> dict[str, Any]:
    roadmap = plan.scenario.roadmap
    locations = {vertex: name for name, vertex in roadmap.drawing.stations}
    destinations = []
    for at, load in stops:
        idle = AT_LOCATION if at in locations else AT_POINT
        operation = LOAD if load > 0 else UNLOAD if load < 0 else idle
        name = locations.get(at, roadmap.name(at))
        destinations.append({"locationName": name, "operation": operation})
    body = {"intendedVehicle": vehicle, "destinations": destinations}
    return body | ({"dependencies": after} if after else {})
