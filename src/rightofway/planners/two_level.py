"""Right of way on two levels: the method of the paper.

Robots run free on their routes. Where two of them meet, one waits in the vertex before until the
other has left. Who waits is decided on two levels: the *node level* counts the conflicts that
either choice leaves in the whole system; where these are equal, the *robot level* follows both
choices to their ends, in two groups, and takes the one in which the two robots achieve their work
sooner.

The paper leaves swaps unsolved. Here two robots whose routes run together share a segment, and the
right of way is decided for the whole of it at once; ``swaps="leave"`` gives the published
behaviour, vertex by vertex.

References
----------
Oleiwi, *Optimum path planning for multi mobile robots with speed of work achievement as
constrain*.

Notes
-----
Deterministic. Rights of way once given are kept, so the method ends: it has decided every meeting,
or it has found one that no waiting can open (`giving_way` says what then). With
``swaps="resolve"`` the planner is complete: given time it finds a plan or proves that there is
none. It is not optimal.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from rightofway.model import Decision, Tick
from rightofway.planners.conflict_resolution import (
    Fleet,
    Right,
    Settlement,
    one_by_one,
    plan_by_rule,
    rights_if_waits,
)
from rightofway.planners.routing import clear_routes, shortest_routes
from rightofway.planners.task import Draft, Task
from rightofway.precedence import Meeting, Segment
from rightofway.search import Distances

__all__ = ["by_two_levels", "two_level"]

Level = Literal["node", "robot", "only", "settled"]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Choice:
    """One way to settle a meeting: robot ``waits`` (0: i, 1: j) lets the other one go first."""

    waits: int
    rights: tuple[Right, ...]
    conflicts_left: int
    meets_settled: bool
    delay: Tick
    level: Level = "only"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Group:
    """A movement group: all meetings of two robots settled, and when both are done."""

    settlement: Settlement
    completion_sum: int


def two_level(task: Task) -> Draft:
    """Plan a fleet by the method of the paper.

    Parameters
    ----------
    task
        Options: ``swaps`` is ``resolve`` or ``leave``, ``routes`` is ``clear`` or ``shortest``.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out; with ``swaps="leave"`` also where the published method is stuck.
    """
    distances = Distances(task.scenario.roadmap)
    if task.options.get("swaps") == "leave":
        routes = shortest_routes(task.scenario, distances)
        return one_by_one(task, distances, Fleet(task, routes, sees_swaps=False), by_two_levels)
    choose = clear_routes if task.options["routes"] == "clear" else shortest_routes
    return plan_by_rule(task, distances, choose(task.scenario, distances), by_two_levels)


def by_two_levels(fleet: Fleet, meeting: Meeting) -> Settlement | None:
    """Follow both movement groups of a pair; the one sooner done wins, group one on a tie."""
    i, j = meeting.robots
    one = _follow(fleet, i, j, on_tie=0)
    if one is not None and all(decision.level != "robot" for decision in one.settlement.decisions):
        return one.settlement
    two = _follow(fleet, i, j, on_tie=1)
    sums = tuple(None if group is None else group.completion_sum for group in (one, two))
    if one is None or (two is not None and two.completion_sum < one.completion_sum):
        return _with_sums(two, sums)
    return _with_sums(one, sums)


def _follow(fleet: Fleet, i: int, j: int, *, on_tie: int) -> _Group | None:
    """Settle all meetings of a pair in order of time, then take everything back.

    Where the node level leaves it open, ``on_tie`` (0: i, 1: j) waits.
    """
    graph = fleet.graph
    mark = graph.checkpoint()
    decisions: list[Decision] = []
    rights: list[Right] = []
    while (meeting := graph.next_meeting_of(i, j)) is not None:
        segment = fleet.segment_of(meeting)
        choices = [_attempt(fleet, meeting, segment, waits) for waits in (0, 1)]
        chosen = _node_level(choices, on_tie)
        if chosen is None:
            graph.rollback(mark)
            return None
        decisions.append(_explain(fleet, meeting, segment, choices, chosen))
        graph.give_all(chosen.rights)
        rights += chosen.rights
    completion_sum = graph.completion(i) + graph.completion(j)
    graph.rollback(mark)
    settlement = Settlement(decisions=tuple(decisions), rights=tuple(rights))
    return _Group(settlement=settlement, completion_sum=completion_sum)


def _attempt(fleet: Fleet, meeting: Meeting, segment: Segment, waits: int) -> _Choice | None:
    """Let one of the two wait until the other has left, and count; None if impossible."""
    graph, robot = fleet.graph, meeting.robots[waits]
    others = fleet.settled.copy()
    others[list(meeting.robots)] = 0
    rights = rights_if_waits(graph, meeting, segment, waits)
    enters = rights[0][1]
    mark, planned, met = graph.checkpoint(), graph.enter(enters), graph.conflicts_of(robot, others)
    if not graph.give_all(rights):
        return None
    choice = _Choice(
        waits=waits,
        rights=rights,
        conflicts_left=graph.conflicts_left(),
        meets_settled=graph.conflicts_of(robot, others) > met,
        delay=Tick(graph.enter(enters) - planned),
    )
    graph.rollback(mark)
    return choice


def _node_level(choices: Sequence[_Choice | None], on_tie: int) -> _Choice | None:
    """Choose who waits by the conflicts left in the whole system."""
    possible = [choice for choice in choices if choice is not None]
    if len(possible) < len(choices):
        return possible[0] if possible else None
    clear = [choice for choice in possible if not choice.meets_settled]
    if len(clear) == 1:
        return replace(clear[0], level="settled")
    i_waits, j_waits = possible
    if i_waits.conflicts_left == j_waits.conflicts_left:
        return replace(possible[on_tie], level="robot")
    return replace(min(possible, key=lambda choice: choice.conflicts_left), level="node")


def _explain(
    fleet: Fleet,
    meeting: Meeting,
    segment: Segment,
    choices: list[_Choice | None],
    chosen: _Choice,
) -> Decision:
    """Write down a decision for the user."""
    left = [None if choice is None else choice.conflicts_left for choice in choices]
    decision = fleet.decide(meeting, segment, chosen.waits, chosen.delay)
    return replace(decision, level=chosen.level, conflicts_left=(left[0], left[1]))


def _with_sums(group: _Group | None, sums: tuple[int | None, ...]) -> Settlement | None:
    """Note both groups' sums at the decisions that the robot level took."""
    if group is None:
        return None
    decisions = tuple(
        replace(one, completion_sums=(sums[0], sums[1])) if one.level == "robot" else one
        for one in group.settlement.decisions
    )
    return replace(group.settlement, decisions=decisions)
