"""Zones: vertices and edges that hold one robot at a time."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from rightofway.errors import InputError, InputFault, find_nearest, quote
from rightofway.site.geometry import VertexId

if TYPE_CHECKING:
    from rightofway.site.roadmap import Roadmap

Ends = tuple[int, int]
"""The two ends of a lane."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Zone:
    """Vertices and edges that hold one robot at a time.

    Attributes
    ----------
    name
        Unique on its roadmap.
    vertices
        Vertices of the zone, in increasing order: those that are given, and those at which two of
        its edges meet.
    edges
        Tail and head of each of its edges.
    """

    name: str
    vertices: tuple[VertexId, ...] = ()
    edges: tuple[tuple[VertexId, VertexId], ...] = ()

    def __post_init__(self) -> None:
        n_edges = Counter(chain.from_iterable(self.edges))
        meeting = {vertex for vertex, count in n_edges.items() if count > 1}
        object.__setattr__(self, "vertices", tuple(sorted(meeting.union(self.vertices))))


class ZoneGuard:
    """The zones of a roadmap, to find lanes on which they keep robots apart.

    Where there are zones, a drive books its edge and the vertices at both ends.
    """

    def __init__(self, roadmap: Roadmap) -> None:
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
        self._edges = set(zip(tails, roadmap.heads.tolist(), strict=True))
        self._of_vertex = defaultdict[int, set[int]](set)
        self._of_edge = defaultdict[Ends, set[int]](set)
        for number, zone in enumerate(roadmap.zones):
            for vertex in zone.vertices:
                self._of_vertex[vertex].add(number)
            for ends in zone.edges:
                self._of_edge[ends].add(number)

    def are_apart(self, lanes: Iterable[Ends], others: Iterable[Ends]) -> bool:
        """Return whether no two robots drive at once along one of some lanes and one of others.

        A lane is its two ends, whichever ways it is driven.
        """
        booked = list(self._list_bookings(others))
        return all(zones & other for zones in self._list_bookings(lanes) for other in booked)

    def _list_bookings(self, lanes: Iterable[Ends]) -> Iterator[set[int]]:
        """Yield the zones that a drive along each edge of some lanes books."""
        for lane in lanes:
            at_ends = set[int]().union(*(self._of_vertex.get(end, ()) for end in lane))
            for ends in {lane, lane[::-1]} & self._edges:
                yield at_ends.union(self._of_edge.get(ends, ()))


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedZone:
    """A zone as a file names it; an edge is the names of its tail and its head."""

    name: str
    vertices: tuple[str, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()


def number_zones(
    named: Collection[NamedZone],
    ids: Mapping[str, int],
    edges: Collection[tuple[str, str]],
    pieces: Mapping[tuple[str, str], Sequence[tuple[str, str]]],
) -> tuple[Zone, ...]:
    """Return zones by vertex numbers.

    Raises
    ------
    InputError
        With every vertex and edge that the roadmap does not have, and every name given twice.
    """
    lanes = {*edges, *pieces}
    faults = []
    names: set[str] = set()
    for index, zone in enumerate(named):
        faults += [fault.nest(("zones", index)) for fault in _find_faults(zone, names, ids, lanes)]
        names.add(zone.name)
    if faults:
        raise InputError(faults)
    return tuple(
        Zone(
            name=zone.name,
            vertices=tuple(VertexId(ids[name]) for name in zone.vertices),
            edges=tuple(
                (VertexId(ids[tail]), VertexId(ids[head]))
                for tail, head in chain.from_iterable(pieces.get(e, (e,)) for e in zone.edges)
            ),
        )
        for zone in named
    )


def _find_faults(
    zone: NamedZone,
    names: Collection[str],
    ids: Mapping[str, int],
    lanes: Collection[tuple[str, str]],
) -> Iterator[InputFault]:
    if zone.name in names:
        yield InputFault("name", f"{quote(zone.name)} is the name of another zone (give its own)")
    if not zone.vertices and not zone.edges:
        yield InputFault("", "has neither vertices nor edges (give some, or take it out)")
    for index, name in enumerate(zone.vertices):
        if name not in ids:
            near = find_nearest(name, ids)
            hint = f"did you mean {near!r}?" if near else f"name one of the {len(ids)} vertices"
            yield InputFault(("vertices", index), f"no vertex is named {quote(name)} ({hint})")
    for index, (tail, head) in enumerate(zone.edges):
        if (tail, head) not in lanes:
            message = f"no edge leads from {quote(tail)} to {quote(head)} (name an edge)"
            yield InputFault(("edges", index), message)
