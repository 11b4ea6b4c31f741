"""Whether, and in which order, a whole fleet can get where it has to go: a search without clocks.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import accumulate, chain

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Scenario

__all__ = ["untimed_lacam"]

FOUND, PROVEN_NONE = 0, 1


def untimed_lacam(
    scenario: Scenario,
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
    scenario
        The problem.
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
    itineraries = scenario.problem.itineraries
    stages = [itinerary.stages for itinerary in itineraries]
    end, steps = _core.untimed_lacam(
        scenario.roadmap.indptr,
        scenario.roadmap.heads,
        np.array([itinerary.home for itinerary in itineraries], np.int32),
        np.array([0, *accumulate(map(len, stages))], np.int32),
        np.array([stage.vertex for stage in chain.from_iterable(stages)], np.int32),
        np.array([robot in ends_anywhere for robot in range(len(stages))], np.uint8),
        _may_rotate(scenario),
        seed,
        time_limit,
        most_steps,
    )
    if end == PROVEN_NONE:
        raise NoPlanExists("no order of moves brings every robot through its trip (give more room)")
    if end != FOUND:
        raise GaveUp("time ran out in the search for the whole fleet (give a longer time limit)")
    return steps


def _may_rotate(scenario: Scenario) -> bool:
    """Tell whether robots may all move round a circle, each booking what another leaves then."""
    rules = scenario.rules
    return rules.rotations and not rules.books_ahead and rules.headway == 0
