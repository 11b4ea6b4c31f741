"""Conflict-directed backjumping: resolve all conflicts of a window, or prove a deadlock.

One decision resolves one meeting of two robots, for a whole segment, in order of time. If neither
robot can wait, the decisions with rights of way on the closed cycles are the *culprits*. The latest
culprit that is not reversed yet is reversed, and all later decisions are dropped. A reversed
decision that fails, too, passes its culprits on: within a window, the search is complete and tries
no combination twice.

References
----------
Prosser, *Hybrid algorithms for the constraint satisfaction problem*, Computational Intelligence 9,
1993.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rightofway.cyclic.simulator import Deadlock
from rightofway.cyclic.window import NumberedRight, Window, WindowRule
from rightofway.model import Tick
from rightofway.precedence import Meeting
from rightofway.repair.conflict_resolution import Right, list_rights_if_waits


@dataclass(frozen=True, slots=True)
class LapDecision:
    """The rights of way given at one meeting, and the opposite rights of way."""

    rights: tuple[NumberedRight, ...]
    others: tuple[NumberedRight, ...]

    def keep_beyond(self, window: Window) -> LapDecision:
        """Return the part of a decision with visits after the cut of a window."""

        def inside(rights: Iterable[NumberedRight]) -> tuple[NumberedRight, ...]:
            return tuple(right for right in rights if right[0][1] >= window.starts[right[0][0]])

        open_rights = (right for right in self.rights if not window.is_past(*right[1]))
        reversible = not any(window.is_past(*second) for _, second in self.others)
        return LapDecision(inside(open_rights), inside(self.others if reversible else ()))


@dataclass(slots=True)
class _Frame:
    """One level of the search: a decision, the graph's mark before it, and its culprits."""

    decision: LapDecision
    mark: int
    is_reversed: bool
    culprits: set[int]


class RightOfWaySearch:
    """The decisions of a window in order; decisions from before the cut come first."""

    def __init__(self, window: Window, carried: Sequence[LapDecision]) -> None:
        self.window = window
        self._frames: list[_Frame] = []
        self._frame_of: dict[Right, int] = {}
        self._circle: list[int] = []
        for decision in carried:
            possible = self._push(decision, is_reversed=False, culprits=set())
            assert possible, "what was possible before the cut still is"

    @property
    def decisions(self) -> list[LapDecision]:
        """All decisions, for the next window."""
        return [frame.decision for frame in self._frames]

    def resolve(self, meeting: Meeting, rule: WindowRule) -> None:
        """Resolve a meeting, if necessary by reversing earlier decisions.

        Raises
        ------
        Deadlock
            If no combination of decisions resolves the meeting.
        TooShort
            If the window ends before the segment.
        """
        window, number = self.window, self.window.number
        segment = window.fleet.find_segment(meeting)
        if window.is_endless(meeting, segment):
            raise self._make_deadlock(meeting, meeting.robots)
        waits = rule(window, meeting, segment)
        rights, others = (
            tuple(
                (number(first), number(second))
                for first, second in list_rights_if_waits(window.graph, meeting, segment, robot)
            )
            for robot in (waits, 1 - waits)
        )
        culprits: set[int] = set()
        self._circle = []
        for is_reversed in (False, True):
            decision = LapDecision(others, rights) if is_reversed else LapDecision(rights, others)
            if self._push(decision, is_reversed=is_reversed, culprits=culprits):
                return
            culprits |= self._find_culprits()
        if not self._reverse_latest(culprits):
            raise self._make_deadlock(meeting, self._circle)

    def _make_deadlock(self, meeting: Meeting, circle: Sequence[int]) -> Deadlock:
        vertex = self.window.graph.get_vertex(meeting.visits[0])
        tick = Tick(self.window.begins + meeting.tick)
        return Deadlock(meeting.robots, vertex, tick, circle)

    def _push(self, decision: LapDecision, *, is_reversed: bool, culprits: set[int]) -> bool:
        """Take a decision; return false and change nothing if it is impossible."""
        graph, visit, mark = self.window.graph, self.window.get_node, self.window.graph.checkpoint()
        rights = [(visit(*first), visit(*second)) for first, second in decision.rights]
        if not graph.give_all(rights):
            return False
        for right in rights:
            self._frame_of.setdefault(right, len(self._frames))
        self._frames.append(_Frame(decision, mark, is_reversed, culprits))
        return True

    def _reverse_latest(self, culprits: set[int]) -> bool:
        """Reverse the latest reversible culprit; return false if there is none."""
        while culprits:
            latest = max(culprits)
            frame = self._frames[latest]
            self.window.graph.rollback(frame.mark)
            del self._frames[latest:]
            self._frame_of = {right: k for right, k in self._frame_of.items() if k < latest}
            culprits = (culprits - {latest}) | frame.culprits
            if frame.is_reversed or not frame.decision.others:
                continue
            decision = LapDecision(frame.decision.others, frame.decision.rights)
            if self._push(decision, is_reversed=True, culprits=culprits):
                return True
            culprits |= self._find_culprits()
        return False

    def _find_culprits(self) -> set[int]:
        """Return the decisions on the cycle of the last refused right of way."""
        graph = self.window.graph
        self._circle = graph.list_deadlocked() or self._circle
        rights = graph.list_deadlocking_rights()
        return {self._frame_of[right] for right in rights if right in self._frame_of}
