"""Settle what meets in a window, the earliest first, and go back where that ends in a circle.

Each meeting is one decision between two robots, for a whole segment. Where neither can wait, the
rights of way that close the circles are the culprits; the latest decision among them that has not
been turned yet is turned, and what was decided after it is forgotten. A turned decision that fails
as well passes its culprits on (conflict-directed backjumping), so in a window nothing is overlooked
and nothing is tried twice.

References
----------
Prosser, *Hybrid algorithms for the constraint satisfaction problem*, Computational Intelligence 9,
1993.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rightofway.cyclic.rules import EndlessRule
from rightofway.cyclic.window import Numbered, Window
from rightofway.model import Tick, VertexId
from rightofway.planners.conflict_resolution import Right, rights_if_waits
from rightofway.precedence import Meeting

__all__ = ["Deadlock", "Decisions", "Order", "Step"]


@dataclass(frozen=True, slots=True)
class Order:
    """A decision: these rights of way, where those others were possible."""

    rights: tuple[Numbered, ...]
    others: tuple[Numbered, ...]

    def beyond(self, window: Window) -> Order:
        """Return what of it reaches beyond the cut that a window begins with."""
        rights = (right for right in self.rights if not window.is_past(*right[1]))
        turnable = not any(window.is_past(*second) for _, second in self.others)
        return Order(window.inside(rights), window.inside(self.others if turnable else ()))


class Deadlock(Exception):
    """No right of way keeps two robots apart.

    Attributes
    ----------
    robots
        The two, by place in the group.
    vertex, tick
        Where and when it shows.
    circle
        Robots that would wait for each other, each for the next. Empty if there is no circle: then
        one of the two stays, or has come already, where the other has to be.
    """

    def __init__(
        self, robots: tuple[int, int], vertex: VertexId, tick: Tick, circle: Sequence[int]
    ) -> None:
        self.robots = robots
        self.vertex = vertex
        self.tick = tick
        self.circle = tuple(circle)
        super().__init__()


@dataclass(slots=True)
class Step:
    """A decision in the window, and what is known against it."""

    order: Order
    mark: int
    turned: bool = False
    culprits: set[int] = field(default_factory=set)


class Decisions:
    """All decisions that hold in a window, in the order they were taken.

    Parameters
    ----------
    window
        Where they hold.
    carried
        Decisions from before its cut that reach beyond it.
    """

    def __init__(self, window: Window, carried: Sequence[Order]) -> None:
        self.window = window
        self.steps: list[Step] = []
        self._step_of: dict[Right, int] = {}
        self._circle: list[int] = []
        for order in carried:
            possible = self._take(order)
            assert possible, "what was possible before the cut still is"

    def settle(self, meeting: Meeting, rule: EndlessRule) -> None:
        """Keep two robots apart, if need be by other decisions than so far.

        Raises
        ------
        Deadlock
            If nothing does.
        TooShort
            If the window does not show whether the segment ends.
        """
        window = self.window
        segment = window.segment_of(meeting)
        if window.is_endless(meeting, segment):
            raise self._deadlock(meeting, meeting.robots)
        waits = rule(window, meeting, segment)
        ways = [
            self._numbered(rights_if_waits(window.graph, meeting, segment, who))
            for who in (waits, 1 - waits)
        ]
        culprits: set[int] = set()
        self._circle = []
        for rights, others in (ways, ways[::-1]):
            if self._take(Order(rights, others), turned=rights is ways[1], culprits=culprits):
                return
            culprits |= self._culprits()
        if not self._go_back(culprits):
            raise self._deadlock(meeting, self._circle)

    def orders(self) -> list[Order]:
        """Return all decisions, to be carried on to the next window."""
        return [step.order for step in self.steps]

    def _deadlock(self, meeting: Meeting, circle: Sequence[int]) -> Deadlock:
        vertex = self.window.graph.vertex(meeting.visits[0])
        tick = Tick(self.window.begins + meeting.tick)
        return Deadlock(meeting.robots, vertex, tick, circle)

    def _take(
        self, order: Order, *, turned: bool = False, culprits: set[int] | None = None
    ) -> bool:
        graph, mark = self.window.graph, self.window.graph.checkpoint()
        rights = self._in_graph(order.rights)
        if not graph.give_all(rights):
            return False
        for right in rights:
            self._step_of.setdefault(right, len(self.steps))
        self.steps.append(Step(order, mark, turned, culprits or set()))
        return True

    def _go_back(self, culprits: set[int]) -> bool:
        """Turn the latest decision that helps; false if none does."""
        while culprits:
            latest = max(culprits)
            step = self._forget_from(latest)
            culprits = (culprits - {latest}) | step.culprits
            if step.turned or not step.order.others:
                continue
            turned = Order(step.order.others, step.order.rights)
            if self._take(turned, turned=True, culprits=culprits):
                return True
            culprits |= self._culprits()
        return False

    def _forget_from(self, index: int) -> Step:
        step = self.steps[index]
        self.window.graph.rollback(step.mark)
        del self.steps[index:]
        self._step_of = {right: one for right, one in self._step_of.items() if one < index}
        return step

    def _culprits(self) -> set[int]:
        """Return the decisions that made the last right of way impossible."""
        graph = self.window.graph
        self._circle = graph.deadlocked() or self._circle
        rights = graph.deadlocking_rights()
        return {self._step_of[right] for right in rights if right in self._step_of}

    def _numbered(self, rights: Sequence[Right]) -> tuple[Numbered, ...]:
        number = self.window.number
        return tuple((number(first), number(second)) for first, second in rights)

    def _in_graph(self, rights: Sequence[Numbered]) -> list[Right]:
        visit = self.window.visit
        return [(visit(*first), visit(*second)) for first, second in rights]
