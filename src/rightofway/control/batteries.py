"""Batteries of robots on the floor: planned states of charge, and ways to charging places.

The measured charge of a state decides when a charge ends, and whether a robot still reaches a
charging place. No part is released because of it: it only holds releases back.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from heapq import heappop, heappush
from itertools import pairwise

from rightofway.dispatch import PlannedStep
from rightofway.model import Battery, PlannedItem, Scenario, Tick
from rightofway.site import VertexId

__all__ = ["FleetBatteries", "follow_charge"]

BEYOND = Fraction(2)
"""More than a full battery."""


class FleetBatteries:
    """The batteries of a fleet.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    """

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        known = dict(scenario.batteries)
        self.of_robot = [
            None if robot.battery is None else known[robot.battery] for robot in scenario.robots
        ]
        self._needs: dict[int, dict[int, Fraction]] = {}

    def find_need(self, robot: int, places: Sequence[str]) -> Fraction:
        """Return the least share with which a robot reaches a charging place; above 1 if none.

        Parameters
        ----------
        robot
            A robot with a battery.
        places
            The vertices that it holds, along which it drives first.
        """
        held = list(map(self._scenario.roadmap.get_vertex, places))
        vertices = [int(vertex) for vertex in self._scenario.roadmap.unfold_route(held)]
        need = self._measure_needs(robot).get(vertices[-1], BEYOND)
        for tail, head in pairwise(vertices):
            need += self._find_share(robot, tail, head) or 0
        return need

    def may_charge(self, robot: int, place: str) -> bool:
        """Return whether a robot has a battery and may charge it at a place."""
        if self.of_robot[robot] is None:
            return False
        return self._scenario.roadmap.get_vertex(place) in self._list_charging(robot)

    def _list_charging(self, robot: int) -> tuple[VertexId, ...]:
        work = self._scenario.problem.work
        assert work is not None, "a fleet with batteries has jobs"
        return work.robots[robot].charging

    def _measure_needs(self, robot: int) -> dict[int, Fraction]:
        """Return the least share from each vertex to a charging place, by Dijkstra's algorithm.

        Turns and other robots do not count.
        """
        if robot not in self._needs:
            into = self._list_edges_into(robot)
            place_of, charging = self._scenario.roadmap.list_place, self._list_charging(robot)
            least = {int(at): Fraction(0) for vertex in charging for at in place_of(vertex)}
            heap = [(share, vertex) for vertex, share in least.items()]
            while heap:
                share, vertex = heappop(heap)
                if share > least[vertex]:
                    continue
                for tail, more in into.get(vertex, ()):
                    if share + more < least.get(tail, share + more + 1):
                        least[tail] = share + more
                        heappush(heap, (least[tail], tail))
            self._needs[robot] = least
        return self._needs[robot]

    def _list_edges_into(self, robot: int) -> dict[int, list[tuple[int, Fraction]]]:
        roadmap, into = self._scenario.roadmap, dict[int, list[tuple[int, Fraction]]]()
        for tail in range(roadmap.n_vertices):
            for edge in range(int(roadmap.indptr[tail]), int(roadmap.indptr[tail + 1])):
                share = self._find_share_of_class(robot, int(roadmap.class_of_edge[edge]))
                if share is not None:
                    into.setdefault(int(roadmap.heads[edge]), []).append((tail, share))
        return into

    def _find_share(self, robot: int, tail: int, head: int) -> Fraction | None:
        roadmap = self._scenario.roadmap
        edges = roadmap.list_edges(VertexId(tail), VertexId(head))
        if not edges:
            return None
        return self._find_share_of_class(robot, int(roadmap.class_of_edge[edges[0]]))

    def _find_share_of_class(self, robot: int, number: int) -> Fraction | None:
        """Return what a drive along an edge of a class takes; None where it is barred."""
        battery, problem = self.of_robot[robot], self._scenario.problem
        ticks = problem.itineraries[robot].edge_ticks[number]
        if battery is None or ticks < 0:
            return None
        length = self._scenario.roadmap.edge_classes[number].length
        return battery.drive * length + battery.on * problem.clock.convert_to_time(ticks)


def follow_charge(
    scenario: Scenario,
    battery: Battery,
    vertices: Sequence[int],
    tour: Sequence[PlannedItem | PlannedStep],
    *,
    soc: Fraction,
    begin: Tick,
) -> Iterator[Fraction]:
    """Yield the planned state of charge at the end of each item of a tour.

    Parameters
    ----------
    scenario
        The problem.
    battery
        The battery of the robot.
    vertices
        The route.
    tour
        The items with their visits of the route, in order.
    soc, begin
        The state of charge when the robot is ready, from 0 to 1, and when that is [ticks].
    """
    roadmap, time = scenario.roadmap, scenario.problem.clock.convert_to_time
    visit, tick = 0, begin
    for item in tour:
        for tail, head in zip(
            vertices[visit : item.visit], vertices[visit + 1 : item.visit + 1], strict=True
        ):
            edge = roadmap.list_edges(VertexId(tail), VertexId(head))[0]
            soc -= battery.drive * roadmap.get_edge_class(edge).length
        soc -= battery.on * time(max(item.begin - tick, 0))
        lasts = time(item.end - item.begin)
        if item.job is None:
            soc = min(soc + battery.charge * lasts, Fraction(1))
        else:
            soc -= (battery.on + battery.work) * lasts
        visit, tick = item.visit, item.end
        yield soc
