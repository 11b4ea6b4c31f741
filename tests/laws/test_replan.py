"""When robots break down the rest finish, wherever that is possible at all."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence

import numpy as np
from hypothesis import strategies as st

from rightofway.execution.forecast import Forecast
from rightofway.execution.monitor import ExecutionMonitor, ExecutionPolicy
from rightofway.execution.progress import derive_progress
from rightofway.execution.replan import find_commitment, find_held_by_broken, replan
from rightofway.model import NEVER, Plan, Scenario, Stage, Tick
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, DelayModel, Stoppage
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.executions import ONE_CHAIN, judge_trace
from tests.builders.laws import law
from tests.oracles.cut_off import most_who_can_finish

MEETINGS = {"vertex conflict", "swap conflict", "headway", "rotation", "zone conflict"}
MEETINGS |= {"space conflict", "too close"}

planners, seeds = st.sampled_from(STRICT), st.integers(0, 2**32 - 1)


def with_breakdowns(draw: random.Random, plan: Plan, most: int) -> ActionDependencyGraph:
    last = max(int(track.enter[-1]) for track in plan.tracks)
    robots = range(len(plan.tracks))
    broken = draw.sample(robots, draw.randint(1, most))
    slow = draw.choice(robots)
    delays = DelayModel(
        random=draw.choice([(), (("exponential", 0.3, 0.0),), (("chance", 0.1, 5.0),)]),
        pace=tuple(1.6 if robot == slow else 1.0 for robot in robots),
        stoppages=tuple(
            (Stoppage(Tick(draw.randint(0, last)), NEVER),) if robot in broken else ()
            for robot in robots
        ),
    )
    return ActionDependencyGraph(plan.scenario, plan.tracks, delays)


def most_by_brute_force(forecast: Forecast, stages: Sequence[tuple[Stage, ...]]) -> int:
    kept = [find_commitment(forecast, robot, own) for robot, own in enumerate(stages)]
    goals = [
        [
            *([] if one.drives_to is None else [int(one.drives_to)]),
            *(int(stage.vertex) for stage in one.left),
        ]
        or [int(one.vertex)]
        for one in kept
    ]
    scenario = forecast.adg.scenario
    may_rotate = scenario.rules.occupancy == "one" and scenario.problem.booking_rules.headway == 0
    return most_who_can_finish(
        scenario,
        [one.vertex for one in kept],
        goals,
        forecast.broken,
        find_held_by_broken(forecast).vertices,
        may_rotate=may_rotate,
    )


@law(any_fleet(robots=(2, 3), without=ONE_CHAIN, tiny=True), planners, seeds)
def test_as_many_finish_as_brute_force_finds(fleet: Scenario, planner: str, chance: int) -> None:
    """One robot breaks down; no other choice of robots that are cut off would be smaller."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    adg = with_breakdowns(draw, plan, most=1)
    sample = adg.delay_sample(chance, 0)
    since, broken = min((sample.find_breakdown(robot), robot) for robot in range(len(plan.tracks)))
    run = adg.execute(sample)
    forecast = Forecast(adg, derive_progress(adg, sample, run, since, frozenset({broken})))
    stages = tuple(one.stages for one in plan.scenario.problem.itineraries)
    replanned = replan(forecast, stages, 0, Deadline())
    assert replanned
    finishing = len(plan.tracks) - 1 - len(replanned[0].cut_off)
    assert all(one.cut_off == replanned[0].cut_off for one in replanned)
    assert finishing == most_by_brute_force(forecast, stages)


@law(any_fleet(robots=(2, 4)), planners, seeds, st.booleans())
def test_no_robots_collide_over_all_plans_of_a_run_and_the_rest_complete(
    fleet: Scenario, planner: str, chance: int, switch: bool
) -> None:
    """A closure may catch a robot that is late, and keep it or others from completing."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    adg = with_breakdowns(draw, plan, most=2)
    policy = ExecutionPolicy(switch=switch, replan=True)
    monitor = ExecutionMonitor(adg, policy, chance, 0, Deadline())
    tracks = monitor.adg.build_tracks(monitor.execution.enter)
    faults = judge_trace(plan, monitor.trace())
    assert not MEETINGS & {fault.kind for fault in faults}
    assert not monitor.execution.collisions[:3].any()
    for robot, completion in enumerate(monitor.completion.tolist()):
        assert completion < NEVER or robot in monitor.lost | monitor.cut_off or fleet.closures
        own = Counter(fault.kind for fault in faults if fault.robots == (robot,))
        assert bool(own.pop("closed", 0)) <= bool(monitor.execution.is_caught[robot])
        if completion < NEVER:
            assert not own, faults
            assert completion >= int(tracks[robot].enter[-1])
    assert all(np.all(np.diff(track.enter) > 0) for track in tracks)
