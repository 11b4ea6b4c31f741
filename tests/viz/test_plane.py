"""Where vertices are drawn."""

from fractions import Fraction

from rightofway.model import Edge, roadmap_of_edges, roadmap_of_grid
from rightofway.viz.plane import plane_of
from tests.builders.plans import DOOR, loop


def test_a_cell_is_a_unit_whatever_its_size() -> None:
    plane = plane_of(roadmap_of_grid(DOOR, cell_size=Fraction(1, 2)))
    # column and row of N0, N1, N2, N4, N6, N7, N8
    assert plane.points.tolist() == [[0, 0], [1, 0], [2, 0], [1, 1], [0, 2], [1, 2], [2, 2]]
    assert (plane.width, plane.height) == (3, 3)


def test_a_short_edge_is_a_unit_of_a_roadmap() -> None:
    # all edges are 2 long but c to d (3) and d to a (sqrt 5); x begins at -1
    plane = plane_of(loop().scenario.roadmap)
    assert plane.points.tolist() == [[0.5, 0], [1.5, 0], [1.5, 1], [0, 1]]
    assert (plane.width, plane.height) == (2.5, 2)


def test_a_roadmap_without_an_edge_is_drawn_as_it_is() -> None:
    plane = plane_of(roadmap_of_edges({"a": (3, 1), "b": (5, 1)}, []))
    assert plane.points.tolist() == [[0, 0], [2, 0]]


def test_vertices_on_one_spot_do_not_divide_by_zero() -> None:
    roadmap = roadmap_of_edges(
        {"a": (1, 1), "b": (1, 1)}, [Edge(tail="a", head="b", length=Fraction(1))]
    )
    assert plane_of(roadmap).points.tolist() == [[0, 0], [0, 0]]
