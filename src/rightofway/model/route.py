"""Where one robot goes, without times: visits with least dwells, once or lap after lap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import takewhile

import numpy as np
from numpy.typing import NDArray

from rightofway.model.plan import Track
from rightofway.model.problem import Itinerary
from rightofway.model.roadmap import Roadmap
from rightofway.model.stays import least_dwells, serving_visits
from rightofway.model.units import NEVER, Tick, VertexId

__all__ = [
    "Lap",
    "Route",
    "drives_along",
    "lap_of",
    "route_along",
    "route_of",
    "route_through",
    "visits_of_laps",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """The visits of one robot.

    Attributes
    ----------
    vertices
        Where each visit is.
    dwell
        How long each visit lasts at least, without the drive that follows [ticks].
    drive
        Ticks of the edge driven into each visit; 0 for the first.
    serves
        The visit that serves each stage; empty where no itinerary made the route.
    """

    vertices: tuple[VertexId, ...]
    dwell: tuple[Tick, ...]
    drive: tuple[Tick, ...]
    serves: tuple[int, ...] = field(default=(), compare=False)

    def __len__(self) -> int:
        return len(self.vertices)

    def least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's (or to completion)."""
        last = visit == len(self.vertices) - 1
        return Tick(self.dwell[visit] + (0 if last else self.drive[visit + 1]))


def route_along(
    roadmap: Roadmap, itinerary: Itinerary, legs: Sequence[Sequence[VertexId]]
) -> Route:
    """Join paths into a route.

    Parameters
    ----------
    roadmap
        The graph the paths run on.
    itinerary
        What the robot has to do.
    legs
        One path for each stage, from where the stage before it is (or home) to its own vertex, both
        included. A stage at the vertex where the robot already is has a leg of that one vertex.
    """
    vertices = [itinerary.home]
    serves = []
    for leg in legs:
        vertices += leg[1:]
        serves.append(len(vertices) - 1)
    return _route(roadmap, itinerary, vertices, serves)


def route_through(roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId]) -> Route:
    """Make a route of the vertices it visits; each stage is served as early as it can be.

    Parameters
    ----------
    roadmap
        The graph the route runs on.
    itinerary
        What the robot has to do; the vertices lead from its home past all stages to the last one.
    vertices
        Where it goes, visit by visit.
    """
    spare = np.full(len(vertices), NEVER)
    return _route(roadmap, itinerary, vertices, _serves(itinerary, vertices, spare))


def route_of(roadmap: Roadmap, itinerary: Itinerary, track: Track) -> Route:
    """Keep where a robot goes and what it does there, and forget when.

    Parameters
    ----------
    roadmap
        The graph the track runs on.
    itinerary
        What the robot has to do.
    track
        Where it is, when; keeps the rules. Each stage is served as early as a visit lasts long
        enough, the last one in the last visit.
    """
    vertices = [VertexId(vertex) for vertex in track.vertices.tolist()]
    drive = np.array(drives_along(roadmap, itinerary, vertices), np.int64)
    spare = np.append(np.diff(track.enter) - drive, NEVER)
    return _route(roadmap, itinerary, vertices, _serves(itinerary, vertices, spare))


def _serves(
    itinerary: Itinerary, vertices: Sequence[VertexId], spare: NDArray[np.int64]
) -> list[int]:
    """Return the visit that serves each stage: the last visit for the last stage."""
    before = serving_visits(itinerary.stages[:-1], np.array(vertices, np.int32), spare)
    return [*before, len(vertices) - 1]


def _route(
    roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId], serves: Sequence[int]
) -> Route:
    dwell = least_dwells(itinerary.stages, serves, len(vertices))
    drive = map(Tick, drives_along(roadmap, itinerary, vertices))
    return Route(
        vertices=tuple(vertices),
        dwell=tuple(map(Tick, dwell.tolist())),
        drive=(Tick(0), *drive),
        serves=tuple(serves),
    )


def drives_along(roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[int]) -> list[int]:
    """Return how long a robot drives along each edge of a path [ticks].

    Raises
    ------
    KeyError
        If no edge leads from some vertex to the next.
    """
    path = np.array(vertices, np.int32)
    edges = roadmap.edges(path[:-1], path[1:])
    if len(edges) and edges.min() < 0:
        gap = int(np.argmin(edges))
        raise KeyError((vertices[gap], vertices[gap + 1]))
    by_class = np.array(itinerary.edge_ticks, np.int64)
    ticks: list[int] = by_class[roadmap.length_class[edges]].tolist()
    return ticks


@dataclass(frozen=True, slots=True, kw_only=True)
class Lap:
    """The visits of one lap; after the last one the first comes again.

    Attributes
    ----------
    vertices
        Where each visit is; the first is at home.
    dwell
        How long each visit lasts at least, without the drive that follows: at a stop the work and
        the turn, at home the turn between two laps [ticks].
    drive
        Ticks of the edge driven into each visit; into the first: from the last one.
    """

    vertices: tuple[VertexId, ...]
    dwell: tuple[Tick, ...]
    drive: tuple[Tick, ...]

    def __len__(self) -> int:
        return len(self.vertices)

    @property
    def duration(self) -> Tick:
        """How long a lap without waits lasts [ticks]."""
        return Tick(sum(self.dwell) + sum(self.drive))

    def least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's."""
        return Tick(self.dwell[visit] + self.drive[(visit + 1) % len(self)])

    def leasts(self) -> tuple[Tick, ...]:
        """Return the least ticks of all visits."""
        drives = (*self.drive[1:], self.drive[0])
        return tuple(Tick(dwell + drive) for dwell, drive in zip(self.dwell, drives, strict=True))


@lru_cache(maxsize=1 << 14)
def visits_of_laps(
    lap: Lap, count: int
) -> tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]:
    """Return vertex, dwell and drive [ticks] of all visits of some laps."""
    return (
        np.array(lap.vertices * count, np.int32),
        np.array(lap.dwell * count, np.int64),
        np.array(lap.drive * count, np.int64),
    )


def lap_of(itinerary: Itinerary, route: Route) -> Lap:
    """Wrap a round trip into a lap.

    Parameters
    ----------
    itinerary
        What the robot has to do in one lap; it ends at home.
    route
        Where it goes for that; the last visit serves all stages at home at the end.
    """
    at_home = takewhile(lambda stage: stage.vertex == itinerary.home, reversed(itinerary.stages))
    between = route.dwell[0] + sum(stage.work + stage.turn for stage in at_home)
    return Lap(
        vertices=route.vertices[:-1],
        dwell=(Tick(between), *route.dwell[1:-1]),
        drive=(route.drive[-1], *route.drive[1:-1]),
    )
