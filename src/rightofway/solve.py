"""From a scenario to a plan that the judge has passed."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from numbers import Integral
from typing import Any

from rightofway.check import check
from rightofway.errors import InputError, InvalidPlan, shown
from rightofway.model import Plan, PlannerRun, Scenario, Track
from rightofway.planners import (
    DEFAULT,
    IMPROVER,
    Deadline,
    Draft,
    PlannerOptions,
    PlannerSpec,
    Task,
    find,
    registered,
)

__all__ = ["improve", "solve"]

LARGEST_SEED = 2**32 - 1
"""Planners draw from this many streams."""


def solve(
    scenario: Scenario,
    planner: str = DEFAULT,
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    options: PlannerOptions | Mapping[str, Any] | None = None,
    report: Callable[[str], None] | None = None,
    **named: Any,
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
        For planners that draw at random, from 0 to 2**32 - 1. The same input and seed give the
        same plan.
    options
        Options of the planner: its own dataclass, like ``LnsOptions(iterations=100)``, or names
        with values.
    report
        Takes sentences on the progress.
    named
        Options one by one, like ``iterations=100``, instead of ``options``.

    Returns
    -------
    Plan
        Passed by `rightofway.check`; only where ``swaps=leave`` was asked for it may hold swaps.

    Raises
    ------
    InputError
        For an unknown planner or option, or a value that does not fit.
    NoPlanExists
        If it is proven that there is no plan.
    GaveUp
        If none was found in time, or by the means of the planner.
    """
    if not isinstance(scenario, Scenario):
        remedy = "load a file with rightofway.load, or build a fleet with FleetBuilder"
        raise InputError.at("scenario", f"{shown(scenario)} is no scenario ({remedy})")
    spec = find(planner)
    given = _given(
        spec, time_limit=time_limit, seed=seed, options=options, named=named, report=report
    )
    return _run(spec, scenario, given)


def improve(
    plan: Plan,
    planner: str = IMPROVER,
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    options: PlannerOptions | Mapping[str, Any] | None = None,
    report: Callable[[str], None] | None = None,
    **named: Any,
) -> Plan:
    """Make a plan better, also one of another program, and have the result judged.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    planner
        Name of a planner that can start from a plan.
    time_limit, seed, options, report, named
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
    if not isinstance(plan, Plan):
        message = f"{shown(plan)} is no plan (load a file with rightofway.load_plan)"
        raise InputError.at("plan", message)
    judged, spec = check(plan), find(planner)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be improved)")
    if not spec.improves:
        able = " or ".join(one.name for one in registered().values() if one.improves)
        raise InputError.at("planner", f"{spec.name} cannot start from a plan (choose {able})")
    given = _given(
        spec, time_limit=time_limit, seed=seed, options=options, named=named, report=report
    )
    return _run(spec, plan.scenario, given, start=plan.tracks)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Given:
    """What the caller says besides the problem."""

    time_limit: float | None
    seed: int
    options: dict[str, str | int]
    report: Callable[[str], None] | None


def _given(
    spec: PlannerSpec,
    *,
    time_limit: float | None,
    seed: int,
    options: PlannerOptions | Mapping[str, Any] | None,
    named: dict[str, Any],
    report: Callable[[str], None] | None,
) -> _Given:
    """Check what the caller says besides the problem."""
    if not isinstance(seed, Integral) or not 0 <= seed <= LARGEST_SEED:
        remedy = f"give a whole number from 0 to {LARGEST_SEED}"
        raise InputError.at("seed", f"{shown(seed)} is no seed ({remedy})")
    if options is not None and named:
        message = f"are given twice, with {', '.join(named)} beside (give one of both)"
        raise InputError.at("options", message)
    settled = spec.settle(named if options is None else options)
    return _Given(time_limit=time_limit, seed=int(seed), options=settled, report=report)


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
    clock = _Clock()
    task = Task(
        scenario=scenario,
        options=given.options,
        seed=given.seed,
        deadline=Deadline.after(given.time_limit),
        report=given.report or (lambda _: None),
        has_plan=clock.keep,
        start=start,
    )
    if start is not None:
        clock.keep()
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
    )
    plan = Plan(scenario=task.scenario, tracks=draft.tracks, run=run)
    _refuse_faults(plan, draft)
    return plan


def _refuse_faults(plan: Plan, draft: Draft) -> None:
    report = check(plan)
    bad = [kind for kind in report.counts if kind != "swap conflict" or not draft.keeps_swaps]
    if bad:
        raise InvalidPlan(f"{plan.run.name} made a plan with {report}")
