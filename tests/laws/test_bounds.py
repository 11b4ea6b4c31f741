"""Lower bounds by prices of places: never above a plan, and far above the robots alone."""

from __future__ import annotations

import pytest
from hypothesis import strategies as st

from rightofway import solve
from rightofway.model import Scenario, compute_cost
from rightofway.repair.bounds import prove_bound
from rightofway.search import PriceAscent, compute_least_completions
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.fleets import random_fleet
from tests.builders.laws import law, leave
from tests.builders.tiny import KINDS, least_cost

kinds, seeds = st.sampled_from(sorted(KINDS)), st.integers(0, 10**6)


@law(kinds, seeds, st.integers(1, 200))
def test_no_prices_bound_a_tiny_fleet_above_its_optimum(kind: str, seed: int, steps: int) -> None:
    scenario = KINDS[kind](seed)
    alone = compute_least_completions(scenario)
    if alone is None or alone.min() < 0:
        leave("a robot cannot reach its places")
    least = least_cost(kind, scenario)
    if least is None:
        leave("no plan exists")
    prices = PriceAscent(scenario.problem)
    prices.run(steps=steps)
    assert prices.bound <= least


@law(any_fleet(), st.sampled_from(STRICT), st.integers(1, 100))
def test_no_plan_of_any_fleet_costs_less_than_prices_say(
    scenario: Scenario, planner: str, steps: int
) -> None:
    plan = planned(scenario, planner)
    prices = PriceAscent(scenario.problem)
    prices.run(steps=steps)
    assert prices.bound <= compute_cost(scenario, plan.tracks)


@law(any_fleet(), st.integers(1, 20), st.integers(1, 20))
def test_more_steps_never_lower_the_bound_and_parts_are_as_good_as_one_run(
    scenario: Scenario, first: int, more: int
) -> None:
    alone = compute_least_completions(scenario)
    if alone is None or alone.min() < 0:
        leave("a robot cannot reach its places")
    whole, in_parts = PriceAscent(scenario.problem), PriceAscent(scenario.problem)
    in_parts.run(steps=first)
    before = in_parts.bound
    in_parts.run(steps=more)
    whole.run(steps=first + more)
    assert before <= in_parts.bound == whole.bound


@law(kinds, seeds)
def test_no_bound_of_two_methods_in_turn_is_above_the_optimum_of_a_tiny_fleet(
    kind: str, seed: int
) -> None:
    """The time limit lets both methods go on after their first turns."""
    scenario = KINDS[kind](seed)
    alone = compute_least_completions(scenario)
    if alone is None or alone.min() < 0:
        leave("a robot cannot reach its places")
    least = least_cost(kind, scenario)
    if least is None:
        leave("no plan exists")
    proof, is_reached = prove_bound(scenario, time_limit=0.05)
    assert proof.bound == least if is_reached else proof.bound <= least


@pytest.mark.parametrize("robots", [40, pytest.param(60, marks=pytest.mark.slow)])
def test_prices_close_a_third_of_the_gap_of_a_full_floor(robots: int) -> None:
    """Random 20 x 20 grids of points of one speed."""
    scenario = random_fleet(1, size=20, robots=robots)
    plan = solve(scenario, "lns", iterations=2000, time_limit=None)
    proof, _ = prove_bound(scenario, nodes=1, steps=300)
    assert proof.bound - plan.lower_bound >= (plan.flowtime - plan.lower_bound) / 3
