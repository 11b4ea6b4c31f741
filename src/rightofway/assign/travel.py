"""Travel times and energies between the places that jobs use, measured once.

Robots of one pace share a table, and so do robots with batteries of one kind. Times are exact for a
robot alone on the roads: one-way lanes, speeds, limits, barred lanes and turns on the way count.
They are lower bounds in two cases. Of the turn before the first drive, which a turn rate needs,
nothing is known here. And where robots may not turn, the time to a stop and the time from it are
each the least of all directions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Problem, Tick
from rightofway.model.stop_directions import list_directions
from rightofway.model.turning import Turning
from rightofway.model.work import LARGEST_BATTERY, BoundBattery, BoundRobot, Work
from rightofway.search import Distances
from rightofway.site import Roadmap, VertexId

T = TypeVar("T", np.int32, np.int64)

__all__ = ["BatteryKind", "Travel", "measure_travel"]

_Pace = tuple[tuple[Tick, ...], Tick, Fraction | None]
"""Ticks for an edge of each class, and of turning at a stop; the turn rate [degrees per tick]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BatteryKind:
    """A battery that robots of one pace with the same charging places have.

    Attributes
    ----------
    battery
        Its numbers, of which `BatteryKind.full` are a full battery; the state of charge is ignored.
    charging
        Indices of the places at which it may be charged.
    drives
        The charge that drives between places take on the quickest way, without `on`; int64, shape
        (P, P). More than full where there is no way, and to starts. Kinds that differ in their
        charging places alone share one array.
    to_charging
        The least that is needed from each place to a charging place, with `on`; int64, shape (P,).
        More than full where there is no way.
    """

    battery: BoundBattery
    charging: tuple[int, ...]
    drives: NDArray[np.int64]
    to_charging: NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Travel:
    """Times and energies of drives between the places of a fleet's work.

    Attributes
    ----------
    vertices
        The vertex of each place: stops, charging places and homes, then the start of each robot. A
        robot leaves its start without a turn of a stop, so starts are places of their own.
    ticks
        For each kind of travel, the ticks from place to place, -1 without a way; with the turn at
        the stop that is left; int32, shape (K, P, P).
    kind_of
        The kind of travel of each robot.
    batteries
        The kinds of batteries.
    battery_of
        The kind of battery of each robot, -1 without a battery.
    """

    vertices: tuple[VertexId, ...]
    ticks: NDArray[np.int32]
    kind_of: tuple[int, ...]
    batteries: tuple[BatteryKind, ...]
    battery_of: tuple[int, ...]

    @cached_property
    def place_of(self) -> dict[VertexId, int]:
        """The place of each vertex where robots work, charge or rest."""
        used = self.vertices[: len(self.vertices) - len(self.kind_of)]
        return {vertex: place for place, vertex in enumerate(used)}

    def get_start(self, robot: int) -> int:
        """Return the place at which a robot starts."""
        return len(self.vertices) - len(self.kind_of) + robot

    def delay(self, delays: NDArray[np.int32], drains: Sequence[NDArray[np.int64]]) -> Travel:
        """Return the same travel, with later arrivals and drives that take more charge.

        Parameters
        ----------
        delays
            Ticks that are added to those of ``ticks``; int32, shape (K, P, P). Entries without a
            way stay so.
        drains
            For each kind of battery, what is added to `BatteryKind.drives`: one array for kinds
            that share one.
        """
        later = np.where(self.ticks < 0, self.ticks, self.ticks + delays)
        drives = {
            id(kind.drives): kind.drives + more
            for kind, more in zip(self.batteries, drains, strict=True)
        }
        batteries = tuple(replace(kind, drives=drives[id(kind.drives)]) for kind in self.batteries)
        return replace(self, ticks=later.astype(np.int32), batteries=batteries)


def measure_travel(problem: Problem, distances: Distances) -> Travel:
    """Measure travel between the places that the jobs of a problem use.

    Parameters
    ----------
    problem
        A problem with work.
    distances
        Tables of the problem's roadmap.

    Raises
    ------
    KernelLimit
        If a least time does not fit 32 bits.
    """
    work = problem.work
    assert work is not None, "the problem has jobs"
    vertices = (*_list_places(work), *(robot.start for robot in work.robots))
    turnings = {
        None if own.turning is None else own.turning.rate: own.turning
        for own in problem.itineraries
    }
    paces = [
        (itinerary.edge_ticks, robot.turn, itinerary.turning.rate if itinerary.turning else None)
        for itinerary, robot in zip(problem.itineraries, work.robots, strict=True)
    ]
    kinds = list(dict.fromkeys(paces))
    places = _Places(problem.roadmap, vertices, len(vertices) - len(work.robots))
    distances.prepare((at, ticks) for ticks, *_ in kinds for at in places.at.tolist())
    travel = Travel(
        vertices=vertices,
        ticks=np.array(
            [_measure_ticks(places, pace, turnings[pace[2]], distances) for pace in kinds]
        ),
        kind_of=tuple(kinds.index(pace) for pace in paces),
        batteries=(),
        battery_of=(),
    )
    return _add_batteries(travel, places, work.robots, paces, distances)


def _list_places(work: Work) -> list[VertexId]:
    """Return the vertices at which robots work, charge or rest, sorted."""
    stops = {stop.vertex for job in work.jobs for stop in job.stops}
    charging = {at for robot in work.robots if robot.battery for at in robot.charging}
    homes = {robot.home for robot in work.robots if robot.home is not None}
    return sorted(stops | charging | homes)


class _Places:
    """The places of travel, each with the vertices of the directions in which robots stop there."""

    def __init__(self, roadmap: Roadmap, vertices: Sequence[VertexId], n_used: int) -> None:
        self.vertices, self.n_used = vertices, n_used
        used = [list_directions(roadmap, vertex) for vertex in vertices[:n_used]]
        self.directions = [*used, *((start,) for start in vertices[n_used:])]
        self.at = np.array([at for own in self.directions for at in own], np.int32)
        self.first = np.cumsum([0, *map(len, self.directions)])[:-1]

    def measure_to(
        self, place: int, measure: Callable[[VertexId], NDArray[T]]
    ) -> NDArray[np.int64]:
        """Return the least from each place to a place; -1 where all are.

        ``measure`` returns it from all vertices to one; shape (V,).
        """
        return self.find_least(map(measure, self.directions[place]))

    def find_least(self, tables: Iterable[NDArray[T]]) -> NDArray[np.int64]:
        """Return the least of some tables at each place; int64, shape (P,), -1 where all are."""
        least = np.minimum.reduce([table[self.at].astype(np.uint64) for table in tables])
        return np.minimum.reduceat(least, self.first).astype(np.int64)


def _measure_ticks(
    places: _Places, pace: _Pace, turning: Turning | None, distances: Distances
) -> NDArray[np.int32]:
    edge_ticks, turn, _ = pace

    def measure(vertex: VertexId) -> NDArray[np.int32]:
        return distances.to(vertex, edge_ticks)

    def measure_with_turns(vertex: VertexId) -> NDArray[np.int32]:
        assert turning is not None, "the robot turns"
        return distances.to_with_turns(vertex, edge_ticks, turning)

    n_used = places.n_used
    columns = [
        places.measure_to(place, measure_with_turns if turning and place < n_used else measure)
        for place in range(len(places.vertices))
    ]
    at, ticks = np.array(places.vertices), np.stack(columns, axis=1)
    turns = (at[:, None] != at[None, :]) & (ticks >= 0)
    turns[n_used:] = False  # robots do not turn at starts
    return np.asarray(ticks + turns * turn, np.int32)


def _add_batteries(
    travel: Travel,
    places: _Places,
    robots: Sequence[BoundRobot],
    paces: Sequence[_Pace],
    distances: Distances,
) -> Travel:
    """Return travel with the kinds of batteries of the robots."""
    kinds: dict[object, list[int]] = {}
    for index, robot in enumerate(robots):
        if robot.battery is not None:
            alike = _list_shares(robot.battery), paces[index], robot.charging
            kinds.setdefault(alike, []).append(index)
    tables = dict[object, NDArray[np.int64]]()
    batteries, battery_of = list[BatteryKind](), [-1] * len(robots)
    for members in kinds.values():
        for full, group in _group_by_full(members, robots):
            for index in group:
                battery_of[index] = len(batteries)
            charging = tuple(travel.place_of[vertex] for vertex in robots[group[0]].charging)
            edge_ticks, *_ = paces[group[0]]
            battery = scale_battery(robots[group[0]].battery, full)
            key = edge_ticks, battery.drive, full
            if key not in tables:
                tables[key] = _measure_drives(places, battery, edge_ticks, distances)
            batteries.append(
                BatteryKind(
                    battery=battery,
                    charging=charging,
                    drives=tables[key],
                    to_charging=_measure_to_charging(
                        places, battery, charging, edge_ticks, distances
                    ),
                )
            )
    return replace(travel, batteries=tuple(batteries), battery_of=tuple(battery_of))


def _list_shares(battery: BoundBattery) -> tuple[Fraction, ...]:
    parts = (*battery.drive, battery.on, battery.work, battery.charge, battery.reserve)
    return tuple(Fraction(part, battery.full) for part in parts)


def _group_by_full(
    members: Iterable[int], robots: Sequence[BoundRobot]
) -> list[tuple[int, list[int]]]:
    """Return groups of robots whose states of charge are whole numbers of one full battery."""
    groups: list[tuple[int, list[int]]] = []
    for index in members:
        battery = robots[index].battery
        assert battery is not None
        for place, (full, group) in enumerate(groups):
            common = lcm(full, battery.full)
            if common <= LARGEST_BATTERY:
                groups[place] = common, [*group, index]
                break
        else:
            groups.append((battery.full, [index]))
    return groups


def _measure_drives(
    places: _Places, battery: BoundBattery, edge_ticks: tuple[Tick, ...], distances: Distances
) -> NDArray[np.int64]:
    """Return `BatteryKind.drives`."""
    most = battery.full + 1

    def measure(vertex: VertexId) -> NDArray[np.int64]:
        return distances.measure_energies(vertex, edge_ticks, battery.drive, most)

    drives = np.full((len(places.vertices),) * 2, most, np.int64)  # starts are no targets
    for place in range(places.n_used):
        drives[:, place] = places.measure_to(place, measure)
    return drives


def _measure_to_charging(
    places: _Places,
    battery: BoundBattery,
    charging: Iterable[int],
    edge_ticks: tuple[Tick, ...],
    distances: Distances,
) -> NDArray[np.int64]:
    """Return `BatteryKind.to_charging`."""
    most = battery.full + 1
    moving = tuple(
        -1 if ticks < 0 else min(drive + battery.on * ticks, most)
        for drive, ticks in zip(battery.drive, edge_ticks, strict=True)
    )
    targets = [at for place in charging for at in places.directions[place]]
    return places.find_least([distances.find_least_energies(targets, moving, most)])


def scale_battery(battery: BoundBattery | None, full: int) -> BoundBattery:
    """Return a battery with other whole numbers: ``full`` is a multiple of its own."""
    assert battery is not None, "the robot has a battery"
    factor = full // battery.full
    return BoundBattery(
        full=full,
        drive=tuple(part * factor for part in battery.drive),
        on=battery.on * factor,
        work=battery.work * factor,
        charge=battery.charge * factor,
        reserve=battery.reserve * factor,
        soc=battery.soc * factor,
    )
