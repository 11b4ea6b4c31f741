"""Vertices and lanes whose attributes have no fixed names: of GraphML, CSV files and networkx.

Each name is one that some program writes; the first that is there counts.
"""

from __future__ import annotations

from rightofway.io.layouts.draft import LevelDraft
from rightofway.io.source import Source
from rightofway.site.geometry import Point
from rightofway.site.layout import LayoutVertex

PAIRS = ("pos", "coords", "coordinates", "position")
"""Names of attributes that hold x and y together."""

LENGTHS = ("length", "distance", "weight")
SPEEDS = ("max_speed", "maxspeed", "speed_limit")
PARKING, CHARGING = ("parking", "is_parking"), ("charging", "is_charging")


def add_vertex(level: LevelDraft, own: Source, name: str, at: Point) -> None:
    """Add a vertex, which is a parking or charging place if its attributes say it."""
    parking, charging = own.get(*PARKING), own.get(*CHARGING)
    vertex = LayoutVertex(
        name=name,
        at=at,
        is_parking=parking is not None and parking.read_flag(),
        is_charging=charging is not None and charging.read_flag(),
    )
    level.add(vertex, own)


def add_lanes(level: LevelDraft, own: Source, tail: str, head: str, both_ways: bool) -> None:
    """Add the lane from one vertex to another, or both ways, with its length and speed limit."""
    length, max_speed = own.get(*LENGTHS), own.get(*SPEEDS)
    for start, end in ((tail, head), (head, tail)) if both_ways else ((tail, head),):
        level.connect(
            own,
            start,
            end,
            length=None if length is None else length.number(),
            attribute="" if length is None else str(length.path[-1]),
            max_speed=None if max_speed is None else max_speed.number(),
        )
