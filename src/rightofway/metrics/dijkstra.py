"""Shortest ways of one robot over edges of any length."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from heapq import heappop, heappush

from rightofway.model import Roadmap, Tick, VertexId

__all__ = ["shortest_ticks"]


def shortest_ticks(
    roadmap: Roadmap, edge_ticks: Sequence[Tick], source: VertexId, targets: Collection[VertexId]
) -> dict[VertexId, Tick]:
    """Return the ticks of a shortest way to each target that a way leads to.

    Parameters
    ----------
    roadmap
        The graph.
    edge_ticks
        Ticks for an edge, by its length class.
    source
        Where all ways begin.
    targets
        Where they lead.
    """
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
            roadmap.heads[edges].tolist(), roadmap.length_class[edges].tolist(), strict=True
        ):
            if head not in settled:
                heappush(heap, (Tick(ticks + edge_ticks[length]), head))
    return {target: settled[target] for target in targets if target in settled}
