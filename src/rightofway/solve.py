"""From a scenario to a plan that the judge has passed."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from rightofway.check import check
from rightofway.errors import InvalidPlan
from rightofway.model import Plan, PlannerRun, Scenario
from rightofway.planners import Deadline, Draft, Task, find

__all__ = ["solve"]


def solve(
    scenario: Scenario,
    planner: str = "auto",
    time_limit: float | None = 10,
    seed: int = 0,
    *,
    options: Mapping[str, Any] | None = None,
    report: Callable[[str], None] | None = None,
) -> Plan:
    """Plan a fleet and have the plan judged.

    Parameters
    ----------
    scenario
        The problem.
    planner
        Name of a planner; ``auto`` chooses.
    time_limit
        When to stop [s]; None for no limit.
    seed
        For planners that draw at random. The same input and seed give the same plan.
    options
        What the planner is told; see its page.
    report
        Takes sentences on the progress.

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
    spec = find(planner)
    settled = spec.settle(options or {})
    began = time.perf_counter()
    task = Task(
        scenario=scenario,
        options=settled,
        seed=seed,
        deadline=Deadline.after(time_limit),
        report=report or (lambda _: None),
    )
    draft = spec.load()(task)
    run = PlannerRun(
        name=spec.name,
        options=settled,
        seed=seed,
        status=draft.status,
        seconds=time.perf_counter() - began,
        decisions=draft.decisions,
        reroutes=draft.reroutes,
    )
    plan = Plan(scenario=scenario, tracks=draft.tracks, run=run)
    _refuse_faults(plan, draft)
    return plan


def _refuse_faults(plan: Plan, draft: Draft) -> None:
    report = check(plan)
    bad = [kind for kind in report.counts if kind != "swap conflict" or not draft.keeps_swaps]
    if bad:
        raise InvalidPlan(f"{plan.run.name} made a plan with {report}")
