"""The search by events: plans without fault, as early as their order allows, steps of LaCAM."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.errors import NoPlanExists
from rightofway.model import Plan, PlannerRun, Rules, Scenario, Track
from rightofway.planners import planning_problem
from rightofway.precedence import graph_of
from rightofway.search import plan_by_lacam
from tests.builders.fleets import grid_fleet
from tests.oracles.untimed_lacam import can_get_through, is_step

GRIDS = (["...", "@.@"], ["..", ".."], [".....", "@@.@@"], ["...", ".@.", "..."], ["...."])
SPEEDS = [Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(2, 5)]
PATIENCE = 20_000

law = settings(max_examples=80, derandomize=True, deadline=None)


@st.composite
def fleets(draw: st.DrawFn, *, own_speeds: bool = True) -> Scenario:
    """Draw up to four robots on a grid that is nearly full."""
    grid = draw(st.sampled_from(GRIDS))
    free = [f"N{k}" for k, cell in enumerate("".join(grid)) if cell == "."]
    homes = draw(st.lists(st.sampled_from(free), min_size=1, max_size=4, unique=True))
    targets = draw(st.permutations(free))[: len(homes)]
    if not own_speeds:
        rules = Rules(ends="none", rotations=draw(st.booleans()))
        return grid_fleet(grid, list(zip(homes, targets, strict=True)), rules=rules)
    rules = Rules(
        ends=draw(st.sampled_from(["home", "none"])),
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=draw(st.sampled_from([Fraction(0), Fraction(1, 2)])),
        rotations=draw(st.booleans()),
    )
    return grid_fleet(
        grid,
        list(zip(homes, targets, strict=True)),
        rules=rules,
        speeds=draw(st.lists(st.sampled_from(SPEEDS), min_size=1, max_size=4)),
        work=draw(st.lists(st.integers(0, 4), min_size=1, max_size=4)),
    )


def tracks_of(scenario: Scenario, seed: int = 0) -> list[Track] | None:
    return plan_by_lacam(planning_problem(scenario), seed=seed, most_effort=PATIENCE)


def may_rotate(scenario: Scenario) -> bool:
    rules = scenario.rules
    return rules.rotations and not rules.books_ahead and rules.headway == 0


@law
@given(fleets(), st.integers(0, 3))
def test_what_is_found_is_a_plan_without_fault(scenario: Scenario, seed: int) -> None:
    tracks = tracks_of(scenario, seed)
    if tracks is None:
        return
    assert can_get_through(scenario, may_rotate=may_rotate(scenario))
    plan = Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="lacam"))
    assert rightofway.check(plan).faults == ()


@law
@given(fleets())
def test_nobody_could_be_earlier_in_the_same_order(scenario: Scenario) -> None:
    tracks = tracks_of(scenario)
    assert tracks is None or graph_of(scenario, tracks).tracks() == tracks


@law
@given(fleets(), st.integers(0, 3))
def test_the_same_seed_gives_the_same_plan(scenario: Scenario, seed: int) -> None:
    assert tracks_of(scenario, seed) == tracks_of(scenario, seed)


@law
@given(fleets(own_speeds=False))
def test_with_equal_speeds_and_no_work_it_takes_steps_of_lacam(scenario: Scenario) -> None:
    """Robots that may not rotate keep a headway of a tick, so that nobody even follows."""
    tracks = tracks_of(scenario)
    if tracks is None:
        return
    last = max(int(track.enter[-1]) for track in tracks)
    steps = zip(*(at_each_tick(track, last) for track in tracks), strict=True)
    for at, after in pairwise(steps):
        assert is_step(scenario.roadmap, at, after, may_rotate=scenario.rules.rotations)


def at_each_tick(track: Track, last: int) -> list[int]:
    visits = np.searchsorted(track.enter, np.arange(last + 1), side="right") - 1
    places: list[int] = track.vertices[visits].tolist()
    return places


@law
@given(fleets())
def test_the_planner_finds_a_plan_exactly_where_there_is_one(scenario: Scenario) -> None:
    possible = can_get_through(scenario, may_rotate=may_rotate(scenario))
    try:
        rightofway.solve(scenario, "lacam", time_limit=60)
    except NoPlanExists:
        assert not possible
    else:
        assert possible
