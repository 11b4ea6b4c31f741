"""A plan whose arcs get longer: the same routes and rights of way on a floor where robots are late.

The clock of the plan is forgotten, its order of visits at every vertex is kept. Visits of a
rotation hold each other and begin at one instant, so they are one joint event.

References
----------
Hönig, Kiesel, Tinka, Durham & Ayanian, *Persistent and robust execution of MAPF schedules in
warehouses*, IEEE Robotics and Automation Letters 4, 2019 (their action dependency graph).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import NEVER, Route, Scenario, Tick, Track, route_of

__all__ = [
    "ActionDependencyGraph",
    "DelayModel",
    "DelaySample",
    "Execution",
    "RunBatch",
    "order_of",
]

KINDS = ("exponential", "uniform", "normal", "chance", "breaks")
"""Kinds of random delay, as the kernel counts them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DelayModel:
    """What may go otherwise than planned, in ticks.

    Attributes
    ----------
    random
        Kind and two numbers of each random delay: ``exponential`` and its mean, ``uniform`` and its
        bounds, ``normal`` with mean and deviation, all as parts of what a visit takes; ``chance``
        of a stop and its ticks; ``breaks`` with the chance to stand still for ever.
    pace
        For each robot, how much longer than planned everything takes it; 1 is as planned.
    standstills
        For each robot, from when it stands still and how long, by tick; `NEVER` for ever.
    """

    random: tuple[tuple[str, float, float], ...]
    pace: tuple[float, ...]
    standstills: tuple[tuple[tuple[Tick, Tick], ...], ...]

    @classmethod
    def none(cls, robots: int) -> DelayModel:
        """Return those of a floor where everything goes as planned."""
        return cls(random=(), pace=(1.0,) * robots, standstills=((),) * robots)

    def all_standstills(self) -> list[tuple[Tick, Tick]]:
        """Return those of all robots, one robot behind the other."""
        return [standstill for of_robot in self.standstills for standstill in of_robot]


class DelaySample(NamedTuple):
    """What befalls one run: arrays as the kernel takes them.

    Attributes
    ----------
    dwell, drive
        How long each visit really lasts at least, and the drive into it [ticks]; int64[N].
    first_standstill
        Which standstills are whose; int32[R + 1].
    tick, ticks
        From when a robot stands still and how long [ticks]; int64[S].
    """

    dwell: NDArray[np.int64]
    drive: NDArray[np.int64]
    first_standstill: NDArray[np.int32]
    tick: NDArray[np.int64]
    ticks: NDArray[np.int64]

    def of(self, robot: int) -> list[tuple[Tick, Tick]]:
        """Return the standstills of a robot."""
        here = slice(*self.first_standstill[robot : robot + 2].tolist())
        pairs = zip(self.tick[here].tolist(), self.ticks[here].tolist(), strict=True)
        return [(Tick(tick), Tick(ticks)) for tick, ticks in pairs]


class Execution(NamedTuple):
    """What happened in one run; `NEVER` for what did not.

    Attributes
    ----------
    enter, start
        When each visit began, and from when it booked its vertex [ticks]; int64[N].
    completion
        When each robot completed [ticks]; int64[R].
    is_broken
        Whether it stands still for ever; uint8[R].
    collisions
        Pairs of visits that overlap, those that do only by the headway, swaps, and when the first
        of all these begins [ticks]; int64[4].
    """

    enter: NDArray[np.int64]
    start: NDArray[np.int64]
    completion: NDArray[np.int64]
    is_broken: NDArray[np.uint8]
    collisions: NDArray[np.int64]


class RunBatch(NamedTuple):
    """What happened in many runs, by right of way but where it says by clock.

    Attributes
    ----------
    completion, is_broken
        As in `Execution`, for each run; [K, R].
    by_right_of_way, by_clock
        Collisions as in `Execution`, for each run; int64[K, 4].
    own, of_others
        Lateness that began at each visit, of its own robot and of others [ticks]; int64[N].
    between
        Robot, another, and the ticks that it is late because of the other; int64[P, 3].
    """

    completion: NDArray[np.int64]
    is_broken: NDArray[np.uint8]
    by_right_of_way: NDArray[np.int64]
    by_clock: NDArray[np.int64]
    own: NDArray[np.int64]
    of_others: NDArray[np.int64]
    between: NDArray[np.int64]


class ActionDependencyGraph:
    """The routes, times and order of a plan, and what may delay it.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        A plan that keeps the rules, by anybody.
    hazards
        What may go otherwise.
    routes
        The routes of the tracks, where they are known already.
    before
        Another order than that of the plan: for each visit the one directly before it at its
        vertex, -1 for none; int32[N].
    since
        When each visit was given its right of way, if that was on the way; it begins no sooner
        [ticks]; int64[N].

    Attributes
    ----------
    routes
        Where robots go, what they do there, and how long that takes at least.
    first_visit, vertex, planned, before, since
        Arrays over visits: which are whose, where each is, when it begins by the plan, which one
        goes directly before it at its vertex, and since when that is so.
    """

    def __init__(
        self,
        scenario: Scenario,
        tracks: Sequence[Track],
        hazards: DelayModel,
        *,
        routes: Sequence[Route] | None = None,
        before: NDArray[np.int32] | None = None,
        since: NDArray[np.int64] | None = None,
    ) -> None:
        itineraries = scenario.problem.itineraries
        self.scenario, self.hazards = scenario, hazards
        self.routes = tuple(
            routes
            or (
                route_of(scenario.roadmap, itinerary, track)
                for itinerary, track in zip(itineraries, tracks, strict=True)
            )
        )
        self.first_visit = np.array([0, *accumulate(map(len, tracks))], np.int32)
        self.vertex = np.concatenate([track.vertices for track in tracks])
        self.planned = np.concatenate([track.enter for track in tracks])
        self.before = order_of(self.vertex, self.planned) if before is None else before
        self.since = np.zeros(len(self.vertex), np.int64) if since is None else since
        self.dwell = np.array([ticks for route in self.routes for ticks in route.dwell], np.int64)
        self.drive = np.array([ticks for route in self.routes for ticks in route.drive], np.int64)
        self._kernel = _core.ActionDependencyGraph(
            self.first_visit,
            self.vertex,
            self.planned,
            self.dwell,
            self.drive,
            self.before,
            self.since,
            int(scenario.problem.headway),
            scenario.rules.books_ahead,
            np.array(hazards.pace, np.float64),
            np.array([KINDS.index(kind) for kind, _, _ in hazards.random], np.int32),
            np.array([a for _, a, _ in hazards.random], np.float64),
            np.array([b for _, _, b in hazards.random], np.float64),
            np.array([0, *accumulate(map(len, hazards.standstills))], np.int32),
            np.array([tick for tick, _ in hazards.all_standstills()], np.int64),
            np.array([ticks for _, ticks in hazards.all_standstills()], np.int64),
        )

    def reordered(
        self, before: NDArray[np.int32], since: NDArray[np.int64] | None = None
    ) -> ActionDependencyGraph:
        """Return the same with another order of visits, and since when each is told of it."""
        return ActionDependencyGraph(
            self.scenario,
            self.split(self.planned),
            self.hazards,
            routes=self.routes,
            before=before,
            since=self.since if since is None else since,
        )

    def deadlocked(self) -> list[int]:
        """Return the robots that can never complete, since they wait for each other."""
        found: list[int] = self._kernel.deadlocked().tolist()
        return found

    def runs(self, seed: int, first: int, count: int, time_limit: float | None = None) -> RunBatch:
        """Run the plan many times; each run depends on its number and the seed alone."""
        return RunBatch(*self._kernel.runs(seed, first, count, time_limit))

    def delay_sample(self, seed: int, run: int) -> DelaySample:
        """Return what befalls one run."""
        return DelaySample(*self._kernel.delay_sample(seed, run))

    def execute(self, delay_sample: DelaySample, *, clock: bool = False) -> Execution:
        """Run the plan once, by right of way or by the clock."""
        return Execution(*self._kernel.execute(*delay_sample, clock))

    def robot_of(self, visit: int) -> int:
        """Return whose visit it is."""
        return int(np.searchsorted(self.first_visit, visit, side="right")) - 1

    def split(self, enter: NDArray[np.int64]) -> tuple[Track, ...]:
        """Return the tracks with these times; visits that never begin are left out."""
        tracks = []
        for first, end in pairwise(self.first_visit.tolist()):
            times = enter[first:end]
            done = int(np.count_nonzero(times < NEVER))
            vertices = self.vertex[first : first + done].copy()
            tracks.append(Track(vertices=vertices, enter=times[:done].copy()))
        return tuple(tracks)


def order_of(vertex: NDArray[np.int32], when: NDArray[np.int64]) -> NDArray[np.int32]:
    """Return for each visit the one directly before it at its vertex, -1 for none.

    Parameters
    ----------
    vertex
        Where each visit is.
    when
        A time for each visit, in whose order they take place at every vertex.
    """
    order = np.lexsort((when, vertex)).astype(np.int32)
    before = np.full(len(vertex), -1, np.int32)
    follows = vertex[order[1:]] == vertex[order[:-1]]
    before[order[1:][follows]] = order[:-1][follows]
    return before
