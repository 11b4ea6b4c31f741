"""The default: a plan as early as possible, then better plans until time is up.

A small fleet is planned by two-level, whose decisions are explained; a large one by LaCAM and by
prioritized planning, whichever plan is better. Large neighbourhood search improves the best of
these. Where it finds nothing better than two-level did, the plan of two-level is returned, with its
decisions. It starts from a given plan unless the plan of two-level is better.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from rightofway.errors import GaveUp, InputError
from rightofway.model import cost_of
from rightofway.planners.features import refuse_with_swaps_left
from rightofway.planners.lns import improved, lns
from rightofway.planners.prioritized import fleet_search
from rightofway.planners.task import Draft, Task
from rightofway.planners.two_level import paper, two_level

FEW = 60
"""A fleet is small with at most this many robots."""

SHARE = 0.3
"""The part of the time for two-level."""


def auto(task: Task) -> Draft:
    """Plan by several methods and improve the best plan; options: `AutoOptions`.

    With ``swaps=leave`` it is `paper`, for points only.
    """
    if task.options["swaps"] == "leave":
        if task.start is not None:
            message = "leave cannot start from a plan (choose swaps=resolve)"
            raise InputError.at(("options", "swaps"), message)
        refuse_with_swaps_left(task.scenario.problem)
        return paper(task)
    explained = None
    if len(task.scenario.robots) <= FEW:
        options = {"swaps": "resolve", "routes": "clear"}
        hurried = replace(task, options=options, start=None, deadline=task.deadline.sooner(SHARE))
        with suppress(GaveUp):
            explained = two_level(hurried)
            task.has_plan()
            task.better(lambda: explained.tracks)
    if explained is None or not _is_preferred(task, explained):
        return lns(task)
    first = Draft(tracks=explained.tracks, status=f"two-level, {explained.status}")
    try:
        if task.start is None:
            better = improved(task, fleet_search(task), first=first)
        else:
            better = lns(replace(task, start=explained.tracks))
    except GaveUp:
        return explained
    before, after = (cost_of(task.scenario, draft.tracks) for draft in (explained, better))
    if after < before:
        return better
    return replace(
        explained, status=better.status, improvement=better.improvement, proof=better.proof
    )


def _is_preferred(task: Task, explained: Draft) -> bool:
    """Whether the plan of two-level is better than the plan given, or is that plan."""
    if task.start is None or explained.tracks == task.start:
        return True
    return cost_of(task.scenario, explained.tracks) < cost_of(task.scenario, task.start)
