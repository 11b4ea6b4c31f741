"""Cyclic routes: one lap per robot, repeated for ever; groups of robots that share vertices."""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, chain

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import limit_loop, make_check
from rightofway.errors import InputError, InputFault
from rightofway.model import BookingRules, Lap, Robot, Route, Scenario, Tick, make_lap
from rightofway.native import BookedRows, list_excluded
from rightofway.precedence import CyclicSchedule, TimedEventGraph
from rightofway.precedence.rotations import FEWEST
from rightofway.repair.routing import (
    ROUTING,
    clear_routes,
    find_direct_routes,
    find_shortest_route,
    find_shortest_routes,
)
from rightofway.search import Distances
from rightofway.search.missing_ways import reaches_its_places
from rightofway.site import VertexId

NOTHING_REPEATS = "'none' leaves nothing to repeat (set return: home)"

ROUTES = ("clear", "direct", "shortest")
"""The choices of round trips; see `make_cyclic_routes`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CyclicRoute:
    """The visits of a robot that repeats one lap, numbered from 0.

    Attributes
    ----------
    robot
        The number of the robot in the scenario.
    lap
        The repeated lap.
    first_dwell
        The least duration of visit 0, without the drive that follows: no lap comes before, so the
        robot does not turn [ticks].
    """

    robot: int
    lap: Lap
    first_dwell: Tick
    _within: tuple[int, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_within", tuple(accumulate(self.lap.compute_leasts(), initial=0)))

    def __len__(self) -> int:
        return len(self.lap)

    @property
    def first_least(self) -> Tick:
        """The least duration of visit 0 with the drive that follows [ticks]."""
        return Tick(self.first_dwell + self.drive(1))

    def get_vertex(self, visit: int) -> VertexId:
        """Return the vertex of a visit."""
        return self.lap.vertices[visit % len(self.lap)]

    def drive(self, visit: int) -> Tick:
        """Return the duration of the drive into a visit [ticks]."""
        return self.lap.drive[visit % len(self.lap)]

    def compute_least(self, visit: int) -> Tick:
        """Return the least time from the enter of a visit to the enter of the next one [ticks]."""
        return self.lap.compute_least(visit % len(self.lap)) if visit else self.first_least

    def compute_undelayed(self, visits: range) -> NDArray[np.int64]:
        """Return the enters of visits of a robot that never waits [ticks]."""
        within, length = np.array(self._within, np.int64), len(self.lap)
        if visits.step == 1:
            laps = np.arange(visits.start // length, -(-visits.stop // length))
            place = visits.start % length
            free = laps[:, None] * within[-1] + within[:-1]
            enter: NDArray[np.int64] = free.ravel()[place : place + len(visits)]
        else:
            laps, places = np.divmod(np.arange(visits.start, visits.stop, visits.step), length)
            enter = laps * within[-1] + within[places]
        enter = enter - within[1] + self.first_least
        if visits.start == 0:
            enter[:1] = 0
        return enter

    def count_visits_lasting(self, visit: int, ticks: int) -> int:
        """Return the number of visits, from one after 0 on, that last ``ticks`` if unimpeded."""
        place = visit % len(self.lap)
        laps, rest = divmod(self._within[place] + ticks, self.lap.duration)
        return laps * len(self.lap) + bisect_left(self._within, rest) - place


@dataclass(frozen=True, slots=True, kw_only=True)
class GroupContext:
    """A group of robots that share vertices, directly or through others.

    Attributes
    ----------
    scenario
        The problem of the robots.
    routes
        The cyclic route of each robot of the group.
    is_apart
        Whether robots keep a headway by which they cannot rotate: only where rules forbid
        rotations, and the laps without this headway have one.
    """

    scenario: Scenario
    routes: tuple[CyclicRoute, ...]
    is_apart: bool = False

    def __len__(self) -> int:
        return len(self.routes)

    @property
    def robots(self) -> tuple[int, ...]:
        """The numbers of the robots in the scenario."""
        return tuple(route.robot for route in self.routes)

    @property
    def names(self) -> list[str]:
        """The names of the robots."""
        return [self.scenario.robots[route.robot].name for route in self.routes]

    @property
    def laps(self) -> list[Lap]:
        """The lap of each robot."""
        return [route.lap for route in self.routes]

    @property
    def longest(self) -> Tick:
        """The duration of the longest lap of the group without waiting [ticks]."""
        return max(lap.duration for lap in self.laps)

    @property
    def booking_rules(self) -> BookingRules:
        """When visits book: the rules to plan with."""
        rules = self.scenario.problem.booking_rules
        return rules.keep_apart() if self.is_apart else rules

    @property
    def might_rotate(self) -> bool:
        """Whether only the rules keep robots from rotating, and no headway does."""
        rules = self.booking_rules
        return rules != rules.keep_apart() and len(self) >= FEWEST

    def has_rotation(self, timetable: CyclicSchedule) -> bool:
        """Return whether robots rotate, against the rules, in the orders of a timetable.

        A circle of robots that hand over at one instant is a deadlock with any headway.
        """
        if not self.might_rotate:
            return False
        graph = replace(self, is_apart=True).build_graph(timetable)
        return graph.find_critical_circuit_if_live() is None

    def build_graph(self, timetable: CyclicSchedule) -> TimedEventGraph:
        """Return the timed event graph of laps of these robots."""
        return TimedEventGraph(
            timetable,
            rules=self.booking_rules,
            rows=BookedRows.of_laps(
                self.scenario.problem, timetable.robots, timetable.laps, timetable.counts
            ),
        )

    def list_booked(self, index: int, visit: int) -> tuple[int, ...]:
        """Return the rows that a visit books until its end: its vertex and the edge driven out."""
        route, resources = self.routes[index], self.scenario.problem.resources
        vertex, following = route.get_vertex(visit), route.get_vertex(visit + 1)
        edge = self.scenario.roadmap.find_edge(vertex, following)
        assert edge is not None, "laps lead along edges"
        return resources.get_vertex_row(route.robot, vertex), resources.get_edge_row(
            route.robot, edge
        )

    def list_excluding(self, index: int, visit: int) -> tuple[int, ...]:
        """Return the rows of other robots that keep a robot from the drive into a visit."""
        resources = self.scenario.problem.resources
        row, edge = self.list_booked(index, visit)[0], self.list_booked(index, visit - 1)[1]
        return (*list_excluded(resources, row), *list_excluded(resources, edge))

    @property
    def reach(self) -> int:
        """The time before a cut that a window includes, for bookings of left vertices [ticks]."""
        rules, longest = self.booking_rules, max(max(lap.drive) for lap in self.laps)
        return 1 + rules.follow(rules.end(0), longest)


def make_cyclic_routes(scenario: Scenario, routes: str = "clear") -> list[CyclicRoute]:
    """Choose the round trip of each robot, for all its laps.

    Parameters
    ----------
    scenario
        The problem; its number of laps is not used.
    routes
        ``clear`` or ``shortest``: as in the planners. ``direct``: clear of other robots in
        proportion to the frequency of their passes in repeated laps. Clear and direct routes avoid
        the homes of other robots if two robots would otherwise block each other permanently.

    Returns
    -------
    list of CyclicRoute
        One for each robot of the scenario.

    Raises
    ------
    InputError
        If a robot does not return home, or never leaves it.
    NoPlanExists
        If a robot cannot reach a place.
    """
    if routes == "direct":
        return clear_and_direct(scenario)[1]
    once, distances = _make_one_lap_each(scenario)
    if routes == "clear":
        return _repeat(once, avoid_homes(once, clear_routes(once, distances)))
    return _repeat(once, find_shortest_routes(once, distances))


def clear_and_direct(scenario: Scenario) -> tuple[list[CyclicRoute], list[CyclicRoute]]:
    """Choose a clear and a direct round trip for each robot; see `make_cyclic_routes`."""
    once, distances = _make_one_lap_each(scenario)
    clear = avoid_homes(once, clear_routes(once, distances))
    direct = avoid_homes(once, find_direct_routes(once, distances, clear))
    return _repeat(once, clear), _repeat(once, direct)


def _make_one_lap_each(scenario: Scenario) -> tuple[Scenario, Distances]:
    """Return the scenario with one lap for each robot, and its distance tables."""
    scenario = take_out_closed_places(scenario)
    if scenario.rules.ends == "none" and all(robot.ends != "home" for robot in scenario.robots):
        raise InputError.at(("rules", "return"), NOTHING_REPEATS)
    faults = [
        fault.nest(("robots", index))
        for index, robot in enumerate(scenario.robots)
        for fault in _find_faults(robot, scenario)
    ]
    if faults:
        raise InputError(faults)
    once = replace(scenario, robots=tuple(replace(robot, laps=1) for robot in scenario.robots))
    distances = Distances(once.roadmap, checkpoint=make_check(ROUTING))
    itineraries = once.problem.itineraries
    distances.prepare(
        (stage.vertex, itinerary.edge_ticks)
        for itinerary in itineraries
        for stage in itinerary.stages
    )
    return once, distances


def take_out_closed_places(scenario: Scenario) -> Scenario:
    """Return the scenario without the places of its roadmap that are closed for ever, and closures.

    Raises
    ------
    InputError
        For closures that begin later than at 0 or end: they are at one time and do not come again
        in each lap. For closures that close different places to robots of different sizes. For
        jobs.
    """
    if scenario.problem.work is not None:
        remedy = "take them out, or plan them once"
        raise InputError.at("", f"repeated work does not know jobs ({remedy})")
    closed = scenario.problem.closures
    if closed is None:
        return scenario
    once = (
        "is at one time, and laps come again (take it out, or close the place permanently, from 0)"
    )
    faults = [
        InputFault("", once).nest(("closures", index))
        for index, closure in enumerate(scenario.closures)
        if closure.from_ > 0 or closure.until is not None
    ]
    if faults:
        raise InputError(faults)
    roadmap, n_vertices = scenario.roadmap, closed.n_vertices
    size, resource = np.divmod(closed.row, n_vertices + closed.n_edges)
    places = [
        frozenset(resource[size == size_class].tolist())
        for size_class in sorted(set(closed.size_of))
    ]
    if len(set(places)) > 1:
        message = "close different places to robots of different sizes, and laps have one roadmap"
        raise InputError.at(("closures",), f"{message} (leave out radius)")
    tails = np.repeat(np.arange(n_vertices), np.diff(roadmap.indptr)).tolist()
    edges = [
        (tails[place - n_vertices], int(roadmap.heads[place - n_vertices]))
        for place in places[0]
        if place >= n_vertices
    ]
    vertices = [place for place in places[0] if place < n_vertices]
    return replace(
        scenario,
        roadmap=roadmap.exclude(vertices, edges),
        closures=(),
        clock=scenario.problem.clock,
    )


def _find_faults(robot: Robot, scenario: Scenario) -> Iterator[InputFault]:
    if (robot.ends or scenario.rules.ends) == "none":
        yield InputFault("return", NOTHING_REPEATS)
    if all(stop.at == robot.home for stop in robot.stops):
        home = scenario.roadmap.name(robot.home)
        yield InputFault("stops", f"all are at its home {home} (let it go somewhere)")


def _repeat(once: Scenario, routes: Sequence[Route]) -> list[CyclicRoute]:
    itineraries = once.problem.itineraries
    return [
        CyclicRoute(
            robot=robot,
            lap=make_lap(once.roadmap, itineraries[robot], route),
            first_dwell=route.dwell[0],
        )
        for robot, route in limit_loop(enumerate(routes), ROUTING)
    ]


def avoid_homes(scenario: Scenario, routes: Sequence[Route]) -> list[Route]:
    """Replace routes of robots that pass each other's homes: neither could leave first.

    The new route is a shortest route that avoids all homes of other robots. Without a new route,
    the old route is kept.
    """
    avoiding, roadmap, resources = list(routes), scenario.roadmap, scenario.problem.resources
    itineraries = scenario.problem.itineraries
    at_home = [
        frozenset(list_excluded(resources, resources.get_vertex_row(robot, itinerary.home)))
        for robot, itinerary in enumerate(itineraries)
    ]
    owners = defaultdict[int, list[int]](list)  # of homes, by the rows that exclude them
    for robot, rows in enumerate(at_home):
        for row in rows:
            owners[row].append(robot)

    def passed(robot: int) -> frozenset[int]:
        rows = resources.list_rows_of_lap(roadmap, robot, avoiding[robot].vertices[:-1])
        return frozenset(np.concatenate(rows).tolist())

    booked = [passed(robot) for robot in limit_loop(range(len(avoiding)), ROUTING)]
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    for robot, itinerary in limit_loop(enumerate(itineraries), ROUTING, 8):
        met = {
            neighbour
            for row in owners.keys() & booked[robot]
            for neighbour in owners[row]
            if neighbour != robot
        }
        if all(at_home[robot].isdisjoint(booked[neighbour]) for neighbour in met):
            continue
        shut = {row for row, homes in owners.items() if homes != [robot]}
        own = np.arange(resources.n_vertices + resources.n_edges) + resources.get_vertex_row(
            robot, 0
        )
        is_shut = np.isin(own, list(shut))
        edges = np.flatnonzero(is_shut[resources.n_vertices :] | is_shut[roadmap.heads])
        ends = zip(tails[edges].tolist(), roadmap.heads[edges].tolist(), strict=True)
        distances = Distances(roadmap.exclude((), list(ends)))
        if reaches_its_places(itinerary, distances):
            avoiding[robot] = find_shortest_route(roadmap, itinerary, distances)
            booked[robot] = passed(robot)
    return avoiding


def split_groups(scenario: Scenario, fleet: Sequence[CyclicRoute]) -> list[list[CyclicRoute]]:
    """Partition a fleet into groups with laps that share no vertex (union-find).

    Robots with a size: that book nothing incompatible.

    Returns
    -------
    list of list of CyclicRoute
        Groups ordered by their first robots; robots in the order given.
    """
    leader = list(range(len(fleet)))

    def find(index: int) -> int:
        while leader[index] != index:
            leader[index] = index = leader[leader[index]]
        return index

    first_at: dict[int, int] = {}
    laps = [make_lap_rows(scenario, route.robot, route.lap) for route in limit_loop(fleet, ROUTING)]
    booked = frozenset().union(*(lap.booked for lap in laps))
    excluded = frozenset().union(*(lap.excluded for lap in laps))
    for index, lap in enumerate(laps):
        for row in (lap.booked & excluded) | (lap.excluded & booked):
            first, second = find(first_at.setdefault(row, index)), find(index)
            leader[max(first, second)] = min(first, second)
    groups: dict[int, list[CyclicRoute]] = {}
    for index, route in enumerate(fleet):
        groups.setdefault(find(index), []).append(route)
    return list(groups.values())


@dataclass(frozen=True, slots=True)
class LapRows:
    """The bookings of a lap, and the places that it excludes other robots from.

    Attributes
    ----------
    booked
        Rows of its vertices and edges.
    excluded
        Rows that other robots cannot book at the same time.
    """

    booked: frozenset[int]
    excluded: frozenset[int]


def make_lap_rows(scenario: Scenario, robot: int, lap: Lap) -> LapRows:
    """Return the bookings of a lap of a robot, and the places that it excludes."""
    resources = scenario.problem.resources
    booked = frozenset(
        np.concatenate(resources.list_rows_of_lap(scenario.roadmap, robot, lap.vertices)).tolist()
    )
    excluded = (list_excluded(resources, row) for row in booked)
    return LapRows(booked, frozenset(chain.from_iterable(excluded)))
