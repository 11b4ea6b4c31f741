"""Robots that do not go on for a while, and when the others are replanned round them."""

from __future__ import annotations

from rightofway.control.fleet_control import FleetControl
from rightofway.control.releases import list_strayed_to
from rightofway.precedence import Part

__all__ = ["StuckRobots"]


class StuckRobots:
    """The look-out for robots that do not go on.

    Parameters
    ----------
    control
        The control.
    patience
        Calls of `look` for which a robot does not go on before others are replanned round it.

    Attributes
    ----------
    passed
        Robots that the rest is planned round.
    """

    def __init__(self, control: FleetControl, patience: int) -> None:
        self._control, self._patience = control, patience
        self.passed = frozenset[int]()
        self._stuck_for: dict[int, int] = {}  # calls of `look` in a row, by robot
        self._held: list[tuple[str, ...]] = []  # what robots held when the rest was planned

    def look(self) -> frozenset[int]:
        """Return the robots that have not gone on for a while; call it every second."""
        control = self._control
        self._stuck_for = {k: self._stuck_for.get(k, 0) + 1 for k in control.list_stuck()}
        self._stuck_for |= dict.fromkeys(control.stranded, self._patience)  # nothing helps it
        return frozenset(k for k, times in self._stuck_for.items() if times >= self._patience)

    def is_changed(self, stuck: frozenset[int], *, at_once: bool) -> bool:
        """Return whether the rest is to be replanned for robots that have not gone on for a while.

        Parameters
        ----------
        stuck
            These robots.
        at_once
            Whether it is for each further one, though nobody waits for it.
        """
        robots = self._control.ledger.robots
        has_moved = any(robots[k].held != self._held[k] for k in stuck & self.passed)
        is_longer = stuck > self.passed and (at_once or not stuck.isdisjoint(self._list_awaited()))
        return has_moved or not stuck >= self.passed or is_longer

    def pass_round(self, stuck: frozenset[int]) -> None:
        """Note that the rest is planned round some robots, where they are.

        Parameters
        ----------
        stuck
            These robots.
        """
        self.passed = stuck
        self._held = [own.held for own in self._control.ledger.robots]

    def _list_awaited(self) -> set[int]:
        """Return the robots that must leave a place before others that are not stuck go on."""
        ledger, awaited = self._control.ledger, set[int]()
        for robot, own in enumerate(ledger.robots):
            part = own.released + 1
            if robot in self._stuck_for or part >= own.route.end:
                continue
            missing = ledger.graph.list_missing(Part(robot, part), ledger.arrived)
            awaited |= {arrival.robot for arrival in missing}
            awaited.update(list_strayed_to(ledger, own.route.get_place(part)))
        return awaited
