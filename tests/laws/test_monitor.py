"""Changes during execution never make robots collide or deadlock, and never change the past."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import strategies as st

import rightofway
from rightofway.execution.forecast import Forecast
from rightofway.execution.monitor import ExecutionMonitor, ExecutionPolicy
from rightofway.model import NEVER, Rules, Scenario, Tick
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, DelayModel, Stoppage
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.executions import ONE_CHAIN, judge_trace, late, oracle_of, times
from tests.builders.fleets import random_fleet
from tests.builders.laws import law
from tests.oracles import execution

POLICIES = (
    ExecutionPolicy(switch=True),
    ExecutionPolicy(replan=True),
    ExecutionPolicy(switch=True, replan=True),
)
CLOSURES = {"closures"}
"""Refused: the refusal has a test of its own."""

planners, policies = st.sampled_from(STRICT), st.sampled_from(POLICIES)
seeds = st.integers(0, 2**32 - 1)


@law(any_fleet(without=ONE_CHAIN), planners, seeds, policies)
def test_robots_that_look_find_the_new_plan_possible(
    fleet: Scenario, planner: str, chance: int, policy: ExecutionPolicy
) -> None:
    adg = late(planned(fleet, planner), random.Random(chance))  # noqa: S311
    monitor = ExecutionMonitor(adg, policy, chance, 0, Deadline())
    slow = oracle_of(monitor.adg, monitor.delay_sample)
    expected = execution.by_right_of_way(slow)
    assert times(monitor.execution) == times(expected)
    assert execution.collisions(slow, expected)[:3] == (0, 0, 0)
    assert monitor.adg.list_deadlocked() == []


@law(
    any_fleet(without=CLOSURES) | any_fleet(without=CLOSURES, always={"passed"}),
    planners,
    seeds,
    policies,
)
def test_the_judge_finds_all_work_done_and_no_robots_meeting(
    fleet: Scenario, planner: str, chance: int, policy: ExecutionPolicy
) -> None:
    """Robots are late, never early: the judge would find them too fast."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    delays = DelayModel(
        random=draw.choice([(("chance", 0.1, 9.0),), (("exponential", 0.5, 0.0),)]),
        pace=tuple(draw.choice([1.0, 1.0, 2.0]) for _ in plan.tracks),
        stoppages=tuple(() for _ in plan.tracks),
    )
    adg = ActionDependencyGraph(fleet, plan.tracks, delays)
    monitor = ExecutionMonitor(adg, policy, chance, 0, Deadline())
    assert (monitor.completion < NEVER).all()
    assert judge_trace(plan, monitor.trace()) == []


@law(any_fleet(without=CLOSURES), planners, policies)
def test_nothing_is_changed_where_no_robot_is_late(
    fleet: Scenario, planner: str, policy: ExecutionPolicy
) -> None:
    plan = planned(fleet, planner)
    adg = ActionDependencyGraph(fleet, plan.tracks, DelayModel.none(len(plan.tracks)))
    assert ExecutionMonitor(adg, policy, 0, 0, Deadline()).adg is adg


def booked_until(monitor: ExecutionMonitor, tick: int) -> list[list[tuple[int, int]]]:
    """Return for each robot which vertices it has booked before a tick, since when."""
    adg, start = monitor.adg, monitor.execution.start
    ranges = pairwise(adg.first_visit.tolist())
    visits = [[visit for visit in range(i, j) if start[visit] < tick] for i, j in ranges]
    return [[(int(adg.vertex[x]), int(start[x])) for x in one] for one in visits]


class Witness(ExecutionMonitor):
    """Looks at each forecast whether the past is as it was at the forecast before."""

    last: tuple[int, list[list[tuple[int, int]]]] = (0, [])
    seen = 0

    def make_forecast(self, now: int) -> Forecast:
        self.look()
        self.last = (now, booked_until(self, now))
        return super().make_forecast(now)

    def look(self) -> None:
        tick, before = self.last
        assert not before or booked_until(self, tick) == before
        Witness.seen += self.switches + self.replans


@law(any_fleet(without=CLOSURES), planners, seeds, policies)
def test_no_change_reaches_into_the_past(
    fleet: Scenario, planner: str, chance: int, policy: ExecutionPolicy
) -> None:
    """A robot that has waited until now for its right of way goes now, not earlier."""
    adg = late(planned(fleet, planner), random.Random(chance))  # noqa: S311
    Witness(adg, policy, chance, 0, Deadline()).look()


def test_the_witness_has_seen_changes() -> None:
    plan = rightofway.solve(
        random_fleet(0, size=5, robots=5, rules=Rules(occupancy="both")), "two-level"
    )
    delays = replace(DelayModel.none(len(plan.tracks)), random=(("chance", 0.1, 20.0),))
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
    for run in range(20):
        Witness(adg, POLICIES[2], run, 0, Deadline()).look()
    assert Witness.seen > 0


@law(any_fleet(without=CLOSURES), planners, seeds, st.integers(1, 40), policies)
def test_what_is_still_to_come_decides_nothing(
    fleet: Scenario, planner: str, chance: int, cut: int, policy: ExecutionPolicy
) -> None:
    """Runs with the same stops before a tick are the same until that tick."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    stops = [
        Stoppage(Tick(draw.randint(0, 30)), Tick(draw.choice([3, 10, 20]))) for _ in plan.tracks
    ]
    seen = []
    for later in ([], [Stoppage(Tick(cut), Tick(50))], [Stoppage(Tick(cut), NEVER)]):
        each = [[stop] for stop in stops]
        each[0] = sorted([stop for stop in each[0] if sum(stop) < cut] + later)
        delays = DelayModel.none(len(plan.tracks))
        stoppages = tuple(tuple(one) for one in each)
        adg = ActionDependencyGraph(
            plan.scenario, plan.tracks, replace(delays, stoppages=stoppages)
        )
        seen.append(booked_until(ExecutionMonitor(adg, policy, 0, 0, Deadline()), cut))
    assert seen[0] == seen[1] == seen[2]


@pytest.mark.slow
@pytest.mark.parametrize("policy", POLICIES)
def test_changes_gain_on_average(policy: ExecutionPolicy) -> None:
    """Robots stop now and then: keeping the order makes the others wait for nothing."""
    scenario = random_fleet(1, size=12, robots=12)
    plan = rightofway.solve(scenario, "local-search", None)
    outcome = rightofway.simulate(
        plan, "chance:0.03x20", runs=20, switch=policy.switch, replan=policy.replan
    )
    assert outcome.gain is not None
    assert outcome.gain.runs == 20
    assert outcome.gain.earlier > outcome.gain.later
    kept = rightofway.simulate(plan, "chance:0.03x20", runs=20)
    won = (kept.completion.sum(axis=1) - outcome.completion.sum(axis=1)).mean()
    assert outcome.gain.flowtime.mean == round(won, 6) > 0


def test_replanning_gains_where_switching_cannot() -> None:
    """R10 is slow: on the same routes nothing is to be won, by another way 20 ticks."""
    plan = rightofway.solve(random_fleet(2, size=12, robots=10), "two-level", None)
    won = []
    for switch, replan in ((True, False), (False, True)):
        outcome = rightofway.simulate(plan, "slow:R10x2", runs=1, switch=switch, replan=replan)
        assert outcome.gain is not None
        won.append(outcome.gain.flowtime.mean)
    assert won == [0, 20]
