"""Closures on random fleets: every planner, the judge, and the optimum of tiny fleets."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest

from rightofway import check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Closure, Scenario, VertexId
from rightofway.planners import registered
from tests.builders.closures import closed_fleet, tiny_closed, with_closures
from tests.builders.seeds import seeds
from tests.oracles.closures import breaks_a_closure
from tests.oracles.joint_space import least_flowtime

PLANNERS = [name for name, spec in registered().items() if spec.knows_closures]


@pytest.mark.parametrize("seed", seeds(60, 9))
def test_plans_of_all_planners_keep_clear_of_closures(seed: int) -> None:
    """Where one planner proves that there is no plan, no other one finds a plan."""
    scenario, proven, found = closed_fleet(seed), False, False
    for planner in PLANNERS:
        options = {"iterations": 20} if planner in {"auto", "lns"} else None
        try:
            plan = solve(scenario, planner, time_limit=2, options=options)
        except NoPlanExists:
            proven = True
        except GaveUp:
            continue
        else:
            found = True
            assert check(plan).ok
            assert not breaks_a_closure(plan)
            assert plan.flowtime >= plan.lower_bound
    assert not (proven and found)


@pytest.mark.parametrize("seed", seeds(200, 40))
def test_auto_finds_the_optimum_of_two_robots_among_closures_or_proves_that_there_is_none(
    seed: int,
) -> None:
    """Points that book one vertex or two, and robots with sizes, on lanes that cross."""
    scenario = tiny_closed(seed)
    least = least_flowtime(scenario)
    try:
        plan = solve(scenario, options={"iterations": 50})
    except NoPlanExists:
        assert least is None
        return
    assert check(plan).ok
    assert plan.flowtime == least


@pytest.mark.parametrize("seed", seeds(100, 15))
def test_the_judge_finds_planted_closures_where_the_oracle_does(seed: int) -> None:
    scenario = replace(closed_fleet(seed), closures=())
    try:
        plan = solve(scenario, "prioritized", time_limit=2)
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan to plant closures in")
    planted = replace(plan, scenario=with_closures(scenario, seed + 1, most=1))
    report = check(planted)
    assert set(report.counts) <= {"closed"}
    assert report.ok is not breaks_a_closure(planted)


@pytest.mark.parametrize("seed", seeds(60, 8))
def test_one_more_closure_never_lowers_the_optimum(seed: int) -> None:
    scenario = tiny_closed(seed)
    before, after = least_of(replace(scenario, closures=())), least_of(scenario)
    assert after is None or (before is not None and before <= after)


def least_of(scenario: Scenario) -> int | None:
    """Return the flowtime that auto finds, None where there is no plan."""
    try:
        return solve(scenario, options={"iterations": 50}).flowtime
    except NoPlanExists:
        return None


@pytest.mark.parametrize("seed", seeds(60, 8))
def test_a_closure_of_a_place_that_a_plan_leaves_alone_changes_no_verdict(seed: int) -> None:
    scenario = replace(closed_fleet(3 * seed), closures=())  # points
    try:
        plan = solve(scenario, "prioritized", time_limit=2)
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    used = {vertex for track in plan.tracks for vertex in track.vertices.tolist()}
    unused = [v for v in range(scenario.roadmap.n_vertices) if v not in used]
    if not unused:
        pytest.skip("all vertices are in use")
    at = VertexId(random.Random(seed).choice(unused))  # noqa: S311 (no secret depends on it)
    closed = replace(scenario, closures=(Closure(at=at, from_=Fraction(0)),))
    assert check(replace(plan, scenario=closed)).ok
