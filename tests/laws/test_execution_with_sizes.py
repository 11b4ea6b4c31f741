"""Robots with a size that are late: by right of way they never come too near to each other."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import rightofway
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution.monitor import ExecutionMonitor, ExecutionPolicy
from rightofway.model import (
    NEVER,
    Edge,
    Plan,
    PlannerRun,
    Rules,
    Tick,
    Track,
    VertexId,
    roadmap_of_edges,
)
from rightofway.model.zones import Zone
from rightofway.planners import Deadline
from rightofway.precedence import ActionDependencyGraph, DelayModel, Stoppage
from tests.builders.fleets import random_fleet
from tests.builders.seeds import seeds
from tests.builders.sizes import crossing, sized, sized_on_lanes, zoned

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


@pytest.mark.parametrize("seed", seeds(60, 6))
def test_late_robots_keep_zones(seed: int) -> None:
    """Most zones do not list the vertices between their edges, so that visits decide."""
    scenario = zoned(seed)
    try:
        plan = rightofway.solve(scenario, "two-level")
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    for delays in ("exponential:0.5", "chance:0.3x15"):
        outcome = rightofway.simulate(plan, delays, runs=30)
        assert (outcome.collisions, outcome.deadlocks) == (0, 0)
        judged = rightofway.check(replace(plan, tracks=outcome.trace(7).tracks))
        assert not (APART | {"zone conflict"}) & set(judged.counts)


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


def some_plan(seed: int) -> Plan:
    scenario = (sized if seed % 2 else sized_on_lanes)(seed + 500)
    try:
        return rightofway.solve(scenario, "prioritized")
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")


@pytest.mark.parametrize("seed", seeds(16, 2))
def test_replanned_robots_keep_apart_and_never_deadlock(seed: int) -> None:
    """Robots stop, are slow, or break down; rights of way are switched, too, in half of the runs.

    The judge looks at every run; robots are late, never early.
    """
    plan, draw = some_plan(seed), random.Random(seed)  # noqa: S311
    robots, last = range(len(plan.tracks)), max(int(track.enter[-1]) for track in plan.tracks)
    for run in range(4):
        lost = draw.sample(robots, draw.choice([0, 1, 2]))
        delays = DelayModel(
            random=draw.choice([(), (("exponential", 0.4, 0.0),), (("chance", 0.2, last / 2),)]),
            pace=tuple(draw.choice([1.0, 1.0, 2.0]) for _ in robots),
            stoppages=tuple(
                (Stoppage(Tick(draw.randint(0, last)), NEVER if robot in lost else Tick(last)),)
                if robot in lost or draw.random() < 0.4
                else ()
                for robot in robots
            ),
        )
        adg = ActionDependencyGraph(plan.scenario, plan.tracks, delays)
        policy = ExecutionPolicy(switch=run % 2 == 1, replan=True)
        monitor = ExecutionMonitor(adg, policy, run, 0, Deadline())
        assert not monitor.execution.collisions[:3].any()
        assert monitor.adg.deadlocked() == []
        tracks = monitor.adg.tracks_at(monitor.execution.enter)
        assert not APART & set(rightofway.check(replace(plan, tracks=tracks)).counts)
        unfinished = set(np.flatnonzero(monitor.completion == NEVER).tolist())
        assert unfinished <= monitor.lost | monitor.cut_off


def test_a_robot_that_breaks_down_in_a_lane_closes_what_it_books() -> None:
    """R1 breaks down where its lane crosses the only lane of R2: R2 is cut off, and stays."""
    tracks = Track.of([0, 1], [0, 4]), Track.of([2, 3], [0, 8])
    plan = Plan(scenario=crossing(), tracks=tracks, run=PlannerRun(name="by hand"))
    outcome = rightofway.simulate(plan, "stop:R1@2", runs=1, replan=True)
    assert (outcome.broken, outcome.cut_off, outcome.stranded) == (1, 1, 0)
    assert (outcome.collisions, outcome.deadlocks) == (0, 0)
    assert outcome.trace(0).tracks[1].vertices.tolist() == [2]


def test_robots_take_another_way_past_a_robot_that_broke_down_in_a_lane() -> None:
    """The lanes A to B and C to D cross; two lanes of 7 lead from C to D past E, to the right."""
    at = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (2.0, -2.0), "D": (2.0, 2.0), "E": (8.0, 0.0)}
    lanes = [("A", "B", 4), ("C", "D", 4), ("C", "E", 7), ("E", "D", 7)]
    edges = [Edge(tail=tail, head=head, length=Fraction(length)) for tail, head, length in lanes]
    roadmap = roadmap_of_edges(at, edges)
    scenario = replace(crossing(), roadmap=roadmap)
    tracks = Track.of([0, 1], [0, 4]), Track.of([2, 3], [0, 8])
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    outcome = rightofway.simulate(plan, "stop:R1@2", runs=1, replan=True)
    assert (outcome.broken, outcome.cut_off, outcome.replans) == (1, 0, 1)
    # R2 stays until tick 2, drives 7 and 7, and works 1.
    assert outcome.trace(0).tracks[1].vertices.tolist() == [2, 4, 3]
    assert outcome.completion[0, 1] == 17


@pytest.mark.parametrize("seed", seeds(8, 2))
def test_replanned_robots_keep_zones(seed: int) -> None:
    """Points whose roadmap has a zone of three vertices."""
    scenario = random_fleet(seed, size=5, robots=4, rules=Rules(occupancy="both"))
    draw = random.Random(seed)  # noqa: S311
    places = {one.home for one in scenario.robots} | {
        stop.at for one in scenario.robots for stop in one.stops
    }
    free = [VertexId(v) for v in range(scenario.roadmap.n_vertices) if v not in places]
    zone = Zone(name="Z", vertices=tuple(draw.sample(free, 3)))
    scenario = replace(scenario, roadmap=replace(scenario.roadmap, zones=(zone,)))
    try:
        plan = rightofway.solve(scenario, "prioritized")
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    for delays in ("chance:0.1x15", "exponential:0.5,breaks:0.05"):
        outcome = rightofway.simulate(plan, delays, runs=5, replan=True)
        assert (outcome.collisions, outcome.deadlocks, outcome.stranded) == (0, 0, 0)
        for run in range(5):
            judged = rightofway.check(replace(plan, tracks=outcome.trace(run).tracks))
            assert not (APART | {"zone conflict"}) & set(judged.counts)
