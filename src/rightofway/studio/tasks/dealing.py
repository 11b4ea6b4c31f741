"""Fleets dealt out at random over a map: the same seed gives the same fleet."""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction
from itertools import islice
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, locate_faults
from rightofway.io.faults import validate
from rightofway.io.scenario.loaded_map import FleetTraits
from rightofway.io.scenario.maps import map_of
from rightofway.io.scenario.shape import MapDocument, UnitsDocument
from rightofway.kinds.table import POSITIVE
from rightofway.metrics.connectivity import find_strong_parts, list_ways
from rightofway.site import Roadmap
from rightofway.studio.messages import Blobs, Emit
from rightofway.units import Units

Result = tuple[Any, ...]


def deal_robots(
    _emit: Emit,
    _blobs: Blobs,
    *,
    document: dict[str, Any],
    folder: str,
    robots: int,
    seed: int,
    speeds: Sequence[Any],
    work: tuple[int, int],
    between: str = "anywhere",
) -> Result:
    """Return robots with homes and targets in the largest part whose places reach each other.

    No two have one home or one target. Speeds go round; work is drawn from the least to the most.
    Between stations, targets are stations and homes are parking and charging places, as long as
    there are some; then homes are no stations.
    """
    with locate_faults("speeds"):
        rates = [POSITIVE.read_at("", speed) for speed in speeds]
    roadmap = _read_roadmap(document, folder, rates)
    part = find_strong_parts(list_ways(roadmap))[0]
    if robots > len(part):
        message = (
            f"{robots} are more than the {len(part)} places that reach each other (give fewer)"
        )
        raise InputError.at("robots", message)
    homes, targets = _draw_places(part, f"homes {seed}"), _draw_places(part, f"targets {seed}")
    if between == "stations":
        drawing = roadmap.drawing
        stations = {int(at) for _, at in drawing.stations}
        spots = {int(at) for at in (*drawing.parking, *drawing.charging)} - stations
        targets.sort(key=lambda place: place not in stations)
        homes.sort(key=lambda place: (place in stations, place not in spots))
    draw = random.Random(f"work {seed}")  # noqa: S311 (no secret depends on it)
    least, most = work
    fleet = []
    for index, home in enumerate(islice(homes, robots)):
        target = next(place for place in targets if place != home or len(targets) == 1)
        targets.remove(target)
        fleet.append(
            {
                "name": f"R{index + 1}",
                "home": roadmap.name(home),
                "target": roadmap.name(target),
                "speed": speeds[index % len(speeds)],
                "work": least + int(draw.random() * (most - least + 1)),
            }
        )
    return ({"robots": fleet},)


def _read_roadmap(document: dict[str, Any], folder: str, speeds: list[Fraction]) -> Roadmap:
    with locate_faults("units"):
        units = validate(UnitsDocument, document.get("units") or {}).get_given("length", "time")
    with locate_faults("map"):
        shape = validate(MapDocument, document.get("map"))
        roadmap = map_of(shape, Path(folder), Units(**units), FleetTraits(speeds=speeds))
    assert roadmap is not None, "speeds are given"
    return roadmap.roadmap


def _draw_places(part: Sequence[int], part_name: str) -> list[int]:
    """Return places in an order that depends on words alone, on every machine and every Python."""
    draw = random.Random(part_name)  # noqa: S311 (no secret depends on it)
    return sorted(part, key=lambda _: draw.random())
