"""Robots with a size that are late, or that break down, where lanes cross."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import rightofway
from rightofway.model import Plan, PlannerRun, Track
from rightofway.site import Edge, make_roadmap
from tests.builders.sizes import crossing


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
    roadmap = make_roadmap(at, edges)
    scenario = replace(crossing(), roadmap=roadmap)
    tracks = Track.of([0, 1], [0, 4]), Track.of([2, 3], [0, 8])
    plan = Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="by hand"))
    outcome = rightofway.simulate(plan, "stop:R1@2", runs=1, replan=True)
    assert (outcome.broken, outcome.cut_off, outcome.replans) == (1, 0, 1)
    # R2 stays until tick 2, drives 7 and 7, and works 1.
    assert outcome.trace(0).tracks[1].vertices.tolist() == [2, 4, 3]
    assert outcome.completion[0, 1] == 17
