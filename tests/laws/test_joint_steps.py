"""The search for the whole fleet finds steps wherever there are any, and proves it where not."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.errors import NoPlanExists
from rightofway.model import Plan, PlannerRun, Rules, Scenario
from rightofway.planners.lacam import timetable_of
from rightofway.search import untimed_lacam
from tests.builders.fleets import grid_fleet
from tests.oracles.joint import can_get_through, is_step

GRIDS = (["...", "@.@"], ["..", ".."], [".....", "@@.@@"], ["...", ".@.", "..."], ["...."])


@st.composite
def fleets(draw: st.DrawFn) -> Scenario:
    """Draw up to four robots on a grid that is nearly full."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    homes = draw(st.lists(st.sampled_from(free), min_size=1, max_size=4, unique=True))
    targets = draw(st.permutations(free))[: len(homes)]
    rules = Rules(
        ends=draw(st.sampled_from(["home", "none"])),
        occupancy=draw(st.sampled_from(["one", "both"])),
    )
    return grid_fleet(grid, list(zip(homes, targets, strict=True)), rules=rules)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(fleets(), st.integers(0, 3))
def test_steps_are_found_exactly_where_there_are_any(scenario: Scenario, seed: int) -> None:
    may_rotate = scenario.rules.occupancy == "one"
    try:
        steps = untimed_lacam(scenario, seed=seed)
    except NoPlanExists:
        assert not can_get_through(scenario, may_rotate=may_rotate)
        return
    assert can_get_through(scenario, may_rotate=may_rotate)
    for at, after in zip(steps[:-1].tolist(), steps[1:].tolist(), strict=True):
        assert is_step(scenario.roadmap, at, after, may_rotate=may_rotate)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(fleets())
def test_the_timetable_of_steps_is_a_plan_without_fault(scenario: Scenario) -> None:
    try:
        steps = untimed_lacam(scenario)
    except NoPlanExists:
        return
    tracks = tuple(timetable_of(scenario, steps))
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="joint"))
    assert rightofway.check(plan).faults == ()
