"""Robots on fixed routes, until nobody meets any more: one right of way after the other.

Which of two robots waits is up to a rule; everything around it is here. The pair that meets first
is settled first. Where no waiting keeps two robots apart, one of them is set aside and, when all
others have their times, sent another way (`rerouting`). Where that does not work out, or takes
more than its share of the time, the whole fleet is planned together (`joint`). So whatever the
rule, a planner that is made of this is complete: given time it finds a plan or proves that there
is none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rightofway.errors import GaveUp
from rightofway.model import Decision, Reroute, Route, Scenario, Tick
from rightofway.planners.joint import plan_jointly
from rightofway.planners.rerouting import reroute
from rightofway.planners.task import Draft, Task, planning_headway
from rightofway.precedence import (
    Meeting,
    PrecedenceGraph,
    Segment,
    crossing,
    graph_of,
    shared_segment,
)
from rightofway.search import Distances

__all__ = ["Fleet", "Right", "Rule", "Settlement", "one_by_one", "plan_by_rule", "rights_if_waits"]

SHARE = 0.8
"""The part of the time that giving way gets; the rest is for planning all together."""

Right = tuple[int, int]
"""Two visits of the graph, of which the first goes first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settlement:
    """How two robots that meet are kept apart."""

    decisions: tuple[Decision, ...]
    rights: tuple[Right, ...]


class Fleet:
    """The robots on their routes while rights of way are being given.

    Parameters
    ----------
    task
        The problem.
    routes
        One for each robot.
    sees_swaps
        Whether a swap is a meeting, and segments are decided at once; the published method does
        neither.
    graph
        What is decided before; nothing where it is not given.

    Attributes
    ----------
    graph
        What is decided so far.
    settled
        Per robot whether a decision holds for it; uint8, as masks are for the graph.
    aside
        Robots that were set aside, and why.
    decisions
        All decisions in the order they were taken.
    """

    def __init__(
        self,
        task: Task,
        routes: Sequence[Route],
        *,
        sees_swaps: bool = True,
        graph: PrecedenceGraph | None = None,
    ) -> None:
        self.task = task
        self.routes = routes
        self.sees_swaps = sees_swaps
        self.settled = np.zeros(len(routes), np.uint8)
        self.aside: dict[int, str] = {}
        self.decisions: list[Decision] = []
        self.graph = graph or PrecedenceGraph(
            routes,
            headway=planning_headway(task.scenario),
            books_ahead=task.scenario.rules.books_ahead,
            forbid_swaps=sees_swaps,
        )

    def settle_all(self, rule: Rule) -> None:
        """Settle the pair that meets first, until nobody meets."""
        while (meeting := self.graph.next_meeting()) is not None:
            self.task.deadline.check("giving right of way")
            settlement = rule(self, meeting)
            if settlement is None:
                self.set_aside(meeting)
            else:
                self.adopt(settlement, meeting.robots)

    def segment_of(self, meeting: Meeting) -> Segment:
        """Return where only one of the two can be at a time."""
        (i, visit_i), (j, visit_j) = (self.graph.place(visit) for visit in meeting.visits)
        if self.sees_swaps:
            return shared_segment(self.routes[i], visit_i, self.routes[j], visit_j)
        return crossing(self.routes[i], visit_i, visit_j)

    def adopt(self, settlement: Settlement, robots: tuple[int, int]) -> None:
        """Give the rights of way of a settlement for good."""
        self.graph.give_all(settlement.rights)
        self.decisions += settlement.decisions
        self.settled[list(robots)] = 1

    def set_aside(self, meeting: Meeting) -> None:
        """Take out one of two robots that no waiting keeps apart; the others keep their rights."""
        why = self.explain_deadlock(meeting)
        if not self.sees_swaps:
            raise GaveUp(f"{why} (the published method is stuck here; try swaps=resolve)")
        everyone = np.ones(len(self.routes), np.uint8)
        robot = max(meeting.robots, key=lambda one: (self.graph.conflicts_of(one, everyone), one))
        self.aside[robot] = why
        self.settled[robot] = 0
        self.graph.withdraw(robot)

    def explain_deadlock(self, meeting: Meeting) -> str:
        """Say who cannot be kept apart, and who waits for whom if one of them waits."""
        names = [self.task.scenario.robots[robot].name for robot in meeting.robots]
        place = self.task.scenario.roadmap.name(self.graph.vertex(meeting.visits[0]))
        why = f"waiting cannot keep {names[0]} and {names[1]} apart at {place}"
        circle = self.circle_if_waits(meeting)
        if len(circle) < 3:  # noqa: PLR2004 (the two themselves)
            return why
        return f"{why}: in a circle, {', '.join(circle)} would each wait for the next"

    def circle_if_waits(self, meeting: Meeting) -> list[str]:
        """Return the robots that would be deadlocked if one of the two waited; none if it could."""
        segment, mark = self.segment_of(meeting), self.graph.checkpoint()
        for waits in (0, 1):
            possible = self.graph.give_all(rights_if_waits(self.graph, meeting, segment, waits))
            self.graph.rollback(mark)
            robots = [] if possible else self.graph.deadlocked()
            if robots:
                return [self.task.scenario.robots[robot].name for robot in robots]
        return []

    def decide(self, meeting: Meeting, segment: Segment, waits: int, delay: Tick) -> Decision:
        """Write down for the user that one of two robots waits; the rule adds its reasons."""
        i, j = meeting.robots
        first_visit = segment.i_first if waits == 0 else segment.j_first
        ahead = segment.vertices
        return Decision(
            tick=meeting.tick,
            kind=segment.kind,
            vertices=ahead[::-1] if waits == 0 and segment.kind == "head-on" else ahead,
            robots=(i, j),
            waits=meeting.robots[waits],
            waits_at=self.routes[meeting.robots[waits]].vertices[first_visit - 1],
            ticks=delay,
            level="only",
            conflicts_left=(None, None),
        )


Rule = Callable[[Fleet, Meeting], Settlement | None]
"""Says how two robots that meet are kept apart; None if no waiting does."""


def rights_if_waits(
    graph: PrecedenceGraph, meeting: Meeting, segment: Segment, waits: int
) -> tuple[Right, ...]:
    """Return the rights of way in a segment if one of two robots (0: i, 1: j) waits."""
    i, j = meeting.robots
    if waits == 0:
        return tuple((graph.visit(j, b), graph.visit(i, a)) for a, b in segment.if_i_waits())
    return tuple((graph.visit(i, a), graph.visit(j, b)) for a, b in segment.if_j_waits())


def plan_by_rule(task: Task, distances: Distances, routes: Sequence[Route], rule: Rule) -> Draft:
    """Plan a fleet by giving way, and where that gets stuck by other means.

    Parameters
    ----------
    task
        The problem.
    distances
        Tables of its roadmap.
    routes
        One for each robot.
    rule
        Who waits.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.
    """
    try:
        hurried = replace(task, deadline=task.deadline.sooner(SHARE))
        return one_by_one(hurried, distances, Fleet(hurried, routes), rule)
    except GaveUp:
        return all_together(task, "time was short, so all were planned together")


def one_by_one(task: Task, distances: Distances, fleet: Fleet, rule: Rule) -> Draft:
    """Give rights of way, then send those another way whom no waiting helps."""
    fleet.settle_all(rule)
    tracks = {r: t for r, t in enumerate(fleet.graph.tracks()) if r not in fleet.aside}
    rerouted = reroute(task, distances, tracks, list(fleet.aside))
    if rerouted is None:
        because = "one robot at a time finds no way, so all were planned together"
        return all_together(task, because)
    ordered = [track for _, track in sorted(tracks.items())]
    if rerouted:  # whoever waited for a robot that goes another way need not wait any more
        ordered = graph_of(task.scenario, ordered).tracks()
    return Draft(
        tracks=tuple(ordered),
        status=_status(task.scenario, rerouted),
        decisions=tuple(one for one in fleet.decisions if not set(one.robots) & set(rerouted)),
        reroutes=tuple(
            Reroute(robot=robot, because=fleet.aside.get(robot, "stood in the way of another one"))
            for robot in rerouted
        ),
        keeps_swaps=not fleet.sees_swaps,
    )


def all_together(task: Task, because: str) -> Draft:
    """Plan the whole fleet anew."""
    return Draft(
        tracks=tuple(plan_jointly(task)[0]),
        status="re-routed all robots together",
        reroutes=tuple(
            Reroute(robot=robot, because=because) for robot in range(len(task.scenario.robots))
        ),
    )


def _status(scenario: Scenario, rerouted: Sequence[int]) -> str:
    if not rerouted:
        return "waits only"
    return "re-routed " + ", ".join(scenario.robots[robot].name for robot in rerouted)
