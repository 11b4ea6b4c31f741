"""What is proven of a plan, also of one whose maker does not say."""

from __future__ import annotations

from rightofway.arguments import checks_arguments
from rightofway.metrics.measure import measure
from rightofway.model import Outcome, OutcomeKind, Plan, Proof
from rightofway.model.outcome import classify_cost


@checks_arguments
def derive_outcome(plan: Plan) -> Outcome:
    """Return what its planner has proven of a plan, or what the sum of the robots alone proves.

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
    An outcome that the plan itself refutes, because it is below the bound, counts for nothing:
    files can be changed.
    """
    said = plan.run.outcome
    if said is not None and said.kind in {OutcomeKind.NO_PLAN_EXISTS, OutcomeKind.GAVE_UP}:
        return said  # its tracks stand for no plan
    if said is not None and said.bound is not None:
        cost = plan.compute_value(said.objective)
        proof = Proof(bound=said.bound, objective=said.objective, factor=said.factor)
        is_careful = said.kind is OutcomeKind.BEST_FOUND  # a plan with swaps proves nothing
        if cost >= said.bound and (is_careful or classify_cost(cost, proof) == said):
            return said
    metrics = measure(plan)
    return classify_cost(metrics.flowtime, Proof(bound=metrics.lower_bound))
