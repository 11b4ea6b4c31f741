"""Fleets with hardly any room: all but two places hold a robot, or the map is a trap."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

import rightofway
from rightofway.facts import Fact
from rightofway.metrics import measure
from rightofway.model import Occupancy, Rules, Scenario, Status
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.sizes import dense, with_radii

HARD = sorted((Path(__file__).parents[1] / "data" / "hard").glob("*.scen"))

# Whatever robot is taken away, the others can still reach each other everywhere.
BICONNECTED = {
    "3 x 3": ["..."] * 3,
    "4 x 4": ["...."] * 4,
    "2 x 4": ["...."] * 2,
    "ring with a chord": [".....", ".@.@.", "....."],
    "two loops": ["....", ".@@.", "....", ".@@.", "...."],
}


def all_but_two(grid: list[str], seed: int, rules: Rules, speeds: list[Fraction]) -> Scenario:
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    n_robots = len(free) - 2
    homes, targets = draw.sample(free, n_robots), draw.sample(free, n_robots)
    return grid_fleet(grid, list(zip(homes, targets, strict=True)), rules=rules, speeds=speeds)


@pytest.mark.parametrize("speeds", [[Fraction(1)], [Fraction(1), Fraction(1, 2), Fraction(1, 3)]])
@pytest.mark.parametrize("occupancy", ["one", "both"])
@pytest.mark.parametrize("grid", BICONNECTED.values(), ids=list(BICONNECTED))
def test_robots_everywhere_but_at_two_places_change_places(
    grid: list[str], occupancy: Occupancy, speeds: list[Fraction]
) -> None:
    for seed in range(5):
        rules = Rules(occupancy=occupancy, ends="none")
        plan = rightofway.solve(all_but_two(grid, seed, rules, speeds), "lacam", time_limit=60)
        assert rightofway.check(plan).ok


@pytest.mark.parametrize("occupancy", ["one", "both"])
@pytest.mark.parametrize("path", HARD, ids=[path.stem for path in HARD])
def test_hard_maps_are_solved(path: Path, occupancy: Occupancy) -> None:
    scenario = rightofway.load(path)
    scenario = replace(scenario, rules=replace(scenario.rules, occupancy=occupancy))
    assert rightofway.check(rightofway.solve(scenario, "lacam", time_limit=60)).ok


def test_there_are_hard_maps() -> None:
    assert len(HARD) == 6


def test_with_room_the_clocks_are_enough() -> None:
    plan = rightofway.solve(random_fleet(1, robots=20), "lacam")
    assert plan.run.status == Status("instants")


def test_without_rotations_a_full_hall_takes_the_order_of_moves_first() -> None:
    rules = Rules(occupancy="both", ends="none")
    scenario = all_but_two(["....."] * 5, 0, rules, [Fraction(1), Fraction(1, 2)])
    told: list[Fact | str] = []
    plan = rightofway.solve(scenario, "lacam", time_limit=60, report=told.append)
    assert plan.run.status == Status("moves")
    _, step, _ = told
    assert step == Fact("planning moves without clocks")


def test_a_large_robot_pushes_every_robot_in_its_way() -> None:
    """R2 and R3 stand beside the row in which R1 drives: 1 away, where 1.5 are needed."""
    trips = [("N17", "N22"), ("N12", "N12"), ("N28", "N28")]
    fleet = grid_fleet(["." * 8] * 5, trips, rules=Rules(ends="none"))
    plan = rightofway.solve(with_radii(fleet, list(map(Fraction, ["1.2", "0.3", "0.3"]))), "lacam")
    assert plan.run.status == Status("instants")
    visits = [len(track) for track in plan.tracks]
    assert visits[0] == 6
    assert min(visits[1:]) >= 3


@pytest.mark.parametrize(
    ("robots", "radii"), [(45, ["0.7"]), (130, ["0.45"]), (35, ["0.3", "0.7", "1"])]
)
def test_dense_fleets_of_robots_with_sizes_are_planned_by_instants(
    robots: int, radii: list[str]
) -> None:
    """Robots one after another find no way for the second fleet, and take seconds for the first."""
    plan = rightofway.solve(dense(0, size=16, robots=robots, radii=radii), "lacam")
    assert plan.run.status == Status("instants")
    assert rightofway.check(plan).ok


def test_robots_with_sizes_that_are_boxed_in_are_planned_by_single_moves() -> None:
    """Nine cells, seven robots: they fill the hall, so that nobody can be pushed far."""
    scenario = all_but_two(["..."] * 3, 0, Rules(ends="none"), [Fraction(1)])
    plan = rightofway.solve(with_radii(scenario, [Fraction("0.5")]), "lacam")
    assert rightofway.check(plan).ok


def test_spread_paths_are_better_than_shortest_ones_in_aisles() -> None:
    """Two long aisles, and three robots at each end have to get to the other."""
    grid = ["." * 20, "." + "@" * 18 + ".", "." * 20]
    rules = Rules(ends="none")
    trips = [(f"N{k}", f"N{(k + 17) % 34}") for k in (0, 1, 2, 17, 18, 19)]
    scenario = grid_fleet(grid, trips, rules=rules)
    flowtimes = [
        measure(rightofway.solve(scenario, "lacam", options={"paths": paths})).flowtime
        for paths in ("spread", "shortest")
    ]
    assert flowtimes[0] < flowtimes[1]
