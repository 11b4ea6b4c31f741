"""Jobs and states of robots as users of Python write them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, replace
from typing import Any

from rightofway.errors import InputError, Where, locate_faults, quote
from rightofway.kinds.table import list_of, make_kind
from rightofway.model import JobStop, RobotState
from rightofway.site import VertexId

MAPPING = make_kind(
    "a mapping like {'at': 'N3', 'work': 2}",
    lambda value: isinstance(value, Mapping),
    "is no mapping",
)

Find = Callable[[Where, Any], VertexId]
"""Returns the vertex of a place as users write it, or raises faults at the place of the value."""


ReadMoment = Callable[[Where, Any], Any]
"""Returns a point in time as a number where it is a time of day, or raises faults at its place."""


def read_job_stops(
    find: Find, read_moment: ReadMoment, given: Mapping[str, Any]
) -> tuple[JobStop, ...]:
    """Return the stops of a job by the arguments of `FleetBuilder.add_job`.

    Raises
    ------
    InputError
        For not exactly one of ``at``, ``pickup`` with ``dropoff``, and ``stops``; for a place that
        is not on the map and a value of a wrong kind.
    """
    forms = [key for key in ("at", "pickup", "stops") if given[key] is not None]
    if len(forms) != 1 or (given["pickup"] is None) != (given["dropoff"] is None):
        message = "has not exactly one form (give at, or pickup and dropoff, or stops)"
        raise InputError.at("", message)
    stops = [_read_stop(find, read_moment, where, stop) for where, stop in _list_stops(given)]
    if given["earliest"] is not None:
        stops[0] = replace(stops[0], earliest=given["earliest"])
    if given["latest"] is not None:
        stops[-1] = replace(stops[-1], latest=given["latest"])
    return tuple(stops)


def _list_stops(given: Mapping[str, Any]) -> Iterator[tuple[Where, Mapping[str, Any]]]:
    """Yield the stops of a job as mappings, with the arguments that they are in."""
    if given["at"] is not None:
        yield "at", {key: given[key] for key in ("at", "work", "actions")}
    elif given["pickup"] is not None:
        for key, sign in (("pickup", 1), ("dropoff", -1)):
            work, load = given[f"{key}_work"], sign * given["load"]
            actions = given[f"{key}_actions"]
            yield key, {"at": given[key], "work": work, "load": load, "actions": actions}
    else:
        stops = list_of(MAPPING).read_at("stops", given["stops"])
        if not stops:
            raise InputError.at("stops", "there is none (give at least one)")
        yield from ((("stops", number), stop) for number, stop in enumerate(stops))


def _read_stop(
    find: Find, read_moment: ReadMoment, where: Where, stop: Mapping[str, Any]
) -> JobStop:
    _refuse_unknown(where, stop, JobStop)
    if "at" not in stop:
        raise InputError.at(where, "has no place (give at)")
    at = find(where, stop["at"])
    with locate_faults(where):
        times = {key: read_moment(key, stop[key]) for key in ("earliest", "latest") if key in stop}
        return JobStop(**{**stop, **times, "at": at})


def read_state(
    find: Find, read_moment: ReadMoment, state: Any, home: VertexId
) -> RobotState | None:
    """Return the state of a robot: a value, or a mapping whose ``at`` is the home by default.

    Raises
    ------
    InputError
        For a place that is not on the map, an unknown key and a value of a wrong kind.
    """
    if state is None or isinstance(state, RobotState):
        return state
    if not isinstance(state, Mapping):
        remedy = 'give RobotState(at=vertex), or a mapping like {"at": "N7", "soc": 0.5}'
        raise InputError.at("start", f"{quote(state)} is no state ({remedy})")
    _refuse_unknown("start", state, RobotState)
    at = find("start", state["at"]) if "at" in state else home
    with locate_faults("start"):
        times = {key: read_moment(key, state[key]) for key in ("ready",) if key in state}
        return RobotState(**{**state, **times, "at": at})


def _refuse_unknown(where: Where, mapping: Mapping[str, Any], owner: type) -> None:
    """Refuse a mapping with a key that is no field of a class."""
    known = [own.name for own in fields(owner)]
    unknown = [key for key in mapping if key not in known]
    if unknown:
        raise InputError.at(where, f"{quote(unknown[0])} is unknown (give {', '.join(known)})")
