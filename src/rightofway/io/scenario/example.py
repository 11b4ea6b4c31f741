"""A first scenario for a layout: the layout as its map, and a few robots on it."""

from __future__ import annotations

import os
from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.io.faults import validate
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.json_text import format_json
from rightofway.io.layouts import read_layout
from rightofway.io.scenario.layouts import make_map_of_layout
from rightofway.io.scenario.loaded_map import FleetTraits, LoadedMap, note_on_hidden_stations
from rightofway.io.scenario.writer import format_yaml
from rightofway.kinds.numbers import format_number
from rightofway.metrics.connectivity import find_strong_parts, list_ways
from rightofway.site import make_grid_roadmap
from rightofway.site.layout import Layout, Level
from rightofway.site.occupancy import Occupancy
from rightofway.units import Units

ROBOTS = 6
"""Robots of the example, at most."""

SHIFT = 7
"""By how many halves of the distance between homes the first target is away from the first home."""

CELL_SIZES = ("1/2", "1/4", "1/8")
"""Sides of the cells that a map in pixels is cut into [m]: the first that gives a large part."""

LARGE = 100
"""Cells of a large part."""

WORK = 10
"""Work time of the example's robots [time unit]."""


class Example(NamedTuple):
    """A first scenario for a layout.

    Attributes
    ----------
    text
        Its text.
    notes
        Mendings and omissions of the reader of the layout, and the part of it that was chosen.
    """

    text: str
    notes: tuple[Fact, ...]


def make_example(path: Path | str, target: Path | str, radius: Fraction = Fraction(0)) -> Example:
    """Return a scenario that has a layout as its map.

    Parameters
    ----------
    path
        The layout's file.
    target
        The file that the text is for, JSON if its name ends so; the layout's path in it is relative
        to that file. ``-`` is standard output.
    radius
        Radius of the robots [m], in a layout without units [length unit]; 0 for points.

    Raises
    ------
    InputError
        As `read_layout` does.

    Notes
    -----
    Where the layout has several levels or vehicle types, those with the most lanes are taken.
    Robots start from parking and charging places and drive to stations, and where there are too few
    of these, between vertices that can be reached from each other. Where there are none, the
    list of robots holds a single one that the user has to place.
    """
    path, target = Path(path), Path(target)
    layout = read_layout(path)
    beside = Path() if str(target) == "-" else target.parent
    shape: dict[str, Any] = {"layout": Path(os.path.relpath(path, beside)).as_posix()}
    level, choices = None, list[Fact]()
    if isinstance(layout, Layout):
        level = max(layout.levels, key=lambda candidate: len(candidate.edges))
        if len(layout.levels) > 1:
            shape["level"] = level.name
            choices.append(
                Fact("level with most lanes", level=level.name, others=len(layout.levels) - 1)
            )
        types = level.vehicle_types
        if len(types) > 1:
            shape["vehicle_type"] = max(types, key=lambda name: len(level.list_lanes(name)))
            choices.append(
                Fact("type with most lanes", type=shape["vehicle_type"], others=len(types) - 1)
            )
    elif isinstance(layout, Occupancy):
        shape["cell_size"] = _choose_cell_size(layout, radius)
    from rightofway.io.scenario.shape import MapDocument

    loaded = make_map_of_layout(
        validate(MapDocument, shape), layout, path, Units(), FleetTraits(radius=radius)
    )
    document = {
        "format": SCENARIO_FORMAT,
        "map": shape,
        **({"units": {"length": "m", "time": "s"}} if loaded.units.length else {}),
        "robots": _place_robots(loaded, level, radius),
    }
    is_json = target.suffix.lower() == ".json"
    text = format_json(document) if is_json else format_yaml(document)
    hidden = note_on_hidden_stations(loaded.roadmap)
    return Example(text, (*choices, *loaded.notes, *hidden))


def _choose_cell_size(occupancy: Occupancy, radius: Fraction) -> str:
    """Return the largest side of cells with which robots get far, else the largest that fits."""
    fitting = list[str]()
    for size in CELL_SIZES:
        try:
            roadmap = make_grid_roadmap(occupancy.cut_cells(Fraction(size), radius=radius))
        except InputError:  # no whole cell, none that is free, or cells below a pixel
            continue
        fitting.append(size)
        if len(find_strong_parts(list_ways(roadmap))[0]) >= LARGE:
            return size
    return fitting[0] if fitting else CELL_SIZES[0]


def _place_robots(loaded: LoadedMap, level: Level | None, radius: Fraction) -> list[dict[str, Any]]:
    """Return robots with homes and targets in the largest part whose vertices reach each other."""
    roadmap = loaded.roadmap
    part = find_strong_parts(list_ways(roadmap))[0]  # without joints between pieces of lanes
    inside, stations, parking = set(part), dict[int, str](), list[int]()
    if level is not None:
        ids = {roadmap.name(vertex): vertex for vertex in part}
        parking = [
            ids[vertex.name]
            for vertex in level.vertices
            if (vertex.is_parking or vertex.is_charging) and vertex.name in ids
        ]
        for name, vertex in roadmap.drawing.stations:
            if vertex in inside and vertex not in parking:
                is_hidden = loaded.find(name) != vertex
                stations.setdefault(vertex, roadmap.name(vertex) if is_hidden else name)
    count = min(ROBOTS, len(part) // 2)
    in_zones = {vertex for zone in roadmap.zones for vertex in zone.vertices}
    free = [vertex for vertex in parking if vertex not in in_zones]
    homes = _choose(free, part, count, in_zones.union(stations))
    shift = SHIFT * len(part) // (2 * ROBOTS)  # targets lie across from homes
    targets = _choose(list(stations), part[shift:] + part[:shift], count, homes)
    assert inside.issuperset((*homes, *targets))
    ends = list(zip(homes, targets, strict=True)) or [(0, 0)]
    size = {"radius": format_number(radius)} if radius else {}
    return [
        {
            "name": f"R{number}",
            "home": roadmap.name(home),
            "target": stations.get(target, roadmap.name(target)),
            "work": WORK,
            **size,
        }
        for number, (home, target) in enumerate(ends, start=1)
    ]


def _choose(wanted: list[int], part: list[int], count: int, taken: Iterable[int]) -> list[int]:
    """Return vertices, the wanted ones first, then others spread over a part."""
    rest = [vertex for vertex in part if vertex not in {*wanted, *taken}] or part
    missing = max(count - len(wanted), 0)
    return [*wanted[:count], *(rest[k * len(rest) // missing] for k in range(missing))]
