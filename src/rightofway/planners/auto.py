"""The default: a plan as early as possible, then better plans until it is optimal or time is up.

A small fleet is planned by two-level, whose decisions are explained; a large one by LaCAM and by
prioritized planning, whichever plan is better. Large neighbourhood search improves the best of
these. Conflict-based search proves how good a plan is, and finds the optimum where it can: of a
small fleet within some nodes before the improvement, of any fleet in the time that is left after
it; then prices of places raise the bound. Where nothing better than the plan of two-level is found,
that is returned, with its decisions. It starts from a given plan unless the plan of two-level is
better.
"""

from __future__ import annotations

from dataclasses import replace

from rightofway.errors import GaveUp, InputError
from rightofway.model import Objective, Proof, Status, Tick
from rightofway.planners.features import refuse_with_swaps_left
from rightofway.planners.lns import improve_best, lns
from rightofway.planners.two_level import paper, two_level
from rightofway.repair.bounds import SHARE as SHARE_OF_NODES
from rightofway.repair.bounds import compute_price_bound, finish_optimum
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.impossible import refuse_blocked
from rightofway.repair.makespan import MakespanSearch, measure_alone
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.search import ConflictBasedSearch

FEW = 60
"""A fleet is small with at most this many robots."""

SHARE = 0.3
"""The part of the time for two-level."""

FIRST_NODES, SHARE_OF_FIRST_NODES = 100, 0.2
"""Nodes of conflict-based search before the improvement of a small fleet, and their part of the
time left."""

MOST_PROVEN = 1000
"""Larger fleets get no conflict-based search: the conflicts of its root would fill the memory."""

LEAST_IDLE = 0.02
"""With a smaller part of the time left after the improvement, nothing more is proven."""


def auto(request: PlanRequest) -> Draft:
    """Plan by several methods, and improve the best plan or prove it; options: `AutoOptions`.

    With ``swaps=leave`` it is `paper`, for points only.
    """
    if request.options["swaps"] == "leave":
        if request.start is not None:
            message = "leave cannot start from a plan (choose swaps=resolve)"
            raise InputError.at(("options", "swaps"), message)
        refuse_with_swaps_left(request.scenario.problem)
        return paper(request)
    if request.scenario.problem.has_times:
        return lns(request)  # the other methods do not know times
    return finish_optimum(request, _find_best(request))


def _find_best(request: PlanRequest) -> Draft:
    """Return the best plan of several methods, with its proof."""
    prover = _Prover(request)
    # Small fleets get the plan of the paper first, because each of its decisions has a reason.
    first = _find_explained(request)
    if first is not None:
        nodes = min(FIRST_NODES, request.options["nodes"] or FIRST_NODES)
        first = prover.prove(first, nodes, SHARE_OF_FIRST_NODES)
        if _is_optimal(request, first):
            return first
    try:
        better = _improve_first(request, first)
    except GaveUp:
        # A large fleet would only lose time in a tree that cannot be searched.
        if len(request.scenario.robots) > FEW:
            raise
        optimum = prover.search()
        if optimum is None:
            raise
        return optimum
    is_interrupted = better.improvement is not None and better.improvement.interrupted
    if is_interrupted or _is_optimal(request, better):
        return better
    better = prover.prove(better, request.options["nodes"], SHARE_OF_NODES)
    return better if _is_optimal(request, better) else prover.prove_by_prices(better)


def _find_explained(request: PlanRequest) -> Draft | None:
    """Return the plan of two-level for a small fleet, unless a plan given is better."""
    if len(request.scenario.robots) > FEW:
        return None
    options = {**request.options, "swaps": "resolve", "routes": "clear"}
    hurried = replace(
        request, options=options, start=None, deadline=request.deadline.shorten(SHARE)
    )
    try:
        explained = two_level(hurried)
    except GaveUp:
        return None
    request.has_plan()
    request.better(lambda: explained.tracks)
    is_given = request.start is not None and explained.tracks != request.start
    if is_given and request.measure_worth(request.start or ()) <= request.measure_worth(
        explained.tracks
    ):
        return None
    status = Status("by planner", planner="two-level", status=explained.status)
    return replace(explained, status=status)


def _improve_first(request: PlanRequest, first: Draft | None) -> Draft:
    """Improve the first plan by large neighbourhood search; keep it where nothing is better."""
    if first is None:
        return lns(request)
    try:
        if request.start is None:
            better = improve_best(request, make_fleet_search(request), first=first)
        else:
            better = replace(lns(replace(request, start=first.tracks)), proof=first.proof)
    except GaveUp:
        return first
    if request.measure_worth(better.tracks) < request.measure_worth(first.tracks):
        return better
    return replace(first, status=better.status, improvement=better.improvement)


class _Prover:
    """Conflict-based search beside other methods: it goes on where it was."""

    def __init__(self, request: PlanRequest) -> None:
        self._request = request
        self._whole = request.deadline.measure_seconds_left()
        self._search: ConflictBasedSearch | None = None

    def prove(self, draft: Draft, nodes: int, share: float = 1.0) -> Draft:
        """Return a plan with its proof, or the optimum."""
        request, objective = self._request, self._request.objective
        if objective.has_makespan:
            return self._try_makespan_proof(draft, nodes, share)
        search = self._run(nodes, share, upper=request.measure_worth(draft.tracks)[0])
        if search is None or search.bound is None:
            return draft
        proof = Proof(bound=search.bound, objective=objective)
        tracks, nodes = search.tracks, search.n_nodes
        if tracks is not None:
            request.better(lambda: tracks)
            status = Status("optimum found by search", nodes=nodes)
            return Draft(tracks=tracks, status=status, proof=proof)
        if search.is_proven:
            status = Status("proven by search", nodes=nodes, status=draft.status)
            draft = replace(draft, status=status)
        return replace(draft, proof=proof)

    def _try_makespan_proof(self, draft: Draft, nodes: int, share: float) -> Draft:
        request = self._request
        if not self._may_search():
            return draft
        search = MakespanSearch(
            request=replace(request, deadline=request.deadline.shorten(share)),
            trees=lambda latest: ConflictBasedSearch(request.scenario.problem, latest=latest),
            tracks=draft.tracks,
            nodes=nodes,
        )
        search.run()
        proof = Proof(bound=Tick(search.bound), objective=request.objective)
        if search.value == search.bound:
            status = Status("proven by search", nodes=search.n_nodes, status=draft.status)
            if search.tracks is not draft.tracks:
                status = Status("optimum found by search", nodes=search.n_nodes)
            draft = replace(draft, status=status)
        if search.tracks is not draft.tracks:
            return Draft(tracks=search.tracks, status=draft.status, proof=proof)
        return replace(draft, proof=proof)

    def prove_by_prices(self, draft: Draft) -> Draft:
        """Return a plan with a bound by prices of places, where that is higher."""
        request = self._request
        if not self._has_time():
            return draft
        objective = request.objective
        if objective is Objective.MAKESPAN:
            return draft  # prices add up what robots lose
        least = compute_price_bound(request.scenario, request.deadline, request.options["nodes"])
        if objective is Objective.BOTH:
            # Prices bound the flowtime; the makespan is at least that of the last robot alone.
            weight = sum(request.scenario.problem.weights)
            least = Tick(least + weight * max(measure_alone(request)))
        if draft.proof is not None and draft.proof.bound >= least:
            return draft
        return replace(draft, proof=Proof(bound=least, objective=objective))

    def search(self) -> Draft | None:
        """Return the optimum of a fleet of which no plan is known; None if none was found.

        Raises
        ------
        NoPlanExists
            If that is proven.
        """
        request = self._request
        search = self._run(request.options["nodes"], 1, upper=None)
        if search is None:
            return None
        if search.tracks is not None:
            request.has_plan()
            status = Status("optimum found by search", nodes=search.n_nodes)
            objective = request.objective
            if objective.has_makespan:
                status = Status("found by search", nodes=search.n_nodes)
                draft = Draft(tracks=search.tracks, status=status)
                return self.prove(draft, request.options["nodes"])
            proof = Proof(bound=search.bound or Tick(0), objective=objective)
            return Draft(tracks=search.tracks, status=status, proof=proof)
        if search.is_proven:
            refuse_blocked(request)
        return None

    def _run(self, nodes: int, share: float, upper: int | None) -> ConflictBasedSearch | None:
        """Search on; None where there is no time, or where the fleet is too large."""
        request = self._request
        if not self._may_search():
            return None
        if self._search is None:
            self._search = ConflictBasedSearch(request.scenario.problem)
        limit = request.deadline.shorten(share).measure_seconds_left()
        try:
            self._search.run(upper=upper, nodes=nodes or None, time_limit=limit)
        except KeyboardInterrupt:
            if not request.keep_best or upper is None:
                raise
        return self._search

    def _may_search(self) -> bool:
        return len(self._request.scenario.robots) <= MOST_PROVEN and self._has_time()

    def _has_time(self) -> bool:
        left = self._request.deadline.measure_seconds_left()
        return left is None or left > LEAST_IDLE * (self._whole or 0)


def _is_optimal(request: PlanRequest, draft: Draft) -> bool:
    """Return whether a plan is proven to be optimal."""
    return draft.proof is not None and request.measure_worth(draft.tracks)[0] == draft.proof.bound
