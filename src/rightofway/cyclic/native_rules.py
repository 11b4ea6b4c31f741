"""The rules that see two robots only, on endless routes, by the native kernel.

It decides what `Rolling` decides with the same rule, so the two are held against each other; but
instead of a window for each cut it keeps one graph, and it can be stopped in between.
"""

from __future__ import annotations

from rightofway.cyclic.backjumping import Deadlock
from rightofway.cyclic.rolling_horizon import MEMORY, MOST_LAG, PATIENCE, Pace
from rightofway.cyclic.rules import losses
from rightofway.cyclic.simulator import CyclicSimulator, Horizon
from rightofway.cyclic.visit_times import VisitTimes
from rightofway.cyclic.window import Ground
from rightofway.errors import GaveUp
from rightofway.planners import Deadline

__all__ = ["Native"]


class Native:
    """A group of robots that go on and on.

    Parameters
    ----------
    ground
        The group.
    rule
        ``first-come``, ``fixed-order`` or ``least-loss``.
    """

    def __init__(self, ground: Ground, rule: str) -> None:
        self.ground = ground
        pace = Pace.of(ground.group, rule)
        self._run = CyclicSimulator(
            [endless.lap for endless in ground.group],
            [endless.first_least for endless in ground.group],
            Horizon(
                pacemaker=pace.pacemaker,
                lag=pace.ticks,
                most_lag=MOST_LAG * pace.longest,
                patience=PATIENCE * pace.longest,
                reach=ground.reach,
                memory=MEMORY,
            ),
            headway=ground.headway,
            books_ahead=ground.books_ahead,
            rule=rule,
            losses=losses(ground.group),
        )

    @property
    def history(self) -> list[VisitTimes]:
        """For each robot when its visits so far began."""
        begun = self._run.started()
        return [
            VisitTimes(endless, begun[robot], *self._run.waits(robot))
            for robot, endless in enumerate(self.ground.group)
        ]

    def until_it_repeats(self, deadline: Deadline) -> tuple[int, int]:
        """Go on until the state at a cut is the same as at an earlier one; return both ticks.

        Raises
        ------
        Deadlock
            If the rule runs into one.
        GaveUp
            If time runs out; it can be asked again.
        """
        ends = self._run.advance(deadline.seconds_left())
        if ends == "open":
            raise GaveUp("time ran out before a state came again (give a longer time limit)")
        if ends == "deadlock":
            raise Deadlock(*self._run.deadlock())
        return self._run.recurrence()

    def follow(self, rule: str) -> None:
        """Decide by another rule from now on; states that were seen are forgotten."""
        self._run.set_rule(rule)

    def forget(self) -> None:
        """Forget the states seen, so that it goes on where one came again."""
        self._run.reset_states()
