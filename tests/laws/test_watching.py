"""A plan that is changed on the way never makes robots collide or deadlock, and never the past."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rightofway
from rightofway.check import check
from rightofway.execution.forecast import Forecast
from rightofway.execution.monitor import Draw, ExecutionMonitor
from rightofway.model import NEVER, Tick
from rightofway.precedence import ActionDependencyGraph, DelayModel, DelaySample
from tests.builders.fleets import random_fleet
from tests.laws.test_late_floor import RULES, oracle_of, some_hazards, some_plan, times
from tests.oracles import late_floor

MEETINGS = {"vertex conflict", "swap conflict", "headway", "rotation"}
CARES = ((True, False), (False, True), (True, True))


def watched(
    floor: ActionDependencyGraph,
    chance: int,
    care: tuple[bool, bool],
    kind: type[ExecutionMonitor] = ExecutionMonitor,
) -> ExecutionMonitor:
    switch, replan = care

    def draw(one: ActionDependencyGraph) -> DelaySample:
        return one.delay_sample(chance, 0)

    return kind(floor, draw(floor), switch=switch, draw=draw if replan else None, seed=chance)


@given(
    seed=st.integers(0, 5),
    rules=st.integers(0, len(RULES) - 1),
    chance=st.integers(0, 2**32 - 1),
    care=st.sampled_from(CARES),
)
@settings(max_examples=100, deadline=None)
def test_robots_that_look_find_the_new_plan_possible(
    seed: int, rules: int, chance: int, care: tuple[bool, bool]
) -> None:
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = some_hazards(draw, len(plan.tracks), 20)
    watch = watched(ActionDependencyGraph(plan.scenario, plan.tracks, hazards), chance, care)
    floor, found = watch.floor, watch.floor.execute(watch.delay_sample)
    slow = oracle_of(floor, watch.delay_sample)
    expected = late_floor.by_right_of_way(slow)
    assert times(found) == times(expected)
    assert late_floor.collisions(slow, expected)[:3] == (0, 0, 0)
    assert floor.deadlocked() == []


@given(
    seed=st.integers(0, 5),
    rules=st.integers(0, len(RULES) - 1),
    chance=st.integers(0, 2**32 - 1),
    care=st.sampled_from(CARES),
)
@settings(max_examples=100, deadline=None)
def test_the_judge_finds_everything_done_and_nobody_meeting(
    seed: int, rules: int, chance: int, care: tuple[bool, bool]
) -> None:
    """Robots are late, never early: the judge would find them too fast."""
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = DelayModel(
        random=draw.choice([(("chance", 0.1, 9.0),), (("exponential", 0.5, 0.0),)]),
        pace=tuple(draw.choice([1.0, 1.0, 2.0]) for _ in plan.tracks),
        standstills=tuple(() for _ in plan.tracks),
    )
    watch = watched(ActionDependencyGraph(plan.scenario, plan.tracks, hazards), chance, care)
    found = watch.floor.execute(watch.delay_sample)
    assert (found.completion < NEVER).all()
    happened = check(replace(plan, tracks=watch.floor.split(found.enter)))
    assert happened.ok, happened


@pytest.mark.parametrize("care", CARES)
@given(seed=st.integers(0, 5), rules=st.integers(0, len(RULES) - 1))
def test_nothing_is_changed_where_nobody_is_late(
    care: tuple[bool, bool], seed: int, rules: int
) -> None:
    plan = some_plan(seed, rules)
    floor = ActionDependencyGraph(plan.scenario, plan.tracks, DelayModel.none(len(plan.tracks)))
    assert watched(floor, 0, care).floor is floor


def seen_until(watch: ExecutionMonitor, tick: int) -> list[list[tuple[int, int]]]:
    """Return for each robot which vertices it has booked before a tick, since when."""
    floor, start = watch.floor, watch.happens.start
    ranges = pairwise(floor.first_visit.tolist())
    visits = [[visit for visit in range(i, j) if start[visit] < tick] for i, j in ranges]
    return [[(int(floor.vertex[x]), int(start[x])) for x in one] for one in visits]


class Witness(ExecutionMonitor):
    """Looks whether changes leave alone what was before them."""

    changes = 0

    def try_to_switch(self, outlook: Forecast) -> Forecast:
        before = seen_until(self, outlook.now)
        found = super().try_to_switch(outlook)
        assert seen_until(self, outlook.now) == before
        Witness.changes += found is not outlook
        return found

    def try_to_plan_anew(self, outlook: Forecast, draw: Draw) -> None:
        before = seen_until(self, outlook.now)
        super().try_to_plan_anew(outlook, draw)
        assert seen_until(self, outlook.now) == before
        Witness.changes += self.floor is not outlook.floor


@given(
    seed=st.integers(0, 5),
    rules=st.integers(0, len(RULES) - 1),
    chance=st.integers(0, 2**32 - 1),
    care=st.sampled_from(CARES),
)
@settings(max_examples=100, deadline=None)
def test_no_change_reaches_into_the_past(
    seed: int, rules: int, chance: int, care: tuple[bool, bool]
) -> None:
    """Who has waited until now for its right of way goes now, not when it could have gone."""
    plan, draw = some_plan(seed, rules), random.Random(chance)  # noqa: S311
    hazards = some_hazards(draw, len(plan.tracks), 20)
    watched(ActionDependencyGraph(plan.scenario, plan.tracks, hazards), chance, care, Witness)


def test_the_witness_has_seen_changes() -> None:
    plan = some_plan(0, 1)
    hazards = replace(DelayModel.none(len(plan.tracks)), random=(("chance", 0.1, 20.0),))
    for run in range(20):
        watched(
            ActionDependencyGraph(plan.scenario, plan.tracks, hazards), run, (True, True), Witness
        )
    assert Witness.changes > 0


@given(chance=st.integers(0, 2**32 - 1), cut=st.integers(1, 40), care=st.sampled_from(CARES))
@settings(max_examples=100, deadline=None)
def test_what_is_still_to_come_decides_nothing(
    chance: int, cut: int, care: tuple[bool, bool]
) -> None:
    """Two runs with the same stops before a tick are the same until that tick."""
    plan, draw = some_plan(chance % 6, chance % len(RULES)), random.Random(chance)  # noqa: S311
    stops = [(Tick(draw.randint(0, 30)), Tick(draw.choice([3, 10, 20]))) for _ in plan.tracks]
    seen = []
    for later in ([], [(Tick(cut), Tick(50))]):
        each = [[stop] for stop in stops]
        each[0] = sorted([stop for stop in each[0] if sum(stop) < cut] + later)
        hazards = DelayModel.none(len(plan.tracks))
        standstills = tuple(tuple(one) for one in each)
        floor = ActionDependencyGraph(
            plan.scenario, plan.tracks, replace(hazards, standstills=standstills)
        )
        seen.append(seen_until(watched(floor, 0, care), cut))
    assert seen[0] == seen[1]


@pytest.mark.parametrize("care", CARES)
def test_changes_win_on_average(care: tuple[bool, bool]) -> None:
    """Robots stop now and then: keeping the order makes the others wait for nothing."""
    scenario = random_fleet(1, size=12, robots=12)
    plan = rightofway.solve(scenario, "local-search", None)
    switch, replan = care
    outcome = rightofway.simulate(plan, "chance:0.03x20", runs=20, switch=switch, replan=replan)
    assert outcome.won is not None
    assert outcome.won.runs == 20
    assert outcome.won.earlier > outcome.won.later
    kept = rightofway.simulate(plan, "chance:0.03x20", runs=20)
    won = (kept.completion.sum(axis=1) - outcome.completion.sum(axis=1)).mean()
    assert outcome.won.flowtime.mean == round(won, 6) > 0


def test_planning_anew_wins_where_switching_cannot() -> None:
    """R10 is slow: on the same routes nothing is to be won, by another way 20 ticks."""
    plan = rightofway.solve(random_fleet(2, size=12, robots=10), "two-level", None)
    won = []
    for switch, replan in ((True, False), (False, True)):
        outcome = rightofway.simulate(plan, "slow:R10x2", runs=1, switch=switch, replan=replan)
        assert outcome.won is not None
        won.append(outcome.won.flowtime.mean)
    assert won == [0, 20]
