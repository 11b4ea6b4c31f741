"""Robots with a size on tiny roadmaps, against a search over where all of them are."""

from __future__ import annotations

import pytest

from rightofway import check, solve
from rightofway.errors import NoPlanExists
from tests.builders.seeds import seeds
from tests.builders.sizes import tiny
from tests.oracles.joint_space import least_flowtime


@pytest.mark.parametrize("robots", [2, 3])
@pytest.mark.parametrize("seed", seeds(200, 20))
def test_auto_finds_the_optimum_or_proves_that_there_is_no_plan(seed: int, robots: int) -> None:
    """Lanes cross and pass near vertices, and robots stand in each other's way."""
    scenario = tiny(seed, robots=robots)
    least = least_flowtime(scenario)
    try:
        plan = solve(scenario)
    except NoPlanExists:
        assert least is None
        return
    assert check(plan).ok
    assert plan.flowtime == least


@pytest.mark.parametrize("seed", range(60))
def test_two_level_never_beats_the_optimum_and_proves_the_same(seed: int) -> None:
    scenario = tiny(seed)
    least = least_flowtime(scenario)
    try:
        plan = solve(scenario, "two-level")
    except NoPlanExists:
        assert least is None
        return
    assert check(plan).ok
    assert least is not None
    assert plan.flowtime >= least
