"""GraphML: a graph whose nodes have coordinates, as x and y, as one text, or as drawn by yEd."""

from __future__ import annotations

import re

from rightofway.errors import quote
from rightofway.facts import Fact
from rightofway.io.faults import read_both
from rightofway.io.layouts.attributes import (
    PAIRS,
    Reading,
    add_lanes,
    add_plain_lanes,
    add_vertex,
)
from rightofway.io.layouts.draft import LayoutDraft, find_name
from rightofway.io.layouts.xml_run import ElementRun
from rightofway.io.layouts.xml_tree import Element
from rightofway.io.source import Source
from rightofway.site.geometry import Point
from rightofway.site.layout import Layout

LANE = "edge"
"""The elements that may be many and alike."""


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
    draft = LayoutDraft("GraphML graph")
    reading = Reading(draft.begin_level(), draft)
    keys = {key.need("id").value: key.need("attr.name", "id").value.lower()
            for key in root.list_all("key")}  # fmt: skip
    for graph in root.list_all("graph"):
        is_directed = graph.value.get("edgedefault") != "undirected"
        for node in graph.list_descendants("node"):
            draft.attempt_vertex(find_name(node, "id"), _add_node, reading, node, keys)
        for edge in graph.list_descendants(LANE):
            draft.faults.attempt("", _add_edge, reading, edge, keys, is_directed)
            if edge.run is not None and _add_run(reading, edge, edge.run, keys, is_directed):
                edge.run = None  # else its elements come next
    return draft.make_layout()


def _read_attributes(element: Element, keys: dict[str, str]) -> Source:
    """Return the values of an element by name in lower case; a key that is not declared counts."""
    attributes = {key.lower(): value for key, value in element.value.items()}
    for data in element.list_all("data"):
        key = data.value.get("key") or data.need("key").value
        attributes[keys.get(key) or key.lower()] = data.content.strip() or None
    return Source(attributes, element.path, element.line)


def _add_node(reading: Reading, node: Element, keys: dict[str, str]) -> None:
    own, name = _read_attributes(node, keys), node.need("id").read_text()
    drawn, pair = next(node.list_descendants("Geometry"), None), own.get(*PAIRS)
    if own.get("x") and own.get("y"):
        at = read_both(own.need("x").number, own.need("y").number)
    elif pair is not None:
        at = _read_pair(pair)
    elif drawn is not None:
        reading.draft.repair(Fact("node where it is drawn"), name)
        half = [(drawn.get(key) or Source(0)).number() / 2 for key in ("width", "height")]
        at = drawn.need("x").number() + half[0], -drawn.need("y").number() - half[1]
    else:
        known = ", ".join(("x and y", *PAIRS))
        raise node.make_fault(f"the node {quote(name)} has no coordinates (give one of {known})")
    add_vertex(reading, own, name, at)


def _read_pair(pair: Source) -> Point:
    """Return the point of a text like ``70,182`` or ``(70, 182)``."""
    numbers = re.split(r"[,;\s]+", pair.value.strip("()[] \t\n"))
    if len(numbers) not in {2, 3}:
        raise pair.make_fault(f"{quote(pair.value)} is no point (give x,y)")
    return pair.make_child(0, numbers[0]).number(), pair.make_child(1, numbers[1]).number()


def _add_edge(reading: Reading, edge: Element, keys: dict[str, str], is_directed: bool) -> None:
    own, (tail, head) = _read_attributes(edge, keys), map(edge.value.get, ("source", "target"))
    if tail is None or head is None:
        edge.need("source" if tail is None else "target")
    directed = own.get("directed")
    is_one_way = is_directed if directed is None else directed.read_flag()
    add_lanes(reading, own, tail, head, not is_one_way)


def _add_run(
    reading: Reading, first: Element, run: ElementRun, keys: dict[str, str], is_directed: bool
) -> bool:
    """Add the lanes that follow one in the same form; return False if it adds none of them.

    It adds them unless one may have a fault, or an attribute that is read in another way.
    """
    columns = iter(run.columns)
    own = {key: next(columns) for key in first.value}
    if not {"source", "target"} <= own.keys():
        return False
    tails, heads = own["source"], own["target"]
    own = {key.lower(): column for key, column in own.items()}
    for data in first.children:
        key = data.value.get("key")
        if data.name != "data" or len(data.value) != 1 or not (key and data.content.strip()):
            return False
        if set(next(columns)) != {key}:
            return False
        own[keys.get(key) or key.lower()] = tuple(text.strip() for text in next(columns))
    del own["source"], own["target"]
    return add_plain_lanes(reading, own, tails, heads, both_ways=not is_directed)
