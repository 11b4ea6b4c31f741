"""Tours compared with PyVRP: flowtime of jobs with windows, capacities, pickup and delivery.

``python -m benchmarks.tours --instances 20 --seconds 10`` draws work of 50 to 200 jobs for 5 to 20
robots, lets both search for the same time, one after the other on one core, and prints a table.
Robots do not meet: PyVRP has no map. ``--objective service`` runs only our search. Needs
``pip install pyvrp==0.14.*``.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from random import Random
from statistics import mean
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.common import table
from rightofway.assign import AssignmentCost, AssignmentSearch, Travel
from rightofway.model.units import Tick
from rightofway.model.work import BoundJob, BoundRobot, BoundStop, Work
from rightofway.site import VertexId

SIDE = 100
"""Places are in a square of this side; a step along an axis takes a tick."""

SHARE = 0.5
"""Of jobs with a time window, and of jobs that carry a load."""


def draw_instance(seed: int) -> tuple[Work, Travel]:
    """Draw jobs and robots that start at homes of their own."""
    random = Random(seed)  # noqa: S311
    n_jobs, n_robots = random.randrange(50, 201), random.randrange(5, 21)
    horizon = 2 * SIDE * n_jobs // n_robots
    jobs, points = list[BoundJob](), list[tuple[int, int]]()
    for _ in range(n_jobs):
        load = random.randrange(1, 4) if random.random() < SHARE else 0
        places = range(len(points), len(points) + (2 if load else 1))
        points += [_draw_point(random) for _ in places]
        opens = random.randrange(horizon)
        stops = [_draw_stop(random, place, opens) for place in places]
        if load:
            stops = [replace(stops[0], load=load, latest=None), replace(stops[1], load=-load)]
        jobs.append(_make_job(tuple(stops), n_robots))
    homes = range(len(points), len(points) + n_robots)
    points += [_draw_point(random) for _ in homes]
    robots = tuple(_make_robot(home, n_robots, random.randrange(3, 7)) for home in homes)
    points += points[homes.start :]
    work = Work(jobs=tuple(jobs), robots=robots, objective="flowtime", late=Fraction(10))
    return work, _measure(points, n_robots)


def _draw_point(random: Random) -> tuple[int, int]:
    return random.randrange(SIDE), random.randrange(SIDE)


def _draw_stop(random: Random, place: int, opens: int) -> BoundStop:
    has_window = random.random() < SHARE
    earliest = opens if has_window else 0
    work = random.randrange(5, 20)
    latest = Tick(opens + random.randrange(SIDE, 4 * SIDE) + work) if has_window else None
    return BoundStop(
        vertex=VertexId(place), work=Tick(work), load=0, earliest=Tick(earliest), latest=latest
    )


def _make_job(stops: tuple[BoundStop, ...], n_robots: int) -> BoundJob:
    return BoundJob(
        stops=stops, first=0, weight=1, due=None, robots=tuple(range(n_robots)), after=(),
        begun_by=None, earliest=stops[0].earliest,
    )  # fmt: skip


def _make_robot(home: int, n_robots: int, capacity: int) -> BoundRobot:
    return BoundRobot(
        start=VertexId(home + n_robots), ready=Tick(0), heading=None, home=VertexId(home),
        turn=Tick(0), capacity=capacity, load=0, battery=None, charging=(),
    )  # fmt: skip


def _measure(points: list[tuple[int, int]], n_robots: int) -> Travel:
    at = np.array(points)
    steps = np.abs(at[:, None] - at[None, :]).sum(axis=2).astype(np.int32)
    return Travel(
        vertices=tuple(VertexId(place) for place in range(len(points))),
        ticks=steps[None],
        kind_of=(0,) * n_robots,
        batteries=(),
        battery_of=(-1,) * n_robots,
    )


def search(work: Work, travel: Travel, seconds: float) -> Iterator[tuple[float, AssignmentCost]]:
    """Yield the seconds since the start and the cost: of the first assignment and of the last."""
    began = perf_counter()
    tours = AssignmentSearch(work, travel, seed=1)
    tours.construct()
    yield perf_counter() - began, tours.cost
    steps = tours.improve(10**9, seconds - (perf_counter() - began))
    yield steps / seconds, tours.cost


def run_pyvrp(work: Work, travel: Travel, seconds: float) -> tuple[int, int]:
    """Return the number of unserved jobs and the flowtime of PyVRP's best solution."""
    pyvrp, stop = import_module("pyvrp"), import_module("pyvrp.stop")
    model = pyvrp.Model()
    steps = travel.ticks[0]
    n_places = len(travel.vertices) - len(work.robots)
    at = [model.add_location(0, place) for place in range(n_places)]
    for robot in work.robots:
        assert robot.home is not None
        depot = model.add_depot(at[robot.home])
        model.add_vehicle_type(
            1, robot.capacity, depot, depot, unit_distance_cost=0, unit_duration_cost=1,
            start_late=0,
        )  # fmt: skip
    prize = int(2 * steps.max() * len(travel.vertices))
    for job in work.jobs:
        add_job(model, at, job, prize)
    for tail in range(n_places):
        for head in range(n_places):
            ticks = int(steps[tail, head])
            model.add_edge(at[tail], at[head], distance=ticks, duration=ticks)
    best = model.solve(stop.MaxRuntime(seconds), seed=1, display=False).best
    if not best.is_feasible():
        return len(work.jobs), 0
    return round(best.uncollected_prizes() / prize), best.duration_cost()


def add_job(model: Any, at: list[Any], job: BoundJob, prize: int) -> None:
    """Add a client, or a shipment for a job with a load."""
    windows = [
        {"tw_early": stop.earliest, "service_duration": stop.work}
        | ({} if stop.latest is None else {"tw_late": stop.latest - stop.work})
        for stop in job.stops
    ]
    if len(job.stops) == 1:
        model.add_client(at[job.stops[0].vertex], 0, 0, **windows[0], prize=prize, required=False)
        return
    pickup, delivery = (
        {f"{step}_{key}": value for key, value in window.items()}
        for step, window in zip(("pickup", "delivery"), windows, strict=True)
    )
    model.add_shipment(
        at[job.stops[0].vertex], at[job.stops[1].vertex], **pickup, **delivery,
        amount=job.stops[0].load, prize=prize, required=False,
    )  # fmt: skip


def main() -> None:
    """Run the instances and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--instances", type=int, default=20)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--objective", default="flowtime")
    options = parser.parse_args()
    lines, gaps = list[list[str]](), list[float]()
    for seed in range(options.first, options.first + options.instances):
        work, travel = draw_instance(seed)
        work = replace(work, objective=options.objective)
        (first_seconds, first), (speed, last) = search(work, travel, options.seconds)
        line = [str(seed), str(len(work.jobs)), str(len(work.robots)), f"{first_seconds:.2f}"]
        line += [f"{cost.unserved}, {cost.value}" for cost in (first, last)] + [f"{speed:.0f}"]
        if options.objective == "flowtime":
            unserved, flowtime = run_pyvrp(work, travel, options.seconds)
            gap = last.value / flowtime - 1 if unserved == last.unserved else float("nan")
            gaps.append(gap)
            line += [f"{unserved}, {flowtime}", f"{100 * gap:+.2f} %"]
        lines.append(line)
        print(*line, sep="\t", flush=True)  # noqa: T201
    heads = ["seed", "jobs", "robots", "first [s]", "first", "ours", "steps per s", "PyVRP", "gap"]
    print(table(heads[: len(lines[0])], lines))  # noqa: T201
    print(f"mean gap {100 * mean(gaps):+.2f} %" if gaps else "")  # noqa: T201


if __name__ == "__main__":
    main()
