"""Robots with a size that are late: by right of way they never come too near to each other."""

from __future__ import annotations

from dataclasses import replace

import pytest

import rightofway
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Plan, PlannerRun, Track
from tests.builders.seeds import seeds
from tests.builders.sizes import crossing, sized, sized_on_lanes

DELAYS = ("exponential:0.5", "chance:0.1x15", "uniform:-0.3..1", "breaks:0.1")
APART = {"vertex conflict", "headway", "space conflict", "too close", "swap conflict"}


@pytest.mark.parametrize("seed", seeds(24, 2))
def test_no_collision_and_no_deadlock_in_any_run(seed: int) -> None:
    """The judge looks at a run; it assumes that drives take as long as planned, or longer."""
    scenario = (sized if seed % 2 else sized_on_lanes)(seed + 200)
    try:
        plan = rightofway.solve(scenario, "prioritized")
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    for delays in DELAYS:
        outcome = rightofway.simulate(plan, delays, runs=30)
        assert (outcome.collisions, outcome.deadlocks) == (0, 0)
        if "breaks" not in delays:
            assert outcome.stranded == 0
        if "-" not in delays:
            judged = rightofway.check(replace(plan, tracks=outcome.trace(7).tracks))
            assert not APART & set(judged.counts)


def one_after_another() -> Plan:
    """Return a plan in which R2 starts to cross the way of R1 when R1 is there, after 4 of 8."""
    tracks = Track.of([0, 1], [0, 4]), Track.of([2, 3], [0, 8])
    return Plan(scenario=crossing(), tracks=tracks, run=PlannerRun(name="by hand"))


def test_a_late_robot_makes_others_wait_where_lanes_cross() -> None:
    """R1 stands still for 3 before it starts: by the clock R2 crosses its way."""
    plan = one_after_another()
    assert plan.scenario.problem.clock.tick == 1
    outcome = rightofway.simulate(plan, "stop:R1@0+3", runs=1)
    assert [track.enter.tolist() for track in outcome.trace(0).tracks] == [[0, 7], [0, 11]]
    assert (outcome.by_right_of_way.vertex, outcome.by_clock.vertex) == (0, 1)


def test_a_plan_is_not_changed_on_the_way() -> None:
    with pytest.raises(
        InputError, match="replanning during execution does not know robots with a size"
    ):
        rightofway.simulate(one_after_another(), runs=1, replan=True)
