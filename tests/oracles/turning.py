"""Robots that need time to turn: angles by complex numbers, and the best plan of a few robots.

The least flowtime is found by a search over where all robots are, tick by tick: one way trips
without work and headway, of robots that book ahead. A robot that has begun to turn towards an edge
turns and drives; before that it may stand as long as it likes.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from fractions import Fraction
from heapq import heappop, heappush
from itertools import combinations, product
from math import ceil, degrees
from typing import NamedTuple

from rightofway.model import Scenario
from tests.oracles.space import Shape, drive, incompatible

__all__ = ["least_flowtime", "turn"]


def turn(scenario: Scenario, robot: int, before: int, at: int, to: int) -> int:
    """Return how long a robot turns that comes to a vertex from one and goes to another [ticks].

    ``before`` is -1 for a robot that has not driven yet.
    """
    rates = scenario.robots[robot].turn_rate, scenario.rules.turn_rate
    rate = rates[1] if rates[0] is None else rates[0]
    if before < 0 or rate is None:
        return 0
    places = [complex(*scenario.roadmap.positions[vertex].tolist()) for vertex in (before, at, to)]
    came, goes = places[1] - places[0], places[2] - places[1]
    if came == 0 or goes == 0:
        return 0
    angle = Fraction(round(abs(degrees(phase(goes / came))) * 10**6), 10**6)
    return ceil(angle / rate / scenario.problem.clock.tick)


class _State(NamedTuple):
    """A robot at the start of a tick."""

    vertex: int
    before: int = -1  # the vertex that it has come from
    head: int = -1  # where it turns and drives to
    turn: int = 0  # ticks left
    left: int = 0  # ticks of the drive left
    is_done: bool = False


class _Fleet:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.has_sizes = not scenario.problem.resources.are_points
        self.excludes: dict[tuple[int, Shape, int, Shape], bool] = {}

    def clash(self, i: int, one: list[Shape], j: int, other: list[Shape]) -> bool:
        """Return whether what robots i and j book in one tick excludes each other."""
        if not self.has_sizes:
            return bool(set(one) & set(other))
        for x, y in product(one, other):
            if (i, x, j, y) not in self.excludes:
                self.excludes[i, x, j, y] = incompatible(self.scenario, i, x, j, y)
        return any(self.excludes[i, x, j, y] for x, y in product(one, other))

    def actions(self, robot: int, state: _State) -> Iterator[tuple[_State, list[Shape], int]]:
        """Yield the next state, what is booked in the tick, and what the tick costs."""
        here: list[Shape] = [(state.vertex,)]
        if state.is_done:
            yield state, here, 0
        elif state.turn:
            yield state._replace(turn=state.turn - 1), here, 1
        elif state.left > 1:
            yield state._replace(left=state.left - 1), self._driving(state), 1
        elif state.left:
            yield _State(state.head, state.vertex), self._driving(state), 1
        else:
            if state.vertex == self.scenario.problem.itineraries[robot].last:
                yield state._replace(is_done=True), here, 0
            yield state, here, 1
            roadmap = self.scenario.roadmap
            first, end = roadmap.indptr[state.vertex : state.vertex + 2].tolist()
            for head in roadmap.heads[first:end].tolist():
                turns = turn(self.scenario, robot, state.before, state.vertex, head)
                ticks = int(drive(self.scenario, robot, state.vertex, head))
                yield from self.actions(robot, state._replace(head=head, turn=turns, left=ticks))

    def _driving(self, state: _State) -> list[Shape]:
        along: list[Shape] = [(state.vertex, state.head)] if self.has_sizes else []
        return [(state.vertex,), (state.head,), *along]


def least_flowtime(scenario: Scenario) -> int | None:
    """Return the least sum of completions [ticks], None where there is no plan."""
    fleet, robots = _Fleet(scenario), range(len(scenario.robots))
    start = tuple(_State(itinerary.home) for itinerary in scenario.problem.itineraries)
    best = {start: 0}
    heap = [(0, start)]
    while heap:
        cost, states = heappop(heap)
        if all(state.is_done for state in states):
            return cost
        if best[states] < cost:
            continue
        for chosen in product(*(list(fleet.actions(robot, states[robot])) for robot in robots)):
            if any(
                fleet.clash(i, chosen[i][1], j, chosen[j][1]) for i, j in combinations(robots, 2)
            ):
                continue
            after = tuple(each[0] for each in chosen)
            total = cost + sum(each[2] for each in chosen)
            if total < best.get(after, total + 1):
                best[after] = total
                heappush(heap, (total, after))
    return None
