"""Bookings of visits, and closures of their places, as kernels take them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import NEVER, Lap, Problem, Route, Tick, Track
from rightofway.native.resources import bind_lists


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BookedRows:
    """The bookings of robots with a size.

    Attributes
    ----------
    vertex, edge
        The row of each visit's vertex, -1 for one that books nothing, and of the edge driven out of
        it, -1 for last visits; int32, shape (N,).
    lists
        The rows that each row excludes.
    """

    vertex: NDArray[np.int32]
    edge: NDArray[np.int32]
    lists: _core.ExcludedRows

    @classmethod
    def of(
        cls, problem: Problem, vertices: Sequence[Sequence[int] | NDArray[np.int32]]
    ) -> BookedRows | None:
        """Return the rows of visits, or None where no robot has a size.

        Parameters
        ----------
        problem
            The scenario in ticks.
        vertices
            The vertices that each robot visits.
        """
        resources = problem.resources
        lists = bind_lists(resources)
        if lists is None:
            return None
        at_vertex, along_edge = [], []
        for robot, route in enumerate(vertices):
            visited = np.asarray(route, np.int32)
            edges = problem.roadmap.find_edges(visited[:-1], visited[1:])
            at_vertex.append(resources.get_vertex_row(robot, 0) + visited)
            along_edge.append(np.append(resources.get_edge_row(robot, 0) + edges, -1))
        return cls(
            vertex=np.concatenate(at_vertex, dtype=np.int32),
            edge=np.concatenate(along_edge, dtype=np.int32, casting="same_kind"),
            lists=lists,
        )

    @classmethod
    def of_laps(
        cls, problem: Problem, robots: Sequence[int], laps: Sequence[Lap], counts: Sequence[int]
    ) -> BookedRows | None:
        """Return the rows of visits that repeat, or None where no robot has a size.

        Parameters
        ----------
        problem
            The scenario in ticks.
        robots, laps, counts
            Robots of the scenario, the lap of each, and how many laps it makes in a period.
        """
        resources = problem.resources
        lists = bind_lists(resources)
        if lists is None:
            return None
        at_vertex, along_edge = list[NDArray[np.int32]](), list[NDArray[np.int32]]()
        for robot, lap, count in zip(robots, laps, counts, strict=True):
            rows = resources.list_rows_of_lap(problem.roadmap, robot, lap.vertices)
            for rows_of_bookings, own in zip((at_vertex, along_edge), rows, strict=True):
                rows_of_bookings.append(np.tile(own, count))
        return cls(
            vertex=np.concatenate(at_vertex, dtype=np.int32),
            edge=np.concatenate(along_edge, dtype=np.int32),
            lists=lists,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ClosedPlaces:
    """Closures of the places that visits book.

    Attributes
    ----------
    first
        List ``2 x`` is of the vertex of visit ``x``, list ``2 x + 1`` of the edge driven into it:
        entries ``first[k]`` to ``first[k + 1]`` (exclusive); int32, shape (2 N + 1,).
    start, end
        When each entry is closed [ticks]; int64, shape (K,).
    """

    first: NDArray[np.int32]
    start: NDArray[np.int64]
    end: NDArray[np.int64]

    @classmethod
    def of(
        cls,
        problem: Problem,
        routes: Sequence[Route],
        begun: NDArray[np.bool_] | None = None,
    ) -> ClosedPlaces | None:
        """Return when the places of routes are closed, or None where nothing ever is.

        Parameters
        ----------
        problem
            The scenario in ticks.
        routes
            One for each robot.
        begun
            Stays and drives that have begun, so that it is too late for a closure, by list; bool,
            shape (2 N,).
        """
        closures = problem.closures
        if closures is None:
            return None
        lists: list[list[tuple[Tick, Tick]]] = []
        for robot, route in enumerate(routes):
            visited = np.array(route.vertices, np.int32)
            edges = problem.roadmap.find_edges(visited[:-1], visited[1:]).tolist()
            for vertex, edge in zip(route.vertices, [None, *edges], strict=True):
                lists.append(closures.list_at_vertex(robot, vertex))
                lists.append([] if edge is None else closures.list_along_edge(robot, edge))
        if begun is not None:
            lists = [[] if late else closed for closed, late in zip(lists, begun, strict=True)]
        times = [time for closed in lists for time in closed]
        return cls(
            first=np.array([0, *accumulate(map(len, lists))], np.int32),
            start=np.array([start for start, _ in times], np.int64),
            end=np.array([end for _, end in times], np.int64),
        )


def book_times(
    problem: Problem, tracks: Sequence[Track], drive: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return begin and end of the booking of each visit, by robot; int64, shape (N,).

    Parameters
    ----------
    problem
        The scenario in ticks; its booking rules define begin and end of bookings.
    tracks
        One track for each robot.
    drive
        Ticks of the edge that ends each visit, robot after robot, 0 for last ones; shape (N,).
    """
    enter = np.concatenate([track.enter for track in tracks])
    drive_in = np.roll(drive, 1)  # that of the last is 0
    end = np.append(problem.booking_rules.end(enter[1:]), NEVER)
    end[np.cumsum([len(track) for track in tracks]) - 1] = NEVER
    return problem.booking_rules.start(enter, drive_in), end


def find_overlaps(
    vertex: NDArray[np.int32],
    robot: NDArray[np.int32],
    start: NDArray[np.int64],
    end: NDArray[np.int64],
    *,
    most: int,
    time_limit: float | None,
) -> tuple[NDArray[np.int32], NDArray[np.int32], bool]:
    """Return the earlier and the later of any two bookings that overlap, and whether these are all.

    Parameters
    ----------
    vertex, robot, start, end
        The bookings, by vertex, then by start [ticks]; shape (N,).
    most
        How many pairs to find at most.
    time_limit
        After how long to stop [s].
    """
    return _core.find_overlaps(vertex, robot, start, end, most, time_limit)


def bind_rows(rows: BookedRows | None) -> _core.VisitRows | None:
    """Return the bookings of visits for kernels.

    Parameters
    ----------
    rows
        The rows of resources that the visits book; None where robots are points.
    """
    if rows is None:
        return None
    return _core.VisitRows(rows.lists, rows.vertex, rows.edge)


def bind_closures(closed: ClosedPlaces | None) -> _core.VisitClosures | None:
    """Return the closures of the places of visits for kernels.

    Parameters
    ----------
    closed
        The closed times of the visits' places; None where nothing is closed.
    """
    return None if closed is None else _core.VisitClosures(closed.first, closed.start, closed.end)
