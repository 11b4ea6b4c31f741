"""The search by events: plans as early as their order allows, steps of LaCAM, and a proof."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
from hypothesis import strategies as st

import rightofway
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Scenario, Track
from rightofway.precedence import build_graph_of_plan
from rightofway.search import plan_by_lacam
from tests.builders.any_fleet import FEATURES, any_fleet
from tests.builders.any_plan import planned
from tests.builders.laws import law, leave
from tests.oracles.all_steps import can_get_through, is_step

UNKNOWN = {"closures", "barred"}
"""Refused; the refusals have tests of their own."""


# Where robots may not rotate, the search keeps a tick between one that leaves and one that follows.
# Near robots with a size it is not as early as it could be.
@law(any_fleet(without={*UNKNOWN, "sizes"}), st.integers(0, 2**32 - 1))
def test_nobody_could_be_earlier_in_the_same_order(scenario: Scenario, seed: int) -> None:
    planned(scenario, "lacam")
    tracks = plan_by_lacam(scenario.problem, seed=seed, most_effort=20_000)
    if tracks is None:
        leave("the search gave up")
    assert build_graph_of_plan(scenario.problem, tracks).build_tracks() == tracks


def in_step(scenario: Scenario) -> Scenario:
    """Return the fleet with one way trips and nothing to do at their ends."""
    robots = tuple(
        replace(robot, stops=(replace(robot.stops[-1], work=Fraction(0)),))
        for robot in scenario.robots
    )
    return replace(scenario, robots=robots, rules=replace(scenario.rules, ends="none"))


@law(any_fleet(without=set(FEATURES) - {"no rotations", "one-way lanes", "layouts"}).map(in_step))
def test_with_equal_speeds_and_no_work_it_takes_steps_of_lacam(scenario: Scenario) -> None:
    """Robots that may not rotate keep a headway of a tick, so that nobody even follows."""
    tracks = planned(scenario, "lacam").tracks
    last = max(int(track.enter[-1]) for track in tracks)
    steps = zip(*(at_each_tick(track, last) for track in tracks), strict=True)
    for at, after in pairwise(steps):
        assert is_step(scenario, at, after, may_rotate=scenario.rules.rotations)


def at_each_tick(track: Track, last: int) -> list[int]:
    visits = np.searchsorted(track.enter, np.arange(last + 1), side="right") - 1
    places: list[int] = track.vertices[visits].tolist()
    return places


LARGE = {"spacing", "laps", "stops"}
"""Each multiplies the configurations of the oracle, so that a case would take seconds."""


@law(any_fleet(robots=(1, 3), without={*UNKNOWN, *LARGE, "passed", "sizes", "zones"}, tiny=True))
def test_the_planner_finds_a_plan_exactly_where_there_is_one(scenario: Scenario) -> None:
    """The oracle goes through all configurations of points on vertices.

    Where stops have a choice of directions, nothing is proven of those that were not chosen.
    """
    rotates = scenario.problem.booking_rules.may_rotate
    possible = can_get_through(scenario, may_rotate=rotates)
    try:
        rightofway.solve(scenario, "lacam", None)
    except NoPlanExists:
        assert not possible
    except GaveUp:
        assert scenario.problem.has_other_directions
        leave("other directions")
    else:
        assert possible
