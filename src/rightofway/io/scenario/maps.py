"""Maps of scenario documents made into roadmaps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.deadline import READING, limit_loop
from rightofway.errors import InputError, find_nearest, locate_faults, name_file, quote
from rightofway.facts import Fact
from rightofway.io.content import refuse_special
from rightofway.io.faults import Faults
from rightofway.io.movingai import load_map
from rightofway.io.scenario.loaded_map import (
    FleetTraits,
    LoadedMap,
    note_on_chosen_pieces,
    note_on_curves,
    note_on_squares,
)
from rightofway.site import (
    Edge,
    Floor,
    Frame,
    Obstacle,
    Point,
    Roadmap,
    VertexId,
    choose_rounding_step,
    cluster,
    compute_node_length,
    make_grid_roadmap,
    measure_squared_distance,
    measure_straight_length,
)
from rightofway.site.clustering import MAX_CELLS, free_cells
from rightofway.site.directions import Directions
from rightofway.site.drawing import Drawing
from rightofway.site.edges import make_roadmap_of_table
from rightofway.site.spacing import find_pieces, refuse_many_pieces, split_lanes
from rightofway.site.zones import NamedZone
from rightofway.units import Units

if TYPE_CHECKING:
    from rightofway.io.scenario.curves import LaneCurve
    from rightofway.io.scenario.shape import (
        EdgeDocument,
        FloorDocument,
        MapDocument,
        ObstacleDocument,
        RoadmapDocument,
    )


def map_of(
    document: MapDocument,
    base: Path | None,
    units: Units,
    fleet: FleetTraits = FleetTraits(),  # noqa: B008 (it cannot change)
) -> LoadedMap | None:
    """Make the roadmap of a map document; None where a floor's cells depend on unknown speeds.

    Files are relative to the directory ``base``; without one, none may be read. Units are those
    that the scenario names.
    """
    if document.layout is not None:
        with locate_faults("layout"):
            file = find_file_beside(base, document.layout)
        from rightofway.io.scenario.layouts import map_of_layout

        return map_of_layout(document, file, units, fleet)
    if document.roadmap is not None:
        with locate_faults("roadmap"):
            return _map_of_roadmap(document.roadmap, document, units, fleet)
    if document.floor is not None:
        if document.cell_size == "adaptive":
            return _map_of_squares(document, fleet.speeds, fleet.radius, units)
        return _map_of_floor(document, fleet.speeds, keeps_names=units != Units())
    cell_size = document.cell_size if isinstance(document.cell_size, Fraction) else Fraction(1)
    make = partial(
        make_grid_roadmap,
        cell_size=cell_size,
        y_up=document.y_up,
        origin=document.origin,
        yaw=document.yaw or Fraction(0),
    )
    if document.file is not None:
        with locate_faults("file"):
            loaded = map_of_file(find_file_beside(base, document.file), make)
    else:
        with locate_faults("grid"):
            lines = tuple(document.grid)
            loaded = LoadedMap(roadmap=make(lines), lines=lines)
    obstacles = _list_named_obstacles(document.obstacles)
    return replace(loaded, roadmap=replace(loaded.roadmap, obstacles=obstacles))


def map_of_file(
    file: Path, make: Callable[[Sequence[str]], Roadmap] = make_grid_roadmap
) -> LoadedMap:
    """Make the roadmap of the rows of a `.map` file."""
    lines = load_map(file)
    with name_file(str(file)):
        return LoadedMap(roadmap=make(lines), lines=lines, file=file)


def _list_named_obstacles(documents: Sequence[ObstacleDocument]) -> tuple[Obstacle, ...]:
    """Return the obstacles that have a name, in the site's frame."""
    return tuple(_make_obstacle(document) for document in documents if document.name)


def _make_obstacle(
    document: ObstacleDocument, left: Fraction = Fraction(0), low: Fraction = Fraction(0)
) -> Obstacle:
    """Return an obstacle relative to a point of the site."""
    x, y, width, height = document.rect
    return Obstacle(name=document.name, x=x - left, y=y - low, width=width, height=height)


def find_file_beside(base: Path | None, name: str) -> Path:
    """Return the path of a file that a document names.

    InputError for a document in no file, and for devices, pipes and directories.
    """
    if base is None:
        message = f"{quote(name)} is relative to no file (write the contents into the document)"
        raise InputError.at("", message)
    refuse_special(base / name)
    return base / name


def _map_of_floor(
    document: MapDocument, speeds: Sequence[Fraction] | None, *, keeps_names: bool
) -> LoadedMap | None:
    """Cut a floor into cells, from its upper left corner on; where y grows upwards, the lower one.

    The rest at the other borders is not used. The names of obstacles stay with the grid where
    the scenario names its units; plan files of floors without units are as they have always been.
    """
    with locate_faults("floor"):
        floor = _make_floor(document.floor, document)
    cell_size = document.cell_size
    if not isinstance(cell_size, Fraction):
        if not speeds:
            return None
        cell_size = compute_node_length(speeds)
    lines = cluster(floor, cell_size, max_cells=document.floor.max_cells or MAX_CELLS)
    origin = document.origin
    if document.y_up:
        lines = lines[::-1]
    elif origin:
        origin = (origin[0], origin[1] - floor.height + len(lines) * cell_size)
    with locate_faults("floor"):
        roadmap = make_grid_roadmap(
            lines,
            cell_size=cell_size,
            y_up=document.y_up,
            origin=origin,
            yaw=document.yaw or Fraction(0),
        )
        if keeps_names:
            roadmap = replace(roadmap, obstacles=_list_named_obstacles(document.floor.obstacles))
        return LoadedMap(roadmap=roadmap, lines=lines, floor=floor)


def _map_of_squares(
    document: MapDocument, speeds: Sequence[Fraction] | None, radius: Fraction, units: Units
) -> LoadedMap | None:
    """Cut a floor into squares of a quadtree, from the corner that has the least x and y.

    The smallest are as wide as the largest robot; where no robot has a size, as node clustering
    has it.
    """
    from rightofway.site.quadtree import MAX_SMALLEST, build_roadmap_of_squares

    smallest = document.smallest or 2 * radius
    if not smallest:
        if not speeds:
            return None
        smallest = compute_node_length(speeds)
    with locate_faults("floor"):
        floor = _make_floor(document.floor, document)
    free = free_cells(floor, smallest, max_cells=MAX_SMALLEST, key="smallest")
    origin = document.origin or (Fraction(0), Fraction(0) if document.y_up else floor.height)
    roadmap = build_roadmap_of_squares(
        free,
        smallest,
        largest=document.largest,
        radius=radius,
        y_up=document.y_up,
        corner=origin if document.y_up else (origin[0], origin[1] - floor.height),
        origin=origin,
        yaw=document.yaw or Fraction(0),
        max_squares=document.floor.max_cells or MAX_CELLS,
    )
    return LoadedMap(
        roadmap=roadmap, notes=(note_on_squares(Fact("floor"), roadmap, int(free.sum()), units),)
    )


def _make_floor(document: FloorDocument, on: MapDocument) -> Floor:
    """Return a floor, its obstacles relative to the corner that has the least x and y."""
    width, height = document.size
    left, low = on.origin or (Fraction(0), Fraction(0))
    if on.origin and not on.y_up:
        low -= height
    return Floor(
        width=width,
        height=height,
        obstacles=tuple(_make_obstacle(obstacle, left, low) for obstacle in document.obstacles),
    )


def _map_of_roadmap(
    document: RoadmapDocument, on: MapDocument, units: Units, fleet: FleetTraits
) -> LoadedMap:
    """Make a roadmap of its vertices and edges, or report every edge that is wrong.

    Robots with a size drive along the straight pieces of a curve.
    """
    faults, edges, first = Faults(), list[Edge](), dict[tuple[str, str], int]()
    curves: dict[tuple[str, str], LaneCurve] = {}
    positions = {name: vertex.at for name, vertex in document.vertices.items()}
    lengths = list[Fraction | None]()
    squares = {
        index: measure_squared_distance(positions[edge.tail], positions[edge.head])
        for index, edge in enumerate(document.edges)
        if edge.length is None
        and edge.curve is None
        and edge.tail in positions
        and edge.head in positions
    }
    step = choose_rounding_step(squares.values())
    for index, edge in enumerate(limit_loop(document.edges, READING)):
        place, square = ("edges", index), squares.get(index)
        lane_length = faults.attempt(place, _measure_length, edge, positions, square, step)
        length, curve = lane_length or (None, None)
        lengths.append(length)
        if length is None:
            continue
        forward, back = (edge.tail, edge.head), (edge.head, edge.tail)
        if curve:
            curves[forward] = curve
        if curve and edge.both_ways:
            curves[back] = curve.reverse()
        for tail, head in (forward, back) if edge.both_ways else (forward,):
            earlier = first.setdefault((tail, head), index)
            if earlier != index:
                message = f"leads from {tail!r} to {head!r} as {{other}} does (take one out)"
                faults.note(place, message, ("edges", earlier))
                break
            edges.append(
                Edge(
                    tail=tail,
                    head=head,
                    length=length,
                    max_speed=edge.max_speed,
                    max_speed_by_type=edge.max_speed_by_type,
                    barred=frozenset(edge.barred),
                    surcharge=edge.surcharge or Fraction(0),
                )
            )
    faults.stop()
    zones = [
        NamedZone(name=zone.name, vertices=tuple(zone.vertices), edges=tuple(zone.edges))
        for zone in document.zones
    ]
    if on.longest_piece is not None and document.sides is not None:
        raise InputError.at("sides", "cells are not split by spacing (take one of them out)")
    has_sizes = fleet.radius > 0
    is_cut = bool(curves) and has_sizes
    distance = on.choose_distance(fleet.distance) if document.sides is None else Fraction(0)
    is_split = on.longest_piece is not None or is_cut or distance > 0
    shapes = _cut_shapes(curves, positions, on.longest_piece, has_sizes) if is_split else {}
    split = split_lanes(positions, edges, on.longest_piece, shapes, distance=distance)
    written_pieces = {
        ends: [part for piece in pieces for part in split.pieces.get(piece, (piece,))]
        for ends, pieces in find_pieces(
            positions, {(edge.tail, edge.head) for edge in edges}
        ).items()
    }
    left, low = on.origin if on.origin and on.yaw else (Fraction(0), Fraction(0))
    drawn = {name: (x - left, y - low) for name, (x, y) in split.positions.items()}
    frame = Frame(x=left, y=low, y_up=on.y_up, yaw=on.yaw or Fraction(0))
    directions = _read_directions(document, curves)
    rounded = sum((lengths[index] or 0) ** 2 != square for index, square in squares.items())
    roadmap = make_roadmap_of_table(
        drawn,
        split.edges,
        y_up=on.y_up,
        zones=zones,
        pieces=written_pieces | split.pieces,
        sides=document.sides,
        frame=frame,
        barred={name: vertex.barred for name, vertex in document.vertices.items() if vertex.barred},
        surcharges={
            name: vertex.surcharge for name, vertex in document.vertices.items() if vertex.surcharge
        },
        passed=[name for name, vertex in document.vertices.items() if vertex.is_passed],
        directions=directions,
    )
    drawing = replace(
        _read_places(document, roadmap),
        **_collect_bends(curves, roadmap),
        **directions.collect(roadmap),
        edge_ids=roadmap.list_whole_edges(_collect_edge_ids(document)),
    )
    error = max(curve.error for curve in curves.values()) if is_cut else Fraction(0)
    return LoadedMap(
        roadmap=replace(roadmap, drawing=drawing),
        rounding=(rounded, len(document.edges), step) if rounded else None,
        chord_error=error,
        notes=(
            *(note_on_curves(len({*map(frozenset, curves)}), error, units) if is_cut else ()),
            *note_on_chosen_pieces(split, units),
        ),
    )


def _cut_shapes(
    curves: Mapping[tuple[str, str], LaneCurve],
    positions: Mapping[str, Point],
    spacing: Fraction | None,
    has_sizes: bool,
) -> dict[tuple[str, str], tuple[Point, ...]]:
    """Return the points at which curves are cut; for robots without a size by spacing alone."""
    if has_sizes or spacing is None:
        return {ends: curve.points for ends, curve in curves.items()}
    from rightofway.io.scenario.curves import make_points_along

    refuse_many_pieces((curve.length for curve in curves.values()), spacing)
    return {
        (tail, head): make_points_along(curve, positions[tail], positions[head], spacing)
        for (tail, head), curve in curves.items()
    }


def _collect_bends(curves: Mapping[tuple[str, str], LaneCurve], roadmap: Roadmap) -> dict[str, Any]:
    """Return the points and the control points of the curves that are one edge each."""
    whole = roadmap.list_whole_edges(curves)
    return {
        "curves": tuple((tail, head, curve.points) for tail, head, curve in whole),
        "controls": tuple((tail, head, curve.controls) for tail, head, curve in whole),
    }


def _collect_edge_ids(document: RoadmapDocument) -> dict[tuple[str, str], str]:
    """Return the ids of edges in orders, by their ends."""
    return {
        ends: edge.edge_id
        for edge in document.edges
        if edge.edge_id is not None
        for ends in ((edge.tail, edge.head), (edge.head, edge.tail))[: 1 + edge.both_ways]
    }


def _read_directions(
    document: RoadmapDocument, curves: Mapping[tuple[str, str], LaneCurve]
) -> Directions:
    """Return where robots may not turn, and how they are turned."""
    vertices = document.vertices.items()
    directed = [
        (ends, edge)
        for edge in document.edges
        if edge.orientation is not None or edge.turning is not None
        for ends in ((edge.tail, edge.head), (edge.head, edge.tail))[: 1 + edge.both_ways]
    ]
    return Directions(
        fixed=[name for name, vertex in vertices if not vertex.turning],
        turning={ends: edge.turning for ends, edge in directed if edge.turning is not None},
        headings={name: vertex.heading for name, vertex in vertices if vertex.heading is not None},
        orientations={
            ends: edge.orientation for ends, edge in directed if edge.orientation is not None
        },
        bends={ends: curve.points for ends, curve in curves.items()},
    )


def _read_places(document: RoadmapDocument, roadmap: Roadmap) -> Drawing:
    """Return the stations and parking places, or report every vertex that there is not."""
    faults = Faults()

    def vertex(name: str) -> VertexId:
        try:
            return roadmap.get_vertex(name)
        except KeyError:
            near = find_nearest(name, document.vertices)
            hint = f"did you mean {near!r}?" if near else "add it to vertices"
            raise InputError.at("", f"no vertex is named {quote(name)} ({hint})") from None

    def known(key: str, names: Sequence[str]) -> tuple[VertexId, ...]:
        vertices = [faults.attempt((key, at), vertex, name) for at, name in enumerate(names)]
        return tuple(at_vertex for at_vertex in vertices if at_vertex is not None)

    stations = [
        (name, faults.attempt(("stations", name), vertex, at))
        for name, at in document.stations.items()
    ]
    parking, charging = known("parking", document.parking), known("charging", document.charging)
    faults.stop()
    return Drawing(
        stations=tuple((name, at) for name, at in stations if at is not None),
        parking=parking,
        charging=charging,
    )


def _measure_length(
    edge: EdgeDocument, positions: Mapping[str, Point], square: Fraction | None, step: Fraction
) -> tuple[Fraction, LaneCurve | None]:
    """Return the length of an edge after checking its ends, and its curve."""
    faults = Faults()
    for place, name in (("from", edge.tail), ("to", edge.head)):
        if name not in positions:
            near = find_nearest(name, positions)
            hint = f"did you mean {near!r}?" if near else "add it to vertices"
            faults.note(place, f"no vertex is named {name!r} ({hint})")
    if edge.tail == edge.head:
        faults.note("", f"leads from {edge.tail!r} to itself (take it out)")
    faults.stop()
    if edge.curve is None:
        return edge.length or measure_straight_length(square or Fraction(0), step), None
    from rightofway.io.scenario.curves import make_lane_curve

    with locate_faults("curve"):
        curve = make_lane_curve(positions[edge.tail], edge.curve, positions[edge.head])
    return edge.length or curve.length, curve
