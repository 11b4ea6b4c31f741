"""Places of new jobs in the work of robots: where a job is least out of the way of one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from rightofway.control.ledger import Ledger
from rightofway.facts import Fact
from rightofway.model import Scenario
from rightofway.resume.rest_of_fleet import StopToMake
from rightofway.search import Distances
from rightofway.site import VertexId

__all__ = ["Detours", "list_neighbours"]

UNREACHABLE = 10**12
"""More than any way [ticks]."""


class Detours:
    """Detours of robots to a place between two of their stops.

    Parameters
    ----------
    scenario
        The fleet.
    ledger
        The state that the journal describes.
    """

    def __init__(self, scenario: Scenario, ledger: Ledger) -> None:
        self._scenario, self._ledger = scenario, ledger
        self._distances = Distances(scenario.roadmap)

    def find_least(
        self, robots: Iterable[int], stops: Sequence[Sequence[StopToMake]], at: str
    ) -> tuple[int, int]:
        """Return the robot with the least detour, and the stop before which it is made.

        Parameters
        ----------
        robots
            Numbers of robots.
        stops
            The stops that each robot of the fleet still has to make.
        at
            The name of a vertex.
        """
        _, index, robot = min((*self._measure(robot, stops[robot], at), robot) for robot in robots)
        return robot, index

    def _measure(self, robot: int, stops: Sequence[StopToMake], at: str) -> tuple[int, int]:
        """Return how much longer a robot drives for a job at best, and before which stop."""
        own, roadmap = self._ledger.robots[robot], self._scenario.roadmap
        stations = [
            own.route.get_place(own.released),
            *(stop.place for stop in stops),
            own.route.places[-1],
        ]
        vertices = [roadmap.get_vertex(place) for place in stations]
        vertex = roadmap.get_vertex(at)
        return min(
            (
                self._measure_way(robot, before, vertex)
                + self._measure_way(robot, vertex, after)
                - self._measure_way(robot, before, after),
                index,
            )
            for index, (before, after) in enumerate(pairwise(vertices))
        )

    def _measure_way(self, robot: int, start: int, end: int) -> int:
        itinerary = self._scenario.problem.itineraries[robot]
        ticks = int(self._distances.to(VertexId(end), itinerary.edge_ticks)[start])
        return ticks if ticks >= 0 else UNREACHABLE


def list_neighbours(
    ledger: Ledger, robot: int, stops: Sequence[StopToMake], index: int
) -> tuple[Fact, ...]:
    """Return the jobs of a robot before and after one of its stops.

    Parameters
    ----------
    ledger
        The state that the journal describes.
    robot
        Its number.
    stops
        The stops that it still has to make.
    index
        One of them.
    """
    own, name = ledger.robots[robot], ledger.names[robot]
    route = own.route
    released = [
        (route.get_place(visit), job)
        for visit in range(own.arrived, own.released + 1)
        for job in route.get_jobs(visit)
        if job not in own.finished
    ]
    jobs_of_stops = [(stop.place, stop.job) for stop in stops if stop.job]
    before = sum(bool(stop.job) for stop in stops[:index])
    earlier, later = [*released, *jobs_of_stops[:before]], jobs_of_stops[before + 1 :]
    return tuple(
        Fact(kind, job=f"{name}/{job}", place=place)
        for kind, rows in (("after job", earlier[-1:]), ("before job", later[:1]))
        for place, job in rows
    )
