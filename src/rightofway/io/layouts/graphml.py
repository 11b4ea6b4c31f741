"""GraphML: a graph whose nodes have coordinates, as x and y, as one text, or as drawn by yEd."""

from __future__ import annotations

import re
from fractions import Fraction

from rightofway.errors import InputError, shown
from rightofway.io.layouts.draft import Draft, Lane, LevelDraft
from rightofway.io.layouts.parts import number_in
from rightofway.io.layouts.xml_tree import Element
from rightofway.site.geometry import Point
from rightofway.site.layout import Layout, LayoutVertex

PAIRS = ("pos", "coords", "coordinates", "position")
"""Names of attributes that hold x and y in one text, like ``70,182`` or ``(70, 182)``."""

LENGTHS = ("length", "distance", "weight")
SPEEDS = ("max_speed", "maxspeed", "speed_limit")

Attributes = dict[str, str]


def recognizes(root: Element) -> bool:
    """Return whether an XML file is GraphML."""
    return root.name == "graphml"


def read(root: Element) -> Layout:
    """Return the layout of a file; y grows upwards.

    Raises
    ------
    InputError
        With every node without coordinates, and every edge that leads nowhere.
    """
    draft = Draft("GraphML graph")
    level = draft.level()
    keys = {key.need("id"): key.get("attr.name") or key.need("id") for key in root.all("key")}
    for graph in root.all("graph"):
        is_directed = graph.get("edgedefault") != "undirected"
        for node in graph.descendants("node"):
            draft.faults.attempt("", _add_node, level, node, keys, draft)
        for edge in graph.descendants("edge"):
            draft.faults.attempt("", _add_edge, level, edge, keys, is_directed)
    return draft.layout()


def _attributes(element: Element, keys: dict[str, str]) -> Attributes:
    """Return the values of an element by name in lower case; a key that is not declared counts."""
    found = {key.lower(): value for key, value in element.attributes.items()}
    for data in element.all("data"):
        key = data.need("key")
        found[keys.get(key, key).lower()] = data.text.strip()
    return found


def _add_node(level: LevelDraft, node: Element, keys: dict[str, str], draft: Draft) -> None:
    own, name = _attributes(node, keys), node.label("id")
    drawn = next(node.descendants("Geometry"), None)
    if "x" in own and "y" in own:
        at = number_in(own["x"], node.place), number_in(own["y"], node.place)
    elif any(pair in own for pair in PAIRS):
        at = _pair(next(own[pair] for pair in PAIRS if pair in own), node)
    elif drawn is not None:
        draft.repair("a node lies where it is drawn, y negated")
        half = [number_in(drawn.get(key) or "0", drawn.place) / 2 for key in ("width", "height")]
        at = drawn.number("x") + half[0], -drawn.number("y") - half[1]
    else:
        known = ", ".join(("x and y", *PAIRS))
        message = f"the node {shown(name)} has no coordinates (give one of {known})"
        raise InputError.at(node.place, message)
    level.add(
        LayoutVertex(
            name=name,
            at=at,
            is_parking=own.get("parking", "").lower() in {"true", "1"},
            is_charging=own.get("charging", "").lower() in {"true", "1"},
        ),
        node.place,
    )


def _pair(text: str, node: Element) -> Point:
    numbers = re.split(r"[,;\s]+", text.strip("()[] \t\n"))
    if len(numbers) not in {2, 3}:
        raise InputError.at(node.place, f"{shown(text)} is no point (give x,y)")
    return number_in(numbers[0], node.place), number_in(numbers[1], node.place)


def _add_edge(level: LevelDraft, edge: Element, keys: dict[str, str], is_directed: bool) -> None:
    own = _attributes(edge, keys)
    one_way = own.get("directed", str(is_directed)).lower() in {"true", "1"}
    tail, head = edge.label("source"), edge.label("target")

    def first(names: tuple[str, ...]) -> tuple[str, Fraction | None]:
        found = next((name for name in names if own.get(name)), "")
        return found, number_in(own[found], edge.place) if found else None

    (attribute, length), (_, max_speed) = first(LENGTHS), first(SPEEDS)
    for ends in ((tail, head),) if one_way else ((tail, head), (head, tail)):
        level.connect(
            Lane(
                place=edge.place,
                tail=ends[0],
                head=ends[1],
                length=length,
                attribute=attribute,
                max_speed=max_speed,
            )
        )
