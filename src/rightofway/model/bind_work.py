"""Jobs, states and tours in ticks for planners, and itineraries made from tours."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate
from math import lcm
from typing import Protocol

from rightofway.errors import InputError, InputFault, Steps, quote
from rightofway.model.itinerary import Arc, Itinerary, Stage
from rightofway.model.problem import (
    MAX_TICKS,
    Problem,
    compute_turning_time,
    scale_weights,
)
from rightofway.model.robot import Robot, Rules
from rightofway.model.stop_directions import choose_directions
from rightofway.model.turning import compute_first_turns, find_heading_on_map
from rightofway.model.units import Clock, Tick
from rightofway.model.work import (
    CAPACITY,
    LARGEST_BATTERY,
    LATE,
    OBJECTIVE,
    Battery,
    BoundBattery,
    BoundJob,
    BoundRobot,
    BoundStop,
    Job,
    JobStop,
    RobotState,
    Tour,
    TourItem,
    Work,
)
from rightofway.site import Roadmap, VertexId

MICRO = 10**6
"""The yaw of a map is taken to so many parts of a degree."""


class Shift(Protocol):
    """The fields of a scenario that jobs need; the module of `Scenario` imports this one."""

    @property
    def roadmap(self) -> Roadmap:
        """The map, in its vertices and edges."""

    @property
    def robots(self) -> tuple[Robot, ...]:
        """The fleet."""

    @property
    def rules(self) -> Rules:
        """Its rules."""

    @property
    def jobs(self) -> tuple[Job, ...] | None:
        """The jobs; None without the key."""

    @property
    def batteries(self) -> tuple[tuple[str, Battery], ...]:
        """Each battery with its name."""

    @property
    def charging(self) -> tuple[VertexId, ...]:
        """Charging places apart from those of the map."""


def bind_work(problem: Problem, scenario: Shift) -> Problem:
    """Return the problem of a valid scenario with jobs: no robot has a tour yet.

    Raises
    ------
    InputError
        For times beyond the integers of the native core, and shares of a battery without a common
        denominator up to `LARGEST_BATTERY`.
    """
    assert scenario.jobs is not None, "the scenario has jobs"
    faults = list(_find_long_times(scenario.jobs, scenario.robots, problem.clock))
    if faults:
        raise InputError(faults)
    work = Work(
        jobs=tuple(_bind_jobs(scenario, problem.clock)),
        robots=tuple(_bind_robots(scenario, problem)),
        objective=scenario.rules.objective or OBJECTIVE,
        late=LATE if scenario.rules.late is None else scenario.rules.late,
    )
    return bind_tours(replace(problem, work=work), [()] * len(work.robots))


def bind_tours(problem: Problem, tours: Sequence[Tour]) -> Problem:
    """Return a problem with work in which each robot has the stages of its tour.

    There is one tour for each robot; its items name jobs and stops that exist.
    """
    assert problem.work is not None, "the problem has jobs"
    return replace(
        problem,
        itineraries=tuple(
            _bind_tour(problem, robot, itinerary, tour)
            for robot, itinerary, tour in zip(
                problem.work.robots, problem.itineraries, tours, strict=True
            )
        ),
        after=tuple(_list_arcs(problem.work.jobs, tours)),
    )


def _bind_tour(problem: Problem, robot: BoundRobot, itinerary: Itinerary, tour: Tour) -> Itinerary:
    assert problem.work is not None, "the problem has jobs"
    stages = [_bind_item(problem.work.jobs, item, robot.turn) for item in tour]
    home = robot.start if robot.home is None else robot.home
    if robot.home is not None or not tour:
        stages.append(Stage(vertex=home, work=Tick(0), turn=Tick(0)))
    heading = robot.heading if itinerary.turning is not None else None
    itinerary = replace(
        itinerary,
        home=robot.start,
        stages=tuple(stages),
        ready=robot.ready,
        heading=heading,
        first_turns=compute_first_turns(problem.roadmap, itinerary.turning, robot.start, heading),
        ends_anywhere=robot.home is None,
    )
    return choose_directions(problem.roadmap, itinerary, home)


def _bind_item(jobs: Sequence[BoundJob], item: TourItem, turn: Tick) -> Stage:
    stage = Stage(vertex=item.vertex, work=item.duration, turn=turn)
    if item.job is None or item.stop is None:
        return stage
    job = jobs[item.job]
    if item.stop < job.first:  # a plan that repeats what is done
        return stage
    stop, is_last = job.stops[item.stop - job.first], item.stop == job.first + len(job.stops) - 1
    return replace(
        stage,
        earliest=stop.earliest,
        latest=stop.latest,
        weight=job.weight if is_last else 0,
        due=job.due if is_last else None,
    )


def _list_arcs(jobs: Sequence[BoundJob], tours: Sequence[Tour]) -> Iterator[Arc]:
    """Yield the arcs between robots: the last stage of a job, the first stage of one after it."""
    first: dict[int, tuple[int, int]] = {}
    last: dict[int, tuple[int, int]] = {}
    for robot, tour in enumerate(tours):
        for stage, item in enumerate(tour):
            if item.job is not None:
                first.setdefault(item.job, (robot, stage))
                last[item.job] = robot, stage
    for job in sorted(first):
        for before in jobs[job].after:
            if before in last and last[before][0] != first[job][0]:
                yield Arc(before=last[before], after=first[job])


def _bind_jobs(scenario: Shift, clock: Clock) -> Iterator[BoundJob]:
    jobs = scenario.jobs or ()
    index = {job.name: number for number, job in enumerate(jobs)}
    begun = {
        name: (robot, count)
        for robot, own in enumerate(scenario.robots)
        if own.start is not None
        for name, count in own.start.begun
    }
    known: dict[Hashable, tuple[int, ...]] = {}
    for job, weight in zip(jobs, scale_weights(jobs), strict=True):
        robot, first = begun.get(job.name, (None, 0))
        stops = [_bind_stop(stop, clock) for stop in job.stops[first:]]
        if robot is not None:
            stops = [replace(stop, latest=None) for stop in stops]
        yield BoundJob(
            stops=tuple(stops),
            first=first,
            weight=weight,
            due=_round_down(job.due, clock),
            robots=_list_able(scenario, job, (robot, first), known),
            after=() if robot is not None else tuple(index[name] for name in job.after),
            begun_by=robot,
            earliest=stops[0].earliest if robot is None else Tick(0),
        )


def _bind_stop(stop: JobStop, clock: Clock) -> BoundStop:
    return BoundStop(
        vertex=stop.at,
        work=clock.count_ticks(stop.work),
        load=stop.load,
        earliest=clock.count_ticks(stop.earliest),
        latest=_round_down(stop.latest, clock),
    )


def _round_down(time: Fraction | None, clock: Clock) -> Tick | None:
    return None if time is None else Tick(time // clock.tick)


def _list_able(
    scenario: Shift,
    job: Job,
    begun: tuple[int | None, int],
    known: dict[Hashable, tuple[int, ...]],
) -> tuple[int, ...]:
    """Return the robots that may do a job and can; those of jobs that are alike are known.

    ``begun`` is the robot that has begun it, and how many stops are done.
    """
    begun_by, first = begun
    load = max([*accumulate(stop.load for stop in job.stops)][first:])
    barred = scenario.roadmap.barred_vertices
    kept_out = frozenset(kind for stop in job.stops[first:] for kind in barred.get(stop.at, ()))
    alike = begun_by, job.robot, job.types, load, kept_out
    if alike not in known:
        known[alike] = tuple(
            index
            for index, robot in enumerate(scenario.robots)
            if begun_by in {None, index}
            and job.robot in {None, robot.name}
            and (not job.types or robot.type in job.types)
            and get_capacity(robot) >= load
            and robot.type not in kept_out
        )
    return known[alike]


def get_capacity(robot: Robot) -> int:
    """Return the largest load of a robot."""
    return CAPACITY if robot.capacity is None else robot.capacity


def get_state(robot: Robot) -> RobotState:
    """Return where a robot begins and the work it has done."""
    return robot.start or RobotState(at=robot.home)


def list_charging_places(scenario: Shift, robot: Robot) -> tuple[VertexId, ...]:
    """Return the vertices at which a robot may charge, sorted."""
    if robot.charging is not None:
        return tuple(sorted(set(robot.charging)))
    passing = scenario.roadmap.passing
    passed = () if passing is None else passing.vertices
    places = {*scenario.roadmap.drawing.charging, *scenario.charging}
    return tuple(sorted(at for at in places if at not in passed))


def _bind_robots(scenario: Shift, problem: Problem) -> Iterator[BoundRobot]:
    jobs = scenario.jobs or ()
    loads = {job.name: list(accumulate(stop.load for stop in job.stops)) for job in jobs}
    batteries, roadmap, tick = dict(scenario.batteries), scenario.roadmap, problem.clock.tick
    shares: dict[tuple[object, ...], tuple[list[Fraction], list[Fraction]]] = {}
    for robot in scenario.robots:
        state, battery = get_state(robot), None
        if robot.battery is not None:
            alike = robot.battery, robot.type, robot.radius
            if alike not in shares:
                shares[alike] = _find_shares(
                    batteries[robot.battery], robot, scenario.roadmap, tick
                )
            battery = _bind_battery(*shares[alike], state.soc, robot)
        returns = (robot.ends or scenario.rules.ends) == "home"
        turn = compute_turning_time(roadmap, robot, scenario.rules)
        yield BoundRobot(
            start=state.at,
            ready=problem.clock.count_ticks(state.ready),
            heading=find_heading_on_map(state.heading, roadmap),
            home=robot.home if returns else None,
            turn=problem.clock.count_ticks(turn),
            capacity=get_capacity(robot),
            load=sum(loads[name][count - 1] for name, count in state.begun),
            battery=battery,
            charging=list_charging_places(scenario, robot),
        )


def _find_shares(
    battery: Battery, robot: Robot, roadmap: Roadmap, tick: Fraction
) -> tuple[list[Fraction], list[Fraction]]:
    """Return the shares for an edge of each class; those for a tick, and the reserve."""
    drive = [
        Fraction(0)
        if edge_class.is_barred(robot.type, robot.radius)
        else battery.drive * edge_class.length
        for edge_class in roadmap.edge_classes
    ]
    return drive, [battery.on * tick, battery.work * tick, battery.charge * tick, battery.reserve]


def _bind_battery(
    drive: Sequence[Fraction], others: Sequence[Fraction], soc: Fraction, robot: Robot
) -> BoundBattery:
    """Return a battery in whole numbers.

    Raises
    ------
    InputError
        If a common denominator of its shares is above `LARGEST_BATTERY`.
    """
    full = lcm(*{share.denominator for share in (*drive, *others, soc)})
    if full > LARGEST_BATTERY:
        message = f"{quote(full)} is the common denominator of its shares, with lengths of edges,"
        message += f" the tick and soc {quote(soc)} of {robot.name}: above 10^15"
        place: Steps = ("batteries", robot.battery or "")
        raise InputError.at(place, f"{message} (give rounder fractions)")
    on, work, charge, reserve = (min(int(share * full), full + 1) for share in others)
    return BoundBattery(
        full=full,
        drive=tuple(min(int(share * full), full + 1) for share in drive),
        on=on,
        work=work,
        charge=charge,
        reserve=reserve,
        soc=int(soc * full),
    )


def _find_long_times(
    jobs: Sequence[Job], robots: Sequence[Robot], clock: Clock
) -> Iterator[InputFault]:
    """Yield the times that do not fit the integers of the native core."""
    for where, time in _list_times(jobs, robots).items():
        ticks = clock.count_ticks(time)
        if ticks > MAX_TICKS:
            message = f"it takes {quote(ticks)} ticks of {quote(clock.tick)}, more than {MAX_TICKS}"
            remedy = "bring speeds, lengths and times closer together"
            yield InputFault(where, f"{message} ({remedy})")


def _list_times(jobs: Sequence[Job], robots: Sequence[Robot]) -> Mapping[Steps, Fraction]:
    """Return the times of jobs and states by their places [time unit]."""
    times: dict[Steps, Fraction | None] = {}
    for number, job in enumerate(jobs):
        times["jobs", number, "due"] = job.due
        for place, stop in enumerate(job.stops):
            known = {"work": stop.work, "earliest": stop.earliest, "latest": stop.latest}
            times |= {("jobs", number, "stops", place, key): time for key, time in known.items()}
    for number, robot in enumerate(robots):
        times["robots", number, "start", "ready"] = get_state(robot).ready
    return {where: time for where, time in times.items() if time is not None}
