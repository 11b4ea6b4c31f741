"""Vertices and lanes whose attributes have no fixed names: of GraphML, CSV files and networkx.

Each name is one that some program writes; the first that is there counts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import chain
from typing import NamedTuple

from rightofway.errors import InputError
from rightofway.io.layouts.draft import MAX_EDGES, LayoutDraft, LevelDraft
from rightofway.io.source import Source
from rightofway.site.geometry import Point
from rightofway.site.layout import LayoutVertex, name_lanes

PAIRS = ("pos", "coords", "coordinates", "position")
"""Names of attributes that hold x and y together."""

LENGTHS = ("length", "distance", "weight")
SPEEDS = ("max_speed", "maxspeed", "speed_limit")
PARKING, CHARGING = ("parking", "is_parking"), ("charging", "is_charging")
PASSED = ("pass", "is_passed")


NAMES = ("name", "id", "node", "vertex", "nodeid", "node_id")
TAILS = ("from", "source", "start", "tail", "startid")
HEADS = ("to", "target", "end", "head", "endid")
BOTH_WAYS = ("both_ways", "bidirectional")

OF_VERTICES = {"x", "y", "z", *PAIRS, *PARKING, *CHARGING, *PASSED, *NAMES}
OF_LANES = {"id", "directed", *TAILS, *HEADS, *LENGTHS, *SPEEDS, *BOTH_WAYS}
"""All names that are read."""


class Reading(NamedTuple):
    """A level that is read, and its layout."""

    level: LevelDraft
    draft: LayoutDraft


def add_vertex(reading: Reading, own: Source, name: str, at: Point) -> None:
    """Add a vertex: a parking or charging place, or passed only, if its attributes have it."""
    parking, charging, passed = own.get(*PARKING), own.get(*CHARGING), own.get(*PASSED)
    vertex = LayoutVertex(
        name=name,
        at=at,
        is_parking=parking is not None and parking.read_flag(),
        is_charging=charging is not None and charging.read_flag(),
        is_passed=passed is not None and passed.read_flag(),
    )
    reading.level.add(vertex, own)
    reading.draft.note_unused(own, name, OF_VERTICES)


def add_lanes(reading: Reading, own: Source, tail: str, head: str, both_ways: bool) -> None:
    """Add the lane from one vertex to another, or both ways, with its length and speed limit."""
    if not own.value.keys() <= OF_LANES:  # nearly all lanes of a million have no other key
        (name,) = name_lanes([(tail, head)])
        reading.draft.note_unused(own, name, OF_LANES)
    length, max_speed = own.get(*LENGTHS), own.get(*SPEEDS)
    for start, end in ((tail, head), (head, tail)) if both_ways else ((tail, head),):
        reading.level.connect(
            own,
            start,
            end,
            length=None if length is None else length.number(),
            attribute="" if length is None else str(length.path[-1]),
            max_speed=None if max_speed is None else max_speed.number(),
        )


def add_plain_lanes(
    reading: Reading,
    own: Mapping[str, Sequence[str]],
    tails: Sequence[str],
    heads: Sequence[str],
    *,
    both_ways: bool,
) -> bool:
    """Add lanes by columns of their attributes; add none and return False if one needs more care.

    That is a lane with a fault, or with an attribute other than its id, a length and a speed limit.
    """
    lengths, speeds = ([key for key in keys if key in own] for keys in (LENGTHS, SPEEDS))
    vertices, lanes = reading.level.vertices, reading.level.lanes
    if len(lengths) > 1 or len(speeds) > 1 or own.keys() - {"id", *lengths, *speeds}:
        return False
    if not vertices.keys() >= {*tails, *heads}:
        return False
    count = len(tails) * (2 if both_ways else 1)
    if len(lanes.tails) + count > MAX_EDGES:
        return False
    try:
        of_lengths, of_speeds = (
            _read_numbers(own[keys[0]]) if keys else [None] * len(tails)
            for keys in (lengths, speeds)
        )
    except InputError:
        return False
    if any(speed is not None and speed <= 0 for speed in of_speeds):
        return False
    lanes.extend(
        chain.from_iterable(
            ((tail, head, length, speed), (head, tail, length, speed))[: 2 if both_ways else 1]
            for tail, head, length, speed in zip(tails, heads, of_lengths, of_speeds, strict=True)
        ),
        attribute=lengths[0] if lengths else "",
    )
    return True


def _read_numbers(column: Sequence[str]) -> list[Fraction | None]:
    """Return the numbers of texts; equal texts have one number."""
    number_of: dict[str, Fraction | None] = {text: Source(text).number() for text in {*column}}
    return [number_of[text] for text in column]
