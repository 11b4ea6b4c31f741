"""Rules of right of way on endless routes: of two robots that meet, which one waits.

Each rule sees a window: some laps of each robot, with the rights of way given so far and the
timetable that follows. So what it says is a function of the state that the window begins with.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal

from rightofway.cyclic.route import CyclicRoute
from rightofway.cyclic.window import Window
from rightofway.planners.conflict_resolution import rights_if_waits
from rightofway.planners.two_level import by_two_levels
from rightofway.precedence import Meeting, Segment

__all__ = ["FAR_SIGHTED", "RULES", "EndlessRule", "Waits", "losses"]

LAP = 1 << 40
"""What a lap is worth; so many parts of it that a tick is always a whole number of them."""

Waits = Literal[0, 1]
"""Which robot of a meeting (i, j): 0 for i, 1 for j."""

EndlessRule = Callable[[Window, Meeting, Segment], Waits]
"""Says who waits if it can; where it cannot, the other one does."""


def first_come(window: Window, meeting: Meeting, segment: Segment) -> Waits:
    """Let that robot go first which would enter the segment first; on a tie the first listed."""
    i, j = meeting.robots
    graph = window.graph
    i_enters = graph.enter(graph.visit(i, segment.i_first))
    j_enters = graph.enter(graph.visit(j, segment.j_first))
    return 0 if j_enters < i_enters else 1


def fixed_order(_window: Window, _meeting: Meeting, _segment: Segment) -> Waits:
    """Let that robot go first which the scenario lists first."""
    return 1


def losses(group: Sequence[CyclicRoute]) -> list[int]:
    """Return what a tick of waiting costs each robot: the part of its lap that is lost."""
    return [max(LAP // endless.lap.duration, 1) for endless in group]


def least_loss(window: Window, meeting: Meeting, segment: Segment) -> Waits:
    """Let that robot wait which loses the smaller part of a lap; on a tie as first come."""
    of_i, of_j = (_loss(window, meeting, segment, waits) for waits in (0, 1))
    if of_i == of_j:
        return first_come(window, meeting, segment)
    return 0 if of_i < of_j else 1


def _loss(window: Window, meeting: Meeting, segment: Segment, waits: Waits) -> int:
    """Return what it costs a robot to wait: how much later it is at a place of the segment."""
    graph = window.graph
    later = max(
        graph.enter(first + 1) + window.gap_before(second) - graph.enter(second)
        for first, second in rights_if_waits(graph, meeting, segment, waits)
    )
    return max(later, 0) * losses(window.group)[meeting.robots[waits]]


def two_level(window: Window, meeting: Meeting, segment: Segment) -> Waits:
    """Follow the paper: fewest conflicts left, then least time for the two of them.

    Both are counted to the end of the window. Where the paper's way finds no end, who comes first
    goes first.
    """
    settlement = by_two_levels(window, meeting)
    if settlement is None or not settlement.decisions:
        return first_come(window, meeting, segment)
    decision = settlement.decisions[0]
    return 0 if decision.waits == meeting.robots[0] else 1


FAR_SIGHTED = frozenset({"two-level"})
"""Rules that count what happens in this lap and the next; the others see two robots only."""

RULES: dict[str, EndlessRule] = {
    "first-come": first_come,
    "fixed-order": fixed_order,
    "least-loss": least_loss,
    "two-level": two_level,
}
"""All rules by name."""
