"""Simulated executions: what users see."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import rightofway
from rightofway.errors import InputError
from rightofway.execution import SimulationResult, replay
from rightofway.facts import Fact
from rightofway.model import Plan, PlannerRun, Rules, Track
from rightofway.model.units import Clock
from tests.builders.fleets import grid_fleet, random_fleet
from tests.builders.planned_jobs import make_plan


@pytest.fixture(scope="module")
def plan() -> Plan:
    """Two robots cross in the middle: R1 from west to east, R2 after it from north to south."""
    scenario = grid_fleet(
        ["@.@", "...", "@.@"], [("N3", "N5"), ("N1", "N7")], rules=Rules(ends="none")
    )
    return rightofway.solve(scenario, "two-level")


def test_without_delays_everything_is_as_planned(plan: Plan) -> None:
    outcome = rightofway.simulate(plan, "uniform:0..0", runs=3)
    assert outcome.trace(2).tracks == plan.tracks
    assert outcome.collisions == outcome.deadlocks == outcome.by_clock.total == 0
    assert outcome.lateness.all.max == 0


def test_a_robot_keeps_no_headway_from_itself() -> None:
    """It books its home again for the drive back before the headway of its first stay is over."""
    rules = Rules(occupancy="both", headway=Fraction(1), turn=Fraction(0))
    plan = rightofway.solve(grid_fleet([".."], [("N0", "N1")], rules=rules), "prioritized")
    assert plan.tracks[0].enter.tolist() == [0, 1, 2]
    outcome = rightofway.simulate(plan, "uniform:0..0", runs=1)
    assert outcome.trace(0).tracks == plan.tracks


@pytest.mark.parametrize("change", ["switch", "replan"])
def test_changes_during_execution_are_refused_for_plans_with_jobs(change: str) -> None:
    changes: dict[str, Any] = {change: True}
    with pytest.raises(InputError, match=f"{change}: is not for plans with jobs"):
        rightofway.simulate(make_plan(), runs=1, **changes)
    with pytest.raises(InputError, match=f"{change}: is not for plans with jobs"):
        replay(make_plan(), **changes)


def test_a_late_job_holds_back_the_job_after_it() -> None:
    """R2 waits at vertex 8 for J1 of R1, which is 10 ticks longer at vertex 1.

    J1 ends at 19 instead of 9, so J2 begins then. R2 works for 3 ticks, turns, and drives to
    vertex 4 by way of 9: at home at 25 instead of 15.
    """
    late = rightofway.simulate(make_plan(), "stop:R1@4+10", runs=1)
    assert late.completion.tolist() == [[25, 25]]
    assert late.lateness.robots[1].waiting == {0: 10}


def test_a_robot_that_stops_is_run_into_by_the_clock_and_waited_for_by_right_of_way(
    plan: Plan,
) -> None:
    """The first in the middle stands there from its enter on for 10; the other is to follow."""
    first = min(range(2), key=lambda robot: int(plan.tracks[robot].enter[1]))
    name = plan.scenario.robots[first].name
    outcome = rightofway.simulate(plan, f"stop:{name}@1+10", runs=1)
    assert outcome.by_clock.vertex == 1
    assert outcome.by_clock.first.median == 2
    assert outcome.collisions == 0
    other = 1 - first
    assert outcome.lateness.robots[other].quantiles.mean == 10
    assert outcome.lateness.robots[other].waiting == {first: 10.0}
    assert outcome.lateness.sources[0].robot == first
    assert outcome.lateness.sources[0].own == outcome.lateness.sources[0].of_others == 10


def test_robots_that_wait_for_a_broken_robot_are_stranded_not_deadlocked(plan: Plan) -> None:
    first = min(range(2), key=lambda robot: int(plan.tracks[robot].enter[1]))
    name = plan.scenario.robots[first].name
    outcome = rightofway.simulate(plan, f"stop:{name}@1", runs=2)
    assert (outcome.broken, outcome.stranded, outcome.deadlocks) == (2, 2, 0)
    assert (outcome.completion == -1).all()


def test_the_same_seed_gives_the_same_outcome_and_another_one_does_not() -> None:
    plan = rightofway.solve(random_fleet(2, robots=6), "two-level")
    one, same, other = (rightofway.simulate(plan, runs=20, seed=seed) for seed in (4, 4, 5))
    assert one.as_dict() == same.as_dict()
    assert not np.array_equal(one.completion, other.completion)


def test_a_run_shown_is_the_run_counted() -> None:
    plan = rightofway.solve(random_fleet(2, robots=6), "two-level")
    for switch in (False, True):
        outcome = rightofway.simulate(plan, "chance:0.1x9", runs=5, switch=switch)
        for run in range(5):
            ends = [int(track.enter[-1]) for track in outcome.trace(run).tracks]
            assert ends == outcome.completion[run].tolist()
    with pytest.raises(InputError, match="run 5 is not among the 5 runs"):
        outcome.trace(5)


def test_a_run_is_replayed_without_the_others() -> None:
    plan = rightofway.solve(random_fleet(2, robots=6), "two-level")
    for switch in (False, True):
        outcome = rightofway.simulate(plan, "chance:0.1x9", runs=5, seed=3, switch=switch)
        again = replay(plan, "chance:0.1x9", 4, 3, switch=switch)
        ends = [int(track.enter[-1]) for track in again.tracks]
        assert ends == outcome.completion[4].tolist()


@pytest.mark.parametrize("switch", [False, True])
def test_an_interrupt_may_keep_the_runs_that_were_made(
    switch: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = rightofway.solve(random_fleet(2, robots=6), "two-level")
    monkeypatch.setattr("rightofway.execution.simulation.CHUNK", 1)
    whole = rightofway.simulate(plan, "chance:0.1x9", runs=3, switch=switch)

    def interrupt(progress: Fact) -> None:
        if progress.values["done"] == 3:
            raise KeyboardInterrupt

    def asked(*, keep_runs: bool) -> SimulationResult:
        return rightofway.simulate(
            plan, "chance:0.1x9", 90, switch=switch, keep_runs=keep_runs, report=interrupt
        )

    assert asked(keep_runs=True).as_dict() == whole.as_dict()
    with pytest.raises(KeyboardInterrupt):
        asked(keep_runs=False)


def test_runs_are_ranked_from_the_best_to_the_worst() -> None:
    plan = rightofway.solve(random_fleet(2, robots=6), "two-level")
    outcome = rightofway.simulate(plan, runs=9)
    order = outcome.rank_runs().tolist()
    assert sorted(order) == list(range(9))
    assert np.diff(outcome.completion.sum(axis=1)[order]).min() >= 0
    assert (order[4], order[-1]) == (outcome.find_typical_run(), outcome.find_worst_run())


def test_switching_and_replanning_gain_when_one_robot_stops() -> None:
    """Each of eight robots stands still for 30 ticks once; one run each, all added up."""
    plan = rightofway.solve(random_fleet(1, size=8, robots=8), "two-level")
    late = dict.fromkeys(("kept", "switched", "replanned"), 0)
    for robot in plan.scenario.robots:
        for how, (switch, replan) in zip(late, [(0, 0), (1, 0), (0, 1)], strict=True):
            stop = f"stop:{robot.name}@5+30"
            outcome = rightofway.simulate(
                plan, stop, runs=1, switch=bool(switch), replan=bool(replan)
            )
            assert outcome.collisions == outcome.deadlocks == 0
            late[how] += int(outcome.completion.sum())
    assert late["replanned"] < late["switched"] < late["kept"]


def test_the_gain_compares_the_same_runs() -> None:
    plan = rightofway.solve(random_fleet(1, size=8, robots=8), "two-level")
    kept, replanned = (
        rightofway.simulate(plan, "chance:0.05x20", runs=10, replan=replan)
        for replan in (False, True)
    )
    won = kept.completion.sum(axis=1) - replanned.completion.sum(axis=1)
    assert kept.gain is None
    assert replanned.gain is not None
    assert (replanned.gain.runs, replanned.gain.flowtime.max) == (10, won.max())
    assert (replanned.gain.earlier, replanned.gain.later) == ((won > 0).sum(), (won < 0).sum())


def test_replanning_brings_home_robots_that_a_broken_one_would_strand() -> None:
    """R1 breaks down in the upper lane; R2 was to follow it and takes the lower one."""
    scenario = grid_fleet(
        ["....", ".@@.", "...."], [("N1", "N7"), ("N0", "N3")], rules=Rules(ends="none")
    )
    plan = rightofway.solve(scenario, "two-level")
    stranded = rightofway.simulate(plan, "stop:R1@1/2", runs=1)
    saved = rightofway.simulate(plan, "stop:R1@1/2", runs=1, replan=True)
    assert stranded.stranded == 1
    assert (saved.stranded, saved.replans, saved.broken, saved.cut_off) == (0, 1, 1, 0)
    assert saved.completion[0, 1] > 0


def test_robots_that_are_cut_off_are_counted() -> None:
    """R1 breaks down in the only way to the target of R2."""
    scenario = grid_fleet(["...."], [("N1", "N3"), ("N0", "N2")], rules=Rules(ends="none"))
    plan = rightofway.solve(scenario, "two-level")
    outcome = rightofway.simulate(plan, "stop:R1@0", runs=1, replan=True)
    assert (outcome.broken, outcome.cut_off, outcome.stranded) == (1, 1, 0)


def test_plans_with_faults_are_refused(plan: Plan) -> None:
    wrong = replace(plan, tracks=(plan.tracks[0], plan.tracks[0]))
    with pytest.raises(rightofway.InputError, match=r"faults.*\(only one without can be run\)"):
        rightofway.simulate(wrong)


def test_a_time_limit_ends_replanning_and_one_run_is_made() -> None:
    """The run that is shown is the one that was counted, although replanning was cut short."""
    plan = rightofway.solve(random_fleet(1, size=8, robots=8), "two-level")
    outcome = rightofway.simulate(plan, "stop:R1@5", runs=5, replan=True, time_limit=0)
    assert outcome.runs == 1
    ticks = [-1 if tick is None else tick for tick in outcome.trace(0).completion]
    assert ticks == outcome.completion[0].tolist()


@pytest.mark.parametrize("limit", [-5, float("nan")])
def test_a_time_limit_that_is_no_duration_is_refused(plan: Plan, limit: float) -> None:
    with pytest.raises(rightofway.InputError, match="time_limit"):
        rightofway.simulate(plan, runs=1, time_limit=limit)


def test_no_run_at_all_is_refused(plan: Plan) -> None:
    with pytest.raises(rightofway.InputError, match="runs: 0 does not fit"):
        rightofway.simulate(plan, runs=0)


def test_what_is_left_of_a_scenario_keeps_its_clock(plan: Plan) -> None:
    kept = replace(plan.scenario, clock=Clock(tick=plan.scenario.problem.clock.tick / 4))
    assert kept.problem.itineraries[0].edge_ticks == (4,)


def test_the_robots_of_a_rotation_wait_for_each_other_and_go_together() -> None:
    """Four robots move round a square at tick 1; the one that is late by 5 takes the others along.

    By the clock the other three drive on, and the first of them drives into the late one.
    """
    ring = [("N0", "N1"), ("N1", "N3"), ("N3", "N2"), ("N2", "N0")]
    scenario = grid_fleet(["..", ".."], ring, rules=Rules(ends="none"))
    vertex = scenario.roadmap.get_vertex
    tracks = tuple(Track.of([vertex(home), vertex(target)], [0, 1]) for home, target in ring)
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    outcome = rightofway.simulate(plan, "stop:R2@0+5", runs=1)
    assert outcome.completion.tolist() == [[6, 6, 6, 6]]
    assert outcome.collisions == outcome.deadlocks == 0
    assert outcome.by_clock.vertex == 1
    assert outcome.lateness.robots[3].waiting == {1: 5.0}


def late_before_a_closure(*rows: str, target: str, **closure: int | str) -> SimulationResult:
    """Return a run in which R1 stands still for 6 time units, with replanning."""
    fleet = rightofway.FleetBuilder(grid=list(rows), ends="none", turn=0)
    fleet.add_robot("R1", home="N0", target=target).add_closure(from_=5, **closure)  # type: ignore[arg-type]
    plan = rightofway.solve(fleet.build_scenario())
    kept = rightofway.simulate(plan, "stop:R1@0+6", runs=1)
    assert kept.stranded == (0 if "until" in closure else 1)
    return rightofway.simulate(plan, "stop:R1@0+6", runs=1, replan=True)


def test_a_robot_that_is_too_late_for_a_place_gets_another_way() -> None:
    """It sees at tick 5 that N1 is closed, goes on at 6 and takes 6 edges instead of 4."""
    outcome = late_before_a_closure(".....", ".....", target="N4", at="N1")
    assert outcome.completion.tolist() == [[12]]
    assert outcome.trace(0).tracks[0].vertices.tolist() == [0, 5, 6, 7, 8, 9, 4]
    assert (outcome.replans, outcome.stranded, outcome.cut_off, outcome.caught) == (1, 0, 0, 0)


def test_a_robot_that_no_way_is_left_for_is_cut_off() -> None:
    outcome = late_before_a_closure(".....", target="N4", at="N1")
    assert (outcome.stranded, outcome.cut_off, outcome.caught) == (0, 1, 0)
    assert outcome.completion.tolist() == [[-1]]


def test_a_robot_waits_for_a_closure_that_is_shorter_than_another_way() -> None:
    """N1 is closed until 7: R1 enters it then, and three edges follow; around takes until 12."""
    outcome = late_before_a_closure(".....", ".....", target="N4", at="N1", until=7)
    assert outcome.completion.tolist() == [[10]]
    assert outcome.trace(0).tracks[0].vertices.tolist() == [0, 1, 2, 3, 4]
