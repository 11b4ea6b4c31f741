"""How the vertices of a roadmap hang together."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import networkx as nx  # type: ignore[import-untyped]
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rightofway.metrics.connectivity import (
    Ways,
    find_corridors,
    find_immediate_dominators,
    find_separations,
    find_strong_parts,
    list_ways,
    measure_distances_from,
    measure_route_load,
)
from rightofway.site import Edge, make_grid_roadmap, make_roadmap

DIGRAPHS = st.integers(1, 9).flatmap(
    lambda count: st.tuples(
        st.just(count),
        st.sets(
            st.tuples(st.integers(0, count - 1), st.integers(0, count - 1)).filter(
                lambda ends: ends[0] != ends[1]
            )
        ),
    )
)


def ways(lines: list[str]) -> Ways:
    return list_ways(make_grid_roadmap(lines))


def drawn(count: int, ends: set[tuple[int, int]]) -> Ways:
    edges = [Edge(tail=str(a), head=str(b), length=Fraction(1)) for a, b in sorted(ends)]
    return list_ways(make_roadmap({str(k): (float(k), 0.0) for k in range(count)}, edges))


def graph(count: int, ends: set[tuple[int, int]]) -> Any:
    made: Any = nx.DiGraph()
    made.add_nodes_from(range(count))
    made.add_edges_from(ends)
    return made


@given(DIGRAPHS)
def test_strong_parts_are_those_of_another_library(given: tuple[int, set[tuple[int, int]]]) -> None:
    expected = {frozenset(part) for part in nx.strongly_connected_components(graph(*given))}
    found = find_strong_parts(drawn(*given))
    assert {frozenset(part) for part in found} == expected
    assert [len(part) for part in found] == sorted(map(len, found), reverse=True)


@given(DIGRAPHS)
def test_dominators_are_those_of_another_library(given: tuple[int, set[tuple[int, int]]]) -> None:
    made = drawn(*given)
    expected = dict(nx.immediate_dominators(graph(*given), 0))
    expected.pop(0, None)
    assert find_immediate_dominators(made.along, made.against, 0) == expected


@given(DIGRAPHS)
def test_a_vertex_separates_places_if_and_only_if_closing_it_does(
    given: tuple[int, set[tuple[int, int]]],
) -> None:
    places = find_strong_parts(drawn(*given))[0][:4]
    found = find_separations(drawn(*given), places)
    for vertex in range(given[0]):
        left = graph(*given)
        left.remove_node(vertex)
        others = [place for place in places if place != vertex]
        reach = all(nx.has_path(left, a, b) for a in others for b in others)
        assert bool(found.get(vertex, set()) - {vertex}) == (not reach)


def test_a_corridor_is_a_chain_between_two_halls_with_its_length() -> None:
    """Row 0 holds vertices 0 to 3, row 1 vertices 4 to 10; 6, 7 and 8 join two halls of 2 x 2."""
    (found,) = find_corridors(ways(["..@@@..", "......."]))
    assert (found.inside, found.ends, found.steps) == ((6, 7, 8), (5, 9), 4)


def test_a_corridor_into_a_dead_end_ends_there() -> None:
    (found,) = find_corridors(ways(["...."]))
    assert (found.inside, found.ends) == ((1, 2), (0, 3))


def test_rings_and_one_way_lanes_are_no_corridors() -> None:
    assert find_corridors(ways(["...", ".@.", "..."])) == []
    assert find_corridors(ways(["@...", "..@.", "@..."])) == []
    assert find_corridors(drawn(4, {(0, 1), (1, 2), (2, 3)})) == []


def test_distances_are_whole_multiples_of_one_length() -> None:
    edges = [Edge(tail="A", head="B", length=Fraction(1, 2)), Edge(tail="B", head="C", length=1)]  # type: ignore[arg-type]
    made = list_ways(make_roadmap({"A": (0, 0), "B": (0.5, 0), "C": (1.5, 0)}, edges))
    assert measure_distances_from(made, 0) == ([0, 1, 2], {0: 0, 1: 1, 2: 3})


@given(DIGRAPHS)
def test_levels_give_the_order_and_the_load_that_a_queue_gives(
    given: tuple[int, set[tuple[int, int]]],
) -> None:
    made = drawn(*given)
    queued = replace(made, even=0)
    assert measure_distances_from(made, 0) == measure_distances_from(queued, 0)
    trips = {0: {goal: 1.0 for goal in measure_distances_from(made, 0)[1] if goal}}
    assert measure_route_load(made, trips) == measure_route_load(queued, trips)


def test_equally_short_routes_share_the_load() -> None:
    """From corner to corner of 2 x 2 cells, half of the route passes each of the others."""
    load = measure_route_load(ways(["..", ".."]), {0: {3: 1.0}})
    assert {vertex: passing for vertex, passing in load.items() if passing} == pytest.approx(
        {1: 0.5, 2: 0.5}
    )


@given(DIGRAPHS)
def test_load_counts_the_inner_vertices_of_routes(given: tuple[int, set[tuple[int, int]]]) -> None:
    made = drawn(*given)
    _, distance = measure_distances_from(made, 0)
    load = measure_route_load(made, {0: {goal: 1.0 for goal in distance if goal}})
    assert sum(load.values()) == pytest.approx(sum(gone - 1 for gone in distance.values() if gone))
