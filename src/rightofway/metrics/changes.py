"""In what a scenario differs from another one, as a person would say it: ``R2: speed 1 → 2``.

Robots are the same where their names are; places, where their names are or, on maps of cells of
different sizes, where they lie within a cell of each other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any

import numpy as np

from rightofway.arguments import checks_arguments
from rightofway.model import Robot, Scenario
from rightofway.model.attributes import Attribute
from rightofway.model.closures import Closure
from rightofway.model.place_names import PlaceNames
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES
from rightofway.quantities import Quantities, format_decimal
from rightofway.site import Roadmap

NAMED = 2
"""Robots with the same change that are named; more are counted."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Something in which a scenario differs from another one.

    Attributes
    ----------
    subject
        What has changed: a robot, several robots, ``map``, ``rules``, a place.
    robots
        The names of the robots that have changed in this way; empty where it is something else.
    key
        What of it: ``speed``, ``home``, ``headway``, ``added``, ``removed``, ``closed``, ``open``;
        empty for the size of a map.
    before, after
        The values as people read them; empty where there is none.
    """

    subject: str
    key: str
    before: str = ""
    after: str = ""
    robots: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The change as a line: ``R2: speed 1 m/s → 2 m/s``."""
        values = f"{self.before} → {self.after}" if self.before or self.after else ""
        return f"{self.subject}: {' '.join(filter(None, (self.key, values)))}"

    def as_dict(self) -> dict[str, Any]:
        """Return the attributes and the text by name."""
        named = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**named, "robots": list(self.robots), "text": self.text}


@checks_arguments
def find_changes(before: Scenario, after: Scenario) -> tuple[Change, ...]:
    """Return in what a scenario differs from another one.

    Parameters
    ----------
    before, after
        The scenarios.

    Returns
    -------
    tuple of Change
        Robots, in the order of ``after``, those that are removed last; then map, rules, closures.
        Robots that change in the same way are one entry.
    """
    robots_of_change: dict[tuple[str, str, str], list[str]] = {}
    was = {robot.name: robot for robot in before.robots}
    is_same_place = _places(before.roadmap, after.roadmap)
    for robot in after.robots:
        old = was.pop(robot.name, None)
        differing = (
            [("added", "", "")] if old is None else _robot(before, old, after, robot, is_same_place)
        )
        for change in differing:
            robots_of_change.setdefault(change, []).append(robot.name)
    for name in was:
        robots_of_change.setdefault(("removed", "", ""), []).append(name)
    robots = [
        Change(subject=_named(names), robots=tuple(names), key=key, before=old, after=new)
        for (key, old, new), names in robots_of_change.items()
    ]
    return (*robots, *_map(before, after), *_rules(before, after), *_closures(before, after))


def _named(names: list[str]) -> str:
    return " and ".join(names) if len(names) <= NAMED else f"{len(names)} robots"


def _places(before: Roadmap, after: Roadmap) -> Callable[[int, int], bool]:
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


def _robot(
    before: Scenario,
    old: Robot,
    after: Scenario,
    new: Robot,
    is_same_place: Callable[[int, int], bool],
) -> Iterator[tuple[str, str, str]]:
    """Yield what of a robot differs: key and both values in words."""
    was, now = PlaceNames(before).describe_place, PlaceNames(after).describe_place
    if not is_same_place(old.home, new.home):
        yield "home", was(old.home), now(new.home)
    stops, then = [stop.at for stop in old.stops], [stop.at for stop in new.stops]
    if len(stops) != len(then) or not all(map(is_same_place, stops, then)):
        yield "stops", ", ".join(map(was, stops)), ", ".join(map(now, then))
    works = [
        ", ".join(_time(scenario, stop.work) for stop in robot.stops)
        for scenario, robot in ((before, old), (after, new))
    ]
    if works[0] != works[1]:
        yield "work", works[0], works[1]
    yield from _attributes(ROBOT_ATTRIBUTES, before, old, after, new)


def _time(scenario: Scenario, value: Fraction) -> str:
    """Return a time [time unit] as people read it."""
    quantities = scenario.quantities
    times = Quantities(units=quantities.units, tick=Fraction(1))
    return (
        times.format_cell(value)
        if quantities.units.seconds is None
        else times.format_duration(value)
    )


def _value(scenario: Scenario, attribute: Attribute, value: Any) -> str:
    """Return a value of a robot or a rule as people read it."""
    if value is None:
        return attribute.unset
    if isinstance(value, bool):
        return "yes" if value else "no"
    if attribute.measure == "speed":
        return scenario.quantities.format_speed(value)
    if attribute.measure == "length":
        return scenario.quantities.format_length(value)
    if isinstance(value, str):
        return value
    return _time(scenario, value) if attribute.measure == "time" else format_decimal(value)


def _attributes(
    attributes: Iterable[Attribute], before: Scenario, old: Any, after: Scenario, new: Any
) -> Iterator[tuple[str, str, str]]:
    """Yield what differs between two robots or rules: name and both values in words."""
    for attribute in attributes:
        was = _value(before, attribute, getattr(old, attribute.name))
        now = _value(after, attribute, getattr(new, attribute.name))
        if was != now:
            yield attribute.name.replace("_", " "), was, now


def _rules(before: Scenario, after: Scenario) -> Iterator[Change]:
    for key, was, now in _attributes(RULE_ATTRIBUTES, before, before.rules, after, after.rules):
        yield Change(subject="rules", key=key, before=was, after=now)


def _map(before: Scenario, after: Scenario) -> Iterator[Change]:
    """Yield one change where the maps differ: by their sizes where these say it."""
    old_roadmap, other = before.roadmap, after.roadmap
    if old_roadmap == other:
        return
    sizes = []
    for roadmap in (old_roadmap, other):
        cells, vertices = roadmap.grid is not None, roadmap.n_vertices
        sizes.append(f"{vertices} free cells" if cells else f"{vertices} vertices")
    if sizes[0] == sizes[1] and old_roadmap.grid is None:
        sizes = [f"{len(roadmap.heads)} edges" for roadmap in (old_roadmap, other)]
    if sizes[0] == sizes[1]:
        yield Change(subject="map", key="changed")
    else:
        yield Change(subject="map", key="", before=sizes[0], after=sizes[1])


def _closures(before: Scenario, after: Scenario) -> Iterator[Change]:
    was, now = _closed(before), _closed(after)
    for place in now:
        if place not in was:
            yield Change(subject=place, key="closed")
        elif was[place] != now[place]:
            yield Change(subject=place, key="closed", before=was[place], after=now[place])
    for place in was:
        if place not in now:
            yield Change(subject=place, key="open")


def _closed(scenario: Scenario) -> dict[str, str]:
    """Return where something is closed, and when."""

    def when(closure: Closure) -> str:
        until = "the end" if closure.until is None else _time(scenario, closure.until)
        return f"{_time(scenario, closure.from_)} to {until}"

    shown_values: dict[str, str] = {}
    for closure in scenario.closures:
        ends = [closure.at] if closure.edge is None else closure.edge
        place = " to ".join(
            PlaceNames(scenario).describe_place(int(end)) for end in ends if end is not None
        )
        shown_values[place] = ", ".join(filter(None, (shown_values.get(place), when(closure))))
    return shown_values
