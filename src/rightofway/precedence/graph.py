"""The precedence graph: routes, rights of way between their visits, and the earliest times.

Every visit is a node, its enter the time. An arc leads from a visit to the next one of its robot,
as long as the visit lasts at least. A *right of way* at a vertex is one more arc: the visit that
goes second enters no earlier than the first one has left (and the headway is over). The timetable
is the longest path to each node; a cycle of positive length is a deadlock and is refused.

Robots with a size have rights of way between visits of different vertices: the drive into the
second visit starts no earlier than the first visit has ended. A visit books its vertex and, during
the drive out of it, an edge; where only that edge is too near to the other robot, the second visit
of the right of way is the one that the edge leads to.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.kinds.table import require_one_for_each
from rightofway.model import (
    BookingRules,
    Problem,
    Route,
    Tick,
    Track,
    make_route,
    make_route_through,
)
from rightofway.native import BookedRows, ClosedPlaces, bind_closures, bind_rows, bind_rules
from rightofway.precedence.segments import (
    LinkedSegments,
    Segment,
    find_shared_segment,
)
from rightofway.site import VertexId

Visit = int
"""A visit's number in the graph: the robots' routes one behind the other."""

Pairs = NDArray[np.int32]
"""Pairs of visits; int32, shape (n, 2)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Meeting:
    """A remaining conflict of a timetable.

    Attributes
    ----------
    tick
        When the robots meet [ticks].
    kind
        ``vertex`` or ``swap``.
    robots
        The two robots (i, j), i < j.
    visits
        Their visits to one vertex: in a vertex conflict the overlapping ones; in a swap, i's visit
        to the vertex that it enters and j's to the same vertex, which it leaves. Robots with a size
        may be at different vertices, or on the edges driven out of them.
    """

    tick: Tick
    kind: Literal["vertex", "swap"]
    robots: tuple[int, int]
    visits: tuple[Visit, Visit]


class PrecedenceGraph:
    """Fixed routes with the rights of way decided so far.

    Parameters
    ----------
    routes
        One for each robot.
    rules
        When visits book.
    forbid_swaps
        Whether a swap counts as a conflict (the published method does not see them).
    frozen
        Visits that no right of way may delay: `give_way` refuses it.
    rows
        The bookings of the visits, where robots have a size.
    closed
        When the places of visits are closed: a visit that would book one of them then comes later.

    Raises
    ------
    ValueError
        If closures leave the route of a robot no times.
    """

    def __init__(
        self,
        routes: Sequence[Route],
        *,
        rules: BookingRules,
        forbid_swaps: bool = True,
        frozen: Iterable[Visit] = (),
        rows: BookedRows | None = None,
        closed: ClosedPlaces | None = None,
    ) -> None:
        self.routes = tuple(routes)
        self._has_sizes = rows is not None
        self._segments: dict[tuple[int, int], LinkedSegments] = {}
        self._frozen = frozenset(frozen)
        self._delays_frozen = False
        lengths = [len(route) for route in routes]
        self._first = np.concatenate(([0], np.cumsum(lengths))).astype(np.int32)
        self._robot = np.repeat(np.arange(len(routes)), lengths).tolist()
        self._last_dwells: int = sum(route.dwell[-1] for route in routes)
        self._kernel = _core.PrecedenceGraph(
            bind_rules(rules),
            _core.Routes(
                self._first,
                np.array([vertex for route in routes for vertex in route.vertices], np.int32),
                np.array([ticks for route in routes for ticks in route.dwell], np.int64),
                np.array([ticks for route in routes for ticks in route.drive], np.int64),
            ),
            forbid_swaps,
            bind_rows(rows),
            bind_closures(closed),
        )

    def get_visit(self, robot: int, index: int) -> Visit:
        """Return the number of the ``index``-th visit of a robot."""
        return int(self._first[robot]) + index

    def place(self, visit: Visit) -> tuple[int, int]:
        """Return the robot that a visit belongs to, and its index in that robot's route."""
        robot: int = self._robot[visit]
        return robot, visit - int(self._first[robot])

    def get_vertex(self, visit: Visit) -> VertexId:
        """Return where a visit is."""
        robot, index = self.place(visit)
        return self.routes[robot].vertices[index]

    def give_way(self, first: Visit, second: Visit) -> bool:
        """Let ``first`` have the right of way over ``second``, a visit to the same vertex.

        Robots with a size may be at different vertices: the drive into ``second`` starts when
        ``first`` has ended.

        False, with nothing changed, if that is impossible: ``first`` never leaves, ``second`` is
        there from the start or frozen, both would deadlock with earlier decisions, or a visit
        would be at a place while it is closed.
        """
        self._delays_frozen = second in self._frozen
        return not self._delays_frozen and self._kernel.precede(first, second)

    def give_all(self, rights: Iterable[tuple[Visit, Visit]]) -> bool:
        """Give several rights of way; false, without a change, if that is impossible."""
        mark = self.checkpoint()
        if all(self.give_way(first, second) for first, second in rights):
            return True
        self.rollback(mark)
        return False

    def take_back(self, first: Visit, second: Visit) -> bool:
        """Take back one right of way, whenever it was given; false if there is none.

        No robot becomes later. A rollback to an earlier mark gives it again.
        """
        return self._kernel.take_back(first, second)

    def list_deadlocked(self) -> list[int]:
        """Return the robots that the last right of way found impossible would have deadlocked.

        Each robot would have waited for the next, the last robot for the first. Empty if another
        reason made the right of way impossible.
        """
        robots = [self._robot[visit] for visit in self._find_refused_cycle()]
        return [robot for robot, _ in groupby(reversed(robots))]

    def list_deadlocking_rights(self) -> list[tuple[Visit, Visit]]:
        """Return the rights of way that made the last one impossible, by closing a circle with it.

        None if there was another reason.
        """
        return [
            (first_visit - 1, other)
            for first_visit, other in pairwise(self._find_refused_cycle())
            if self._robot[first_visit] != self._robot[other]
        ]

    def _find_refused_cycle(self) -> list[Visit]:
        return [] if self._delays_frozen else self._kernel.cycle().tolist()

    def keep_order(self, when: Sequence[Sequence[int] | NDArray[np.int64]]) -> None:
        """Give the right of way at every vertex in an order in which all visits can take place.

        Robots with a size: between all incompatible visits.

        Parameters
        ----------
        when
            For each robot, a number for each of its visits; of two visits to one vertex, the one
            with the smaller number goes first. The ticks of a plan, or steps.

        Raises
        ------
        ValueError
            If some visit cannot take place: visits that took place in an order can take place in it
            again, but not always with a longer headway before a closure.
        """
        if not self.keeps_order(when):
            raise ValueError("when: in this order some visit cannot take place")

    def keeps_order(self, when: Sequence[Sequence[int] | NDArray[np.int64]]) -> bool:
        """Do as `keep_order`; false, without a change, if some visit cannot take place."""
        return self._kernel.keep_order(np.concatenate(when, dtype=np.int64))

    def list_rights_of(self, robot: int) -> list[tuple[Visit, Visit]]:
        """Return all (first, second) of which one is a visit of the robot."""
        return [(first, second) for first, second in self._kernel.rights_of(robot).tolist()]

    def list_rights(self) -> Pairs:
        """Return all (first, second) in the order they were given."""
        return self._kernel.rights_of_way()

    def find_segment(self, visit: Visit, other: Visit) -> Segment:
        """Return the segment around two visits that are in conflict if both are at one time."""
        (i, index_i), (j, index_j) = self.place(visit), self.place(other)
        if self._has_sizes:
            segment = self._list_segments(i, j).find(index_i, index_j)
            assert segment is not None, "the visits exclude each other"
            return segment
        return find_shared_segment(self.routes[i], index_i, self.routes[j], index_j)

    def find_segment_of_right(self, first: Visit, second: Visit) -> Segment:
        """Return the segment for which a right of way holds."""
        if not self._has_sizes:
            return self.find_segment(first, second)
        (i, index_i), (j, starts) = self.place(first), self.place(second)
        segments = self._list_segments(i, j)
        return next(
            segment
            for index_j in (starts, starts - 1)
            if (segment := segments.find(index_i, index_j)) is not None
            and (index_i, starts) in segment.list_meetings()
        )

    def _list_segments(self, i: int, j: int) -> LinkedSegments:
        """Return the segments of two robots, by the indices of the visits in them."""
        if (i, j) not in self._segments:
            begins = np.array([self.get_visit(i, 0), self.get_visit(j, 0)] * 2, np.int32)
            indices = self._kernel.incompatible(i, j) - begins
            self._segments[i, j] = LinkedSegments(self.routes[i], self.routes[j], indices)
        return self._segments[i, j]

    def checkpoint(self) -> int:
        """Return a mark to roll back to."""
        return self._kernel.checkpoint()

    def rollback(self, mark: int) -> None:
        """Undo everything since the mark: rights of way given or taken back."""
        self._kernel.rollback(mark)

    def withdraw(self, robot: int) -> None:
        """Remove a robot for good: it then has no conflicts, and no robot waits for it."""
        self._last_dwells -= self.routes[robot].dwell[-1]
        self._kernel.withdraw(robot)

    def count_conflicts(self) -> int:
        """Return the conflicts in the whole system: ticks of overlap, and swaps."""
        return self._kernel.conflicts()

    def count_conflicts_of(self, robot: int, others: NDArray[np.uint8]) -> int:
        """Return the conflicts of one robot with those others whose place in the mask is not 0."""
        return self._kernel.conflicts_of(robot, others)

    def find_next_meeting(self) -> Meeting | None:
        """Return the earliest conflict in the system, or None."""
        return self._convert_meeting(self._kernel.next_conflict())

    def find_next_meeting_of(self, i: int, j: int) -> Meeting | None:
        """Return the earliest conflict of two robots, or None."""
        return self._convert_meeting(self._kernel.next_conflict_between(i, j))

    def _convert_meeting(self, meeting: tuple[int, int, int, int] | None) -> Meeting | None:
        if meeting is None:
            return None
        tick, kind, first, other = meeting
        robots = (self._robot[first], self._robot[other])
        if kind:  # a swap names the visits entered; the robot of `other` has left the vertex of one
            return Meeting(tick=Tick(tick), kind="swap", robots=robots, visits=(first, other - 1))
        return Meeting(tick=Tick(tick), kind="vertex", robots=robots, visits=(first, other))

    def get_completion(self, robot: int) -> Tick:
        """Return the completion time of a robot."""
        return Tick(self._kernel.completion(robot) + self.routes[robot].dwell[-1])

    def compute_flowtime(self) -> Tick:
        """Return the sum of all completion times; of robots that were set aside, it has none."""
        return Tick(self._kernel.completion_sum() + self._last_dwells)

    def list_critical_rights(self, robot: int) -> list[tuple[Visit, Visit]]:
        """Return the rights of way that a robot's completion time is due to, the latest first.

        They lie on a longest path to its last visit: with all of them it cannot complete sooner.
        """
        return [(first, second) for first, second in self._kernel.critical_rights(robot).tolist()]

    def enter(self, visit: Visit) -> Tick:
        """Return when a visit begins [ticks]."""
        return Tick(self._kernel.enter_of(visit))

    def build_tracks(self) -> list[Track]:
        """Return the timetable: the earliest track of each robot."""
        parts = np.split(self._kernel.enter(), self._first[1:-1])
        return [
            Track(vertices=np.array(route.vertices, np.int32), enter=enter)
            for route, enter in zip(self.routes, parts, strict=True)
        ]


def build_graph(
    problem: Problem,
    routes: Sequence[Route],
    *,
    forbid_swaps: bool = True,
    begun: NDArray[np.bool_] | None = None,
) -> PrecedenceGraph:
    """Return the precedence graph of some routes, without a right of way.

    Parameters
    ----------
    problem
        The scenario in ticks.
    routes
        One for each robot.
    forbid_swaps
        Whether a swap counts as a conflict.
    begun
        Stays at visits and drives into them that closures bind no more; bool, shape (N, 2).

    Raises
    ------
    ValueError
        If closures leave the route of a robot no times.
    """
    require_one_for_each(problem.itineraries, routes=routes)
    return PrecedenceGraph(
        routes,
        rules=problem.booking_rules,
        forbid_swaps=forbid_swaps,
        rows=BookedRows.of(problem, [route.vertices for route in routes]),
        closed=ClosedPlaces.of(problem, routes, None if begun is None else begun.ravel()),
    )


def build_graph_of_plan(problem: Problem, tracks: Sequence[Track]) -> PrecedenceGraph:
    """Return the precedence graph of a plan: its routes, and its order of visits at every vertex.

    Parameters
    ----------
    problem
        The scenario in ticks; the graph keeps its booking rules.
    tracks
        A plan that keeps the rules.

    Notes
    -----
    With the booking rules of the plan, no robot is later in the timetable than in the plan.
    """
    require_one_for_each(problem.itineraries, tracks=tracks)
    assert not problem.has_times, "the graph does not know times of stages"
    routes = [
        make_route(problem.roadmap, itinerary, track)
        for itinerary, track in zip(problem.itineraries, tracks, strict=True)
    ]
    graph = build_graph(problem, routes)
    graph.keep_order([track.enter.tolist() for track in tracks])
    return graph


def build_timetable(problem: Problem, tracks: Sequence[Track]) -> list[Track] | None:
    """Return the earliest tracks that keep routes and order of other tracks, and closures.

    Parameters
    ----------
    problem
        The scenario in ticks.
    tracks
        One for each robot; of their times only the order counts. They may be of another clock or
        of robots with other speeds. Each stage is served as early as it can be.

    Returns
    -------
    list of Track or None
        One for each robot; None where the order is a deadlock or closures leave no such tracks.
    """
    assert not problem.has_times, "the graph does not know times of stages"
    routes = [
        make_route_through(problem.roadmap, itinerary, track.vertices.tolist())
        for itinerary, track in zip(problem.itineraries, tracks, strict=True)
    ]
    try:
        graph = build_graph(problem, routes)
    except ValueError:
        return None
    is_kept = graph.keeps_order([track.enter.tolist() for track in tracks])
    return graph.build_tracks() if is_kept else None
