"""The least completion of each robot without the others: no plan has a flowtime below their sum."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from rightofway.errors import NoPlanExists
from rightofway.model import Scenario, Tick
from rightofway.search import compute_least_completions
from rightofway.search.missing_ways import find_missing_ways


@lru_cache(maxsize=4)
def compute_alone_completions(scenario: Scenario) -> tuple[Tick, ...]:
    """Return each robot's least completion time without the others, and without closures.

    Parameters
    ----------
    scenario
        The problem.

    Returns
    -------
    tuple of int
        One for each robot [ticks].

    Raises
    ------
    NoPlanExists
        If no way leads from one place of a robot's trip to the next; with all such robots.

    Notes
    -----
    The latest answers are kept. A plan that was made in this process brings its own figures, which
    the planner computed.
    """
    ticks = compute_least_completions(scenario)
    assert ticks is not None, "no time limit was given"
    stranded = np.flatnonzero(ticks < 0).tolist()
    if stranded:
        raise NoPlanExists(find_missing_ways(scenario, stranded), scenario)
    return tuple(map(Tick, ticks.tolist()))
