"""Zones on tiny roadmaps, against a search over where all robots are, and how they got there."""

from __future__ import annotations

import pytest

from rightofway import check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.planners import registered
from tests.builders.seeds import seeds
from tests.builders.sizes import zoned
from tests.oracles.joint_space import least_flowtime
from tests.oracles.space import overlaps

KNOW_ZONES = sorted(spec.name for spec in registered().values() if spec.knows_sizes)
STEPS: dict[str, dict[str, int]] = {name: {"iterations": 200} for name in ("auto", "lns")}


@pytest.mark.parametrize("planner", KNOW_ZONES)
@pytest.mark.parametrize("seed", seeds(60, 2))
def test_plans_keep_zones_and_what_is_proven_is_true(planner: str, seed: int) -> None:
    """Planners keep clear of some vertices without need: they may give up, but prove nothing."""
    scenario = zoned(seed)
    least = least_flowtime(scenario)
    try:
        plan = solve(scenario, planner, options=STEPS.get(planner))
    except GaveUp:
        return
    except NoPlanExists:
        assert least is None
        return
    assert check(plan).ok
    assert not overlaps(scenario, list(plan.tracks))
    assert least is not None
    assert plan.flowtime >= least
    if "optimal" in plan.run.status or "best order of moves" in plan.run.status:
        assert plan.flowtime == least
