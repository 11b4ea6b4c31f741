"""Where vertices are drawn: in the plane, and in one line."""

from fractions import Fraction

import pytest

from rightofway.site import Edge, make_grid_roadmap, make_roadmap
from rightofway.viz.placement import (
    MAX_ROBOTS,
    MAX_VERTICES,
    lay_out_roadmap,
    make_edge_length,
    order_in_line,
)
from tests.builders.plans import DOOR, loop


def test_a_cell_is_a_unit_whatever_its_size() -> None:
    plane = lay_out_roadmap(make_grid_roadmap(DOOR, cell_size=Fraction(1, 2)))
    # column and row of N0, N1, N2, N4, N6, N7, N8
    assert plane.points.tolist() == [[0, 0], [1, 0], [2, 0], [1, 1], [0, 2], [1, 2], [2, 2]]
    assert (plane.width, plane.height) == (3, 3)


def test_a_short_edge_is_a_unit_of_a_roadmap() -> None:
    # all edges are 2 long but c to d (3) and d to a (sqrt 5); x begins at -1
    plane = lay_out_roadmap(loop().scenario.roadmap)
    assert plane.points.tolist() == [[0.5, 0], [1.5, 0], [1.5, 1], [0, 1]]
    assert (plane.width, plane.height) == (2.5, 2)


def test_a_drawing_knows_its_unit_and_its_corner() -> None:
    cells = lay_out_roadmap(make_grid_roadmap(DOOR, cell_size=Fraction(1, 2)))
    assert (cells.unit, cells.corner) == (0.5, (0, 0))
    edge = Edge(tail="a", head="b", length=Fraction(9))  # drawn 2 across and 3 down
    drawn = lay_out_roadmap(make_roadmap({"a": (3, 1), "b": (5, 4)}, [edge]))
    assert drawn.unit == pytest.approx(13**0.5)
    assert drawn.corner == (3, 1)


def test_a_roadmap_without_an_edge_is_drawn_as_it_is() -> None:
    plane = lay_out_roadmap(make_roadmap({"a": (3, 1), "b": (5, 1)}, []))
    assert plane.points.tolist() == [[0, 0], [2, 0]]


def test_vertices_on_one_spot_do_not_divide_by_zero() -> None:
    roadmap = make_roadmap(
        {"a": (1, 1), "b": (1, 1)}, [Edge(tail="a", head="b", length=Fraction(1))]
    )
    assert lay_out_roadmap(roadmap).points.tolist() == [[0, 0], [0, 0]]


def one_each(*_: int) -> float:
    """Return the length of every edge."""
    return 1.0


def test_one_route_is_a_line_from_its_home() -> None:
    assert list(order_in_line([[4, 2, 9, 2, 4]], one_each)) == [4, 2, 9]


def test_two_routes_through_a_door_meet_in_the_middle() -> None:
    # R1: 0 1 3 5 4, R2: 2 1 3 5 6; 2 lies one before 1 as 0 does, 6 one after 5 as 4 does
    assert list(order_in_line([[0, 1, 3, 5, 4], [2, 1, 3, 5, 6]], one_each)) == [
        0,
        2,
        1,
        3,
        5,
        4,
        6,
    ]


def test_a_route_the_other_way_keeps_the_line() -> None:
    # the second robot comes from 7, beyond 3, and leaves at 0 for 8
    assert list(order_in_line([[0, 1, 2, 3], [7, 3, 2, 1, 0, 8]], one_each)) == [
        8,
        0,
        1,
        2,
        3,
        7,
    ]


def test_a_detour_lies_between_its_ends() -> None:
    # 5 and 6 lie evenly between 1 (place 1) and 3 (place 3): at 5/3 and 7/3, round 2
    assert list(order_in_line([[0, 1, 2, 3], [0, 1, 5, 6, 3]], one_each)) == [0, 1, 5, 2, 6, 3]


def test_routes_that_share_nothing_lie_side_by_side() -> None:
    assert list(order_in_line([[0, 1], [2, 3]], one_each)) == [0, 2, 1, 3]


def test_too_many_robots_or_vertices_have_no_line() -> None:
    assert list(order_in_line([[0]] * (MAX_ROBOTS + 1), one_each)) == []
    assert list(order_in_line([list(range(MAX_VERTICES + 1))], one_each)) == []


def test_places_in_line_are_as_far_apart_as_their_edges_are_long() -> None:
    # the route a b c d of the loop: edges of 2, 2 and 3; the way from d to a is not on the line
    plan = loop()
    places = order_in_line(
        [plan.tracks[0].vertices.tolist()], make_edge_length(plan.scenario.roadmap)
    )
    assert places == {0: 0, 1: 2, 2: 4, 3: 7}
