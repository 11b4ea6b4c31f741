"""The robots that are said to block each other do so, and none of them can be left out."""

from dataclasses import replace

from hypothesis import strategies as st

from rightofway.errors import NoPlanExists
from rightofway.model import Rules, Scenario
from rightofway.model.deadline import Deadline
from rightofway.planners.impossible import blocking_set
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law, leave
from tests.oracles.all_steps import can_get_through

GRIDS = (["...", "@.@"], [".....", "@@.@@"], ["....", "@@@@", "...."], ["......"])


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    """Draw two to four robots on a narrow grid, each with home and target in one row."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    homes = draw(st.lists(st.sampled_from(free), min_size=2, max_size=4, unique=True))
    columns = len(grid[0])
    trips = []
    for home in homes:
        row = int(home[1:]) // columns
        near = [place for place in free if int(place[1:]) // columns == row]
        trips.append((home, draw(st.sampled_from(near))))
    return grid_fleet(grid, trips, rules=Rules(ends="home"))


def has_plan(scenario: Scenario, names: tuple[str, ...]) -> bool:
    kept = tuple(robot for robot in scenario.robots if robot.name in names)
    return can_get_through(replace(scenario, robots=kept), may_rotate=True)


@law(fleets())
def test_a_blocking_set_is_blocked_and_minimal(scenario: Scenario) -> None:
    everybody = tuple(robot.name for robot in scenario.robots)
    if has_plan(scenario, everybody):
        leave("a plan exists")
    blockage = blocking_set(scenario, range(len(everybody)), seed=0, deadline=Deadline())
    assert not has_plan(scenario, blockage.robots)
    for name in blockage.robots:
        fewer = tuple(other for other in blockage.robots if other != name)
        assert not fewer or has_plan(scenario, fewer)
    assert NoPlanExists([blockage]).robots == blockage.robots
