"""Executions of plans with jobs: whatever the delays, work keeps its times and its order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

import rightofway
from rightofway.check import check
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution.delays import delay_plan
from rightofway.io import parse_scenario
from rightofway.model import NEVER, Plan, Tick
from rightofway.precedence import ActionDependencyGraph, Execution
from tests.builders.laws import law, leave
from tests.builders.work_scenarios import draw_work_document

seeds = st.integers(0, 2**32 - 1)

DELAYS = ("exponential:0.5", "uniform:0..1", "chance:0.3x9", "exponential:0.1,chance:0.1x30")

OF_LATE_ROBOTS = {"wrong duration", "too late", "low battery", "stranded"}
"""Faults of plans that delays may cause: work that takes longer, and ends too late."""


def _plan(chance: int) -> Plan:
    """Return a plan of drawn jobs for up to three robots."""
    document = draw_work_document(chance, n_robots=3, n_jobs=4, states=chance % 2 == 0)
    document["rules"] |= {
        "turn": chance % 3,
        "return": "none" if chance % 5 == 0 else "home",
        "headway": int(chance % 7 == 0),
    }
    if chance % 11 == 0:
        document["rules"]["turn_rate"] = 90
    try:
        return rightofway.solve(parse_scenario(document), time_limit=0.2)
    except (GaveUp, NoPlanExists):
        leave("there is no plan, or the planner finds none")


def _execute(plan: Plan, delays: str, run: int) -> tuple[ActionDependencyGraph, Execution, Plan]:
    """Return a run, and the plan that it has been."""
    _, adg = delay_plan(plan, delays or ())
    execution = adg.execute(adg.delay_sample(0, run))
    assert plan.tours is not None
    times = zip(execution.begin.tolist(), execution.end.tolist(), strict=True)
    tours = []
    for tour in plan.tours:
        next(times)  # the robot is ready
        done = [(item, next(times)) for item in tour]
        tours.append(
            tuple(replace(item, begin=Tick(begin), end=Tick(end)) for item, (begin, end) in done)
        )
    tracks = adg.build_tracks(execution.enter)
    return adg, execution, replace(plan, tracks=tracks, tours=tuple(tours))


@law(seeds, st.sampled_from(DELAYS))
def test_late_robots_keep_earliest_the_order_of_jobs_and_their_distance(
    chance: int, delays: str
) -> None:
    adg, execution, done = _execute(_plan(chance), delays, chance % 10)
    assert adg.list_deadlocked() == []
    assert not execution.collisions[:3].any()
    assert (execution.completion < NEVER).all()
    assert {fault.kind for fault in check(done, limit=10**6).faults} <= OF_LATE_ROBOTS


@law(seeds)
def test_without_delays_jobs_are_done_as_planned_or_sooner(chance: int) -> None:
    plan = _plan(chance)
    adg, execution, done = _execute(plan, "", 0)
    assert check(done).ok
    assert (execution.enter <= adg.planned).all()
    assert adg.get_planned_completions().tolist() == list(plan.completions)
    assert execution.completion.tolist() == list(done.completions)
    assert (execution.completion <= np.array(plan.completions)).all()


@law(seeds)
def test_lateness_is_that_of_its_sources(chance: int) -> None:
    plan = _plan(chance)
    outcome = rightofway.simulate(plan, "exponential:0.3", runs=5, seed=chance)
    late = np.maximum(outcome.completion - np.array(plan.completions), 0).mean(axis=0)
    charged = [robot.own + sum(robot.waiting.values()) for robot in outcome.lateness.robots]
    assert np.allclose(late, charged, atol=1e-5)
