"""The robots that are said to block each other do so, and none of them can be left out."""

from dataclasses import replace

import pytest
from hypothesis import strategies as st

import rightofway
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Rules, Scenario
from rightofway.repair.impossible import refuse_blocked
from rightofway.repair.plan_request import PlanRequest
from tests.builders.any_plan import QUICK
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law, leave
from tests.oracles.all_steps import can_get_through

GRIDS = (["...", "@.@"], [".....", "@@.@@"], ["....", "@@@@", "...."], ["......"])


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    """Draw two to four robots on a narrow grid, each with home and target in one row.

    In most fleets the first two have to pass each other in a row, which most grids make impossible.
    """
    grid, pass_each_other = draw(st.sampled_from(GRIDS)), draw(st.sampled_from((True, True, False)))
    columns = len(grid[0])
    free = [k for k, cell in enumerate("".join(grid)) if cell == "."]
    homes = draw(st.lists(st.sampled_from(free), min_size=2, max_size=4, unique=True))
    if pass_each_other:
        rows = [[k for k in free if k // columns == row] for row in range(len(grid))]
        row = draw(st.sampled_from([row for row in rows if len(row) > 1]))
        left, right = sorted(draw(st.sets(st.sampled_from(row), min_size=2, max_size=2)))
        homes = [left, right, *(home for home in homes if home not in {left, right})]
    trips = []
    for number, home in enumerate(homes):
        near = [k for k in free if k // columns == home // columns]
        if pass_each_other and number == 0:
            near = [k for k in near if k >= homes[1]]
        elif pass_each_other and number == 1:
            near = [k for k in near if k <= homes[0]]
        trips.append((f"N{home}", f"N{draw(st.sampled_from(near))}"))
    return grid_fleet(grid, trips, rules=Rules(ends="home"))


def has_plan(scenario: Scenario, names: tuple[str, ...]) -> bool:
    kept = tuple(robot for robot in scenario.robots if robot.name in names)
    return can_get_through(replace(scenario, robots=kept), may_rotate=True)


@law(fleets())
def test_a_blocking_set_is_blocked_and_minimal(scenario: Scenario) -> None:
    everybody = tuple(robot.name for robot in scenario.robots)
    if has_plan(scenario, everybody):
        leave("a plan exists")
    with pytest.raises(NoPlanExists) as proof:
        refuse_blocked(PlanRequest(scenario=scenario))
    check_minimal(scenario, proof.value)


@law(fleets(), st.sampled_from(("auto", "cbs", "lacam")))
def test_every_planner_names_a_minimal_set(scenario: Scenario, planner: str) -> None:
    try:
        rightofway.solve(scenario, planner, time_limit=None, options=QUICK.get(planner))
    except NoPlanExists as proof:
        check_minimal(scenario, proof)
        return
    except GaveUp:
        leave("the planner gave up")
    assert has_plan(scenario, tuple(robot.name for robot in scenario.robots))


def check_minimal(scenario: Scenario, proof: NoPlanExists) -> None:
    for blockage in proof.blockages:
        names = tuple(scenario.robots[robot].name for robot in blockage.robots)
        assert not has_plan(scenario, names)
        for name in names:
            fewer = tuple(other for other in names if other != name)
            assert not fewer or has_plan(scenario, fewer)
