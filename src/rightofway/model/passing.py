"""Tracks through passed vertices: by the vertices of chains, and without waits on the way."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rightofway.model.problem import Problem
from rightofway.model.route import Track
from rightofway.site import Roadmap


def unfold_tracks(roadmap: Roadmap, tracks: Sequence[Track]) -> tuple[Track, ...]:
    """Return tracks with the vertices of chains in place of passed vertices."""
    passing = roadmap.passing
    if passing is None:
        return tuple(tracks)
    return tuple(
        Track.of(passing.unfold_route(track.vertices.tolist()), track.enter.tolist())
        if np.isin(track.vertices, list(passing.vertices)).any()
        else track
        for track in tracks
    )


def wait_before_chains(problem: Problem, tracks: Sequence[Track]) -> tuple[Track, ...]:
    """Return tracks on which robots wait where a chain begins instead of on its way.

    No robot arrives later at the end of a chain. A robot on a chain excludes others from all that
    it excludes them from where the chain begins, so that no booking grows.
    """
    roadmap = problem.roadmap
    if roadmap.passing is None:
        return tuple(tracks)
    moved = list[Track]()
    for track, itinerary in zip(tracks, problem.itineraries, strict=True):
        # A robot that has broken down may stand on a chain, and begins and ends there.
        inside = np.flatnonzero(track.vertices[1:-1] >= roadmap.n_drawn) + 1
        if not len(inside):
            moved.append(track)
            continue
        edges = roadmap.find_edges(track.vertices[:-1], track.vertices[1:])
        needed = np.array(itinerary.edge_ticks, np.int64)[roadmap.class_of_edge[edges]]
        if itinerary.turning is not None:
            needed[1:] += itinerary.turning.compute_turns(edges)
        enter = track.enter.copy()
        for visit in reversed(inside.tolist()):
            enter[visit] = enter[visit + 1] - needed[visit]
        moved.append(Track(vertices=track.vertices, enter=enter))
    return tuple(moved)
