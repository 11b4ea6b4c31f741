"""The script of jobs draws fleets, and plans each of them in both ways."""

from __future__ import annotations

import pytest

from benchmarks.jobs import assign_then_plan, draw_fleet, plan_together

pytestmark = pytest.mark.slow


def test_a_drawn_fleet_is_planned_in_both_ways() -> None:
    scenario = draw_fleet(3, 6, seed=1)
    assert min(assign_then_plan(scenario, 1), plan_together(scenario, 1)) > 0
