"""Robots with a size on tiny roadmaps, against a search over where all of them are."""

from __future__ import annotations

from rightofway import check, solve
from rightofway.errors import NoPlanExists
from tests.builders.sizes import tiny
from tests.oracles.joint_space import least_flowtime

SEEDS = range(60)


def test_auto_proves_the_impossible_and_finds_the_optimum_nearly_always() -> None:
    """Lanes cross, pass near vertices, and robots stand in each other's way."""
    optimal = possible = 0
    for seed in SEEDS:
        scenario = tiny(seed)
        least = least_flowtime(scenario)
        try:
            plan = solve(scenario, time_limit=2)
        except NoPlanExists:
            assert least is None
            continue
        assert check(plan).ok
        assert least is not None
        assert plan.flowtime >= least
        possible += 1
        optimal += plan.flowtime == least
    assert possible >= 40
    assert optimal >= 0.8 * possible
