"""All robots together, instant by instant: LaCAM for robots with clocks.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
Okumura, Machida, Défago & Tamura, *Priority inheritance with backtracking for iterative multi-agent
path finding*, Artificial Intelligence 310, 2022.
"""

from __future__ import annotations

from rightofway.planners.joint import plan_jointly
from rightofway.planners.task import Draft, Task

__all__ = ["lacam"]


def lacam(task: Task) -> Draft:
    """Plan with clocks; where that does not come to an end, find an order of moves without.

    Parameters
    ----------
    task
        Options: ``paths`` is ``spread`` or ``shortest``.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.
    """
    tracks, status = plan_jointly(task, spreads=task.options["paths"] == "spread")
    return Draft(tracks=tuple(tracks), status=status)
