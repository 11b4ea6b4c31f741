"""The map of a scenario document: a grid, a file, a floor or a roadmap; made into a roadmap."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

from rightofway.errors import InputError
from rightofway.io.faults import under
from rightofway.io.movingai import read_map
from rightofway.io.scenario.ground import Ground
from rightofway.io.scenario.roadmaps import drawn_roadmap
from rightofway.io.words import shown
from rightofway.model import Floor, Obstacle, cluster, node_length, roadmap_of_grid
from rightofway.model.clustering import MAX_CELLS

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import FloorDocument, MapDocument

__all__ = ["beside", "ground_of"]


def ground_of(
    document: MapDocument, speeds: Sequence[Fraction] | None, base: Path | None
) -> Ground | None:
    """Make the roadmap of a map document.

    Parameters
    ----------
    document
        The map.
    speeds
        Of the whole fleet, for node clustering; None where they are not all known.
    base
        The directory that files are relative to; None where no file may be read.

    Returns
    -------
    Ground or None
        None where the cells of a floor depend on speeds that are not known.

    Raises
    ------
    InputError
        With places relative to the map.
    """
    if document.roadmap is not None:
        with under("roadmap"):
            return Ground(roadmap=drawn_roadmap(document.roadmap))
    if document.floor is not None:
        return _clustered(document, speeds)
    if document.file is not None:
        return _from_file(document, base)
    with under("grid"):
        roadmap = roadmap_of_grid(document.grid, cell_size=_cell_size(document))
        return Ground(roadmap=roadmap, lines=tuple(document.grid))


def _cell_size(document: MapDocument) -> Fraction:
    size = document.cell_size
    return size if isinstance(size, Fraction) else Fraction(1)


def _from_file(document: MapDocument, base: Path | None) -> Ground:
    with under("file"):
        file = beside(base, document.file)
        lines = read_map(file)
        roadmap = roadmap_of_grid(lines, cell_size=_cell_size(document))
        return Ground(roadmap=roadmap, lines=lines, file=file)


def beside(base: Path | None, name: str) -> Path:
    """Return the path of a file that a document names.

    Raises
    ------
    InputError
        If the document is in no directory, and so may read no file.
    """
    if base is None:
        message = f"{shown(name)} is relative to no file (write the contents into the document)"
        raise InputError.at("", message)
    return base / name


def _clustered(document: MapDocument, speeds: Sequence[Fraction] | None) -> Ground | None:
    with under("floor"):
        floor = _floor(document.floor)
    cell_size = document.cell_size
    if not isinstance(cell_size, Fraction):
        if not speeds:
            return None
        cell_size = node_length(speeds)
    lines = cluster(floor, cell_size, max_cells=document.floor.max_cells or MAX_CELLS)
    with under("floor"):
        return Ground(roadmap=roadmap_of_grid(lines, cell_size=cell_size), lines=lines, floor=floor)


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
