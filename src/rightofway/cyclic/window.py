"""A window on cyclic routes: some consecutive visits of each robot, in one precedence graph.

A window begins at a *cut*. Rights of way never change visits begun by the cut: the *frozen prefix*.
Visits not over by the cut are in the graph with their actual times, later visits with their least
durations. Each robot leaves the window to a vertex of its own, without conflicts; times are valid
until the first robot leaves.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.cyclic.route import GroupContext
from rightofway.model import Route, Tick
from rightofway.native import BookedRows, bind_lists
from rightofway.planners import Deadline, PlanRequest
from rightofway.precedence import Meeting, PrecedenceGraph, Segment
from rightofway.repair.conflict_resolution import PartialPlan
from rightofway.site import VertexId

NumberedRight = tuple[tuple[int, int], tuple[int, int]]
"""A right of way of one visit over another; a visit is (robot, number)."""


class TooShort(Exception):
    """The window has to hold more visits of these robots (positions in the group)."""

    def __init__(self, robots: Iterable[int]) -> None:
        self.robots = tuple(robots)
        super().__init__()


@dataclass(frozen=True, slots=True)
class FrozenPrefix:
    """The past of a group: the enters of each robot's visits, up to and including a tick."""

    tick: int
    history: list[list[int]]


class Window:
    """A group of robots that continue from a cut.

    The visits of each robot after the cut last at least ``ahead`` ticks, and the window ends with
    visit ``stop`` of the robot or a later visit.
    """

    def __init__(
        self,
        context: GroupContext,
        deadline: Deadline,
        prefix: FrozenPrefix,
        ahead: Sequence[int],
        stop: Sequence[int],
    ) -> None:
        self.context = context
        self.prefix = prefix
        self.begins = max(prefix.tick - context.reach, 0)  # time 0 of the graph
        self.starts = [bisect_right(past, self.begins) - 1 for past in prefix.history]
        self.routes = [
            self._route(robot, *row) for robot, row in enumerate(zip(ahead, stop, strict=True))
        ]
        lengths = [len(route) for route in self.routes]
        first = np.cumsum([0, *lengths]).tolist()
        known = zip(first[:-1], self.starts, prefix.history, strict=True)
        self.graph = PrecedenceGraph(
            self.routes,
            rules=context.booking_rules,
            frozen=[visit for f, s, past in known for visit in range(f, f + len(past) - s)],
            rows=self._list_rows(),
        )
        request = PlanRequest(
            scenario=context.scenario, options={"swaps": "resolve"}, deadline=deadline
        )
        self.fleet = PartialPlan(request, self.routes, graph=self.graph)
        self._ends = [visit - 1 for visit in first[1:]]

    def get_node(self, robot: int, number: int) -> int:
        """Return the node of a robot's visit in the graph."""
        return self.graph.get_visit(robot, number - self.starts[robot])

    def number(self, visit: int) -> tuple[int, int]:
        """Return the robot and the number of a visit of the graph."""
        robot, index = self.graph.place(visit)
        return robot, self.starts[robot] + index

    def is_past(self, robot: int, number: int) -> bool:
        """Return whether a visit began by the cut."""
        return number < len(self.prefix.history[robot])

    def compute_ends(self) -> NDArray[np.int64]:
        """Return the tick at which each robot leaves the window [ticks]."""
        enter = self.graph.enter
        return np.array([enter(visit) for visit in self._ends], np.int64) + self.begins

    def describe_state(self) -> tuple[Hashable, ...]:
        """Return the state that determines later visits, except rights of way beyond the cut."""
        frozen = (
            (start % len(route), *stretch.dwell[: len(past) - start])
            for route, start, stretch, past in zip(
                self.context.routes, self.starts, self.routes, self.prefix.history, strict=True
            )
        )
        return (self.prefix.tick - self.begins, *frozen)

    def is_endless(self, meeting: Meeting, segment: Segment) -> bool:
        """Return whether two robots are head-on for ever, so that neither can give way.

        Two cyclic routes that agree for the length of both laps together agree for ever (Fine and
        Wilf 1965). Robots with a size: a segment that links two visits with visits whole laps later
        of one robot and whole laps earlier of the other goes on in the same way. If it comes again
        for one of the robots only, that robot can go on for ever.

        Raises
        ------
        TooShort
            If the window is too short to decide.
        """
        if segment.kind != "head-on":
            return False
        (i, j), pairs = meeting.robots, segment.list_meetings()
        i_last, j_last = max(a for a, _ in pairs), max(b for _, b in pairs)
        if i_last < len(self.routes[i]) - 2 and j_last < len(self.routes[j]) - 2:
            return False
        i_lap, j_lap = len(self.context.routes[i]), len(self.context.routes[j])
        if not self.context.scenario.problem.resources.are_points:
            recurrence = _classify_recurrence(
                ((pair.i, pair.j) for pair in segment.pairs), i_lap, j_lap
            )
            if recurrence is not None:
                return recurrence == "head-on"
        elif len(pairs) >= i_lap + j_lap:
            return True
        raise TooShort(meeting.robots)

    def _list_rows(self) -> BookedRows | None:
        """Return the visits' bookings where robots have a size; the last vertices are free."""
        scenario = self.context.scenario
        resources = scenario.problem.resources
        lists = bind_lists(resources)
        if lists is None:
            return None
        beyond = np.array([-1], np.int32)
        at_vertex, along_edge = list[NDArray[np.int32]](), list[NDArray[np.int32]]()
        for route, start, stretch in zip(
            self.context.routes, self.starts, self.routes, strict=True
        ):
            rows = resources.list_rows_of_lap(scenario.roadmap, route.robot, route.lap.vertices)
            places = np.arange(start, start + len(stretch) - 1) % len(route)
            at_vertex += [rows[0][places], beyond]
            along_edge += [rows[1][places[:-1]], np.full(2, -1, np.int32)]
        return BookedRows(
            vertex=np.concatenate(at_vertex),
            edge=np.concatenate(along_edge),
            lists=lists,
        )

    def _route(self, robot: int, ahead: int, stop: int) -> Route:
        """Return the stretch of a robot's route that the window holds."""
        cyclic, past = self.context.routes[robot], self.prefix.history[robot]
        start = self.starts[robot]
        stop = max(len(past) + cyclic.count_visits_lasting(len(past), ahead), stop)
        visits = range(start, stop)
        places = [visit % len(cyclic) for visit in visits]
        dwell = [cyclic.lap.dwell[place] for place in places]
        dwell[-1] = cyclic.compute_least(visits[-1])
        for visit in range(start, len(past)):
            dwell[visit - start] = Tick(
                self._measure_lasting(robot, visit) - cyclic.drive(visit + 1)
            )
        return Route(
            vertices=(
                *(cyclic.lap.vertices[place] for place in places),
                VertexId(self.context.scenario.roadmap.n_vertices + robot),
            ),
            dwell=(*dwell, Tick(0)),
            drive=(Tick(0), *(cyclic.lap.drive[place] for place in places[1:]), Tick(0)),
        )

    def _measure_lasting(self, robot: int, visit: int) -> int:
        """Return the least duration within the window of a visit begun by the cut [ticks]."""
        past = self.prefix.history[robot]
        if visit + 1 < len(past):
            leave = past[visit + 1]
        else:  # the robot leaves after the cut
            least = self.context.routes[robot].compute_least(visit)
            leave = max(past[visit] + least, self.prefix.tick + 1)
        return max(leave - max(past[visit], self.begins), 1)


def _classify_recurrence(
    pairs: Iterable[tuple[int, int]], i_lap: int, j_lap: int
) -> Literal["head-on", "in place"] | None:
    """Return how pairs of a head-on segment come again whole laps apart, so that it has no end.

    ``head-on``: later for one robot and earlier for the other. ``in place``: for one robot only;
    it can go on for ever while the other robot waits. None if no pair comes again.
    """
    j_at_place = defaultdict[tuple[int, int], dict[int, list[int]]](dict)
    for a, b in pairs:
        j_at_place[a % i_lap, b % j_lap].setdefault(a, []).append(b)
    recurs: Literal["in place"] | None = None
    for j_by_i in j_at_place.values():
        latest = -1
        for _, visits in sorted(j_by_i.items()):
            if min(visits) < latest:
                return "head-on"
            if len(visits) > 1 or latest in visits:
                recurs = "in place"
            latest = max(latest, *visits)
    return recurs


WindowRule = Callable[[Window, Meeting, Segment], Literal[0, 1]]
"""Returns the robot (0: i, 1: j) of a meeting that waits if possible; else the other waits."""
