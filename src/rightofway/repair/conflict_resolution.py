"""Conflicts between robots on fixed routes, resolved one right of way after the other.

A *rule* decides which of two robots waits; this module does the rest. The earliest conflict is
resolved first. Where no waiting keeps two robots apart, one of them is deferred, to be rerouted
when all others have their times.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Decision, Route, Tick, Track
from rightofway.model.kept_facts import RerouteReason
from rightofway.precedence import (
    Meeting,
    PrecedenceGraph,
    Segment,
    build_graph,
    find_rotation,
    make_crossing,
)
from rightofway.repair.plan_request import PlanRequest

Right = tuple[int, int]
"""Two visits of the graph, of which the first goes first."""

GIVING = Fact("giving right of way")


@dataclass(frozen=True, slots=True, kw_only=True)
class Resolution:
    """How a conflict of two robots is resolved."""

    decisions: tuple[Decision, ...]
    rights: tuple[Right, ...]


class PartialPlan:
    """A fleet on its routes, with the rights of way that are decided so far.

    Attributes
    ----------
    sees_swaps
        Whether a swap is a conflict, and segments are decided at once; the published method does
        neither.
    graph
        The rights of way.
    settled
        Per robot whether a decision holds for it; uint8, as masks are for the graph.
    deferred
        Robots that are rerouted at the end, and why.
    decisions
        All decisions in the order they were taken.
    """

    def __init__(
        self,
        request: PlanRequest,
        routes: Sequence[Route],
        *,
        sees_swaps: bool = True,
        graph: PrecedenceGraph | None = None,
    ) -> None:
        self.request = request
        self.routes = routes
        self.sees_swaps = sees_swaps
        self.settled = np.zeros(len(routes), np.uint8)
        self.deferred: dict[int, RerouteReason] = {}
        self.decisions: list[Decision] = []
        self.graph = graph or build_graph(request.scenario.problem, routes, forbid_swaps=sees_swaps)

    def resolve_all(self, rule: Rule) -> None:
        """Resolve the earliest conflict until none is left; defer where the rule cannot."""
        while True:
            self.request.deadline.check(GIVING)
            meeting = self.graph.find_next_meeting()
            if meeting is None:
                rotation = find_rotation(self.request.scenario.problem, self._list_tracks())
                if not rotation:
                    return
                self.defer(rotation, self._name_rotation(rotation))
                continue
            resolution = rule(self, meeting)
            if resolution is None:
                self.defer(meeting.robots, self.explain_deadlock(meeting))
                continue
            self.graph.give_all(resolution.rights)
            self.decisions += resolution.decisions
            self.settled[list(meeting.robots)] = 1

    def _list_tracks(self) -> list[Track]:
        """Return the tracks at their times; that of a deferred robot has its home only."""
        return [
            Track.of([route.vertices[0]], [0]) if robot in self.deferred else track
            for robot, (route, track) in enumerate(
                zip(self.routes, self.graph.build_tracks(), strict=True)
            )
        ]

    def find_segment(self, meeting: Meeting) -> Segment:
        """Return the visits of which one robot goes first in all."""
        if self.sees_swaps:
            return self.graph.find_segment(*meeting.visits)
        (i, visit_i), (j, visit_j) = (self.graph.place(visit) for visit in meeting.visits)
        return make_crossing(self.routes[i], visit_i, self.routes[j], visit_j)

    def defer(self, robots: Sequence[int], why: RerouteReason) -> None:
        """Take out one of some robots that no waiting keeps apart; the others keep their rights."""
        if not self.sees_swaps:
            raise GaveUp(Fact("method is stuck", reason=why))
        everyone = np.ones(len(self.routes), np.uint8)
        robot = max(
            robots,
            key=lambda candidate: (self.graph.count_conflicts_of(candidate, everyone), candidate),
        )
        self.deferred[robot] = why
        self.settled[robot] = 0
        self.graph.withdraw(robot)

    def _name_rotation(self, rotation: Sequence[int]) -> RerouteReason:
        """Name the robots that would move round a circle at one instant."""
        names = [self.request.scenario.robots[robot].name for robot in rotation]
        return RerouteReason("rotation", robots=names)

    def explain_deadlock(self, meeting: Meeting) -> RerouteReason:
        """Name the two robots, and the cycle of robots that one of them would close by waiting."""
        scenario, segment = self.request.scenario, self.find_segment(meeting)
        names = [scenario.robots[robot].name for robot in meeting.robots]
        place = scenario.roadmap.name(self.graph.get_vertex(meeting.visits[0]))
        mark = self.graph.checkpoint()
        for waits in (0, 1):
            possible = self.graph.give_all(
                list_rights_if_waits(self.graph, meeting, segment, waits)
            )
            self.graph.rollback(mark)
            cycle = [] if possible else self.graph.list_deadlocked()
            if cycle:
                circle = [scenario.robots[robot].name for robot in cycle]
                return describe_deadlock(names, place, circle)
        return describe_deadlock(names, place)

    def decide(self, meeting: Meeting, segment: Segment, waits: int, delay: Tick) -> Decision:
        """Record that one of two robots (0: i, 1: j) waits; rules add their reasons."""
        first_visit = segment.i_first if waits == 0 else segment.j_first
        return Decision(
            tick=meeting.tick,
            kind=segment.kind,
            vertices=segment.list_vertices_ahead(waits),
            robots=meeting.robots,
            waits=meeting.robots[waits],
            waits_at=self.routes[meeting.robots[waits]].vertices[first_visit - 1],
            ticks=delay,
            level="only",
            conflicts_left=(None, None),
        )


Rule = Callable[[PartialPlan, Meeting], Resolution | None]
"""Decides which of two robots waits; None if no waiting keeps them apart."""


def list_rights_if_waits(
    graph: PrecedenceGraph, meeting: Meeting, segment: Segment, waits: int
) -> tuple[Right, ...]:
    """Return the rights of way in a segment if one of two robots (0: i, 1: j) waits."""
    i, j = meeting.robots
    if waits == 0:
        return tuple(
            (graph.get_visit(j, b), graph.get_visit(i, a)) for a, b in segment.list_rights_of_j()
        )
    return tuple(
        (graph.get_visit(i, a), graph.get_visit(j, b)) for a, b in segment.list_rights_of_i()
    )


def describe_deadlock(
    names: Sequence[str], place: str, circle: Sequence[str] = ()
) -> RerouteReason:
    """Return which two robots no waiting keeps apart, and the circle that a wait would close."""
    meeting = {"one": names[0], "other": names[1], "place": place}
    if len(circle) < 3:  # noqa: PLR2004 (the two themselves)
        return RerouteReason("deadlock of two", **meeting)
    return RerouteReason("deadlock in circle", **meeting, robots=circle)
