"""Planners find a plan where one exists, or prove that none does: instances are enumerated."""

from __future__ import annotations

import pytest

from rightofway import solve
from rightofway.errors import NoPlanExists
from rightofway.model import Scenario
from rightofway.search import ConflictBasedSearch
from tests.builders.closed_grids import (
    Grid,
    count_instances,
    list_axes,
    list_grids,
    make_instance,
)
from tests.oracles import joint_space

grids = pytest.mark.parametrize("grid", list_grids(), ids="/".join)


def check_instance(scenario: Scenario) -> None:
    """Compare with a search of all joint states, tick by tick, that knows no shortcut."""
    least = joint_space.least_flowtime(scenario)
    plan = ConflictBasedSearch(scenario.problem).search_together([0, 1], states=100_000)
    assert (plan.has_ended, plan.bound) == (True, least)
    try:
        solve(scenario, "prioritized", time_limit=None)
    except NoPlanExists:
        assert least is None
        return
    assert least is not None


@grids
def test_two_robots_on_a_small_grid_get_a_plan_or_a_right_proof(grid: Grid) -> None:
    axes = list_axes(grid)
    count = count_instances(axes)
    for number in range(0, count, count // 6 + 1):
        check_instance(make_instance(grid, axes, number))


@pytest.mark.parametrize("grid", [("....",), ("...", "@.@")], ids="/".join)
def test_a_robot_that_works_at_home_steps_aside_first_for_one_whose_home_closes(
    grid: Grid,
) -> None:
    """R1 drives to the home of R2, because its own home, vertex 0, is closed for a while.

    So R2, which works at its home for 4 ticks, has to leave it before it has worked there.
    """
    homes = [(0, 1), (0, 2), (0, 3)]
    axes = (homes, [(1, 0)], [(0, 4), (4, 4)], ["one", "both"], ["home"], [0], list_axes(grid)[-1])
    for number in range(0, count_instances(axes), 11):
        check_instance(make_instance(grid, axes, number))


@pytest.mark.slow
@grids
def test_more_instances_get_a_plan_or_a_right_proof(grid: Grid) -> None:
    axes = list_axes(grid)
    for number in range(1, count_instances(axes), 1009):
        check_instance(make_instance(grid, axes, number))


@pytest.mark.nightly
@grids
def test_every_instance_gets_a_plan_or_a_right_proof(grid: Grid) -> None:
    axes = list_axes(grid)
    for number in range(count_instances(axes)):
        check_instance(make_instance(grid, axes, number))
