"""Action dependency graph: the routes of a plan and its order of visits at each vertex, no clock.

A robot enters a vertex when the visit directly before has left it, however late that is. The visits
of a rotation wait for each other and begin at one instant: one joint event. A robot with a size
starts to drive into a vertex when all visits before that are incompatible have ended.

References
----------
Hönig, Kiesel, Tinka, Durham & Ayanian, *Persistent and robust execution of MAPF schedules in
warehouses*, IEEE Robotics and Automation Letters 4, 2019.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, chain, pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import NEVER, PlannedTour, Route, Scenario, Tick, Track, make_route
from rightofway.native import (
    BookedRows,
    ClosedPlaces,
    bind_closures,
    bind_rows,
    bind_rules,
)
from rightofway.precedence.graph import Pairs, build_graph
from rightofway.precedence.works import make_routes_of_tours

KINDS = ("exponential", "uniform", "normal", "chance", "breaks")
"""Kinds of random delay; the kernel takes the index."""


class Stoppage(NamedTuple):
    """A robot stops from a tick on, for some ticks; `NEVER` ticks are a breakdown."""

    tick: Tick
    ticks: Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class DelayModel:
    """Delays of a fleet in ticks: random ones, slow robots, stoppages.

    Attributes
    ----------
    random
        Kind and two numbers of each random delay: ``exponential`` with the mean, ``uniform`` with
        the bounds, ``normal`` with mean and deviation, all as parts of the planned duration;
        ``chance`` with the probability of a stop in a visit and its ticks; ``breaks`` with the
        probability that a robot breaks down.
    pace
        For each robot, real duration divided by planned duration; 1 is as planned.
    stoppages
        For each robot its stoppages, sorted.
    """

    random: tuple[tuple[str, float, float], ...]
    pace: tuple[float, ...]
    stoppages: tuple[tuple[Stoppage, ...], ...]

    @classmethod
    def none(cls, robots: int) -> DelayModel:
        """Return the model of a fleet without delays."""
        return cls(random=(), pace=(1.0,) * robots, stoppages=((),) * robots)


class DelaySample(NamedTuple):
    """Delays drawn for one run: arrays as the kernel takes them.

    Attributes
    ----------
    dwell, drive
        Real least duration of each visit, and of the drive into it [ticks]; int64[N].
    first_stoppage
        Robot ``r`` owns stoppages ``first_stoppage[r] .. first_stoppage[r + 1] - 1``; int32[R + 1].
    tick, ticks
        Begin and length of each stoppage [ticks]; int64[S].
    """

    dwell: NDArray[np.int64]
    drive: NDArray[np.int64]
    first_stoppage: NDArray[np.int32]
    tick: NDArray[np.int64]
    ticks: NDArray[np.int64]

    def list_stoppages(self, robot: int) -> list[Stoppage]:
        """Return the stoppages of a robot."""
        own = slice(*self.first_stoppage[robot : robot + 2].tolist())
        pairs = zip(self.tick[own].tolist(), self.ticks[own].tolist(), strict=True)
        return [Stoppage(Tick(tick), Tick(ticks)) for tick, ticks in pairs]

    def add_stoppages(self, other: DelaySample) -> DelaySample:
        """Return these durations with the stoppages of another sample of the same fleet."""
        return DelaySample(self.dwell, self.drive, *other[2:])

    def find_breakdown(self, robot: int) -> Tick:
        """Return when a robot breaks down, `NEVER` if it does not [ticks]."""
        own = self.list_stoppages(robot)
        return min((tick for tick, ticks in own if ticks == NEVER), default=NEVER)


class Execution(NamedTuple):
    """Times of one run; `NEVER` for actions that do not happen.

    Attributes
    ----------
    enter, start
        When each visit began, and from when it booked its vertex [ticks]; int64[N].
    completion
        When each robot completed [ticks]; int64[R].
    is_broken
        Whether each robot broke down; uint8[R].
    collisions
        Numbers of overlapping pairs of visits, of pairs that overlap by the headway only, and of
        swaps; and when the first of all these begins [ticks]; int64[4].
    is_caught
        Whether each robot books something while it is closed; uint8[R].
    begin, end
        Of a plan with jobs, when each work begins and ends [ticks]; int64[W]. The works of a robot
        are that it is ready, then the items of its tour.
    """

    enter: NDArray[np.int64]
    start: NDArray[np.int64]
    completion: NDArray[np.int64]
    is_broken: NDArray[np.uint8]
    collisions: NDArray[np.int64]
    is_caught: NDArray[np.uint8]
    begin: NDArray[np.int64]
    end: NDArray[np.int64]


class RunBatch(NamedTuple):
    """Times and counts of K runs; by right of way, except in fields with `clock` in the name.

    Attributes
    ----------
    completion, is_broken
        As in `Execution`, for each run; [K, R].
    by_right_of_way, by_clock
        Collisions as in `Execution`, for each run; int64[K, 4].
    own, of_others
        Lateness that began at each visit, of its own robot and of others [ticks]; int64[N].
    between
        Robot, another, and how late the robot is because of the other [ticks]; int64[P, 3].
    is_caught
        As in `Execution`, for each run; [K, R].
    """

    completion: NDArray[np.int64]
    is_broken: NDArray[np.uint8]
    by_right_of_way: NDArray[np.int64]
    by_clock: NDArray[np.int64]
    own: NDArray[np.int64]
    of_others: NDArray[np.int64]
    between: NDArray[np.int64]
    is_caught: NDArray[np.uint8]


class ActionDependencyGraph:
    """Routes, planned times and order of a plan, with possible delays.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        A plan that keeps the rules.
    delay_model
        The delays to draw from.
    routes
        The routes of the tracks, if known already.
    order
        Pairs (first, second): the second visit starts when the first has ended; int32[M, 2], sorted
        by the second. For points, the visits that follow each other at a vertex. Without, the order
        of the plan.
    since
        When each visit was given its right of way; it begins no sooner [ticks]; int64[N]. Without,
        tick 0.
    tours
        Of a plan with jobs: the items of robots, with their visits. They give the routes.

    Attributes
    ----------
    routes
        Vertices, least dwells and drives of each robot.
    first_visit, vertex, planned, dwell, drive, order, since
        Arrays over visits, robot after robot: index of each robot's first visit (int32[R + 1]),
        vertex (int32[N]), planned enter, least dwell and drive into it (int64[N], ticks), and the
        two above.
    """

    def __init__(
        self,
        scenario: Scenario,
        tracks: Sequence[Track],
        delay_model: DelayModel,
        *,
        routes: Sequence[Route] | None = None,
        order: Pairs | None = None,
        since: NDArray[np.int64] | None = None,
        tours: Sequence[PlannedTour] | None = None,
    ) -> None:
        itineraries, works = scenario.problem.itineraries, None
        self.scenario, self.delay_model, self._tours = scenario, delay_model, tours
        if tours is not None:
            routes, works = make_routes_of_tours(scenario, tracks, tours)
        self.routes = tuple(
            routes
            or (
                make_route(scenario.roadmap, itinerary, track)
                for itinerary, track in zip(itineraries, tracks, strict=True)
            )
        )
        self.first_visit = np.array([0, *accumulate(map(len, tracks))], np.int32)
        self.vertex = np.concatenate([track.vertices for track in tracks])
        self.planned = np.concatenate([track.enter for track in tracks])
        self.order = self.order_at(self.planned) if order is None else order
        self.since = np.zeros(len(self.vertex), np.int64) if since is None else since
        self.dwell = np.array([ticks for route in self.routes for ticks in route.dwell], np.int64)
        self.drive = np.array([ticks for route in self.routes for ticks in route.drive], np.int64)
        first, second = (column.copy() for column in self.order.T)
        begins = np.searchsorted(second, np.arange(len(self.vertex) + 1)).astype(np.int32)
        self._kernel = _core.ActionDependencyGraph(
            bind_rules(scenario.problem.booking_rules),
            _core.Routes(self.first_visit, self.vertex, self.dwell, self.drive),
            _core.Order(self.planned, begins, first, self.since),
            _make_kernel(delay_model),
            bind_rows(BookedRows.of(scenario.problem, [route.vertices for route in self.routes])),
            bind_closures(ClosedPlaces.of(scenario.problem, self.routes)),
            works,
        )

    def order_at(self, when: NDArray[np.int64]) -> Pairs:
        """Return the order, as above, of visits that take place at some times; int64[N].

        Raises
        ------
        ValueError
            If robots with a size cannot make their visits in that order.
        """
        if self.scenario.problem.resources.are_points:
            return order_of(self.vertex, when)
        # An order has no clock: what has begun too late for a closure has its place in it, too.
        begun = np.ones((len(self.vertex), 2), bool)
        graph = build_graph(self.scenario.problem, self.routes, begun=begun)
        if not graph.keeps_order(np.split(when, self.first_visit[1:-1])):
            raise ValueError("when: some visits cannot take place in this order")
        rights = graph.list_rights()
        return rights[np.lexsort((rights[:, 0], rights[:, 1]))]

    def reorder(
        self, order: Pairs, since: NDArray[np.int64] | None = None
    ) -> ActionDependencyGraph:
        """Return the same routes with another order of visits; `order` and `since` as above."""
        return ActionDependencyGraph(
            self.scenario,
            self.build_tracks(self.planned),
            self.delay_model,
            routes=self.routes,
            order=order,
            since=self.since if since is None else since,
            tours=self._tours,
        )

    def get_planned_completions(self) -> NDArray[np.int64]:
        """Return when each robot completes by the plan [ticks]; int64[R]."""
        return self._kernel.planned_completions()

    def list_deadlocked(self) -> list[int]:
        """Return the robots that can never complete because they wait for each other."""
        circle: list[int] = self._kernel.deadlocked().tolist()
        return circle

    def make_runs(
        self, seed: int, first: int, count: int, time_limit: float | None = None
    ) -> RunBatch:
        """Run the plan ``count`` times, from run number ``first`` on.

        A run depends on its number and the seed alone. After ``time_limit`` [s] no run is begun.
        """
        return RunBatch(*self._kernel.runs(seed, first, count, time_limit))

    def delay_sample(self, seed: int, run: int) -> DelaySample:
        """Return the delays of one run."""
        return DelaySample(*self._kernel.delay_sample(seed, run))

    def execute(self, delay_sample: DelaySample, *, clock: bool = False) -> Execution:
        """Run the plan once, by right of way or by the clock."""
        return Execution(*self._kernel.execute(*delay_sample, clock))

    def comes_after(self, visit: int) -> list[int]:
        """Return the visits that have to end before a visit starts."""
        first, second = self.order.T
        return list(map(int, first[slice(*np.searchsorted(second, [visit, visit + 1]))]))

    def get_robot(self, visit: int) -> int:
        """Return the robot of a visit."""
        return int(np.searchsorted(self.first_visit, visit, side="right")) - 1

    def build_tracks(self, enter: NDArray[np.int64]) -> tuple[Track, ...]:
        """Return the tracks with these times (int64[N]); visits at `NEVER` are left out."""
        tracks = []
        for first, end in pairwise(self.first_visit.tolist()):
            times = enter[first:end]
            done = int(np.count_nonzero(times < NEVER))
            vertices = self.vertex[first : first + done].copy()
            tracks.append(Track(vertices=vertices, enter=times[:done].copy()))
        return tuple(tracks)


def order_of(vertex: NDArray[np.int32], when: NDArray[np.int64]) -> Pairs:
    """Return pairs of visits that follow each other at a vertex; int32[M, 2], sorted by the second.

    Parameters
    ----------
    vertex
        The vertex of each visit; int32[N].
    when
        A time for each visit; visits at one vertex take place in its order; int64[N].
    """
    order = np.lexsort((when, vertex)).astype(np.int32)
    follows = vertex[order[1:]] == vertex[order[:-1]]
    first, second = order[:-1][follows], order[1:][follows]
    by_second = np.argsort(second)
    return np.column_stack((first[by_second], second[by_second]))


def _make_kernel(delays: DelayModel) -> _core.DelayModel:
    stoppages = list(chain(*delays.stoppages))
    return _core.DelayModel(
        np.array(delays.pace, np.float64),
        np.array([KINDS.index(kind) for kind, _, _ in delays.random], np.int32),
        np.array([a for _, a, _ in delays.random], np.float64),
        np.array([b for _, _, b in delays.random], np.float64),
        np.array([0, *accumulate(map(len, delays.stoppages))], np.int32),
        np.array([stoppage.tick for stoppage in stoppages], np.int64),
        np.array([stoppage.ticks for stoppage in stoppages], np.int64),
    )
