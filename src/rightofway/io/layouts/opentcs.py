"""Plant models of openTCS as XML, versions 0.0.2 to 0.0.5, 6 and 7.

Lengths are millimetres there, speeds millimetres per second; a speed of 0 means that a path is not
driven in that direction. Control points are in coordinates of the drawing, so they are not read.
Operations of locations are the actions of robots at their points.
"""

from __future__ import annotations

import json
import re
from collections import defaultdict
from dataclasses import replace
from fractions import Fraction

from rightofway.errors import quote
from rightofway.facts import Fact
from rightofway.io.faults import read_both
from rightofway.io.layouts.draft import LayoutDraft, LevelDraft, find_name, name_piece
from rightofway.io.layouts.xml_tree import Element
from rightofway.io.source import Source
from rightofway.model.actions import ActionUse, find_load_change, find_use
from rightofway.site.layout import Layout, LayoutVertex, Station
from rightofway.site.zones import NamedZone

VERSIONS = ("0.0.2", "0.0.3", "0.0.4", "0.0.5", "6", "7")
"""The versions that are read; a whole number stands for all versions that begin with it."""

MILLIMETRE = Fraction(1, 1000)
MOST = 10**12
"""The largest position [mm]; UTM coordinates have ten digits."""

X, Y = ("positionX", "xPosition"), ("positionY", "yPosition")

CHARGE = re.compile(r"(?<!dis)charg", re.IGNORECASE)

IDLE = {"", "MOVE", "NOP", "PARK"}
"""Operations that are no work; openTCS defines them."""

Operations = dict[tuple[str, ActionUse], dict[str, str]]
"""For points and kinds of stops: their operations, each with the name of its location."""

USED = {
    *X, *Y, "destinationPoint", "id", "length", "link", "locked", "maxReverseVelocity",
    "maxVelocity", "name", "outgoingPath", "sourcePoint", "type", "vehicleOrientationAngle",
    # What concerns the drawing alone.
    "locationLayout", "pathLayout", "pointLayout", "positionZ", "zPosition",
}  # fmt: skip
"""Attributes of points, paths and locations, and elements inside, that are read."""


def recognizes(root: Element) -> bool:
    """Return whether an XML file is a plant model: other programs use the element, too."""
    return root.name == "model" and ("version" in root.value or any(root.list_all("point")))


def read(root: Element) -> Layout:
    """Return the layout of a file; locations are stations, blocks are zones.

    Raises
    ------
    InputError
        For an unknown version, and with every point, path and location that cannot be used.
    """
    _check_version(root)
    draft = LayoutDraft("openTCS plant model")
    level = draft.begin_level()
    paths: dict[str, list[tuple[str, str]]] = {}
    for point in root.list_all("point"):
        draft.attempt_vertex(find_name(point, "name"), _add_point, level, point, draft)
    for path in root.list_all("path"):
        draft.faults.attempt("", _add_path, level, path, paths, draft)
    of_types = {
        kind.value.get("name", ""): _list_operations(kind) for kind in root.list_all("locationType")
    }
    operations: Operations = defaultdict(dict)
    for location in root.list_all("location"):
        if draft.faults.attempt("", _add_location, level, location, draft):
            _add_operations(level, location, of_types, operations)
    _add_actions(level, operations, draft)
    for kind in ("vehicle", "vehicleType", "staticRoute"):
        for part in root.list_all(kind):
            draft.note_unused_key(kind, name_piece(part, "name"))
    for block in root.list_all("block"):
        draft.faults.attempt("", _add_block, level, block, paths, draft)
    return draft.make_layout()


def _check_version(root: Element) -> None:
    known = f"{', '.join(VERSIONS[:-1])} and {VERSIONS[-1]} are known"
    version = root.value.get("version")
    if version is None:
        raise root.make_fault(f"a plant model without a version (add it; {known})")
    if version not in VERSIONS and version.partition(".")[0] not in VERSIONS:
        remedy = (
            "update rightofway for a newer one; save an older one with an openTCS that opens it"
        )
        raise root.make_fault(f"a plant model of version {quote(version)} ({known}: {remedy})")


def _note_unused(element: Element, draft: LayoutDraft) -> None:
    """Note the attributes and elements of an element that have no effect on plans.

    Angles that are not given are NaN.
    """
    name = name_piece(element, "name")
    given = {key: value for key, value in element.value.items() if value not in {"NaN", "0"}}
    draft.note_unused(Source(given), name, USED)
    for child in element.children:
        if child.name not in USED:
            draft.note_unused_key(child.name, name)


def _is_locked(element: Element) -> bool:
    locked = element.get("locked")
    return locked is not None and locked.read_flag()


def _add_point(level: LevelDraft, point: Element, draft: LayoutDraft) -> None:
    x, y = read_both(lambda: point.need(*X).number(MOST), lambda: point.need(*Y).number(MOST))
    level.add(
        LayoutVertex(
            name=point.need("name").read_text(),
            at=(x * MILLIMETRE, y * MILLIMETRE),
            is_parking=point.value.get("type") == "PARK_POSITION",
            is_passed=point.value.get("type") == "REPORT_POSITION",  # no halt is allowed there
            heading=_read_heading(point),
        ),
        point,
    )
    _note_unused(point, draft)


def _read_heading(point: Element) -> Fraction | None:
    """Return the angle of vehicles at a point [degrees]; None for NaN, which leaves it open."""
    angle = point.value.get("vehicleOrientationAngle", "NaN")
    return None if angle == "NaN" else point.need("vehicleOrientationAngle").number()


def _add_path(
    level: LevelDraft, path: Element, paths: dict[str, list[tuple[str, str]]], draft: LayoutDraft
) -> None:
    tail, head = read_both(
        lambda: path.need("sourcePoint").read_text(),
        lambda: path.need("destinationPoint").read_text(),
    )
    lanes = paths.setdefault(path.need("name").read_text(), [])
    _note_unused(path, draft)
    if _is_locked(path):
        draft.repair(Fact("locked path"), name_piece(path, "name"))
        return
    length = path.need("length").number() * MILLIMETRE if path.value.get("length") else None
    speeds = (path.need(key).number() for key in ("maxVelocity", "maxReverseVelocity"))
    for ends, speed in zip(((tail, head), (head, tail)), speeds, strict=True):
        if speed > 0:
            lanes.append(ends)
            level.edge_ids.setdefault(ends, path.need("name").read_text())
            level.connect(path, *ends, length=length, max_speed=speed * MILLIMETRE)


def _add_location(level: LevelDraft, location: Element, draft: LayoutDraft) -> bool:
    """Add a location as a station, and return whether it is in use."""
    points = [link.need("point").read_text() for link in location.list_all("link")]
    if _is_locked(location):
        draft.repair(Fact("locked location"), name_piece(location, "name"))
        return False
    _note_unused(location, draft)
    level.stations.append(Station(name=location.need("name").read_text(), vertices=tuple(points)))
    return True


def _list_operations(owner: Element) -> list[str]:
    """Return the operations of vehicles that a type of locations, or a link of one, allows."""
    return [own.value.get("name", "") for own in owner.list_all("allowedOperation")]


def _add_operations(
    level: LevelDraft, location: Element, of_types: dict[str, list[str]], operations: Operations
) -> None:
    """Add the operations at the points of a location; those of a link replace those of the type."""
    of_type = of_types.get(location.value.get("type", ""), [])
    for link in location.list_all("link"):
        point = link.value["point"]
        for operation in _list_operations(link) or of_type:
            if CHARGE.search(operation) and point in level.vertices:
                level.vertices[point] = replace(level.vertices[point], is_charging=True)
            elif is_work(operation):
                use = find_use(find_load_change(operation))
                operations[point, use].setdefault(operation, name_piece(location, "name"))


def is_work(operation: str) -> bool:
    """Return whether a vehicle does something in an operation, other than charging."""
    return operation not in IDLE and not CHARGE.search(operation)


def _add_actions(level: LevelDraft, operations: Operations, draft: LayoutDraft) -> None:
    """Add operations as actions of points; note those of which an order would have to choose."""
    for (point, use), names in operations.items():
        vertex = level.vertices.get(point)
        if vertex is None or len(names) > 1:
            for operation, location in names.items():
                draft.note_unused_key(f"operation {operation}", location)
        else:
            action = json.dumps({"action": next(iter(names))})
            level.vertices[point] = replace(vertex, actions=(*vertex.actions, (use, action)))


def _add_block(
    level: LevelDraft, block: Element, paths: dict[str, list[tuple[str, str]]], draft: LayoutDraft
) -> None:
    members = [member.need("name").read_text() for member in block.list_all("member")]
    mending = Fact("unknown member of block")
    for name in members:
        if name not in level.vertices and name not in paths:
            draft.repair(
                mending, Fact("name with detail", name=name, what=name_piece(block, "name"))
            )
    if block.value.get("type") == "SAME_DIRECTION_ONLY":
        mending = Fact("block of one direction")
        draft.repair(mending, name_piece(block, "name"))
    level.zones.append(
        NamedZone(
            name=block.need("name").read_text(),
            vertices=tuple(name for name in members if name in level.vertices),
            edges=tuple(ends for name in members for ends in paths.get(name, ())),
        )
    )
