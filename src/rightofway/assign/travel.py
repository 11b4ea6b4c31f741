"""Travel times and energies between the places that jobs use, measured once.

Robots of one pace share a table, and so do robots with batteries of one kind. Times are exact for a
robot alone on the roads: one-way lanes, speeds, limits, barred lanes and turns on the way count. Of
the turn before the first drive nothing is known here, so with a turn rate times are lower bounds.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import lcm

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Problem, Tick
from rightofway.model.turning import Turning
from rightofway.model.work import LARGEST_BATTERY, BoundBattery, BoundRobot, Work
from rightofway.search import Distances
from rightofway.site import VertexId

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
    distances.prepare((vertex, ticks) for ticks, *_ in kinds for vertex in vertices)
    n_used = len(vertices) - len(work.robots)
    travel = Travel(
        vertices=vertices,
        ticks=np.array(
            [_measure_ticks(vertices, n_used, pace, turnings[pace[2]], distances) for pace in kinds]
        ),
        kind_of=tuple(kinds.index(pace) for pace in paces),
        batteries=(),
        battery_of=(),
    )
    return _add_batteries(travel, work.robots, paces, distances)


def _list_places(work: Work) -> list[VertexId]:
    """Return the vertices at which robots work, charge or rest, sorted."""
    stops = {stop.vertex for job in work.jobs for stop in job.stops}
    charging = {at for robot in work.robots if robot.battery for at in robot.charging}
    homes = {robot.home for robot in work.robots if robot.home is not None}
    return sorted(stops | charging | homes)


def _measure_ticks(
    vertices: Sequence[VertexId],
    n_used: int,
    pace: _Pace,
    turning: Turning | None,
    distances: Distances,
) -> NDArray[np.int32]:
    edge_ticks, turn, _ = pace
    at = np.array(vertices, np.int32)
    by_target = {vertex: distances.to(vertex, edge_ticks)[at] for vertex in set(vertices)}
    if turning is not None:  # starts are no targets
        for vertex in set(vertices[:n_used]):
            by_target[vertex] = distances.to_with_turns(vertex, edge_ticks, turning)[at]
    ticks = np.stack([by_target[vertex] for vertex in vertices], axis=1)
    turns = (at[:, None] != at[None, :]) & (ticks >= 0)
    turns[n_used:] = False
    return np.asarray(ticks + turns * turn, np.int32)


def _add_batteries(
    travel: Travel, robots: Sequence[BoundRobot], paces: Sequence[_Pace], distances: Distances
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
            charging, (edge_ticks, *_) = robots[group[0]].charging, paces[group[0]]
            battery = scale_battery(robots[group[0]].battery, full)
            key = edge_ticks, battery.drive, full
            if key not in tables:
                tables[key] = _measure_drives(travel, battery, edge_ticks, distances)
            batteries.append(
                BatteryKind(
                    battery=battery,
                    charging=tuple(travel.place_of[vertex] for vertex in charging),
                    drives=tables[key],
                    to_charging=_measure_to_charging(
                        travel, battery, charging, edge_ticks, distances
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
    travel: Travel, battery: BoundBattery, edge_ticks: tuple[Tick, ...], distances: Distances
) -> NDArray[np.int64]:
    """Return `BatteryKind.drives`."""
    at, most = np.array(travel.vertices, np.int32), battery.full + 1
    drives = np.full((len(at), len(at)), most, np.int64)  # nobody drives to a start
    for vertex, place in travel.place_of.items():
        drives[:, place] = distances.measure_energies(vertex, edge_ticks, battery.drive, most)[at]
    return drives


def _measure_to_charging(
    travel: Travel,
    battery: BoundBattery,
    charging: Iterable[VertexId],
    edge_ticks: tuple[Tick, ...],
    distances: Distances,
) -> NDArray[np.int64]:
    """Return `BatteryKind.to_charging`."""
    most = battery.full + 1
    moving = tuple(
        -1 if ticks < 0 else min(drive + battery.on * ticks, most)
        for drive, ticks in zip(battery.drive, edge_ticks, strict=True)
    )
    energies = distances.find_least_energies(charging, moving, most)
    return energies.take(travel.vertices)


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
