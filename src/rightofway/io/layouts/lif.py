"""LIF, the Layout Interchange Format of the VDMA, version 1.0.0, read leniently.

References
----------
VDMA, *Layout Interchange Format (LIF)*, version 1.0.0, 2024. The examples of the standard lack
``stations`` or write numbers as text; both are accepted.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from rightofway.io.layouts.draft import Draft, Lane, LevelDraft
from rightofway.io.layouts.parts import Part
from rightofway.model.layout import Layout, LayoutVertex, Station

CHARGING = "startCharging"
"""The action that makes a node a charging place."""


def recognizes(document: Any) -> bool:
    """Return whether a document is a LIF file: it has layouts, or the information about them."""
    return isinstance(document, dict) and (
        "layouts" in document or {"metaInformation", "nodes"} <= set(document)
    )


def read(document: Any) -> Layout:
    """Return the layout of a document; each of its layouts is a level.

    Raises
    ------
    InputError
        With every node, edge and station that cannot be used.
    """
    draft, root = Draft("LIF layout"), Part(document)
    names = _level_names(root.need("layouts").items())
    for part, name in zip(root.need("layouts").items(), names, strict=True):
        level = draft.level(name)
        for node in part.need("nodes").items():
            draft.faults.attempt("", _add_node, level, node, draft)
        for edge in _items(part, "edges", draft):
            draft.faults.attempt("", _add_edge, level, edge, draft)
        for station in _items(part, "stations", draft):
            draft.faults.attempt("", _add_station, level, station)
    return draft.layout()


def _level_names(layouts: list[Part]) -> list[str]:
    """Return the levels' names where they differ, else the layouts' names."""
    for key in ("layoutLevelId", "layoutId"):
        found = [layout.get(key) for layout in layouts]
        names = [part.text() for part in found if part is not None]
        if len(set(names)) == len(layouts):
            return names
    return [str(number) for number in range(1, len(layouts) + 1)]


def _items(part: Part, key: str, draft: Draft) -> list[Part]:
    found = part.get(key)
    if found is None:
        draft.repair(f"the list of {key} is missing and counts as empty")
        return []
    return found.items()


def _number(part: Part, draft: Draft) -> Fraction:
    if isinstance(part.value, str):
        draft.repair("a number is written as text")
    return part.number()


def _add_node(level: LevelDraft, node: Part, draft: Draft) -> None:
    name, at = node.need("nodeId").text(), node.need("nodePosition")
    level.add(
        LayoutVertex(
            name=name,
            at=(_number(at.need("x"), draft), _number(at.need("y"), draft)),
            is_charging=any(
                action.value.get("actionType") == CHARGING
                for own in _listed(node, "vehicleTypeNodeProperties")
                for action in _listed(own, "actions")
                if isinstance(action.value, dict)
            ),
        ),
        node.place,
    )


def _listed(part: Part, key: str) -> list[Part]:
    found = part.get(key)
    return [] if found is None else found.items()


def _add_edge(level: LevelDraft, edge: Part, draft: Draft) -> None:
    tail, head = edge.need("startNodeId").text(), edge.need("endNodeId").text()
    own = _listed(edge, "vehicleTypeEdgeProperties")
    if not own:
        draft.repair("an edge without a vehicle type is free for all")
        level.connect(Lane(place=edge.place, tail=tail, head=head))
    limits: dict[Fraction | None, set[str]] = {}
    for each in own:
        speed = each.get("maxSpeed")
        limit = None if speed is None else _number(speed, draft)
        limits.setdefault(limit, set()).add(each.need("vehicleTypeId").text())
    for limit, types in limits.items():  # one lane for all types with one speed limit
        level.connect(
            Lane(place=edge.place, tail=tail, head=head, max_speed=limit, types=frozenset(types))
        )


def _add_station(level: LevelDraft, station: Part) -> None:
    nodes = [node.text() for node in station.need("interactionNodeIds").items()]
    level.stations.append(Station(name=station.need("stationId").text(), vertices=tuple(nodes)))
