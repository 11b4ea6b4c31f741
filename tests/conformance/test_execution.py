"""Plans of every planner with delays: by right of way no robots ever collide or deadlock."""

from __future__ import annotations

from itertools import product

import pytest

import rightofway
from rightofway.model import Plan, Track
from tests.builders.executions import judge_trace
from tests.builders.small import SMALL, STRICT

DELAYS = (
    "exponential:0.3",
    "uniform:-0.3..1",
    "chance:0.05x15,slow:R1x2",
    "breaks:0.1,early:R1x0.5",
)
EARLY = DELAYS[1::2]
MEETINGS = {"vertex conflict", "swap conflict", "headway", "rotation"}


@pytest.mark.parametrize("name", SMALL)
def test_no_collision_and_no_deadlock_in_any_run(name: str) -> None:
    """The judge looks at a run of each, as a second opinion; equal plans are driven once.

    It assumes that drives take as long as planned, so where robots book ahead it is not asked about
    robots that are faster.
    """
    plans = dict[tuple[Track, ...], Plan]()
    for planner in STRICT:
        plan = rightofway.solve(SMALL[name], planner, time_limit=1)
        plans.setdefault(plan.tracks, plan)
    for plan, delays in product(plans.values(), DELAYS):
        about = plan.run.name, delays
        outcome = rightofway.simulate(plan, delays, runs=50)
        changed = rightofway.simulate(plan, delays, runs=2, switch=True, replan=True)
        for one in (outcome, changed):
            assert (one.collisions, one.deadlocks) == (0, 0), about
        assert changed.stranded == 0, about
        faults = judge_trace(plan, outcome.trace(7))
        if delays not in EARLY or not plan.scenario.problem.booking_rules.books_ahead:
            assert not MEETINGS & {fault.kind for fault in faults}, about
        if delays == DELAYS[0]:
            assert faults == [], about
