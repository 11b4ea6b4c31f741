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

    All tracks lie side by side in the arrays that the answer looks into.
    """
    itineraries = scenario.problem.itineraries
    ends = np.cumsum([len(track) for track in tracks])
    enter = np.concatenate([track.enter for track in tracks])
    drive, dwell = _drives(scenario, tracks), np.zeros(len(enter), np.int64)
    waits = np.append(np.diff(enter), 0) - drive
    waits[ends - 1] = 0
    owns = [slice(end - len(track), end) for track, end in zip(tracks, ends.tolist(), strict=True)]
    for own, track, itinerary in zip(owns, tracks, itineraries, strict=True):
        dwell[own] = _dwell(itinerary, track, waits[own])
    completion = (enter + dwell)[ends - 1].tolist()
    waits -= dwell
    waits[ends - 1] = 0
    return tuple(
        Stays(dwell=dwell[own], drive=drive[own], waits=waits[own], completion=Tick(done))
        for own, done in zip(owns, completion, strict=True)
    )


def _drives(scenario: Scenario, tracks: Sequence[Track]) -> NDArray[np.int64]:
    """Return the ticks of the edge after each visit of all tracks, 0 where there is none."""
    itineraries, lengths = scenario.problem.itineraries, [len(track) for track in tracks]
    paces = {itinerary.edge_ticks: None for itinerary in itineraries}
    row = {pace: index for index, pace in enumerate(paces)}
    rows = np.repeat([row[itinerary.edge_ticks] for itinerary in itineraries], lengths)
    by_class = np.array([[*pace, 0] for pace in paces], np.int64)
    drives: NDArray[np.int64] = by_class[rows, _edge_classes(scenario.roadmap, tracks)]
    drives[np.cumsum(lengths) - 1] = 0
    return drives


def _edge_classes(roadmap: Roadmap, tracks: Sequence[Track]) -> NDArray[np.int32]:
    """Return how long the edge from each vertex to the one after it is, -1 where there is none."""
    n_vertices = roadmap.n_vertices
    tails = np.repeat(np.arange(n_vertices), np.diff(roadmap.indptr))
    keys = tails * n_vertices + roadmap.heads
    order = np.argsort(keys, kind="stable")
    keys = np.append(keys[order], -1)  # the last one is no edge
    length_class = np.append(roadmap.length_class[order], -1)
    vertices = np.concatenate([track.vertices for track in tracks]).astype(np.int64)
    heads = np.append(vertices[1:], -1)
    wanted = vertices * n_vertices + heads
    found = np.searchsorted(keys[:-1], wanted)
    is_edge = (keys[found] == wanted) & (heads >= 0) & (heads < n_vertices)
    return np.where(is_edge, length_class[found], -1)


def _dwell(itinerary: Itinerary, track: Track, spare: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return how long each visit lasts at least, where it lasts so much longer than its drive."""
    dwell = np.zeros(len(track), np.int64)
    last = len(track) - 1
    for visit, stages in _served(itinerary, track, spare).items():
        dwell[visit] = least_dwell(stages, leaves=visit < last)
    return dwell


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
