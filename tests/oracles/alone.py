"""The least completion of each robot without the others, by searches in Python.

Where all edges are equally long and few lead into each vertex, a breadth-first search counts the
edges between the places of 256 legs at once: each vertex keeps one bit for each leg, set as soon as
the vertex is within reach of the first place of that leg, and takes over its neighbours' bits in
every step. On other roadmaps Dijkstra's algorithm runs once for each pace and place; for a robot
that turns in some time A* runs over edges instead of vertices, from each place of the trip with the
least ticks of every edge into that place.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from heapq import heapify, heappop, heappush
from itertools import chain, count, groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.model import NEVER, Itinerary, Scenario, Tick, compute_least_dwell
from rightofway.model.turning import Turning
from rightofway.site import Roadmap, VertexId

Leg = tuple[VertexId, VertexId]
"""Two places of a trip that follow each other."""

Pace = tuple[Tick, ...]
"""Ticks of each length class of edges; robots of one speed have one pace."""

Indices = NDArray[np.int64]

WORD = 64
"""Bits in a word."""

BLOCK = 4 * WORD
"""Legs in a search; four words a vertex stay in the processor's cache on most maps."""

MOST_EDGES_IN = 8
"""A roadmap with more edges into one vertex is searched with Dijkstra's algorithm."""


def alone_completions(scenario: Scenario) -> tuple[Tick, ...]:
    """Return each robot's least completion time without the others; -1 where it has no way."""
    itineraries = scenario.problem.itineraries
    wanted: defaultdict[Pace, set[Leg]] = defaultdict(set)
    for itinerary in itineraries:
        wanted[itinerary.edge_ticks].update(_legs(itinerary))
    roadmap = scenario.roadmap
    is_lattice = (
        len(roadmap.lengths) <= 1
        and np.bincount(roadmap.heads).max(initial=0) <= MOST_EDGES_IN
        and not scenario.problem.is_barred
    )
    ways = (_by_edges if is_lattice else _by_ticks)(roadmap, wanted)
    turns: dict[tuple[Pace, Turning], _Turns] = {}

    def moving(itinerary: Itinerary) -> int:
        pace, turning = itinerary.edge_ticks, itinerary.turning
        if turning is None:
            return sum(ways[pace][leg] for leg in _legs(itinerary))
        if (pace, turning) not in turns:
            turns[pace, turning] = _Turns(roadmap, pace, turning)
        return _drives_and_turns(itinerary, turns[pace, turning])

    return tuple(
        Tick(moving(one) + least_dwell_of_trip(one))
        if all(leg in ways[one.edge_ticks] for leg in _legs(one))
        else Tick(-1)
        for one in itineraries
    )


def _legs(itinerary: Itinerary) -> Iterable[Leg]:
    places = chain([itinerary.home], (stage.vertex for stage in itinerary.stages))
    return pairwise(place for place, _ in groupby(places))


def least_dwell_of_trip(itinerary: Itinerary) -> int:
    """Return how long all visits of a trip last at least, without drives and turns to them [ticks].

    Parameters
    ----------
    itinerary
        The trip; stages that follow each other at one vertex share a visit.
    """
    visits = [list(stages) for _, stages in groupby(itinerary.stages, lambda stage: stage.vertex)]
    moving = sum(compute_least_dwell(stages, leaves=True) for stages in visits[:-1])
    return moving + compute_least_dwell(visits[-1], leaves=False)


def _by_ticks(roadmap: Roadmap, wanted: Mapping[Pace, set[Leg]]) -> dict[Pace, dict[Leg, int]]:
    """Return the ticks of the least costly way of each leg; one without a way is missing."""
    ways: dict[Pace, dict[Leg, int]] = {}
    for pace, legs in wanted.items():
        targets: defaultdict[VertexId, list[VertexId]] = defaultdict(list)
        for source, target in legs:
            targets[source].append(target)
        ways[pace] = {
            (source, target): ticks
            for source in targets
            for target, ticks in _dijkstra(roadmap, pace, source, targets[source]).items()
        }
    return ways


def _dijkstra(
    roadmap: Roadmap, pace: Pace, source: VertexId, targets: Collection[VertexId]
) -> dict[VertexId, Tick]:
    settled: dict[VertexId, Tick] = {}
    missing = set(targets)
    heap = [(Tick(0), source)]
    while heap and missing:
        ticks, vertex = heappop(heap)
        if vertex in settled:
            continue
        settled[vertex] = ticks
        missing.discard(vertex)
        edges = slice(roadmap.indptr[vertex], roadmap.indptr[vertex + 1])
        for head, length in zip(
            roadmap.heads[edges].tolist(), roadmap.class_of_edge[edges].tolist(), strict=True
        ):
            if head not in settled and pace[length] > 0:
                heappush(heap, (Tick(ticks + pace[length]), head))
    return {target: settled[target] for target in targets if target in settled}


class _Turns:
    """Edges that follow each other, with turn and drive [ticks]; as lists, for speed."""

    def __init__(self, roadmap: Roadmap, pace: Pace, turning: Turning) -> None:
        self.heads: list[int] = roadmap.heads.tolist()
        self.longest = int(turning.ticks.max(initial=0))
        self._first: list[int] = roadmap.indptr.tolist()
        self._drive = [pace[each] for each in roadmap.class_of_edge.tolist()]
        self._offset: list[int] = turning.angles.offset.tolist()
        self._turn: list[int] = turning.ticks[turning.angles.kind].tolist()
        self._cells = None
        if roadmap.grid is not None:
            self._cells = [roadmap.grid.get_cell(vertex) for vertex in range(roadmap.n_vertices)]
            self._quickest = min((ticks for ticks in pace if ticks > 0), default=0)

    def first(self, vertex: int) -> Iterator[tuple[int, int]]:
        """Yield each edge out of a vertex and the ticks of its drive."""
        for edge in range(self._first[vertex], self._first[vertex + 1]):
            if self._drive[edge] > 0:  # it is not barred
                yield edge, self._drive[edge]

    def after(self, edge: int) -> Iterator[tuple[int, int]]:
        """Yield each edge that follows an edge, and the ticks of the turn and the drive."""
        for following, drive in self.first(self.heads[edge]):
            yield following, self._turn[self._offset[edge] + following] + drive

    def least(self, edge: int, target: int) -> int:
        """Return a lower bound of the ticks from the end of an edge to a vertex."""
        if self._cells is None:
            return 0
        (row, column), (to_row, to_column) = self._cells[self.heads[edge]], self._cells[target]
        return self._quickest * (abs(row - to_row) + abs(column - to_column))


def _drives_and_turns(itinerary: Itinerary, turns: _Turns) -> int:
    """Return the least ticks of all drives of a trip and the turns between them.

    A* from leg to leg. It ends when each heading at the end of the leg is reached, or when any
    other heading would take longer than to turn there.
    """
    reached: dict[int, int] | None = None  # least ticks by the edge driven in; None: at home
    for place, target in _legs(itinerary):
        if reached is None:
            begin = list(turns.first(place))
        else:
            begin = [
                (after, ticks + more)
                for edge, ticks in reached.items()
                for after, more in turns.after(edge)
            ]
        heap = [(ticks + turns.least(edge, target), ticks, edge) for edge, ticks in begin]
        heapify(heap)
        settled: set[int] = set()
        reached, limit = {}, NEVER
        while heap and heap[0][0] <= limit:
            _, ticks, edge = heappop(heap)
            if edge in settled:
                continue
            settled.add(edge)
            if turns.heads[edge] == target:
                reached[edge] = ticks
                limit = min(limit, Tick(ticks + turns.longest))
                continue
            for after, more in turns.after(edge):
                if after not in settled:
                    ahead = ticks + more
                    heappush(heap, (ahead + turns.least(after, target), ahead, after))
    return min(reached.values()) if reached else 0


def _by_edges(roadmap: Roadmap, wanted: Mapping[Pace, set[Leg]]) -> dict[Pace, dict[Leg, int]]:
    """Return the same where all edges are equally long."""
    order = np.argsort(roadmap.heads, kind="stable")
    heads = roadmap.heads[order]
    number = np.arange(len(heads)) - np.searchsorted(heads, heads)
    # Row k has the tail of the k-th edge into each vertex, or the vertex itself if it has fewer.
    tails = np.tile(np.arange(roadmap.n_vertices), (number.max(initial=-1) + 1, 1))
    tails[number, heads] = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))[order]
    legs = sorted(set().union(*wanted.values()))
    sources, targets = np.array(legs, np.int64).reshape(-1, 2).T
    gaps = np.abs(roadmap.positions[sources] - roadmap.positions[targets]).sum(axis=1)
    alike = np.argsort(gaps, kind="stable")  # searches for legs of one length end at one step
    found = np.full(len(legs), -1)
    for block in (alike[begin : begin + BLOCK] for begin in range(0, len(legs), BLOCK)):
        found[block] = _count_edges(tails, sources[block], targets[block])
    edges_of = dict(zip(legs, found.tolist(), strict=True))
    return {
        pace: {leg: edges_of[leg] * pace[0] for leg in own if edges_of[leg] >= 0}
        for pace, own in wanted.items()
    }


def _count_edges(tails: Indices, sources: Indices, targets: Indices) -> Indices:
    """Search for all targets of a block, step by step; -1 where no way leads."""
    found = np.full(len(sources), -1)
    pending = np.arange(len(sources))
    word, bit = pending // WORD, np.uint64(1) << (pending % WORD).astype(np.uint64)
    reach = np.zeros((tails.shape[1], -(-len(sources) // WORD)), np.uint64)
    np.bitwise_or.at(reach, (sources, word), bit)
    before, taken = np.zeros_like(reach), np.empty_like(reach)
    for step in count():
        arrived = (reach[targets[pending], word[pending]] & bit[pending]) != 0
        found[pending[arrived]] = step
        pending = pending[~arrived]
        if not len(pending) or np.array_equal(reach, before):
            break
        before = reach.copy()
        for own_tails in tails:
            # Ten times as fast as an index in brackets; "clip" only saves a copy.
            reach |= np.take(before, own_tails, axis=0, out=taken, mode="clip")
    return found
