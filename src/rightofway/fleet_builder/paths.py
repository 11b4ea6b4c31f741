"""Paths of an algorithm of one's own as a plan, which can be judged, improved and shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Sized
from fractions import Fraction
from typing import Any

from rightofway.errors import InputError, find_nearest, locate_faults, quote
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import ANYTHING, list_of
from rightofway.model import Plan, PlannerRun, Scenario, Track
from rightofway.site.places import as_place, find_vertex_at

__all__ = ["plan_of_paths"]

PAIR = 2


@checks_arguments
def plan_of_paths(scenario: Scenario, paths: Mapping[str, Sequence[Any]]) -> Plan:
    """Return paths as a plan, for `check`, `improve` and the pages.

    Parameters
    ----------
    scenario
        The scenario.
    paths
        For each robot by name the places that it is at: one for each time unit, from time 0 on; or
        pairs of a place and the tick at which the robot enters it. A place is a cell as (row,
        column), a name or a point.

    Raises
    ------
    InputError
        If a robot has no path, or a place is not known. A broken rule is no fault here:
        `rightofway.check` judges it.

    Examples
    --------
    >>> import rightofway
    >>> fleet = rightofway.FleetBuilder(grid=["..."], ends="none", turn=0)
    >>> scenario = fleet.add_robot("R1", home=(0, 0), target=(0, 2)).build_scenario()
    >>> plan = plan_of_paths(scenario, {"R1": [(0, 0), (0, 0), (0, 1), (0, 2)]})
    >>> rightofway.check(plan).ok, plan["R1"].completion
    (True, 3)
    >>> plan == plan_of_paths(scenario, {"R1": [("N0", 0), ("N1", 2), ("N2", 3)]})
    True
    """
    names = [robot.name for robot in scenario.robots]
    if not isinstance(paths, Mapping):
        remedy = 'give each robot its path by its name, like {"R1": ["N0", "N1"]}'
        raise InputError.at("paths", f"{quote(paths)} are no paths ({remedy})")
    for name in paths:
        if name not in names:
            near = find_nearest(name, names)
            hint = f"did you mean {near!r}?" if near else f"robots are {', '.join(names)}"
            raise InputError.at("paths", f"no robot is named {quote(name)} ({hint})")
    missing = [name for name in names if _is_missing(paths.get(name))]
    if missing:
        raise InputError.at("paths", f"{missing[0]} has no path (give at least its home)")
    read = {name: list_of(ANYTHING).read_at(("paths", name), paths[name]) for name in names}
    tracks = [_track(scenario, name, read[name]) for name in names]
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun())


def _track(scenario: Scenario, name: str, path: Sequence[Any]) -> Track:
    """Return the visits of a path; a robot that stays makes one of them."""
    vertices, enter = list[int](), list[int]()
    for index, (place, tick) in enumerate(_count_times(scenario, name, path)):
        with locate_faults(("paths", name, index)):
            roadmap = scenario.roadmap
            vertex = find_vertex_at(roadmap, as_place(place, roadmap), units=scenario.units)
        if not vertices or vertices[-1] != vertex:
            vertices.append(vertex)
            enter.append(tick)
    return Track.of(vertices, enter)


def _count_times(scenario: Scenario, name: str, path: Sequence[Any]) -> Iterator[tuple[Any, int]]:
    """Yield each place with its tick: as it is given, or of the time units so far."""
    per_unit = 1 / Fraction(scenario.problem.clock.tick)
    pairs = [_is_pair(item) for item in path]
    for index, item in enumerate(path):
        if pairs[index] != pairs[0]:
            message = f"{quote(item)} is a pair, or another item is (give a tick to all or none)"
            raise InputError.at(("paths", name, index), message)
        if pairs[index]:
            yield item[0], item[1]
        elif (index * per_unit).denominator != 1:
            tick = scenario.problem.clock.tick
            message = f"a tick is {tick}, no part of a time unit (give pairs of place and tick)"
            raise InputError.at(("paths", name), message)
        else:
            yield item, int(index * per_unit)


def _is_missing(path: Any) -> bool:
    """Return whether a path is none, or has no item."""
    return path is None or (isinstance(path, Sized) and not len(path))


def _is_pair(item: Any) -> bool:
    """Return whether an item is a place and a tick, and no cell, which is two numbers."""
    is_two = isinstance(item, tuple | list) and len(item) == PAIR
    return is_two and not isinstance(item[0], int) and isinstance(item[1], int)
