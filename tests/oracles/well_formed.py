"""Which jobs a robot can do alone from home and back: one search over places and next stops."""

from __future__ import annotations

from fractions import Fraction
from heapq import heappop, heappush

from rightofway.model import Battery, Job, Robot, Scenario


def list_ill_formed(scenario: Scenario) -> list[str]:
    """Return the names of jobs that no robot can do alone, past the other homes.

    Robots are points on a grid without one-way edges, turns and closures.
    """
    return [
        job.name
        for job in scenario.jobs or ()
        if not any(_can_do(scenario, index, job) for index in range(len(scenario.robots)))
    ]


def _can_do(scenario: Scenario, index: int, job: Job) -> bool:
    robot = scenario.robots[index]
    load = most = 0
    for stop in job.stops:
        load += stop.load
        most = max(most, load)
    if job.robot not in (None, robot.name) or (job.types and robot.type not in job.types):
        return False
    if most > (1 if robot.capacity is None else robot.capacity):
        return False
    battery = None if robot.battery is None else dict(scenario.batteries)[robot.battery]
    spent = _spend(scenario, robot, job, battery)
    if spent is None or battery is None:
        return spent is not None
    charges = robot.charging is not None and robot.home in robot.charging and battery.charge > 0
    return charges and spent <= 1 - battery.reserve


def _spend(scenario: Scenario, robot: Robot, job: Job, battery: Battery | None) -> Fraction | None:
    """Return the least share of a battery that the job takes, or None where there is no way."""
    roadmap, battery = scenario.roadmap, battery or Battery()
    others = {other.home for other in scenario.robots} - {robot.home}
    places = [*(stop.at for stop in job.stops), robot.home]
    heap, seen = [(Fraction(0), int(robot.home), 0)], set[tuple[int, int]]()
    while heap:
        spent, vertex, done = heappop(heap)
        if done == len(places):
            return spent
        if (vertex, done) in seen or vertex in others:
            continue
        seen.add((vertex, done))
        if vertex == places[done]:
            work = job.stops[done].work if done < len(job.stops) else Fraction(0)
            heappush(heap, (spent + work * (battery.work + battery.on), vertex, done + 1))
        for edge in range(int(roadmap.indptr[vertex]), int(roadmap.indptr[vertex + 1])):
            length = roadmap.get_edge_class(edge).length
            share = length * battery.drive + length / robot.speed * battery.on
            heappush(heap, (spent + share, int(roadmap.heads[edge]), done))
    return None
