"""Zones: vertices and edges that hold one robot at a time."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

from rightofway.errors import InputError, InputFault, nearest, shown
from rightofway.model.units import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Zone:
    """Vertices and edges that hold one robot at a time.

    Attributes
    ----------
    name
        Unique on its roadmap.
    vertices
        Vertices of the zone.
    edges
        Tail and head of each of its edges.
    """

    name: str
    vertices: tuple[VertexId, ...] = ()
    edges: tuple[tuple[VertexId, VertexId], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedZone:
    """A zone by the names of its vertices; an edge is the names of its tail and its head."""

    name: str
    vertices: tuple[str, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()


def zones_of(
    named: Collection[NamedZone],
    ids: Mapping[str, int],
    edges: Collection[tuple[str, str]],
) -> tuple[Zone, ...]:
    """Return zones by vertex numbers.

    Parameters
    ----------
    named
        The zones.
    ids
        Number of each vertex.
    edges
        Tail and head of each edge of the roadmap, by name.

    Raises
    ------
    InputError
        With every vertex and edge that the roadmap does not have, every name given twice, and every
        vertex that belongs to a zone and is not listed.
    """
    faults = []
    names: set[str] = set()
    for index, zone in enumerate(named):
        faults += [fault.within(f"zones[{index}]") for fault in _faults(zone, names, ids, edges)]
        names.add(zone.name)
    if faults:
        raise InputError(faults)
    return tuple(
        Zone(
            name=zone.name,
            vertices=tuple(VertexId(ids[name]) for name in zone.vertices),
            edges=tuple((VertexId(ids[tail]), VertexId(ids[head])) for tail, head in zone.edges),
        )
        for zone in named
    )


def _faults(
    zone: NamedZone,
    names: Collection[str],
    ids: Mapping[str, int],
    edges: Collection[tuple[str, str]],
) -> Iterator[InputFault]:
    if zone.name in names:
        yield InputFault("name", f"{shown(zone.name)} is the name of another zone (give its own)")
    if not zone.vertices and not zone.edges:
        yield InputFault("", "has neither vertices nor edges (give some, or take it out)")
    for index, name in enumerate(zone.vertices):
        if name not in ids:
            near = nearest(name, ids)
            hint = f"did you mean {near!r}?" if near else f"name one of the {len(ids)} vertices"
            yield InputFault(f"vertices[{index}]", f"no vertex is named {shown(name)} ({hint})")
    for index, (tail, head) in enumerate(zone.edges):
        if (tail, head) not in edges:
            message = f"no edge leads from {shown(tail)} to {shown(head)} (name an edge)"
            yield InputFault(f"edges[{index}]", message)
    entered, left = {head for _, head in zone.edges}, {tail for tail, _ in zone.edges}
    for name in sorted((entered & left).difference(zone.vertices)):
        yield InputFault(
            "vertices",
            f"{shown(name)} can be entered and left along edges of the zone (list it, too)",
        )
