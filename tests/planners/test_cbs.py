"""Conflict-based search and the improvement of its first plan take turns."""

from __future__ import annotations

import re
from fractions import Fraction
from inspect import signature

import pytest

import rightofway
from benchmarks.proofs import fleet
from rightofway.bench.fleets import make_scenario_document
from rightofway.io import parse_scenario
from rightofway.model import OutcomeKind, Plan, Rules, Scenario
from rightofway.planners import cbs, lns
from rightofway.planners.cbs import ITERATIONS_PER_ROBOT, TURNS_WITHIN_FACTOR
from rightofway.planners.options import CbsOptions
from rightofway.search import ConflictBasedSearch
from tests.builders.fleets import random_fleet

ROBOTS = 20


def _fleet() -> Scenario:
    grid = {"width": 12, "height": 12, "walls": 0.1, "seed": 4}
    drawn = {"speeds": [1], "work": [0, 0], "by_seed": False, "rules": {}}
    return parse_scenario(make_scenario_document({"random": grid}, drawn, ROBOTS, 4))


def _count_neighbourhoods(plan: Plan) -> int:
    tries = re.search(r"(\d+) neighbourhoods?", str(plan.run.status))
    return int(tries[1]) if tries else 0


def _plan_within(factor: int) -> Plan:
    options = {"suboptimality": Fraction(factor)}
    return rightofway.solve(_fleet(), "cbs", time_limit=None, options=options)


def test_a_first_plan_within_the_factor_is_improved_by_few_neighbourhoods(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plan = _plan_within(5)
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.kind in {OutcomeKind.BOUNDED, OutcomeKind.OPTIMAL}
    assert _count_neighbourhoods(plan) == TURNS_WITHIN_FACTOR * ROBOTS
    monkeypatch.setattr(cbs, "TURNS_WITHIN_FACTOR", 0)
    first = _plan_within(5)
    assert _count_neighbourhoods(first) == 0
    assert plan.flowtime < first.flowtime


def test_reports_on_progress_do_not_change_when_the_proof_is_looked_at(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Reports come by the clock: here after each neighbourhood."""
    plan = _plan_within(5)
    monkeypatch.setattr(lns, "BETWEEN_REPORTS", 0.0)
    assert _plan_within(5).tracks == plan.tracks


def test_the_improvement_ends_where_the_tree_has_proven_its_plan() -> None:
    plan = rightofway.solve(_fleet(), "cbs", time_limit=None)
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.kind is OutcomeKind.OPTIMAL
    assert _count_neighbourhoods(plan) < ITERATIONS_PER_ROBOT * ROBOTS / 4


def test_an_end_by_nodes_gives_one_plan() -> None:
    plans = [
        rightofway.solve(_fleet(), "cbs", time_limit=None, options={"nodes": 7}) for _ in range(2)
    ]
    assert plans[0].tracks == plans[1].tracks
    assert plans[0].run.outcome == plans[1].run.outcome


def test_the_planner_and_the_search_have_the_same_defaults() -> None:
    """Answers of options are words, those of the search are claims."""
    said = CbsOptions()
    of_search = {
        name: given.default
        for name, given in signature(ConflictBasedSearch.__init__).parameters.items()
    }
    for switch in ("bypass", "clear", "targets", "disjoint", "pairs"):
        assert (getattr(said, switch) == "yes") is of_search[switch]
    assert (said.cardinal == "first") is of_search["cardinal"]
    for count in ("pair_nodes", "joint_states"):
        assert getattr(said, count) == of_search[count]


def test_disjoint_splits_prove_the_same_optima_with_fewer_nodes() -> None:
    bounds, nodes = [], []
    for disjoint in (True, False):
        searches = [
            ConflictBasedSearch(fleet.problem, disjoint=disjoint)
            for fleet in (
                random_fleet(seed, size=7, robots=6, rules=Rules(occupancy="both"))
                for seed in (2, 4, 17, 26)
            )
        ]
        for search in searches:
            search.run(nodes=1000)
        assert all(search.is_proven for search in searches)
        bounds.append([search.bound for search in searches])
        nodes.append(sum(search.n_nodes for search in searches))
    assert bounds[0] == bounds[1]
    assert nodes[0] < nodes[1]


@pytest.mark.slow
def test_a_robot_that_is_held_keeps_to_its_row_in_the_conflicts_that_it_has() -> None:
    """Their sets of constraints were those without the hold: after 1280 nodes none was left."""
    scenario = fleet(None, "14x5", 24, 3, classic=False)
    search = ConflictBasedSearch(scenario.problem, pair_nodes=0)
    search.run(nodes=1300)
    assert search.n_nodes == 1300


def test_a_robot_that_comes_home_last_keeps_the_headway_behind_the_robot_that_left() -> None:
    """Of two plans with the least flowtime, that with fewer actions was against the rules."""
    vertices = {"left": [0, 0], "middle": ["23/4", 0], "right": ["43/4", 0]}
    robots = [
        {"name": "R1", "home": "middle", "target": "left", "work": 2, "speed": 1},
        {"name": "R2", "home": "right", "target": "middle", "work": 3, "speed": 1},
    ]
    edges = [{"from": "left", "to": "middle"}, {"from": "middle", "to": "right"}]
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": vertices, "edges": edges}},
            "robots": robots,
            "rules": {"occupancy": "one", "headway": 1},
        }
    )
    plan = rightofway.solve(scenario, "cbs", time_limit=None)
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.kind is OutcomeKind.OPTIMAL
    assert rightofway.check(plan).ok


def test_a_search_that_has_ended_stays_as_it_is() -> None:
    search = ConflictBasedSearch(random_fleet(2, size=7, robots=6).problem)
    search.run()
    ended = search.bound, search.tracks, search.n_nodes
    assert search.is_proven
    search.run()
    assert (search.bound, search.tracks, search.n_nodes) == ended
