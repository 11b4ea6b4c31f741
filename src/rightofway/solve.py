"""From a scenario to a plan that the judge has passed."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from rightofway.check import Report, check
from rightofway.deadline import Deadline, limit_work
from rightofway.errors import GaveUp, InputError, InvalidPlan, NoPlanExists
from rightofway.facts import Fact
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.numbers import format_number
from rightofway.kinds.table import SEED, make_range
from rightofway.metrics import derive_outcome
from rightofway.model import (
    Objective,
    Outcome,
    OutcomeKind,
    Plan,
    PlannerRun,
    Proof,
    Scenario,
    Status,
    Tick,
    Track,
    require_time_limit,
)
from rightofway.model.outcome import classify_cost
from rightofway.model.passing import wait_before_chains
from rightofway.model.scenario import assign_tours
from rightofway.model.work import Assignment, UnservedReason
from rightofway.planners import (
    DEFAULT_PLANNER,
    IMPROVER,
    Draft,
    Feature,
    PlannerOptions,
    PlannerSpec,
    PlanRequest,
    find,
)
from rightofway.planners.features import refuse_unknown
from rightofway.planners.registry import name_able
from rightofway.progress import log_progress

__all__ = ["improve", "solve"]

OF_BATTERIES = frozenset({"low battery", "stranded"})
"""Faults of plans whose tours need more than a battery holds; planners do not look for them."""

JUDGING = 0.4e-6
"""The time to judge a plan, for each visit that it has at least [s]."""


@checks_arguments
def solve(
    scenario: Scenario,
    planner: str = DEFAULT_PLANNER,
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    start: Plan | None = None,
    options: PlannerOptions | Mapping[str, Any] | None = None,
    report: Callable[[Fact | str], None] | None = None,
    on_plan: Callable[[Plan], None] | None = None,
    keep_best: bool = False,
    seconds_per_visit: float = JUDGING,
    **named: Any,
) -> Plan:
    """Plan a fleet and judge the plan.

    Parameters
    ----------
    scenario
        The problem.
    planner
        Name of a planner.
    time_limit
        When to stop [s]; None for no limit.
    seed
        For planners that draw at random, from 0 to 2**32 - 1. The same input and seed give the
        same plan.
    start
        A plan of this scenario before it was changed: routes and rights of way are kept if
        possible, and only the other robots are planned again before the planner continues.
        ``run.start`` of the new plan has the numbers of kept routes and tracks. If the scenario has
        not changed, the new plan is at least as good.
    options
        Options of the planner: its own dataclass, like ``LnsOptions(iterations=100)``, or names
        with values.
    report
        Takes facts on the progress; ``str`` of one is an English sentence. By default they go to
        the logger ``rightofway``.
    on_plan
        Takes each better plan during the search. The judge has not seen it.
    keep_best
        Whether Ctrl-C returns the best plan so far, where there is one. By default
        `KeyboardInterrupt` is raised.
    seconds_per_visit
        The time to leave, for each visit of the plan, to judge it and to use it [s]: planning ends
        earlier by this time, but takes at least half of the time limit.
    named
        Options one by one, like ``iterations=100``, instead of ``options``.

    Returns
    -------
    Plan
        Passed by `rightofway.check`. Only a plan of the published method may hold swaps: one of
        ``paper``, or of ``auto`` or ``two-level`` with ``swaps="leave"``.

    Raises
    ------
    InputError
        For an unknown planner or option, a value that does not fit, or a start for a planner that
        cannot start from a plan, or for a scenario with jobs.
    NoPlanExists
        If it is proven that there is no plan.
    GaveUp
        If none was found in time, or by the means of the planner.
    """
    spec, limit = find(planner), require_time_limit(time_limit)
    if start is not None:
        _refuse_start(spec)
        if scenario.jobs is not None:
            remedy = "leave it out; `improve` keeps the tours of a plan"
            raise InputError.at("start", f"is not for a scenario with jobs ({remedy})")
    settled = _settle_options(spec, options, named, seed)
    request = PlanRequest(
        scenario=scenario, **settled, report=report or log_progress, keep_best=keep_best
    )
    if scenario.jobs is not None and scenario.tours is None:
        return _run_rounds(spec, request, limit, seconds_per_visit, on_plan)
    return _run(spec, request, limit, seconds_per_visit, on_plan, old=start)[0]


@checks_arguments
def improve(
    plan: Plan,
    planner: str = IMPROVER,
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    options: PlannerOptions | Mapping[str, Any] | None = None,
    report: Callable[[Fact | str], None] | None = None,
    on_plan: Callable[[Plan], None] | None = None,
    keep_best: bool = False,
    seconds_per_visit: float = JUDGING,
    **named: Any,
) -> Plan:
    """Improve a plan, also one of another program, and judge the result.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    planner
        Name of a planner that can start from a plan.
    time_limit, seed, options, report, on_plan, keep_best, seconds_per_visit, named
        As for `solve`.

    Returns
    -------
    Plan
        Passed by `rightofway.check`, and of no larger flowtime. A plan with jobs keeps its tours.

    Raises
    ------
    InputError
        If the plan has faults, for a planner that cannot start from one, or an unknown option.
    """
    spec = find(planner)
    _refuse_start(spec)
    limit, judged = require_time_limit(time_limit), check(plan)
    if not judged.ok:
        start = "`rightofway plan SCENARIO --start PLAN`, in Python solve(scenario, start=plan)"
        remedy = f"repair it: {start}, keeps its routes where it can"
        message = f"the plan has {judged.summary}; improving starts from a plan without faults"
        raise InputError.at("", f"{message} ({remedy})")
    settled = _settle_options(spec, options, named, seed)
    request = PlanRequest(
        scenario=plan.scenario, **settled, report=report or log_progress, keep_best=keep_best
    )
    request = replace(request, start=plan.tracks)
    improved, judged = _run(
        spec, request, limit, seconds_per_visit, on_plan, unserved=plan.unserved
    )
    return plan if OF_BATTERIES.intersection(judged.counts) else improved


def _refuse_start(spec: PlannerSpec) -> None:
    """Refuse planners that cannot start from a plan."""
    if Feature.IMPROVES not in spec.features:
        message = f"{spec.name} cannot start from a plan (choose {name_able(Feature.IMPROVES)})"
        raise InputError.at("planner", message)


def _settle_options(
    spec: PlannerSpec,
    options: PlannerOptions | Mapping[str, Any] | None,
    named: dict[str, Any],
    seed: int,
) -> dict[str, Any]:
    """Return the options and the seed of a request, checked."""
    if options is not None and named:
        message = f"are given twice, with {', '.join(named)} beside (give one of both)"
        raise InputError.at("options", message)
    settled = spec.settle(named if options is None else options)
    return {"options": settled, "seed": SEED.read_at("seed", seed)}


def _run_rounds(
    spec: PlannerSpec,
    request: PlanRequest,
    time_limit: float | None,
    seconds_per_visit: float,
    on_plan: Callable[[Plan], None] | None,
) -> Plan:
    """Assign the jobs of a scenario, plan the tours, and keep the best plan."""
    from rightofway.plan_work import plan_work  # loads the native core

    _refuse_unknown(spec, request)

    def plan_tours(
        assignment: Assignment, deadline: Deadline, seed: int, offer: Callable[[Plan], None] | None
    ) -> tuple[Plan, Report]:
        toured = replace(
            request, scenario=assign_tours(request.scenario, assignment.tours), seed=seed
        )
        limit = deadline.measure_seconds_left()
        return _run(spec, toured, limit, seconds_per_visit, offer, unserved=assignment.unserved)

    began = time.perf_counter()
    plan = plan_work(
        request.scenario,
        plan_tours,
        deadline=Deadline.after(time_limit),
        seed=request.seed,
        better=on_plan or (lambda _: None),
        report=request.report,
    )
    return replace(plan, run=replace(plan.run, seconds=time.perf_counter() - began))


def _refuse_unknown(spec: PlannerSpec, request: PlanRequest) -> None:
    """Refuse a scenario that needs more than a planner can."""
    refuse_unknown(
        request.scenario.problem,
        spec.features,
        f"planner {spec.name}",
        lambda needed: f"choose {name_able(needed)}",
    )


def _run(
    spec: PlannerSpec,
    request: PlanRequest,
    time_limit: float | None,
    seconds_per_visit: float,
    on_plan: Callable[[Plan], None] | None,
    *,
    old: Plan | None = None,
    unserved: Sequence[tuple[int, UnservedReason]] = (),
) -> tuple[Plan, Report]:
    """Plan and judge; ``old`` is a plan of the scenario before it was changed.

    Only a plan with tours may come back with faults: planners know no batteries.
    """
    # These load the native core: not for help.
    from rightofway.repair.impossible import refuse_stranded
    from rightofway.resume.warm_start import compare_with_start
    from rightofway.search import compute_least_completions

    seconds_per_visit = make_range(0, 3600).read_at("seconds_per_visit", seconds_per_visit)
    _refuse_unknown(spec, request)
    request.report(Fact("planning begins", planner=spec.name, robots=len(request.scenario.robots)))
    began, deadline = time.perf_counter(), Deadline.after(time_limit)
    with_plan: list[float] = []  # how long planning took until there was a plan [s]

    def keep() -> None:
        with_plan.append(time.perf_counter() - began)

    with limit_work(deadline):
        alone = compute_least_completions(
            request.scenario, time_limit=deadline.measure_seconds_left()
        )
        if alone is None:
            raise GaveUp(Fact("time over", doing=Fact("measuring distances")))
        refuse_stranded(request.scenario, np.flatnonzero(alone < 0).tolist())
        least_visits = _estimate_visits(request.scenario, alone.tolist())
        request = replace(
            request,
            alone=alone,
            deadline=deadline.bring_forward(seconds_per_visit * least_visits),
            has_plan=keep,
        )
        if on_plan is not None:
            request = replace(request, better=_make_hand_over(on_plan, spec, request, unserved))
        if request.start is not None:
            keep()
        try:
            draft = _make_draft(spec, request, old)
        except GaveUp as error:
            error.lower_bound = max(int(alone.sum()), error.lower_bound or 0)
            raise
    keep()
    start = None if old is None else compare_with_start(old, request.scenario, draft.tracks)
    run = PlannerRun(
        name=spec.name,
        options=_format_options(request),
        seed=request.seed,
        status=None if draft.status is None else Status.of(draft.status),
        seconds=with_plan[-1],
        first_plan_seconds=with_plan[0],
        decisions=draft.decisions,
        reroutes=draft.reroutes,
        improvement=draft.improvement,
        forced_losses=draft.forced_losses,
        start=start,
        alone=tuple(alone.tolist()),
    )
    plan = _make_plan(request, draft.tracks, run, unserved)
    report = check(plan)
    may_have = {"swap conflict"} if draft.keeps_swaps else OF_BATTERIES
    if not may_have.issuperset(report.counts):
        raise InvalidPlan(f"{spec.name} made a plan with {report}")
    outcome = _classify_outcome(spec, request, draft, plan, keeps_rules=report.ok)
    values = {"objective": outcome.objective.value, "value": plan.compute_value(outcome.objective)}
    request.report(Fact("plan judged", request.scenario, **values, seconds=round(with_plan[-1], 2)))
    return replace(plan, run=replace(run, outcome=outcome)), report


def _make_plan(
    request: PlanRequest,
    tracks: Sequence[Track],
    run: PlannerRun,
    unserved: Sequence[tuple[int, UnservedReason]] = (),
) -> Plan:
    """Return the plan of a planner's tracks: robots wait before chains, not on them."""
    driven = wait_before_chains(request.scenario.problem, tracks)
    return Plan(scenario=request.scenario, tracks=driven, run=run, unserved=tuple(unserved))


def _classify_outcome(
    spec: PlannerSpec, request: PlanRequest, draft: Draft, plan: Plan, *, keeps_rules: bool
) -> Outcome:
    """Return the proof of a plan: by its planner, and by the robots alone."""
    if plan.scenario.jobs is not None:
        return derive_outcome(plan)  # other tours may be better, whatever is proven of these
    alone, objective = plan.lower_bound, request.objective
    if objective.has_makespan:
        weights = plan.scenario.problem.weights
        alone = Tick(objective.compute_values(weights, plan.run.alone or ())[0])
    else:
        objective = Objective.FLOWTIME
    proof = draft.proof or Proof(bound=alone, objective=objective)
    proof = replace(proof, bound=max(proof.bound, alone))
    cost = plan.compute_value(proof.objective)
    if not keeps_rules:  # its swaps may save time, so it proves nothing
        return Outcome(kind=OutcomeKind.BEST_FOUND, objective=proof.objective, bound=proof.bound)
    if cost < proof.bound:
        claimed = f"claims that no {proof.objective} is below {proof.bound} ticks"
        raise InvalidPlan(f"{spec.name} {claimed}, but its plan has {cost}")
    return classify_cost(cost, proof)


def _format_options(request: PlanRequest) -> dict[str, Any]:
    """Return the options as files keep them: an exact number as a whole number or text."""
    return {
        name: format_number(value) if isinstance(value, Fraction) else value
        for name, value in request.options.items()
    }


def _make_draft(spec: PlannerSpec, request: PlanRequest, old: Plan | None) -> Draft:
    """Return the draft of a planner, with proofs that hold for all directions of stops."""
    has_others = request.scenario.problem.has_other_directions
    try:
        draft = _plan_or_adapt(spec, request, old)
    except NoPlanExists as error:
        if not has_others:
            raise
        reason = Fact("no plan in directions", request.scenario, why=error.explain())
        raise GaveUp(reason) from error
    return replace(draft, status=None, proof=None, forced_losses=()) if has_others else draft


def _plan_or_adapt(spec: PlannerSpec, request: PlanRequest, old: Plan | None) -> Draft:
    """Return the draft of a planner, from an old plan where there is one that helps."""
    # Both load the native core: not for help.
    from rightofway.repair.impossible import refuse_closed_ways
    from rightofway.resume.warm_start import make_first_plan

    tracks = None if old is None else make_first_plan(request, old)
    if tracks is None:
        if old is not None:
            request.report(Fact("planning from nothing"))
        refuse_closed_ways(request.scenario, request.deadline)
        return spec.load()(request)
    request.has_plan()
    request.better(lambda: tracks)
    try:
        return spec.load()(replace(request, start=tracks))
    except GaveUp:
        return Draft(tracks=tracks, status=Status("adapted"))


def _make_hand_over(
    on_plan: Callable[[Plan], None],
    spec: PlannerSpec,
    request: PlanRequest,
    unserved: Sequence[tuple[int, UnservedReason]],
) -> Callable[[Callable[[], Sequence[Track]]], None]:
    """Return a function that hands plans of a planner that goes on to the caller of `solve`.

    A planner that tries several methods calls it with the plan of each; only better ones go on.
    """
    assert request.alone is not None, "it is measured before planning"
    alone = tuple(request.alone.tolist())
    run = PlannerRun(
        name=spec.name,
        options=_format_options(request),
        seed=request.seed,
        status=Status("so far"),
        alone=alone,
    )
    least: list[tuple[Tick, Tick]] = []

    def hand_over(tracks: Callable[[], Sequence[Track]]) -> None:
        plan = _make_plan(request, tracks(), run, unserved)
        rating = request.measure_worth(plan.tracks)
        if not least or rating < least[-1]:
            least.append(rating)
            on_plan(plan)

    return hand_over


def _estimate_visits(scenario: Scenario, alone: Sequence[int]) -> int:
    """Return about how many visits the shortest routes of a fleet have."""
    visits = 0
    for itinerary, ticks in zip(scenario.problem.itineraries, alone, strict=True):
        dwell = sum(stage.work + stage.turn for stage in itinerary.stages)
        visits += max(ticks - dwell, 0) // itinerary.quickest_edge
    return visits
