"""Laps without end: the next laps of a plan are appended to the routes of robots that drive.

A plan repeats in *groups* of robots with one period each: those of its steady state, as chosen
timetables have them; without a steady state all robots repeat the whole plan. Before a robot comes
to the end of its route, its group gets the visits of one more period. Visits that robots have left
are dropped at the same time, so that the state of a control does not grow.

Where the rest was replanned, robots come home out of step. Then their group begins again with
the first visit of the plan, after all that is planned until then.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.routes import RouteToDrive, make_routes_to_drive
from rightofway.errors import InputError
from rightofway.model import Plan, Scenario, Track
from rightofway.precedence import Arrival, Part, ReleaseGraph
from rightofway.resume.rest_of_fleet import StopToMake

__all__ = ["LapsToDrive", "build_graph_behind_released"]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Group:
    """Robots that repeat their visits together.

    Attributes
    ----------
    robots
        Their numbers.
    period
        After how long their visits come again [ticks].
    visits
        For each of them how many of its last visits are a period.
    jobs
        For each of them how many jobs a period has.
    """

    robots: tuple[int, ...]
    period: int
    visits: tuple[int, ...]
    jobs: tuple[int, ...]


class MoreLaps(NamedTuple):
    """Routes with one more period.

    Attributes
    ----------
    routes
        Of all robots, from the visits on at which they have arrived.
    missed
        For robots that wait where their next lap begins, the work with which it begins: no order
        that was sent gets more work, so these robots have to come there once more.
    """

    routes: list[RouteToDrive]
    missed: dict[int, list[StopToMake]]


class LapsToDrive:
    """The laps of a plan, as many as are wanted.

    Parameters
    ----------
    plan
        A plan that keeps the rules, whose robots end where they have begun.
    count
        How many laps each robot makes at least, those of the plan included; 0 for laps without end.

    Raises
    ------
    InputError
        If a robot ends elsewhere, the visits of a period do not repeat, or the plan has jobs.
    """

    def __init__(self, plan: Plan, count: int = 0) -> None:
        if plan.scenario.jobs is not None:
            message = "has jobs, and jobs are done once (drive it without laps)"
            raise InputError.at("plan", message)
        self._count, self._routes = 0, make_routes_to_drive(plan)
        names = [robot.name for robot in plan.scenario.robots]
        for name, route in zip(names, self._routes, strict=True):
            if route.places[0] != route.places[-1]:
                message = f"{name} ends at {route.places[-1]}, not at {route.places[0]}"
                raise InputError.at("plan", f"{message} (laps need robots that return home)")
        self._groups = (
            [*self._list_steady_groups(plan, names)] if plan.steady else [self._make_whole_group()]
        )
        robots = [RobotLedger(route) for route in self._routes]
        for own, route in zip(robots, self._routes, strict=True):
            own.take_route(route)
        more = self.extend(robots, ahead=10**9)
        if more is None:
            raise InputError.at("plan", "no robot moves (laps need stops away from home)")
        if cycle := build_graph_behind_released(
            plan.scenario, more.routes, [0] * len(names)
        ).find_rotation():
            those = ", ".join(names[robot] for robot in sorted({part.robot for part in cycle}))
            message = f"{those} move round a circle at one instant from one lap to the next"
            raise InputError.at("plan", f"{message} (plan with rotations: false)")
        self._count = count

    def _make_whole_group(self) -> _Group:
        moving = [robot for robot, route in enumerate(self._routes) if route.end > 1]
        period = max(route.enter[-1] for route in self._routes) + 1
        return self._group(moving, period, [self._routes[robot].end - 1 for robot in moving])

    def _list_steady_groups(self, plan: Plan, names: Sequence[str]) -> list[_Group]:
        groups = []
        for group in plan.steady:
            visits = []
            for robot in group.robots:
                route, enter = self._routes[robot], plan.tracks[robot].enter
                again = int(np.searchsorted(enter, enter[-1] - group.period))
                if (
                    enter[again] != enter[-1] - group.period
                    or route.places[again] != (route.places[-1])
                ):
                    message = f"{names[robot]} makes less than a period, {group.period} ticks"
                    raise InputError.at("plan", f"{message} (give a plan with more laps)")
                visits.append(route.end - 1 - again)
            groups.append(self._group(group.robots, int(group.period), visits))
        return groups

    def _group(self, robots: Sequence[int], period: int, visits: Sequence[int]) -> _Group:
        routes = [self._routes[robot] for robot in robots]
        jobs = [
            len(route.jobs[0]) + sum(map(len, route.jobs[-count:]))
            for route, count in zip(routes, visits, strict=True)
        ]
        return _Group(robots=tuple(robots), period=period, visits=tuple(visits), jobs=tuple(jobs))

    def extend(self, robots: Sequence[RobotLedger], ahead: int = 0) -> MoreLaps | None:
        """Return all routes with the next period of each group that needs one; None if none does.

        Parameters
        ----------
        robots
            The records of each robot.
        ahead
            Visits and jobs that shall be left to each robot after its released parts, if more than
            those of a period.
        """
        routes, missed = [own.route for own in robots], dict[int, list[StopToMake]]()
        needy = [
            group
            for group in self._groups
            if any(
                _is_short(robots[robot], max(visits, ahead), max(jobs, ahead))
                for robot, visits, jobs in zip(group.robots, group.visits, group.jobs, strict=True)
                if jobs
            )
            and not any(robots[robot].is_off for robot in group.robots)
        ]
        if not needy or self._has_enough(robots):
            return None
        latest = max(route.enter[-1] for route in routes)
        for group in needy:
            in_step = all(routes[robot].in_step for robot in group.robots)
            for robot, visits in zip(group.robots, group.visits, strict=True):
                route, lap = routes[robot], self._routes[robot]
                if in_step:
                    later = route.enter[-1] - lap.enter[-1] + group.period
                    begin = lap.end - 1 - visits
                else:
                    later, begin = latest + 1, 0
                numbers = itertools.count(robots[robot].next_job)
                first = [
                    StopToMake(lap.places[0], f"job{next(numbers)}", work) for work in lap.work[0]
                ]
                if first and robots[robot].released == route.end - 1:
                    missed[robot], first = first, []
                routes[robot] = route.join(_make_next_lap(route, lap, begin, first, numbers), later)
        rows = zip(robots, routes, strict=True)
        return MoreLaps([route.cut_before(own.arrived) for own, route in rows], missed)

    def _has_enough(self, robots: Sequence[RobotLedger]) -> bool:
        """Return whether each robot has made as many laps as are wanted, or will on its route."""
        if not self._count:
            return False
        driving = [
            robots[robot]
            for group in self._groups
            for robot, visits in zip(group.robots, group.visits, strict=True)
            if visits and not robots[robot].is_off
        ]
        return all(own.count_laps() >= self._count for own in driving)

    def find_planned_visit(self, robot: int, visit: int) -> tuple[int, int]:
        """Return how often a robot in step has come to the end of the plan, and a visit of it.

        Parameters
        ----------
        robot
            Its number.
        visit
            The number of a visit, from the begin of all on.
        """
        last = self._routes[robot].end - 1
        if visit <= last:
            return 0, visit
        for group in self._groups:
            if robot in group.robots:
                visits = group.visits[group.robots.index(robot)]
                rounds, index = divmod(visit - last - 1, visits)
                return rounds + 1, last - visits + 1 + index
        raise AssertionError("a robot without laps has no visits beyond the plan")


def _is_short(own: RobotLedger, visits: int, jobs: int) -> bool:
    """Return whether a robot has less left than a period, after its released parts.

    Replanned laps may take few visits, as where a robot works at home: visits alone do not tell.
    """
    if own.route.end - 1 - own.released >= visits:
        return False
    left = own.route.jobs[own.released + 1 - own.route.first :]
    return sum(map(len, left)) <= jobs


def _make_next_lap(
    route: RouteToDrive,
    lap: RouteToDrive,
    begin: int,
    first: Sequence[StopToMake],
    numbers: Iterator[int],
) -> RouteToDrive:
    """Return the visits of a lap from one on, with numbers and jobs of a route that goes on.

    The first one is the last of the route, with the work at its end and that with which the lap
    begins.
    """
    part, last = lap.cut_before(begin), route.end - 1
    jobs = (tuple(f"job{next(numbers)}" for _ in names) for names in part.jobs[1:])
    return replace(
        part,
        first=last,
        jobs=((*route.jobs[-1], *(stop.job for stop in first)), *jobs),
        work=((*route.work[-1], *(stop.work for stop in first)), *part.work[1:]),
        lap_ends=(
            *(end for end in route.lap_ends if end == last),
            *(end + last - begin for end in part.lap_ends if end > begin),
        ),
        in_step=True,
    )


def build_graph_behind_released(
    scenario: Scenario,
    routes: Sequence[RouteToDrive],
    released: Sequence[int],
    absent: Collection[int] = (),
) -> ReleaseGraph:
    """Return who waits for whom: for all that is released, then in the order of planned times.

    Parameters
    ----------
    scenario
        The problem: which robots exclude each other where.
    routes
        Where robots go, from the visits on at which they have arrived.
    released
        The last released part of each robot; all up to it goes first.
    absent
        Robots that are off the floor: nobody waits for them, and they wait for nobody.
    """
    present = [robot for robot in range(len(routes)) if robot not in absent]
    ends = [route.end for route in routes]
    if not present:
        return ReleaseGraph(ends, {}, [route.first for route in routes])
    if len(present) == len(routes):
        return _make_present_graph(scenario, routes, released)
    robots = tuple(scenario.robots[robot] for robot in present)
    fleet = replace(scenario, robots=robots, clock=scenario.problem.clock)
    graph = _make_present_graph(fleet, [routes[k] for k in present], [released[k] for k in present])
    waits = {
        Part(present[part.robot], part.number): [
            Arrival(present[arrival.robot], arrival.visit) for arrival in graph.waits(part)
        ]
        for part in graph.list_waiting_parts()
    }
    return ReleaseGraph(ends, waits, [route.first for route in routes])


def _make_present_graph(
    scenario: Scenario, routes: Sequence[RouteToDrive], released: Sequence[int]
) -> ReleaseGraph:
    roadmap = scenario.roadmap
    begins = min(route.enter[0] for route in routes)
    span = max(route.enter[-1] for route in routes) - begins + 1
    tracks = [
        Track.of(
            roadmap.unfold_route(list(map(roadmap.get_vertex, route.places))),
            [
                tick - begins + span * (route.first + index > end)
                for index, tick in enumerate(route.enter)
            ],
        )
        for route, end in zip(routes, released, strict=True)
    ]
    return ReleaseGraph.of(scenario, tracks, [route.first for route in routes])
