"""The judge of jobs, written a second time from its definition: slowly, tick by tick, in fractions.

It reads a scenario and a plan as users write them, and rounds times by itself. `judge` returns the
broken rules, each with the robots or the job concerned; `measure` returns what a plan costs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from math import atan2, ceil, degrees, floor, inf
from typing import NamedTuple

from rightofway.model import Battery, Job, Plan, PlannedItem, Robot, RobotState, Scenario
from tests.oracles.judge import Site

__all__ = ["Broken", "Fleet", "Own", "judge", "measure"]

Broken = tuple[str, int]
"""A rule (item, load, charge, end; job, time) with the index of the robot, or of the job."""


class Own(NamedTuple):
    """What a robot does: its visits in order, and its tour."""

    vertices: Sequence[int]
    enter: Sequence[int]
    tour: Sequence[PlannedItem]


class Fleet:
    """A scenario with jobs: everything in ticks is worked out here."""

    def __init__(self, scenario: Scenario) -> None:
        assert scenario.jobs is not None, "the scenario has jobs"
        self.scenario, self.jobs, self.site = scenario, scenario.jobs, Site(scenario)
        self.tick = self.site.tick
        self.begun = {
            name: (robot, count)
            for robot, own in enumerate(scenario.robots)
            for name, count in self.state(own).begun
        }

    def state(self, robot: Robot) -> RobotState:
        """Return where a robot begins."""
        return robot.start or RobotState(at=robot.home)

    def ready(self, robot: Robot) -> int:
        """Return when a robot may begin [ticks]."""
        return ceil(self.state(robot).ready / self.tick)

    def returns(self, robot: Robot) -> bool:
        """Tell whether a robot has to end at home."""
        return (robot.ends or self.scenario.rules.ends) == "home"

    def stop_turn(self, robot: Robot) -> int:
        """Return how long a robot turns after what it does in a visit [ticks]."""
        rules, grid = self.scenario.rules, self.scenario.roadmap.grid
        rate = rules.turn_rate if robot.turn_rate is None else robot.turn_rate
        turn = rules.turn if robot.turn is None else robot.turn
        if turn is None:
            turn = "cell" if grid is not None and rate is None else Fraction(0)
        if turn == "cell":
            assert grid is not None, "cells have a size"
            turn = grid.cell_size / robot.speed
        return ceil(turn / self.tick)

    def corner(self, robot: Robot, own: Own, visit: int) -> int:
        """Return how long a robot turns on the spot before the drive that ends a visit [ticks]."""
        here, after = own.vertices[visit : visit + 2]
        if visit:
            return self.site.turn(robot, own.vertices[visit - 1], here, after)
        rules, heading = self.scenario.rules, self.state(robot).heading
        rate = rules.turn_rate if robot.turn_rate is None else robot.turn_rate
        if rate is None or heading is None:
            return 0
        frame, (a, b) = self.scenario.roadmap.frame, (self.site.at[v] for v in (here, after))
        x, y = (float(b[k] - a[k]) for k in (0, 1))
        course = degrees(atan2(-y if frame.y_up else y, x)) + degrees(frame.yaw)
        angle = abs(course - float(heading)) % 360
        return ceil(Fraction(round(min(angle, 360 - angle) * 10**6), 10**6) / rate / self.tick)

    def departure(self, robot: Robot, own: Own, visit: int) -> float:
        """Return until when a robot may do something in a visit, its last turn not counted."""
        if visit == len(own.vertices) - 1:
            return inf
        edge = (own.vertices[visit], own.vertices[visit + 1])
        drive = self.site.drive(robot, edge) or 0
        return own.enter[visit + 1] - drive - self.corner(robot, own, visit)

    def rest(self, robot: Robot, own: Own) -> int:
        """Return from when on a robot rests [ticks]."""
        end = max((item.end for item in own.tour[-1:]), default=0)
        return max(self.ready(robot), own.enter[-1], end)

    def completion(self, robot: Robot, own: Own) -> int:
        """Return when a robot completes [ticks]."""
        if own.tour and not self.returns(robot):
            return max(self.ready(robot), own.tour[-1].end)
        return self.rest(robot, own)

    def chargers(self, robot: Robot) -> set[int]:
        """Return where a robot may charge."""
        if robot.charging is not None:
            return {*robot.charging}
        return {*self.scenario.charging, *self.scenario.roadmap.drawing.charging}


def list_robots(plan: Plan) -> list[Own]:
    """Return what each robot does."""
    assert plan.tours is not None, "a plan with jobs has tours"
    return [
        Own([int(vertex) for vertex in track.vertices], [int(tick) for tick in track.enter], tour)
        for track, tour in zip(plan.tracks, plan.tours, strict=True)
    ]


def judge(plan: Plan) -> set[Broken]:
    """Return what is wrong with the tours of a plan; drives and bookings are not judged."""
    fleet, robots = Fleet(plan.scenario), list_robots(plan)
    unserved = {job for job, _ in plan.unserved}
    broken = set[Broken]()
    for index, own in enumerate(robots):
        robot = plan.scenario.robots[index]
        broken |= {(rule, index) for rule in _break_robot(fleet, robot, own)}
        if robot.battery is not None and not _lasts(fleet, robot, own):
            broken.add(("charge", index))
    for index, job in enumerate(fleet.jobs):
        done = [
            (robot, item)
            for robot, own in enumerate(robots)
            for item in own.tour
            if item.job == index
        ]
        if not _is_in_time(fleet, job, done):
            broken.add(("time", index))
        if index in unserved:
            if done or job.name in fleet.begun:
                broken.add(("job", index))
            continue
        if not _is_done(fleet, job, done):
            broken.add(("job", index))
        if done and job.name not in fleet.begun:
            broken |= {(rule, index) for rule in _break_order(fleet, job, done, robots, unserved)}
    return broken


def _break_robot(fleet: Fleet, robot: Robot, own: Own) -> Iterator[str]:
    if own.vertices[0] != fleet.state(robot).at or own.enter[0] != 0:
        yield "end"
    if fleet.returns(robot) and own.vertices[-1] != robot.home:
        yield "end"
    if len(own.vertices) > 1 and fleet.departure(robot, own, 0) < fleet.ready(robot):
        yield "item"
    for before, item in pairwise(own.tour):
        if item.visit < before.visit or item.begin < before.end:
            yield "item"
    if any(not _is_right(fleet, robot, own, item) for item in own.tour):
        yield "item"
    yield from _break_loads(fleet, robot, own)


def _break_loads(fleet: Fleet, robot: Robot, own: Own) -> Iterator[str]:
    """Yield loads out of range, and charges elsewhere."""
    begun = fleet.state(robot).begun
    load = sum(stop.load for name, count in begun for stop in _job(fleet, name).stops[:count])
    for item in own.tour:
        if item.job is None and own.vertices[item.visit] not in fleet.chargers(robot):
            yield "charge"
        if item.job is not None and item.stop is not None:
            load += fleet.jobs[item.job].stops[item.stop].load
            if not 0 <= load <= (1 if robot.capacity is None else robot.capacity):
                yield "load"


def _is_right(fleet: Fleet, robot: Robot, own: Own, item: PlannedItem) -> bool:
    """Tell whether an item is inside its visit, at its vertex, for as long as it has to be."""
    if item.begin < own.enter[item.visit] or item.begin < fleet.ready(robot):
        return False
    if item.end + fleet.stop_turn(robot) > fleet.departure(robot, own, item.visit):
        return False
    if item.job is None or item.stop is None:
        return item.end >= item.begin
    stop = fleet.jobs[item.job].stops[item.stop]
    ticks = ceil(stop.work / fleet.tick)
    return own.vertices[item.visit] == stop.at and item.end - item.begin == ticks


def _job(fleet: Fleet, name: str) -> Job:
    return next(job for job in fleet.jobs if job.name == name)


def _is_done(fleet: Fleet, job: Job, done: Sequence[tuple[int, PlannedItem]]) -> bool:
    """Tell whether a job is done whole, in order, by one robot that may."""
    by, first = fleet.begun.get(job.name, (None, 0))
    order = [item.stop for _, item in done]
    if order != list(range(first, len(job.stops))) or len({robot for robot, _ in done}) != 1:
        return False
    number = done[0][0]
    robot = fleet.scenario.robots[number]
    return (
        by in {None, number}
        and job.robot in {None, robot.name}
        and (not job.types or robot.type in job.types)
    )


def _is_in_time(fleet: Fleet, job: Job, done: Sequence[tuple[int, PlannedItem]]) -> bool:
    _, first = fleet.begun.get(job.name, (None, 0))
    for _, item in done:
        if item.stop is None or item.stop < first:
            continue
        stop = job.stops[item.stop]
        if item.begin * fleet.tick < stop.earliest:
            return False
        has_latest = stop.latest is not None and job.name not in fleet.begun
        if has_latest and stop.latest is not None and item.end * fleet.tick > stop.latest:
            return False
    return True


def _break_order(
    fleet: Fleet,
    job: Job,
    done: Sequence[tuple[int, PlannedItem]],
    robots: Sequence[Own],
    unserved: set[int],
) -> Iterator[str]:
    begin = min(item.begin for _, item in done)
    for name in job.after:
        index = next(number for number, other in enumerate(fleet.jobs) if other.name == name)
        if index in unserved or any(
            item.job == index and item.end > begin for own in robots for item in own.tour
        ):
            yield "job"


def _lasts(fleet: Fleet, robot: Robot, own: Own) -> bool:
    """Tell whether the battery of a robot lasts, tick by tick."""
    battery = dict(fleet.scenario.batteries)[robot.battery or ""]
    soc = start = fleet.state(robot).soc
    for tick in range(fleet.ready(robot), fleet.rest(robot, own) + 1):
        if tick > fleet.ready(robot):
            soc = _pass_tick(fleet, battery, own, soc, tick)
        soc -= sum(
            battery.drive * fleet.site.edges[edge].length
            for edge, enter in zip(pairwise(own.vertices), own.enter[1:], strict=True)
            if enter == tick and edge in fleet.site.edges
        )
        least = battery.reserve
        if start < battery.reserve and (
            not own.tour or (own.tour[0].job is None and tick < own.tour[0].end)
        ):
            least = Fraction(0)
        if soc < least:
            return False
    return not own.tour or soc - way_to_charger(fleet, robot, battery, own) >= battery.reserve


def _pass_tick(fleet: Fleet, battery: Battery, own: Own, soc: Fraction, tick: int) -> Fraction:
    """Return the state of charge after the tick that ends now, without drives."""
    during = [item for item in own.tour if item.begin < tick <= item.end]
    if any(item.job is None for item in during):
        return min(Fraction(1), soc + battery.charge * fleet.tick)
    return soc - (battery.on + len(during) * battery.work) * fleet.tick


def way_to_charger(fleet: Fleet, robot: Robot, battery: Battery, own: Own) -> Fraction | float:
    """Return the least share for a drive to a charging place, by relaxing all edges again."""
    cost: dict[int, Fraction | float] = {at: Fraction(0) for at in fleet.chargers(robot)}
    for _ in range(len(fleet.site.at)):
        for (tail, head), kind in fleet.site.edges.items():
            drive = fleet.site.drive(robot, (tail, head))
            if drive is None:
                continue
            share = battery.drive * kind.length + battery.on * drive * fleet.tick
            cost[tail] = min(cost.get(tail, inf), cost.get(head, inf) + share)
    return cost.get(own.vertices[-1], inf)


def measure(plan: Plan) -> tuple[Fraction, Fraction]:
    """Return the weight of the unserved jobs, and the service cost of the others [time units]."""
    fleet, robots = Fleet(plan.scenario), list_robots(plan)
    unserved = {job for job, _ in plan.unserved}
    late = Fraction(10) if plan.scenario.rules.late is None else plan.scenario.rules.late
    weight = sum((fleet.jobs[job].weight for job in unserved), Fraction(0))
    cost = Fraction(0)
    for index, job in enumerate(fleet.jobs):
        if index not in unserved:
            end = max(item.end for own in robots for item in own.tour if item.job == index)
            cost += job.weight * price(fleet, job, end, late)
    return weight, cost


def price(fleet: Fleet, job: Job, end: int, late: Fraction) -> Fraction:
    """Return what the end of a job costs without its weight [time units]."""
    earliest = 0 if job.name in fleet.begun else ceil(job.stops[0].earliest / fleet.tick)
    cost = Fraction(end - earliest)
    if job.due is not None:
        cost += late * max(0, end - floor(job.due / fleet.tick))
    return cost * fleet.tick
