"""Whether a whole fleet can get through its trips: every step from every configuration."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from itertools import product

from rightofway.model import Scenario
from rightofway.site import Roadmap

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
        for after in steps(scenario.roadmap, at, may_rotate=may_rotate):
            state = advance(after, stage, goals)
            if state not in seen:
                seen.add(state)
                queue.append(state)
    return False


def is_step(roadmap: Roadmap, at: Sequence[int], after: Sequence[int], *, may_rotate: bool) -> bool:
    """Tell whether all robots may go from one configuration to another in one step."""
    moves = {a: b for a, b in zip(at, after, strict=True) if a != b}
    return (
        len(set(after)) == len(after)
        and all(roadmap.edge(a, b) is not None for a, b in moves.items())
        and all(moves.get(b) != a for a, b in moves.items())
        and (may_rotate or not _rotates(moves))
    )


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


def steps(roadmap: Roadmap, at: tuple[int, ...], *, may_rotate: bool) -> Iterator[tuple[int, ...]]:
    """Yield every configuration that all robots may go to in one step."""
    choices = [[v, *roadmap.heads[roadmap.indptr[v] : roadmap.indptr[v + 1]].tolist()] for v in at]
    for after in product(*choices):
        if is_step(roadmap, at, after, may_rotate=may_rotate):
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
