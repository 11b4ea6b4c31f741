"""What each visit of a track is for: how long it has to last, and the drive that ends it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Itinerary, Roadmap, Scenario, Stage, Tick, Track, least_dwell

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
    edges = _Edges(scenario.roadmap)
    return tuple(
        _stays(itinerary, track, edges.ticks(track.vertices, itinerary.edge_ticks))
        for itinerary, track in zip(scenario.timing.itineraries, tracks, strict=True)
    )


class _Edges:
    """The edges of a roadmap, found by where they lead from and to, many at a time."""

    def __init__(self, roadmap: Roadmap) -> None:
        self.n_vertices = roadmap.n_vertices
        tails = np.repeat(np.arange(self.n_vertices), np.diff(roadmap.indptr))
        keys = tails * self.n_vertices + roadmap.heads
        order = np.argsort(keys, kind="stable")
        self.keys = np.append(keys[order], -1)  # the last one is no edge
        self.length_class = np.append(roadmap.length_class[order], -1)

    def ticks(self, vertices: NDArray[np.int32], edge_ticks: Sequence[Tick]) -> NDArray[np.int64]:
        """Return the ticks of the edge after each vertex of a track, 0 where there is none."""
        tails, heads = vertices[:-1].astype(np.int64), vertices[1:].astype(np.int64)
        keys = tails * self.n_vertices + heads
        found = np.searchsorted(self.keys[:-1], keys)
        is_edge = (self.keys[found] == keys) & (heads >= 0) & (heads < self.n_vertices)
        by_class = np.array([*edge_ticks, 0], np.int64)
        return np.append(by_class[np.where(is_edge, self.length_class[found], -1)], 0)


def _stays(itinerary: Itinerary, track: Track, drive: NDArray[np.int64]) -> Stays:
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
    left = spare.copy()
    served: defaultdict[int, list[Stage]] = defaultdict(list)
    visit, last = 0, len(track) - 1
    for stage in itinerary.stages:
        need = stage.work + stage.turn
        there = visit + np.flatnonzero(track.vertices[visit:] == stage.vertex)
        long_enough = there[(there == last) | (left[there] >= need)]
        if not len(long_enough):
            break
        visit = int(long_enough[0])
        served[visit].append(stage)
        left[visit] -= need
    return served
