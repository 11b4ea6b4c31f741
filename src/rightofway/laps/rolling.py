"""A rule on endless routes: one window after the other, until a state comes again.

Each window ends where one robot of the group, the *pacemaker*, is home again. What meets less than
a lap after that is settled too before everything up to there is frozen, so that whoever still has
to wait before a segment has not entered it yet.
"""

from __future__ import annotations

from collections.abc import Hashable
from itertools import count

import numpy as np

from rightofway.laps.giving import Decisions, Order
from rightofway.laps.rules import EndlessRule
from rightofway.laps.window import Cut, Ground, TooShort, Window

__all__ = ["Rolling"]

PATIENCE = 8
"""How many times its usual length a window grows before somebody else becomes pacemaker."""


class Rolling:
    """A group of robots that go on and on.

    Parameters
    ----------
    ground
        The group.
    rule
        Who waits.

    Attributes
    ----------
    cut
        How far it is.
    cuts
        The ticks of all cuts.
    """

    def __init__(self, ground: Ground, rule: EndlessRule) -> None:
        self.ground = ground
        self.rule = rule
        self.cut = Cut(0, [[0] for _ in ground.group])
        self.cuts: list[int] = []
        self._orders: list[Order] = []
        durations = [endless.lap.duration for endless in ground.group]
        self._lag = max(durations)
        self._pacemaker = durations.index(self._lag)
        self._usual = 3 * self._lag
        self._seen: dict[Hashable, int] = {}

    def until_it_repeats(self) -> tuple[int, int]:
        """Go on until the state at a cut is the same as at an earlier one; return both ticks.

        Raises
        ------
        Deadlock
            If the rule runs into one.
        GaveUp
            If time runs out.
        """
        window = Window(self.ground, self.cut, self._usual)
        while True:
            self.ground.task.deadline.check("waiting for a state to come again")
            self._orders = [order.beyond(window) for order in self._orders]
            self._orders = [order for order in self._orders if order.rights]
            earlier = self._seen.setdefault(self._state(window), len(self.cuts))
            self.cuts.append(self.cut.tick)
            if earlier < len(self.cuts) - 1:
                return self.cuts[earlier], self.cut.tick
            self._go_on(window)
            window = Window(self.ground, self.cut, self._usual)

    def _go_on(self, window: Window) -> None:
        """Settle what has to be before the next cut, in a window as long as it takes."""
        for longer in count(1):
            decisions = Decisions(window, self._orders)
            try:
                self._settle(window, decisions)
                break
            except TooShort:
                if 2**longer > PATIENCE:
                    self._change_pacemaker(window)
                window = Window(self.ground, self.cut, self._usual * 2**longer)
        self._freeze(window, decisions)

    def _settle(self, window: Window, decisions: Decisions) -> None:
        graph, next_home = window.graph, self._next_home(window)
        end = window.first_end()
        while True:
            self.ground.task.deadline.check("giving right of way")
            meeting = graph.next_meeting()
            limit = window.begins + graph.enter(next_home) + self._lag
            tick = limit if meeting is None else min(limit, window.begins + meeting.tick)
            if tick >= end and tick >= (end := window.first_end()):
                raise TooShort
            if meeting is None or tick >= limit:
                return
            decisions.settle(meeting, self.rule)

    def _change_pacemaker(self, window: Window) -> None:
        """Let the robot set the pace that is home again first; this one seems to wait for ever."""
        homes = []
        for robot in range(len(self.ground.group)):
            self._pacemaker = robot
            homes.append(window.graph.enter(self._next_home(window)))
        self._pacemaker = homes.index(min(homes))
        self._seen.clear()

    def _state(self, window: Window) -> Hashable:
        return window.state(), self._relative(window)

    def _next_home(self, window: Window) -> int:
        robot = self._pacemaker
        length = len(self.ground.group[robot].lap)
        laps = -(-len(self.cut.history[robot]) // length)
        return window.visit(robot, laps * length)

    def _relative(self, window: Window) -> Hashable:
        """Return the rights of way that reach beyond the cut, as seen from it."""
        starts = window.starts
        return tuple(
            tuple(
                tuple((i, a - starts[i], j, b - starts[j]) for (i, a), (j, b) in rights)
                for rights in (order.rights, order.others)
            )
            for order in self._orders
        )

    def _freeze(self, window: Window, decisions: Decisions) -> None:
        tick = window.begins + window.graph.enter(self._next_home(window))
        for past, start, enter in zip(
            self.cut.history, window.starts, window.enters(), strict=True
        ):
            end = int(np.searchsorted(enter, tick, "right"))
            past.extend(enter[len(past) - start : end].tolist())
        self.cut = Cut(tick, self.cut.history)
        self._orders = decisions.orders()
