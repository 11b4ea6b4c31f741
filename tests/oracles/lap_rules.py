"""The rules of the native simulator of repeated laps, as functions of a window."""

from __future__ import annotations

from typing import Literal

from rightofway.cyclic.rolling_horizon import RollingHorizon
from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.simulator import HorizonParams, choose_pacemaker
from rightofway.cyclic.window import Window, WindowRule
from rightofway.precedence import Meeting, Segment
from rightofway.repair.conflict_resolution import list_rights_if_waits

__all__ = ["rolling"]

LAP_LOSS = 1 << 40


def first_come(window: Window, meeting: Meeting, segment: Segment) -> Literal[0, 1]:
    """Let the robot go first that would enter the segment first; on a tie the first listed."""
    (i, j), graph = meeting.robots, window.graph
    i_enters = graph.enter(graph.get_visit(i, segment.i_first))
    j_enters = graph.enter(graph.get_visit(j, segment.j_first))
    return 0 if j_enters < i_enters else 1


def fixed_order(_window: Window, _meeting: Meeting, _segment: Segment) -> Literal[0, 1]:
    """Let the robot go first that the scenario lists first."""
    return 1


def least_loss(window: Window, meeting: Meeting, segment: Segment) -> Literal[0, 1]:
    """Let the robot wait that loses the smaller part of a lap; on a tie as first come."""
    of_i, of_j = (_loss(window, meeting, segment, waits) for waits in (0, 1))
    if of_i == of_j:
        return first_come(window, meeting, segment)
    return 0 if of_i < of_j else 1


def _loss(window: Window, meeting: Meeting, segment: Segment, waits: int) -> int:
    """Return the part of a lap that a robot loses by waiting: how late it is in the segment."""
    graph, context = window.graph, window.context
    later = 0
    for first, second in list_rights_if_waits(graph, meeting, segment, waits):
        robot, number = window.number(second)
        approach = context.routes[robot].drive(number) if context.booking_rules.books_ahead else 0
        due = graph.enter(first + 1) + context.booking_rules.headway + approach
        later = max(later, due - graph.enter(second))
    return later * max(LAP_LOSS // context.laps[meeting.robots[waits]].duration, 1)


RULES: dict[str, WindowRule] = {
    "first-come": first_come,
    "fixed-order": fixed_order,
    "least-loss": least_loss,
}


def rolling(context: GroupContext, rule: str) -> RollingHorizon:
    """Return the slow simulation of a native rule, with the pacemaker of the native simulator."""
    least = -(-context.longest // HorizonParams().pacemaker_part)
    pacemaker = choose_pacemaker(context.laps, least)
    return RollingHorizon(context, RULES[rule], pacemaker=pacemaker)
