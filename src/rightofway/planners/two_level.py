"""Right of way on two levels: the method of the paper.

Robots run free on their shortest routes. Where two of them meet, one waits in the vertex before
until the other has left. Who waits is decided on two levels: the *node level* counts the conflicts
that either choice leaves in the whole system; where these are equal, the *robot level* follows
both choices to their ends, in two groups, and takes the one in which the two robots achieve their
work sooner.

The paper leaves swaps unsolved. Here robots that meet head-on share a segment, and the right of
way is decided for the whole of it at once (``swaps="leave"`` gives the published behaviour).

References
----------
Oleiwi, *Optimum path planning for multi mobile robots with speed of work achievement as
constrain*.

Notes
-----
Deterministic. Rights of way once given are kept, so the method ends: it has decided every meeting,
or it has found one that no waiting can open (a deadlock). Then one of the two robots is set aside
and, when all others have their times, sent another way (`rerouting`). Where that does not work
out, or takes more than its share of the time, the whole fleet is planned together (`joint`). So
with ``swaps="resolve"`` the planner is complete: given time it finds a plan or proves that there
is none. It is not optimal.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from rightofway.errors import GaveUp
from rightofway.model import Decision, Reroute, Route, Scenario, Tick
from rightofway.planners.joint import plan_jointly
from rightofway.planners.rerouting import reroute
from rightofway.planners.routing import shortest_routes
from rightofway.planners.task import Draft, Task, planning_headway
from rightofway.precedence import Meeting, PrecedenceGraph, Segment, graph_of, head_on_segment
from rightofway.search import Distances

__all__ = ["two_level"]

SHARE = 0.8
"""The part of the time that the method of the paper gets; the rest is for planning all together."""

Level = Literal["node", "robot", "only", "settled"]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Choice:
    """One way to settle a meeting: robot ``waits`` (0: i, 1: j) lets the other one go first."""

    waits: int
    first: int
    second: int
    conflicts_left: int
    meets_settled: bool
    delay: Tick


@dataclass(frozen=True, slots=True, kw_only=True)
class _Group:
    """A movement group: all meetings of two robots settled, and when both are done."""

    decisions: tuple[Decision, ...]
    rights: tuple[tuple[int, int], ...]
    completion_sum: int


def two_level(task: Task) -> Draft:
    """Plan a fleet by the method of the paper.

    Parameters
    ----------
    task
        Options: ``swaps`` is ``resolve`` or ``leave``.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out; with ``swaps="leave"`` also where the published method is stuck.
    """
    distances = Distances(task.scenario.roadmap)
    if task.options["swaps"] == "leave":
        return _one_by_one(task, distances)
    try:
        return _one_by_one(replace(task, deadline=task.deadline.sooner(SHARE)), distances)
    except GaveUp:
        return _all_together(task, distances, "time was short, so all were planned together")


def _one_by_one(task: Task, distances: Distances) -> Draft:
    """Give rights of way on the shortest routes, then re-route whom no waiting helps."""
    fleet = _Fleet(task, shortest_routes(task.scenario, distances))
    fleet.settle_all()
    tracks = {r: t for r, t in enumerate(fleet.graph.tracks()) if r not in fleet.aside}
    rerouted = reroute(task, distances, tracks, list(fleet.aside))
    if rerouted is None:
        because = "one robot at a time finds no way, so all were planned together"
        return _all_together(task, distances, because)
    ordered = [track for _, track in sorted(tracks.items())]
    if rerouted:  # whoever waited for a robot that goes another way need not wait any more
        ordered = graph_of(task.scenario, ordered).tracks()
    return Draft(
        tracks=tuple(ordered),
        status=_status(task.scenario, rerouted),
        decisions=tuple(fleet.decisions_that_hold(rerouted)),
        reroutes=tuple(
            Reroute(robot=robot, because=fleet.aside.get(robot, "stood in the way of another one"))
            for robot in rerouted
        ),
        keeps_swaps=not fleet.by_segment,
    )


def _all_together(task: Task, distances: Distances, because: str) -> Draft:
    """Plan the whole fleet anew."""
    return Draft(
        tracks=tuple(plan_jointly(task, distances)),
        status="re-routed all robots together",
        reroutes=tuple(
            Reroute(robot=robot, because=because) for robot in range(len(task.scenario.robots))
        ),
    )


class _Fleet:
    """The robots on their routes while rights of way are being decided."""

    def __init__(self, task: Task, routes: list[Route]) -> None:
        self.task = task
        self.routes = routes
        self.by_segment = task.options["swaps"] == "resolve"
        self.aside: dict[int, str] = {}
        self.settled: set[int] = set()
        self.decisions: list[Decision] = []
        self.graph = PrecedenceGraph(
            routes,
            headway=planning_headway(task.scenario),
            books_ahead=task.scenario.rules.books_ahead,
            forbid_swaps=self.by_segment,
        )

    def settle_all(self) -> None:
        """Settle the pair that meets first, until nobody meets."""
        while (meeting := self.graph.next_meeting()) is not None:
            self.task.deadline.check("giving right of way")
            group = self.better_group(*meeting.robots)
            if group is None:
                self.set_aside(meeting)
            else:
                self.adopt(group, meeting.robots)

    def better_group(self, i: int, j: int) -> _Group | None:
        """Follow both movement groups of a pair; the one sooner done wins, group one on a tie."""
        one = self.follow(i, j, on_tie=0)
        if one is not None and all(decision.level != "robot" for decision in one.decisions):
            return one
        two = self.follow(i, j, on_tie=1)
        sums = tuple(None if group is None else group.completion_sum for group in (one, two))
        if one is None or (two is not None and two.completion_sum < one.completion_sum):
            return _with_sums(two, sums)
        return _with_sums(one, sums)

    def follow(self, i: int, j: int, *, on_tie: int) -> _Group | None:
        """Settle all meetings of a pair in order of time, then take everything back.

        Where the node level leaves it open, ``on_tie`` (0: i, 1: j) waits.
        """
        mark, decisions, rights = self.graph.checkpoint(), [], []
        while (meeting := self.graph.next_meeting_of(i, j)) is not None:
            shared = self.shared_segment(meeting)
            choices = [self.attempt(meeting, shared, waits) for waits in (0, 1)]
            chosen, level = _node_level(choices, on_tie)
            if chosen is None:
                self.graph.rollback(mark)
                return None
            decisions.append(self.explain(meeting, shared, choices, chosen, level))
            self.graph.give_way(chosen.first, chosen.second)
            rights.append((chosen.first, chosen.second))
        total = self.graph.completion(i) + self.graph.completion(j)
        self.graph.rollback(mark)
        return _Group(decisions=tuple(decisions), rights=tuple(rights), completion_sum=total)

    def shared_segment(self, meeting: Meeting) -> Segment:
        """Return where only one of the two can be: a head-on segment, or just the vertex."""
        (i, visit_i), (j, visit_j) = (self.graph.place(visit) for visit in meeting.visits)
        if self.by_segment:
            return head_on_segment(self.routes[i], visit_i, self.routes[j], visit_j)
        here = (self.routes[i].vertices[visit_i],)
        return Segment(
            i_first=visit_i, i_last=visit_i, j_first=visit_j, j_last=visit_j, vertices=here
        )

    def attempt(self, meeting: Meeting, shared: Segment, waits: int) -> _Choice | None:
        """Let one of the two wait until the other has left, and count; None if impossible."""
        i, j = meeting.robots
        if waits == 0:
            first, second = self.graph.visit(j, shared.j_last), self.graph.visit(i, shared.i_first)
        else:
            first, second = self.graph.visit(i, shared.i_last), self.graph.visit(j, shared.j_first)
        others = sorted(self.settled - {i, j})
        mark, planned = self.graph.checkpoint(), self.graph.enter(second)
        met = self.graph.conflicts_of(meeting.robots[waits], others)
        if not self.graph.give_way(first, second):
            return None
        choice = _Choice(
            waits=waits,
            first=first,
            second=second,
            conflicts_left=self.graph.conflicts_left(),
            meets_settled=self.graph.conflicts_of(meeting.robots[waits], others) > met,
            delay=Tick(self.graph.enter(second) - planned),
        )
        self.graph.rollback(mark)
        return choice

    def explain(
        self,
        meeting: Meeting,
        shared: Segment,
        choices: list[_Choice | None],
        chosen: _Choice,
        level: Level,
    ) -> Decision:
        """Write down a decision for the user."""
        left = [None if choice is None else choice.conflicts_left for choice in choices]
        return Decision(
            tick=meeting.tick,
            kind="vertex" if len(shared.vertices) == 1 else "head-on",
            vertices=shared.vertices if chosen.waits == 1 else shared.vertices[::-1],
            robots=meeting.robots,
            waits=meeting.robots[chosen.waits],
            waits_at=self.graph.vertex(chosen.second - 1),
            ticks=chosen.delay,
            level=level,
            conflicts_left=(left[0], left[1]),
        )

    def adopt(self, group: _Group, robots: tuple[int, int]) -> None:
        """Give the rights of way of a group for good."""
        for first, second in group.rights:
            self.graph.give_way(first, second)
        self.decisions += group.decisions
        self.settled |= set(robots)

    def set_aside(self, meeting: Meeting) -> None:
        """Take out one of two robots that no waiting keeps apart; the others keep their rights."""
        names = [self.task.scenario.robots[robot].name for robot in meeting.robots]
        place = self.task.scenario.roadmap.name(self.graph.vertex(meeting.visits[0]))
        why = f"waiting cannot keep {names[0]} and {names[1]} apart at {place}"
        if not self.by_segment:
            raise GaveUp(f"{why} (the published method is stuck here; try swaps=resolve)")
        everyone = [robot for robot in range(len(self.routes)) if robot not in self.aside]
        robot = max(meeting.robots, key=lambda one: (self.graph.conflicts_of(one, everyone), one))
        self.aside[robot] = why
        self.settled.discard(robot)
        self.graph.withdraw(robot)

    def decisions_that_hold(self, rerouted: Sequence[int]) -> list[Decision]:
        """Return the decisions between robots that stayed on their routes."""
        return [one for one in self.decisions if not set(one.robots) & set(rerouted)]


def _node_level(choices: Sequence[_Choice | None], on_tie: int) -> tuple[_Choice | None, Level]:
    """Choose who waits by the conflicts left in the whole system."""
    possible = [choice for choice in choices if choice is not None]
    if len(possible) < len(choices):
        return (possible[0] if possible else None), "only"
    clear = [choice for choice in possible if not choice.meets_settled]
    if len(clear) == 1:
        return clear[0], "settled"
    i_waits, j_waits = possible
    if i_waits.conflicts_left == j_waits.conflicts_left:
        return possible[on_tie], "robot"
    return min(possible, key=lambda choice: choice.conflicts_left), "node"


def _with_sums(group: _Group | None, sums: tuple[int | None, ...]) -> _Group | None:
    """Note both groups' sums at the decisions that the robot level took."""
    if group is None:
        return None
    decisions = tuple(
        replace(one, completion_sums=(sums[0], sums[1])) if one.level == "robot" else one
        for one in group.decisions
    )
    return replace(group, decisions=decisions)


def _status(scenario: Scenario, rerouted: Sequence[int]) -> str:
    if not rerouted:
        return "waits only"
    return "re-routed " + ", ".join(scenario.robots[robot].name for robot in rerouted)
