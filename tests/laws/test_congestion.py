"""The native routes among others are those that a plain search finds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import strategies as st

from rightofway import _core
from tests.builders.laws import law
from tests.oracles.congestion import Congestion
from tests.oracles.distances import Edge, distances_to


@st.composite
def floors(draw: st.DrawFn) -> Congestion:
    """Small graphs without loops or parallel edges; most edges go both ways."""
    n_vertices = draw(st.integers(2, 8))
    vertex = st.integers(0, n_vertices - 1)
    pairs = draw(st.sets(st.tuples(vertex, vertex), min_size=n_vertices, max_size=20))
    ticks = st.integers(1, draw(st.sampled_from([1, 4])))
    one_ways = draw(st.booleans())
    ends = {(u, v) for u, v in pairs if u != v}
    ends |= set() if one_ways else {(v, u) for u, v in ends}
    return Congestion(
        n_vertices=n_vertices,
        edges=[Edge(u, v, draw(ticks)) for u, v in sorted(ends)],
        shares=draw(st.sampled_from([1, 16])),
        station=draw(
            st.lists(st.sampled_from([0, 16, 40]), min_size=n_vertices, max_size=n_vertices)
        ),
    )


def kernel_of(floor: Congestion) -> _core.Congestion:
    """Return the kernel for one robot and a length class for each edge."""
    starts = [edge.start for edge in floor.edges]
    zero = np.zeros(1, np.int32)
    roads = _core.Roads(
        indptr=np.searchsorted(starts, np.arange(floor.n_vertices + 1)).astype(np.int32),
        heads=np.array([edge.end for edge in floor.edges], np.int32),
        length_class=np.arange(len(floor.edges), dtype=np.int32),
        n_classes=len(floor.edges),
    )
    robots = _core.Robots(
        paces=np.array([edge.ticks for edge in floor.edges], np.int32),
        pace_of=zero,
        home=zero,
        first_stage=np.array([0, 1], np.int32),
        stage_vertex=zero,
        stage_work=np.zeros(1, np.int64),
        stage_turn=np.zeros(1, np.int64),
    )
    problem = _core.Problem(roads, robots, _core.BookingRules(0, False))
    return _core.Congestion(problem, floor.shares, np.array(floor.station, np.int64))


@law(floors(), st.data())
def test_each_robots_path_is_the_cheapest_among_those_before(
    floor: Congestion, data: st.DataObject
) -> None:
    kernel = kernel_of(floor)
    for start in range(floor.n_vertices):
        for target in range(floor.n_vertices):
            to_go = distances_to(target, floor.n_vertices, floor.edges)
            if to_go[start] < 0:
                continue
            path = kernel.path(0, start, target, np.array(to_go, np.int32))
            assert path.tolist() == floor.path(start, target)
            oncoming = data.draw(st.sampled_from([0, 4, 100]))
            kernel.add(path, oncoming)
            floor.add(path.tolist(), oncoming)


def test_a_target_out_of_reach_and_a_path_with_a_gap_are_refused() -> None:
    floor = Congestion(n_vertices=3, edges=[Edge(0, 1, 1)], shares=16, station=[0, 0, 0])
    kernel = kernel_of(floor)
    with pytest.raises(ValueError, match="target: 2 cannot be reached from 0"):
        kernel.path(0, 0, 2, np.array([-1, -1, 0], np.int32))
    with pytest.raises(ValueError, match=r"path\[1\]: 2 is no neighbour of 0"):
        kernel.add(np.array([0, 2], np.int32), 4)
    with pytest.raises(ValueError, match=r"start: 3 is not in 0\.\.2"):
        kernel.path(0, 3, 1, np.array([1, 0, -1], np.int32))
