"""Faults of jobs, states and batteries, each with its place, value and remedy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from itertools import takewhile
from math import lcm

from rightofway.errors import InputFault, Where, find_nearest, quote
from rightofway.model.bind_work import Shift, get_state
from rightofway.model.problem import HEAVIEST, scale_weights
from rightofway.model.robot import Robot
from rightofway.model.work import Job, JobStop, RobotState
from rightofway.site import Roadmap, VertexId
from rightofway.units import write_decimal

MAX_STOPS = 1_000_000
"""Stops of all jobs at most."""


def find_work_faults(scenario: Shift) -> Iterator[InputFault]:
    """Yield all faults of the keys of jobs, or of their use without jobs.

    Robots, rules and the roadmap are of the right kinds; vertices may be out of range.
    """
    if scenario.jobs is None:
        yield from _find_lone_keys(scenario)
        return
    yield from _find_trips(scenario)
    for index, job in enumerate(scenario.jobs):
        of_job = _find_job_faults(job, scenario)
        yield from (fault.nest(("jobs", index)) for fault in of_job)
    yield from _find_repeated_names(scenario.jobs)
    yield from _find_order_faults(scenario.jobs)
    yield from _find_weight_faults(scenario.jobs)
    stops = sum(len(job.stops) for job in scenario.jobs)
    if stops > MAX_STOPS:
        yield InputFault("jobs", f"{stops} stops, more than {MAX_STOPS} (give fewer jobs)")
    yield from _find_battery_faults(scenario)
    yield from _find_places(scenario.charging, ("charging",), scenario.roadmap)
    yield from _find_state_faults(scenario)


def _find_lone_keys(scenario: Shift) -> Iterator[InputFault]:
    """Yield the keys that only a scenario with jobs may have."""
    lone: dict[Where, object] = {
        "batteries": scenario.batteries or None,
        "charging": scenario.charging or None,
        ("rules", "objective"): scenario.rules.objective,
        ("rules", "late"): scenario.rules.late,
        ("rules", "patience"): scenario.rules.patience,
    }
    for index, robot in enumerate(scenario.robots):
        for key in ("start", "capacity", "battery", "charging"):
            lone["robots", index, key] = getattr(robot, key)
    for place, value in lone.items():
        if value is not None:
            yield InputFault(place, "is for a scenario with jobs (give jobs, or take it out)")


def _find_trips(scenario: Shift) -> Iterator[InputFault]:
    """Yield trips of robots: with jobs, all stops are those of jobs."""
    remedy = "take it out; a fixed trip is a job with robot: {name}"
    for index, robot in enumerate(scenario.robots):
        if robot.stops:
            message = f"are given beside jobs ({remedy.format(name=robot.name)})"
            yield InputFault(("robots", index, "stops"), message)
        if robot.laps is not None and robot.laps > 1:
            message = f"{robot.laps} laps do not go with jobs ({remedy.format(name=robot.name)})"
            yield InputFault(("robots", index, "laps"), message)
    if scenario.rules.laps > 1:
        message = f"{scenario.rules.laps} laps do not go with jobs (take it out)"
        yield InputFault(("rules", "laps"), message)


def _find_job_faults(job: Job, scenario: Shift) -> Iterator[InputFault]:
    if not job.name:
        yield InputFault("name", "is empty (give the job a name)")
    if job.robot is not None:
        yield from _find_unknown(
            "robot", job.robot, [robot.name for robot in scenario.robots], "robot"
        )
    if not job.stops:
        yield InputFault("stops", "there is none (give at least one)")
    for index, stop in enumerate(job.stops):
        yield from (fault.nest(("stops", index)) for fault in _find_stop_faults(stop))
        yield from _find_places([stop.at], ("stops", index, "at"), scenario.roadmap)
    yield from _find_load_faults(job)


def _find_stop_faults(stop: JobStop) -> Iterator[InputFault]:
    if stop.latest is not None and stop.latest < stop.earliest + stop.work:
        message = f"{stop.latest} is before earliest and work, {stop.earliest} + {stop.work}"
        remedy = f"give {stop.earliest + stop.work} or more, or leave it out"
        yield InputFault("latest", f"{message} ({remedy})")


def _find_load_faults(job: Job) -> Iterator[InputFault]:
    """Yield a stop that unloads more than is loaded, else a load that is left at the end."""
    left = 0
    for index, stop in enumerate(job.stops):
        left += stop.load
        if left < 0:
            message = f"{stop.load} unloads more than the stops before have loaded"
            remedy = "load it at a stop before"
            yield InputFault(("stops", index, "load"), f"{message} ({remedy})")
            return
    if left:
        message = f"the loads sum to {left} (unload as much as is loaded)"
        yield InputFault("stops", message)


def _find_unknown(place: Where, name: str, known: Sequence[str], kind: str) -> Iterator[InputFault]:
    """Yield a name that nothing of this kind has."""
    if name not in known:
        near = find_nearest(name, known)
        remedy = f"did you mean {near!r}?" if near else f"give the name of a {kind}"
        yield InputFault(place, f"no {kind} is named {quote(name)} ({remedy})")


def _find_places(
    vertices: Sequence[int], where: tuple[str | int, ...], roadmap: Roadmap
) -> Iterator[InputFault]:
    """Yield vertices that are not on the roadmap, or only driven through."""
    for index, vertex in enumerate(vertices):
        place = where if where[-1] == "at" else (*where, index)
        if not 0 <= vertex < roadmap.n_vertices:
            message = f"vertex {vertex} is not on the roadmap (give 0 to {roadmap.n_vertices - 1})"
            yield InputFault(place, message)
        elif roadmap.passing is not None and vertex in roadmap.passing.vertices:
            message = f"{roadmap.name(vertex)} is driven through only"
            remedy = "give another place, or take pass out of the vertex"
            yield InputFault(place, f"{message} ({remedy})")
        elif where[0] == "stops":
            yield from find_heading_faults(place, vertex, roadmap)


def find_heading_faults(place: Where, vertex: int, roadmap: Roadmap) -> Iterator[InputFault]:
    """Yield a place to work at that robots cannot come to in its heading."""
    if headings := roadmap.unmet.get(VertexId(vertex)):
        message = f"robots may not turn at {roadmap.name(vertex)}, where they work {headings}"
        remedy = "let them turn there, give another heading, or draw a lane that ends in it"
        yield InputFault(place, f"{message} ({remedy})")


def _find_repeated_names(jobs: Sequence[Job]) -> Iterator[InputFault]:
    first: dict[str, int] = {}
    for index, job in enumerate(jobs):
        earlier = first.setdefault(job.name, index)
        if earlier != index and job.name:
            message = f"{job.name} is the name of {{other}} already (give each its own)"
            yield InputFault(("jobs", index, "name"), message, ("jobs", earlier))


def _find_order_faults(jobs: Sequence[Job]) -> Iterator[InputFault]:
    """Yield unknown names of jobs in `after`, and a cycle."""
    names = [job.name for job in jobs]
    known = set(names)
    for index, job in enumerate(jobs):
        for place, name in enumerate(job.after):
            if name not in known:
                yield from _find_unknown(("jobs", index, "after", place), name, names, "job")
    try:
        TopologicalSorter({job.name: [*job.after] for job in jobs}).prepare()
    except CycleError as error:
        cycle = error.args[1]
        message = f"{' after '.join(reversed(cycle))} is a cycle (take one of them out)"
        yield InputFault(("jobs", names.index(cycle[0]), "after"), message)


def _find_weight_faults(jobs: Sequence[Job]) -> Iterator[InputFault]:
    weights = scale_weights(jobs)
    heaviest = max(weights, default=1)
    if heaviest > HEAVIEST:
        index = weights.index(heaviest)
        message = f"{jobs[index].weight} makes weights too far apart or too fine: in whole"
        message += f" numbers it is {heaviest}, above {HEAVIEST} (round weights)"
        yield InputFault(("jobs", index, "weight"), message)


def _find_battery_faults(scenario: Shift) -> Iterator[InputFault]:
    names = [name for name, _ in scenario.batteries]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield InputFault(("batteries", name), "is the name of two batteries (give each its own)")
    for index, robot in enumerate(scenario.robots):
        if robot.battery is not None:
            yield from _find_unknown(("robots", index, "battery"), robot.battery, names, "battery")


def _find_state_faults(scenario: Shift) -> Iterator[InputFault]:
    robots, roadmap = scenario.robots, scenario.roadmap
    jobs = {job.name: job for job in scenario.jobs or ()}
    for index, robot in enumerate(robots):
        yield from _find_places(robot.charging or (), ("robots", index, "charging"), roadmap)
        if robot.start is not None:
            of_start = _find_begun_faults(robot.start, robot, jobs)
            yield from (fault.nest(("robots", index, "start")) for fault in of_start)
    yield from _find_twice_begun(robots)
    yield from _find_equal_starts(robots, roadmap)
    yield from _find_near_starts(scenario)


def _find_begun_faults(
    state: RobotState, robot: Robot, jobs: Mapping[str, Job]
) -> Iterator[InputFault]:
    for name, count in state.begun:
        place = ("begun", name)
        if name not in jobs:
            yield from _find_unknown(place, name, list(jobs), "job")
            continue
        job, most = jobs[name], len(jobs[name].stops) - 1
        if not 0 < count <= most:
            message = f"{count} of {most + 1} stops are no begun job"
            remedy = f"give 1 to {most}" if most > 1 else "give 1" if most else "take it out"
            yield InputFault(place, f"{message} ({remedy})")
        if job.robot is not None and job.robot != robot.name:
            remedy = "only the robot that has begun it may finish it"
            yield InputFault(place, f"the job is for {job.robot} ({remedy})")
        if job.types and robot.type not in job.types:
            types, kind = " or ".join(job.types), robot.type or "none"
            remedy = "only the robot that has begun it may finish it"
            yield InputFault(place, f"the job is for type {types}, not {kind} ({remedy})")


def _find_twice_begun(robots: Sequence[Robot]) -> Iterator[InputFault]:
    first: dict[str, int] = {}
    for index, robot in enumerate(robots):
        for name, _ in robot.start.begun if robot.start is not None else ():
            earlier = first.setdefault(name, index)
            if earlier != index:
                message = f"{robots[earlier].name} has begun it already (only one robot may)"
                place = ("robots", index, "start", "begun", name)
                yield InputFault(place, message, ("robots", earlier))


def _find_equal_starts(robots: Sequence[Robot], roadmap: Roadmap) -> Iterator[InputFault]:
    first: dict[int, int] = {}
    for index, robot in enumerate(robots):
        at = get_state(robot).at
        earlier = first.setdefault(at, index)
        has_state = robot.start is not None or robots[earlier].start is not None
        if earlier != index and has_state:
            message = f"{_name(at, roadmap)} is the start of {robots[earlier].name} already"
            remedy = "a vertex holds one robot; move one of them"
            place = ("robots", index, "start", "at")
            yield InputFault(place, f"{message} ({remedy})", ("robots", earlier))


def _find_near_starts(scenario: Shift) -> Iterator[InputFault]:
    """Yield robots with a size that begin too near to an earlier one."""
    robots, roadmap = scenario.robots, scenario.roadmap
    starts = [get_state(robot).at for robot in robots]
    largest = max(robot.radius for robot in robots)
    if largest <= 0 or not all(0 <= at < roadmap.n_vertices for at in starts):
        return
    at, least_of = _scale_starts(scenario, starts)
    by_x = sorted(range(len(robots)), key=lambda robot: at[robot])
    reach = least_of[largest, largest]
    near = (
        sorted((first, other))
        for place, first in enumerate(by_x)
        for other in takewhile(
            lambda robot, end=at[first][0] + reach: at[robot][0] < end,  # type: ignore[misc]
            by_x[place + 1 :],
        )
        if abs(at[first][1] - at[other][1]) < reach
    )
    for first, other in near:
        radii = robots[first].radius, robots[other].radius
        (x, y), (other_x, other_y) = at[first], at[other]
        square = (x - other_x) ** 2 + (y - other_y) ** 2
        if starts[first] != starts[other] and square < least_of[radii] ** 2:
            least = sum(radii) + scenario.rules.clearance
            message = f"{roadmap.name(starts[other])} is nearer than {write_decimal(least)} to the"
            message += f" start of {robots[first].name} (move one of them)"
            yield InputFault(("robots", other, "start", "at"), message, ("robots", first))


def _scale_starts(
    scenario: Shift, starts: Sequence[int]
) -> tuple[list[tuple[int, int]], dict[tuple[Fraction, Fraction], int]]:
    """Return starts, and least distances of robots by their radii, as multiples of one length."""
    clearance, radii = scenario.rules.clearance, {robot.radius for robot in scenario.robots}
    points = [scenario.roadmap.get_position(start) for start in starts]
    numbers = (clearance, *radii, *(axis for point in points for axis in point))
    scale = lcm(*(number.denominator for number in numbers))
    least_of = {
        (radius, other): int((radius + other + clearance) * scale) if radius + other else 0
        for radius in radii
        for other in radii
    }
    return [(int(x * scale), int(y * scale)) for x, y in points], least_of


def _name(vertex: int, roadmap: Roadmap) -> str:
    return roadmap.name(vertex) if 0 <= vertex < roadmap.n_vertices else str(vertex)
