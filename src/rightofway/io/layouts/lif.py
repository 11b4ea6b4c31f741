"""LIF, the Layout Interchange Format of the VDMA, versions 1.0.0 and 2.0.0, read leniently.

Version 2 has layouts inside origins, several types of robots with one set of properties, and other
names of keys; the names of both versions are known in either.

References
----------
VDMA, *Layout Interchange Format (LIF)*, version 1.0.0, 2024. The examples of the standard lack
``stations`` or write numbers as text; both are accepted.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from rightofway.errors import InputError
from rightofway.io.layouts.draft import MICRO, Curve, LayoutDraft, LevelDraft
from rightofway.io.layouts.nurbs import CHORD_ERROR, Nurbs
from rightofway.io.source import Source
from rightofway.phrases import Phrase
from rightofway.site.layout import Layout, LayoutVertex, Station

NODE_PROPERTIES = ("vehicleTypeNodeProperties", "mobileRobotTypeNodeProperties")
EDGE_PROPERTIES = ("vehicleTypeEdgeProperties", "mobileRobotTypeEdgeProperties")
ACTIONS = ("actions", "requiredActions", "feasibleActions")
SPEEDS = ("maxSpeed", "maximumSpeed")

NUMBERS = {"x", "y", "theta", *SPEEDS, "maxRotationSpeed", "maximumRotationSpeed", "minHeight",
           "maxHeight", "stationHeight", "degree", "knotVector", "weight"}  # fmt: skip
"""Keys of numbers, in both versions."""

CHARGING = "startCharging"
"""The action that makes a node a charging place."""


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
    for _ in _numbers_as_text(document):
        draft.repair(Phrase("a number is written as text"))
    origins = [root] if root.get("origins") is None else root.need("origins").read_items()
    layouts = [layout for origin in origins for layout in origin.need("layouts").read_items()]
    for part, name in zip(layouts, _level_names(layouts), strict=True):
        level = draft.begin_level(name)
        for node in part.need("nodes").read_items():
            draft.faults.attempt("", _add_node, level, node)
        for edge in _items(part, "edges", draft):
            draft.faults.attempt("", _add_edge, level, edge, draft)
        for station in _items(part, "stations", draft):
            draft.faults.attempt("", _add_station, level, station)
    return draft.make_layout()


def _level_names(layouts: list[Source]) -> list[str]:
    """Return the levels' names where they differ, else the layouts' names."""
    for key in ("layoutLevelId", "layoutId"):
        layout_names = [layout.get(key) for layout in layouts]
        names = [part.read_text() for part in layout_names if part is not None]
        if len(set(names)) == len(layouts):
            return names
    return [str(number) for number in range(1, len(layouts) + 1)]


def _items(part: Source, key: str, draft: LayoutDraft) -> list[Source]:
    value = part.get(key)
    if value is None:
        draft.repair(Phrase("the list of {key} is missing and counts as empty", key=key))
        return []
    return value.read_items()


def _numbers_as_text(value: Any, is_number: bool = False) -> Iterator[str]:
    """Yield the numbers of a document that are text, also those that nothing here depends on."""
    if isinstance(value, dict):
        for key, child in value.items():
            yield from _numbers_as_text(child, key in NUMBERS)
    elif isinstance(value, list):
        for child in value:
            yield from _numbers_as_text(child, is_number)
    elif is_number and isinstance(value, str):
        yield value


def _add_node(level: LevelDraft, node: Source) -> None:
    name, at = node.need("nodeId").read_text(), node.need("nodePosition")
    level.add(
        LayoutVertex(
            name=name,
            at=(at.need("x").number(), at.need("y").number()),
            is_charging=any(
                action.value.get("actionType") == CHARGING
                for own in node.read_items_under(*NODE_PROPERTIES)
                for action in own.read_items_under(*ACTIONS)
                if isinstance(action.value, dict)
            ),
        ),
        node,
    )


def _add_edge(level: LevelDraft, edge: Source, draft: LayoutDraft) -> None:
    tail, head = edge.need("startNodeId").read_text(), edge.need("endNodeId").read_text()
    own = edge.read_items_under(*EDGE_PROPERTIES)
    if not own:
        draft.repair(Phrase("an edge without a vehicle type is free for all"))
        level.connect(edge, tail, head)
    ways: dict[tuple[Fraction | None, Curve | None], set[str]] = {}
    for properties in own:
        speed = properties.get(*SPEEDS)
        limit = None if speed is None else speed.number()
        limit_and_curve = limit, _curve(properties, draft)
        ways.setdefault(limit_and_curve, set()).update(_types(properties))
    for (limit, curve), types in ways.items():  # one lane for all types with one way
        level.connect(edge, tail, head, max_speed=limit, types=frozenset(types), curve=curve)


def _types(own: Source) -> list[str]:
    """Return the vehicle types that properties are for: an id, or series of robots."""
    series = own.get("mobileRobotTypes")
    if series is None:
        return [own.need("vehicleTypeId").read_text()]
    return [robot_type.need("seriesName").read_text() for robot_type in series.read_items()]


def _curve(own: Source, draft: LayoutDraft) -> Curve | None:
    """Return the curve of a trajectory, if there is one that can be read."""
    trajectory = own.get("trajectory")
    if trajectory is None:
        return None
    try:
        nurbs = _nurbs(trajectory)
        pieces = nurbs.cut_pieces()
    except (InputError, ValueError):
        draft.repair(Phrase("a trajectory that cannot be read: its edge counts as straight"))
        return None
    points = tuple(
        (Fraction(round(x * MICRO), MICRO), Fraction(round(y * MICRO), MICRO))
        for x, y in pieces.tolist()
    )
    error = Fraction(repr(CHORD_ERROR)) if nurbs.degree > 1 else Fraction(0)
    return Curve(points, error)


def _nurbs(trajectory: Source) -> Nurbs:
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


def _add_station(level: LevelDraft, station: Source) -> None:
    nodes = [node.read_text() for node in station.need("interactionNodeIds").read_items()]
    level.stations.append(
        Station(name=station.need("stationId").read_text(), vertices=tuple(nodes))
    )
