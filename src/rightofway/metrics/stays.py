"""What each visit of a track is for: how long it has to last, and the drive that ends it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Itinerary, Scenario, Stage, Tick, Track, least_dwell

__all__ = ["Stays", "stays_of"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stays:
    """The visits of one robot.

    Attributes
    ----------
    dwell
        How long each visit lasts at least before the robot drives on [ticks]; int64, shape (n,).
        For the last visit: how long the robot still works there.
    drive
        The edge that ends each visit [ticks], 0 for the last one; int64, shape (n,).
    waits
        What each visit lasts beyond that [ticks], 0 for the last one; int64, shape (n,).
    completion
        When the robot has done its work and entered its last vertex [ticks].
    """

    dwell: NDArray[np.int64]
    drive: NDArray[np.int64]
    waits: NDArray[np.int64]
    completion: Tick


def stays_of(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Stays, ...]:
    """Take the tracks of a fleet to pieces.

    Notes
    -----
    Stages are matched to visits greedily: a robot works as early as it can, on several stages in
    one visit if they follow each other at one vertex. Of tracks that break the rules, a move
    without an edge takes no time, and what comes after a missed stop is waiting.
    """
    roadmap = scenario.roadmap

    @cache
    def length_class(tail: int, head: int) -> int | None:
        edge = roadmap.edge(tail, head)
        return None if edge is None else int(roadmap.length_class[edge])

    return tuple(
        _stays(itinerary, track, length_class)
        for itinerary, track in zip(scenario.timing.itineraries, tracks, strict=True)
    )


def _stays(
    itinerary: Itinerary, track: Track, length_class: Callable[[int, int], int | None]
) -> Stays:
    moves = [length_class(*move) for move in pairwise(track.vertices.tolist())]
    ticks = [0 if length is None else itinerary.edge_ticks[length] for length in moves]
    drive = np.array([*ticks, 0], np.int64)
    spare = np.append(np.diff(track.enter), 0) - drive
    dwell = np.zeros(len(track), np.int64)
    last = len(track) - 1
    for visit, stages in _served(itinerary, track, spare).items():
        dwell[visit] = least_dwell(stages, leaves=visit < last)
    waits = spare - dwell
    waits[last] = 0
    return Stays(
        dwell=dwell, drive=drive, waits=waits, completion=Tick(int(track.enter[last] + dwell[last]))
    )


def _served(itinerary: Itinerary, track: Track, spare: NDArray[np.int64]) -> dict[int, list[Stage]]:
    """Return the stages that each visit serves."""
    vertices, left = track.vertices.tolist(), spare.tolist()
    served: defaultdict[int, list[Stage]] = defaultdict(list)
    visit = 0
    for stage in itinerary.stages:
        need = stage.work + stage.turn
        found = next(_long_enough(vertices, left, stage.vertex, need, visit), None)
        if found is None:
            break
        visit = found
        served[visit].append(stage)
        left[visit] -= need
    return served


def _long_enough(
    vertices: list[int], left: list[int], vertex: int, need: int, begin: int
) -> Iterator[int]:
    last = len(vertices) - 1
    for visit in range(begin, last + 1):
        if vertices[visit] == vertex and (visit == last or left[visit] >= need):
            yield visit
