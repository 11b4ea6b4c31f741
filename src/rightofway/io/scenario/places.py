"""Places of a scenario document, found on its map."""

from __future__ import annotations

from rightofway.io.scenario.maps import LoadedMap
from rightofway.model import Floor, Grid, VertexId
from rightofway.model.places import Place, vertex_at

__all__ = ["find_place"]


def find_place(place: Place, on: LoadedMap) -> VertexId:
    """Return the vertex at a place of a map, or raise an InputError that says what is there."""

    def what_blocks(row: int, column: int) -> str:
        grid, floor = on.roadmap.grid, on.floor
        obstacle = _obstacle(row, column, floor, grid) if floor and grid else ""
        return obstacle or repr(on.lines[row][column])

    return vertex_at(on.roadmap, place, what_blocks=what_blocks)


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
