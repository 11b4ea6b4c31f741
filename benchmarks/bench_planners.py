"""How long planners take, and how good their plans are, by number of robots."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

import rightofway
from rightofway.metrics import measure
from rightofway.model import Scenario
from rightofway.planners import Feature, find_all


@pytest.mark.parametrize("robots", [50, 100, 200, 400])
@pytest.mark.parametrize(
    "planner",
    sorted(name for name, spec in find_all().items() if Feature.LEAVES_SWAPS not in spec.features),
)
def test_planner(
    benchmark: BenchmarkFixture, fleet: Callable[[int], Scenario], planner: str, robots: int
) -> None:
    scenario = fleet(robots)
    plan = benchmark.pedantic(  # type: ignore[no-untyped-call]  # it has no types
        rightofway.solve, (scenario, planner), {"time_limit": 300}, rounds=3, iterations=1
    )
    metrics = measure(plan)
    benchmark.extra_info.update(
        ratio=round(metrics.flowtime / metrics.lower_bound, 3),
        decisions=len(plan.run.decisions),
        reroutes=len(plan.run.reroutes),
    )
