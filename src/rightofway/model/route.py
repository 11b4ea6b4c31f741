"""Routes, laps, and what each visit is for: the stages it serves, its least dwell, its drive.

A stage is served in the first visit of its vertex, from the one that serves the stage before it on,
that lasts long enough beyond its drive; several stages that follow each other at one vertex may
share a visit. The last visit of a track never ends, so it is long enough for any stage.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import takewhile

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.model.problem import Itinerary, Stage, least_dwell
from rightofway.model.roadmap import Roadmap
from rightofway.model.scenario import Scenario
from rightofway.model.units import NEVER, Tick, VertexId


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Track:
    """The route of one robot with the times of its visits.

    Attributes
    ----------
    vertices
        The route; int32, shape (n,), at least one.
    enter
        When each visit begins [ticks]; int64, shape (n,). A visit's leave is the next one's enter;
        the last visit has none.
    """

    vertices: NDArray[np.int32]
    enter: NDArray[np.int64]

    def __post_init__(self) -> None:
        if len(self.vertices) != len(self.enter) or not len(self.vertices):
            counts = f"{len(self.vertices)} vertices and {len(self.enter)} times"
            raise InputError.at("", f"{counts} (give as many of both, at least one)")
        self.vertices.flags.writeable = self.enter.flags.writeable = False

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Track):
            return NotImplemented
        return np.array_equal(self.vertices, other.vertices) and np.array_equal(
            self.enter, other.enter
        )

    def __hash__(self) -> int:
        return hash((self.vertices.tobytes(), self.enter.tobytes()))

    def __len__(self) -> int:
        return len(self.vertices)

    def __repr__(self) -> str:
        count = "1 visit" if len(self) == 1 else f"{len(self)} visits"
        ends = f"{self.vertices[0]} to {self.vertices[-1]}"
        return f"Track({count}, vertex {ends}, tick {self.enter[0]} to {self.enter[-1]})"

    @classmethod
    def of(cls, vertices: Sequence[int], enter: Sequence[int]) -> Track:
        """Make a track from any sequences."""
        return cls(vertices=np.array(vertices, np.int32), enter=np.array(enter, np.int64))


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """The visits of one robot.

    Attributes
    ----------
    vertices
        Where each visit is.
    dwell
        How long each visit lasts at least, without the drive that follows [ticks]: work and turns.
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
    turns = turns_along(roadmap, itinerary, track.vertices)
    spare = np.append(np.diff(track.enter) - drive - turns[:-1], NEVER)
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
    dwell = _least_dwells(itinerary.stages, serves, len(vertices))
    dwell += turns_along(roadmap, itinerary, np.array(vertices, np.int32))
    drive = map(Tick, drives_along(roadmap, itinerary, vertices))
    return Route(
        vertices=tuple(vertices),
        dwell=tuple(map(Tick, dwell.tolist())),
        drive=(Tick(0), *drive),
        serves=tuple(serves),
    )


def drives_along(roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[int]) -> list[int]:
    """Return how long a robot drives along each edge of a path [ticks].

    Parameters
    ----------
    roadmap
        The graph of the path.
    itinerary
        The robot; its speed is in `Itinerary.edge_ticks`.
    vertices
        The path.

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


def turns_along(
    roadmap: Roadmap, itinerary: Itinerary, vertices: NDArray[np.int32]
) -> NDArray[np.int64]:
    """Return how long a robot turns at each vertex of a path [ticks]; int64, shape (n,).

    It turns neither at the first vertex nor at the last one.

    Parameters
    ----------
    roadmap
        The graph of the path.
    itinerary
        The robot; how it turns is in `Itinerary.turning`.
    vertices
        The path; int32, shape (n,).
    """
    turns = np.zeros(len(vertices), np.int64)
    if itinerary.turning is not None:
        turns[1:-1] = itinerary.turning.between(roadmap.edges(vertices[:-1], vertices[1:]))
    return turns


def serving_visits(
    stages: Sequence[Stage], vertices: NDArray[np.int32], spare: NDArray[np.int64]
) -> list[int]:
    """Return the visit that serves each stage, up to the first stage that no visit serves.

    Parameters
    ----------
    stages
        What the robot has to do, in order.
    vertices, spare
        Where each visit is, and how long it lasts beyond its drive and the turn before [ticks];
        shape (n,).
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


def _least_dwells(
    stages: Sequence[Stage], serves: Sequence[int], n_visits: int
) -> NDArray[np.int64]:
    """Return the least ticks of each visit, without its drive, given the visits of the stages."""
    dwell = np.zeros(n_visits, np.int64)
    for stage, visit in zip(stages, serves, strict=False):
        dwell[visit] += least_dwell([stage], leaves=visit < n_visits - 1)
    return dwell


@dataclass(frozen=True, slots=True, kw_only=True)
class Lap:
    """The visits of one lap; after the last visit the first one follows.

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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stays:
    """The visits of one robot.

    Attributes
    ----------
    dwell
        The least ticks of each visit before the robot drives on: the work and turning of the stages
        that it serves, and `turns`; int64, shape (n,). For the last visit: the work that is left to
        do there.
    drive
        Ticks of the edge that ends each visit, 0 for the last one; int64, shape (n,).
    waits
        Ticks of each visit beyond both, 0 for the last one; int64, shape (n,).
    turns
        How long the robot turns on the spot between two edges, a part of `dwell`, 0 for the first
        visit and the last one; int64, shape (n,).
    serves
        The visit that serves each stage. It ends before the first stage that no visit serves.
    completion
        When the robot has entered its last vertex and done the work there [ticks].
    """

    dwell: NDArray[np.int64]
    drive: NDArray[np.int64]
    waits: NDArray[np.int64]
    turns: NDArray[np.int64]
    serves: tuple[int, ...]
    completion: Tick


def stays_of(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Stays, ...]:
    """Return what the visits of a fleet are for.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot; they may break the rules.

    Notes
    -----
    Of tracks that break the rules, a move without an edge takes no time, and what comes after a
    missed stop is waiting. All tracks lie side by side in the arrays that the answer looks into.
    """
    ends = np.cumsum([len(track) for track in tracks])
    enter = np.concatenate([track.enter for track in tracks])
    edges = _edges_of_fleet(scenario.roadmap, tracks, ends)
    owns = [slice(end - len(track), end) for track, end in zip(tracks, ends.tolist(), strict=True)]
    drive, dwell = _drives_of_fleet(scenario, tracks, edges), np.zeros(len(enter), np.int64)
    turns = np.zeros(len(enter), np.int64)
    for own, itinerary in zip(owns, scenario.problem.itineraries, strict=True):
        if itinerary.turning is not None:
            turns[own][1:] = itinerary.turning.between(edges[own])
    spare = np.append(np.diff(enter), 0) - drive - turns
    spare[ends - 1] = NEVER
    all_serves = []
    for own, track, itinerary in zip(owns, tracks, scenario.problem.itineraries, strict=True):
        serves = serving_visits(itinerary.stages, track.vertices, spare[own])
        dwell[own] = _least_dwells(itinerary.stages, serves, len(track))
        all_serves.append(tuple(serves))
    dwell += turns
    completion = (enter + dwell)[ends - 1].tolist()
    waits = spare + turns - dwell
    waits[ends - 1] = 0
    return tuple(
        Stays(
            dwell=dwell[own],
            drive=drive[own],
            waits=waits[own],
            turns=turns[own],
            serves=serves,
            completion=Tick(done),
        )
        for own, serves, done in zip(owns, all_serves, completion, strict=True)
    )


def completions_of(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Tick, ...]:
    """Return when each robot has done its work and entered its last vertex [ticks].

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    return tuple(stay.completion for stay in stays_of(scenario, tracks))


def flowtime_of(scenario: Scenario, tracks: Sequence[Track]) -> Tick:
    """Return the sum of the robots' completion times [ticks].

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    return Tick(sum(completions_of(scenario, tracks)))


def cost_of(scenario: Scenario, tracks: Sequence[Track]) -> Tick:
    """Return what planners minimize: the flowtime and the surcharges of all edges driven [ticks].

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    cost, roadmap = flowtime_of(scenario, tracks), scenario.roadmap
    if roadmap.surcharges:
        for itinerary, track in zip(scenario.problem.itineraries, tracks, strict=True):
            edges = roadmap.edges(track.vertices[:-1], track.vertices[1:])
            by_class = np.array(itinerary.surcharges, np.int64)
            cost = Tick(cost + int(by_class[roadmap.length_class[edges]].sum()))
    return cost


def _edges_of_fleet(
    roadmap: Roadmap, tracks: Sequence[Track], ends: NDArray[np.int64]
) -> NDArray[np.int32]:
    """Return the edge after each visit of all tracks, -1 where there is none; int32."""
    vertices = np.concatenate([track.vertices for track in tracks])
    vertices[(vertices < 0) | (vertices >= roadmap.n_vertices)] = -1
    edges = np.append(roadmap.edges(vertices[:-1], vertices[1:]), np.int32(-1))
    edges[vertices < 0] = -1
    edges[ends - 1] = -1
    return edges


def _drives_of_fleet(
    scenario: Scenario, tracks: Sequence[Track], edges: NDArray[np.int32]
) -> NDArray[np.int64]:
    """Return the ticks of the edge after each visit of all tracks, 0 where there is none."""
    roadmap, itineraries = scenario.roadmap, scenario.problem.itineraries
    row = {pace: k for k, pace in enumerate({one.edge_ticks: None for one in itineraries})}
    by_class = np.array([[*pace, 0] for pace in row], np.int64)  # the last column: no edge
    length_class = np.append(roadmap.length_class, -1)
    rows = np.repeat(
        [row[itinerary.edge_ticks] for itinerary in itineraries], [len(track) for track in tracks]
    )
    drives: NDArray[np.int64] = by_class[rows, length_class[edges]]
    return np.maximum(drives, 0)  # -1: a track that drives along an edge where it is barred
