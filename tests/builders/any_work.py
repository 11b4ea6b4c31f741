"""Small random work with travel, as values: jobs and robots in ticks, places in a plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from random import Random

import numpy as np

from rightofway.assign import Travel
from rightofway.assign.travel import BatteryKind
from rightofway.model.units import Tick
from rightofway.model.work import (
    BoundBattery,
    BoundJob,
    BoundRobot,
    BoundStop,
    Work,
    WorkObjective,
)
from rightofway.site import VertexId

HALF = 0.5

OBJECTIVES: tuple[WorkObjective, ...] = ("service", "flowtime", "makespan", "both")


@dataclass(frozen=True, slots=True)
class _Draw:
    """The sizes of a draw: all places are in a square of this side."""

    random: Random
    n_jobs: int
    n_robots: int
    size: int

    @property
    def n_places(self) -> int:
        return 2 * self.n_jobs + 3

    def draw_place(self) -> VertexId:
        return VertexId(self.random.randrange(self.n_places))


def draw_work(
    seed: int,
    *,
    n_jobs: int,
    n_robots: int,
    size: int = 6,
    windows: bool = False,
    batteries: bool = False,
    after: bool = False,
    begun: bool = False,
    objective: WorkObjective = "service",
) -> tuple[Work, Travel]:
    """Draw jobs of one to three stops, robots, and travel by steps along the axes of a plane.

    With batteries, a robot that returns home starts at the point of its home: an empty tour is
    possible with any state of charge.
    """
    random = Random(seed)  # noqa: S311
    draw = _Draw(random, n_jobs, n_robots, size)
    battery = _draw_battery(random, size) if batteries else None
    charging = tuple(sorted(VertexId(p) for p in random.sample(range(draw.n_places), 2)))
    returns = random.random() < 0.6
    robots = [_draw_robot(draw, robot, battery, charging, returns) for robot in range(n_robots)]
    jobs = [_draw_job(draw, windows) for _ in range(n_jobs)]
    if begun:
        _begin_job(random, jobs, robots)
    if after:
        jobs = _order_jobs(random, jobs)
    work = Work(
        jobs=tuple(jobs),
        robots=tuple(robots),
        objective=objective,
        late=random.choice([Fraction(10), Fraction(0), Fraction(3, 2)]),
    )
    return work, _measure(draw, robots)


def _draw_battery(random: Random, size: int) -> BoundBattery:
    full = random.randrange(3 * size, 6 * size)
    return BoundBattery(
        full=full,
        drive=(),
        on=random.randrange(2),
        work=random.randrange(2),
        charge=random.randrange(2, 6),
        reserve=random.randrange(3),
        soc=full,
    )


def _draw_robot(
    draw: _Draw,
    robot: int,
    battery: BoundBattery | None,
    charging: tuple[VertexId, ...],
    returns: bool,
) -> BoundRobot:
    random = draw.random
    if battery is not None:
        battery = replace(battery, soc=random.randrange(battery.full + 1))
    return BoundRobot(
        start=VertexId(draw.n_places + robot),
        ready=Tick(random.choice([0, 0, random.randrange(draw.size)])),
        heading=None,
        home=draw.draw_place() if returns else None,
        turn=Tick(0),
        capacity=random.randrange(1, 4),
        load=0,
        battery=battery,
        charging=charging,
    )


def _draw_job(draw: _Draw, windows: bool) -> BoundJob:
    random = draw.random
    load = random.randrange(1, 3)
    loads = random.choice([[0], [0], [load, -load], [load, -load], [load, -load], [2, -1, -1]])
    stops = tuple(_draw_stop(draw, change, windows) for change in loads)
    robots = sorted(random.sample(range(draw.n_robots), random.randrange(1, draw.n_robots + 1)))
    return BoundJob(
        stops=stops,
        first=0,
        weight=random.randrange(1, 4),
        due=Tick(random.randrange(4 * draw.size)) if random.random() < HALF else None,
        robots=tuple(robots if random.random() < HALF else range(draw.n_robots)),
        after=(),
        begun_by=None,
        earliest=stops[0].earliest,
    )


def _draw_stop(draw: _Draw, load: int, windows: bool) -> BoundStop:
    random, work, latest = draw.random, draw.random.randrange(4), None
    earliest = random.randrange(3 * draw.size) if windows and random.random() < HALF else 0
    if windows and random.random() < HALF:
        latest = Tick(earliest + work + random.randrange(1, 4 * draw.size))
    return BoundStop(
        vertex=draw.draw_place(),
        work=Tick(work),
        load=load,
        earliest=Tick(earliest),
        latest=latest,
    )


def _begin_job(random: Random, jobs: list[BoundJob], robots: list[BoundRobot]) -> None:
    """Let a robot have done the first stop of a job that has several."""
    several = [number for number, job in enumerate(jobs) if len(job.stops) > 1]
    if not several:
        return
    number, robot = random.choice(several), random.randrange(len(robots))
    job, load = jobs[number], jobs[number].stops[0].load
    jobs[number] = replace(
        job,
        stops=tuple(replace(stop, latest=None) for stop in job.stops[1:]),
        first=1,
        robots=(robot,),
        begun_by=robot,
        earliest=Tick(0),
    )
    state = robots[robot]
    robots[robot] = replace(state, load=load, capacity=max(state.capacity, load))


def _order_jobs(random: Random, jobs: list[BoundJob]) -> list[BoundJob]:
    """Let about half of the jobs come after an earlier one."""
    return [
        replace(job, after=(random.randrange(number),))
        if number and job.begun_by is None and random.random() < HALF
        else job
        for number, job in enumerate(jobs)
    ]


def _measure(draw: _Draw, robots: Sequence[BoundRobot]) -> Travel:
    """Draw the points of places and starts; robots are of two kinds, a quick and a slow one."""
    random, n_places = draw.random, draw.n_places
    points = [
        (random.randrange(draw.size), random.randrange(draw.size))
        for _ in range(n_places + len(robots))
    ]
    for number, robot in enumerate(robots):
        if robot.battery is not None and robot.home is not None:
            points[n_places + number] = points[robot.home]
    at = np.array(points)
    steps = np.abs(at[:, None] - at[None, :]).sum(axis=2)
    slow = random.randrange(2, 4)
    kind_of = tuple(random.randrange(2) for _ in robots)
    battery, charging = robots[0].battery, robots[0].charging
    kinds = []
    for factor in (1, slow) if battery is not None else ():
        assert battery is not None
        to = (steps + battery.on * factor * steps)[:, list(charging)].min(axis=1)
        drives = steps.astype(np.int64)
        kinds.append(
            BatteryKind(
                battery=battery,
                charging=tuple(charging),
                drives=drives,
                to_charging=to.astype(np.int64),
            )
        )
    return Travel(
        vertices=tuple(VertexId(v) for v in range(len(points))),
        ticks=np.stack([steps, slow * steps]).astype(np.int32),
        kind_of=kind_of,
        batteries=tuple(kinds),
        battery_of=kind_of if battery is not None else (-1,) * len(robots),
    )
