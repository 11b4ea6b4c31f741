"""Waiting places of robots whose next stop cannot be reached for now.

A waiting robot must block neither the stops of others nor their way. It gets the nearest vertex
without which the neighbours of that vertex still reach each other. Robots are placed one after
another, each on the roadmap that the earlier ones leave.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.metrics.connectivity import reach_from
from rightofway.model import Scenario
from rightofway.native.resources import list_excluded
from rightofway.resume.held import list_held
from rightofway.site import Roadmap, VertexId

__all__ = ["ReachableStops", "choose_waiting_places"]

MOST_CANDIDATES = 30
"""Vertices for which it is computed whether they separate others; the nearest first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachableStops:
    """The stops that a robot can make for now.

    Attributes
    ----------
    start
        The vertex at the end of its released parts.
    stops
        The vertices of these stops, in their order.
    then
        The vertex of the next stop, which cannot be reached; None where there is none.
    """

    start: VertexId
    stops: tuple[VertexId, ...]
    then: VertexId | None

    @property
    def end(self) -> VertexId:
        """Where it is after these stops."""
        return self.stops[-1] if self.stops else self.start


def choose_waiting_places(
    scenario: Scenario,
    passable: Roadmap,
    trips: Mapping[int, ReachableStops],
    standing: Collection[int],
) -> dict[int, VertexId]:
    """Return where robots wait that cannot make all their stops.

    Parameters
    ----------
    scenario
        The problem: which robots exclude each other where.
    passable
        The vertices and the edges that can be driven now.
    trips
        The places that each robot on the floor can reach.
    standing
        Robots that do not go on for now: they stay where they start.

    Returns
    -------
    dict
        The vertex of each robot with a stop that cannot be reached; without robots that stand,
        and without robots for which no vertex is left.
    """
    floor = _Floor(scenario, passable)
    ends = {k: (trip.end,) for k, trip in trips.items() if trip.then is None or k in standing}
    chosen = dict[int, VertexId]()
    for robot in sorted(trips.keys() - ends.keys()):
        others = trips.keys() - {robot, *standing}
        in_use = {k: (trips[k].start, *trips[k].stops) for k in others}
        blocked = floor.list_excluded(robot, ends) | floor.list_excluded(robot, in_use)
        places = floor.list_places(robot, trips[robot])
        nearest = [place for place in places if place not in blocked]
        harmless = (
            v for v in islice(nearest, MOST_CANDIDATES) if not floor.is_needed_between(robot, v)
        )
        place = next(harmless, nearest[0] if nearest else None)
        if place is not None:
            chosen[robot] = VertexId(place)
            ends[robot] = (chosen[robot],)
            floor.exclude(robot, place)
    return chosen


class _Floor:
    """The passable roadmap, without the waiting places that are chosen."""

    def __init__(self, scenario: Scenario, passable: Roadmap) -> None:
        self._scenario, self._passable = scenario, passable

    def exclude(self, robot: int, place: int) -> None:
        """Remove the places that a robot excludes while it waits at a place."""
        held = list_held(self._scenario, {robot: [place]})
        self._passable = self._passable.exclude(held.vertices, held.edges)

    def list_excluded(self, robot: int, places: Mapping[int, Sequence[int]]) -> set[int]:
        """Return the vertices at which a robot cannot be while others are at their places."""
        resources = self._scenario.problem.resources
        first = resources.get_vertex_row(robot, 0)
        rows = {
            row - first
            for other, vertices in places.items()
            for vertex in vertices
            for row in list_excluded(resources, resources.get_vertex_row(other, vertex))
        }
        return {row for row in rows if 0 <= row < resources.n_vertices}

    def list_places(self, robot: int, trip: ReachableStops) -> list[int]:
        """Return the vertices that a robot reaches behind its stops, the nearest first.

        From each a way leads to its next stop once everything is open.
        """
        ticks = np.array(self._scenario.problem.itineraries[robot].edge_ticks)
        whole = self._scenario.roadmap
        against = [list[int]() for _ in range(whole.n_vertices)]
        for tail, heads in enumerate(_list_heads(whole, ticks[whole.class_of_edge] >= 0)):
            for head in heads:
                against[head].append(tail)
        goals = set(
            reach_from([trip.end if trip.then is None else trip.then], against, _accept_any)
        )
        along = _list_heads(self._passable, ticks[self._passable.class_of_edge] >= 0)
        return [vertex for vertex in reach_from([trip.end], along, _accept_any) if vertex in goals]

    def is_needed_between(self, robot: int, place: int) -> bool:
        """Return whether others no longer reach each other while a robot is at a place."""
        held = list_held(self._scenario, {robot: [place]})
        rest = self._passable.exclude(held.vertices, held.edges)
        along, heads_left = _list_heads(self._passable), _list_heads(rest)
        lost = [
            (tail, head)
            for tail, heads in enumerate(along)
            for head in set(heads).difference(heads_left[tail])
        ]
        tails = {tail for tail, _ in lost if tail not in held.vertices}
        heads = {head for _, head in lost if head not in held.vertices}
        return any(not _is_reaching(heads_left, tail, heads - {tail}) for tail in tails)


def _accept_any(_: int) -> bool:
    return True


def _list_heads(roadmap: Roadmap, is_allowed: NDArray[np.bool_] | None = None) -> list[list[int]]:
    """Return the heads of the edges that leave each vertex."""
    heads, bounds = roadmap.heads.tolist(), roadmap.indptr.tolist()
    allowed = [True] * len(heads) if is_allowed is None else is_allowed.tolist()
    return [
        [heads[edge] for edge in range(begin, end) if allowed[edge]]
        for begin, end in pairwise(bounds)
    ]


def _is_reaching(along: Sequence[Sequence[int]], start: int, goals: set[int]) -> bool:
    """Return whether ways lead from a vertex to all of some vertices."""
    left, seen, front = set(goals), {start}, [start]
    while front and left:
        ahead = {head for vertex in front for head in along[vertex]} - seen
        seen |= ahead
        left -= ahead
        front = list(ahead)
    return not left
