"""Routes without an end: a robot's laps one behind the other."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.homes import avoid_homes
from rightofway.errors import InputError, InputFault
from rightofway.model import Lap, Robot, Route, Scenario, Tick, VertexId, lap_of
from rightofway.planners.routing import clear_routes, direct_routes, shortest_routes
from rightofway.search import Distances

__all__ = ["CyclicRoute", "clear_and_direct", "cyclic_routes"]


@dataclass(frozen=True, slots=True, kw_only=True)
class CyclicRoute:
    """The visits of a robot that makes lap after lap, numbered from 0.

    Attributes
    ----------
    robot
        Its number in the scenario.
    lap
        What it repeats.
    first_least
        The least ticks of visit 0: nobody turns at home before the first lap.
    """

    robot: int
    lap: Lap
    first_least: Tick
    _within: tuple[int, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_within", tuple(accumulate(self.lap.leasts(), initial=0)))

    def place(self, visit: int) -> int:
        """Return the place of a visit in the lap."""
        return visit % len(self.lap)

    def vertex(self, visit: int) -> VertexId:
        """Return where a visit is."""
        return self.lap.vertices[self.place(visit)]

    def drive(self, visit: int) -> Tick:
        """Return the ticks of the edge driven into a visit."""
        return self.lap.drive[self.place(visit)]

    def least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's."""
        return self.lap.least(self.place(visit)) if visit else self.first_least

    def leasts(self, visits: range) -> NDArray[np.int64]:
        """Return the least ticks of visits one behind the other."""
        numbers = np.arange(visits.start, visits.stop)
        least = np.diff(np.array(self._within, np.int64))[numbers % len(self.lap)]
        return np.where(numbers > 0, least, self.first_least)

    def free(self, visits: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return when visits begin if nobody is ever in the way [ticks]."""
        laps, places = np.divmod(visits, len(self.lap))
        within = np.array(self._within, np.int64)
        later = laps * within[-1] + within[places] - within[1] + self.first_least
        return np.where(visits > 0, later, 0)

    def free_from(self, visits: range) -> NDArray[np.int64]:
        """Return the same of visits one behind the other."""
        laps = np.arange(visits.start // len(self.lap), -(-visits.stop // len(self.lap)))
        within = np.array(self._within, np.int64)
        later: NDArray[np.int64] = (laps[:, None] * within[-1] + within[:-1]).ravel()
        begins = self.place(visits.start)
        free: NDArray[np.int64] = later[begins : begins + len(visits)] - within[1]
        free += self.first_least
        if visits.start == 0:
            free[:1] = 0
        return free

    def lasting(self, visit: int, ticks: int) -> int:
        """Return how many visits from a later one than 0 on last that long at least."""
        place = self.place(visit)
        laps, rest = divmod(self._within[place] + ticks, self.lap.duration)
        return laps * len(self.lap) + bisect_left(self._within, rest) - place

    def stretch(self, visits: range) -> tuple[list[VertexId], list[Tick], list[Tick]]:
        """Return vertices, dwells and drives of visits one behind the other."""
        place, times = self.place(visits.start), len(visits) // len(self.lap) + 2
        part = slice(place, place + len(visits))
        lap = self.lap
        return (
            list((lap.vertices * times)[part]),
            list((lap.dwell * times)[part]),
            list((lap.drive * times)[part]),
        )


def cyclic_routes(scenario: Scenario, routes: str = "clear") -> list[CyclicRoute]:
    """Choose a round trip for each robot, once and for all laps.

    Parameters
    ----------
    scenario
        The problem; how many laps it asks for plays no part.
    routes
        ``clear`` or ``shortest``, as planners choose them, or ``direct``: clear of others only as
        much as they are there when all make lap after lap. Clear and direct ones lead past no other
        home where that would bar two robots' way for good.

    Raises
    ------
    InputError
        If a robot does not come home, or never leaves it.
    NoPlanExists
        If a robot cannot get to a place.
    """
    if routes == "direct":
        return clear_and_direct(scenario)[1]
    once = _one_lap_each(scenario)
    distances = _distances(once)
    if routes == "clear":
        found = avoid_homes(once, clear_routes(once, distances))
    else:
        found = shortest_routes(once, distances)
    return _endless(once, found)


def clear_and_direct(scenario: Scenario) -> tuple[list[CyclicRoute], list[CyclicRoute]]:
    """Choose clear round trips and direct ones for each robot; see `cyclic_routes`."""
    once = _one_lap_each(scenario)
    distances = _distances(once)
    clear = avoid_homes(once, clear_routes(once, distances))
    direct = avoid_homes(once, direct_routes(once, distances, clear))
    return _endless(once, clear), _endless(once, direct)


def _distances(once: Scenario) -> Distances:
    """Return the tables that all routes need."""
    distances = Distances(once.roadmap)
    itineraries = once.problem.itineraries
    distances.prepare((stage.vertex, one.edge_ticks) for one in itineraries for stage in one.stages)
    return distances


def _endless(once: Scenario, routes: Sequence[Route]) -> list[CyclicRoute]:
    return [
        CyclicRoute(
            robot=robot,
            lap=lap_of(once.problem.itineraries[robot], route),
            first_least=route.least(0),
        )
        for robot, route in enumerate(routes)
    ]


def _one_lap_each(scenario: Scenario) -> Scenario:
    faults = [
        fault.within(f"robots[{index}]")
        for index, robot in enumerate(scenario.robots)
        for fault in _faults(robot, scenario)
    ]
    if faults:
        raise InputError(faults)
    robots = tuple(replace(robot, laps=1) for robot in scenario.robots)
    return replace(scenario, robots=robots)


def _faults(robot: Robot, scenario: Scenario) -> Iterator[InputFault]:
    if (robot.ends or scenario.rules.ends) == "none":
        yield InputFault("return", "'none' leaves nothing to repeat (set return: home)")
    if all(stop.at == robot.home for stop in robot.stops):
        home = scenario.roadmap.name(robot.home)
        yield InputFault("stops", f"all are at its home {home} (let it go somewhere)")
