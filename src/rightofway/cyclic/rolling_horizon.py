"""A rule on endless routes: one window after the other, until a state comes again.

Each window ends where one robot of the group, the *pacemaker*, is home again. What meets less than
a *lag* after that is settled too before everything up to there is frozen, so that whoever still has
to wait before a segment has not entered it yet. Where that was too little, and waiting does not
keep two robots apart any more, some windows are taken back and tried with a longer lag, until that
place is behind.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from rightofway.cyclic.backjumping import Deadlock, Decisions, Order
from rightofway.cyclic.route import CyclicRoute
from rightofway.cyclic.rules import FAR_SIGHTED, RULES
from rightofway.cyclic.window import Cut, Ground, TooShort, Window
from rightofway.planners import Deadline

__all__ = ["MEMORY", "MOST_LAG", "PATIENCE", "Pace", "Rolling"]

PATIENCE = 8
"""How many of the longest laps a pacemaker may stay away before somebody else becomes it."""

PARTS = 4
"""A pacemaker that is home this many times in the longest lap keeps windows short."""

MOST_LAG = 4
"""How many of the longest laps the lag may grow to."""

MEMORY = 32
"""How many windows can be taken back."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pace:
    """How a group goes on.

    Attributes
    ----------
    pacemaker
        The robot that is home again at each cut, at first.
    ticks
        How long its lap takes alone; as long is the lag [ticks].
    longest
        How long the longest lap of the group takes alone [ticks].
    """

    pacemaker: int
    ticks: int
    longest: int

    @classmethod
    def of(cls, group: Sequence[CyclicRoute], rule: str) -> Pace:
        """Return the pace of a group under a rule."""
        durations = [endless.lap.duration for endless in group]
        longest = max(durations)
        least = longest if rule in FAR_SIGHTED else -(-longest // PARTS)
        ticks = min(duration for duration in durations if duration >= least)
        return cls(pacemaker=durations.index(ticks), ticks=ticks, longest=longest)


@dataclass(frozen=True, slots=True)
class _Moment:
    """All that is needed to go back to a cut."""

    tick: int
    lengths: tuple[int, ...]
    orders: tuple[Order, ...]


class Rolling:
    """A group of robots that go on and on.

    Parameters
    ----------
    ground
        The group.
    rule
        The name of the rule that says who waits.

    Attributes
    ----------
    cut
        How far it is.
    """

    def __init__(self, ground: Ground, rule: str) -> None:
        self.ground = ground
        self.cut = Cut(0, [[0] for _ in ground.group])
        self._rule = RULES[rule]
        self._orders: tuple[Order, ...] = ()
        pace = Pace.of(ground.group, rule)
        self._longest = pace.longest
        self._pacemaker = pace.pacemaker
        self._pace = pace.ticks
        self._lag: int = pace.ticks
        self._trouble = 0
        self._seen: dict[Hashable, int] = {}
        self._past: deque[_Moment] = deque(maxlen=MEMORY)
        self._back = 1

    @property
    def history(self) -> list[list[int]]:
        """For each robot when its visits so far began."""
        return self.cut.history

    def until_it_repeats(self, deadline: Deadline) -> tuple[int, int]:
        """Go on until the state at a cut is the same as at an earlier one; return both ticks.

        Raises
        ------
        Deadlock
            If the rule runs into one.
        GaveUp
            If time runs out; it can be asked again.
        """
        self.ground = replace(self.ground, task=replace(self.ground.task, deadline=deadline))
        while True:
            self.ground.task.deadline.check("waiting for a state to come again")
            in_trouble = self.cut.tick < self._trouble
            if not in_trouble:
                self._lag, self._back = self._pace, 1
            window = self._window([3 * self._lag] * len(self.ground.group), self._orders)
            self._remember(window)
            if not in_trouble:
                earlier = self._seen.setdefault(self._state(window), self.cut.tick)
                if earlier < self.cut.tick:
                    return earlier, self.cut.tick
            try:
                self._go_on(window)
            except Deadlock:
                if not self._go_back():
                    raise

    def _window(self, ahead: list[int], orders: Iterable[Order]) -> Window:
        shown = [0] * len(ahead)
        shown[self._pacemaker] = self._next_home_of(self._pacemaker) + 1
        for order in orders:
            for robot, visit in chain.from_iterable(order.rights + order.others):
                shown[robot] = max(shown[robot], visit + 1)
        return Window(self.ground, self.cut, ahead, shown)

    def _remember(self, window: Window) -> None:
        beyond = (order.beyond(window) for order in self._orders)
        self._orders = tuple(order for order in beyond if order.rights)
        lengths = tuple(len(past) for past in self.cut.history)
        self._past.append(_Moment(self.cut.tick, lengths, self._orders))

    def _go_back(self) -> bool:
        """Take some windows back and look further ahead from now on; false if it is no use."""
        if self._lag >= MOST_LAG * self._longest:
            return False
        self._trouble = max(self._trouble, self.cut.tick + 1)
        for _ in range(min(self._back, len(self._past))):
            moment = self._past.pop()
        for past, length in zip(self.cut.history, moment.lengths, strict=True):
            del past[length:]
        self.cut = Cut(moment.tick, self.cut.history)
        self._orders = moment.orders
        self._lag *= 2
        self._back *= 2
        self._seen = {state: tick for state, tick in self._seen.items() if tick <= self.cut.tick}
        return True

    def _go_on(self, window: Window) -> None:
        """Settle what has to be before the next cut, in a window as long as it takes."""
        ahead = [3 * self._lag] * len(self.ground.group)
        orders: Sequence[Order] = self._orders
        while True:
            decisions = Decisions(window, orders)
            try:
                self._settle(window, decisions)
                break
            except TooShort as short:
                for robot in short.robots:
                    ahead[robot] *= 2
                orders = decisions.orders()
                window = self._window(ahead, orders)
        self._freeze(window, decisions)

    def _settle(self, window: Window, decisions: Decisions) -> None:
        graph, next_home, end = window.graph, self._next_home(window), window.ends().min()
        while True:
            self.ground.task.deadline.check("giving right of way")
            meeting = graph.next_meeting()
            if graph.enter(next_home) > PATIENCE * self._longest:
                next_home = self._change_pacemaker(window)
            limit = window.begins + graph.enter(next_home) + self._lag
            tick = limit if meeting is None else min(limit, window.begins + meeting.tick)
            if tick >= end:
                ends = window.ends()
                end = ends.min()
                if tick >= end:
                    raise TooShort(np.flatnonzero(ends <= tick).tolist())
            if meeting is None or tick >= limit:
                return
            decisions.settle(meeting, self._rule)

    def forget(self) -> None:
        """Forget the states seen, so that it goes on where one came again."""
        self._seen.clear()

    def _change_pacemaker(self, window: Window) -> int:
        """Let the robot set the pace that is home again first; this one seems to wait for ever."""
        robots = range(len(self.ground.group))
        visits = {robot: self._next_home_of(robot) for robot in robots}
        enter = {
            robot: window.graph.enter(window.visit(robot, visit))
            for robot, visit in visits.items()
            if window.shows(robot, visit)
        }
        self._pacemaker = min(enter, key=lambda robot: (enter[robot], robot))
        self._seen.clear()
        return self._next_home(window)

    def _next_home(self, window: Window) -> int:
        return window.visit(self._pacemaker, self._next_home_of(self._pacemaker))

    def _next_home_of(self, robot: int) -> int:
        length = len(self.ground.group[robot].lap)
        return -(-len(self.cut.history[robot]) // length) * length

    def _state(self, window: Window) -> Hashable:
        starts = window.starts
        orders = tuple(
            tuple(
                tuple((i, a - starts[i], j, b - starts[j]) for (i, a), (j, b) in rights)
                for rights in (order.rights, order.others)
            )
            for order in self._orders
        )
        return window.state(), orders

    def _freeze(self, window: Window, decisions: Decisions) -> None:
        tick = window.begins + window.graph.enter(self._next_home(window))
        for past, start, enter in zip(
            self.cut.history, window.starts, window.enters(), strict=True
        ):
            end = int(np.searchsorted(enter, tick, "right"))
            past.extend(enter[len(past) - start : end].tolist())
        self.cut = Cut(tick, self.cut.history)
        self._orders = tuple(decisions.orders())
