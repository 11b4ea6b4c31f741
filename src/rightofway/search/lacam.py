"""LaCAM for a whole fleet: with clocks, instant by instant, or without, in steps.

With clocks only robots that are free decide. Without clocks the search is complete: it finds an
order of moves or proves that none exists.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import Blockage, GaveUp, NoPlanExists
from rightofway.model import Problem, Track
from rightofway.model.given import checked_index, checked_seed
from rightofway.native import bound, tracks_of

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
    Deterministic for a seed as long as there is time; not optimal. No robot could be earlier on
    the same routes with the same order at every vertex, unless rotations are forbidden or the
    roadmap has zones.
    """
    end, first_visit, vertices, enter = _core.plan_by_lacam(
        bound(problem), spreads, checked_seed(seed), most_effort, time_limit
    )
    if end == PROVEN_NONE:
        raise NoPlanExists(
            [
                Blockage(
                    "a robot has no way to one of its places", (), (), "join the parts of the map"
                )
            ]
        )
    return tracks_of(first_visit, vertices, enter) if end == FOUND else None


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
        Robots that only prefer their last stage: any vertex will do that is in no robot's way.

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
    native, robots = bound(problem), range(len(problem.itineraries))
    for robot in ends_anywhere:
        checked_index("ends_anywhere", robot, len(robots))
    anywhere = np.array([robot in ends_anywhere for robot in robots], np.uint8)
    end, steps = _core.untimed_lacam(native, anywhere, checked_seed(seed), most_steps, time_limit)
    if end == PROVEN_NONE:
        raise NoPlanExists(
            [
                Blockage(
                    "no order of moves brings every robot through its trip",
                    (),
                    (),
                    "give more room",
                )
            ]
        )
    if end != FOUND:
        raise GaveUp("time ran out in the search for the whole fleet (give a longer time limit)")
    return steps
