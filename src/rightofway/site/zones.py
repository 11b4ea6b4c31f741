"""Zones: vertices and edges that hold one robot at a time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from rightofway.errors import InputError, InputFault, find_nearest, quote
from rightofway.site.geometry import VertexId


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
