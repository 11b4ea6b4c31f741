"""Conflict-based search: a plan of least flowtime, or one within a proven factor of it.

A first plan comes from `lns`. The search then raises the proven bound, node by node, until it
meets that plan, or finds a better one: of least cost by construction. Which constraints a
conflict leads to, and why no plan is lost by them, is in ``cpp/cbs/track_conflicts.cpp`` and in
decision 30.

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

from dataclasses import replace
from fractions import Fraction
from math import ceil
from typing import Any

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Proof, Tick, compute_cost
from rightofway.model.outcome import Objective, choose_objective
from rightofway.phrases import Phrase, say_count
from rightofway.planners.bounds import finish_optimum
from rightofway.planners.impossible import find_blocking_set
from rightofway.planners.lns import improve_best
from rightofway.planners.makespan import MakespanSearch
from rightofway.planners.objectives import find_objective
from rightofway.planners.prioritized import make_fleet_search
from rightofway.planners.task import Draft, Task
from rightofway.search import ConflictBasedSearch

SHARE = 0.25
"""The part of the time for the first plan."""

ITERATIONS_PER_ROBOT = 200
"""How many neighbourhoods of the first plan are replanned for each robot."""


def cbs(task: Task) -> Draft:
    """Plan a fleet with least flowtime and surcharges, or makespan; options: `CbsOptions`."""
    has_makespan = find_objective(task).has_makespan
    first = _first_plan(task)
    if has_makespan:
        draft = _with_makespan(task, first or _of_least_flowtime(task, None))
    else:
        draft = _of_least_flowtime(task, first)
    return finish_optimum(task, draft)


def _search(task: Task, **limits: Any) -> ConflictBasedSearch:
    return ConflictBasedSearch(
        task.scenario.problem,
        cardinal=task.options["cardinal"] == "first",
        bypass=task.options["bypass"] == "yes",
        clear=task.options["clear"] == "yes",
        targets=task.options["targets"] == "yes",
        pairs=task.options["pairs"] == "yes",
        pair_nodes=task.options["pair_nodes"],
        joint_states=task.options["joint_states"],
        **limits,
    )


def _of_least_flowtime(task: Task, first: Draft | None) -> Draft:
    """Return an optimal plan, or the first plan with what is proven of it."""
    scenario, factor = task.scenario, Fraction(task.options["suboptimality"])
    upper = None if first is None else compute_cost(scenario, first.tracks)
    search = _search(task, factor=factor)
    ended = "time ran out"
    try:
        search.run(
            upper=upper,
            enough=None if upper is None else ceil(upper / factor),
            nodes=task.options["nodes"] or None,
            time_limit=task.deadline.measure_seconds_left(),
        )
    except KeyboardInterrupt:
        if not task.keep_best or first is None:
            raise
        return replace(first, status=Phrase("interrupted: {status}", status=first.status))
    done = say_count(search.n_nodes, "node", "nodes")
    if search.tracks is not None:
        task.has_plan()
        tracks = search.tracks
        kind = Phrase("optimal")
        if factor > 1:
            kind = Phrase("within {factor} of the optimum", factor=f"{float(factor):g}")
        status = Phrase("{kind}: found in {nodes}", kind=kind, nodes=done)
        if first is not None and compute_cost(scenario, tracks) >= compute_cost(
            scenario, first.tracks
        ):
            tracks = first.tracks
            status = Phrase(
                "{kind}: {nodes} prove it (first plan: {status})",
                kind=kind,
                nodes=done,
                status=first.status,
            )
        task.better(lambda: tracks)
    elif first is not None:
        tracks = first.tracks
        if search.is_proven:
            status = Phrase(
                "optimal: {nodes} prove that nothing is better (first plan: {status})",
                nodes=done,
                status=first.status,
            )
        else:
            status = Phrase(
                "{nodes} found nothing better (first plan: {status})",
                nodes=done,
                status=first.status,
            )
    elif search.is_proven:
        robots = range(len(scenario.robots))
        raise NoPlanExists(
            [find_blocking_set(scenario, robots, seed=task.seed, deadline=task.deadline)]
        )
    else:
        remedy = "give a longer time limit, or take another planner"
        error = GaveUp(f"{ended} in the search for an optimal plan, after {done} ({remedy})")
        if choose_objective(scenario) is Objective.FLOWTIME:  # the message has a bound of that
            error.lower_bound = search.bound
        raise error
    proof = Proof(
        bound=Tick(search.bound or 0),
        objective=choose_objective(scenario),
        factor=factor if factor > 1 else None,
    )
    return Draft(tracks=tracks, status=status, proof=proof)


def _with_makespan(task: Task, first: Draft) -> Draft:
    """Return the best plan by its makespan, or its makespan and flowtime, with what is proven."""
    objective, factor = find_objective(task), Fraction(task.options["suboptimality"])
    search = MakespanSearch(
        task=task,
        trees=lambda latest: _search(task, latest=latest),
        tracks=first.tracks,
        nodes=task.options["nodes"],
        factor=factor,
    )
    search.run()
    status = Phrase(
        "{kind}: {nodes} for the {objective} (first plan: {status})",
        kind=Phrase("optimal") if search.value == search.bound else Phrase("best found"),
        nodes=say_count(search.n_nodes, "node", "nodes"),
        objective=Phrase(objective.value),
        status=first.status,
    )
    proof = Proof(
        bound=Tick(search.bound), objective=objective, factor=factor if factor > 1 else None
    )
    return Draft(tracks=search.tracks, status=status, proof=proof)


def _first_plan(task: Task) -> Draft | None:
    """Return the plan given or one by large neighbourhood search, None where it finds none."""
    if task.start is not None:
        return Draft(tracks=task.start, status=Phrase("the plan given"))
    iterations = ITERATIONS_PER_ROBOT * len(task.scenario.robots)
    hurried = replace(
        task,
        options={"iterations": iterations, "objective": task.options["objective"]},
        deadline=task.deadline.shorten(SHARE),
    )
    try:
        return improve_best(hurried, make_fleet_search(hurried))
    except GaveUp:
        return None
