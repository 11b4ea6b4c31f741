"""The script of proofs draws its fleets, and its table of gaps can be made."""

from __future__ import annotations

from fractions import Fraction

import pytest

from benchmarks.proofs import fleet, gaps, line_of_gaps
from rightofway.model import Objective

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("objective", [Objective.FLOWTIME, Objective.MAKESPAN])
def test_plans_are_compared_with_a_proven_optimum_or_a_bound(objective: Objective) -> None:
    is_proven, above = gaps(fleet(None, "6x10", 3, 1, classic=False), 0.9, objective)
    assert len(above) == 3
    assert all(gap is None or gap >= 0 for gap in above)
    assert line_of_gaps([(is_proven, above)])[0] == f"{is_proven:d} of 1"


def test_a_fleet_of_discs_drives_on_a_roadmap_with_lanes_that_cross() -> None:
    scenario = fleet(None, "discs", 10, 1, classic=False)
    assert scenario.roadmap.n_vertices == 900
    assert 6000 < scenario.roadmap.n_edges < 8000
    assert {robot.radius for robot in scenario.robots} == {Fraction("0.35")}
