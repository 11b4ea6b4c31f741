"""Robots that may drive and do not move: an alarm of their own, though nothing else is wrong.

A robot that is stuck may report for hours that it drives. A robot moves if it arrives at a node or
if its reported position changes. No release depends on it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import dist

import numpy as np

from rightofway.control.dispatcher import Dispatcher
from rightofway.control.notices import Notices
from rightofway.control.robot_ledger import RobotLedger
from rightofway.facts import Fact
from rightofway.model.route import compute_drives_along, compute_turns_along

__all__ = ["STILL", "Standstill"]

STILL = "still"
"""The kind of trouble of a robot that may drive and does not move."""

PATIENCE = 10
"""Seconds beyond twice the planned time of a drive after which a robot does not move."""

MOVED = 0.1
"""By how much a position changes at least where a robot moves [m]; less is noise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Stand:
    """The place of a robot since its last move.

    Attributes
    ----------
    arrived
        The visit at which it has arrived.
    point
        Its reported position; None where it reports none.
    tick
        When it was seen there [ticks].
    """

    arrived: int
    point: tuple[float, float] | None
    tick: int


class Standstill:
    """The look-out for robots that do not move.

    Parameters
    ----------
    dispatcher
        The work of robots.
    notices
        Receives begin and end of each standstill.
    read_ticks
        Returns the time since the run began [ticks].
    """

    def __init__(
        self, dispatcher: Dispatcher, notices: Notices, read_ticks: Callable[[], int]
    ) -> None:
        self._control, self._notices, self._read_ticks = dispatcher.control, notices, read_ticks
        self._scenario = dispatcher.plan.scenario
        clock, seconds = self._scenario.problem.clock, self._scenario.units.seconds or 1
        self._patience = int(PATIENCE / (clock.tick * seconds)) + 1  # [ticks]
        self._stands: dict[int, _Stand] = {}

    def look(self) -> None:
        """Report the robots that have begun to stand still, or move again; call it every second."""
        now = self._read_ticks()
        for robot, own in enumerate(self._control.ledger.robots):
            if own.is_off or own.released == own.arrived:
                self._stands.pop(robot, None)
                self._notices.end(robot, STILL)
                continue
            point, stand = self._control.points.get(robot), self._stands.get(robot)
            if stand is None or stand.arrived != own.arrived or _is_apart(stand.point, point):
                self._stands[robot] = _Stand(arrived=own.arrived, point=point, tick=now)
                self._notices.end(robot, STILL)
            elif own.fault is not None or not self._control.is_fit(robot):
                continue  # that has an alarm already
            elif now - stand.tick > 2 * self._count_drive(robot, own) + self._patience:
                route = own.route
                begin = Fact(
                    "not moving",
                    place=route.get_place(own.arrived),
                    target=route.get_place(own.released),
                )
                self._notices.begin(robot, STILL, begin, Fact("moving"))

    def _count_drive(self, robot: int, own: RobotLedger) -> int:
        """Return how long a robot turns and drives to its next vertex by plan [ticks]."""
        roadmap, itinerary = self._scenario.roadmap, self._scenario.problem.itineraries[robot]
        before = max(own.arrived - 1, own.route.first)
        places = own.route.stretch(before, own.arrived + 2)
        vertices = np.array([roadmap.get_vertex(place) for place in places], np.int32)
        turns = compute_turns_along(roadmap, itinerary, vertices)
        return compute_drives_along(roadmap, itinerary, vertices.tolist())[-1] + int(turns.sum())


def _is_apart(first: tuple[float, float] | None, second: tuple[float, float] | None) -> bool:
    """Return whether two positions are of a robot that has moved between them."""
    if first is None or second is None:
        return first is not second
    return dist(first, second) > MOVED
