"""Layouts of other programs as the map of a scenario."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

from rightofway.errors import InputError, locate_faults
from rightofway.facts import Fact
from rightofway.io.layouts import read_layout
from rightofway.io.scenario.loaded_map import (
    FleetTraits,
    LoadedMap,
    note_on_chosen_pieces,
    note_on_curves,
    note_on_squares,
)
from rightofway.model.actions import read_drawn_actions
from rightofway.site import make_grid_roadmap
from rightofway.site.drawing import Drawing
from rightofway.site.layout import Layout, build_roadmap_of_level
from rightofway.site.occupancy import CellMap, Occupancy
from rightofway.site.quadtree import MAX_SMALLEST, build_roadmap_of_squares
from rightofway.units import Units

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import MapDocument

CELL_SIZE = Fraction(1, 2)
"""Side of the cells that a map in finer pixels is cut into where none is given [m]."""


def map_of_layout(
    document: MapDocument,
    file: Path,
    units: Units,
    fleet: FleetTraits,
) -> LoadedMap:
    """Return the map of a layout's file."""
    with locate_faults("layout"):
        layout = read_layout(file)
    return make_map_of_layout(document, layout, file, units, fleet)


def make_map_of_layout(
    document: MapDocument,
    layout: Layout | Occupancy | CellMap,
    file: Path,
    units: Units,
    fleet: FleetTraits,
) -> LoadedMap:
    """Return the map of a layout that was read from a file.

    Layouts are in metres and seconds; a scenario that names no units has these.
    """
    if isinstance(layout, CellMap):
        return _map_of_cells(document, layout, file)
    units = replace(units, length=units.length or "m", time=units.time or "s")
    metres, seconds = units.metres, units.seconds
    assert metres, "a unit of length has a length"
    assert seconds, "a unit of time has a length"
    if isinstance(layout, Layout):
        _refuse(document, "a layout of lanes", "cell_size", "smallest", "largest", "unknown")
        level = layout.get_level(document.level)
        level_map = build_roadmap_of_level(
            level,
            vehicle_type=document.vehicle_type,
            robot_types=fleet.types,
            metre=1 / metres,
            second=1 / seconds,
            spacing=document.longest_piece,
            distance=document.choose_distance(fleet.distance),
            has_sizes=fleet.radius > 0,
        )
        roadmap = level_map.roadmap
        notes = (
            *layout.notes,
            *level_map.notes,
            *_note_on_types(document.vehicle_type, fleet.types.intersection(level.vehicle_types)),
            *note_on_curves(level_map.curves, level_map.chord_error, units),
            *note_on_chosen_pieces(level_map.split, units),
        )
        return LoadedMap(
            roadmap=roadmap,
            units=units,
            chord_error=level_map.chord_error,
            notes=notes,
            actions=read_drawn_actions(level, roadmap),
        )
    _refuse(document, "a map in pixels", "level", "vehicle_type", "spacing")
    return _map_of_pixels(document, layout, units, metres, fleet.radius)


def _note_on_types(vehicle_type: str | None, types: Collection[str | None]) -> Iterator[Fact]:
    """Yield a note where robots drive on the lanes of another type than their own."""
    others = sorted(name for name in types if name not in {None, vehicle_type} and name)
    if vehicle_type is not None and others:
        yield Fact("other vehicle type", types=tuple(others), type=vehicle_type)


def _map_of_pixels(
    document: MapDocument, occupancy: Occupancy, units: Units, metres: Fraction, radius: Fraction
) -> LoadedMap:
    """Cut a map in pixels into cells."""
    if document.cell_size == "adaptive":
        return _map_of_squares(document, occupancy, units, metres, radius)
    size = (
        document.cell_size
        if isinstance(document.cell_size, Fraction)
        else _choose_usual_cell(occupancy) / metres
    )
    lines = occupancy.cut_cells(
        size * metres, radius=radius * metres, unknown_is_free=document.unknown == "free"
    )
    with locate_faults("layout"):
        roadmap = make_grid_roadmap(
            lines,
            cell_size=size,
            y_up=True,
            origin=(occupancy.origin[0] / metres, occupancy.origin[1] / metres),
            yaw=occupancy.yaw,
        )
    if occupancy.picture is not None:
        roadmap = replace(roadmap, drawing=Drawing(picture=occupancy.picture.scale(1 / metres)))
    cells = Fact(
        "map cut into cells", about=units, columns=len(lines[0]), rows=len(lines), size=size
    )
    blocked = "what the picture shows there"
    if 2 * radius > size:
        blocked += f", or beside it for a radius of {units.write_length(radius)}"
    return LoadedMap(
        roadmap=roadmap,
        lines=lines,
        units=units,
        blocked=blocked,
        keeps_clear=True,
        notes=(*occupancy.notes, cells),
    )


def _choose_usual_cell(occupancy: Occupancy) -> Fraction:
    """Return the side of cells where none is given; no cell is below a pixel [m]."""
    return max(CELL_SIZE, occupancy.resolution)


def _map_of_squares(
    document: MapDocument, occupancy: Occupancy, units: Units, metres: Fraction, radius: Fraction
) -> LoadedMap:
    """Cut a map in pixels into squares; the smallest are as wide as the largest robot."""
    pixel = occupancy.resolution / metres
    smallest = document.smallest or (
        max(2 * radius, pixel) if radius else _choose_usual_cell(occupancy) / metres
    )
    free = occupancy.free_cells(
        smallest * metres,
        radius=radius * metres,
        unknown_is_free=document.unknown == "free",
        max_cells=MAX_SMALLEST,
        key="smallest",
    )
    corner = (occupancy.origin[0] / metres, occupancy.origin[1] / metres)
    roadmap = build_roadmap_of_squares(
        free,
        smallest,
        largest=document.largest,
        radius=radius,
        y_up=True,
        corner=corner,
        origin=corner,
        yaw=occupancy.yaw,
    )
    if occupancy.picture is not None:
        roadmap = replace(roadmap, drawing=Drawing(picture=occupancy.picture.scale(1 / metres)))
    note = note_on_squares(Fact("map"), roadmap, int(free.sum()), units)
    return LoadedMap(roadmap=roadmap, units=units, notes=(*occupancy.notes, note))


def _map_of_cells(document: MapDocument, cells_of_map: CellMap, file: Path) -> LoadedMap:
    if document.cell_size == "adaptive":
        message = "a map in cells has cells already (give cell_size as a length)"
        raise InputError.at("cell_size", message)
    _refuse(document, "a map in cells", "level", "vehicle_type", "spacing", "unknown")
    size = document.cell_size if isinstance(document.cell_size, Fraction) else Fraction(1)
    with locate_faults("layout"):
        roadmap = make_grid_roadmap(cells_of_map.lines, cell_size=size)
    return LoadedMap(roadmap=roadmap, lines=cells_of_map.lines, file=file)


def _refuse(document: MapDocument, description: str, *keys: str) -> None:
    for key in keys:
        if key in document.given:
            raise InputError.at(key, f"is given with {description}, which needs none (take it out)")
