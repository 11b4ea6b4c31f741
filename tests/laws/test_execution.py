"""Executions with delays, on any fleet: nobody collides or deadlocks, and the kernel is right."""

from __future__ import annotations

import random
from collections.abc import Iterator

import numpy as np
from hypothesis import strategies as st

import rightofway
from rightofway.model import NEVER, Scenario
from rightofway.precedence import ActionDependencyGraph, DelayModel, DelaySample
from rightofway.precedence.adg import Execution
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.executions import ONE_CHAIN, any_delays, late, oracle_of, times, wrong_in
from tests.builders.laws import law, leave
from tests.oracles import execution, judge

planners, seeds = st.sampled_from(STRICT), st.integers(0, 2**32 - 1)


@law(any_fleet(), planners, seeds, st.sampled_from(["keep", "switch", "replan", "both"]))
def test_delayed_robots_never_collide_or_deadlock(
    fleet: Scenario, planner: str, chance: int, policy: str
) -> None:
    """Both by the counts of the kernel and by the second judge."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    outcome = rightofway.simulate(
        plan,
        any_delays(draw, fleet),
        runs=3,
        seed=chance,
        switch=policy in {"switch", "both"},
        replan=policy in {"replan", "both"},
    )
    assert wrong_in(outcome, range(3)) == []


@law(any_fleet(), planners)
def test_without_delays_nobody_is_later_than_planned(fleet: Scenario, planner: str) -> None:
    plan = planned(fleet, planner)
    adg = ActionDependencyGraph(fleet, plan.tracks, DelayModel.none(len(plan.tracks)))
    found = adg.execute(adg.delay_sample(0, 0))
    assert not found.collisions[:3].any()
    assert not found.is_caught.any()
    assert (found.enter <= adg.planned).all()


@law(any_fleet(without=ONE_CHAIN), planners, seeds)
def test_the_kernel_equals_robots_that_look(fleet: Scenario, planner: str, chance: int) -> None:
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    adg = late(plan, draw)
    since = np.array([draw.choice([0, 0, 0, 12]) for _ in adg.vertex], np.int64)
    adg = adg.reorder(adg.order, since)
    delay_sample = adg.delay_sample(chance, 3)
    slow = oracle_of(adg, delay_sample)
    for clock, run in ((False, execution.by_right_of_way), (True, execution.by_clock)):
        found, expected = adg.execute(delay_sample, clock=clock), run(slow)
        assert times(found) == times(expected)
        assert tuple(found.collisions.tolist()) == execution.collisions(slow, expected)
        if not clock:
            assert not found.collisions[:3].any()
    assert adg.list_deadlocked() == []


@law(any_fleet(robots=(3, 4), without=ONE_CHAIN), planners, seeds)
def test_robots_in_a_wrong_order_deadlock_just_where_the_kernel_says(
    fleet: Scenario, planner: str, chance: int
) -> None:
    """Two visits next to each other at one vertex change places."""
    plan, draw = planned(fleet, planner), random.Random(chance)  # noqa: S311
    adg = ActionDependencyGraph(fleet, plan.tracks, DelayModel.none(len(plan.tracks)))
    firsts = set(adg.first_visit.tolist())
    swappable = [
        visit
        for other, visit in adg.order.tolist()
        if other not in firsts and adg.get_robot(other) != adg.get_robot(visit)
    ]
    if not swappable:
        leave("no robots share a vertex")
    before = np.full(len(adg.vertex), -1, np.int32)
    before[adg.order[:, 1]] = adg.order[:, 0]
    visit = draw.choice(swappable)
    other = int(before[visit])
    after = np.flatnonzero(before == visit)
    before[visit], before[other] = before[other], visit
    before[after] = other
    second = np.flatnonzero(before >= 0).astype(np.int32)
    adg = adg.reorder(np.column_stack((before[second], second)))
    delay_sample = adg.delay_sample(0, 0)
    found, expected = (
        adg.execute(delay_sample),
        execution.by_right_of_way(oracle_of(adg, delay_sample)),
    )
    assert found.completion.tolist() == expected.completion
    stuck = [robot for robot, tick in enumerate(expected.completion) if tick >= NEVER]
    assert adg.list_deadlocked() == stuck


@law(any_fleet(), planners, seeds)
def test_runs_are_what_single_runs_are_however_they_are_cut_up(
    fleet: Scenario, planner: str, chance: int
) -> None:
    adg = late(planned(fleet, planner), random.Random(chance))  # noqa: S311
    whole, second = adg.make_runs(chance, 0, 8), adg.make_runs(chance, 5, 3)
    assert np.array_equal(whole.completion[5:], second.completion)
    for run in range(8):
        delay_sample = adg.delay_sample(chance, run)
        one, clocked = adg.execute(delay_sample), adg.execute(delay_sample, clock=True)
        assert one.completion.tolist() == whole.completion[run].tolist()
        assert one.is_broken.tolist() == whole.is_broken[run].tolist()
        assert one.is_caught.tolist() == whole.is_caught[run].tolist()
        assert one.collisions.tolist() == whole.by_right_of_way[run].tolist()
        assert clocked.collisions.tolist() == whole.by_clock[run].tolist()


@law(any_fleet(), planners, seeds)
def test_what_lateness_is_put_down_to_sums_up_to_it(
    fleet: Scenario, planner: str, chance: int
) -> None:
    adg = late(planned(fleet, planner), random.Random(chance))  # noqa: S311
    runs = adg.make_runs(chance, 0, 5)
    ends = adg.first_visit[1:] - 1
    by = runs.completion - adg.planned[ends] - adg.dwell[ends]
    expected = np.where(runs.completion < NEVER, np.maximum(by, 0), 0).sum()
    assert runs.own.sum() + runs.of_others.sum() == expected
    assert runs.between[:, 2].sum() == runs.of_others.sum()


@law(any_fleet(always={"closures"}, without={"passed"}, joined=True), planners, seeds)
def test_robots_are_caught_by_closures_where_the_second_judge_sees_it(
    fleet: Scenario, planner: str, chance: int
) -> None:
    """As planned, a drive that begins and the stay after it overlap no closure."""
    adg = late(planned(fleet, planner), random.Random(chance))  # noqa: S311
    site = judge.Site(fleet)
    for run in range(5):
        sample = adg.delay_sample(chance, run)
        found = adg.execute(sample)
        for robot, one in enumerate(fleet.robots):
            visits = range(*adg.first_visit[robot : robot + 2].tolist())
            done = [x for visit in visits for x in _booked(site, adg, found, sample, visit)]
            assert found.is_caught[robot] == judge.is_shut(site, one, done)
            begun = [x for visit in visits[1:] for x in _as_planned(site, adg, found, visit)]
            assert not judge.is_shut(site, one, begun)


def _booked(
    site: judge.Site, adg: ActionDependencyGraph, found: Execution, sample: DelaySample, visit: int
) -> Iterator[judge.Booking]:
    """Yield what a visit has booked in a run: its vertex, and the edge driven in."""
    start, enter = int(found.start[visit]), int(found.enter[visit])
    if start == NEVER:
        return
    leave_ = NEVER if visit + 1 in adg.first_visit else int(found.enter[visit + 1])
    vertex = int(adg.vertex[visit])
    yield judge.Booking((vertex,), frozenset(), start, leave_ + site.headway)
    if visit not in adg.first_visit:
        begin = start if site.is_both else start - int(sample.drive[visit])
        edge = int(adg.vertex[visit - 1]), vertex
        yield judge.Booking(edge, frozenset(), begin, enter + site.headway)


def _as_planned(
    site: judge.Site, adg: ActionDependencyGraph, found: Execution, visit: int
) -> Iterator[judge.Booking]:
    """Yield what a drive that has begun books if it and the stay after it go as planned."""
    start, drive, vertex = int(found.start[visit]), int(adg.drive[visit]), int(adg.vertex[visit])
    if start == NEVER:
        return
    begin = start if site.is_both else start - drive
    end, is_last = begin + drive, visit + 1 in adg.first_visit
    stay = NEVER if is_last else end + int(adg.dwell[visit]) + int(adg.drive[visit + 1])
    edge = int(adg.vertex[visit - 1]), vertex
    yield judge.Booking(edge, frozenset(), begin, end + site.headway)
    yield judge.Booking((vertex,), frozenset(), start, stay + site.headway)
