"""The native distance tables and single paths are those that a plain search finds."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from rightofway._core import DistanceTables, ShortestPaths
from tests.builders.laws import law
from tests.oracles.distances import Edge, distances_to, first_shortest_path


@st.composite
def graphs(draw: st.DrawFn) -> tuple[int, list[Edge]]:
    """Small directed graphs, with loops and parallel edges; often all edges take equally long."""
    n_vertices = draw(st.integers(1, 7))
    vertex = st.integers(0, n_vertices - 1)
    ticks = st.integers(1, draw(st.sampled_from([1, 9])))
    factor = draw(st.integers(1, 3))
    edges = draw(st.lists(st.builds(Edge, vertex, vertex, ticks), max_size=16))
    return n_vertices, sorted(Edge(u, v, factor * t) for u, v, t in edges)


@st.composite
def floors(draw: st.DrawFn) -> tuple[int, list[Edge]]:
    """Grids with walls, in the order east, south, west, north; sometimes some edges are slow."""
    width, height = draw(st.integers(2, 8)), draw(st.integers(1, 8))
    is_wall = draw(st.lists(st.sampled_from([0, 0, 0, 1]), min_size=width * height,
                            max_size=width * height))  # fmt: skip
    slow = draw(st.sets(st.integers(0, width * height - 1), max_size=5))
    edges = []
    for cell in range(width * height):
        row, column = divmod(cell, width)
        for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            head = cell + dy * width + dx
            is_inside = 0 <= row + dy < height and 0 <= column + dx < width
            if is_inside and not is_wall[cell] and not is_wall[head]:
                edges.append(Edge(cell, head, 2 if cell in slow else 1))
    return width * height, edges


def arrays(n_vertices: int, edges: list[Edge]) -> tuple[np.ndarray, np.ndarray]:
    starts = [edge.start for edge in edges]
    indptr = np.searchsorted(starts, np.arange(n_vertices + 1)).astype(np.int32)
    return indptr, np.array([edge.end for edge in edges], np.int32)


def tables(n_vertices: int, edges: list[Edge]) -> DistanceTables:
    return DistanceTables(*arrays(n_vertices, edges))


@law(graphs())
def test_every_table_is_what_a_plain_search_finds(graph: tuple[int, list[Edge]]) -> None:
    n_vertices, edges = graph
    ticks = np.array([edge.ticks for edge in edges], np.int32)
    kernel = tables(n_vertices, edges)

    for target in range(n_vertices):
        assert kernel.to(target, ticks).tolist() == distances_to(target, n_vertices, edges)


@law(graphs(), st.integers(2, 5))
def test_slower_robots_have_the_same_tables_in_longer_ticks(
    graph: tuple[int, list[Edge]], factor: int
) -> None:
    n_vertices, edges = graph
    ticks = np.array([edge.ticks for edge in edges], np.int32)
    kernel = tables(n_vertices, edges)

    fast = kernel.to(0, ticks)
    slow = kernel.to(0, ticks * np.int32(factor))

    assert slow.tolist() == np.where(fast < 0, fast, fast * factor).tolist()


@law(st.one_of(graphs(), floors()), st.lists(st.tuples(st.integers(0), st.integers(0)),
                                             min_size=10, max_size=20))  # fmt: skip
def test_single_paths_are_those_that_a_walk_down_a_table_takes(
    graph: tuple[int, list[Edge]], trips: list[tuple[int, int]]
) -> None:
    n_vertices, edges = graph
    ticks = np.array([edge.ticks for edge in edges], np.int32)
    paths = ShortestPaths(*arrays(n_vertices, edges), ticks)
    for trip in trips:  # the first ones go down tables themselves
        start, target = (vertex % n_vertices for vertex in trip)
        path = first_shortest_path(start, target, n_vertices, edges)
        assert paths.find(start, target).tolist() == path
