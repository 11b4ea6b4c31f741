"""What each visit of a track is for: the stages it serves, its least dwell, the drive that ends it.

A stage is served in the first visit of its vertex, from the one that serves the stage before it on,
that lasts long enough beyond its drive; several stages that follow each other at one vertex may
share a visit. The last visit of a track never ends, so it is long enough for any stage.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rightofway.model.plan import Track
from rightofway.model.problem import Stage, least_dwell
from rightofway.model.scenario import Scenario
from rightofway.model.units import NEVER, Tick

__all__ = [
    "Stays",
    "completions_of",
    "flowtime_of",
    "least_dwells",
    "serving_visits",
    "stays_of",
]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stays:
    """The visits of one robot.

    Attributes
    ----------
    dwell
        The least ticks of each visit before the robot drives on: the work and turning of the stages
        that it serves; int64, shape (n,). For the last visit: the work that is left to do there.
    drive
        Ticks of the edge that ends each visit, 0 for the last one; int64, shape (n,).
    waits
        Ticks of each visit beyond both, 0 for the last one; int64, shape (n,).
    serves
        The visit that serves each stage. It ends before the first stage that no visit serves.
    completion
        When the robot has entered its last vertex and done the work there [ticks].
    """

    dwell: NDArray[np.int64]
    drive: NDArray[np.int64]
    waits: NDArray[np.int64]
    serves: tuple[int, ...]
    completion: Tick


def serving_visits(
    stages: Sequence[Stage], vertices: NDArray[np.int32], spare: NDArray[np.int64]
) -> list[int]:
    """Return the visit that serves each stage, up to the first stage that no visit serves.

    Parameters
    ----------
    stages
        What the robot has to do, in order.
    vertices, spare
        Where each visit is, and how long it lasts beyond its drive [ticks]; shape (n,).
    """
    visits_at: dict[int, list[int]] = {}
    used: dict[int, int] = {}
    serves: list[int] = []
    visit = 0
    for stage in stages:
        if stage.vertex not in visits_at:
            visits_at[stage.vertex] = np.flatnonzero(vertices == stage.vertex).tolist()
        there, need = visits_at[stage.vertex], stage.work + stage.turn
        place = bisect_left(there, visit)
        while place < len(there) and spare[there[place]] - used.get(there[place], 0) < need:
            place += 1
        if place == len(there):
            break
        visit = there[place]
        used[visit] = used.get(visit, 0) + need
        serves.append(visit)
    return serves


def least_dwells(
    stages: Sequence[Stage], serves: Sequence[int], n_visits: int
) -> NDArray[np.int64]:
    """Return the least ticks of each visit, without its drive, given the visits of the stages."""
    dwell = np.zeros(n_visits, np.int64)
    for stage, visit in zip(stages, serves, strict=False):
        dwell[visit] += least_dwell([stage], leaves=visit < n_visits - 1)
    return dwell


def stays_of(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Stays, ...]:
    """Return what the visits of a fleet are for.

    Notes
    -----
    Of tracks that break the rules, a move without an edge takes no time, and what comes after a
    missed stop is waiting. All tracks lie side by side in the arrays that the answer looks into.
    """
    ends = np.cumsum([len(track) for track in tracks])
    enter = np.concatenate([track.enter for track in tracks])
    drive, dwell = _drives(scenario, tracks, ends), np.zeros(len(enter), np.int64)
    spare = np.append(np.diff(enter), 0) - drive
    spare[ends - 1] = NEVER
    owns = [slice(end - len(track), end) for track, end in zip(tracks, ends.tolist(), strict=True)]
    all_serves = []
    for own, track, itinerary in zip(owns, tracks, scenario.problem.itineraries, strict=True):
        serves = serving_visits(itinerary.stages, track.vertices, spare[own])
        dwell[own] = least_dwells(itinerary.stages, serves, len(track))
        all_serves.append(tuple(serves))
    completion = (enter + dwell)[ends - 1].tolist()
    waits = spare - dwell
    waits[ends - 1] = 0
    return tuple(
        Stays(
            dwell=dwell[own],
            drive=drive[own],
            waits=waits[own],
            serves=serves,
            completion=Tick(done),
        )
        for own, serves, done in zip(owns, all_serves, completion, strict=True)
    )


def completions_of(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Tick, ...]:
    """Return when each robot has done its work and entered its last vertex [ticks]."""
    return tuple(stay.completion for stay in stays_of(scenario, tracks))


def flowtime_of(scenario: Scenario, tracks: Sequence[Track]) -> Tick:
    """Return the sum of the robots' completion times [ticks]."""
    return Tick(sum(completions_of(scenario, tracks)))


def _drives(
    scenario: Scenario, tracks: Sequence[Track], ends: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the ticks of the edge after each visit of all tracks, 0 where there is none."""
    roadmap, itineraries = scenario.roadmap, scenario.problem.itineraries
    vertices = np.concatenate([track.vertices for track in tracks])
    vertices[(vertices < 0) | (vertices >= roadmap.n_vertices)] = -1
    edges = np.append(roadmap.edges(vertices[:-1], vertices[1:]), -1)
    edges[vertices < 0] = -1
    edges[ends - 1] = -1
    row = {pace: k for k, pace in enumerate({one.edge_ticks: None for one in itineraries})}
    by_class = np.array([[*pace, 0] for pace in row], np.int64)  # the last column: no edge
    length_class = np.append(roadmap.length_class, -1)
    rows = np.repeat(
        [row[itinerary.edge_ticks] for itinerary in itineraries], [len(track) for track in tracks]
    )
    drives: NDArray[np.int64] = by_class[rows, length_class[edges]]
    return drives
