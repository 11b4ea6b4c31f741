"""Rolling horizon for a rule that counts conflicts of whole laps, until a state recurs.

Each window ends when one robot of the group, the *pacemaker*, returns home. Meetings less than a
*lag* after the window are resolved, too, before the visits of the window are frozen, so that a
robot that has to wait before a segment has not entered the segment yet. If the lag is too short,
so that waiting cannot avoid a conflict, some windows are undone and repeated with a longer lag,
until the tick of the deadlock has passed.

The native simulator does the same for rules that consider two robots only.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Iterable, Sequence
from itertools import chain
from typing import Literal

import numpy as np

from rightofway.cyclic.backjumping import LapDecision, RightOfWaySearch
from rightofway.cyclic.route import GroupContext
from rightofway.cyclic.simulator import DEFAULT, Deadlock, HorizonParams, choose_pacemaker
from rightofway.cyclic.window import FrozenPrefix, TooShort, Window, WindowRule
from rightofway.facts import Fact
from rightofway.planners import Deadline
from rightofway.planners.two_level import plan_by_two_levels
from rightofway.precedence import Meeting, Segment
from rightofway.repair.conflict_resolution import GIVING

SIMULATING = Fact("waiting for a state again")


def two_level(window: Window, meeting: Meeting, segment: Segment) -> Literal[0, 1]:
    """Decide as in the paper: fewest conflicts left in the window, then least time of two robots.

    On a tie, the robot that would enter the segment later waits.
    """
    settlement = plan_by_two_levels(window.fleet, meeting)
    if settlement is not None and settlement.decisions:
        return 0 if settlement.decisions[0].waits == meeting.robots[0] else 1
    (i, j), graph = meeting.robots, window.graph
    i_enters = graph.enter(graph.get_visit(i, segment.i_first))
    return 0 if graph.enter(graph.get_visit(j, segment.j_first)) < i_enters else 1


_Checkpoint = tuple[int, tuple[int, ...], tuple[LapDecision, ...]]
"""The tick of a cut, the visits of each robot begun by the cut, and the open decisions."""


class RollingHorizon:
    """A simulation of a group by a rule on windows.

    The default pacemaker is a robot with the longest lap.
    """

    def __init__(
        self,
        context: GroupContext,
        rule: WindowRule = two_level,
        *,
        pacemaker: int | None = None,
        params: HorizonParams = DEFAULT,
    ) -> None:
        self.context = context
        self._params = params
        self._rule = rule
        self._longest = context.longest
        self._pacemaker = choose_pacemaker(context.laps, self._longest)
        if pacemaker is not None:
            self._pacemaker = pacemaker
        self._least_lag: int = context.laps[self._pacemaker].duration
        self._lag: int = self._least_lag
        self._prefix = FrozenPrefix(0, [[0] for _ in context.routes])
        self._decisions: tuple[LapDecision, ...] = ()
        self._trouble = 0  # a deadlock lies before this tick
        self._taken_back = 1
        self._seen: dict[Hashable, int] = {}
        self._checkpoints: deque[_Checkpoint] = deque(maxlen=self._params.memory)
        self._deadline = Deadline()

    @property
    def history(self) -> list[list[int]]:
        """For each robot, the enters of its visits so far [ticks]."""
        return self._prefix.history

    def advance(self, deadline: Deadline) -> tuple[int, int]:
        """Continue until the states at two cuts are equal; return both ticks.

        Raises
        ------
        Deadlock
            If a deadlock remains at the longest lag.
        GaveUp
            If time runs out; another call continues.
        """
        self._deadline = deadline
        while True:
            deadline.check(SIMULATING)
            in_trouble = self._prefix.tick < self._trouble
            if not in_trouble:
                self._lag, self._taken_back = self._least_lag, 1
            window = self._make_window(self._list_first_ahead(), self._decisions)
            beyond = (decision.keep_beyond(window) for decision in self._decisions)
            self._decisions = tuple(decision for decision in beyond if decision.rights)
            lengths = tuple(len(past) for past in self.history)
            self._checkpoints.append((self._prefix.tick, lengths, self._decisions))
            if not in_trouble:
                earlier = self._seen.setdefault(self._state(window), self._prefix.tick)
                if earlier < self._prefix.tick:
                    return earlier, self._prefix.tick
            try:
                self._resolve_to_next_cut(window)
            except Deadlock:
                if not self._take_back():
                    raise

    def reset_states(self) -> None:
        """Forget the states seen, so that `advance` continues after a recurrence."""
        self._seen.clear()

    def _list_first_ahead(self) -> list[int]:
        return [self._params.window_lags * self._lag] * len(self.context)

    def _make_window(self, ahead: Sequence[int], decisions: Iterable[LapDecision]) -> Window:
        """Return a window with the next cut and all visits of the decisions."""
        stop = [0] * len(ahead)
        stop[self._pacemaker] = self._find_next_home(self._pacemaker) + 1
        for decision in decisions:
            for robot, visit in chain.from_iterable(decision.rights + decision.others):
                stop[robot] = max(stop[robot], visit + 1)
        return Window(self.context, self._deadline, self._prefix, ahead, stop)

    def _take_back(self) -> bool:
        """Return to an earlier cut with twice the lag; return false at the longest lag."""
        if self._lag >= self._params.most_lag * self._longest:
            return False
        self._trouble = max(self._trouble, self._prefix.tick + 1)
        for _ in range(min(self._taken_back, len(self._checkpoints))):
            cut, lengths, self._decisions = self._checkpoints.pop()
        for past, length in zip(self.history, lengths, strict=True):
            del past[length:]
        self._prefix = FrozenPrefix(cut, self.history)
        self._lag *= 2
        self._taken_back *= 2
        self._seen = {s: tick for s, tick in self._seen.items() if tick <= cut}
        return True

    def _resolve_to_next_cut(self, window: Window) -> None:
        """Resolve all meetings up to a lag after the next cut, extending the window as needed."""
        ahead, decisions = self._list_first_ahead(), list(self._decisions)
        while True:
            search = RightOfWaySearch(window, decisions)
            try:
                self._resolve_all(window, search)
                break
            except TooShort as short:
                for robot in short.robots:
                    ahead[robot] *= 2
                decisions = search.decisions
                window = self._make_window(ahead, decisions)
        self._fix_window(window, search)

    def _resolve_all(self, window: Window, search: RightOfWaySearch) -> None:
        graph, end = window.graph, window.compute_ends().min()
        while True:
            self._deadline.check(GIVING)
            meeting = graph.find_next_meeting()
            if graph.enter(self._find_home_in(window)) > self._params.patience * self._longest:
                self._replace_pacemaker(window)
            limit = window.begins + graph.enter(self._find_home_in(window)) + self._lag
            tick = limit if meeting is None else min(limit, window.begins + meeting.tick)
            if tick >= end:
                ends = window.compute_ends()
                end = ends.min()
                if tick >= end:
                    raise TooShort(np.flatnonzero(ends <= tick).tolist())
            if meeting is None or tick >= limit:
                return
            search.resolve(meeting, self._rule)

    def _replace_pacemaker(self, window: Window) -> None:
        """Replace a pacemaker that seems to wait for ever by the robot that is home first."""
        enter = {
            robot: window.graph.enter(window.get_node(robot, self._find_next_home(robot)))
            for robot in range(len(self.context))
            if self._find_next_home(robot) - window.starts[robot] < len(window.routes[robot]) - 1
        }
        self._pacemaker = min(enter, key=lambda robot: (enter[robot], robot))
        self._seen.clear()

    def _find_home_in(self, window: Window) -> int:
        """Return the node of the pacemaker's next visit home."""
        return window.get_node(self._pacemaker, self._find_next_home(self._pacemaker))

    def _find_next_home(self, robot: int) -> int:
        length = len(self.context.routes[robot])
        return -(-len(self.history[robot]) // length) * length

    def _state(self, window: Window) -> Hashable:
        """Return the state that determines later decisions, relative to the window's start."""
        starts = window.starts
        decisions = tuple(
            tuple(
                tuple((i, a - starts[i], j, b - starts[j]) for (i, a), (j, b) in rights)
                for rights in (decision.rights, decision.others)
            )
            for decision in self._decisions
        )
        return window.describe_state(), decisions

    def _fix_window(self, window: Window, search: RightOfWaySearch) -> None:
        tick = window.begins + window.graph.enter(self._find_home_in(window))
        for past, start, track in zip(
            self.history, window.starts, window.graph.build_tracks(), strict=True
        ):
            enter = track.enter[:-1] + window.begins
            end = int(np.searchsorted(enter, tick, "right"))
            past.extend(enter[len(past) - start : end].tolist())
        self._prefix = FrozenPrefix(tick, self.history)
        self._decisions = tuple(search.decisions)
