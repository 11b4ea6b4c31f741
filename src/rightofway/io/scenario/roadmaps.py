"""A roadmap that is drawn vertex by vertex and edge by edge in a document."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

from rightofway.io.faults import Faults
from rightofway.io.words import nearest
from rightofway.model import Edge, Roadmap, roadmap_of_edges, straight_length

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import EdgeDocument, RoadmapDocument

__all__ = ["drawn_roadmap"]

Positions = Mapping[str, tuple[Fraction, Fraction]]


def drawn_roadmap(document: RoadmapDocument) -> Roadmap:
    """Make the roadmap of a roadmap document.

    Raises
    ------
    InputError
        For every edge from or to nowhere, to itself, given twice, or without a length where none
        follows from the positions; with places relative to the document.
    """
    faults, edges, first = Faults(), list[Edge](), dict[tuple[str, str], int]()
    for index, written in enumerate(document.edges):
        directed = faults.attempt(f"edges[{index}]", _directed, written, document.vertices) or ()
        for edge in directed:
            if first.setdefault((edge.tail, edge.head), index) != index:
                ends = (
                    f"{edge.tail!r} to {edge.head!r} as edges[{first[edge.tail, edge.head]}] does"
                )
                faults.note(f"edges[{index}]", f"leads from {ends} (take one out)")
                break
        edges += directed
    faults.stop()
    positions = {name: (float(x), float(y)) for name, (x, y) in document.vertices.items()}
    return roadmap_of_edges(positions, edges)


def _directed(edge: EdgeDocument, positions: Positions) -> tuple[Edge, ...]:
    _check_ends(edge, positions)
    length = edge.length or straight_length(positions[edge.tail], positions[edge.head])
    there = Edge(tail=edge.tail, head=edge.head, length=length)
    return (
        (there, Edge(tail=edge.head, head=edge.tail, length=length)) if edge.both_ways else (there,)
    )


def _check_ends(edge: EdgeDocument, positions: Positions) -> None:
    faults = Faults()
    for place, name in (("from", edge.tail), ("to", edge.head)):
        if name not in positions:
            near = nearest(name, positions)
            hint = f"did you mean {near!r}?" if near else "add it to vertices"
            faults.note(place, f"no vertex is named {name!r} ({hint})")
    if edge.tail == edge.head:
        faults.note("", f"leads from {edge.tail!r} to itself (take it out)")
    faults.stop()
