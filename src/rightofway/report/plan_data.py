"""Reports on plans for programs: plain data, times in ticks."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.io.plan.writer import describe_outcome, make_forced_losses
from rightofway.kinds.numbers import format_number
from rightofway.metrics import compute_lost_time, derive_outcome, measure, waits
from rightofway.model import Plan, Scenario
from rightofway.model.outcome import classify_error
from rightofway.report.jobs import make_jobs_data
from rightofway.report.sentences import list_forced_losses


def describe_measures(scenario: Scenario) -> dict[str, Any]:
    """Return the units of the numbers in a report for programs."""
    tick = format_number(scenario.problem.clock.tick)
    return {"tick": tick, "units": scenario.units.to_document()}


def make_summary_data(plan: Plan) -> dict[str, Any]:
    """Return the data of the report on a plan: the planner as in a plan file, times in ticks."""
    metrics, run = measure(plan), plan.run
    gap = metrics.gap
    names, place = [robot.name for robot in plan.scenario.robots], plan.scenario.roadmap.name
    return {
        "planner": {
            "name": run.name,
            "options": dict(run.options),
            "seed": run.seed,
            "status": None if run.status is None else run.status.as_dict(),
            "seconds": _round_seconds(run.seconds),
            "first_plan_seconds": _round_seconds(run.first_plan_seconds),
            **({} if run.start is None else {"start": asdict(run.start)}),
            "outcome": describe_outcome(derive_outcome(plan)),
            **make_forced_losses(list_forced_losses(plan), plan.scenario),
        },
        **describe_measures(plan.scenario),
        "metrics": {**metrics.as_dict(), "gap": None if gap is None else round(gap, 6)},
        "robots": [
            {"name": names[lost.robot], **lost.as_dict(names.__getitem__, place)}
            for lost in compute_lost_time(plan)
        ],
        "waits": [
            {
                "robot": names[wait.robot],
                "vertex": place(wait.vertex),
                "tick": wait.tick,
                "ticks": wait.ticks,
                "for": None if wait.for_robot is None else names[wait.for_robot],
            }
            for wait in waits(plan)
        ],
        "rerouted": [names[reroute.robot] for reroute in run.reroutes],
        **make_jobs_data(plan),
    }


def make_no_plan_data(error: NoPlanExists | GaveUp) -> dict[str, Any]:
    """Return the outcome of a search that found no plan."""
    return describe_outcome(classify_error(error))


def _round_seconds(seconds: float | None) -> float | None:
    return None if seconds is None else round(seconds, 6)
