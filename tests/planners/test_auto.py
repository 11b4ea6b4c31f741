"""The default planner: several methods, the best of them, and better."""

from __future__ import annotations

from pathlib import Path

import pytest

import rightofway
from rightofway.bench.fleets import make_scenario_document
from rightofway.io import load_plan, parse_scenario, write_plan
from rightofway.metrics import measure
from rightofway.model import Plan, Rules, Status
from tests.builders.fleets import grid_fleet, random_fleet

CROWDED = random_fleet(3, size=9, robots=12, rules=Rules(occupancy="both"))


def test_it_is_the_default() -> None:
    assert rightofway.solve(grid_fleet(["..."], [("N0", "N2")])).run.name == "auto"


@pytest.mark.parametrize("other", ["two-level", "lacam", "prioritized"])
def test_it_is_no_worse_than_what_it_starts_from(other: str) -> None:
    plan = rightofway.solve(CROWDED, options={"iterations": 100})
    assert measure(plan).flowtime <= measure(rightofway.solve(CROWDED, other)).flowtime


def test_where_nothing_better_is_found_the_decisions_of_two_level_are_kept() -> None:
    door = rightofway.load("examples/door.yaml")
    plan, two_level = rightofway.solve(door), rightofway.solve(door, "two-level")
    assert plan.run.decisions == two_level.run.decisions
    first = Status("by planner", planner="two-level", status=Status("waits only"))
    assert plan.run.status == Status("proven by search", nodes=0, status=first)


def test_it_tells_when_its_first_plan_was_there(tmp_path: Path) -> None:
    """The file, which promises to be the same for the same seed, does not."""
    plan = rightofway.solve(rightofway.load("examples/door.yaml"), options={"iterations": 2000})
    assert plan.run.first_plan_seconds is not None
    assert plan.run.seconds is not None
    assert 0 < plan.run.first_plan_seconds < plan.run.seconds
    write_plan(plan, tmp_path / "plan.json")
    assert load_plan(tmp_path / "plan.json").run.first_plan_seconds is None


def test_a_large_fleet_has_a_first_plan_long_before_its_last() -> None:
    plan = rightofway.solve(random_fleet(1, size=32, robots=90), time_limit=3)
    assert plan.run.first_plan_seconds is not None
    assert plan.run.first_plan_seconds < 1.5


@pytest.mark.parametrize("planner", ["auto", "lns"])
def test_where_lacam_finds_no_plan_the_cheap_plan_is_first(planner: str) -> None:
    """LaCAM finds none in 20 s; one after another takes some hundredths of a second."""
    problem = {"random": {"width": 32, "height": 32, "walls": 0.2, "seed": 1}}
    speeds = ["1", "1/2", "1/3"]
    fleet = {"speeds": speeds, "work": [0, 5], "rules": {}, "by_seed": True}
    scenario = parse_scenario(make_scenario_document(problem, fleet, robots=100, seed=2))
    plans: list[Plan] = []
    options = {"iterations": 20} | ({"nodes": 1} if planner == "auto" else {})
    found = rightofway.solve(
        scenario, planner, time_limit=20, options=options, on_plan=plans.append
    )
    assert found.run.first_plan_seconds is not None
    assert found.run.first_plan_seconds < 2
    assert found.flowtime < plans[0].flowtime
    assert str(found.run.status).endswith("(first plan: one after another)")


def test_a_proven_optimum_ends_it() -> None:
    plan = rightofway.solve(rightofway.load("examples/floor.yaml"), time_limit=None)
    assert plan.run.status == Status("optimum found by search", nodes=1)


def test_a_large_fleet_is_not_held_up_by_two_level() -> None:
    plan = rightofway.solve(random_fleet(1, size=32, robots=90), options={"iterations": 10})
    assert "two-level" not in str(plan.run.status)
    assert rightofway.check(plan).ok


def test_the_published_method_is_at_hand() -> None:
    door_5 = grid_fleet(["...", "@.@", "..."], [("N0", "N6"), ("N2", "N8")])
    plan = rightofway.solve(door_5, options={"swaps": "leave"})
    assert plan.run.status == Status("waits only")


def test_without_rotations_its_plans_have_none() -> None:
    rules = Rules(rotations=False)
    for seed in (24, 29, 112):
        fleet = random_fleet(seed, size=6, robots=9, walls=0.05, rules=rules)
        plan = rightofway.solve(fleet, options={"iterations": 200})
        assert rightofway.check(plan).ok
        first = rightofway.solve(fleet, "two-level")
        assert measure(plan).flowtime <= measure(first).flowtime
