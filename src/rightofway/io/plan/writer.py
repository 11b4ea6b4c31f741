"""Plans, written: the same plan gives the same bytes, and a file that needs no other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, NoPlanExists
from rightofway.files import write_whole
from rightofway.io.formats import PLAN_FORMAT, PLAN_OF_JOBS_FORMAT
from rightofway.io.json_text import format_json
from rightofway.io.plan.work import dump_tours, dump_unserved
from rightofway.io.scenario.writer import dump_scenario
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.numbers import format_number
from rightofway.model import (
    Decision,
    ForcedLoss,
    Objective,
    Outcome,
    Plan,
    PlannerRun,
    Scenario,
    SteadyState,
)


def dump_plan(plan: Plan, *, seconds: bool = False) -> dict[str, Any]:
    """Return a plan as a document.

    Parameters
    ----------
    plan
        A plan; it need not keep the rules.
    seconds
        Whether to keep the time of planning, which differs between runs.

    Raises
    ------
    InputError
        If a track leads through a vertex that the roadmap does not have.
    """
    scenario = plan.scenario
    n_vertices = scenario.roadmap.n_vertices
    for index, track in enumerate(plan.tracks):
        if not 0 <= track.vertices.min() <= track.vertices.max() < n_vertices:
            message = f"a vertex is not on the roadmap (give 0 to {n_vertices - 1})"
            raise InputError.at(("robots", index, "vertices"), message)
    names = [scenario.roadmap.name(vertex) for vertex in range(n_vertices)]
    document = {
        "format": PLAN_FORMAT if plan.tours is None else PLAN_OF_JOBS_FORMAT,
        "scenario": dump_scenario(scenario),
        "tick": format_number(scenario.problem.clock.tick),
        "planner": _write_planner(plan.run, scenario, seconds=seconds),
        "metrics": _write_metrics(plan),
        "robots": [
            {
                "name": robot.name,
                "vertices": [names[vertex] for vertex in track.vertices.tolist()],
                "enter": track.enter.tolist(),
                **tour,
            }
            for robot, track, tour in zip(
                scenario.robots, plan.tracks, dump_tours(plan), strict=True
            )
        ],
        **dump_unserved(plan),
    }
    if plan.steady:
        document["steady"] = [_write_steady(group, scenario) for group in plan.steady]
    return document


@checks_arguments
def write_plan(plan: Plan, path: Path | str, *, seconds: bool = False) -> None:
    """Write a plan as JSON.

    Parameters
    ----------
    plan, seconds
        As for `dump_plan`.
    path
        The file. It is replaced as a whole: no program reads half of a plan.

    Raises
    ------
    InputError
        As for `dump_plan`, or if the file cannot be written.
    """
    write_whole(path, format_plan(plan, seconds=seconds))


def format_plan(plan: Plan, *, seconds: bool = False) -> str:
    """Return the text of a plan file: the same plan gives the same bytes; see `dump_plan`.

    Parameters
    ----------
    plan
        The plan.
    seconds
        Whether to write the time of planning.
    """
    return format_json(dump_plan(plan, seconds=seconds))


def _write_planner(run: PlannerRun, scenario: Scenario, *, seconds: bool) -> dict[str, Any]:
    return {
        "name": run.name,
        "options": dict(sorted(run.options.items())),
        "seed": run.seed,
        "status": None if run.status is None else run.status.as_dict(),
        "seconds": float(run.seconds) if seconds and run.seconds is not None else None,
        "decisions": [_write_decision(decision, scenario) for decision in run.decisions],
        "reroutes": [
            {"robot": scenario.robots[reroute.robot].name, "because": reroute.because.as_dict()}
            for reroute in run.reroutes
        ],
        **({} if run.start is None else {"start": asdict(run.start)}),
        **({} if run.outcome is None else {"outcome": describe_outcome(run.outcome)}),
        **make_forced_losses(run.forced_losses, scenario),
    }


def make_forced_losses(losses: Sequence[ForcedLoss], scenario: Scenario) -> dict[str, Any]:
    """Return forced losses as plan files and reports for programs have them; none, no key."""
    documents = [
        {
            "robots": [scenario.robots[robot].name for robot in loss.robots],
            "ticks": loss.ticks,
            "vertex": scenario.roadmap.name(loss.vertex),
            **({} if loss.objective is Objective.FLOWTIME else {"objective": loss.objective.value}),
        }
        for loss in losses
    ]
    return {"forced_losses": documents} if documents else {}


def describe_outcome(outcome: Outcome) -> dict[str, Any]:
    """Return an outcome as plan files and reports for programs have it."""
    factor = outcome.factor
    return {
        "kind": str(outcome.kind),
        "objective": str(outcome.objective),
        "bound": outcome.bound,
        **({} if factor is None else {"factor": format_number(factor)}),
    }


def _write_decision(decision: Decision, scenario: Scenario) -> dict[str, Any]:
    vertex, robots = scenario.roadmap.name, scenario.robots
    sums = decision.completion_sums
    return {
        "tick": decision.tick,
        "kind": decision.kind,
        "vertices": [vertex(visited) for visited in decision.vertices],
        "robots": [robots[robot].name for robot in decision.robots],
        "waits": robots[decision.waits].name,
        "waits_at": vertex(decision.waits_at),
        "ticks": decision.ticks,
        "level": decision.level,
        "conflicts_left": list(decision.conflicts_left),
        "completion_sums": None if sums is None else list(sums),
    }


def _write_steady(steady: SteadyState, scenario: Scenario) -> dict[str, Any]:
    names = [robot.name for robot in scenario.robots]
    return {
        "robots": [names[robot] for robot in steady.robots],
        "start": steady.start,
        "period": steady.period,
        "critical": [{"robot": names[robot], "visit": visit} for robot, visit in steady.critical],
    }


def _write_metrics(plan: Plan) -> dict[str, Any]:
    from rightofway.metrics import measure

    try:
        return measure(plan).as_dict()
    except NoPlanExists:  # some place cannot be reached: nothing to compare the plan with
        return {}
