"""Graphs of `networkx` as layouts; attributes have the names that they have in GraphML."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from rightofway.errors import InputError, is_printable, shown
from rightofway.io.layouts.draft import Draft, Lane, LevelDraft
from rightofway.io.layouts.graphml import LENGTHS, PAIRS, SPEEDS
from rightofway.io.layouts.parts import LONGEST_NAME, number_in
from rightofway.site.geometry import Point
from rightofway.site.layout import Layout, LayoutVertex


def layout_of_graph(graph: Any) -> Layout:
    """Return the layout of a graph, in metres and metres per second, with y upwards.

    Parameters
    ----------
    graph
        A `networkx` graph, directed or not. Nodes are named by their text, ``str(node)``. A node's
        position is its ``x`` and ``y``, or a pair ``pos``, ``coords``, ``coordinates`` or
        ``position``, or the node, if it is a pair of numbers; nodes with ``parking`` or
        ``charging`` are such places. Edges may have ``length``, ``distance`` or ``weight``, and
        ``max_speed``, ``maxspeed`` or ``speed_limit``.

    Raises
    ------
    InputError
        With every node without a position, and every value that is no number.

    Examples
    --------
    >>> import networkx
    >>> graph = networkx.DiGraph()
    >>> graph.add_node("dock", x=0, y=0, charging=True)
    >>> graph.add_node("shelf", pos=(3, 4))
    >>> graph.add_edge("dock", "shelf", max_speed=0.5)
    >>> layout_of_graph(graph).levels[0].edges[0].length
    Fraction(5, 1)
    """
    if not all(hasattr(graph, name) for name in ("nodes", "edges", "is_directed")):
        raise InputError.at("graph", f"{shown(graph)} is no graph (give a networkx graph)")
    draft = Draft("networkx graph")
    level = draft.level()
    for node, data in graph.nodes(data=True):
        draft.faults.attempt("", _add_node, level, node, data)
    for tail, head, data in graph.edges(data=True):
        draft.faults.attempt("", _add_edge, level, (tail, head), data, graph.is_directed())
    return draft.layout()


def _add_node(level: LevelDraft, node: object, data: Mapping[str, Any]) -> None:
    name = str(node)
    place = f"node {shown(name)}"
    if not is_printable(name) or len(name) > LONGEST_NAME:
        raise InputError.at(place, "is no name (give printable text)")
    level.add(
        LayoutVertex(
            name=name,
            at=_position(node, data, place),
            is_parking=bool(data.get("parking")),
            is_charging=bool(data.get("charging")),
        ),
        place,
    )


def _position(node: Any, data: Mapping[str, Any], place: str) -> Point:
    pair: Any = next((data[name] for name in PAIRS if name in data), node)
    if {"x", "y"} <= data.keys():
        pair = data["x"], data["y"]
    if isinstance(pair, str) or not hasattr(pair, "__len__") or len(pair) != 2:  # noqa: PLR2004
        raise InputError.at(place, f"has no position (give x and y, or {PAIRS[0]}=(x, y))")
    x, y = pair
    return number_in(x, place), number_in(y, place)


def _add_edge(
    level: LevelDraft, ends: tuple[object, object], data: Mapping[str, Any], is_directed: bool
) -> None:
    tail, head = map(str, ends)
    place = f"edge {shown(tail)} to {shown(head)}"

    def first(names: tuple[str, ...]) -> tuple[str, Fraction | None]:
        found = next((name for name in names if data.get(name) is not None), "")
        return found, number_in(data[found], place) if found else None

    (attribute, length), (_, max_speed) = first(LENGTHS), first(SPEEDS)
    for one, other in ((tail, head),) if is_directed else ((tail, head), (head, tail)):
        level.connect(
            Lane(
                place=place,
                tail=one,
                head=other,
                length=length,
                attribute=attribute,
                max_speed=max_speed,
            )
        )
