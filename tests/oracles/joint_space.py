"""The least flowtime of a few robots: a search over where all of them are.

One way trips without work and headway. In each tick a robot stands, drives or is done for ever;
what it books in that tick must not exclude what any other robot books, and must not be closed.
Points may book one vertex only; two points do not exchange vertices, and fleets of three points
that book one vertex are not searched: they could rotate.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache, partial
from heapq import heappop, heappush
from itertools import product
from typing import NamedTuple

from rightofway.model import Scenario
from tests.oracles.closures import begins, ends, is_shut
from tests.oracles.space import Shape, drive, incompatible, zones_around, zones_with


class State(NamedTuple):
    """A robot at the start of a tick: where it stands or drives from, and what is left."""

    vertex: int
    head: int = -1
    left: int = 0  # ticks of the drive to the head
    is_done: bool = False


Booked = tuple[Shape, ...]
Action = tuple[State, Booked, int]
"""The next state, what is booked in the tick, and what the tick costs."""


class _Fleet:
    """What each robot can do in a tick, and whether two robots can do it together."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.books_ahead = scenario.rules.occupancy == "both"
        assert self.books_ahead or len(scenario.robots) < 3, "three points may rotate"
        self.excludes = cache(partial(incompatible, scenario))
        self.clash = cache(self._clash)
        self.is_closed = cache(self._is_closed)
        self.actions = cache(lambda robot, state: list(self._actions(robot, state)))

    def _is_closed(self, robot: int, booked: Booked, tick: int) -> bool:
        """Return whether something that a robot books in a tick is closed."""
        places = [shape for shape in booked if shape[0] >= 0]  # the others are zones
        now = Fraction(tick)
        return any(is_shut(self.scenario, robot, shape, now, now + 1) for shape in places)

    def _clash(self, i: int, one: Booked, j: int, other: Booked) -> bool:
        """Return whether robots i and j book shapes that exclude each other."""
        if not self.books_ahead:  # points: only vertices exclude each other
            one = tuple(shape for shape in one if len(shape) == 1)
            other = tuple(shape for shape in other if len(shape) == 1)
        return any(self.excludes(i, x, j, y) for x, y in product(one, other))

    def together(self, states: tuple[State, ...], tick: int) -> list[tuple[Action, ...]]:
        """Return what all robots can do in a tick without booking what excludes each other."""
        found: list[tuple[Action, ...]] = [()]
        for j, state in enumerate(states):
            found = [
                (*before, action)
                for action in self.actions(j, state)
                if not self.is_closed(j, action[1], tick)
                for before in found
                if not any(
                    self.clash(i, one[1], j, action[1])
                    or _exchanges(states[i], one[0], state, action[0])
                    for i, one in enumerate(before)
                )
            ]
        return found

    def _actions(self, robot: int, state: State) -> Iterator[Action]:
        """Yield the next state, what is booked in the tick, and what the tick costs."""
        roadmap = self.scenario.roadmap
        inside = zones_around(roadmap, state.vertex)
        here: Booked = ((state.vertex,), *((-1 - zone,) for zone in inside))
        if state.is_done:
            yield state, here, 0
        elif state.left:
            left, edge = state.left - 1, (state.vertex, state.head)
            along, ahead = zones_with(roadmap, edge), zones_around(roadmap, state.head)
            booked: Booked = (*here, edge, *((-1 - zone,) for zone in along | ahead))
            booked += ((state.head,),) if self.books_ahead else ()
            yield state._replace(left=left) if left else State(state.head), booked, 1
        else:
            if state.vertex == self.scenario.problem.itineraries[robot].last:
                yield state._replace(is_done=True), here, 0
            yield state, here, 1
            first, end = roadmap.indptr[state.vertex : state.vertex + 2].tolist()
            for head in roadmap.heads[first:end].tolist():
                ticks = int(drive(self.scenario, robot, state.vertex, head))
                yield from self._actions(robot, state._replace(head=head, left=ticks))


def least_flowtime(scenario: Scenario) -> int | None:
    """Return the least sum of completions [ticks], None where there is no plan."""
    fleet = _Fleet(scenario)
    moments = [begins(scenario, closure) for closure in scenario.closures]
    moments += [ends(scenario, closure) or 0 for closure in scenario.closures]
    horizon = max(moments, default=0)  # nothing is opened or closed later
    start = (0, tuple(State(itinerary.home) for itinerary in scenario.problem.itineraries))
    best = {start: 0}
    heap = [(0, *start)]
    while heap:
        cost, tick, states = heappop(heap)
        if tick == horizon and all(
            state.is_done and not fleet.is_closed(robot, ((state.vertex,),), tick)
            for robot, state in enumerate(states)
        ):
            return cost
        if best[tick, states] < cost:
            continue
        for chosen in fleet.together(states, tick):
            after = (min(tick + 1, horizon), tuple(each[0] for each in chosen))
            total = cost + sum(each[2] for each in chosen)
            if total < best.get(after, total + 1):
                best[after] = total
                heappush(heap, (total, *after))
    return None


def _exchanges(one: State, one_after: State, other: State, other_after: State) -> bool:
    """Tell whether two robots exchange their vertices at the end of a tick."""
    moves = one.vertex != one_after.vertex
    return moves and one_after.vertex == other.vertex and other_after.vertex == one.vertex
