"""A point is in exactly the cell that the frame of the map puts it in."""

from __future__ import annotations

from fractions import Fraction
from math import floor

from hypothesis import strategies as st

from rightofway.errors import InputError
from rightofway.io import dump_scenario, parse_scenario
from rightofway.model import Robot, Scenario, Stop
from rightofway.site import Roadmap, VertexId, make_grid_roadmap
from rightofway.site.places import Spot, find_vertex_at
from tests.builders.laws import law

sizes = st.fractions(Fraction(1, 20), 5, max_denominator=40)
coordinates = st.fractions(-50, 50, max_denominator=40)


@st.composite
def grids(draw: st.DrawFn) -> Roadmap:
    columns = draw(st.integers(1, 6))
    rows = draw(st.lists(st.text(".@", min_size=columns, max_size=columns), min_size=1, max_size=6))
    rows[0] = "." + rows[0][1:]
    corner = draw(st.none() | st.tuples(coordinates, coordinates))
    return make_grid_roadmap(rows, cell_size=draw(sizes), y_up=draw(st.booleans()), origin=corner)


def vertex_or_none(roadmap: Roadmap, spot: Spot) -> int | None:
    try:
        return find_vertex_at(roadmap, spot)
    except InputError:
        return None


@law(grids(), st.fractions(0, 1, max_denominator=20), st.fractions(0, 1, max_denominator=20))
def test_every_point_inside_a_free_cell_is_that_cell(
    roadmap: Roadmap, right: Fraction, up: Fraction
) -> None:
    """Points of the border belong to several cells and are left to the next test."""
    grid = roadmap.grid
    assert grid is not None
    for vertex in range(roadmap.n_vertices):
        x, y = roadmap.get_point(vertex)
        half = grid.cell_size / 2
        inside = Spot(x + (2 * right - 1) * half, y + (2 * up - 1) * half)
        found = vertex_or_none(roadmap, inside)
        assert found == vertex or {right, up} & {0, 1}


@law(grids(), coordinates, coordinates)
def test_a_point_is_in_the_cell_that_counting_from_the_corner_gives(
    roadmap: Roadmap, x: Fraction, y: Fraction
) -> None:
    grid, frame = roadmap.grid, roadmap.frame
    assert grid is not None
    left = frame.x - grid.cell_size / 2
    top = frame.y + (grid.cell_size / 2 if frame.y_up else -grid.cell_size / 2)
    right, down = (x - left) / grid.cell_size, (top - y if frame.y_up else y - top) / grid.cell_size
    column, row = floor(right) - (right == grid.columns), floor(down) - (down == grid.rows)
    is_inside = 0 <= row < grid.rows and 0 <= column < grid.columns
    expected = int(grid.vertex_at[row * grid.columns + column]) if is_inside else -1
    assert vertex_or_none(roadmap, Spot(x, y)) == (None if expected < 0 else expected)


@law(grids(), st.data())
def test_a_scenario_with_points_is_the_one_with_names(
    roadmap: Roadmap, data: st.DataObject
) -> None:
    home, target = (data.draw(st.integers(0, roadmap.n_vertices - 1)) for _ in range(2))
    named = {"name": "R1", "home": roadmap.name(home), "target": roadmap.name(target)}
    document = {"format": "rightofway-scenario/1", "map": {}, "robots": [named]}
    robot = Robot(name="R1", home=VertexId(home), stops=(Stop(at=VertexId(target)),))
    document["map"] = dump_scenario(Scenario(roadmap=roadmap, robots=(robot,)))["map"]
    points = {
        key: dict(zip("xy", map(str, roadmap.get_point(vertex)), strict=True))
        for key, vertex in (("home", home), ("target", target))
    }
    scenario = parse_scenario(document)
    assert scenario == parse_scenario({**document, "robots": [{**named, **points}]})
    assert scenario.roadmap == roadmap
