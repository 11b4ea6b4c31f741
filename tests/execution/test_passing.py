"""Vertices that robots only drive through, with breakdowns on the way through."""

from __future__ import annotations

import pytest

from rightofway import simulate, solve
from tests.builders.tiny import KINDS


@pytest.mark.parametrize("seed", [169, 254])
def test_closures_are_known_where_a_robot_that_broke_down_leaves_no_lane(seed: int) -> None:
    """It has broken down on the way through, which all lanes touch; a closure has a radius."""
    scenario = KINDS["passed"](seed)
    assert any(closure.radius for closure in scenario.closures)
    plan = solve(scenario, "prioritized", time_limit=None)
    result = simulate(plan, delays=["breaks:0.4"], runs=4, seed=seed, replan=True)
    assert result.broken > 0
