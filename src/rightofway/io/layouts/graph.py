"""Graphs of `networkx` as layouts; attributes have the names that they have in GraphML."""

from __future__ import annotations

from typing import Any

from rightofway.errors import InputError, quote
from rightofway.io.layouts.attributes import PAIRS, Reading, add_lanes, add_vertex
from rightofway.io.layouts.draft import LayoutDraft
from rightofway.io.source import Source
from rightofway.kinds.arguments import checks_arguments
from rightofway.site.geometry import Point
from rightofway.site.layout import Layout


@checks_arguments
def make_layout_of_graph(graph: Any) -> Layout:
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
        With every node without a position, and every value that is not a number.

    Examples
    --------
    >>> import networkx
    >>> graph = networkx.DiGraph()
    >>> graph.add_node("dock", x=0, y=0, charging=True)
    >>> graph.add_node("shelf", pos=(3, 4))
    >>> graph.add_edge("dock", "shelf", max_speed=0.5)
    >>> make_layout_of_graph(graph).levels[0].edges[0].length
    Fraction(5, 1)
    """
    if not all(hasattr(graph, name) for name in ("nodes", "edges", "is_directed")):
        raise InputError.at("graph", f"{quote(graph)} is no graph (give a networkx graph)")
    draft = LayoutDraft("networkx graph")
    reading, both_ways = Reading(draft.begin_level(), draft), not graph.is_directed()
    for node, data in graph.nodes(data=True):
        name = f"node {quote(str(node))}"
        own = Source(dict(data), (name,))
        draft.attempt_vertex(str(node), _add_node, reading, node, own)
    for tail, head, data in graph.edges(data=True):
        name = f"edge {quote(str(tail))} to {quote(str(head))}"
        own, ends = Source(dict(data), (name,)), (str(tail), str(head))
        draft.faults.attempt("", add_lanes, reading, own, *ends, both_ways)
    return draft.make_layout()


def _add_node(reading: Reading, node: object, own: Source) -> None:
    name = Source(str(node), own.path).read_text()
    add_vertex(reading, own, name, _read_position(node, own))


def _read_position(node: Any, own: Source) -> Point:
    pair = own.get(*PAIRS) or Source(node, own.path)
    if own.get("x") and own.get("y"):
        return own.need("x").number(), own.need("y").number()
    if isinstance(pair.value, str) or not hasattr(pair.value, "__len__") or len(pair.value) != 2:  # noqa: PLR2004
        raise own.make_fault(f"has no position (give x and y, or {PAIRS[0]}=(x, y))")
    x, y = pair.value
    return pair.make_child(0, x).number(), pair.make_child(1, y).number()
