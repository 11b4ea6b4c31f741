"""Assignments of jobs to robots: tours by insertion and large neighbourhood search.

Robots do not meet here: tours count travel times of robots alone. A planner makes routes of tours.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, chain, pairwise
from typing import NamedTuple, cast

import numpy as np

from rightofway import _core
from rightofway.assign.travel import Travel, scale_battery
from rightofway.model.units import Tick
from rightofway.model.work import Assignment, Tour, TourItem, UnservedReason, Work

__all__ = ["AssignmentCost", "AssignmentSearch"]

_OBJECTIVES = {
    "service": _core.TourObjective.service,
    "flowtime": _core.TourObjective.flowtime,
    "makespan": _core.TourObjective.makespan,
    "both": _core.TourObjective.both,
}

_REASONS: dict[_core.UnservedReason, UnservedReason] = {
    _core.UnservedReason.robot: "robot",
    _core.UnservedReason.way: "way",
    _core.UnservedReason.latest: "latest",
    _core.UnservedReason.battery: "battery",
    _core.UnservedReason.after: "after",
    _core.UnservedReason.not_found: "not found",
}


class AssignmentCost(NamedTuple):
    """The cost of an assignment without other robots in the way; compared from left to right.

    Attributes
    ----------
    missing
        The number of begun jobs that are in no tour. A plan needs 0.
    unserved
        The weights of the other jobs that are in no tour.
    value
        The objective of the work [ticks times weights; for `service`, of which
        ``Work.late.denominator`` are one].
    flowtime
        The completion times of robots by their weights [ticks].
    """

    missing: int
    unserved: int
    value: int
    flowtime: int


class AssignmentSearch:
    """Search for tours; the best assignment can be read between calls.

    Parameters
    ----------
    work
        Jobs, robots and the objective.
    travel
        Travel times and energies, which may contain the delays of an earlier plan.
    weights
        The weight of each robot; empty where all are 1.
    seed
        For all that is drawn.

    Raises
    ------
    KernelLimit
        If costs might not fit 64 bits.

    Notes
    -----
    The result depends on the seed and the steps alone, not on the time that they take.
    """

    def __init__(
        self, work: Work, travel: Travel, *, weights: Sequence[int] = (), seed: int = 0
    ) -> None:
        self._work = work
        self._travel = travel
        self._first = list(accumulate((len(job.stops) for job in work.jobs), initial=0))
        self._items = [
            (number, job.first + k)
            for number, job in enumerate(work.jobs)
            for k in range(len(job.stops))
        ]
        problem = _core.TourProblem(
            len(travel.vertices),
            np.ascontiguousarray(travel.ticks, np.int32).reshape(-1),
            _bind_robots(work, travel, weights or [1] * len(work.robots)),
            _bind_jobs(work, travel),
            _bind_rules(work),
            _bind_batteries(travel),
            _OBJECTIVES[work.objective],
            work.late.denominator,
            work.late.numerator,
        )
        self._search = _core.TourSearch(problem, seed)

    def start(self, assignment: Assignment) -> None:
        """Insert the jobs as they are in an assignment, as far as that is feasible.

        Charges are planned again. Call it before `construct`.
        """
        tours = [
            [self.find_number(item.job, item.stop)
             for item in tour if item.job is not None and item.stop is not None]
            for tour in assignment.tours
        ]  # fmt: skip
        self._search.start(_number_lists(tours), _as_ids(chain.from_iterable(tours)))

    def construct(self, time_limit: float | None = None) -> bool:
        """Insert all jobs that have no tour, and return whether there was enough time.

        Parameters
        ----------
        time_limit
            When to stop [s]; None for no limit.
        """
        return self._search.construct(time_limit)

    def improve(self, n_steps: int, time_limit: float | None = None) -> int:
        """Do steps of large neighbourhood search, and return the number of them.

        Parameters
        ----------
        n_steps
            The most steps.
        time_limit
            When to stop [s]; None for no limit.
        """
        return self._search.improve(n_steps, time_limit)

    def compare_robots(self, job: int) -> tuple[list[int | None], int]:
        """Return the objective with a job on each robot, and without the job.

        The job is at its best place in the best tour of the robot; None if it fits nowhere. It is
        in no other tour, and the jobs that come after it are in none. Values are those of
        `AssignmentCost.value`.
        """
        *values, without = self._search.compare_robots(job).tolist()
        return [None if value == _core.NEVER else value for value in values], without

    @property
    def native(self) -> _core.TourSearch:
        """The search in the native core, for other kernels."""
        return self._search

    def find_item(self, stop: int) -> tuple[int, int]:
        """Return the job and the stop, among all its stops, of a stop in the native core."""
        return self._items[stop]

    def find_number(self, job: int, stop: int) -> int:
        """Return the number of a stop in the native core."""
        return self._first[job] + stop - self._work.jobs[job].first

    @property
    def cost(self) -> AssignmentCost:
        """The cost of the best assignment."""
        return AssignmentCost(*self._search.cost)

    @property
    def assignment(self) -> Assignment:
        """The best assignment."""
        jobs, reasons = self._search.unserved()
        return Assignment(
            tours=tuple(self._list_tours()),
            unserved=tuple(
                (job, _REASONS[_core.UnservedReason(reason)])
                for job, reason in zip(jobs.tolist(), reasons.tolist(), strict=True)
            ),
        )

    def list_ends(self) -> list[tuple[Tick, ...]]:
        """Return when the items of each best tour end, without other robots in the way [ticks]."""
        first, _, _, begins, ticks = (array.tolist() for array in self._search.tours())
        ends = [Tick(begin + duration) for begin, duration in zip(begins, ticks, strict=True)]
        return [tuple(ends[a:b]) for a, b in pairwise(first)]

    def _list_tours(self) -> list[Tour]:
        first, stops, places, _, ticks = (array.tolist() for array in self._search.tours())
        items = [
            TourItem(
                job=None if stop < 0 else self._items[stop][0],
                stop=None if stop < 0 else self._items[stop][1],
                vertex=self._travel.vertices[place],
                duration=Tick(duration),
            )
            for stop, place, duration in zip(stops, places, ticks, strict=True)
        ]
        return [tuple(items[a:b]) for a, b in pairwise(first)]


def _as_ids(values: object) -> np.ndarray[tuple[int], np.dtype[np.int32]]:
    return np.fromiter(cast("Sequence[int]", values), np.int32)


def _as_wholes(values: object) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
    return np.fromiter(cast("Sequence[int]", values), np.int64)


def _number_lists(
    lists: Sequence[Sequence[int]],
) -> np.ndarray[tuple[int], np.dtype[np.int32]]:
    """Return where each of several lists begins in all of them together."""
    return _as_ids(accumulate((len(members) for members in lists), initial=0))


def _bind_robots(work: Work, travel: Travel, weights: Sequence[int]) -> _core.TourRobots:
    states = []
    for robot, kind in zip(work.robots, travel.battery_of, strict=True):
        full = travel.batteries[kind].battery.full if kind >= 0 else 0
        states.append(scale_battery(robot.battery, full).soc if robot.battery else 0)
    return _core.TourRobots(
        travel=_as_ids(travel.kind_of),
        battery=_as_ids(travel.battery_of),
        start=_as_ids(map(travel.get_start, range(len(work.robots)))),
        end=_as_ids(
            -1 if robot.home is None else travel.place_of[robot.home] for robot in work.robots
        ),
        ready=_as_wholes(robot.ready for robot in work.robots),
        capacity=_as_ids(robot.capacity for robot in work.robots),
        load=_as_ids(robot.load for robot in work.robots),
        soc=_as_wholes(states),
        weight=_as_wholes(weights),
    )


def _bind_jobs(work: Work, travel: Travel) -> _core.TourJobs:
    stops = [stop for job in work.jobs for stop in job.stops]
    return _core.TourJobs(
        first_stop=_number_lists([job.stops for job in work.jobs]),  # type: ignore[misc]
        place=_as_ids(travel.place_of[stop.vertex] for stop in stops),
        work=_as_wholes(stop.work for stop in stops),
        load=_as_ids(stop.load for stop in stops),
        earliest=_as_wholes(stop.earliest for stop in stops),
        latest=_as_wholes(_limit(stop.latest) for stop in stops),
    )


def _bind_rules(work: Work) -> _core.TourRules:
    jobs = work.jobs
    return _core.TourRules(
        weight=_as_wholes(job.weight for job in jobs),
        release=_as_wholes(job.earliest for job in jobs),
        due=_as_wholes(_limit(job.due) for job in jobs),
        begun_by=_as_ids(-1 if job.begun_by is None else job.begun_by for job in jobs),
        first_robot=_number_lists([job.robots for job in jobs]),
        robots=_as_ids(robot for job in jobs for robot in job.robots),
        first_after=_number_lists([job.after for job in jobs]),
        after=_as_ids(earlier for job in jobs for earlier in job.after),
    )


def _limit(tick: Tick | None) -> int:
    return _core.NEVER if tick is None else tick


def _bind_batteries(travel: Travel) -> _core.TourBatteries:
    kinds = travel.batteries
    tables = {id(kind.drives): kind.drives for kind in kinds}
    number = {key: index for index, key in enumerate(tables)}
    empty = [np.empty(0, np.int64)]
    return _core.TourBatteries(
        full=_as_wholes(kind.battery.full for kind in kinds),
        on=_as_wholes(kind.battery.on for kind in kinds),
        work=_as_wholes(kind.battery.work for kind in kinds),
        charge=_as_wholes(kind.battery.charge for kind in kinds),
        reserve=_as_wholes(kind.battery.reserve for kind in kinds),
        table=_as_ids(number[id(kind.drives)] for kind in kinds),
        drive=np.concatenate([drives.reshape(-1) for drives in tables.values()] or empty),
        to_charging=np.concatenate([kind.to_charging for kind in kinds] or empty),
        first_charging=_number_lists([kind.charging for kind in kinds]),
        charging=_as_ids(place for kind in kinds for place in kind.charging),
    )
