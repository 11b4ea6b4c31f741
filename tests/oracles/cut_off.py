"""How many robots can finish when some stand still for ever: every step there is."""

from __future__ import annotations

from collections.abc import Sequence

from rightofway.model import Scenario
from tests.oracles.all_steps import advance, steps

__all__ = ["most_who_can_finish"]


def most_who_can_finish(
    scenario: Scenario,
    at: Sequence[int],
    goals: Sequence[Sequence[int]],
    stuck: frozenset[int],
    closed: frozenset[int],
    *,
    may_rotate: bool,
) -> int:
    """Return the most robots that are through their goals and at the last one, all at one time.

    Parameters
    ----------
    scenario
        The map, and which robots are barred from which edges.
    at
        Where each robot stands.
    goals
        The vertices each has to go to, one after the other; the last one is where it stays.
    stuck
        Robots that never move again.
    closed
        Vertices that nobody enters or leaves any more.
    may_rotate
        Whether robots may move round a circle all at once.
    """
    goals = [list(goal) for goal in goals]
    start = advance(tuple(at), (0,) * len(at), goals)
    open_, seen, best = [start], {start}, 0
    while open_:
        places, stage = open_.pop()
        through = (
            r not in stuck and goal[reached:] == [place]
            for r, (goal, reached, place) in enumerate(zip(goals, stage, places, strict=True))
        )
        best = max(best, sum(through))
        for after in steps(scenario, places, may_rotate=may_rotate):
            moved = {v for a, b in zip(places, after, strict=True) if a != b for v in (a, b)}
            state = advance(after, stage, goals)
            if not moved & closed and state not in seen:
                seen.add(state)
                open_.append(state)
    return best
