"""The default: an answer at once, then a better one until time is up.

A small fleet is planned by two-level, whose decisions are explained; a large one by LaCAM and by
prioritized planning, whichever plan is better. Large neighbourhood search improves the best of
these. Where it finds nothing better than two-level did, the plan of two-level is returned, with its
decisions.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from rightofway.errors import GaveUp
from rightofway.model import cost_of
from rightofway.model.problem import refuse_closures, refuse_turn_rates
from rightofway.model.resources import refuse_sizes
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
        refuse_sizes(task.scenario.problem.resources, "swaps=leave", "choose swaps=resolve")
        refuse_closures(task.scenario.problem, "swaps=leave", "choose swaps=resolve")
        refuse_turn_rates(task.scenario.problem, "swaps=leave", "choose swaps=resolve")
        return paper(task)
    explained = None
    if len(task.scenario.robots) <= FEW:
        options = {"swaps": "resolve", "routes": "clear"}
        hurried = replace(task, options=options, deadline=task.deadline.sooner(SHARE))
        with suppress(GaveUp):
            explained = two_level(hurried)
            task.has_plan()
            task.better(lambda: explained.tracks)
    if explained is None:
        return lns(task)
    resources, first = task.scenario.problem.resources, None
    if resources is None or resources.is_exact:  # else two-level may wait where LNS may not
        first = Draft(tracks=explained.tracks, status=f"two-level, {explained.status}")
    try:
        better = improved(task, fleet_search(task), first=first)
    except GaveUp:
        return explained
    before, after = (cost_of(task.scenario, one.tracks) for one in (explained, better))
    if after < before:
        return better
    return replace(explained, status=better.status, improvement=better.improvement)
