"""Two CSV files: nodes with name, x and y, and edges with from and to, in metres, y up."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from pathlib import Path

from rightofway.errors import InputError, Location
from rightofway.io.content import is_regular, read_text
from rightofway.io.faults import read_both
from rightofway.io.layouts.attributes import (
    BOTH_WAYS,
    HEADS,
    NAMES,
    TAILS,
    Reading,
    add_lanes,
    add_vertex,
)
from rightofway.io.layouts.draft import LayoutDraft, find_name
from rightofway.io.source import Source
from rightofway.site.layout import Layout

LONGEST_HEADINGS = 10_000
"""Characters of a row of headings; a JSON file may be one line of millions."""


def recognizes(text: str) -> bool:
    """Return whether a text begins with the headings of nodes or of edges."""
    headings = set(_read_headings(text))
    return {"x", "y"} <= headings or (
        any(name in headings for name in TAILS) and any(name in headings for name in HEADS)
    )


def _read_headings(text: str) -> list[str]:
    first = text[:LONGEST_HEADINGS].partition("\n")[0]
    return [word.strip().strip('"').lower() for word in re.split("[,;\t]", first)]


def read(text: str, path: Path) -> Layout:
    """Return the layout of a file of nodes and the file of edges beside it, or the other way round.

    Raises
    ------
    InputError
        If the other file is not there, and with every row that cannot be used.
    """
    beside = _find_partner(path, "x" in _read_headings(text))
    other = read_text(beside)
    if not recognizes(other):
        raise InputError.at("", "has no headings of nodes or edges (give name, x, y or from, to)",
                            str(beside))  # fmt: skip
    nodes, edges = (text, other) if "x" in _read_headings(text) else (other, text)
    draft = LayoutDraft("CSV pair")
    reading = Reading(draft.begin_level(), draft)
    for row in _read_rows(nodes):
        draft.attempt_vertex(find_name(row, *NAMES), _add_node, reading, row)
    for row in _read_rows(edges):
        draft.faults.attempt("", _add_edge, reading, row)
    return draft.make_layout()


def _find_partner(path: Path, is_nodes: bool) -> Path:
    """Return the file of edges beside one of nodes, or the other way round."""
    own_words, other_words = (("nodes", "vertices", "points"), ("edges", "lanes", "links"))
    if not is_nodes:
        own_words, other_words = other_words, own_words
    for word in own_words:
        if word in path.name:
            for other in other_words:
                beside = path.with_name(path.name.replace(word, other))
                if is_regular(beside):
                    return beside
    mine, wanted = ("nodes", "edges") if is_nodes else ("edges", "nodes")
    remedy = f"name this file {mine}.csv and put {wanted}.csv beside it"
    raise InputError.at("", f"these are {mine} without their {wanted} ({remedy})")


def _read_rows(text: str) -> Iterator[Source]:
    """Yield the rows as mappings from headings in lower case, without empty values."""
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=first.count)
    reader = csv.reader(io.StringIO(text), delimiter=delimiter)
    headings: list[str] = []
    try:
        for cells in reader:
            if not headings:
                headings = [cell.strip().lower() for cell in cells]
            elif row := {
                heading: cell.strip()
                for heading, cell in zip(headings, cells, strict=False)
                if cell.strip()
            }:
                yield Source(row, line=reader.line_num)
    except csv.Error as error:
        raise InputError.at(Location(line=reader.line_num), f"{error} (mend the row)") from None


def _add_node(reading: Reading, row: Source) -> None:
    at = read_both(lambda: row.need("x").number(), lambda: row.need("y").number())
    add_vertex(reading, row, row.need(*NAMES).read_text(), at)


def _add_edge(reading: Reading, row: Source) -> None:
    both = row.get(*BOTH_WAYS)
    ends = read_both(lambda: row.need(*TAILS).read_text(), lambda: row.need(*HEADS).read_text())
    add_lanes(reading, row, *ends, both is not None and both.read_flag())
