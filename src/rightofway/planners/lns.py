"""Large neighbourhood search: the tracks of a few robots at a time are replanned, anytime.

Where no neighbourhood gains any more, a small population of plans of the fleet is crossed.

References
----------
Li, Chen, Harabor, Stuckey & Koenig, *Anytime multi-agent path finding via large neighborhood
search*, IJCAI 2021.

Li, Chen, Harabor, Stuckey & Koenig, *MAPF-LNS2: Fast repairing for multi-agent path finding via
large neighborhood search*, AAAI 2022.

Moscato & Norman, *A memetic approach for the traveling salesman problem*, 1992.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Improvement, Objective, Status, Tick, Track
from rightofway.planners.lacam import plan_by_instants, plan_fleet
from rightofway.planners.prioritized import (
    MOST_ROBOTS,
    plan_in_turn,
    plan_whole_fleet,
)
from rightofway.planners.rivals import UNLIMITED, Rival
from rightofway.precedence import build_graph_of_plan
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.search import FleetSearch

SHARE, SHARE_WITH_SIZES = 0.9, 0.2
"""The part of the time for LaCAM, which makes a first plan: for points, and for sizes."""

EFFORT = 2000
"""Number of choices of LaCAM for each robot before robots are planned one after another.

Where it finds a plan, it does so with a few hundred choices for each, as a rule.
"""

SHARE_IN_TURN = 0.5
"""The part of the time left for planning points one after another where LaCAM found no plan."""

PATIENCE = 1000
"""The search ends after this many neighbourhoods per robot without a gain."""

BETWEEN_REPORTS = 0.5
"""Time from one sentence on progress to the next [s]."""

RETIMING = 0.9e-6
"""The time that the last step takes for each visit of the plan, `FleetSearch.retime` [s]."""

RETIMING_AMONG_CLOSURES = 15e-6
"""The same with closures, where a precedence graph does it [s]."""

ITERATIONS_PER_TURN = 1
"""Neighbourhoods for each robot from one look at the proof to the next."""

TURN_OF_IMPROVEMENT = 0.2
"""How long the improvement goes on between two turns of prioritized planning [s]."""

IsEnough = Callable[[Tick], bool]
"""Tells whether a plan of some value is good enough; it may search for the proof each time."""


def lns(request: PlanRequest) -> Draft:
    """Find a plan or take the one given, and improve it till time is up; options: `LnsOptions`."""
    search = make_fleet_search(request)
    if request.start is not None:
        return _run_improvement(
            request, search, Draft(tracks=request.start, status=Status("given"))
        )
    return improve_best(request, search)


def improve_best(
    request: PlanRequest,
    search: FleetSearch,
    *,
    first: Draft | None = None,
    is_enough: IsEnough | None = None,
) -> Draft:
    """Improve the best of several first plans: the given one, one by LaCAM, one by prioritized.

    It ends as soon as a plan is good enough, which is asked after every few neighbourhoods.
    """
    problem = request.scenario.problem
    drafts: tuple[Draft | None, ...]
    is_simple = problem.resources.are_points and problem.is_open and not problem.has_times
    competes = is_simple and problem.closures is None
    if problem.has_times or not problem.is_open:
        drafts = (first, _try_search(request, search, needed=first is None))
    elif len(problem.itineraries) > MOST_ROBOTS and problem.resources.are_points:
        drafts = (first, _plan_together(request))
    elif (together := _plan_quickly_together(request)) is not None and competes:
        drafts = (first, together)
    else:
        competes = False
        has_plan = first is not None or together is not None
        drafts = (first, together, _plan_in_turn(request, search, has_plan=has_plan))
    plans = [plan for plan in drafts if plan is not None]
    if not plans:
        together = _plan_together(request) if is_simple else plan_whole_fleet(request)
        plans = [together] if together is not None else []
    if not plans:
        is_over = request.deadline.measure_seconds_left() == 0
        raise GaveUp(Fact("time over without a plan" if is_over else "no first plan"))
    best = plans[0]
    if len(plans) > 1:
        best = min(plans, key=lambda plan: request.measure_worth(plan.tracks))
    proof = None if first is None else first.proof
    return _run_improvement(
        request, search, replace(best, proof=proof), is_enough, competes=competes
    )


def _try_search(request: PlanRequest, search: FleetSearch, *, needed: bool) -> Draft | None:
    """Plan robots one after another; where a plan is there already, finding none is no error."""
    try:
        return plan_in_turn(request, search, "shortest")
    except GaveUp:
        if needed:
            raise
        return None


def _plan_together(request: PlanRequest) -> Draft | None:
    """Plan by LaCAM in all the time left, by instants and then without clocks."""
    try:
        draft = plan_fleet(request)
    except GaveUp:
        return None
    request.better(lambda: draft.tracks)
    return replace(draft, status=Status("together"))


def _plan_quickly_together(request: PlanRequest) -> Draft | None:
    """Plan by LaCAM: in an instant, or not at all, as in long narrow lanes."""
    share = SHARE if request.scenario.problem.resources.are_points else SHARE_WITH_SIZES
    hurried = replace(request, deadline=request.deadline.shorten(share))
    draft = plan_by_instants(hurried, effort=EFFORT * len(request.scenario.robots))
    if draft is None:
        return None
    request.better(lambda: draft.tracks)
    return replace(draft, status=Status("together"))


def _plan_in_turn(request: PlanRequest, search: FleetSearch, *, has_plan: bool) -> Draft | None:
    """Plan robots one after another; without a plan, LaCAM needs time for a second attempt."""
    if not has_plan and request.scenario.problem.resources.are_points:
        request = replace(request, deadline=request.deadline.shorten(SHARE_IN_TURN))
    draft = plan_in_turn(request, search, "shortest", has_plan=has_plan)
    if draft is not None:
        request.better(lambda: draft.tracks)
    return draft


def _run_improvement(
    request: PlanRequest,
    search: FleetSearch,
    first: Draft,
    is_enough: IsEnough | None = None,
    *,
    competes: bool = False,
) -> Draft:
    """Improve a plan until time, iterations or gains are used up, or nothing can be better.

    An interrupt ends it too where the request keeps the best plan.
    """
    request.better(lambda: first.tracks)
    search.start(first.tracks)
    rival = Rival(request, search, competes=competes)
    is_open = request.scenario.problem.closures is None
    retiming = RETIMING if is_open else RETIMING_AMONG_CLOSURES
    deadline = request.deadline.bring_forward(retiming * sum(map(len, first.tracks)))
    objective = request.objective
    weights, fastest = request.scenario.problem.weights, search.compute_alone().tolist()
    alone, least_cost = objective.compute_values(weights, fastest)
    bound = alone if first.proof is None else max(alone, first.proof.bound)
    # Plans of one makespan may differ in flowtime.
    goal = (bound, least_cost if objective is Objective.MAKESPAN else None)
    if request.scenario.problem.minimizes_service:
        bound, goal = 0, (-1, None)  # alone robots are no bound of service
    before = search.value, search.cost
    patience = PATIENCE * len(request.scenario.robots)
    iterations = request.options["iterations"] or UNLIMITED
    turn = ITERATIONS_PER_TURN * len(request.scenario.robots) if is_enough else iterations
    done, look, is_interrupted = 0, 0, False
    try:
        rival.begin()
        before = search.value, search.cost
        # A report on progress comes by the clock; it is no look at the proof.
        while done < iterations and not _is_over(search, goal, is_enough if done >= look else None):
            look += turn if done >= look else 0
            began, done_before = time.perf_counter(), done
            reached = search.value, search.cost
            done += search.improve(
                min(look, iterations) - done,
                patience=patience,
                time_limit=deadline.measure_seconds_left(),
                pause=BETWEEN_REPORTS if rival.is_over else TURN_OF_IMPROVEMENT,
            )
            rate = (done - done_before) / (time.perf_counter() - began)
            rival.go_on()
            if (search.value, search.cost) < reached:
                request.better(search.list_tracks)
            request.report(_describe_progress(request, search, bound, rate))
            if search.idle >= patience or deadline.measure_seconds_left() == 0:
                break
    except KeyboardInterrupt:
        if not request.keep_best:
            raise
        is_interrupted = True
    if rival.status is not None:
        first = replace(first, status=rival.status)
    tracks = _take_found(
        request, search, first.tracks, is_better=(search.value, search.cost) < before
    )
    reached = request.measure_worth(tracks)
    status = Status("as fast as alone", status=first.status)
    if reached[1] != least_cost or request.scenario.problem.minimizes_service:
        is_better = reached != before
        status = Status(
            "improved" if is_better else "not improved", neighbourhoods=done, status=first.status
        )
        status = Status("interrupted", status=status) if is_interrupted else status
    saved = request.measure_worth(first.tracks)[0] - reached[0]
    gain = Improvement(saved=Tick(saved), tries=done, interrupted=is_interrupted)
    return Draft(tracks=tracks, status=status, improvement=gain, proof=first.proof)


def _is_over(search: FleetSearch, goal: tuple[int, int | None], is_enough: IsEnough | None) -> bool:
    """Return whether nothing is better, by value and cost where that counts, or it is enough."""
    bound, least_cost = goal
    if search.value == bound and least_cost in {None, search.cost}:
        return True
    return is_enough is not None and is_enough(search.value)


def _describe_progress(request: PlanRequest, search: FleetSearch, bound: int, rate: float) -> Fact:
    """Return the value that the search has reached, its gap, and its attempts per second."""
    objective, cost = request.objective.value, search.value
    work = request.scenario.problem.work
    if work is not None and request.scenario.problem.minimizes_service:  # in other units there
        service = request.measure_worth(search.list_tracks())[0]
        objective, cost = "service", Tick(service // work.late.denominator)
    values = {"objective": objective, "value": cost, "rate": round(rate)}
    if not bound:
        return Fact("value reached", request.scenario, **values)
    return Fact("value and gap reached", request.scenario, **values, gap=cost / bound - 1)


def _take_found(
    request: PlanRequest, search: FleetSearch, first: tuple[Track, ...], *, is_better: bool
) -> tuple[Track, ...]:
    """Return what the search found, with the tracks given wherever these are as good."""
    if not is_better:
        return search.list_tracks() if request.start is None else first
    if request.start is not None:
        search.restore(first)
    return _compute_retimed(request, search)


def _compute_retimed(request: PlanRequest, search: FleetSearch) -> tuple[Track, ...]:
    """Return every visit at the earliest time that keeps the order at each vertex.

    LNS replaces tracks, not waits.
    """
    problem = request.scenario.problem
    if problem.closures is None:
        search.retime()
    if problem.closures is None or problem.has_times:  # the graph does not know times
        return search.list_tracks()
    graph = build_graph_of_plan(request.scenario.problem, search.list_tracks())
    return tuple(graph.build_tracks())
