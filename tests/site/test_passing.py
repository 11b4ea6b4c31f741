"""Chains: ways through vertices that robots only drive through."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

import pytest

from rightofway.errors import InputError
from rightofway.site import Edge, Roadmap, VertexId, chains, make_roadmap


def build_roadmap(lanes: Sequence[str], passed: str, *, one_way: bool = False) -> Roadmap:
    """Return vertices named by letters; a lane is two of them and its length."""
    names = sorted({name for lane in lanes for name in lane[:2]})
    edges = [
        Edge(tail=tail, head=head, length=Fraction(length))
        for lane in lanes
        for tail, head, length in ((lane[0], lane[1], lane[2]), (lane[1], lane[0], lane[2]))
        if not one_way or tail == lane[0]
    ]
    positions = {name: (float(k), 0.0) for k, name in enumerate(names)}
    return make_roadmap(positions, edges, passed=list(passed))


def list_ways(roadmap: Roadmap) -> list[str]:
    """Return the names along each chain."""
    assert roadmap.passing is not None
    return sorted("".join(map(roadmap.name, chain)) for chain in roadmap.passing.chains)


@pytest.mark.parametrize(
    ("lanes", "passed", "ways"),
    [
        (["ap1", "pb1"], "p", ["apb", "bpa"]),
        # From each of three arms to both others; not back to where a robot came from.
        (["ap1", "bp1", "cp1"], "p", ["apb", "apc", "bpa", "bpc", "cpa", "cpb"]),
        # Two ways round; none comes to a vertex twice.
        (["ap1", "aq1", "pb1", "qb1", "pq1"], "pq", [
            "apb", "apqb", "aqb", "aqpb", "bpa", "bpqa", "bqa", "bqpa",
        ]),
        # A way that ends at a passed vertex leads nowhere.
        (["ab1", "bp1"], "p", []),
    ],
)  # fmt: skip
def test_each_way_through_passed_vertices_is_a_chain(
    lanes: list[str], passed: str, ways: list[str]
) -> None:
    assert list_ways(build_roadmap(lanes, passed)) == sorted(ways)


def test_a_chain_has_vertices_of_its_own_with_names_positions_and_lengths_as_drawn() -> None:
    roadmap = build_roadmap(["ap2", "pq3", "qb5"], "pq", one_way=True)
    assert roadmap.passing is not None
    (chain,) = roadmap.passing.chains
    assert chain == (0, 4, 5, 1)  # a, b, p, q are 0 to 3
    assert [roadmap.name(vertex) for vertex in chain] == ["a", "p", "q", "b"]
    assert roadmap.positions[4].tolist() == roadmap.positions[2].tolist()
    edges = [roadmap.find_edge(*ends) for ends in pairwise(chain)]
    assert [int(roadmap.get_edge_class(edge or 0).length) for edge in edges] == [2, 3, 5]
    assert roadmap.get_vertex("p") == 2
    assert [roadmap.is_passed(vertex) for vertex in range(6)] == [False, False, True, True] + [
        True
    ] * 2


def test_a_route_is_unfolded_and_drawn_again() -> None:
    roadmap = build_roadmap(["ap1", "pb1", "bq1", "qc1"], "pq")
    drawn = list(map(int, map(roadmap.get_vertex, "apbqcqb")))
    route = roadmap.unfold_route(drawn)
    assert all(roadmap.find_edge(*ends) is not None for ends in pairwise(route))
    assert [roadmap.get_drawn(vertex) for vertex in route] == drawn
    back = list(map(int, map(roadmap.get_vertex, "apa")))  # on no chain
    assert roadmap.unfold_route(back) == back


def test_a_folded_roadmap_is_the_one_that_was_drawn() -> None:
    lanes = ["ap1", "pb1", "bc2", "cq1"]
    plain = build_roadmap(lanes, "")
    for passed in ("p", "q", "pq"):
        folded = build_roadmap(lanes, passed).fold()
        assert folded.n_vertices == plain.n_vertices
        for column in ("indptr", "heads", "class_of_edge", "positions"):
            assert getattr(folded, column).tolist() == getattr(plain, column).tolist()
        assert folded.labels == plain.labels
        assert folded.fold() is folded
    assert plain.passing is None


def test_roadmaps_with_other_passed_vertices_differ() -> None:
    lanes = ["ap1", "pb1", "cq1"]
    roadmaps = [build_roadmap(lanes, passed) for passed in ("", "p", "q", "pq")]
    for first, one in enumerate(roadmaps):
        for other, another in enumerate(roadmaps):
            assert (one == another) == (first == other)


def test_an_edge_at_a_passed_vertex_is_one_of_each_chain_on_it() -> None:
    roadmap = build_roadmap(["ap1", "bp1", "cp1"], "p")
    a, b, p = map(roadmap.get_vertex, "abp")
    assert len(roadmap.list_edges(a, p)) == 2  # to b and to c
    assert roadmap.list_edges(a, b) == []
    assert roadmap.find_edge(a, p) is None
    assert roadmap.is_drawn(a, p)
    assert not roadmap.is_drawn(a, b)
    assert [list(ends) for ends in roadmap.find_ways_along((a, p))] == [[a, p]]


def test_where_a_robot_may_stop_next() -> None:
    roadmap = build_roadmap(["ab1", "ap1", "pc1", "pd1"], "p")
    stops = chains.list_next_stops(roadmap, roadmap.get_vertex("a"))
    assert "".join(map(roadmap.name, stops)) == "bcd"


def test_too_many_ways_are_refused_before_they_are_made() -> None:
    names = [f"p{k}" for k in range(12)]  # each joined to each other: about 12! ways
    edges = [
        Edge(tail=tail, head=head, length=Fraction(1))
        for tail in (*names, "a", "b")
        for head in (*names, "a", "b")
        if tail != head
    ]
    positions = {name: (0.0, float(k)) for k, name in enumerate((*names, "a", "b"))}
    with pytest.raises(InputError, match="more than 100000 vertices are on the ways through 'p"):
        make_roadmap(positions, edges, passed=names)


def test_a_vertex_of_a_chain_is_no_place_for_a_closure() -> None:
    from rightofway.model import Closure, Robot, Scenario, Stop

    roadmap = build_roadmap(["ap1", "pb1"], "p")
    robot = Robot(name="R1", home=VertexId(0), stops=(Stop(at=VertexId(1)),))
    with pytest.raises(InputError, match=r"vertex 3 is not on the roadmap \(give 0 to 2\)"):
        Scenario(roadmap=roadmap, robots=(robot,), closures=(Closure(at=VertexId(3)),))
