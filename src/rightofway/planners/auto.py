"""The default: an answer at once, then a better one until time is up.

A small fleet is planned by two-level, which explains itself; large ones by whichever of planning
all together and one after another comes out better. Large neighbourhood search improves on the
best of these. Where it finds nothing better than two-level did, the plan of two-level is handed
out, with its decisions.
"""

from __future__ import annotations

from dataclasses import replace

from rightofway.errors import GaveUp
from rightofway.model import flowtime_of
from rightofway.planners.lns import improved, lns
from rightofway.planners.prioritized import fleet_search
from rightofway.planners.task import Draft, Task
from rightofway.planners.two_level import two_level

__all__ = ["auto"]

FEW = 60
"""A fleet is small with so many robots."""

SHARE = 0.3
"""The part of the time that two-level may take."""


def auto(task: Task) -> Draft:
    """Plan by several methods and improve the best plan.

    Parameters
    ----------
    task
        Options: with ``swaps=leave`` it is `two_level` as published; ``iterations`` as for `lns`.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out before there was a plan.
    """
    if task.options["swaps"] == "leave":
        return two_level(task)
    explained = _explained(task) if len(task.scenario.robots) <= FEW else None
    if explained is None:
        return lns(task)
    first = Draft(tracks=explained.tracks, status=f"two-level, {explained.status}")
    better = improved(task, fleet_search(task), first=first)
    before, after = (flowtime_of(task.scenario, one.tracks) for one in (explained, better))
    if after < before:
        return better
    return replace(explained, status=better.status)


def _explained(task: Task) -> Draft | None:
    options = {"swaps": "resolve", "routes": "clear"}
    try:
        draft = two_level(replace(task, options=options, deadline=task.deadline.sooner(SHARE)))
    except GaveUp:
        return None
    task.has_plan()
    return draft
