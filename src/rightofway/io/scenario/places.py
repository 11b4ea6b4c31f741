"""Places of a scenario document, found on its map."""

from __future__ import annotations

from rightofway.io.scenario.ground import Ground
from rightofway.model import Floor, Grid, VertexId
from rightofway.model.places import Place, as_place, vertex_at

__all__ = ["Place", "as_place", "find_place"]


def find_place(place: Place, ground: Ground) -> VertexId:
    """Return the vertex at a place of a map that a document describes; see `vertex_at`.

    Raises
    ------
    InputError
        If the place is outside the map, blocked, or not known; with what blocks it.
    """

    def what_blocks(row: int, column: int) -> str:
        grid, floor = ground.roadmap.grid, ground.floor
        obstacle = _obstacle(row, column, floor, grid) if floor and grid else ""
        return obstacle or repr(ground.lines[row][column])

    return vertex_at(ground.roadmap, place, what_blocks=what_blocks)


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
