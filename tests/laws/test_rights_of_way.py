"""Rights of way between robots that book ahead: conflicts, earliest times, segments, delays."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np
from hypothesis import strategies as st

from rightofway import solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution import delay_model_of, read_delays, simulate
from rightofway.io import parse_scenario
from rightofway.model import NEVER, Plan, Scenario
from rightofway.precedence import (
    ActionDependencyGraph,
    DelaySample,
    PrecedenceGraph,
    build_graph,
    build_graph_of_plan,
)
from rightofway.repair.routing import find_shortest_routes
from rightofway.search import Distances
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave, once
from tests.builders.sizes import crossing, sized
from tests.oracles.space import (
    bookings,
    discs_meet,
    executed,
    first_overlap,
    incompatible,
)

DELAYS = ("exponential:0.5", "uniform:-0.6..1", "chance:0.3x7")


FLEETS = any_fleet(robots=(2, 4), without={"closures", "passed", "zones"}, always={"both", "sizes"})
"""The oracle of delayed robots knows bookings that exclude each other by place, ahead of a drive.

Closures and zones are held by the laws of plans, whose judge knows all features.
"""

PLANNERS = st.sampled_from(["two-level", "fixed-priority", "prioritized"])
"""Planners that give rights of way."""


def undecided(scenario: Scenario) -> PrecedenceGraph:
    """Return the graph of shortest routes, without any right of way."""
    try:
        return build_graph(
            scenario.problem, find_shortest_routes(scenario, Distances(scenario.roadmap))
        )
    except NoPlanExists:
        leave("a robot has no way")


def all_can_be_decided(
    graph: PrecedenceGraph, choices: list[tuple[tuple[int, int], tuple[int, int]]]
) -> bool:
    """Return whether no pair is found of which neither visit can go first any more."""
    while True:
        mark = graph.checkpoint()
        for choice in choices:
            possible = []
            for right in choice:
                trial = graph.checkpoint()
                possible += [right] if graph.give_way(*right) else []
                graph.rollback(trial)
            if not possible:
                return False
            if len(possible) == 1:
                graph.give_way(*possible[0])
        if graph.checkpoint() == mark:
            return True


def some_plan(scenario: Scenario, planner: str) -> Plan:
    """Return a plan, or leave the case out."""
    try:
        return solve(scenario, planner)
    except (NoPlanExists, GaveUp) as reason:
        leave(type(reason).__name__)


def excluded_crosswise() -> Scenario:
    """R1 comes from v2 as R4 drives out of v3, along lanes that near each other at a sharp angle.

    The piece that each drives first excludes the vertex after the other one's piece, not the piece.
    """
    lengths = {
        ("v0", "v1"): "4/4",
        ("v0", "v2"): "8/4",
        ("v2", "v3"): "22/4",
        ("v2", "v4"): "17/4",
        ("v0", "v5"): "8/4",
        ("v0", "v6"): "12/4",
        ("v0", "v7"): "16/4",
    }
    points = {"v0": [0, 0], "v1": [0, 1], "v2": [2, 0], "v3": [0, 5], "v4": [1, 4]}
    points |= {"v5": [0, 2], "v6": [0, 3], "v7": [0, 4]}
    edges = [
        {"from": tail, "to": head, "length": length, "both_ways": True}
        for (tail, head), length in lengths.items()
    ]
    ends = {"R1": ("v2", "v4"), "R2": ("v0", "v0"), "R3": ("v1", "v1"), "R4": ("v3", "v2")}
    robots = [
        {"name": name, "home": home, "target": target, "work": 0, "radius": "0.3"}
        for name, (home, target) in ends.items()
    ]
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": points, "edges": edges}, "spacing": 2},
            "robots": robots,
            "rules": {"occupancy": "both"},
        }
    )


@law(FLEETS)
@once(scenario=excluded_crosswise())
def test_the_earliest_conflict_of_two_robots_is_that_of_their_bookings(scenario: Scenario) -> None:
    graph = undecided(scenario)
    booked = [
        list(bookings(scenario, robot, track)) for robot, track in enumerate(graph.build_tracks())
    ]
    for i, j in combinations(range(len(booked)), 2):
        overlaps = [
            max(one.start, other.start)
            for one, other in product(booked[i], booked[j])
            if one.start < other.end
            and other.start < one.end
            and incompatible(scenario, i, one.shape, j, other.shape)
        ]
        meeting = graph.find_next_meeting_of(i, j)
        assert (meeting and meeting.tick) == min(overlaps, default=None)


@law(FLEETS)
def test_one_robot_goes_first_in_a_whole_segment(scenario: Scenario) -> None:
    """Other orders leave a pair undecidable; what a segment gives implies each pair's order."""
    graph = undecided(scenario)
    for i, j in combinations(range(len(graph.routes)), 2):
        meeting = graph.find_next_meeting_of(i, j)
        if meeting is None:
            continue
        segment = graph.find_segment(*meeting.visits)
        if scenario.problem.resources.are_points and not scenario.problem.booking_rules.books_ahead:
            leave("points that follow each other at one instant")
        i_first = [(graph.get_visit(i, p.i), graph.get_visit(j, p.j_starts)) for p in segment.pairs]
        j_first = [(graph.get_visit(j, p.j), graph.get_visit(i, p.i_starts)) for p in segment.pairs]
        mark = graph.checkpoint()
        for mixed in product(i_first, j_first):
            if graph.give_all(mixed):
                assert not all_can_be_decided(graph, list(zip(i_first, j_first, strict=True)))
            graph.rollback(mark)
        for whole, given in (
            (
                i_first,
                [
                    (graph.get_visit(i, a), graph.get_visit(j, b))
                    for a, b in segment.list_rights_of_i()
                ],
            ),
            (
                j_first,
                [
                    (graph.get_visit(j, b), graph.get_visit(i, a))
                    for a, b in segment.list_rights_of_j()
                ],
            ),
        ):
            if graph.give_all(given):
                enter = np.concatenate([track.enter for track in graph.build_tracks()])
                assert graph.give_all(whole)
                again = np.concatenate([track.enter for track in graph.build_tracks()])
                assert enter.tolist() == again.tolist()
            graph.rollback(mark)


def test_lanes_that_cross_are_one_decision() -> None:
    """R1 drives from A to B, R2 from C to D; only the two drives exclude each other."""
    graph = undecided(crossing())
    meeting = graph.find_next_meeting()
    assert meeting is not None
    segment = graph.find_segment(*meeting.visits)
    assert segment.kind == "crossing"
    assert segment.list_rights_of_i() == [(0, 1)]  # R1 has left A before R2 starts to drive to D
    assert segment.list_rights_of_j() == [(1, 0)]
    assert segment.i_vertices == (0, 1)


@law(FLEETS, PLANNERS)
def test_the_order_of_a_plan_gives_the_earliest_times(scenario: Scenario, planner: str) -> None:
    plan = some_plan(scenario, planner)
    graph = build_graph_of_plan(plan.scenario.problem, plan.tracks)
    dwell, drive = ([getattr(route, name) for route in graph.routes] for name in ("dwell", "drive"))
    _, enter = executed(plan.scenario, plan.tracks, dwell, drive)
    assert [track.enter.tolist() for track in graph.build_tracks()] == enter
    assert graph.find_next_meeting() is None


@law(FLEETS, PLANNERS, st.sampled_from(DELAYS), st.integers(0, 999))
def test_delayed_robots_wait_just_as_long_as_they_must(
    scenario: Scenario, planner: str, delays: str, seed: int
) -> None:
    """Times are those of the oracle; bookings never overlap, discs never meet."""
    plan = some_plan(scenario, planner)
    model = delay_model_of(read_delays(delays, scenario), scenario)
    adg = ActionDependencyGraph(scenario, plan.tracks, model)
    assert adg.list_deadlocked() == []
    sample = adg.delay_sample(seed, 1)
    run = adg.execute(sample)
    own = adg.first_visit[1:-1]
    dwell, drive = (
        [part.tolist() for part in np.split(each, own)] for each in (sample.dwell, sample.drive)
    )
    start, enter = executed(scenario, plan.tracks, dwell, drive)
    assert [part.tolist() for part in np.split(run.enter, own)] == enter
    assert [part.tolist() for part in np.split(run.start, own)] == start
    tracks = adg.build_tracks(run.enter)
    assert first_overlap(scenario, tracks, start) is None
    assert not discs_meet(scenario, tracks, start)
    assert run.collisions[:3].tolist() == [0, 0, 0]


@law(FLEETS, PLANNERS, st.integers(0, 999))
def test_the_kernel_counts_what_meets_by_the_clock(
    scenario: Scenario, planner: str, seed: int
) -> None:
    """Robots that keep their planned times collide; the oracle finds whether and when."""
    plan = some_plan(scenario, planner)
    model = delay_model_of(read_delays("exponential:0.7", scenario), scenario)
    adg = ActionDependencyGraph(scenario, plan.tracks, model)
    run = adg.execute(adg.delay_sample(seed, 0), clock=True)
    start = [part.tolist() for part in np.split(run.start, adg.first_visit[1:-1])]
    first = first_overlap(scenario, adg.build_tracks(run.enter), start)
    assert (run.collisions[:3].sum() > 0) == (first is not None)
    assert int(run.collisions[3]) == (NEVER if first is None else first)


@law(FLEETS, PLANNERS, st.integers(0, 999))
def test_robots_that_break_down_are_waited_for(scenario: Scenario, planner: str, seed: int) -> None:
    plan = some_plan(scenario, planner)
    model = delay_model_of(read_delays("breaks:0.4,chance:0.3x5", plan.scenario), plan.scenario)
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, model)
    batch = adg.make_runs(seed, 0, 50)
    assert not batch.by_right_of_way[:, :3].any()
    stuck = (batch.completion >= NEVER).any(axis=1)
    assert batch.is_broken[stuck].any(axis=1).all()


@law(FLEETS, PLANNERS, st.integers(0, 999))
def test_rights_of_way_are_switched_without_collision_and_deadlock(
    scenario: Scenario, planner: str, seed: int
) -> None:
    """Ten runs, or fewer of long plans: a run looks for better rights of way at each delay."""
    plan = some_plan(scenario, planner)
    runs = max(1, min(10, 400 // sum(map(len, plan.tracks))))
    outcome = simulate(plan, "chance:0.4x9", runs=runs, seed=seed, switch=True)
    assert (outcome.collisions, outcome.deadlocks, outcome.stranded) == (0, 0, 0)


def test_switching_pays_where_a_robot_with_the_right_of_way_is_slow() -> None:
    """Four robots on a grid, of which R1 takes three times as long as planned."""
    outcome = simulate(solve(sized(4), "two-level"), "slow:R1x3", runs=1, switch=True)
    assert outcome.switches >= 1
    assert outcome.gain is not None
    assert (outcome.gain.earlier, outcome.collisions) == (1, 0)


def test_a_robot_waits_before_the_crossing_until_the_late_one_has_left() -> None:
    """R1 drives first by the plan, 4 ticks; it is late by 3, so R2 drives from tick 7 on."""
    scenario = crossing()
    plan = solve(scenario, "fixed-priority")
    adg = ActionDependencyGraph(scenario, plan.tracks, delay_model_of((), scenario))
    none = adg.delay_sample(0, 0)
    late = np.array([3, 0, 0, 0], np.int64)
    sample = DelaySample(none.dwell + late, *none[1:])
    assert adg.execute(none).start.tolist() == [0, 0, 0, 4]
    assert adg.execute(sample).start.tolist() == [0, 3, 0, 7]
