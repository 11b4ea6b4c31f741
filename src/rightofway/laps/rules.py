"""Rules of right of way on endless routes: of two robots that meet, which one waits.

Each rule sees a window: some laps of each robot, with the rights of way given so far and the
timetable that follows. So what it says is a function of the state that the window begins with.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from rightofway.planners.giving_way import Fleet
from rightofway.planners.two_level import by_two_levels
from rightofway.precedence import Meeting, Segment

__all__ = ["FAR_SIGHTED", "RULES", "EndlessRule", "Waits"]

Waits = Literal[0, 1]
"""Which robot of a meeting (i, j): 0 for i, 1 for j."""

EndlessRule = Callable[[Fleet, Meeting, Segment], Waits]
"""Says who waits if it can; where it cannot, the other one does."""


def first_come(fleet: Fleet, meeting: Meeting, segment: Segment) -> Waits:
    """Let that robot go first which would enter the segment first; on a tie the first listed."""
    i, j = meeting.robots
    graph = fleet.graph
    i_enters = graph.enter(graph.visit(i, segment.i_first))
    j_enters = graph.enter(graph.visit(j, segment.j_first))
    return 0 if j_enters < i_enters else 1


def fixed_order(_fleet: Fleet, _meeting: Meeting, _segment: Segment) -> Waits:
    """Let that robot go first which the scenario lists first."""
    return 1


def two_level(fleet: Fleet, meeting: Meeting, segment: Segment) -> Waits:
    """Follow the paper: fewest conflicts left, then least time for the two of them.

    Both are counted to the end of the window. Where the paper's way finds no end, who comes first
    goes first.
    """
    settlement = by_two_levels(fleet, meeting)
    if settlement is None or not settlement.decisions:
        return first_come(fleet, meeting, segment)
    decision = settlement.decisions[0]
    return 0 if decision.waits == meeting.robots[0] else 1


FAR_SIGHTED = frozenset({"two-level"})
"""Rules that count what happens in this lap and the next; the others see two robots only."""

RULES: dict[str, EndlessRule] = {
    "first-come": first_come,
    "fixed-order": fixed_order,
    "two-level": two_level,
}
"""All rules by name."""
