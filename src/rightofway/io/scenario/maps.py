"""Maps of scenario documents made into roadmaps, and places found on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

from rightofway.errors import InputError, nearest, shown
from rightofway.io.faults import Faults, under
from rightofway.io.movingai import load_map
from rightofway.model import (
    Edge,
    Floor,
    Grid,
    Obstacle,
    Roadmap,
    VertexId,
    cluster,
    node_length,
    roadmap_of_edges,
    roadmap_of_grid,
    straight_length,
)
from rightofway.model.clustering import MAX_CELLS
from rightofway.model.places import Place, vertex_at

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import (
        EdgeDocument,
        FloorDocument,
        MapDocument,
        RoadmapDocument,
    )

Point = tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedMap:
    """A roadmap, and what its document says beyond it."""

    roadmap: Roadmap
    lines: tuple[str, ...] = ()  # of a grid, as they were written
    floor: Floor | None = None  # that the grid was cut from
    file: Path | None = None  # that the grid was read from

    def find(self, place: Place) -> VertexId:
        """Return the vertex at a place, or raise an InputError that says what is there."""

        def what_blocks(row: int, column: int) -> str:
            grid, floor = self.roadmap.grid, self.floor
            obstacle = _obstacle(row, column, floor, grid) if floor and grid else ""
            return obstacle or repr(self.lines[row][column])

        return vertex_at(self.roadmap, place, what_blocks=what_blocks)


def _obstacle(row: int, column: int, floor: Floor, grid: Grid) -> str:
    """Return what stands on a cell of a floor."""
    size = grid.cell_size
    for index, it in enumerate(floor.obstacles):
        if (
            it.x < (column + 1) * size
            and column * size < it.x + it.width
            and it.y < (row + 1) * size
            and row * size < it.y + it.height
        ):
            return it.name or f"obstacles[{index}]"
    return ""


def map_of(
    document: MapDocument, speeds: Sequence[Fraction] | None, base: Path | None
) -> LoadedMap | None:
    """Make the roadmap of a map document; None where a floor's cells depend on unknown speeds.

    The speeds of the whole fleet [length units per time unit] are for node clustering. Files are
    relative to the directory ``base``; without one, none may be read.
    """
    if document.roadmap is not None:
        with under("roadmap"):
            return LoadedMap(roadmap=_drawn(document.roadmap))
    if document.floor is not None:
        return _clustered(document, speeds)
    cell_size = document.cell_size if isinstance(document.cell_size, Fraction) else Fraction(1)
    if document.file is not None:
        with under("file"):
            file = file_beside(base, document.file)
            lines = load_map(file)
            roadmap = roadmap_of_grid(lines, cell_size=cell_size)
            return LoadedMap(roadmap=roadmap, lines=lines, file=file)
    with under("grid"):
        roadmap = roadmap_of_grid(document.grid, cell_size=cell_size)
        return LoadedMap(roadmap=roadmap, lines=tuple(document.grid))


def file_beside(base: Path | None, name: str) -> Path:
    """Return the path of a file that a document names; InputError for a document in no file."""
    if base is None:
        message = f"{shown(name)} is relative to no file (write the contents into the document)"
        raise InputError.at("", message)
    return base / name


def _clustered(document: MapDocument, speeds: Sequence[Fraction] | None) -> LoadedMap | None:
    with under("floor"):
        floor = _floor(document.floor)
    cell_size = document.cell_size
    if not isinstance(cell_size, Fraction):
        if not speeds:
            return None
        cell_size = node_length(speeds)
    lines = cluster(floor, cell_size, max_cells=document.floor.max_cells or MAX_CELLS)
    with under("floor"):
        roadmap = roadmap_of_grid(lines, cell_size=cell_size)
        return LoadedMap(roadmap=roadmap, lines=lines, floor=floor)


def _floor(document: FloorDocument) -> Floor:
    width, height = document.size
    return Floor(
        width=width,
        height=height,
        obstacles=tuple(
            Obstacle(name=obstacle.name, x=x, y=y, width=width, height=height)
            for obstacle in document.obstacles
            for x, y, width, height in [obstacle.rect]
        ),
    )


def _drawn(document: RoadmapDocument) -> Roadmap:
    """Make a roadmap of its vertices and edges, or report every edge that is wrong."""
    faults, edges, first = Faults(), list[Edge](), dict[tuple[str, str], int]()
    for index, edge in enumerate(document.edges):
        length = faults.attempt(f"edges[{index}]", _length, edge, document.vertices)
        if length is None:
            continue
        there, back = (edge.tail, edge.head), (edge.head, edge.tail)
        for tail, head in (there, back) if edge.both_ways else (there,):
            earlier = first.setdefault((tail, head), index)
            if earlier != index:
                message = f"leads from {tail!r} to {head!r} as edges[{earlier}] does (take one out)"
                faults.note(f"edges[{index}]", message)
                break
            edges.append(Edge(tail=tail, head=head, length=length))
    faults.stop()
    positions = {name: (float(x), float(y)) for name, (x, y) in document.vertices.items()}
    return roadmap_of_edges(positions, edges)


def _length(edge: EdgeDocument, positions: Mapping[str, Point]) -> Fraction:
    """Return the length of an edge after checking its ends."""
    faults = Faults()
    for place, name in (("from", edge.tail), ("to", edge.head)):
        if name not in positions:
            near = nearest(name, positions)
            hint = f"did you mean {near!r}?" if near else "add it to vertices"
            faults.note(place, f"no vertex is named {name!r} ({hint})")
    if edge.tail == edge.head:
        faults.note("", f"leads from {edge.tail!r} to itself (take it out)")
    faults.stop()
    return edge.length or straight_length(positions[edge.tail], positions[edge.head])
