"""Places as users write them, on grids and on drawn roadmaps."""

from fractions import Fraction

import pytest

from rightofway import InputError
from rightofway.site import Roadmap, make_grid_roadmap, make_roadmap
from rightofway.site.places import Spot, as_place, find_vertex_at
from rightofway.units import Units

GRID = make_grid_roadmap(["...", "@..", "..."], cell_size=Fraction(1, 2))
UPWARDS = make_grid_roadmap(["...", "@..", "..."], y_up=True, origin=(Fraction(10), Fraction(20)))
DRAWN = make_roadmap({"bay": (0.1, -19.65), "7": (3.0, 4.0), "pit": (3.0, 4.0)}, [], y_up=True)


def found(roadmap: Roadmap, x: object, y: object) -> str:
    return roadmap.name(find_vertex_at(roadmap, as_place({"x": x, "y": y})))


@pytest.mark.parametrize(
    ("x", "y", "name"),
    [
        (0, 0, "N0"),
        ("0.49", 0.1, "N0"),
        ("1/2", 0, "N1"),  # a border belongs to the cell right of it
        ("1/2", "1/2", "N4"),  # and below it
        (1.5, 1.5, "N8"),  # the map's own border to the cell inside
    ],
)
def test_a_point_is_the_cell_that_holds_it(x: object, y: object, name: str) -> None:
    assert found(GRID, x, y) == name


@pytest.mark.parametrize(
    ("x", "y", "name"), [(10, 20, "N6"), (10.5, 22.5, "N0"), (11, 22, "N4"), (13, 23, "N2")]
)
def test_a_point_counts_upwards_from_the_origin(x: object, y: object, name: str) -> None:
    assert found(UPWARDS, x, y) == name


def test_a_point_of_a_drawn_roadmap_is_the_vertex_at_this_very_point() -> None:
    assert found(DRAWN, "0.1", "-19.65") == "bay"


@pytest.mark.parametrize(
    ("roadmap", "place", "message"),
    [
        (
            GRID,
            {"x": 0.2, "y": 0.6},
            (
                "{x: 0.2, y: 0.6} lies in N3, row 1, column 0, which is blocked by a wall (the"
                " nearest free cell is N0 at {x: 0.25, y: 0.25}, 0.35 m away)"
            ),
        ),
        (
            UPWARDS,
            {"x": 9, "y": 20},
            "{x: 9, y: 20} is outside the map (x is 10 to 13, y 20 to 23)",
        ),
        (
            DRAWN,
            {"x": "1/10", "y": -19.35},
            (
                "no vertex is at {x: 0.1, y: -19.35} (the nearest is 'bay' at {x: 0.1, y: -19.65},"
                " 0.3 m away)"
            ),
        ),
        (
            DRAWN,
            {"x": 3, "y": 4},
            "{x: 3, y: 4} is the point of '7', 'pit' (give one of these names)",
        ),
        (DRAWN, {"x": 1}, "y: is missing (give {x: 1.2, y: 0.8})"),
        (DRAWN, {"x": 1, "y": "a"}, "y: 'a' is not a number (write it like 3, 0.5 or 1/3)"),
        (GRID, {"x": 1, "y": 1, "z": 0}, "'z' is no coordinate (give {x: 1.2, y: 0.8})"),
        (GRID, 2, "2 is no place (did you mean N2?)"),
        (GRID, "2", "'2' is no place on a grid (did you mean N2?)"),
        (GRID, "n2", "'n2' is no place on a grid (did you mean N2?)"),
        (DRAWN, 7, "7 is no place (did you mean the vertex '7'? write it in quotes)"),
        (DRAWN, 8, "8 is no place (give the name of a vertex, or {x, y})"),
        (GRID, [2.5, 0.5], "[2.5, 0.5] is no place (for a point write {x: 2.5, y: 0.5})"),
        (GRID, True, "true is no place (give N<k>, [row, column] or {x, y})"),
    ],
)
def test_what_is_no_place_is_said_with_what_may_be_meant(
    roadmap: Roadmap, place: object, message: str
) -> None:
    with pytest.raises(InputError) as caught:
        find_vertex_at(roadmap, as_place(place, roadmap), units=Units(length="m"))
    assert str(caught.value) == message


def test_a_point_is_written_exactly() -> None:
    assert str(Spot(Fraction(1, 3), Fraction("-19.65"))) == "{x: 1/3, y: -19.65}"
