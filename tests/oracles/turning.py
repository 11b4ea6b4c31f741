"""Robots that need time to turn: angles by complex numbers, and the best plan of a few robots.

The least flowtime is found by a search over where all robots are, tick by tick: one way trips
without work and headway, of robots that book ahead. A robot that has begun to turn towards an edge
turns and drives; before that it may stand as long as it likes.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator
from fractions import Fraction
from functools import cache, partial
from heapq import heappop, heappush
from itertools import combinations, product
from math import ceil, degrees
from typing import NamedTuple

from rightofway.model import Scenario
from tests.oracles.joint_space import costs_to_go
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


Booked = tuple[Shape, ...]
Action = tuple[_State, Booked, int]
"""The next state, what is booked in the tick, and what the tick costs."""


class _Fleet:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.has_sizes = not scenario.problem.resources.are_points
        self.excludes = cache(partial(incompatible, scenario))
        self.clash = cache(self._clash)
        self.actions = cache(lambda robot, state: list(self._actions(robot, state)))

    def _clash(self, i: int, one: Booked, j: int, other: Booked) -> bool:
        """Return whether what robots i and j book in one tick excludes each other."""
        if not self.has_sizes:
            return bool(set(one) & set(other))
        return any(self.excludes(i, x, j, y) for x, y in product(one, other))

    def _actions(self, robot: int, state: _State) -> Iterator[Action]:
        """Yield the next state, what is booked in the tick, and what the tick costs."""
        here: Booked = ((state.vertex,),)
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
                yield from self._actions(robot, state._replace(head=head, turn=turns, left=ticks))

    def _driving(self, state: _State) -> Booked:
        along: Booked = ((state.vertex, state.head),) if self.has_sizes else ()
        return ((state.vertex,), (state.head,), *along)


def least_flowtime(scenario: Scenario) -> int | None:
    """Return the least sum of completions [ticks], None where there is no plan.

    Joint states in the order of what they cost and what each robot alone would cost from there.
    """
    fleet, robots = _Fleet(scenario), range(len(scenario.robots))
    start = tuple(_State(itinerary.home) for itinerary in scenario.problem.itineraries)
    alone = [costs_to_go(start[robot], partial(fleet.actions, robot)) for robot in robots]
    if any(state not in costs for costs, state in zip(alone, start, strict=True)):
        return None
    best = {start: 0}
    heap = [(0, 0, start)]
    while heap:
        _, negative, states = heappop(heap)
        cost = -negative
        if all(state.is_done for state in states):
            return cost
        if best[states] < cost:
            continue
        for chosen in product(*(fleet.actions(robot, states[robot]) for robot in robots)):
            after = tuple(each[0] for each in chosen)
            total = cost + sum(each[2] for each in chosen)
            if total >= best.get(after, total + 1) or any(
                fleet.clash(i, chosen[i][1], j, chosen[j][1]) for i, j in combinations(robots, 2)
            ):
                continue
            if any(state not in costs for costs, state in zip(alone, after, strict=True)):
                continue
            best[after] = total
            left = sum(costs[state] for costs, state in zip(alone, after, strict=True))
            heappush(heap, (total + left, -total, after))
    return None
