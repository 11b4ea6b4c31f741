"""Bookings with a period or none, and when one more robot can make its laps among them.

References
----------
Phillips & Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import takewhile
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import (
    NEVER,
    BookingRules,
    Itinerary,
    Lap,
    Resources,
    Stage,
    Tick,
    make_visits_of_laps,
)
from rightofway.model.turning import Turning
from rightofway.native import bind_lists, bind_roads, bind_rules, bind_turning, list_excluded
from rightofway.search.distances import Distances
from rightofway.site import Roadmap, VertexId


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RoundTrip:
    """The trip of a robot in one lap, whose route is not chosen yet.

    Attributes
    ----------
    roadmap
        The graph to drive on.
    pace
        Ticks for an edge of each class; int32.
    stages
        The stages in order; the last one is home, with the turn there between two laps.
    tables
        For each stage the least ticks from every vertex [ticks], -1 where the robot must not go;
        int32[V].
    turning
        How long the robot turns; None where it turns in no time.
    """

    roadmap: Roadmap
    pace: NDArray[np.int32]
    stages: tuple[Stage, ...]
    tables: tuple[NDArray[np.int32], ...]
    turning: Turning | None = None

    @classmethod
    def of(
        cls, itinerary: Itinerary, distances: Distances, *, forbidden: Collection[int] = ()
    ) -> Self:
        """Return the round trip of a robot.

        Parameters
        ----------
        itinerary
            The stages of one lap; the last one is at home.
        distances
            The tables that guide the search.
        forbidden
            Vertices that the robot must not visit.
        """
        stages = _merge_home_stages(itinerary.stages)
        tables = tuple(distances.to(stage.vertex, itinerary.edge_ticks) for stage in stages)
        if forbidden:
            tables = tuple(map(np.copy, tables))
            for table in tables:
                table[list(forbidden)] = -1
        return cls(
            roadmap=distances.roadmap,
            pace=np.array(itinerary.edge_ticks, np.int32),
            stages=stages,
            tables=tables,
            turning=itinerary.turning,
        )


def _merge_home_stages(stages: Sequence[Stage]) -> tuple[Stage, ...]:
    """Return the stages with those at home at the end merged into one."""
    home = stages[-1].vertex
    at_home = list(takewhile(lambda stage: stage.vertex == home, reversed(stages)))
    once = Stage(
        vertex=home,
        work=Tick(sum(stage.work for stage in at_home)),
        turn=Tick(sum(stage.turn for stage in at_home)),
    )
    return (*stages[: len(stages) - len(at_home)], once)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowsOfLaps:
    """The rows that robots with a size book, where laps repeat.

    Attributes
    ----------
    roadmap
        The graph to drive on.
    resources
        Which rows exclude each other.
    robots
        Robots of the scenario; bookings number them from 0.
    """

    roadmap: Roadmap
    resources: Resources
    robots: tuple[int, ...]

    def find_rows(self, robot: int, lap: Lap) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return the rows of a lap's vertices, and of the edges driven into them."""
        bookings_of_robot = self.robots[robot]
        vertices, edges = self.resources.list_rows_of_lap(
            self.roadmap, bookings_of_robot, lap.vertices
        )
        return vertices, np.roll(edges, 1)


Visits = tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]
"""Vertex (or row), least dwell and drive into each visit."""


class PeriodicBookings:
    """Bookings of robots that repeat their laps, on a circle of time; or on a line of time.

    Parameters
    ----------
    n_vertices
        How many vertices the roadmap has.
    period
        Ticks after which all bookings repeat; None for a line of time.
    rules
        When visits book.
    rows
        The bookings of laps, where robots have a size.
    """

    def __init__(
        self,
        n_vertices: int,
        period: Tick | None,
        *,
        rules: BookingRules,
        rows: RowsOfLaps | None = None,
    ) -> None:
        self.period = NEVER if period is None else period
        self._rows = rows
        lists = None if rows is None else bind_lists(rows.resources)
        self._kernel = _core.PeriodicBookings(
            bind_rules(rules),
            n_vertices if lists is None else lists.n_rows,
            period,
            lists,
        )

    def _list_visits(
        self, robot: int, lap: Lap, count: int
    ) -> tuple[Visits, NDArray[np.int32] | None]:
        """Return the visits of some laps, and the rows of the edges driven in."""
        vertex, dwell, drive = make_visits_of_laps(lap, count)
        if self._rows is None:
            return (vertex, dwell, drive), None
        vertices, edges = self._rows.find_rows(robot, lap)
        return (np.tile(vertices, count), dwell, drive), np.tile(edges, count)

    def add(self, robot: int, lap: Lap, count: int, enter: NDArray[np.int64]) -> None:
        """Book the visits of a robot's laps in one period.

        Raises
        ------
        ValueError
            If the robot has bookings already, or a booking overlaps another robot's.
        """
        if not self.add_if_free(robot, lap, count, enter):
            raise ValueError(f"enter: a booking of robot {robot} overlaps another robot's")

    def add_if_free(self, robot: int, lap: Lap, count: int, enter: NDArray[np.int64]) -> bool:
        """Book as `add` does; false, without a booking, if one overlaps another robot's."""
        visits, edges = self._list_visits(robot, lap, count)
        return self._kernel.add(robot, *visits, enter, None, edges)

    def add_visits(
        self, robot: int, lap: Lap, visits: range, enter: NDArray[np.int64], leave: int
    ) -> None:
        """Book some visits of a robot on a line of time.

        Parameters
        ----------
        robot, lap
            The robot, and the lap that it repeats.
        visits
            Which visits, numbered from those of its first lap on.
        enter, leave
            When each begins, and when the last one ends [ticks].
        """
        place = np.arange(visits.start, visits.stop) % len(lap)
        (vertex, dwell, drive), edges = self._list_visits(robot, lap, 1)
        begins, edges = np.ascontiguousarray(enter), None if edges is None else edges[place]
        self._kernel.add(
            robot, vertex[place], dwell[place], drive[place], begins, int(leave), edges
        )

    def remove(self, robot: int) -> None:
        """Remove all bookings of a robot."""
        self._kernel.remove(robot)

    def search(
        self,
        lap: Lap,
        count: int,
        phase: int,
        *,
        robot: int = 0,
        time_limit: float | None = None,
    ) -> NDArray[np.int64] | None:
        """Return when a robot can begin each visit of its laps in one period, or None.

        Notes
        -----
        Complete for this lap, unless no other robot visits its home: then the robot stays there
        until the phase, and None excludes no other phase.
        """
        visits, edges = self._list_visits(robot, lap, count)
        enter = self._kernel.search(*visits, phase, time_limit, edges)
        return None if enter is None else enter - enter[0] // int(self.period) * int(self.period)

    def find_route(
        self, trip: RoundTrip, phase: int, *, robot: int = 0, time_limit: float | None = None
    ) -> tuple[Lap, NDArray[np.int64]] | None:
        """Return one lap in a period on any route, and when each visit can begin, or None.

        Notes
        -----
        Complete among all routes, with the exception of `search`. From this phase, no route is
        home again earlier.
        """
        rows = self._rows
        route = self._kernel.find_route(
            bind_roads(trip.roadmap),
            _core.RoundTrip(
                trip.pace,
                np.array([stage.vertex for stage in trip.stages], np.int32),
                np.array([stage.work for stage in trip.stages], np.int64),
                np.array([stage.turn for stage in trip.stages], np.int64),
                list(trip.tables),
                bind_turning([trip.turning]),
            ),
            phase,
            time_limit,
            0 if rows is None else rows.resources.get_vertex_row(rows.robots[robot], 0),
        )
        if route is None:
            return None
        vertices, dwell, drive, enter = route
        lap = Lap(
            vertices=tuple(map(VertexId, vertices.tolist())),
            dwell=tuple(map(Tick, dwell.tolist())),
            drive=tuple(map(Tick, drive.tolist())),
        )
        return lap, enter - enter[0] // int(self.period) * int(self.period)

    def connect(
        self, lap: Lap, count: int, begins: int, until: int, leave: int, *, robot: int = 0
    ) -> NDArray[np.int64] | None:
        """Return when the visits of some laps can begin, with the visit home after them, or None.

        Parameters
        ----------
        lap, count
            The lap, and how many of it.
        begins
            When the robot comes home before them [ticks].
        until, leave
            By when it has to be home again, and until when it stays there then [ticks].
        robot
            The robot.
        """
        vertex, dwell, drive = _list_visits_home(lap, count)
        ticks = int(begins), int(until), int(leave)
        if self._rows is None:
            return self._kernel.connect(vertex, dwell, drive, *ticks)
        place = np.append(np.arange(len(lap) * count) % len(lap), 0)
        vertices, edges = self._rows.find_rows(robot, lap)
        return self._kernel.connect(vertices[place], dwell, drive, *ticks, edges[place])

    def find_blockers(
        self, robot: int, lap: Lap, begins: int = -NEVER, until: int = NEVER
    ) -> set[int]:
        """Return the robots whose bookings refused the last search of this lap."""
        return self._list_users(self._find_not_reached(robot, lap), begins, until)

    def keeps_out(self, other: int, home_of: Lap, robot: int, lap: Lap) -> bool:
        """Return whether a robot at home excludes places that the last search needed."""
        needed = self._find_not_reached(robot, lap)
        if self._rows is None:
            return bool(needed[0] == home_of.vertices[0])
        row = int(self._rows.find_rows(other, home_of)[0][0])
        return bool(np.isin(needed, list_excluded(self._rows.resources, row)).any())

    def _find_not_reached(self, robot: int, lap: Lap) -> NDArray[np.int32]:
        """Return the rows (for points: the vertex) that the last search could not book."""
        visit = (self._kernel.reached + 1) % len(lap)
        if self._rows is None:
            return np.array([lap.vertices[visit]], np.int32)
        return np.array([rows[visit] for rows in self._rows.find_rows(robot, lap)], np.int32)

    def find_neighbours(self, robot: int, lap: Lap) -> set[int]:
        """Return the robots that have booked anything that a lap needs."""
        if self._rows is None:
            return self._list_users(np.array(lap.vertices, np.int32))
        return self._list_users(np.concatenate(self._rows.find_rows(robot, lap)))

    def _list_users(
        self, rows: NDArray[np.int32], begins: int = -NEVER, until: int = NEVER
    ) -> set[int]:
        return set(self._kernel.users(rows, begins, until).tolist())


@lru_cache(maxsize=1 << 14)
def _list_visits_home(
    lap: Lap, count: int
) -> tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64]]:
    vertex, dwell, drive = make_visits_of_laps(lap, 1)
    place = np.append(np.arange(len(lap) * count) % len(lap), 0)
    return vertex[place], dwell[place], drive[place]
