"""Lower bounds of the objective of jobs, for robots that are never in each other's way.

Two bounds of service hold for every fleet. Each job ends no sooner than on the robot that can end
it first, alone. And robots are parallel machines: between the ends of two jobs on one robot lies at
least the drive to the last stop of the second one, and its work.

The assignment of few jobs is enumerated: the best tours without other robots cost no more than
any plan. Batteries, turns on the way and the times of jobs `after` others are relaxed.

References
----------
Eastman, Even & Isaacs, *Bounds for the optimal scheduling of n jobs on m processors*, Management
Science 1964.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache, cached_property
from math import prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.assign.travel import Travel
from rightofway.model.work import BoundJob, Work

MOST_STATES, MOST_ROBOTS = 250, 6
"""Jobs are enumerated if the stops of each robot have so many states, and robots are so few."""

NO_WAY = 1 << 50
"""A drive that does not exist [ticks]."""

Label = tuple[int, int]
"""The time of a robot, and the cost of the jobs that it has ended."""

Progress = tuple[tuple[int, ...], int]
"""Numbers of served stops of each job, and the place of the robot."""


class Alone(NamedTuple):
    """How soon each robot that may do a job can do it as its only one.

    Attributes
    ----------
    ends
        When the job ends at the earliest [ticks]; `NO_WAY` or more if there is no way; int64.
    homes
        When the robot can rest after that [ticks]; int64.
    are_late
        Whether a stop ends after its `latest`, also so.
    ready
        When the robot is ready [ticks]; int64.
    """

    ends: NDArray[np.int64]
    homes: NDArray[np.int64]
    are_late: NDArray[np.bool_]
    ready: NDArray[np.int64]


class WorkBound:
    """Lower bounds of plans of a scenario with jobs.

    Parameters
    ----------
    work
        The jobs.
    travel
        Travel times without delays.
    weights
        The weight of each robot.
    """

    def __init__(self, work: Work, travel: Travel, weights: Sequence[int]) -> None:
        self._work, self._travel, self._weights = work, travel, weights
        self._ready = [robot.ready for robot in work.robots]
        self.find_alone = cache(self._find_alone)
        self.find_end = cache(self._find_end)

    def is_impossible(self, job: int) -> bool:
        """Return whether no plan serves a job, because of robots, ways, `latest` or `after`."""
        own = self._work.jobs[job]
        if own.begun_by is not None:
            return False
        if any(map(self.is_impossible, own.after)):
            return True
        alone = self.find_alone(job)
        return bool(np.all((alone.homes >= NO_WAY) | alone.are_late))

    def compute(self, served: Sequence[int]) -> int:
        """Return a lower bound of the objective for the jobs that a plan serves.

        Of service in ticks times weights, in parts of which ``Work.late.denominator`` are one; of
        other objectives in ticks, of ``both`` times weights.
        """
        enumeration = _Enumeration(self, self._work, self._travel, served)
        is_small = enumeration.is_small
        match self._work.objective:
            case "service":
                least = enumeration.find_least_service() if is_small else 0
                return max(self._bound_service(served), least)
            case "flowtime":
                return self._bound_flowtime(served)
            case "makespan":
                return self._bound_makespan(served)
            case "both":
                flowtime = self._bound_flowtime(served) - sum(self._ready)
                weighted = (w * tick for w, tick in zip(self._weights, self._ready, strict=True))
                makespan = sum(self._weights) * self._bound_makespan(served)
                return makespan + sum(weighted) + min(self._weights) * flowtime

    def _bound_service(self, served: Sequence[int]) -> int:
        jobs, late = self._work.jobs, self._work.late
        by_ends = sum(jobs[job].weight * self.find_end(job) for job in served)
        delays = sum(
            jobs[job].weight * measure_late(jobs[job], self.find_end(job)) for job in served
        )
        releases = sum(jobs[job].weight * jobs[job].earliest for job in served)
        ends = max(by_ends, self._bound_ends(served))
        return int(late.denominator * (ends - releases) + late.numerator * delays)

    def _bound_ends(self, served: Sequence[int]) -> int:
        """Return a lower bound of the weighted sum of ends, by parallel machines."""
        jobs, first = self._work.jobs, min(self._ready)
        n_robots = len({robot for job in served for robot in jobs[job].robots})
        if not n_robots:
            return 0
        steps = {job: self._find_step(job, served, first) for job in served}
        # Smith's rule: on one machine, jobs in order of weight by duration are best.
        order = sorted(served, key=lambda job: steps[job] / jobs[job].weight)
        now = one_machine = 0
        for job in order:
            now += steps[job]
            one_machine += jobs[job].weight * now
        own = sum(jobs[job].weight * steps[job] for job in served)
        weights = sum(jobs[job].weight for job in served)
        return first * weights + -(-(2 * one_machine + (n_robots - 1) * own) // (2 * n_robots))

    def _find_step(self, job: int, served: Sequence[int], first: int) -> int:
        """Return the least time from the end of a job before, or from `first`, to a job's end."""
        own = self._work.jobs[job]
        least = max(0, self.find_end(job) - first)
        to = self._travel.place_of[own.stops[-1].vertex]
        starts = [
            self._travel.place_of[self._work.jobs[other].stops[-1].vertex]
            for other in served
            if other != job
        ]
        for kind in {self._travel.kind_of[robot] for robot in own.robots}:
            drives = self._travel.ticks[kind, starts, to]
            drives = drives[drives >= 0]
            if len(drives):
                least = min(least, int(drives.min()) + own.stops[-1].work)
        return least

    def _bound_makespan(self, served: Sequence[int]) -> int:
        homes = (self._find_home(job, 0) for job in served)
        first = min(self._ready)
        steps = sum(self._find_step(job, served, first) for job in served)
        shared = first + -(-steps // len(self._ready))
        return max([*self._ready, *homes, shared])

    def _bound_flowtime(self, served: Sequence[int]) -> int:
        last = max((self._find_home(job, 1) for job in served), default=0)
        latest = max(self._ready)
        steps = sum(self._find_step(job, served, latest) for job in served)
        return sum(self._ready) + max(0, last, steps)

    def _find_home(self, job: int, from_ready: int) -> int:
        """Return when a robot that does a job rests at the earliest, or how long after `ready`."""
        alone = self.find_alone(job)
        return int((alone.homes - from_ready * alone.ready).min())

    def _find_end(self, job: int) -> int:
        """Return when a job ends at the earliest [ticks]; `NO_WAY` if no robot may do it."""
        return int(self.find_alone(job).ends.min(initial=NO_WAY))

    def find_release(self, job: int) -> int:
        """Return when the jobs end at the earliest after which a job may begin [ticks]."""
        return max((self.find_end(other) for other in self._work.jobs[job].after), default=0)

    def _find_alone(self, job: int) -> Alone:
        own, travel = self._work.jobs[job], self._travel
        robots = np.array(own.robots, np.int64)
        kinds = np.array(travel.kind_of, np.int64)[robots]
        at = np.array([travel.get_start(robot) for robot in own.robots], np.int64)
        ready = np.array(self._ready, np.int64)[robots]
        now, are_late = ready, np.zeros(len(robots), np.bool_)
        for number, stop in enumerate(own.stops):
            to = np.full(len(robots), travel.place_of[stop.vertex])
            least = stop.earliest if number else max(stop.earliest, self.find_release(job))
            now = np.maximum(now + self._measure_drives(kinds, at, to), least) + stop.work
            are_late |= now > (NO_WAY if stop.latest is None else stop.latest)
            at = to
        ends = [self._work.robots[robot].home for robot in own.robots]
        to = np.array(
            [
                place if end is None else travel.place_of[end]
                for place, end in zip(at, ends, strict=True)
            ],
            np.int64,
        )
        return Alone(now, now + self._measure_drives(kinds, at, to), are_late, ready)

    def _measure_drives(
        self, kinds: NDArray[np.int64], at: NDArray[np.int64], to: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        ticks = self._travel.ticks[kinds, at, to].astype(np.int64)
        return np.where(ticks < 0, NO_WAY, ticks)

    def measure_drive(self, robot: int, at: int, to: int) -> int:
        """Return the ticks of a drive, `NO_WAY` without a way."""
        ticks = int(self._travel.ticks[self._travel.kind_of[robot], at, to])
        return NO_WAY if ticks < 0 else ticks


def measure_late(job: BoundJob, end: int) -> int:
    """Return how long after its `due` a job ends [ticks]."""
    return 0 if job.due is None else max(0, end - job.due)


class _Enumeration:
    """The least cost of few jobs over all tours, by dynamic programming over sets of jobs."""

    def __init__(self, bound: WorkBound, work: Work, travel: Travel, served: Sequence[int]) -> None:
        self._bound, self._work, self._travel, self._served = bound, work, travel, served

    @cached_property
    def is_small(self) -> bool:
        states = prod(len(self._work.jobs[job].stops) + 1 for job in self._served)
        return states <= MOST_STATES and len(self._work.robots) <= MOST_ROBOTS

    def find_least_service(self) -> int:
        """Return the least service cost of all jobs."""
        everything = (1 << len(self._served)) - 1
        least = {0: 0}
        for robot in range(len(self._work.robots)):
            own, before = self._list_costs(robot), least
            least = dict(before)
            for done, cost in before.items():
                for more, further in own.items():
                    if not done & more:
                        both = done | more
                        least[both] = min(least.get(both, cost + further), cost + further)
        return least.get(everything, 0)  # no tours: it bounds nothing

    def _list_costs(self, robot: int) -> dict[int, int]:
        """Return the least cost of each set of jobs on one robot."""
        jobs = [self._work.jobs[job] for job in self._served]
        state = self._work.robots[robot]
        start = (tuple(0 for _ in jobs), self._travel.get_start(robot))
        layer: dict[Progress, list[Label]] = {start: [(int(state.ready), 0)]}
        costs = dict[int, int]()
        while layer:
            following: dict[Progress, list[Label]] = {}
            for (progress, at), labels in layer.items():
                for number, label, to in self._list_steps(robot, progress, at, labels):
                    done = (*progress[:number], progress[number] + 1, *progress[number + 1 :])
                    _add_label(following.setdefault((done, to), []), label)
            for (progress, _), labels in following.items():
                if all(
                    done in {0, len(job.stops)} for done, job in zip(progress, jobs, strict=True)
                ):
                    served = sum(1 << k for k, done in enumerate(progress) if done)
                    least = min(cost for _, cost in labels)
                    costs[served] = min(costs.get(served, least), least)
            layer = following
        return costs

    def _list_steps(
        self, robot: int, progress: tuple[int, ...], at: int, labels: Sequence[Label]
    ) -> Iterator[tuple[int, Label, int]]:
        """Yield the next stops that a robot may serve: number of the job, label, place."""
        state = self._work.robots[robot]
        load = state.load + sum(
            stop.load
            for job, done in zip(self._served, progress, strict=True)
            for stop in self._work.jobs[job].stops[:done]
        )
        for number, (job, done) in enumerate(zip(self._served, progress, strict=True)):
            own = self._work.jobs[job]
            if robot not in own.robots or done == len(own.stops):
                continue
            stop = own.stops[done]
            if not 0 <= load + stop.load <= state.capacity:
                continue
            to = self._travel.place_of[stop.vertex]
            drive = self._bound.measure_drive(robot, at, to)
            release = stop.earliest if done else max(stop.earliest, self._bound.find_release(job))
            for now, cost in labels:
                end = max(now + drive, release) + stop.work
                if end >= NO_WAY or (stop.latest is not None and end > stop.latest):
                    continue
                more = self._measure_service(own, end) if done + 1 == len(own.stops) else 0
                yield number, (end, cost + more), to

    def _measure_service(self, job: BoundJob, end: int) -> int:
        late = self._work.late
        delay = late.numerator * measure_late(job, end)
        return job.weight * (late.denominator * (end - job.earliest) + delay)


def _add_label(labels: list[Label], new: Label) -> None:
    """Add a label unless another one is as early and as cheap; remove those that are worse."""
    if any(now <= new[0] and cost <= new[1] for now, cost in labels):
        return
    labels[:] = [old for old in labels if not (new[0] <= old[0] and new[1] <= old[1])]
    labels.append(new)
