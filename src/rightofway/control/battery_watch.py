"""Robots whose batteries are too low: an alarm at once, and no further release."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, floor

from rightofway.control.batteries import FleetBatteries
from rightofway.control.fleet_control import FleetControl
from rightofway.control.journal import Entry
from rightofway.control.notices import Notices
from rightofway.facts import Fact
from rightofway.model import Scenario

__all__ = ["LOW", "BatteryWatch"]

STEP = 5
"""By how many percents a charge changes until the journal has it, for people."""

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
        self._noted: dict[int, int] = {}  # the charge of each robot that the journal has last [%]

    def look(self) -> None:
        """Report the robots that have begun to be too low, or are so no more; each second."""
        self._control.commit(*self._list_changed())
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

    def _list_changed(self) -> Iterator[Entry]:
        """Yield entries for people on charges that have changed by some percents."""
        for robot, charge in self._control.charges.items():
            percent, before = round(100 * charge), self._noted.get(robot)
            is_end = percent in {0, 100} and percent != before
            if self._batteries.of_robot[robot] is not None and (
                before is None or is_end or abs(percent - before) >= STEP
            ):
                self._noted[robot] = percent
                yield {"kind": "charge", "robot": robot, "percent": percent}
