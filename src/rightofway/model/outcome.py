"""The proof of a planner about its answer: the kind, the objective and a lower bound."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

import numpy as np

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import require_one_for_each
from rightofway.model.route import Track
from rightofway.model.scenario import Scenario
from rightofway.model.stays import compute_completions, compute_cost, compute_costs
from rightofway.model.units import Tick
from rightofway.site import VertexId


class Objective(StrEnum):
    """The quantity that a planner minimizes, or proves a bound of [ticks].

    Attributes
    ----------
    FLOWTIME
        The sum of the completion times.
    COST
        The flowtime and the surcharges of all edges driven.
    WEIGHTED
        The flowtime and surcharges, with the ticks of each robot multiplied by its weight: whole
        numbers in the ratio of the weights of robots.
    MAKESPAN
        The latest completion time.
    BOTH
        The makespan and the completion time of each robot, by weights, summed over the robots: the
        makespan times the total weight, plus the weighted sum of completion times.
    SERVICE
        With jobs: service times and lateness by weights of jobs, in ticks times weights, of which
        the denominator of `Work.late` are one.
    """

    FLOWTIME = "flowtime"
    COST = "flowtime and surcharges"
    WEIGHTED = "weighted flowtime"
    MAKESPAN = "makespan"
    BOTH = "makespan and flowtime"
    SERVICE = "service"

    @checks_arguments
    def compute_cost(self, scenario: Scenario, tracks: Sequence[Track]) -> Tick:
        """Return the value of a plan [ticks].

        Parameters
        ----------
        scenario
            The problem.
        tracks
            One track for each robot.
        """
        require_one_for_each(scenario.robots, tracks=tracks)
        if self is Objective.WEIGHTED:
            return compute_cost(scenario, tracks)
        if self is Objective.COST:
            return Tick(sum(compute_costs(scenario, tracks)))
        completions = compute_completions(scenario, tracks)
        if self is Objective.FLOWTIME:
            return Tick(sum(completions))
        latest = max(completions)
        if self is Objective.MAKESPAN:
            return latest
        both = zip(scenario.problem.weights, completions, strict=True)
        return Tick(sum(weight * (latest + completion) for weight, completion in both))

    def compute_values(self, weights: Sequence[int], completions: Sequence[int]) -> tuple[int, int]:
        """Return the value and the cost of some robots by their completions, without surcharges."""
        latest, cost = max(completions), int(np.dot(weights, completions))
        match self:
            case Objective.MAKESPAN:
                return latest, cost
            case Objective.BOTH:
                return sum(weights) * latest + cost, cost
        return cost, cost

    @property
    def has_makespan(self) -> bool:
        """Whether a later makespan makes it worse."""
        return self in {Objective.MAKESPAN, Objective.BOTH}


def choose_objective(scenario: Scenario) -> Objective:
    """Return the objective of the planners of this package for a scenario."""
    if any(itinerary.weight != 1 for itinerary in scenario.problem.itineraries):
        return Objective.WEIGHTED
    return Objective.COST if scenario.roadmap.has_surcharges else Objective.FLOWTIME


class OutcomeKind(StrEnum):
    """How a search ended.

    Attributes
    ----------
    OPTIMAL
        No plan has a smaller objective.
    BOUNDED
        The plan is at most a factor above the least objective.
    BEST_FOUND
        The best plan that was found; its distance from the optimum is bounded only by the lower
        bound.
    NO_PLAN_EXISTS
        It is proven that there is no plan.
    GAVE_UP
        No plan was found; one may exist.
    """

    OPTIMAL = "optimal"
    BOUNDED = "bounded"
    BEST_FOUND = "best found"
    NO_PLAN_EXISTS = "no plan exists"
    GAVE_UP = "gave up"


@dataclass(frozen=True, slots=True, kw_only=True)
class Proof:
    """A lower bound that a planner has proven.

    Attributes
    ----------
    bound
        No plan has a smaller objective [ticks].
    objective
        The objective of the bound.
    factor
        The factor above the least objective that the planner claims for its plan, 1 or more; None
        where it claims none.
    """

    bound: Tick
    objective: Objective = Objective.FLOWTIME
    factor: Fraction | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How a search ended, and its proof.

    Attributes
    ----------
    kind
        Optimal, bounded by a factor, best found, no plan exists, or gave up.
    objective
        The objective of the bound and the factor.
    bound
        No plan has a smaller objective [ticks]; None where none is known.
    factor
        For a bounded plan the factor above the least objective that it keeps; else None.
    """

    kind: OutcomeKind
    objective: Objective = Objective.FLOWTIME
    bound: Tick | None = None
    factor: Fraction | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ForcedLoss:
    """Robots that cannot all be as early as alone, or earlier than a tick in any plan.

    Attributes
    ----------
    robots
        By index, the smaller first: two or more, of the makespan also one.
    ticks
        Their least losses together in every plan, of time and of surcharges; of the weighted
        flowtime as often as their weights say. Of the makespan, before which tick not all of them
        can have completed [ticks].
    vertex
        Where the first two of them that meet would meet, each on its best track alone; of one
        robot, its last stop.
    objective
        The quantity that is lost: `FLOWTIME`, `COST`, `WEIGHTED` or `MAKESPAN`.
    """

    robots: tuple[int, ...]
    ticks: Tick
    vertex: VertexId
    objective: Objective = Objective.FLOWTIME


def classify_cost(cost: Tick, proof: Proof) -> Outcome:
    """Return the outcome of a search that found a plan.

    Notes
    -----
    The plan is optimal where the cost is the bound, and bounded where the planner claims a factor
    and the bound proves it: cost <= factor * bound. Else it is the best plan found.
    """
    kind, factor = OutcomeKind.BEST_FOUND, None
    if cost == proof.bound:
        kind = OutcomeKind.OPTIMAL
    elif proof.factor is not None and cost <= proof.factor * proof.bound:
        kind, factor = OutcomeKind.BOUNDED, proof.factor
    return Outcome(kind=kind, objective=proof.objective, bound=proof.bound, factor=factor)


def classify_error(error: NoPlanExists | GaveUp) -> Outcome:
    """Return the outcome of a search that found no plan."""
    if isinstance(error, NoPlanExists):
        return Outcome(kind=OutcomeKind.NO_PLAN_EXISTS)
    bound = None if error.lower_bound is None else Tick(error.lower_bound)
    return Outcome(kind=OutcomeKind.GAVE_UP, bound=bound)
