"""Differences of two scenarios and of plans of jobs, each with both values.

Robots and jobs are the same where their names are; places, where their names are or, on maps of
cells of different sizes, where they lie within a cell of each other.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

import numpy as np

from rightofway.facts import Fact, get_teller
from rightofway.metrics.jobs import JobTimes, list_job_times
from rightofway.model import Plan, Robot, Scenario
from rightofway.model.attributes import Attribute
from rightofway.model.closures import Closure
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES
from rightofway.site import Roadmap
from rightofway.units import Units

Subject = Literal["robots", "map", "rules", "place", "jobs"]
"""The parts of a scenario that differ."""

Difference = tuple[str, Fact | None, Fact | None]
"""A key, and the values before and after."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """A difference of two scenarios or plans.

    Attributes
    ----------
    subject
        The part of the scenario.
    robots
        The names of the robots that have changed in this way; empty for other subjects.
    jobs
        The names of the jobs that have changed in this way; empty for other subjects.
    place
        The place that is closed or open; None for other subjects.
    key
        The attribute or the event: ``speed``, ``home``, ``headway``, ``added``, ``removed``,
        ``closed``, ``open``; empty for the size of a map. Of jobs ``added``, ``removed`` and
        ``changed``, and in plans ``robot``, ``served``, ``unserved``, ``earlier`` and ``later``.
    before, after
        The values; None where there is none.
    """

    subject: Subject
    key: str
    before: Fact | None = None
    after: Fact | None = None
    robots: tuple[str, ...] = ()
    place: Fact | None = None
    jobs: tuple[str, ...] = ()

    def __str__(self) -> str:
        return get_teller().tell_fact(self)


def find_changes(before: Scenario, after: Scenario) -> tuple[Change, ...]:
    """Return the differences of a scenario from another one.

    Parameters
    ----------
    before, after
        The scenarios.

    Returns
    -------
    tuple of Change
        Robots, in the order of ``after``, those that are removed last; then map, rules, closures
        and jobs. Robots that change in the same way are one entry, and so are jobs.
    """
    robots_of_change: dict[Difference, list[str]] = {}
    was = {robot.name: robot for robot in before.robots}
    is_same_place = _make_place_test(before.roadmap, after.roadmap)
    for robot in after.robots:
        old = was.pop(robot.name, None)
        differing: Iterable[Difference] = (
            [("added", None, None)]
            if old is None
            else _compare_robots(before, old, after, robot, is_same_place)
        )
        for change in differing:
            robots_of_change.setdefault(change, []).append(robot.name)
    for name in was:
        robots_of_change.setdefault(("removed", None, None), []).append(name)
    robots = [
        Change(subject="robots", robots=tuple(names), key=key, before=old, after=new)
        for (key, old, new), names in robots_of_change.items()
    ]
    return (
        *robots,
        *_compare_maps(before, after),
        *_compare_rules(before, after),
        *_compare_closures(before, after),
        *_group_jobs(_compare_jobs(before, after)),
    )


def find_job_changes(before: Plan, after: Plan) -> tuple[Change, ...]:
    """Return the differences of two plans in the jobs that both scenarios have.

    Parameters
    ----------
    before, after
        The plans.

    Returns
    -------
    tuple of Change
        Jobs of another robot, jobs that are served or not served only in ``after``, and jobs that
        end earlier or later. Jobs that change in the same way are one entry; both times are in
        the entry of one job.
    """
    return tuple(_group_jobs(_compare_served_jobs(before, after)))


def _compare_jobs(before: Scenario, after: Scenario) -> Iterator[tuple[str, Difference]]:
    """Yield the names of jobs with their differences, those that are removed last."""
    was, now = _describe_jobs(before), _describe_jobs(after)
    for name, job in now.items():
        if name not in was:
            yield name, ("added", None, None)
        elif was[name] != job:
            yield name, ("changed", None, None)
    yield from ((name, ("removed", None, None)) for name in was if name not in now)


def _describe_jobs(scenario: Scenario) -> dict[str, Hashable]:
    """Return all of each job, by its name: places by names, times in seconds if units are known."""
    seconds = scenario.units.seconds

    def scale(time: Fraction | None) -> Hashable:
        return time if time is None or seconds is None else time * seconds

    return {
        job.name: (
            seconds is None,
            tuple(
                (scenario.roadmap.name(stop.at), stop.load,
                 *map(scale, (stop.work, stop.earliest, stop.latest)))
                for stop in job.stops
            ),
            scale(job.due), job.weight, job.types, job.robot, job.after,
        )
        for job in scenario.jobs or ()
    }  # fmt: skip


def _compare_served_jobs(before: Plan, after: Plan) -> Iterator[tuple[str, Difference]]:
    was, now = _list_served(before), _list_served(after)
    reasons = dict(after.unserved)
    for index, job in enumerate(after.scenario.jobs or ()):
        if job.name not in was or job.name not in now:
            continue
        old, new = was[job.name], now[job.name]
        if old is None or new is None:
            if old is not new:
                why = None if new else Fact(f"unserved {reasons.get(index, 'not found')}")
                yield job.name, ("served" if new else "unserved", None, why)
            continue
        robots = [
            plan.scenario.robots[times.robot].name for plan, times in ((before, old), (after, new))
        ]
        if robots[0] != robots[1]:
            first, second = (Fact("word", value=name) for name in robots)
            yield job.name, ("robot", first, second)
        ends = [
            plan.scenario.problem.clock.convert_to_time(times.end)
            for plan, times in ((before, old), (after, new))
        ]
        if not _has_same("time", before.scenario, ends[0], after.scenario, ends[1]):
            yield job.name, _compare_ends(before.scenario, ends[0], after.scenario, ends[1])


def _compare_ends(before: Scenario, was: Fraction, after: Scenario, now: Fraction) -> Difference:
    seconds = [scenario.units.seconds or 1 for scenario in (before, after)]
    key = "earlier" if now * seconds[1] < was * seconds[0] else "later"
    return key, Fact("time", before, value=was), Fact("time", after, value=now)


def _list_served(plan: Plan) -> dict[str, JobTimes | None]:
    """Return the times of each job by its name; None where the plan does not serve it."""
    served = {times.job: times for times in list_job_times(plan)}
    return {job.name: served.get(index) for index, job in enumerate(plan.scenario.jobs or ())}


def _group_jobs(differences: Iterable[tuple[str, Difference]]) -> Iterator[Change]:
    """Yield the differences of jobs, each once; ends are told of a single job only."""
    groups: dict[Difference, list[str]] = {}
    ends: dict[str, Difference] = {}
    for name, (key, old, new) in differences:
        is_end = key in {"earlier", "later"}
        groups.setdefault((key, None, None) if is_end else (key, old, new), []).append(name)
        if is_end:
            ends[name] = (key, old, new)
    for (key, old, new), names in groups.items():
        if len(names) == 1 and key in {"earlier", "later"}:
            _, old, new = ends[names[0]]  # noqa: PLW2901
        yield Change(subject="jobs", jobs=tuple(names), key=key, before=old, after=new)


def _make_place_test(before: Roadmap, after: Roadmap) -> Callable[[int, int], bool]:
    """Return whether a vertex of one map is the place of a vertex of the other one."""
    old_grid, other = before.grid, after.grid
    if old_grid is None or other is None or (old_grid.cell_size, old_grid.columns) == (
        other.cell_size, other.columns
    ):  # fmt: skip
        return lambda vertex, now: before.name(vertex) == after.name(now)
    reach = float(max(old_grid.cell_size, other.cell_size))
    return lambda vertex, now: bool(
        np.abs(before.positions[vertex] - after.positions[now]).max() < reach
    )


def _compare_robots(
    before: Scenario,
    old: Robot,
    after: Scenario,
    new: Robot,
    is_same_place: Callable[[int, int], bool],
) -> Iterator[Difference]:
    """Yield the differences of a robot."""
    if not is_same_place(old.home, new.home):
        home, moved = (
            Fact("listed place", scenario, place=int(robot.home))
            for scenario, robot in ((before, old), (after, new))
        )
        yield "home", home, moved
    stops, then = ([int(stop.at) for stop in robot.stops] for robot in (old, new))
    if len(stops) != len(then) or not all(map(is_same_place, stops, then)):
        was, now = (
            Fact("listed places", scenario, places=tuple(places)) if places else None
            for scenario, places in ((before, stops), (after, then))
        )
        yield "stops", was, now
    works, others = ([stop.work for stop in robot.stops] for robot in (old, new))
    if not _has_all_same("time", before, works, after, others):
        was, now = (
            Fact("times", scenario, times=tuple(times)) if times else None
            for scenario, times in ((before, works), (after, others))
        )
        yield "work", was, now
    yield from _compare_attributes(ROBOT_ATTRIBUTES, before, old, after, new)


def _find_scale(measure: str, units: Units) -> Fraction | None:
    """Return the size of a unit in metres and seconds, or None where it is not known."""
    metres, seconds = units.metres, units.seconds
    if measure == "speed":
        return metres / seconds if metres and seconds else None
    return {"length": metres, "time": seconds}.get(measure)


def _has_same(measure: str, before: Scenario, was: Any, after: Scenario, now: Any) -> bool:
    """Return whether two values are the same, in the units of their scenarios."""
    if not isinstance(was, Fraction) or not isinstance(now, Fraction):
        return bool(was == now)
    scale, other = (_find_scale(measure, scenario.units) for scenario in (before, after))
    if scale is None or other is None:
        return was == now and scale == other
    return was * scale == now * other


def _has_all_same(
    measure: str, before: Scenario, was: Sequence[Any], after: Scenario, now: Sequence[Any]
) -> bool:
    """Return whether there are as many values in both scenarios, each the same."""
    return len(was) == len(now) and all(
        _has_same(measure, before, value, after, other)
        for value, other in zip(was, now, strict=True)
    )


def _make_value(scenario: Scenario, attribute: Attribute, value: Any) -> Fact:
    """Return a value of a robot or a rule as a fact."""
    if value is None:
        return Fact(attribute.unset)
    if isinstance(value, bool):
        return Fact("yes" if value else "no")
    if isinstance(value, str):
        return Fact("word", value=value)
    return Fact(attribute.measure or "number", scenario, value=value)


def _compare_attributes(
    attributes: Iterable[Attribute], before: Scenario, old: Any, after: Scenario, new: Any
) -> Iterator[Difference]:
    """Yield the differences of two robots or of rules: name and both values."""
    for attribute in attributes:
        was, now = (getattr(owner, attribute.name) for owner in (old, new))
        if not _has_same(attribute.measure, before, was, after, now):
            key = attribute.name.replace("_", " ")
            yield key, _make_value(before, attribute, was), _make_value(after, attribute, now)


def _compare_rules(before: Scenario, after: Scenario) -> Iterator[Change]:
    for key, was, now in _compare_attributes(
        RULE_ATTRIBUTES, before, before.rules, after, after.rules
    ):
        yield Change(subject="rules", key=key, before=was, after=now)


def _compare_maps(before: Scenario, after: Scenario) -> Iterator[Change]:
    """Yield one change where the maps differ: by their sizes where these differ."""
    old_roadmap, other = before.roadmap, after.roadmap
    if old_roadmap == other:
        return
    sizes = [
        Fact("n_vertices" if roadmap.grid is None else "n_free_cells", number=roadmap.n_vertices)
        for roadmap in (old_roadmap, other)
    ]
    if sizes[0] == sizes[1] and old_roadmap.grid is None:
        sizes = [Fact("n_edges", number=len(roadmap.heads)) for roadmap in (old_roadmap, other)]
    if sizes[0] == sizes[1]:
        yield Change(subject="map", key="changed")
    else:
        yield Change(subject="map", key="", before=sizes[0], after=sizes[1])


Place = tuple[Hashable, ...]
"""A vertex, or the ends of an edge, by names; cells with units by their middles."""


def _compare_closures(before: Scenario, after: Scenario) -> Iterator[Change]:
    was, now = _list_closures(before), _list_closures(after)
    for name, (place, closures) in now.items():
        if name not in was:
            yield Change(subject="place", place=place, key="closed")
        elif not _has_all_same(
            "time", before, _list_times(was[name][1]), after, _list_times(closures)
        ):
            old, new = (
                Fact("closed at", scenario, times=tuple(map(_describe_time, times)))
                for scenario, times in ((before, was[name][1]), (after, closures))
            )
            yield Change(subject="place", place=place, key="closed", before=old, after=new)
    for name, (place, _) in was.items():
        if name not in now:
            yield Change(subject="place", place=place, key="open")


def _list_times(closures: Iterable[Closure]) -> list[Fraction | None]:
    return [time for closure in closures for time in (closure.from_, closure.until)]


def _list_closures(scenario: Scenario) -> dict[Place, tuple[Fact, list[Closure]]]:
    """Return the places that are closed, each with its closures."""
    roadmap = scenario.roadmap
    is_measured = roadmap.has_cells and scenario.units.length
    places: dict[Place, tuple[Fact, list[Closure]]] = {}
    for closure in scenario.closures:
        ends = [int(end) for end in closure.edge or (closure.at,) if end is not None]
        place = (
            Fact("listed place", scenario, place=ends[0])
            if len(ends) == 1
            else Fact("listed edge", scenario, tail=ends[0], head=ends[1])
        )
        name = tuple(roadmap.get_point(end) if is_measured else roadmap.name(end) for end in ends)
        places.setdefault(name, (place, []))[1].append(closure)
    return places


def _describe_time(closure: Closure) -> Fact:
    if closure.until is None:
        return Fact("to the end", begin=closure.from_)
    return Fact("from time to time", begin=closure.from_, until=closure.until)
