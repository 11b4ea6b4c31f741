"""The least flowtime of a few robots with sizes: a search over where all of them are.

One way trips without work and headway. In each tick a robot stands, drives or is done for ever;
what it books in that tick must not exclude what any other robot books.
"""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heappop, heappush
from itertools import combinations, product
from typing import NamedTuple

from rightofway.model import Scenario
from tests.oracles.space import Shape, drive, incompatible, zones_around, zones_with


class State(NamedTuple):
    """A robot at the start of a tick: where it stands or drives from, and what is left."""

    vertex: int
    head: int = -1
    left: int = 0  # ticks of the drive to the head
    is_done: bool = False
    came: frozenset[int] = frozenset()  # zones with the edge driven in that do not list the vertex
    passes: frozenset[int] = frozenset()  # those with the edge that is driven out, decided before


class _Fleet:
    """What each robot can do in a tick, and whether two robots can do it together."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.excludes: dict[tuple[int, Shape, int, Shape], bool] = {}

    def clash(self, i: int, one: list[Shape], j: int, other: list[Shape]) -> bool:
        """Return whether robots i and j book shapes that exclude each other."""
        for x, y in product(one, other):
            if (i, x, j, y) not in self.excludes:
                self.excludes[i, x, j, y] = incompatible(self.scenario, i, x, j, y)
        return any(self.excludes[i, x, j, y] for x, y in product(one, other))

    def actions(self, robot: int, state: State) -> Iterator[tuple[State, list[Shape], int]]:
        """Yield the next state, what is booked in the tick, and what the tick costs."""
        roadmap = self.scenario.roadmap
        inside = zones_around(roadmap, state.vertex) | state.passes
        here: list[Shape] = [(state.vertex,), *((-1 - zone,) for zone in inside)]
        if state.is_done:
            yield state, here, 0
        elif state.left:
            left, edge = state.left - 1, (state.vertex, state.head)
            along, ahead = zones_with(roadmap, edge), zones_around(roadmap, state.head)
            booked = [*here, (state.head,), edge, *((-1 - zone,) for zone in along | ahead)]
            if left:
                yield state._replace(left=left), booked, 1
                return
            came = frozenset(along - ahead)
            for size in range(len(came) + 1):
                for passes in combinations(sorted(came), size):
                    after = State(state.head, came=came, passes=frozenset(passes))
                    yield after, booked, 1
        else:
            if state.vertex == self.scenario.problem.itineraries[robot].last and not state.passes:
                yield state._replace(is_done=True), here, 0
            yield state, here, 1
            first, end = roadmap.indptr[state.vertex : state.vertex + 2].tolist()
            for head in roadmap.heads[first:end].tolist():
                if state.came & zones_with(roadmap, (state.vertex, head)) != state.passes:
                    continue
                ticks = int(drive(self.scenario, robot, state.vertex, head))
                yield from self.actions(robot, state._replace(head=head, left=ticks))


def least_flowtime(scenario: Scenario) -> int | None:
    """Return the least sum of completions [ticks], None where there is no plan."""
    fleet, robots = _Fleet(scenario), range(len(scenario.robots))
    start = tuple(State(itinerary.home) for itinerary in scenario.problem.itineraries)
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
