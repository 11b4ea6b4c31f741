"""All robots together, instant by instant: LaCAM for robots with clocks.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
Okumura, Machida, Défago & Tamura, *Priority inheritance with backtracking for iterative multi-agent
path finding*, Artificial Intelligence 310, 2022.
"""

from __future__ import annotations

from rightofway.errors import NoPlanExists
from rightofway.model import Scenario, Track
from rightofway.planners.joint import plan_jointly
from rightofway.planners.routing import refuse_shared_ends, refuse_the_impossible
from rightofway.planners.task import Draft, Task, planning_headway
from rightofway.search import Distances, plan_by_events

__all__ = ["lacam"]

SHARE_OF_TIME = 0.9
"""How much of its time the search with clocks may take, if it does not give up before."""

LEAST_EFFORT = 2_000_000
EFFORT_PER_PLACE = 8
"""How patient the search with clocks is: choices per robot and vertex, but at least so many."""


def lacam(task: Task) -> Draft:
    """Plan with clocks; where that does not come to an end, find an order of moves without.

    Raises
    ------
    NoPlanExists
        If it is proven that there is none.
    GaveUp
        If time ran out.

    Notes
    -----
    Complete: the search without clocks finds an order of moves or proves that there is none.
    Deterministic, as long as nine tenths of the time limit are enough for the search with clocks.
    Not optimal.
    """
    refuse_shared_ends(task.scenario)
    tracks = _by_events(task)
    if tracks is not None:
        return Draft(tracks=tuple(tracks), status="instant by instant")
    task.report("no end by instants: planning the order of moves without clocks")
    distances = Distances(task.scenario.roadmap)
    return Draft(tracks=tuple(plan_jointly(task, distances)), status="order of moves first")


def _by_events(task: Task) -> list[Track] | None:
    try:
        return plan_by_events(
            task.scenario,
            headway=planning_headway(task.scenario),
            seed=task.seed,
            most_effort=_patience(task.scenario),
            time_limit=task.deadline.sooner(SHARE_OF_TIME).seconds_left(),
            spreads=task.options.get("paths") != "shortest",
        )
    except NoPlanExists:
        refuse_the_impossible(task.scenario, Distances(task.scenario.roadmap))
        raise


def _patience(scenario: Scenario) -> int:
    places = len(scenario.robots) * scenario.roadmap.n_vertices
    return max(LEAST_EFFORT, EFFORT_PER_PLACE * places)
