"""The native distance tables are the distances that a plain search finds."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from rightofway._core import DistanceTables
from tests.builders.laws import law
from tests.oracles.distances import Edge, distances_to


@st.composite
def graphs(draw: st.DrawFn) -> tuple[int, list[Edge]]:
    """Small directed graphs, with loops and parallel edges; often all edges take equally long."""
    n_vertices = draw(st.integers(1, 7))
    vertex = st.integers(0, n_vertices - 1)
    ticks = st.integers(1, draw(st.sampled_from([1, 9])))
    factor = draw(st.integers(1, 3))
    edges = draw(st.lists(st.builds(Edge, vertex, vertex, ticks), max_size=16))
    return n_vertices, sorted(Edge(u, v, factor * t) for u, v, t in edges)


def tables(n_vertices: int, edges: list[Edge]) -> DistanceTables:
    starts = [edge.start for edge in edges]
    indptr = np.searchsorted(starts, np.arange(n_vertices + 1)).astype(np.int32)
    return DistanceTables(indptr, np.array([edge.end for edge in edges], np.int32))


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
