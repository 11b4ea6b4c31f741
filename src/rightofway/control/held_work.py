"""Work that waits at its place: for its time, for other jobs, or until a battery is charged.

A robot drives to the place by right of way and stands there. If it waited before the place instead,
it could be in the way of robots that are planned to pass while it works: the fleet would deadlock.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from rightofway.control.fleet_control import FleetControl
from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.model import Scenario

__all__ = ["HeldWork", "list_ready"]

NOISE = 0.005
"""By how much a measured state of charge may miss the planned one: robots report whole percents."""


class HeldWork:
    """Decides which work may begin.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    control
        The control of its robots, with the pool of jobs in its ledger.
    read_ticks
        Returns the time since the run began [ticks].
    """

    def __init__(
        self, scenario: Scenario, control: FleetControl, read_ticks: Callable[[], int]
    ) -> None:
        self._scenario, self._control = scenario, control
        self._clock, self._read_ticks = scenario.problem.clock, read_ticks
        self._ready = list_ready(scenario)
        # For each robot: item and measured charge, and when both were seen first together.
        self._seen: dict[int, tuple[tuple[str, float | None], int]] = {}

    def may_set_out(self, robot: int) -> bool:
        """Return whether a robot does anything yet: it is ready.

        Parameters
        ----------
        robot
            Its number.
        """
        return self._ready[robot] <= self._read_ticks()

    def may_begin(self, robot: int, item: str) -> bool:
        """Return whether an item of work may begin now.

        Parameters
        ----------
        robot
            A robot whose route has the item.
        item
            See `rightofway.control.work_items`.
        """
        begin = self.find_begin(robot, item)
        return begin is not None and begin <= self._read_ticks() and self.may_set_out(robot)

    def find_begin(self, robot: int, item: str) -> int | None:
        """Return when an item may begin, as far as that is known [ticks]; None if it is not.

        Parameters
        ----------
        robot, item
            As for `may_begin`.
        """
        stop = find_stop(item)
        if stop is None:
            return self._find_end_of_charge(robot, item) if find_charge_step(item) == "end" else 0
        pool, (name, number) = self._control.ledger.pool, stop
        own = pool.jobs.get(name)
        if own is None or name in self._control.ledger.outdated:
            return None
        if number > own.done:  # also where both are at one place, and the first one fails
            return None
        if number == 0 and not own.is_begun and not all(map(pool.is_over, own.job.after)):
            return None
        return self._clock.count_ticks(own.job.stops[number].earliest)

    def _find_end_of_charge(self, robot: int, item: str) -> int | None:
        """Return when a charge is expected to reach its target [ticks].

        A robot that reports no charge stays as long as planned. Of one whose charge does not rise
        any more, as long as it should take to the target, no more is expected.
        """
        now, own = self._read_ticks(), self._control.ledger.robots[robot]
        if own.find_next_item() != item:  # it does not charge yet
            return None
        target = dict(own.route.targets).get(item, 0.0)
        measured = self._control.charges.get(robot)
        if self._seen.get(robot, ((), 0))[0] != (item, measured):
            self._seen[robot] = (item, measured), now
        since = self._seen[robot][1]
        if measured is None:
            index = own.route.get_jobs(own.arrived).index(item)
            return since + own.route.get_work(own.arrived)[index]
        name = self._scenario.robots[robot].battery
        rate = dict(self._scenario.batteries)[name].charge if name else 0
        if measured >= target - NOISE or not rate:
            return since
        return since + self._clock.count_ticks(Fraction(target - measured) / rate)

    def find_next_change(self) -> int | None:
        """Return when robots are ready, or work for which they stand may begin [ticks], or None."""
        now, changes = self._read_ticks(), list(self._ready)
        for robot, own in enumerate(self._control.ledger.robots):
            item = own.find_next_item()
            if item is None or own.is_off or own.is_asked_for(item):
                continue
            begin = self.find_begin(robot, item)
            if begin is not None:
                changes.append(begin)
        return min((change for change in changes if change > now), default=None)


def list_ready(scenario: Scenario) -> list[int]:
    """Return when each robot is ready [ticks]."""
    count = scenario.problem.clock.count_ticks
    return [count(robot.start.ready) if robot.start else 0 for robot in scenario.robots]
