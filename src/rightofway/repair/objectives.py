"""The objective of a planner, and how it compares plans by it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rightofway.errors import InputError
from rightofway.model import Objective, Scenario, Tick, Track, compute_cost
from rightofway.model.outcome import choose_objective
from rightofway.repair.task import Task


def find_objective(task: Task) -> Objective:
    """Return the value of the option ``objective``; flowtime for planners without that option.

    Raises
    ------
    InputError
        If it has a makespan, and the roadmap has surcharges.
    """
    name = task.options.get("objective", "flowtime")
    if name == "flowtime":
        return choose_objective(task.scenario)
    if task.scenario.roadmap.has_surcharges:
        message = f"{name} leaves out the surcharges of the roadmap (minimize the flowtime)"
        raise InputError.at(("options", "objective"), message)
    return Objective.MAKESPAN if name == "makespan" else Objective.BOTH


def measure_worth(task: Task, tracks: Sequence[Track]) -> tuple[Tick, Tick]:
    """Return the value of a plan, and its cost, which decides between plans of equal value."""
    cost = compute_cost(task.scenario, tracks)
    objective = find_objective(task)
    return objective.compute_cost(task.scenario, tracks) if objective.has_makespan else cost, cost


def compute_value(
    objective: Objective, weights: Sequence[int], completions: Sequence[int]
) -> tuple[int, int]:
    """Return the value and the cost of some robots by their completions, without surcharges."""
    latest, cost = max(completions), int(np.dot(weights, completions))
    match objective:
        case Objective.MAKESPAN:
            return latest, cost
        case Objective.BOTH:
            return sum(weights) * latest + cost, cost
    return cost, cost


def list_weights(scenario: Scenario) -> list[int]:
    """Return the weight of each robot."""
    return [itinerary.weight for itinerary in scenario.problem.itineraries]
