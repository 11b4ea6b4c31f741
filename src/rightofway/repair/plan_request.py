"""The input and the output of a planner."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.deadline import NO_DEADLINE, Deadline
from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.model import (
    Decision,
    ForcedLoss,
    Improvement,
    Objective,
    Proof,
    Reroute,
    Scenario,
    Status,
    Tick,
    Track,
    compute_cost,
)
from rightofway.model.outcome import choose_objective
from rightofway.model.stays import compute_service
from rightofway.progress import log_progress


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanRequest:
    """A scenario and the means to plan it.

    Attributes
    ----------
    scenario
        The problem.
    options
        Every option of the planner, defaults filled in.
    seed
        For planners that draw at random.
    deadline
        When to stop.
    report
        Takes a fact on progress; English text from planners of other packages.
    has_plan
        Planners that improve a first plan call it as soon as they have one. Only the first call
        counts.
    start
        A plan that keeps the rules, to improve; only for planners that can.
    alone
        The least completion of each robot without the others [ticks], -1 where no way leads to a
        place, where that is known; int64, shape (R,).
    better
        Planners that improve a plan call it with a function that returns the tracks of the best
        plan so far, whenever there may be a better one.
    keep_best
        Whether an interrupt ends the planner with the best plan so far, where there is one.
    objective
        The one that the option ``objective`` asks for; flowtime for planners without that option.
        With jobs, the one of completions that `Work.objective` names; flowtime for ``service``.

    Raises
    ------
    InputError
        If the objective has a makespan, and the roadmap has surcharges.
    """

    scenario: Scenario
    options: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    deadline: Deadline = NO_DEADLINE
    report: Callable[[Fact | str], None] = log_progress
    has_plan: Callable[[], None] = lambda: None
    better: Callable[[Callable[[], Sequence[Track]]], None] = lambda _: None
    start: tuple[Track, ...] | None = None
    alone: NDArray[np.int64] | None = None
    keep_best: bool = False
    objective: Objective = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "objective", self._choose_objective())

    def _choose_objective(self) -> Objective:
        work = self.scenario.problem.work
        name = self.options.get("objective", "flowtime") if work is None else work.objective
        if name in {"flowtime", "service"}:
            return choose_objective(self.scenario)
        if self.scenario.roadmap.has_surcharges:
            message = f"{name} leaves out the surcharges of the roadmap (minimize the flowtime)"
            raise InputError.at(("options", "objective"), message)
        return Objective.MAKESPAN if name == "makespan" else Objective.BOTH

    def measure_worth(self, tracks: Sequence[Track]) -> tuple[Tick, Tick]:
        """Return the value of a plan, and its cost, which decides between plans of equal value."""
        scenario, objective = self.scenario, self.objective
        cost = compute_cost(scenario, tracks)
        if scenario.problem.minimizes_service:
            return compute_service(scenario, tracks), cost
        return objective.compute_cost(scenario, tracks) if objective.has_makespan else cost, cost


@dataclass(frozen=True, slots=True, kw_only=True)
class Draft:
    """The plan of a planner, before the judge has seen it.

    Attributes
    ----------
    tracks
        One for each robot.
    status
        The method that found them; in planners of other packages also an English phrase.
    decisions, reroutes, improvement, forced_losses
        As in `PlannerRun`.
    keeps_swaps
        Whether the plan may hold swaps, as plans of the published method do.
    proof
        A lower bound that the planner has proven; None where it proves nothing beyond the sum of
        the robots alone, which `rightofway.solve` computes.
    """

    tracks: tuple[Track, ...]
    status: Status | str | None = None
    decisions: tuple[Decision, ...] = ()
    reroutes: tuple[Reroute, ...] = ()
    improvement: Improvement | None = None
    keeps_swaps: bool = False
    proof: Proof | None = None
    forced_losses: tuple[ForcedLoss, ...] = ()


Planner = Callable[[PlanRequest], Draft]
"""Turns a request into a draft.

Raises `NoPlanExists` if it is proven that there is no plan, and `GaveUp` if none was found.
"""
