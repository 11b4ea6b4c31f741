"""A plan for a whole fleet with clocks, instant by instant: only robots that are free decide.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
"""

from __future__ import annotations

from itertools import accumulate, chain, pairwise

import numpy as np

from rightofway import _core
from rightofway.errors import NoPlanExists
from rightofway.model import Itinerary, Scenario, Tick, Track

__all__ = ["plan_by_lacam"]

FOUND, PROVEN_NONE = 0, 1


def plan_by_lacam(
    scenario: Scenario,
    *,
    headway: Tick,
    seed: int = 0,
    most_effort: int,
    time_limit: float | None = None,
    spreads: bool = True,
) -> list[Track] | None:
    """Plan all robots together, each at its own speed.

    Parameters
    ----------
    scenario
        The problem; no two robots end at one vertex.
    headway
        Ticks that a vertex stays booked after it was left; at least those of the scenario.
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
    itineraries, rules = scenario.problem.itineraries, scenario.rules
    stages = [itinerary.stages for itinerary in itineraries]
    every_stage = list(chain.from_iterable(stages))
    end, first_visit, vertices, enter = _core.plan_by_lacam(
        scenario.roadmap.indptr,
        scenario.roadmap.heads,
        scenario.roadmap.length_class,
        np.array([itinerary.home for itinerary in itineraries], np.int32),
        np.array([0, *accumulate(map(len, stages))], np.int32),
        np.array([stage.vertex for stage in every_stage], np.int32),
        np.array([stage.work + stage.turn for stage in every_stage], np.int64),
        _class_ticks(itineraries),
        int(headway),
        rules.books_ahead,
        rules.rotations and not rules.books_ahead and headway == 0,
        spreads,
        seed,
        most_effort,
        time_limit,
    )
    if end == PROVEN_NONE:
        raise NoPlanExists("a robot has no way to one of its places (join the parts of the map)")
    if end != FOUND:
        return None
    return [
        Track(vertices=vertices[first:last].copy(), enter=enter[first:last].copy())
        for first, last in pairwise(first_visit.tolist())
    ]


def _class_ticks(itineraries: tuple[Itinerary, ...]) -> np.ndarray[tuple[int], np.dtype[np.int32]]:
    return np.array([ticks for one in itineraries for ticks in one.edge_ticks], np.int32)
