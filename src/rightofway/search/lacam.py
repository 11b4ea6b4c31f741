"""LaCAM: a search over the states of a whole fleet, instant by instant.

Only robots that are free decide. Where the fleet moves in steps (`Problem.as_steps`), the search is
complete: it finds a plan or proves that none exists.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from rightofway import _core
from rightofway.errors import Blockage, NoPlanExists
from rightofway.facts import Fact
from rightofway.kinds.table import SEED, require_index
from rightofway.model import Problem, Track
from rightofway.native import bind_native, make_tracks

FOUND, PROVEN_NONE = 0, 1


def plan_by_lacam(
    problem: Problem,
    *,
    seed: int = 0,
    most_effort: int | None = None,
    time_limit: float | None = None,
    spreads: bool = True,
    ends_anywhere: Collection[int] = (),
) -> list[Track] | None:
    """Plan all robots together, each at its own speed.

    Parameters
    ----------
    problem
        The trips of the fleet; no two robots end at one vertex.
    seed
        For ties.
    most_effort
        When the search stops: a choice of a robot is a unit, and so is a decision that it takes
        again to go back to where it has been. None: as late as the time limit.
    time_limit
        When to stop [s].
    spreads
        Whether robots prefer paths that were spread before the search.
    ends_anywhere
        Robots that only prefer their last stage: any vertex will do that is in no robot's way.

    Returns
    -------
    list of Track or None
        None if the search stopped before it found a plan. That proves nothing.

    Raises
    ------
    NoPlanExists
        If a robot cannot get to a place, or, for a fleet that moves in steps, if the search has
        tried all steps.

    Notes
    -----
    Deterministic for a seed as long as there is time; not optimal. No robot could be earlier on
    the same routes with the same order at every vertex, unless robots have a size.
    """
    native, robots = bind_native(problem), range(len(problem.itineraries))
    for robot in ends_anywhere:
        require_index("ends_anywhere", robot, len(robots))
    anywhere = [robot in ends_anywhere for robot in robots] if ends_anywhere else []
    end, first_visit, vertices, enter = _core.plan_by_lacam(
        native,
        np.array(anywhere, np.uint8),
        spreads,
        SEED.read_at("seed", seed),
        most_effort,
        time_limit,
    )
    if end == PROVEN_NONE:
        raise NoPlanExists([Blockage(Fact("no order of moves"), remedy=Fact("give more room"))])
    return make_tracks(first_visit, vertices, enter) if end == FOUND else None
