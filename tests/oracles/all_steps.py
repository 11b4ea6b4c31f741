"""Whether a whole fleet can get through its trips: every step from every configuration."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from itertools import product

from rightofway.model import Scenario
from rightofway.site import VertexId

__all__ = ["advance", "can_get_through", "is_step", "steps"]

State = tuple[tuple[int, ...], tuple[int, ...]]


def can_get_through(scenario: Scenario, *, may_rotate: bool) -> bool:
    """Search all configurations that can be reached, the nearest first."""
    goals = [[int(s.vertex) for s in it.stages] for it in scenario.problem.itineraries]
    homes = tuple(int(itinerary.home) for itinerary in scenario.problem.itineraries)
    start = advance(homes, (0,) * len(homes), goals)
    queue, seen = deque([start]), {start}
    while queue:
        at, stage = queue.popleft()
        if all(g[s:] == [v] for g, s, v in zip(goals, stage, at, strict=True)):
            return True
        for after in steps(scenario, at, may_rotate=may_rotate):
            state = advance(after, stage, goals)
            if state not in seen:
                seen.add(state)
                queue.append(state)
    return False


def is_step(
    scenario: Scenario, at: Sequence[int], after: Sequence[int], *, may_rotate: bool
) -> bool:
    """Tell whether all robots may go from one configuration to another in one step."""
    # Vertices of several directions at one place exclude each other.
    before, behind = (
        [int(min(scenario.roadmap.list_place(VertexId(vertex)))) for vertex in fleet]
        for fleet in (at, after)
    )
    moves = {a: b for a, b in zip(before, behind, strict=True) if a != b}
    return (
        len(set(behind)) == len(behind)
        and all(
            a == b or _may_drive(scenario, r, a, b)
            for r, (a, b) in enumerate(zip(at, after, strict=True))
        )
        and all(moves.get(b) != a for a, b in moves.items())
        and (may_rotate or not _rotates(moves))
    )


def _may_drive(scenario: Scenario, robot: int, tail: int, head: int) -> bool:
    """Tell whether there is an edge, and it is not barred to the robot."""
    roadmap, ticks = scenario.roadmap, scenario.problem.itineraries[robot].edge_ticks
    edge = roadmap.find_edge(tail, head)
    return edge is not None and ticks[roadmap.class_of_edge[edge]] >= 0


def _rotates(moves: dict[int, int]) -> bool:
    for start, head in moves.items():
        place = head
        while place in moves and place != start:
            place = moves[place]
            if place == head:
                break  # round a circle that does not hold the start
        if place == start:
            return True
    return False


def steps(
    scenario: Scenario, at: tuple[int, ...], *, may_rotate: bool
) -> Iterator[tuple[int, ...]]:
    """Yield every configuration that all robots may go to in one step."""
    roadmap = scenario.roadmap
    choices = [[v, *roadmap.heads[roadmap.indptr[v] : roadmap.indptr[v + 1]].tolist()] for v in at]
    for after in product(*choices):
        if is_step(scenario, at, after, may_rotate=may_rotate):
            yield after


def advance(at: tuple[int, ...], stage: tuple[int, ...], goals: Sequence[Sequence[int]]) -> State:
    """Return a configuration with the number of the goal that each robot then is on its way to."""
    done = []
    for place, number, goal in zip(at, stage, goals, strict=True):
        reached = number
        while reached < len(goal) - 1 and goal[reached] == place:
            reached += 1
        done.append(reached)
    return at, tuple(done)
