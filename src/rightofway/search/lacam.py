"""A plan for a whole fleet with clocks, instant by instant: only robots that are free decide.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
"""

from __future__ import annotations

from itertools import pairwise

from rightofway import _core
from rightofway.errors import NoPlanExists
from rightofway.model import Problem, Track
from rightofway.search.native import bound

__all__ = ["plan_by_lacam"]

FOUND, PROVEN_NONE = 0, 1


def plan_by_lacam(
    problem: Problem,
    *,
    seed: int = 0,
    most_effort: int,
    time_limit: float | None = None,
    spreads: bool = True,
) -> list[Track] | None:
    """Plan all robots together, each at its own speed.

    Parameters
    ----------
    problem
        What the fleet has to do; no two robots end at one vertex.
    seed
        For ties.
    most_effort
        When the search stops: a choice of a robot is a unit, and so is a decision that it takes
        again to go back to where it has been.
    time_limit
        When to stop [s].
    spreads
        Whether robots prefer paths that were spread before the search.

    Returns
    -------
    list of Track or None
        None if the search stopped before it found a plan. That proves nothing.

    Raises
    ------
    NoPlanExists
        If a robot cannot get to a place.

    Notes
    -----
    Deterministic for a seed as long as there is time; not optimal. Nobody could be earlier on the
    same routes in the same order at every vertex.
    """
    end, first_visit, vertices, enter = _core.plan_by_lacam(
        bound(problem), spreads, seed, most_effort, time_limit
    )
    if end == PROVEN_NONE:
        raise NoPlanExists("a robot has no way to one of its places (join the parts of the map)")
    if end != FOUND:
        return None
    return [
        Track(vertices=vertices[first:last].copy(), enter=enter[first:last].copy())
        for first, last in pairwise(first_visit.tolist())
    ]
