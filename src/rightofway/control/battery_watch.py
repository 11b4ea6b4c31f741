"""Robots whose batteries are too low: an alarm at once, and no further release."""

from __future__ import annotations

from math import ceil, floor

from rightofway.control.batteries import FleetBatteries
from rightofway.control.fleet_control import FleetControl
from rightofway.control.notices import Notices
from rightofway.facts import Fact
from rightofway.model import Scenario

__all__ = ["LOW", "BatteryWatch"]

LOW = "battery"
"""The kind of trouble of a robot that no longer reaches a charging place."""


class BatteryWatch:
    """The look-out for robots that no longer reach a charging place.

    Others are planned round such a robot: only a person can move or charge it.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    control
        Has the measured charges.
    notices
        Receives begin and end of each such trouble.
    """

    def __init__(self, scenario: Scenario, control: FleetControl, notices: Notices) -> None:
        self._batteries = FleetBatteries(scenario)
        self._control, self._notices = control, notices

    def look(self) -> None:
        """Report the robots that have begun to be too low, or are so no more; each second."""
        for robot, own in enumerate(self._control.ledger.robots):
            charge = self._control.charges.get(robot)
            if self._batteries.of_robot[robot] is None or charge is None:
                continue
            need = self._batteries.find_need(robot, own.held)
            if own.is_off or charge >= need:
                self._control.stranded.discard(robot)
                self._notices.end(robot, LOW)
                continue
            self._control.stranded.add(robot)
            begin = Fact("low on the floor", charge=floor(100 * charge), need=ceil(100 * need))
            self._notices.begin(robot, LOW, begin, Fact("no longer low"))
