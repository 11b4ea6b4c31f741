"""Which formats of layouts there are, and how a file is recognized: by content, not by its name."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

from rightofway.errors import InputError, Location, name_file
from rightofway.extras import load_plugins
from rightofway.facts import Fact
from rightofway.io.collector import pause_garbage_collection
from rightofway.io.content import is_own_document, read_text, refuse_long, refuse_picture
from rightofway.io.json_text import parse_json
from rightofway.io.layouts import csv_pair, graphml, lif, nav2, open_rmf, opentcs, ros_map
from rightofway.io.layouts.xml_tree import Element, parse_xml
from rightofway.io.locations import add_lines
from rightofway.io.movingai import load_map
from rightofway.io.yaml_text import parse_yaml
from rightofway.site.layout import Layout
from rightofway.site.occupancy import CellMap, Occupancy

GROUP = "rightofway.layouts"
"""Entry points of this group are further formats."""

NO_LAYOUTS = (".map", ".scen", ".toml", ".xlsx", ".xlsm")
"""Endings of files whose format is recognised by the name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutFormat:
    """A format of layouts.

    Attributes
    ----------
    summary
        Its kind, in a few words.
    content
        The input of `recognizes` and `read`: plain data of JSON or YAML, the root of an XML
        file, or text.
    recognizes
        Returns whether a content is of this format.
    read
        Returns the layout of a content; the path is for files beside it.
    """

    summary: str
    content: Literal["data", "xml", "text"]
    recognizes: Callable[[Any], bool]
    read: Callable[[Any, Path], Layout | Occupancy | CellMap]


def _is_movingai(text: str) -> bool:
    header = text.lstrip().split("\n", 4)[:4]
    return any(line.strip() == "map" for line in header) or header[0].startswith("type ")


def _own() -> dict[str, LayoutFormat]:
    return {
        "lif": LayoutFormat(
            summary="Layout Interchange Format of the VDMA, 1.0.0 and 2.0.0", content="data",
            recognizes=lif.recognizes, read=lambda content, _: lif.read(content),
        ),
        "nav2": LayoutFormat(
            summary="route graph of Nav2, GeoJSON", content="data",
            recognizes=nav2.recognizes, read=lambda content, _: nav2.read(content),
        ),
        "open-rmf": LayoutFormat(
            summary="navigation graph or building of Open-RMF", content="data",
            recognizes=open_rmf.recognizes, read=open_rmf.read,
        ),
        "ros-map": LayoutFormat(
            summary="map of the ROS map server, with its picture", content="data",
            recognizes=ros_map.recognizes, read=ros_map.read,
        ),
        "opentcs": LayoutFormat(
            summary="plant model of openTCS, 0.0.2 to 7.0.0", content="xml",
            recognizes=opentcs.recognizes, read=lambda content, _: opentcs.read(content),
        ),
        "graphml": LayoutFormat(
            summary="GraphML with coordinates", content="xml",
            recognizes=graphml.recognizes, read=lambda content, _: graphml.read(content),
        ),
        "movingai": LayoutFormat(
            summary="map of the MovingAI benchmarks", content="text",
            recognizes=_is_movingai, read=lambda _, path: CellMap(lines=load_map(path)),
        ),
        "csv": LayoutFormat(
            summary="two CSV files, nodes and edges", content="text",
            recognizes=csv_pair.recognizes, read=csv_pair.read,
        ),
    }  # fmt: skip


@cache
def list_layout_formats() -> dict[str, LayoutFormat]:
    """Return the formats of layouts by name: ours, and those of other packages."""
    own = _own()
    return {**own, **load_plugins(GROUP, LayoutFormat), **own}


def read_layout(path: Path | str) -> Layout | Occupancy | CellMap:
    """Return the layout of a file in any known format.

    Parameters
    ----------
    path
        A file in one of the `list_layout_formats`.

    Raises
    ------
    InputError
        If the format is not known, and with every fault, its place and remedy.
    """
    path = Path(path)
    with name_file(str(path)), pause_garbage_collection():
        refuse_picture(path)
        text = read_text(path)
        opened = _open(text)
        if opened is None:
            message = f"this is no layout (known: {', '.join(list_layout_formats())})"
            raise InputError.at("", message)
        format_of, content = opened
        try:
            with add_lines(text) if format_of.content == "data" else nullcontext():
                return format_of.read(content, path)
        except RecursionError:
            raise InputError.at("", "it is nested too deeply (is it the right file?)") from None


def is_layout(path: Path | str) -> bool:
    """Return whether a file is a layout, perhaps one with faults.

    Parameters
    ----------
    path
        The file.
    """
    path = Path(path)
    if path.suffix.lower() in NO_LAYOUTS and path.suffix.lower() != ".map":
        return False
    try:
        text = read_text(path)
        return not is_own_document(text) and _open(text) is not None
    except InputError:
        return False


def refuse_layout(path: Path, text: str) -> None:
    """Refuse a layout where a scenario or a plan is wanted, with a remedy in words.

    Parameters
    ----------
    path
        The file.
    text
        Its content, which is no document of this package.

    Raises
    ------
    InputError
        If it is a layout.
    """
    if path.suffix.lower() in NO_LAYOUTS:
        return
    try:
        if _open(text) is None:
            return
    except InputError:
        if not text.lstrip().startswith("<"):
            return
        raise
    try:
        description = str(describe_layout(read_layout(path)))
    except InputError as error:
        first = error.faults[0].name_file("")
        description = f"a layout with a fault: {first}; mend it first"
    name = path.name
    remedy = f"write a scenario with map: {{layout: {name}}}"
    example = f"`rightofway convert {path} -o scenario.yaml` writes one"
    raise InputError.at("", f"this is {description} ({remedy}; {example})")


def describe_layout(layout: Layout | Occupancy | CellMap) -> Fact:
    """Return the kind and size of a layout: ``a LIF layout with 5 vertices, 6 lanes``.

    Parameters
    ----------
    layout
        The layout.
    """
    if isinstance(layout, Occupancy):
        rows, columns = layout.pixels.shape
        return Fact("ROS map", columns=columns, rows=rows)
    if isinstance(layout, CellMap):
        columns, rows = len(layout.lines[0]), len(layout.lines)
        return Fact("MovingAI map", columns=columns, rows=rows)
    levels = layout.levels
    counts = {
        "n_levels": len(levels) if len(levels) > 1 else 0,
        "n_vertices": sum(len(level.vertices) for level in levels),
        "n_lanes": sum(len(level.edges) for level in levels),
        "n_stations": sum(len(level.stations) for level in levels),
    }
    parts = tuple(Fact(kind, number=count) for kind, count in counts.items() if count)
    article = "layout with vowel" if layout.kind[0].lower() in "aeio" else "layout"
    return Fact(article, kind=layout.kind, parts=parts)


def _open(text: str) -> tuple[LayoutFormat, Any] | None:
    """Return the format of a text and its content, or None for a text in no format."""
    refuse_long(text)
    formats = list_layout_formats().values()
    start = text.lstrip()[:1]
    texts = (
        layout_format
        for layout_format in formats
        if layout_format.content == "text" and layout_format.recognizes(text)
    )
    if start == "<":
        kind, content = "xml", parse_xml(text, graphml.LANE)
    elif first := next(texts, None):
        return first, text
    else:
        kind = "data"
        content = parse_json(text) if start in {"{", "["} else parse_yaml(text, number_keys=True)
    known = (
        layout_format
        for layout_format in formats
        if layout_format.content == kind and layout_format.recognizes(content)
    )
    first = next(known, None)
    if first is None and isinstance(content, Element):
        message = f"an XML file of <{content.name}> is no layout (known: GraphML and openTCS)"
        raise InputError.at(Location(line=content.line), message)
    return None if first is None else (first, content)
