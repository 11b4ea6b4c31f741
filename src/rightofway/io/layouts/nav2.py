"""Route graphs of the Nav2 route server: GeoJSON with points, and lines that name two points.

Edges are directed; their geometry is not used by Nav2, and serves for drawing here.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from rightofway.errors import InputError, quote
from rightofway.facts import Fact
from rightofway.io.faults import read_both
from rightofway.io.layouts.draft import LayoutDraft, LevelDraft, find_name, name_piece
from rightofway.io.source import Source
from rightofway.site.geometry import Point
from rightofway.site.layout import Layout, LayoutVertex

FASTEST = 10
"""A larger speed limit cannot be meant in m/s: by default Nav2 reads limits as percentages."""

NODE_KEYS = {"id", "frame", "metadata"}
EDGE_KEYS = {"id", "startid", "endid", "overridable", "metadata"}
METADATA_KEYS = {"speed_limit"}
"""Keys that are read; `overridable` only permits scorers of Nav2 to change the cost."""

LINES = ("LineString", "MultiLineString")


GEOGRAPHIC = ("4326", "CRS84")
"""Coordinate reference systems (crs) whose coordinates are degrees."""


def recognizes(document: Any) -> bool:
    """Return whether a document is a collection of features."""
    return isinstance(document, dict) and (
        document.get("type") == "FeatureCollection" or "features" in document
    )


def read(document: Any) -> Layout:
    """Return the layout of a document.

    Raises
    ------
    InputError
        With every feature that is not a node and no edge.
    """
    draft = LayoutDraft("Nav2 route graph")
    level = draft.begin_level()
    crs = str(document.get("crs", ""))
    if name := next((name for name in GEOGRAPHIC if name in crs), None):
        draft.repair(Fact("coordinates in metres", crs=name))
    for feature in Source(document).need("features").read_items():
        properties = feature.value.get("properties") if isinstance(feature.value, dict) else None
        if isinstance(properties, dict) and {"startid", "endid"} & set(properties):
            draft.faults.attempt("", _add, level, feature, draft)
        else:
            draft.attempt_vertex(find_name(Source(properties), "id"), _add, level, feature, draft)
    return draft.make_layout()


def _add(level: LevelDraft, feature: Source, draft: LayoutDraft) -> None:
    geometry, own = feature.need("geometry"), feature.need("properties")
    kind = geometry.need("type")
    if kind.value == "Point":
        x, y = _point(geometry.need("coordinates"))
        name = own.need("id").read_text()
        level.add(LayoutVertex(name=name, at=(x, y)), feature)
        _note_unused(own, draft, NODE_KEYS)
    elif kind.value in LINES:
        _add_edge(level, feature, draft)
    else:
        known = ", ".join(("Point", *LINES))
        raise kind.make_fault(f"{quote(kind.value)} is no node and no edge (give one of {known})")


def _note_unused(own: Source, draft: LayoutDraft, used: Collection[str]) -> None:
    """Note the properties of a node or an edge that have no effect, and those in its metadata."""
    name, metadata = name_piece(own, "id"), own.get("metadata")
    draft.note_unused(own, name, used)
    if metadata is not None and isinstance(metadata.value, dict):
        draft.note_unused(metadata, name, METADATA_KEYS)


def _add_edge(level: LevelDraft, feature: Source, draft: LayoutDraft) -> None:
    own = feature.need("properties")
    name = name_piece(own, "id")
    _note_unused(own, draft, EDGE_KEYS)
    metadata = own.get("metadata")
    limit = None if metadata is None else metadata.get("speed_limit")
    max_speed = None if limit is None else limit.number()
    if max_speed is not None and max_speed > FASTEST:
        draft.repair(Fact("speed limit in percent"), name)
        max_speed = None
    elif max_speed is not None:
        draft.repair(Fact("speed limit in m/s"), name)
    tail, head = read_both(
        lambda: own.need("startid").read_text(), lambda: own.need("endid").read_text()
    )
    level.connect(
        feature,
        tail,
        head,
        max_speed=max_speed,
        shape=_read_shape(feature.need("geometry"), draft, name),
    )


def _read_shape(geometry: Source, draft: LayoutDraft, name: str) -> tuple[Point, ...]:
    """Return the points between the ends of a line; a drawing that cannot be read is left out."""
    coordinates = geometry.get("coordinates")
    if coordinates is None:
        return ()
    try:
        points = coordinates.read_items()
        if any(isinstance(number.value, list) for point in points for number in point.read_items()):
            points = [point for line in points for point in line.read_items()]
        return tuple(_point(point) for point in points)[1:-1]
    except InputError:
        draft.repair(Fact("unreadable drawing of edge"), name)
        return ()


def _point(part: Source) -> Point:
    numbers = part.read_items()
    if len(numbers) not in {2, 3}:
        raise part.make_fault(f"{quote(part.value)} is no point (give [x, y])")
    return read_both(numbers[0].number, numbers[1].number)
