"""Neighbourhoods of plans of small fleets with jobs, and the arguments of their native search."""

from __future__ import annotations

from typing import Any

from rightofway.assign import AssignmentSearch, measure_travel
from rightofway.io import parse_scenario
from rightofway.plan_work.neighbourhoods import Neighbourhoods
from rightofway.search import Distances
from rightofway.solve import solve
from tests.builders.work_scenarios import draw_work_document


def make_neighbourhoods(seed: int, *, n_robots: int, n_jobs: int) -> Neighbourhoods:
    """Return the neighbourhoods of a plan of jobs that are drawn."""
    scenario = parse_scenario(draw_work_document(seed, n_robots=n_robots, n_jobs=n_jobs))
    work = scenario.problem.work
    assert work is not None, "the scenario has jobs"
    travel = measure_travel(scenario.problem, Distances(scenario.roadmap))
    search = AssignmentSearch(work, travel, weights=scenario.problem.weights)
    return Neighbourhoods(solve(scenario, "prioritized"), search, travel, 0)


def make_arguments(near: Neighbourhoods) -> dict[str, Any]:
    """Return the arguments of the native search of neighbourhoods."""
    work = near.plan.scenario.problem.work
    assert work is not None, "the plan has jobs"
    return near.make_arguments(work)
