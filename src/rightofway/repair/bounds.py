"""Lower bounds of all plans of a fleet; the longer it takes, the higher.

Two methods: conflict-based search adds the losses of pairs of robots to each other, and goes on to
the optimum where it can: strong for small fleets and in one-wide aisles. Prices of places take all
robots together: strong on full floors. Each has a short first turn; the one with the higher bound
goes on, and the other one if time is left.

References
----------
Held, Wolfe & Crowder, *Validation of subgradient optimization*, Mathematical Programming 6, 1974.

Lam, Le Bodic, Harabor & Stuckey, *Branch-and-cut-and-price for multi-agent path finding*, Computers
& Operations Research 144, 2022.
"""

from __future__ import annotations

from dataclasses import replace

from rightofway.deadline import Deadline
from rightofway.errors import NoPlanExists
from rightofway.facts import Fact
from rightofway.metrics import find_forced_losses, find_forced_makespan
from rightofway.model import (
    ForcedLoss,
    Objective,
    Proof,
    Scenario,
    Tick,
    compute_completions,
)
from rightofway.model.outcome import choose_objective
from rightofway.repair.makespan import measure_alone
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.search import ConflictBasedSearch, PriceAscent, find_fewest_actions

SHARE = 0.1
"""The part of the time for the first turn of each method."""

PAIRS, STATES = 50, 1_000
"""Pairs of robots whose losses are looked for, and joint states of each."""

STATES_OF_ACTIONS = 10_000
"""Joint states of each search for a plan with fewer drives and waits."""


def prove_bound(
    scenario: Scenario, *, time_limit: float | None = None, nodes: int = 0, steps: int = 0
) -> tuple[Proof, bool]:
    """Prove a lower bound of the objective; the longer, the higher.

    Returns
    -------
    tuple of (Proof, bool)
        The bound, and whether there is a plan that reaches it.

    Raises
    ------
    NoPlanExists
        If that is proven.
    """
    deadline = Deadline.after(time_limit)
    search, prices = ConflictBasedSearch(scenario.problem), PriceAscent(scenario.problem)

    def search_tree(turn: Deadline) -> None:
        left = nodes - search.n_nodes if nodes else None
        if left != 0:
            search.run(nodes=left, time_limit=turn.measure_seconds_left())
        if search.bound is None:
            raise NoPlanExists(Fact("no plan in tree"))

    def raise_prices(turn: Deadline) -> None:
        left = steps - prices.n_steps if steps else None
        if left != 0 and search.tracks is None:
            prices.run(steps=left, time_limit=turn.measure_seconds_left())

    search_tree(deadline.shorten(SHARE))
    raise_prices(deadline.shorten(SHARE))
    if prices.bound > (search.bound or 0):
        raise_prices(deadline)
    search_tree(deadline)
    raise_prices(deadline)
    least = max(search.bound or Tick(0), prices.bound)
    return Proof(bound=least, objective=choose_objective(scenario)), search.tracks is not None


def finish_optimum(request: PlanRequest, draft: Draft) -> Draft:
    """Return an optimal plan with few drives and waits, and the forced losses that prove it.

    Other plans as they are. A plan whose decisions are explained keeps its tracks.
    """
    proof = draft.proof
    if proof is None or proof.objective.compute_cost(request.scenario, draft.tracks) > proof.bound:
        return draft
    return _explain(request, _act_less(request, draft), proof)


def _act_less(request: PlanRequest, draft: Draft) -> Draft:
    objective, scenario = request.objective, request.scenario
    states = request.options.get("joint_states", STATES_OF_ACTIONS)
    if draft.decisions or states == 0:
        return draft
    latest = None
    if objective.has_makespan:
        latest = max(compute_completions(scenario, draft.tracks))
    _, tracks = find_fewest_actions(
        scenario,
        draft.tracks,
        latest=latest,
        states=states,
        time_limit=request.deadline.measure_seconds_left(),
    )
    return replace(draft, tracks=tracks)


def _explain(request: PlanRequest, draft: Draft, proof: Proof) -> Draft:
    """Return an optimal plan with its forced losses.

    A bounded number of steps finds that: without a time limit reached the same losses each time.
    """
    scenario, deadline = request.scenario, request.deadline
    losses: tuple[ForcedLoss, ...] = ()
    if proof.objective.has_makespan:
        makespan = Objective.MAKESPAN.compute_cost(scenario, draft.tracks)
        limit = deadline.measure_seconds_left()
        losses = find_forced_makespan(
            scenario, makespan, time_limit=limit, pairs=PAIRS, states=STATES
        )
    completions = compute_completions(scenario, draft.tracks)
    may_lose = list(completions) != measure_alone(request) or scenario.roadmap.has_surcharges
    if proof.objective is not Objective.MAKESPAN and may_lose:
        limit = deadline.measure_seconds_left()
        losses += find_forced_losses(scenario, time_limit=limit, pairs=PAIRS, states=STATES)
    return replace(draft, forced_losses=losses)


def compute_price_bound(scenario: Scenario, deadline: Deadline, steps: int) -> Tick:
    """Return a lower bound by prices of places."""
    prices = PriceAscent(scenario.problem)
    prices.run(steps=steps or None, time_limit=deadline.measure_seconds_left())
    return prices.bound
