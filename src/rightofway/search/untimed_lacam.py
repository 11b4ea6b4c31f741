"""Whether, and in which order, a whole fleet can get where it has to go: a search without clocks.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Problem
from rightofway.search.native import bound

__all__ = ["untimed_lacam"]

FOUND, PROVEN_NONE = 0, 1


def untimed_lacam(
    problem: Problem,
    *,
    seed: int = 0,
    time_limit: float | None = None,
    most_steps: int | None = None,
    ends_anywhere: Collection[int] = (),
) -> NDArray[np.int32]:
    """Find steps for the whole fleet that bring every robot through its stages.

    In a step each robot stays or moves to a neighbour. Speeds, work and headways do not matter for
    whether there is a plan, because everybody can wait; the order in which robots visit a vertex
    is all that a timetable needs.

    Parameters
    ----------
    problem
        What the fleet has to do.
    seed
        For ties.
    time_limit
        When to stop [s].
    most_steps
        After how many steps of the fleet to stop, those taken back included.
    ends_anywhere
        Robots that only prefer their last stage: any vertex will do where they are in nobody's way.

    Returns
    -------
    ndarray of int32, shape (T, R)
        The vertex of every robot after each step, the start included.

    Raises
    ------
    NoPlanExists
        If it is proven that there are no such steps, and so no plan.
    GaveUp
        If time or steps ran out.

    Notes
    -----
    Complete; deterministic for a seed; not optimal.
    """
    robots = range(len(problem.itineraries))
    anywhere = np.array([robot in ends_anywhere for robot in robots], np.uint8)
    end, steps = _core.untimed_lacam(bound(problem), anywhere, seed, most_steps, time_limit)
    if end == PROVEN_NONE:
        raise NoPlanExists("no order of moves brings every robot through its trip (give more room)")
    if end != FOUND:
        raise GaveUp("time ran out in the search for the whole fleet (give a longer time limit)")
    return steps
