"""Jobs of a plan: each is done in one tour, in order, in time, by a robot that may, or by nobody.

Items of tours are inside visits, loads within the capacity; a robot stays where it begins until it
is ready. All times are whole ticks.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from rightofway.check.faults import Fault, FaultKind
from rightofway.check.visits import Visits
from rightofway.facts import Fact
from rightofway.model import (
    BoundJob,
    BoundRobot,
    Job,
    Plan,
    PlannedItem,
    PlannedTour,
    Scenario,
    Tick,
)
from rightofway.site import Roadmap, VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class TourOfPlan:
    """The visits and the tour of one robot, in Python integers."""

    robot: int
    state: BoundRobot
    vertices: Sequence[int]
    enter: Sequence[int]
    departures: Sequence[int]  # the begin of the turn on the spot before the drive of each visit
    edges: Sequence[int]  # from each visit to the next, -1 where none leads there
    tour: PlannedTour

    @property
    def end(self) -> int:
        """When the last item ends [ticks]; 0 without one."""
        return self.tour[-1].end if self.tour else 0


def judge_work(visits: Visits) -> Iterator[Fault]:
    """Find faults of tours and jobs."""
    if visits.scenario.jobs is None:
        return
    for own in lay_out_tours(visits):
        yield from _find_ends(own, visits.scenario)
        yield from _find_items(own, visits.scenario)
    yield from _find_jobs(visits.plan)


def lay_out_tours(visits: Visits) -> Iterator[TourOfPlan]:
    """Yield the visits and the tour of each robot of a plan with jobs."""
    work, tours, begin = visits.scenario.problem.work, visits.plan.tours, 0
    assert work is not None, "the scenario has jobs"
    assert tours is not None, "a plan with jobs has tours"
    departures = (visits.leave - visits.drive - visits.turn).tolist()
    for robot, track in enumerate(visits.plan.tracks):
        end = begin + len(track)
        yield TourOfPlan(
            robot=robot,
            state=work.robots[robot],
            vertices=visits.vertex[begin:end].tolist(),
            enter=visits.enter[begin:end].tolist(),
            departures=departures[begin:end],
            edges=visits.edge[begin:end].tolist(),
            tour=tours[robot],
        )
        begin = end


def _find_ends(own: TourOfPlan, scenario: Scenario) -> Iterator[Fault]:
    """Yield where a robot begins and rests wrongly, and what it does before it is ready."""
    write = _FaultsOf(own.robot, scenario)
    state, last = own.state, own.vertices[-1]
    if own.vertices[0] != state.start or own.enter[0] != 0:
        yield write("wrong start", own.vertices[0], own.enter[0], place=state.start)
    if state.home is not None and last != state.home:
        yield write("wrong end", last, own.enter[-1], end=state.home)
    if len(own.vertices) > 1 and own.departures[0] < state.ready:
        moment = own.departures[0]
        yield write("before ready", own.vertices[0], moment, ready=state.ready)
    for item in own.tour:
        if item.begin < state.ready:
            at = own.vertices[item.visit]
            yield write("before ready", at, item.begin, ready=state.ready)


def _find_items(own: TourOfPlan, scenario: Scenario) -> Iterator[Fault]:
    """Yield faults of single items of a tour, and of items that follow each other."""
    yield from _find_overlaps(own, scenario)
    load = own.state.load
    for item in own.tour:
        write = _FaultsOf(own.robot, scenario, item)
        at, last = own.vertices[item.visit], item.visit == len(own.vertices) - 1
        departure = None if last else own.departures[item.visit] - own.state.turn
        if item.begin < own.enter[item.visit] or (departure is not None and item.end > departure):
            since = own.enter[item.visit]
            yield write("outside visit", at, item.begin, end=item.end, since=since, until=departure)
        if item.job is None or item.stop is None:
            yield from _find_wrong_charge(own, item, write)
            continue
        job = _get_jobs(scenario)[item.job]
        stop = job.stops[item.stop]
        if at not in _list_directions(scenario.roadmap, stop.at):
            yield write("wrong stop", at, item.begin, place=stop.at)
        load += stop.load
        if not 0 <= load <= own.state.capacity:
            capacity = own.state.capacity
            yield write("wrong load", at, item.end, load=load, capacity=capacity)
        yield from _find_wrong_times(item, at, scenario, write)


def _find_overlaps(own: TourOfPlan, scenario: Scenario) -> Iterator[Fault]:
    for before, item in pairwise(own.tour):
        if item.visit < before.visit or item.begin < before.end:
            write = _FaultsOf(own.robot, scenario, item)
            at, earlier = own.vertices[item.visit], _name_item(before, scenario)
            yield write("items overlap", at, item.begin, end=before.end, earlier=earlier)


def _find_wrong_charge(own: TourOfPlan, item: PlannedItem, write: _FaultsOf) -> Iterator[Fault]:
    at = own.vertices[item.visit]
    if at not in own.state.charging:
        yield write("wrong charger", at, item.begin)
    if item.end < item.begin:
        yield write("wrong duration", at, item.begin, end=item.end, work=0)


def _find_wrong_times(
    item: PlannedItem, at: int, scenario: Scenario, write: _FaultsOf
) -> Iterator[Fault]:
    """Yield times of work at a stop that are not those of its job."""
    assert item.job is not None, "it is no charge"
    assert item.stop is not None, "it is no charge"
    job = _get_bound_jobs(scenario)[item.job]
    work = scenario.problem.clock.count_ticks(_get_jobs(scenario)[item.job].stops[item.stop].work)
    if item.end != item.begin + work:
        yield write("wrong duration", at, item.begin, end=item.end, work=work)
    if item.stop < job.first:
        return  # a stop that is done: it is done again
    stop = job.stops[item.stop - job.first]
    if item.begin < stop.earliest:
        yield write("too early", at, item.begin, earliest=stop.earliest)
    if stop.latest is not None and item.end > stop.latest:
        yield write("too late", at, item.end, latest=stop.latest)


def _find_jobs(plan: Plan) -> Iterator[Fault]:
    """Yield faults of jobs among all tours."""
    assert plan.tours is not None, "a plan with jobs has tours"
    done: dict[int, list[tuple[int, PlannedItem]]] = {}
    for robot, tour in enumerate(plan.tours):
        for item in tour:
            if item.job is not None:
                done.setdefault(item.job, []).append((robot, item))
    unserved = {job for job, _ in plan.unserved}
    for index in range(len(_get_jobs(plan.scenario))):
        items = done.get(index, [])
        if index in unserved:
            yield from _find_wrongly_unserved(index, items, plan.scenario)
        else:
            yield from _find_wrongly_served(index, items, plan.scenario)
            yield from _find_wrong_order(index, done, unserved, plan.scenario)


def _find_wrongly_unserved(
    index: int, items: Sequence[tuple[int, PlannedItem]], scenario: Scenario
) -> Iterator[Fault]:
    job, name = _get_bound_jobs(scenario)[index], _get_jobs(scenario)[index].name
    for robot, item in items[:1]:
        write = _FaultsOf(robot, scenario, item)
        at = _get_jobs(scenario)[index].stops[item.stop or 0].at
        yield write("also unserved", at, item.begin, job=name)
    if job.begun_by is not None:
        write = _FaultsOf(job.begun_by, scenario)
        yield write("begun unserved", job.stops[0].vertex, 0, job=name)


def _find_wrongly_served(
    index: int, items: Sequence[tuple[int, PlannedItem]], scenario: Scenario
) -> Iterator[Fault]:
    """Yield stops that are missing, done twice or out of order, and robots that may not do them."""
    job, bound = _get_jobs(scenario)[index], _get_bound_jobs(scenario)[index]
    counts = Counter(item.stop for _, item in items)
    robots = tuple(sorted({robot for robot, _ in items}))
    for number in range(bound.first, len(job.stops)):
        if not counts[number]:
            stop = Fact("stop of job", number=number + 1, job=job.name)
            yield _make_fault(scenario, "stop not done", robots, job.stops[number].at, 0, item=stop)
    seen = set(range(bound.first))
    for robot, item in items:
        assert item.stop is not None, "it is no charge"
        if item.stop in seen:
            write = _FaultsOf(robot, scenario, item)
            yield write("stop done again", job.stops[item.stop].at, item.begin)
        seen.add(item.stop)
    if len(robots) > 1:
        at, begin = job.stops[0].at, min(item.begin for _, item in items)
        yield _make_fault(scenario, "job divided", robots, at, begin, job=job.name)
    for (before, earlier), (robot, item) in pairwise(items):
        if before == robot and (earlier.stop or 0) > (item.stop or 0):
            write = _FaultsOf(robot, scenario, item)
            later = _name_item(earlier, scenario)
            yield write("stop order", job.stops[item.stop or 0].at, item.begin, later=later)
    for robot in robots:
        if not _may_do(scenario, job, bound, robot):
            begin = min(item.begin for own, item in items if own == robot)
            write = _FaultsOf(robot, scenario)
            yield write("wrong robot", job.stops[0].at, begin, job=job.name)


def _may_do(scenario: Scenario, job: Job, bound: BoundJob, robot: int) -> bool:
    """Return whether a robot may do a job, by what is begun, name and type."""
    own = scenario.robots[robot]
    return (
        bound.begun_by in {None, robot}
        and job.robot in {None, own.name}
        and (not job.types or own.type in job.types)
    )


def _find_wrong_order(
    index: int,
    done: dict[int, list[tuple[int, PlannedItem]]],
    unserved: set[int],
    scenario: Scenario,
) -> Iterator[Fault]:
    """Yield jobs before this one that end after its begin, or are unserved."""
    jobs, items = _get_jobs(scenario), done.get(index, [])
    if not items:
        return
    robot, first = min(items, key=lambda pair: pair[1].begin)
    write, at = _FaultsOf(robot, scenario), jobs[index].stops[0].at
    names = {"job": jobs[index].name}
    for before in _get_bound_jobs(scenario)[index].after:
        names["before"] = jobs[before].name
        end = max((item.end for _, item in done.get(before, [])), default=0)
        if before in unserved:
            yield write("after unserved", at, first.begin, **names)
        elif end > first.begin:
            yield write("wrong order", at, first.begin, **names, end=end)


def _list_directions(roadmap: Roadmap, vertex: VertexId) -> tuple[VertexId, ...]:
    """Return the vertices where robots may work: those of all directions without a heading."""
    is_directed = vertex in {at for at, _ in roadmap.drawing.headings}
    return (vertex,) if is_directed else roadmap.list_place(vertex)


def _get_jobs(scenario: Scenario) -> Sequence[Job]:
    assert scenario.jobs is not None, "the scenario has jobs"
    return scenario.jobs


def _get_bound_jobs(scenario: Scenario) -> Sequence[BoundJob]:
    assert scenario.problem.work is not None, "the scenario has jobs"
    return scenario.problem.work.jobs


def _name_item(item: PlannedItem, scenario: Scenario) -> Fact:
    """Return what an item of a tour is, for sentences."""
    if item.job is None or item.stop is None:
        return Fact("charge")
    return Fact("stop of job", number=item.stop + 1, job=_get_jobs(scenario)[item.job].name)


def _make_fault(
    scenario: Scenario,
    kind: FaultKind,
    robots: tuple[int, ...],
    vertex: int,
    tick: int,
    **numbers: Any,
) -> Fault:
    return Fault(
        kind=kind,
        robots=robots,
        vertices=(VertexId(vertex),),
        tick=Tick(tick),
        numbers=numbers,
        scenario=scenario,
    )


@dataclass(frozen=True, slots=True)
class _FaultsOf:
    """Makes faults of one robot, and of an item of its tour."""

    robot: int
    scenario: Scenario
    item: PlannedItem | None = None

    def __call__(self, kind: FaultKind, vertex: int, tick: int, **numbers: Any) -> Fault:
        """Return a fault at a vertex that begins at a tick."""
        if self.item is not None:
            numbers["item"] = _name_item(self.item, self.scenario)
        return _make_fault(self.scenario, kind, (self.robot,), vertex, tick, **numbers)
