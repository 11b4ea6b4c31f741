"""Grids and roadmaps: what is a vertex, what is an edge, what it is called."""

from fractions import Fraction

import pytest

from rightofway.errors import InputError
from rightofway.site import Edge, make_grid_roadmap, make_roadmap

DOOR = ["...", "@.@", "..."]


def test_grid_vertices_are_named_by_row_major_numbers_over_all_cells() -> None:
    roadmap = make_grid_roadmap(DOOR)
    assert [roadmap.name(vertex) for vertex in range(roadmap.n_vertices)] == [
        "N0", "N1", "N2", "N4", "N6", "N7", "N8",
    ]  # fmt: skip
    assert roadmap.get_vertex("N4") == 3


@pytest.mark.parametrize("name", ["N3", "N9", "N-1", "N", "4", "n4", "N٤", ""])
def test_a_wall_or_no_cell_has_no_vertex(name: str) -> None:
    with pytest.raises(KeyError):
        make_grid_roadmap(DOOR).get_vertex(name)


def test_edges_leave_a_cell_east_south_west_north() -> None:
    roadmap = make_grid_roadmap(["...", "...", "..."])
    middle = roadmap.get_vertex("N4")
    heads = roadmap.heads[roadmap.indptr[middle] : roadmap.indptr[middle + 1]]
    assert [roadmap.name(head) for head in heads] == ["N5", "N7", "N3", "N1"]


def test_a_grid_gives_back_its_lines_with_walls_as_at_signs() -> None:
    roadmap = make_grid_roadmap([".TG", "S.O"])
    assert roadmap.grid is not None
    assert roadmap.grid.as_lines() == (".@.", "..@")


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([], "the grid is empty"),
        ([""], "the grid is empty"),
        (["..", "..."], r"\[1\]: 3 cells, but row 0 has 2"),
        (["@@"], "no free cell"),
    ],
)
def test_a_grid_that_is_none_is_refused(lines: list[str], message: str) -> None:
    with pytest.raises(InputError, match=message):
        make_grid_roadmap(lines)


def test_named_roadmaps_keep_edge_order_and_lengths() -> None:
    positions = {"A": (0.0, 0.0), "B": (2.0, 0.0), "C": (0.0, 1.0)}
    edges = [
        Edge(tail="A", head="C", length=Fraction(1)),
        Edge(tail="A", head="B", length=Fraction(2)),
        Edge(tail="B", head="A", length=Fraction(2)),
    ]
    roadmap = make_roadmap(positions, edges)
    assert roadmap.lengths == (Fraction(1), Fraction(2))
    assert roadmap.heads.tolist() == [2, 1, 0]
    assert roadmap.find_edge(roadmap.get_vertex("A"), roadmap.get_vertex("B")) == 1
    assert roadmap.find_edge(roadmap.get_vertex("C"), roadmap.get_vertex("A")) is None


@pytest.mark.parametrize(
    ("edge", "message"),
    [
        (Edge(tail="A", head="X", length=Fraction(1)), "no vertex is named 'X'"),
        (Edge(tail="A", head="A", length=Fraction(1)), "from 'A' to itself"),
        (Edge(tail="A", head="B", length=Fraction(0)), "length 0 is not positive"),
    ],
)
def test_an_edge_that_is_none_is_refused(edge: Edge, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make_roadmap({"A": (0.0, 0.0), "B": (1.0, 0.0)}, [edge])


def test_closed_vertices_stay_without_their_edges() -> None:
    """The middle of three in a row: nobody gets past it, and names stay."""
    roadmap = make_grid_roadmap(["..."]).exclude({1})
    assert (roadmap.n_vertices, roadmap.n_edges) == (3, 0)
    assert roadmap.name(2) == "N2"
    assert make_grid_roadmap(["...."]).exclude({0}).heads.tolist() == [2, 3, 1, 2]
