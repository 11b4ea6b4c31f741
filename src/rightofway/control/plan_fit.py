"""Comparison of a robot with the orders that a plan has for it.

The orders are those of a run with simulated robots. The robot is known by a state and a factsheet
of its own, as a probe has them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import hypot
from typing import Any

from rightofway.control.conformance import get_list, get_mapping, read_position
from rightofway.control.demo import drive_demo
from rightofway.control.endpoints import (
    OWN_DEVIATION,
    Letter,
    compare_size,
    compare_speed,
)
from rightofway.control.identities import Identity
from rightofway.control.messages import LOOK_AHEAD
from rightofway.control.order_map import OrderMap
from rightofway.control.vda5050 import Factsheet, read
from rightofway.errors import InputError, escape_text
from rightofway.execution.probe_result import ProbeFinding, Verdict
from rightofway.facts import Fact
from rightofway.model import Plan

__all__ = ["PlanFit"]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanFit:
    """A robot of a plan, to be compared with the real one.

    Attributes
    ----------
    plan
        The plan.
    identities
        Of all its robots.
    robot
        The number of the robot.
    look_ahead
        The largest number of edges that a control releases ahead of it.
    """

    plan: Plan
    identities: Sequence[Identity]
    robot: int
    look_ahead: int = LOOK_AHEAD

    def compare(
        self, state: Mapping[str, Any], sheet: Mapping[str, Any] | None
    ) -> Iterator[ProbeFinding]:
        """Yield the findings: place, size, speed, nodes, base and actions.

        Parameters
        ----------
        state
            A state of the robot.
        sheet
            Its factsheet; None where it has sent none.
        """
        for verdict, fact in (
            *self._compare_place(state),
            *self._compare_sheet(sheet),
            *self._compare_orders(sheet or {}),
        ):
            yield ProbeFinding("plan", verdict, fact)

    def _compare_place(self, state: Mapping[str, Any]) -> Iterator[tuple[Verdict, Fact]]:
        """Compare node and position with the home of the robot."""
        scenario = self.plan.scenario
        home = scenario.roadmap.name(int(self.plan.tracks[self.robot].vertices[0]))
        node = state.get("lastNodeId")
        if node and node != home:
            yield "blocks", Fact("not at home", node=escape_text(str(node)), home=home)
        else:
            yield "ok", Fact("at home", home=home)
        order_map = OrderMap(scenario, self.robot, self.identities[self.robot])
        place, position = order_map.get_place(home), read_position(state)
        if place is None or position is None:
            return
        if position["mapId"] != place.map_id:
            yield "note", Fact("other map", given=position["mapId"], wanted=place.map_id)
            return
        x, y = place.point
        apart = round(hypot(position["x"] - x, position["y"] - y), 3)
        limit = OWN_DEVIATION if place.deviation is None else place.deviation
        kind: Verdict = "ok" if apart <= limit else "blocks"
        yield kind, Fact("apart from home", apart=apart, home=home, x=x, y=y, limit=limit)

    def _compare_sheet(self, sheet: Mapping[str, Any] | None) -> Iterator[tuple[Verdict, Fact]]:
        """Compare size and speed with those of the plan."""
        if sheet is None:
            return
        try:
            known = read(Factsheet, sheet, "factsheet")
        except InputError:
            return  # a finding of its own
        larger = compare_size(self.plan.scenario, self.robot, known)
        slower = compare_speed(self.plan.scenario, self.robot, known)
        if larger is not None:
            yield "blocks", larger
        if slower is not None:
            yield "note", slower
        if larger is None and slower is None:
            yield "ok", Fact("fits into plan")

    def _compare_orders(self, sheet: Mapping[str, Any]) -> Iterator[tuple[Verdict, Fact]]:
        """Compare nodes, lengths and actions of the orders with the abilities of the robot."""
        orders = list(self._list_orders())
        nodes = tuple(dict.fromkeys(node["nodeId"] for order in orders for node in order["nodes"]))
        yield "note", Fact("nodes to know", number=len(nodes), names=nodes)
        if pieces := tuple(name for name in nodes if name in self._list_pieces()):
            yield "note", Fact("pieces of lanes", names=pieces)
        yield from _compare_base(orders, sheet, self.look_ahead)
        features = get_mapping(sheet, "protocolFeatures")
        listed = {
            action.get("actionType")
            for key in ("agvActions", "mobileRobotActions")
            for action in get_list(features, key)
        }
        wanted = {
            action["actionType"]
            for order in orders
            for part in (*order["nodes"], *order["edges"])
            for action in part["actions"]
        }
        if wanted:
            yield "note", Fact("actions of plan", names=tuple(sorted(wanted)))
        if sheet and (unknown := wanted - listed):
            yield "note", Fact("actions of plan not listed", names=tuple(sorted(unknown)))

    def _list_pieces(self) -> set[str]:
        """Return the names of vertices between the pieces of a lane: no layout has them."""
        roadmap = self.plan.scenario.roadmap
        return {roadmap.name(int(joint)) for lane in roadmap.lanes for joint in lane.joints}

    def _list_orders(self) -> Iterator[dict[str, Any]]:
        """Yield the orders of the robot in a run with simulated robots, each update once."""
        topic, known = self.identities[self.robot].get_topic("order"), set[tuple[str, int]]()
        letters: list[Letter] = []
        drive_demo(self.plan, identities=self.identities, watch=letters.append)
        for letter in letters:
            if letter.topic != topic:
                continue
            order = json.loads(letter.payload)
            if (key := (order["orderId"], order["orderUpdateId"])) not in known:
                known.add(key)
                yield order


def _compare_base(
    orders: Sequence[Mapping[str, Any]], sheet: Mapping[str, Any], look_ahead: int
) -> Iterator[tuple[Verdict, Fact]]:
    """Compare the least length of a full base with the braking distance.

    The end of a base is where the robot stops unless more comes in time.
    """
    legs = _list_legs(orders)
    lengths = [length for leg in legs for length in leg]
    if not lengths:
        return
    spans = [
        sum(leg[first : first + look_ahead])
        for leg in legs
        for first in range(max(1, len(leg) - look_ahead + 1))
    ]
    least, most, shortest = (round(length, 3) for length in (min(spans), max(spans), min(lengths)))
    base = Fact("length of base", parts=look_ahead, least=least, most=most, shortest=shortest)
    yield "note", base
    physical = get_mapping(sheet, "physicalParameters")
    braking = physical.get("decelerationMax", physical.get("maximumDeceleration"))
    speeds = [
        speed
        for order in orders
        for edge in order["edges"]
        if (speed := edge.get("maxSpeed", edge.get("maximumSpeed"))) is not None
    ]
    if not isinstance(braking, int | float) or braking <= 0 or not speeds:
        return
    distance = round(max(speeds) ** 2 / (2 * braking), 3)
    if distance > least:
        yield "note", Fact("brakes before end", distance=distance, least=least)
    else:
        yield "ok", Fact("base longer than braking", distance=distance)


def _list_legs(orders: Sequence[Mapping[str, Any]]) -> list[list[float]]:
    """Return the lengths of edges up to each stop [m]: no base leads beyond work to be done."""
    legs: list[list[float]] = [[]]
    for order in orders:
        for edge, node in zip(order["edges"], order["nodes"][1:], strict=True):
            legs[-1].append(edge.get("length", 0.0))
            if node["actions"]:
                legs.append([])
    return [leg for leg in legs if leg]
