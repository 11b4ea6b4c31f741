"""Vertices in one line, so that space-time lines of a few robots read like a timetable graph."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

__all__ = ["MAX_ROBOTS", "MAX_VERTICES", "vertices_in_line"]

MAX_ROBOTS = 6
MAX_VERTICES = 40
"""Beyond these, lines of all robots in one diagram can no longer be told apart."""


def vertices_in_line(routes: Sequence[Sequence[int]]) -> list[int]:
    """Order the vertices of all routes so that every robot passes its own nearly in order.

    Parameters
    ----------
    routes
        The vertices that each robot visits.

    Returns
    -------
    list of int
        Every visited vertex once; empty where there are too many robots or vertices for one line.

    Notes
    -----
    The first route gives the places 0, 1, 2, …. Each further one is laid along the vertices it
    shares with those before: forwards or backwards, evenly between, on by one beyond.
    """
    if len(routes) > MAX_ROBOTS or len(set().union(*routes)) > MAX_VERTICES:
        return []
    places: dict[int, float] = {}
    for route in routes:
        once = list(dict.fromkeys(route))
        laid = _lay(once, places)
        places.update(
            (vertex, place)
            for vertex, place in zip(once, laid, strict=True)
            if vertex not in places
        )
    return sorted(places, key=lambda vertex: (places[vertex], vertex))


def _lay(route: Sequence[int], places: dict[int, float]) -> list[float]:
    """Return a place for each vertex of a route, in line with those that have one."""
    anchors = [index for index, vertex in enumerate(route) if vertex in places]
    if not anchors:
        return [float(index) for index in range(len(route))]
    at = [places[route[anchor]] for anchor in anchors]
    ahead = 1 if at[-1] >= at[0] else -1
    between = np.interp(range(len(route)), anchors, at).tolist()
    return [
        place + ahead * (min(index - anchors[0], 0) + max(index - anchors[-1], 0))
        for index, place in enumerate(between)
    ]
