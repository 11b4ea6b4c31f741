"""LIF, the Layout Interchange Format of the VDMA, versions 1.0.0 and 2.0.0, read leniently.

Version 2 has layouts inside origins, several types of robots with one set of properties, and other
names of keys; the names of both versions are known in either.

References
----------
VDMA, *Layout Interchange Format (LIF)*, version 1.0.0, 2024. The examples of the standard lack
``stations`` or write numbers as text; both are accepted.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from math import atan2, degrees
from typing import Any, get_args

import numpy as np

from rightofway.errors import InputError, Steps, format_path, is_printable
from rightofway.facts import Fact
from rightofway.io.faults import read_both
from rightofway.io.layouts.draft import MICRO, Curve, LayoutDraft, LevelDraft, find_name, name_piece
from rightofway.io.layouts.nurbs import CHORD_ERROR, Nurbs
from rightofway.io.source import Source
from rightofway.model import Blocking
from rightofway.model.actions import find_load_change, find_use, freeze_value, thaw_value
from rightofway.site.layout import Layout, LayoutVertex, Station, Turns

NODE_PROPERTIES = ("vehicleTypeNodeProperties", "mobileRobotTypeNodeProperties")
EDGE_PROPERTIES = ("vehicleTypeEdgeProperties", "mobileRobotTypeEdgeProperties")
ACTIONS = ("actions", "requiredActions", "feasibleActions")
SPEEDS = ("maxSpeed", "maximumSpeed")

NUMBERS = {"x", "y", "theta", *SPEEDS, "maxRotationSpeed", "maximumRotationSpeed", "minHeight",
           "maxHeight", "stationHeight", "degree", "knotVector", "weight"}  # fmt: skip
"""Keys of numbers, in both versions."""

CHARGING = ("startCharging", "stopCharging")
"""The actions of a charging place."""

LOADS = ("pick", "drop")
"""The actions of VDA 5050 that change the load."""

NODE_KEYS = {"nodeId", "nodeName", "nodeDescription", "mapId", "nodePosition", *NODE_PROPERTIES}
EDGE_KEYS = {"edgeId", "edgeName", "edgeDescription", "startNodeId", "endNodeId", *EDGE_PROPERTIES}
TURNS = ("rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed")
PROPERTY_KEYS = {"vehicleTypeId", "mobileRobotTypes", "orientationType", "trajectory",
                 *ACTIONS, *SPEEDS}  # fmt: skip
ANGLES = ("theta", "vehicleOrientation")
STATION_KEYS = {"stationId", "stationName", "stationDescription", "interactionNodeIds",
                "stationPosition"}  # fmt: skip
"""The keys that are read, and those for people."""

DEFAULTS: dict[str, tuple[object, ...]] = {
    "vehicleOrientation": (0,),
    "rotationAllowed": (True, False),
    **dict.fromkeys(TURNS, ("BOTH", "NONE")),
    "reentryAllowed": (True,),
    "loadRestriction": ({"unloaded": True, "loaded": True},),
}
"""How robots drive anyway: forwards, with or without a load. They turn in both ways or not."""

HALF_TURN = Fraction("3.15")
"""No angle is larger; pi may be rounded."""


def recognizes(document: Any) -> bool:
    """Return whether a document is a LIF file: it has layouts, or the information about them."""
    return isinstance(document, dict) and bool(
        {"layouts", "origins", "metaInformation"} & set(document)
    )


def read(document: Any) -> Layout:
    """Return the layout of a document; each of its layouts is a level.

    Raises
    ------
    InputError
        With every node, edge and station that cannot be used.
    """
    draft, root = LayoutDraft("LIF layout"), Source(document)
    for path in _list_numbers_as_text(document):
        draft.repair(Fact("number as text"), format_path(path))
    origins = [root] if root.get("origins") is None else root.need("origins").read_items()
    layouts = [layout for origin in origins for layout in origin.need("layouts").read_items()]
    for part, name in zip(layouts, _choose_level_names(layouts), strict=True):
        draft.faults.attempt("", _read_layout, part, name, draft)
    return draft.make_layout()


def _read_layout(part: Source, name: str, draft: LayoutDraft) -> None:
    level = draft.begin_level(name)
    for node in draft.attempt_vertex(None, lambda: part.need("nodes").read_items()) or []:
        draft.attempt_vertex(find_name(node, "nodeId"), _add_node, level, node, draft)
    for edge in draft.faults.attempt("", _list_items, part, "edges", draft) or []:
        draft.faults.attempt("", _add_edge, level, edge, draft)
    for station in draft.faults.attempt("", _list_items, part, "stations", draft) or []:
        draft.faults.attempt("", _add_station, level, station, draft)
    if not draft.faults.found:
        _note_headings(part.read_items_under("stations"), draft)


def _choose_level_names(layouts: list[Source]) -> list[str]:
    """Return the levels' names where they differ, else the layouts' names."""
    for key in ("layoutLevelId", "layoutId"):
        layout_names = [layout.get(key) for layout in layouts]
        names = [part.read_text() for part in layout_names if part is not None]
        if len(set(names)) == len(layouts):
            return names
    return [str(number) for number in range(1, len(layouts) + 1)]


def _list_items(part: Source, key: str, draft: LayoutDraft) -> list[Source]:
    value = part.get(key)
    if value is None:
        mending = Fact("missing list", key=key)
        draft.repair(mending, name_piece(part, "layoutLevelId", "layoutId"))
        return []
    return value.read_items()


def _list_numbers_as_text(value: Any, is_number: bool = False) -> Iterator[Steps]:
    """Yield where numbers of a document are text, also those that nothing here depends on."""
    if isinstance(value, dict):
        entries = ((key, child, key in NUMBERS) for key, child in value.items())
    else:
        entries = ((index, child, is_number) for index, child in enumerate(value))
    for step, child, is_own in entries:
        if isinstance(child, dict | list):
            for inner in _list_numbers_as_text(child, is_own):
                yield (step, *inner)
        elif is_own and isinstance(child, str):
            yield (step,)


def _add_node(level: LevelDraft, node: Source, draft: LayoutDraft) -> None:
    name, at = node.need("nodeId").read_text(), node.need("nodePosition")
    draft.note_unused(node, name, NODE_KEYS)
    actions = dict[str, str]()
    for own in node.read_items_under(*NODE_PROPERTIES):
        _note_unused_properties(own, name, draft, _take_actions(own, actions))
    headings = [_read_angle(own, "theta") for own in node.read_items_under(*NODE_PROPERTIES)]
    level.add(
        LayoutVertex(
            name=name,
            at=read_both(lambda: at.need("x").number(), lambda: at.need("y").number()),
            heading=_choose_common(headings, "theta", name, draft),
            is_charging=any(
                action.value.get("actionType") == CHARGING[0]
                for own in node.read_items_under(*NODE_PROPERTIES)
                for action in own.read_items_under(*ACTIONS)
                if isinstance(action.value, dict)
            ),
            actions=tuple(actions.items()),
        ),
        node,
    )


def _take_actions(own: Source, actions: dict[str, str]) -> set[str]:
    """Add the actions for picking and dropping loads; return the action types that count."""
    kinds = list[tuple[str, Source]]()
    for source in own.read_items_under(*ACTIONS):
        kind = source.value.get("actionType") if isinstance(source.value, dict) else None
        if isinstance(kind, str) and find_load_change(kind):
            kinds.append((kind, source))
    used = set[str]()
    for kind, source in sorted(kinds, key=lambda own: own[0] not in LOADS):
        written = json.dumps(_read_action(source, kind))
        if actions.setdefault(find_use(find_load_change(kind)), written) == written:
            used.add(kind)
    return used


def _read_action(source: Source, kind: str) -> dict[str, Any]:
    """Return an action as scenarios have it; what cannot be read is left out."""
    value = source.value
    blocking = str(value.get("blockingType", "HARD")).lower()
    description = value.get("actionDescription") or value.get("actionDescriptor")
    is_shown = isinstance(description, str) and is_printable(description)
    known = {
        "parameters": _read_parameters(source),
        "blocking": blocking if blocking in get_args(Blocking) else None,
        "description": description if is_shown else None,
    }
    return {"action": kind, **{key: own for key, own in known.items() if own}}


def _read_parameters(action: Source) -> dict[str, Any]:
    """Return the parameters of an action that have a value."""
    parameters = dict[str, Any]()
    for own in action.read_items_under("actionParameters"):
        if isinstance(own.value, dict) and isinstance(own.value.get("key"), str):
            with suppress(ValueError):
                parameters[own.value["key"]] = thaw_value(freeze_value(own.value.get("value")))
    return parameters


def _add_edge(level: LevelDraft, edge: Source, draft: LayoutDraft) -> None:
    tail, head = read_both(
        lambda: edge.need("startNodeId").read_text(), lambda: edge.need("endNodeId").read_text()
    )
    own, name = edge.read_items_under(*EDGE_PROPERTIES), name_piece(edge, "edgeId")
    if (edge_id := find_name(edge, "edgeId")) is not None:
        level.edge_ids.setdefault((tail, head), edge_id)
    draft.note_unused(edge, name, EDGE_KEYS)
    direction = _find_direction(level, tail, head)
    for properties in own:
        _note_unused_properties(properties, name, draft, direction=direction)
    if not own:
        mending = Fact("edge without vehicle type")
        draft.repair(mending, name)
        level.connect(edge, tail, head)
    ways: dict[tuple[Fraction | None, Curve | None], set[str]] = {}
    turns = level.turns.setdefault((tail, head), {})
    for properties in own:
        for vehicle_type in _list_types(properties):
            known = turns.get(vehicle_type, Turns())
            turns[vehicle_type] = _restrict(known, _read_turns(properties))
        speed = properties.get(*SPEEDS)
        limit = None if speed is None else speed.number()
        limit_and_curve = limit, _read_curve(properties, draft, name)
        ways.setdefault(limit_and_curve, set()).update(_list_types(properties))
    orientations = [_read_orientation(properties, direction) for properties in own]
    orientation = _choose_common(orientations, "vehicleOrientation", name, draft)
    if orientation is not None:
        level.orientations[tail, head] = orientation
    for (limit, curve), types in ways.items():  # one lane for all types with one way
        level.connect(edge, tail, head, max_speed=limit, types=frozenset(types), curve=curve)


def _read_angle(own: Source, key: str) -> Fraction | None:
    """Return an angle [degrees]; None without one in radians."""
    try:
        angle = own.need(key).number() if own.value.get(key) is not None else None
    except InputError:
        return None  # no plan depends on it
    if angle is None or abs(angle) > HALF_TURN:
        return None
    return Fraction(round(degrees(angle) * MICRO), MICRO)


def _read_orientation(own: Source, direction: Fraction | None) -> Fraction | None:
    """Return the orientation against the direction of driving along an edge [degrees].

    One of the site has none along a curve, or where the direction is unknown.
    """
    angle = _read_angle(own, "vehicleOrientation")
    if angle is None or not _is_global(own):
        return angle
    if direction is None or own.value.get("trajectory") is not None:
        return None
    return (angle - direction + 180) % 360 - 180


def _is_global(own: Source) -> bool:
    """Return whether an orientation along an edge is one of the site."""
    return bool(own.value.get("orientationType") == "GLOBAL")


def _find_direction(level: LevelDraft, tail: str, head: str) -> Fraction | None:
    """Return the direction of driving along a straight edge [degrees]; None to other levels."""
    begin, end = level.vertices.get(tail), level.vertices.get(head)
    if begin is None or end is None or begin.at == end.at:
        return None
    x, y = (float(b - a) for a, b in zip(begin.at, end.at, strict=True))
    return Fraction(round(degrees(atan2(y, x)) * MICRO), MICRO)


def _read_turns(own: Source) -> Turns:
    """Return where robots of a type may turn on an edge."""
    along = own.value.get("rotationAllowed")
    at_begin, at_end = (own.value.get(key) != "NONE" for key in TURNS)
    return Turns(at_begin, at_end, along if isinstance(along, bool) else None)


def _restrict(first: Turns, other: Turns) -> Turns:
    """Return where robots may turn on each of two parallel edges."""
    along = [turn for turn in (first.along, other.along) if turn is not None]
    return Turns(
        first.at_begin and other.at_begin,
        first.at_end and other.at_end,
        all(along) if along else None,
    )


def _choose_common(
    angles: Sequence[Fraction | None], key: str, name: str, draft: LayoutDraft
) -> Fraction | None:
    """Return the angle of all types of robots that have one; None, with a note, if they differ."""
    different = {angle for angle in angles if angle is not None}
    if len(different) > 1:
        draft.note_unused_key(key, name)
    return different.pop() if len(different) == 1 else None


def _list_types(own: Source) -> list[str]:
    """Return the vehicle types that properties are for: an id, or series of robots."""
    series = own.get("mobileRobotTypes")
    if series is None:
        return [own.need("vehicleTypeId").read_text()]
    return [robot_type.need("seriesName").read_text() for robot_type in series.read_items()]


def _read_curve(own: Source, draft: LayoutDraft, name: str) -> Curve | None:
    """Return the curve of a trajectory, if there is one that can be read."""
    trajectory = own.get("trajectory")
    if trajectory is None:
        return None
    try:
        nurbs = _read_nurbs(trajectory)
        pieces = nurbs.cut_pieces()
    except (InputError, ValueError):
        mending = Fact("unreadable trajectory")
        draft.repair(mending, name)
        return None
    points = tuple(
        (Fraction(round(x * MICRO), MICRO), Fraction(round(y * MICRO), MICRO))
        for x, y in pieces.tolist()
    )
    error = Fraction(repr(CHORD_ERROR)) if nurbs.degree > 1 else Fraction(0)
    return Curve(points, error)


def _read_nurbs(trajectory: Source) -> Nurbs:
    degree = trajectory.get("degree")
    controls = trajectory.need("controlPoints").read_items()
    knots = [float(knot.number()) for knot in trajectory.need("knotVector").read_items()]
    weights = (control.get("weight") for control in controls)
    return Nurbs(
        degree=1 if degree is None else int(degree.number()),
        knots=np.array(knots),
        points=np.array(
            [[float(control.need(axis).number()) for axis in "xy"] for control in controls]
        ),
        weights=np.array([1.0 if weight is None else float(weight.number()) for weight in weights]),
    )


def _note_unused_properties(
    own: Source,
    name: str,
    draft: LayoutDraft,
    taken: Collection[str] = (),
    direction: Fraction | None = None,
) -> None:
    """Note the properties for one type of robots that have no effect on plans and orders.

    False and 0 have a meaning here. Defaults have an effect on no plan.
    """
    properties = own.read_mapping()
    used = {"theta"} if _read_angle(own, "theta") is not None else set[str]()
    if _read_orientation(own, direction) is not None:
        used.add("vehicleOrientation")
    for key, value in properties.items():
        is_default = value in DEFAULTS.get(key, ())
        is_default &= not (key == "vehicleOrientation" and _is_global(own))
        if key not in PROPERTY_KEYS | used and value is not None and not is_default:
            draft.note_unused_key(key, name)
    for action in own.read_items_under(*ACTIONS):
        kind = action.value.get("actionType") if isinstance(action.value, dict) else None
        if kind not in CHARGING and kind not in taken:
            draft.note_unused_key(f"action {kind}", name)
    for key in ANGLES:
        _check_angle(own, key, name, draft)


def _check_angle(own: Source, key: str, name: str, draft: LayoutDraft) -> None:
    """Note an angle that is not in radians."""
    if own.value.get(key) is None:
        return
    try:
        angle = own.need(key).number()
    except InputError:
        return  # no plan depends on it
    if abs(angle) > HALF_TURN:
        mending = Fact("angle too large", key=key)
        draft.repair(mending, Fact("name with number", name=name, what=angle))


def _add_station(level: LevelDraft, station: Source, draft: LayoutDraft) -> None:
    name = station.need("stationId").read_text()
    nodes = [node.read_text() for node in station.need("interactionNodeIds").read_items()]
    level.stations.append(Station(name=name, vertices=tuple(nodes)))
    draft.note_unused(station, name, STATION_KEYS)
    if _get_theta(station) is not None:
        position = station.need("stationPosition")
        heading = _read_angle(position, "theta")
        if heading is None:
            draft.note_unused_key("stationPosition.theta", name)
        else:
            _turn_at(level, nodes, heading)
        _check_angle(position, "theta", name, draft)


def _turn_at(level: LevelDraft, nodes: Sequence[str], heading: Fraction) -> None:
    """Give the nodes of a station its heading, where they have none of their own."""
    for node in nodes:
        vertex = level.vertices.get(node)
        if vertex is not None and vertex.heading is None:
            level.vertices[node] = replace(vertex, heading=heading)


def _get_theta(station: Source) -> Any:
    """Return the heading of robots at a station, as it is written."""
    position = station.value.get("stationPosition")
    return position.get("theta") if isinstance(position, dict) else None


def _note_headings(stations: list[Source], draft: LayoutDraft) -> None:
    """Note the stations at one node that differ in theta."""
    at_node = defaultdict[str, dict[str, str]](dict)
    for station in stations:
        theta = _get_theta(station) if isinstance(station.value, dict) else None
        if theta is not None:
            for node in station.need("interactionNodeIds").read_items():
                at_node[node.read_text()][name_piece(station, "stationId")] = str(theta)
    for thetas in at_node.values():
        if len(set(thetas.values())) > 1:
            mending = Fact("stations that differ in theta")
            draft.repair(mending, Fact("names", names=tuple(thetas)))
