"""Routes and tracks, and the service of each visit: its stages, its least dwell, its drive.

A stage is served in the first visit of its vertex, from the one that serves the stage before it on,
that lasts long enough beyond its drive; several stages that follow each other at one vertex may
share a visit. The last visit of a track never ends, so it is long enough for any stage.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, quote
from rightofway.kinds.table import Kind, coerce_fields, make_kind
from rightofway.model.itinerary import Itinerary, Stage
from rightofway.model.units import NEVER, Tick
from rightofway.site import Roadmap, VertexId


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
        coerce_fields(self, "", vertices=_WHOLE_NUMBERS, enter=_WHOLE_NUMBERS)
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
        return cls(
            vertices=_make_array_kind(np.int32).read_at("vertices", vertices),
            enter=_make_array_kind(np.int64).read_at("enter", enter),
        )


_WHOLE_NUMBERS = make_kind(
    "an array of whole numbers",
    lambda value: isinstance(value, np.ndarray) and value.ndim == 1 and value.dtype.kind == "i",
    "is no array of whole numbers",
    remedy="make it with Track.of",
)


def _make_array_kind(kind: type[np.signedinteger[Any]]) -> Kind[NDArray[Any]]:
    """Return the kind of lists of whole numbers that ``kind`` can hold, as an array."""
    least, most = np.iinfo(kind).min, np.iinfo(kind).max

    def read(values: object) -> NDArray[Any]:
        try:
            array = np.array(values)
        except ValueError:  # rows of several lengths
            array = np.array(None)
        if array.ndim != 1 or (len(array) and array.dtype.kind not in "iu"):
            raise ValueError(f"{quote(values)} is no list of whole numbers (give one)")
        if len(array) and not least <= array.min() <= array.max() <= most:
            raise ValueError(f"{quote(values)} is out of range (give {least} to {most})")
        return array.astype(kind)

    return Kind("a list of whole numbers", {}, read)


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

    def compute_least(self, visit: int) -> Tick:
        """Return the least ticks from a visit's enter to the next one's (or to completion)."""
        last = visit == len(self.vertices) - 1
        return Tick(self.dwell[visit] + (0 if last else self.drive[visit + 1]))


def join_route(roadmap: Roadmap, itinerary: Itinerary, legs: Sequence[Sequence[VertexId]]) -> Route:
    """Join paths into a route.

    Parameters
    ----------
    roadmap
        The graph the paths run on.
    itinerary
        The trip of the robot.
    legs
        One path for each stage, from where the stage before it is (or home) to its own vertex, both
        included. A stage at the vertex where the robot already is has a leg of that one vertex.
    """
    vertices, serves = _join_legs(itinerary, legs)
    return _route(roadmap, itinerary, vertices, serves)


def join_track(roadmap: Roadmap, itinerary: Itinerary, legs: Sequence[Sequence[VertexId]]) -> Track:
    """Join paths into the track of a robot that never waits.

    Parameters
    ----------
    roadmap, itinerary, legs
        As for `join_route`.
    """
    vertices, serves = _join_legs(itinerary, legs)
    path = np.array(vertices, np.int32)
    least = compute_least_dwells(itinerary.stages, serves, len(vertices))
    least += compute_turns_along(roadmap, itinerary, path)
    least[:-1] += np.array(compute_drives_along(roadmap, itinerary, vertices), np.int64)
    return Track(vertices=path, enter=np.append(0, np.cumsum(least[:-1])))


def _join_legs(
    itinerary: Itinerary, legs: Sequence[Sequence[VertexId]]
) -> tuple[list[VertexId], list[int]]:
    """Return the vertices of paths one after another, and the visit that ends each path."""
    vertices, serves = [itinerary.home], list[int]()
    for leg in legs:
        vertices += leg[1:]
        serves.append(len(vertices) - 1)
    return vertices, serves


def make_route_through(
    roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId]
) -> Route:
    """Make a route from its vertices; each stage is served by the earliest possible visit.

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
    serves = find_serving_visits(itinerary.stages, np.array(vertices, np.int32), spare)
    return _route(roadmap, itinerary, vertices, serves)


def make_route(roadmap: Roadmap, itinerary: Itinerary, track: Track) -> Route:
    """Return the route of a track, without its times.

    Parameters
    ----------
    roadmap
        The graph the track runs on.
    itinerary
        The trip of the robot.
    track
        Where it is, when; keeps the rules. Each stage is served as early as a visit lasts long
        enough, the last one in the last visit.
    """
    vertices = [VertexId(vertex) for vertex in track.vertices.tolist()]
    drive = np.array(compute_drives_along(roadmap, itinerary, vertices), np.int64)
    turns = compute_turns_along(roadmap, itinerary, track.vertices)
    spare = np.append(np.diff(track.enter) - drive - turns[:-1], NEVER)
    serves = find_serving_visits(itinerary.stages, track.vertices, spare)
    return _route(roadmap, itinerary, vertices, serves)


def _route(
    roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[VertexId], serves: Sequence[int]
) -> Route:
    dwell = compute_least_dwells(itinerary.stages, serves, len(vertices))
    dwell += compute_turns_along(roadmap, itinerary, np.array(vertices, np.int32))
    drive = map(Tick, compute_drives_along(roadmap, itinerary, vertices))
    return Route(
        vertices=tuple(vertices),
        dwell=tuple(map(Tick, dwell.tolist())),
        drive=(Tick(0), *drive),
        serves=tuple(serves),
    )


def compute_drives_along(
    roadmap: Roadmap, itinerary: Itinerary, vertices: Sequence[int]
) -> list[int]:
    """Return the duration of each drive of a robot along a path [ticks].

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
    edges = roadmap.find_edges(path[:-1], path[1:])
    if len(edges) and edges.min() < 0:
        gap = int(np.argmin(edges))
        raise KeyError((vertices[gap], vertices[gap + 1]))
    # A map may have a million classes, and a path has few edges.
    return [itinerary.edge_ticks[kind] for kind in roadmap.class_of_edge[edges].tolist()]


def compute_turns_along(
    roadmap: Roadmap, itinerary: Itinerary, vertices: NDArray[np.int32]
) -> NDArray[np.int64]:
    """Return the turning time of a robot at each vertex of a path [ticks]; int64, shape (n,).

    It does not turn at the last vertex, and at the first one only from its initial heading.

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
        edges = roadmap.find_edges(vertices[:-1], vertices[1:])
        turns[1:-1] = itinerary.turning.compute_turns(edges)
        turns[0] = compute_first_turn(roadmap, itinerary, edges)
    return turns


def compute_first_turn(roadmap: Roadmap, itinerary: Itinerary, edges: NDArray[np.int32]) -> Tick:
    """Return how long a robot turns from its initial heading into the first of some edges [ticks].

    The edges are those that it drives along from its home on, -1 where there is none.
    """
    if not itinerary.first_turns or not len(edges) or edges[0] < 0:
        return Tick(0)
    first = int(edges[0]) - int(roadmap.indptr[itinerary.home])
    is_out_of_home = 0 <= first < len(itinerary.first_turns)
    return itinerary.first_turns[first] if is_out_of_home else Tick(0)


def find_serving_visits(
    stages: Sequence[Stage], vertices: NDArray[np.int32], spare: NDArray[np.int64]
) -> list[int]:
    """Return the visit that serves each stage, up to the first stage that no visit serves.

    Each stage takes the earliest visit that is long enough, but the last stage, where the trip
    ends, takes the last visit: a robot that passes its end works there once it has come to stay.

    Parameters
    ----------
    stages
        The stages of the robot, in order.
    vertices, spare
        Where each visit is, and how long it lasts beyond its drive and the turn before [ticks];
        shape (n,).
    """
    visits_at: dict[int, list[int]] = {}
    used: dict[int, int] = {}
    serves: list[int] = []
    visit, last = 0, len(vertices) - 1
    for number, stage in enumerate(stages):
        need = stage.work + stage.turn
        if number == len(stages) - 1:
            visits, place = [last] if vertices[last] == stage.vertex else [], 0
        else:
            if stage.vertex not in visits_at:
                visits_at[stage.vertex] = np.flatnonzero(vertices == stage.vertex).tolist()
            visits = visits_at[stage.vertex]
            place = bisect_left(visits, visit)
        while place < len(visits) and spare[visits[place]] - used.get(visits[place], 0) < need:
            place += 1
        if place == len(visits):
            break
        visit = visits[place]
        used[visit] = used.get(visit, 0) + need
        serves.append(visit)
    return serves


def compute_least_dwells(
    stages: Sequence[Stage], serves: Sequence[int], n_visits: int
) -> NDArray[np.int64]:
    """Return the least ticks of each visit, without its drive; int64, shape (n,)."""
    dwell = np.zeros(n_visits, np.int64)
    add_least_dwells(dwell, stages, serves)
    return dwell


def add_least_dwells(
    dwell: NDArray[np.int64], stages: Sequence[Stage], serves: Sequence[int]
) -> None:
    """Add the least ticks of each visit, without its drive, to the ticks in an array."""
    last = len(dwell) - 1
    for stage, visit in zip(stages, serves, strict=False):
        dwell[visit] += stage.work + (stage.turn if visit < last else 0)
