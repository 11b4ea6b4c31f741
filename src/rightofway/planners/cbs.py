"""Conflict-based search: a plan of least flowtime, or one within a proven factor of it.

A first plan comes from `lns`. The search raises the proven bound, node by node, until it meets that
plan, or finds a better one: of least cost by construction. Both take turns, so that neither goes on
where the other has proven enough; then the search goes on alone. Which constraints a
conflict leads to, and why no plan is lost by them, is in ``cpp/cbs/track_conflicts.cpp`` and in
decision 9.

References
----------
Sharon, Stern, Felner & Sturtevant, *Conflict-based search for optimal multi-agent pathfinding*,
Artificial Intelligence 219, 2015.

Boyarski, Felner, Stern, Sharon, Tolpin, Betzalel & Shimony, *ICBS: Improved conflict-based search
algorithm for multi-agent pathfinding*, IJCAI 2015.

Li, Felner, Boyarski, Ma & Koenig, *Improved heuristics for multi-agent path finding with
conflict-based search*, IJCAI 2019.

Barer, Sharon, Stern & Felner, *Suboptimal variants of the conflict-based search algorithm for the
multi-agent pathfinding problem*, SoCS 2014.

Notes
-----
Optimal where it ends; deterministic where `nodes` ends it before the time limit does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import ceil
from typing import Any

from rightofway.deadline import Deadline
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Proof, Status, Tick, compute_cost
from rightofway.model.outcome import Objective, choose_objective
from rightofway.planners.lns import improve_best
from rightofway.repair.bounds import finish_optimum
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.impossible import refuse_blocked
from rightofway.repair.makespan import MakespanSearch, measure_alone
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.search import ConflictBasedSearch

SHARE = 0.25
"""The part of the time for the first plan."""

ITERATIONS_PER_ROBOT = 200
"""Number of neighbourhoods of the first plan that are replanned for each robot."""

NODES_PER_TURN, SHARE_OF_TURN = 5, 0.1
"""Nodes from one look at the first plan to the next, and the part of its time that they may take.
"""


TURNS_WITHIN_FACTOR = 2
"""Turns of the first plan, of a neighbourhood for each robot, once it is proven to be within a
factor above 1: the first turns gain most, and take about as long as the plan and its proof.
"""


def cbs(request: PlanRequest) -> Draft:
    """Plan a fleet with least flowtime and surcharges, or makespan; options: `CbsOptions`."""
    if request.objective.has_makespan:
        first = _find_first_plan(request, partial(_is_within, request))
        draft = _find_with_makespan(request, first or _Tree(request).finish(None))
    else:
        tree = _Tree(request)
        draft = tree.finish(_find_first_plan(request, tree.prove))
    return finish_optimum(request, draft)


def _search(request: PlanRequest, **limits: Any) -> ConflictBasedSearch:
    return ConflictBasedSearch(
        request.scenario.problem,
        cardinal=request.options["cardinal"] == "first",
        bypass=request.options["bypass"] == "yes",
        clear=request.options["clear"] == "yes",
        targets=request.options["targets"] == "yes",
        disjoint=request.options["disjoint"] == "yes",
        pairs=request.options["pairs"] == "yes",
        pair_nodes=request.options["pair_nodes"],
        joint_states=request.options["joint_states"],
        **limits,
    )


class _Tree:
    """A tree for the least flowtime: it grows in turn with a first plan, and then alone."""

    def __init__(self, request: PlanRequest) -> None:
        self._request = request
        self._factor = Fraction(request.options["suboptimality"])
        self._search = _search(request, factor=self._factor)

    def prove(self, value: Tick, deadline: Deadline) -> bool:
        """Grow by a few nodes; return whether a plan of this cost, or another one, is proven."""
        self._search_tree(value, NODES_PER_TURN, deadline.shorten(SHARE_OF_TURN))
        return self._is_over(value)

    def _is_over(self, value: int | None) -> bool:
        search = self._search
        is_within = value is not None and value <= self._factor * (search.bound or 0)
        return search.is_proven or is_within

    def _search_tree(self, upper: int | None, nodes: int | None, deadline: Deadline) -> None:
        if most := self._request.options["nodes"]:
            nodes = min(nodes or most, most - self._search.n_nodes)
        if nodes == 0 or self._is_over(upper):
            return
        self._search.run(
            upper=upper,
            enough=None if upper is None else ceil(upper / self._factor),
            nodes=nodes,
            time_limit=deadline.measure_seconds_left(),
        )

    def finish(self, first: Draft | None) -> Draft:
        """Return the optimum, a plan within the factor, or the first plan with its proof."""
        request, scenario, search = self._request, self._request.scenario, self._search
        upper = None if first is None else compute_cost(scenario, first.tracks)
        is_interrupted = first and first.improvement and first.improvement.interrupted
        try:
            if not is_interrupted:
                self._search_tree(upper, None, request.deadline)
        except KeyboardInterrupt:
            if not request.keep_best or first is None:
                raise
            return replace(first, status=Status("interrupted", status=first.status))
        nodes, claim = search.n_nodes, Status("optimal")
        if self._factor > 1:
            claim = Status("within factor", factor=self._factor)
        other = search.tracks
        if other is not None and (upper is None or compute_cost(scenario, other) < upper):
            request.has_plan()
            tracks, status = other, Status("found", claim=claim, nodes=nodes)
            request.better(lambda: tracks)
        elif first is not None:
            tracks = first.tracks
            status = Status("nothing better", nodes=nodes, status=first.status)
            if self._is_over(upper):
                status = Status("proven", claim=claim, nodes=nodes, status=first.status)
        elif search.is_proven:
            refuse_blocked(request)
        else:
            error = GaveUp(Fact("time over for an optimal plan", nodes=nodes))
            if choose_objective(scenario) is Objective.FLOWTIME:  # the message has a bound of that
                error.lower_bound = search.bound
            raise error
        proof = Proof(
            bound=Tick(search.bound or 0),
            objective=choose_objective(scenario),
            factor=self._factor if self._factor > 1 else None,
        )
        return Draft(tracks=tracks, status=status, proof=proof)


def _find_with_makespan(request: PlanRequest, first: Draft) -> Draft:
    """Return the best plan by its makespan, or its makespan and flowtime, with its proof."""
    objective, factor = request.objective, Fraction(request.options["suboptimality"])
    search = MakespanSearch(
        request=request,
        trees=lambda latest: _search(request, latest=latest),
        tracks=first.tracks,
        nodes=request.options["nodes"],
        factor=factor,
    )
    search.run()
    status = Status(
        "searched",
        claim=Status("optimal" if search.value == search.bound else "best found"),
        nodes=search.n_nodes,
        objective=objective.value,
        status=first.status,
    )
    proof = Proof(
        bound=Tick(search.bound), objective=objective, factor=factor if factor > 1 else None
    )
    return Draft(tracks=search.tracks, status=status, proof=proof)


def _is_within(request: PlanRequest, value: Tick, _: Deadline) -> bool:
    """Return whether a makespan is within the factor, which is above 1, as robots alone prove."""
    factor = Fraction(request.options["suboptimality"])
    alone = request.objective.compute_values(
        request.scenario.problem.weights, measure_alone(request)
    )
    return factor > 1 and value <= factor * alone[0]


def _find_first_plan(
    request: PlanRequest, is_proven: Callable[[Tick, Deadline], bool]
) -> Draft | None:
    """Return the plan given or one by large neighbourhood search, None where it finds none."""
    if request.start is not None:
        return Draft(tracks=request.start, status=Status("given"))
    iterations = ITERATIONS_PER_ROBOT * len(request.scenario.robots)
    hurried = replace(
        request,
        options={"iterations": iterations, "objective": request.options["objective"]},
        deadline=request.deadline.shorten(SHARE),
    )
    turns = TURNS_WITHIN_FACTOR if Fraction(request.options["suboptimality"]) > 1 else 0

    def is_enough(value: Tick) -> bool:
        nonlocal turns
        if is_proven(value, hurried.deadline):
            turns -= 1
        return turns < 0

    try:
        return improve_best(hurried, make_fleet_search(hurried), is_enough=is_enough)
    except GaveUp:
        return None
