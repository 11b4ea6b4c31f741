"""LaCAM: the whole fleet at once, a search over where all robots are.

The search goes from instant to instant with each robot's own speed and work. It drives along whole
lanes; their pieces are used by the earliest timetable of its order of visits. Where it ends without
a plan, the same search brings all robots through their trips in steps (`Problem.as_steps`), in some
order of moves. That order gives each robot a route, and each vertex an order of visits: rights of
way, whose earliest timetable is a plan for any speeds, work times and headways.

References
----------
Okumura, *LaCAM: Search-based algorithm for quick multi-agent pathfinding*, AAAI 2023.
Okumura, Machida, Défago & Tamura, *Priority inheritance with backtracking for iterative multi-agent
path finding*, Artificial Intelligence 310, 2022.

Notes
-----
Complete: the search in steps finds an order of moves or proves that none exists. Deterministic, as
long as nine tenths of the time limit are enough for the search by instants. Not optimal.
"""

from __future__ import annotations

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import Status
from rightofway.precedence import build_timetable
from rightofway.repair.impossible import (
    refuse_blocked,
    refuse_blocked_parts,
    refuse_stranded,
    refuse_the_impossible,
)
from rightofway.repair.joint_states import plan_by_joint_states
from rightofway.repair.moves import plan_by_moves
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.repair.whole_lanes import join_pieces
from rightofway.search import Distances, FleetSearch, plan_by_lacam

SHARE_OF_TIME = 0.9
"""The part of the time for the search by instants."""

MANY = 5000
"""For more robots the search in steps gets no time: a tenth of the time would be too short."""

LEAST_EFFORT, EFFORT_PER_PLACE = 2_000_000, 8
"""Choices of the search by instants: the minimum, and the limit per robot and vertex above it."""


def lacam(request: PlanRequest) -> Draft:
    """Plan the whole fleet at once; options: `LacamOptions`."""
    return plan_fleet(request, spreads=request.options["paths"] == "spread")


def plan_fleet(request: PlanRequest, *, spreads: bool = True) -> Draft:
    """Plan the whole fleet at once; ``spreads``: robots prefer paths that were spread before."""
    scenario = request.scenario
    problem = scenario.problem
    if problem.is_open:
        draft = plan_by_instants(request, spreads=spreads)
        if draft is not None:
            return draft
    elif (draft := plan_by_joint_states(request)) is not None:
        return draft
    if not problem.resources.are_points:
        request.report(Fact("planning single moves"))
        search = FleetSearch(scenario.problem, seed=request.seed, alone=request.alone)
        return plan_by_moves(request, search)
    if problem.is_open:
        request.report(Fact("planning moves without clocks"))
        refuse_blocked_parts(request)
    try:
        tracks = plan_by_lacam(
            problem.as_steps(),
            seed=request.seed,
            time_limit=request.deadline.measure_seconds_left(),
            spreads=spreads and problem.is_open,
        )
    except NoPlanExists:
        refuse_blocked(request)
    if not problem.is_open:
        raise GaveUp(Fact("no plan in turn among barred edges"))
    if tracks is None:
        raise GaveUp(Fact("time over for the fleet"))
    in_time = build_timetable(problem, tracks)
    assert in_time is not None, "what took place in some order can take place in it again"
    request.has_plan()
    return Draft(tracks=tuple(in_time), status=Status("moves"))


def plan_by_instants(
    request: PlanRequest, *, spreads: bool = True, effort: int | None = None
) -> Draft | None:
    """Plan the whole fleet by the search by instants alone; None if it ends without a plan."""
    scenario, robots, share = request.scenario, len(request.scenario.robots), SHARE_OF_TIME
    most_effort = max(LEAST_EFFORT, EFFORT_PER_PLACE * robots * scenario.roadmap.n_vertices)
    refuse_stranded(scenario, ())
    whole = join_pieces(scenario.problem)
    try:
        tracks = plan_by_lacam(
            scenario.problem if whole is None else whole.problem,
            seed=request.seed,
            most_effort=most_effort if effort is None else min(effort, most_effort),
            time_limit=request.deadline.shorten(
                share if robots <= MANY else 1
            ).measure_seconds_left(),
            spreads=spreads,
        )
    except NoPlanExists:
        refuse_the_impossible(scenario, Distances(scenario.roadmap))
        refuse_blocked_parts(request)
        refuse_blocked(request)
    if tracks is not None and whole is not None:
        in_pieces = [whole.split_track(robot, track) for robot, track in enumerate(tracks)]
        tracks = build_timetable(scenario.problem, in_pieces)
    if tracks is None:
        return None
    request.has_plan()
    return Draft(tracks=tuple(tracks), status=Status("instants"))
