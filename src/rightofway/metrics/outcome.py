"""Proven bounds of plans, also of plans without an outcome of their own."""

from __future__ import annotations

from rightofway.metrics.measure import WITHOUT_PLAN, get_own_outcome, measure
from rightofway.model import Objective, Outcome, OutcomeKind, Plan, Proof
from rightofway.model.outcome import classify_cost


def derive_outcome(plan: Plan) -> Outcome:
    """Return the proof of a plan: by its planner, or by the sum of the robots alone.

    Parameters
    ----------
    plan
        A plan that keeps the rules; one from elsewhere has no outcome of its own.

    Raises
    ------
    NoPlanExists
        If no way leads from one place of a robot's trip to the next, so that there is no bound.

    Notes
    -----
    An outcome that the plan itself refutes, because it is below the bound, is dropped: files can be
    changed.
    """
    outcome = plan.run.outcome
    if outcome is not None and outcome.kind in WITHOUT_PLAN:
        return outcome
    if own := get_own_outcome(plan):
        return own
    metrics = measure(plan)
    if plan.scenario.jobs is not None:  # other tours may be better
        kind, objective = OutcomeKind.BEST_FOUND, Objective.FLOWTIME
        return Outcome(kind=kind, objective=objective, bound=metrics.lower_bound)
    return classify_cost(metrics.flowtime, Proof(bound=metrics.flowtime_alone))
