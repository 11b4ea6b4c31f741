"""From a scenario to a plan that the judge has passed."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.check import check
from rightofway.errors import InputError, InvalidPlan, kernel_limits
from rightofway.model import Plan, PlannerRun, Scenario, Track, checked_time_limit
from rightofway.planners import (
    DEFAULT,
    IMPROVER,
    Deadline,
    Draft,
    PlannerSpec,
    Task,
    find,
    registered,
)

__all__ = ["improve", "solve"]

JUDGING = 0.3e-6
"""The time to judge a plan, for each visit that it has at least [s]."""


def solve(
    scenario: Scenario,
    planner: str = DEFAULT,
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    options: Mapping[str, Any] | None = None,
    report: Callable[[str], None] | None = None,
    keep_best: bool = False,
    seconds_per_visit: float = JUDGING,
) -> Plan:
    """Plan a fleet and have the plan judged.

    Parameters
    ----------
    scenario
        The problem.
    planner
        Name of a planner.
    time_limit
        When to stop [s]; None for no limit.
    seed
        For planners that draw at random. The same input and seed give the same plan.
    options
        What the planner is told; see its page.
    report
        Takes sentences on the progress.
    keep_best
        Whether Ctrl-C returns the best plan so far, where there is one. By default
        `KeyboardInterrupt` is raised.
    seconds_per_visit
        The time to leave, for each visit of the plan, to judge it and to use it [s]: planning ends
        so much before the time limit, but takes at least half of it.

    Returns
    -------
    Plan
        Passed by `rightofway.check`; only where ``swaps=leave`` was asked for it may hold swaps.

    Raises
    ------
    InputError
        For an unknown planner or option.
    NoPlanExists
        If it is proven that there is no plan.
    GaveUp
        If none was found in time, or by the means of the planner.
    """
    limit, spec = checked_time_limit(time_limit), find(planner)
    given = _Given(
        time_limit=limit,
        seed=seed,
        options=options,
        report=report,
        keep_best=keep_best,
        seconds_per_visit=seconds_per_visit,
    )
    return _run(spec, scenario, given)


def improve(
    plan: Plan,
    planner: str = IMPROVER,
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    options: Mapping[str, Any] | None = None,
    report: Callable[[str], None] | None = None,
    keep_best: bool = False,
    seconds_per_visit: float = JUDGING,
) -> Plan:
    """Make a plan better, whoever made it, and have the result judged.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    planner
        Name of a planner that can start from a plan.
    time_limit, seed, options, report, keep_best, seconds_per_visit
        As for `solve`.

    Returns
    -------
    Plan
        Passed by `rightofway.check`, and of no larger flowtime.

    Raises
    ------
    InputError
        If the plan has faults, for a planner that cannot start from one, or an unknown option.
    """
    limit = checked_time_limit(time_limit)
    judged, spec = check(plan), find(planner)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be improved)")
    if not spec.improves:
        able = " or ".join(one.name for one in registered().values() if one.improves)
        raise InputError.at("planner", f"{spec.name} cannot start from a plan (choose {able})")
    given = _Given(
        time_limit=limit,
        seed=seed,
        options=options,
        report=report,
        keep_best=keep_best,
        seconds_per_visit=seconds_per_visit,
    )
    return _run(spec, plan.scenario, given, start=plan.tracks)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Given:
    """What the caller says besides the problem."""

    time_limit: float | None
    seed: int
    options: Mapping[str, Any] | None
    report: Callable[[str], None] | None
    keep_best: bool
    seconds_per_visit: float


class _Clock:
    """How long planning takes, and when the first plan was there [s]."""

    def __init__(self) -> None:
        self._began = time.perf_counter()
        self.kept: float | None = None

    def seconds(self) -> float:
        return time.perf_counter() - self._began

    def keep(self) -> None:
        """Keep the time; only the first call counts."""
        if self.kept is None:
            self.kept = self.seconds()


def _run(
    spec: PlannerSpec, scenario: Scenario, given: _Given, start: tuple[Track, ...] | None = None
) -> Plan:
    clock, deadline = _Clock(), Deadline.after(given.time_limit)
    options = spec.settle(given.options or {})
    with kernel_limits():
        alone = _alone(scenario)
    task = Task(
        scenario=scenario,
        options=options,
        seed=given.seed,
        deadline=deadline.earlier(given.seconds_per_visit * _least_visits(scenario, alone)),
        report=given.report or (lambda _: None),
        has_plan=clock.keep,
        keep_best=given.keep_best,
        start=start,
    )
    if start is not None:
        clock.keep()
    with kernel_limits():
        draft = spec.load()(task)
    clock.keep()
    run = PlannerRun(
        name=spec.name,
        options=task.options,
        seed=task.seed,
        status=draft.status,
        seconds=clock.seconds(),
        first_plan_seconds=clock.kept,
        decisions=draft.decisions,
        reroutes=draft.reroutes,
        alone=tuple(alone.tolist()),
    )
    plan = Plan(scenario=task.scenario, tracks=draft.tracks, run=run)
    _refuse_faults(plan, draft)
    return plan


def _alone(scenario: Scenario) -> NDArray[np.int64]:
    from rightofway.search import alone_completions  # loads the native core, which help needs not

    return alone_completions(scenario)


def _least_visits(scenario: Scenario, alone: NDArray[np.int64]) -> int:
    """Return about how many visits the shortest routes of a fleet have."""
    visits = 0
    for itinerary, ticks in zip(scenario.problem.itineraries, alone.tolist(), strict=True):
        dwell = sum(stage.work + stage.turn for stage in itinerary.stages)
        visits += max(ticks - dwell, 0) // min(itinerary.edge_ticks, default=1)
    return visits


def _refuse_faults(plan: Plan, draft: Draft) -> None:
    report = check(plan)
    bad = [kind for kind in report.counts if kind != "swap conflict" or not draft.keeps_swaps]
    if bad:
        raise InvalidPlan(f"{plan.run.name} made a plan with {report}")
