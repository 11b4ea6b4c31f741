"""Two CSV files: nodes with name, x and y, and edges with from and to, in metres, y up."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from rightofway.errors import InputError, shown
from rightofway.io.layouts.draft import Draft, Lane, LevelDraft
from rightofway.io.layouts.parts import Part, number_in
from rightofway.io.text import is_regular, read_text
from rightofway.site.layout import Layout, LayoutVertex

NAMES = ("name", "id", "node", "vertex", "nodeid", "node_id")
TAILS = ("from", "source", "start", "tail", "startid")
HEADS = ("to", "target", "end", "head", "endid")
LENGTHS = ("length", "distance", "weight")
SPEEDS = ("max_speed", "maxspeed", "speed_limit")
LONGEST_HEADINGS = 10_000
"""Characters of a row of headings; a JSON file may be one line of millions."""

TRUE, FALSE = ("true", "yes", "1"), ("false", "no", "0", "")

Row = tuple[int, dict[str, str]]


def recognizes(text: str) -> bool:
    """Return whether a text begins with the headings of nodes or of edges."""
    headings = set(_headings(text))
    return {"x", "y"} <= headings or (
        any(name in headings for name in TAILS) and any(name in headings for name in HEADS)
    )


def _headings(text: str) -> list[str]:
    first = text[:LONGEST_HEADINGS].partition("\n")[0]
    return [word.strip().strip('"').lower() for word in re.split("[,;\t]", first)]


def read(text: str, path: Path) -> Layout:
    """Return the layout of a file of nodes and the file of edges beside it, or the other way round.

    Raises
    ------
    InputError
        If the other file is not there, and with every row that cannot be used.
    """
    beside = _beside(path, "x" in _headings(text))
    other = read_text(beside)
    if not recognizes(other):
        raise InputError.at("", "has no headings of nodes or edges (give name, x, y or from, to)",
                            str(beside))  # fmt: skip
    nodes, edges = (text, other) if "x" in _headings(text) else (other, text)
    draft = Draft("CSV pair")
    level = draft.level()
    for line, row in _rows(nodes):
        draft.faults.attempt("", _add_node, level, line, row)
    for line, row in _rows(edges):
        draft.faults.attempt("", _add_edge, level, line, row)
    return draft.layout()


def _beside(path: Path, is_nodes: bool) -> Path:
    """Return the file of edges beside one of nodes, or the other way round."""
    here, there = (("nodes", "vertices", "points"), ("edges", "lanes", "links"))
    if not is_nodes:
        here, there = there, here
    for word in here:
        if word in path.name:
            for other in there:
                found = path.with_name(path.name.replace(word, other))
                if is_regular(found):
                    return found
    mine, wanted = ("nodes", "edges") if is_nodes else ("edges", "nodes")
    remedy = f"name this file {mine}.csv and put {wanted}.csv beside it"
    raise InputError.at("", f"these are {mine} without their {wanted} ({remedy})")


def _rows(text: str) -> Iterator[Row]:
    """Yield the rows by heading, in lower case, with their lines."""
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=first.count)
    reader = csv.reader(io.StringIO(text), delimiter=delimiter)
    headings: list[str] = []
    try:
        for cells in reader:
            if not headings:
                headings = [cell.strip().lower() for cell in cells]
            elif any(cell.strip() for cell in cells):
                yield reader.line_num, dict(zip(headings, map(str.strip, cells), strict=False))
    except csv.Error as error:
        raise InputError.at(f"line {reader.line_num}", f"{error} (mend the row)") from None


def _first(row: dict[str, str], names: tuple[str, ...], place: str) -> str:
    found = next((row[name] for name in names if row.get(name)), "")
    if not found:
        raise InputError.at(place, f"has no {names[0]} (add it)")
    return Part(found, (place,)).text()


def _optional(row: dict[str, str], names: tuple[str, ...], place: str) -> Fraction | None:
    found = next((row[name] for name in names if row.get(name)), None)
    return None if found is None else number_in(found, place)


def _flag(row: dict[str, str], names: tuple[str, ...], place: str) -> bool:
    found = next((row[name].lower() for name in names if row.get(name)), "")
    if found not in (*TRUE, *FALSE):
        raise InputError.at(place, f"{shown(found)} is neither true nor false (mend it)")
    return found in TRUE


def _add_node(level: LevelDraft, line: int, row: dict[str, str]) -> None:
    place = f"line {line}"
    level.add(
        LayoutVertex(
            name=_first(row, NAMES, place),
            at=(number_in(row.get("x"), place), number_in(row.get("y"), place)),
            is_parking=_flag(row, ("parking", "is_parking"), place),
            is_charging=_flag(row, ("charging", "is_charging"), place),
        ),
        place,
    )


def _add_edge(level: LevelDraft, line: int, row: dict[str, str]) -> None:
    place = f"line {line}"
    tail, head = _first(row, TAILS, place), _first(row, HEADS, place)
    both = _flag(row, ("both_ways", "bidirectional"), place)
    for one, other in ((tail, head), (head, tail)) if both else ((tail, head),):
        level.connect(
            Lane(
                place=place,
                tail=one,
                head=other,
                length=_optional(row, LENGTHS, place),
                max_speed=_optional(row, SPEEDS, place),
            )
        )
