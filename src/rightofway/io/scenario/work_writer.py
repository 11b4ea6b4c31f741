"""Jobs, batteries and states of a scenario, written with exact numbers and names of places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from fractions import Fraction
from typing import Any

from rightofway.kinds.numbers import format_number
from rightofway.model import Job, JobStop, Robot, RobotState, Rules, Scenario, StopAction
from rightofway.site import Roadmap
from rightofway.units import Units

NO_UNITS = Units()

MOMENTS = frozenset({"earliest", "latest", "due"})
"""Fields that are points in time."""

PAIR = 2
"""Stops of a job that may be a pickup and a dropoff."""


def dump_work(scenario: Scenario) -> dict[str, Any]:
    """Return the keys of a document for jobs; none for a scenario without jobs."""
    if scenario.jobs is None:
        return {}
    roadmap, charging = scenario.roadmap, scenario.charging
    if roadmap.grid is not None:  # a grid in a document has no charging places
        charging = (*charging, *roadmap.drawing.charging)
    document = {
        "batteries": {name: _dump_given(battery) for name, battery in scenario.batteries},
        "charging": list(dict.fromkeys(map(roadmap.name, charging))),
    }
    known = {key: value for key, value in document.items() if value}
    return {**known, "jobs": [dump_job(job, roadmap, scenario.units) for job in scenario.jobs]}


def dump_robot_of_jobs(robot: Robot, roadmap: Roadmap) -> dict[str, Any]:
    """Return the keys that only a robot in a scenario with jobs has."""
    document: dict[str, Any] = {"capacity": robot.capacity, "battery": robot.battery}
    if robot.charging is not None:
        document["charging"] = list(map(roadmap.name, robot.charging))
    if robot.start is not None:
        document["start"] = _dump_state(robot.start, roadmap)
    return {key: value for key, value in document.items() if value is not None}


def dump_rules_of_jobs(rules: Rules) -> dict[str, Any]:
    """Return the rules that only a scenario with jobs has."""
    return _dump_given(rules, only=("objective", "late", "patience"))


def _dump_state(state: RobotState, roadmap: Roadmap) -> dict[str, Any]:
    begun = {"begun": dict(state.begun)} if state.begun else {}
    given = _dump_given(state, but=("at", "begun"))
    return {"at": roadmap.name(state.at), **given, **begun}


def dump_job(job: Job, roadmap: Roadmap, units: Units = NO_UNITS) -> dict[str, Any]:
    """Return the document of a job, in the shortest form that has all of its stops.

    With units that have a start, points in time are times of day.
    """
    names = {key: list(value) for key in ("types", "after") if (value := getattr(job, key))}
    others = _dump_given(job, units, but=("name", "stops", "types", "after"))
    return {"name": job.name, **_dump_stops(job, roadmap, units), **others, **names}


def _dump_stops(job: Job, roadmap: Roadmap, units: Units) -> dict[str, Any]:
    first, last = job.stops[0], job.stops[-1]
    if len(job.stops) == 1:
        return _dump_stop(first, roadmap, units)
    is_carried = first.load > 0 and len(job.stops) == PAIR
    if not is_carried or first.latest is not None or last.earliest:
        return {"stops": [_dump_stop(stop, roadmap, units) for stop in job.stops]}
    ends = {"pickup": first, "dropoff": last}
    works = {f"{key}_work": format_number(stop.work) for key, stop in ends.items() if stop.work}
    times = _dump_given(first, units, only=("earliest",))
    times |= _dump_given(last, units, only=("latest",))
    places = {key: roadmap.name(stop.at) for key, stop in ends.items()}
    actions = dump_actions(**{f"{key}_actions": stop.actions for key, stop in ends.items()})
    return {**places, **works, "load": first.load, **times, **actions}


def _dump_stop(stop: JobStop, roadmap: Roadmap, units: Units) -> dict[str, Any]:
    given = _dump_given(stop, units, but=("at", "actions"))
    return {"at": roadmap.name(stop.at), **given, **dump_actions(actions=stop.actions)}


def dump_actions(**actions: Sequence[StopAction]) -> dict[str, Any]:
    """Return actions by their keys in documents, without those that are not given."""
    return {key: _dump_list(own) for key, own in actions.items() if own}


def _dump_list(actions: Sequence[StopAction]) -> Any:
    """Return actions in the shortest form: one without a list, one of no parameters by its type."""
    documents = [action.to_document() for action in actions]
    short = [own["action"] if own.keys() == {"action"} else own for own in documents]
    return short[0] if len(short) == 1 else short


def dump_moment(time: Fraction, units: Units) -> int | str:
    """Return a point in time exactly: a time of day where the units have a start."""
    return units.write_clock_time(time) or format_number(time)


def _dump_given(
    value: Any,
    units: Units = NO_UNITS,
    *,
    only: tuple[str, ...] = (),
    but: tuple[str, ...] = (),
) -> dict[str, Any]:
    """Return the fields of a value that differ from their defaults, numbers exactly."""
    own: Mapping[str, Any] = {
        field.name: getattr(value, field.name)
        for field in fields(value)
        if field.name not in but
        and (not only or field.name in only)
        and getattr(value, field.name) != field.default
    }
    return {
        name: dump_moment(number, units if name in MOMENTS else NO_UNITS)
        if isinstance(number, Fraction)
        else number
        for name, number in own.items()
    }
