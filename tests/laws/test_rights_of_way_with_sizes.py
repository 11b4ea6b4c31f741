"""Rights of way between robots with a size: conflicts, earliest times, segments, executions."""

from __future__ import annotations

import random
from itertools import combinations, product

import numpy as np
import pytest

from rightofway import solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution import delay_model_of, read_delays, simulate
from rightofway.model import NEVER, Plan, Scenario
from rightofway.planners.routing import shortest_routes
from rightofway.precedence import (
    ActionDependencyGraph,
    DelaySample,
    PrecedenceGraph,
    SegmentOfSizes,
    graph_of,
    graph_on,
)
from rightofway.search import Distances
from tests.builders.seeds import seeds
from tests.builders.sizes import crossing, sized, sized_on_lanes, tiny
from tests.oracles.space import (
    bookings,
    bookings_meet,
    discs_meet,
    executed,
    incompatible,
)

DELAYS = ("exponential:0.5", "uniform:-0.6..1", "chance:0.3x7")


def fleet(seed: int) -> Scenario:
    """Return a fleet on a grid, on lanes that cross, or on a tiny roadmap of these."""
    return (sized, sized_on_lanes, tiny)[seed % 3](seed)


def undecided(scenario: Scenario) -> PrecedenceGraph:
    """Return the graph of shortest routes, without any right of way."""
    try:
        return graph_on(scenario, shortest_routes(scenario, Distances(scenario.roadmap)))
    except NoPlanExists:
        pytest.skip("a robot has no way")


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


def some_plan(seed: int) -> Plan:
    """Return a plan by one of the planners that give rights of way."""
    planner = ("two-level", "fixed-priority", "prioritized")[seed % 4 % 3]
    try:
        return solve(fleet(seed), planner)
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")


@pytest.mark.parametrize("seed", seeds(60, 3))
def test_the_earliest_conflict_of_two_robots_is_that_of_their_bookings(seed: int) -> None:
    scenario = fleet(seed)
    graph = undecided(scenario)
    booked = [list(bookings(scenario, robot, track)) for robot, track in enumerate(graph.tracks())]
    for i, j in combinations(range(len(booked)), 2):
        overlaps = [
            max(one.start, other.start)
            for one, other in product(booked[i], booked[j])
            if one.start < other.end
            and other.start < one.end
            and incompatible(scenario, i, one.shape, j, other.shape)
        ]
        meeting = graph.next_meeting_of(i, j)
        assert (meeting and meeting.tick) == min(overlaps, default=None)


@pytest.mark.parametrize("seed", seeds(60, 3))
def test_one_robot_goes_first_in_a_whole_segment(seed: int) -> None:
    """Other orders leave a pair undecidable; what a segment gives implies each pair's order."""
    scenario = fleet(seed)
    graph = undecided(scenario)
    for i, j in combinations(range(len(graph.routes)), 2):
        meeting = graph.next_meeting_of(i, j)
        if meeting is None:
            continue
        segment = graph.segment(*meeting.visits)
        assert isinstance(segment, SegmentOfSizes)
        i_first = [(graph.visit(i, p.i), graph.visit(j, p.j_starts)) for p in segment.pairs]
        j_first = [(graph.visit(j, p.j), graph.visit(i, p.i_starts)) for p in segment.pairs]
        mark = graph.checkpoint()
        for mixed in product(i_first, j_first):
            if graph.give_all(mixed):
                assert not all_can_be_decided(graph, list(zip(i_first, j_first, strict=True)))
            graph.rollback(mark)
        for whole, given in (
            (i_first, [(graph.visit(i, a), graph.visit(j, b)) for a, b in segment.if_j_waits()]),
            (j_first, [(graph.visit(j, b), graph.visit(i, a)) for a, b in segment.if_i_waits()]),
        ):
            if graph.give_all(given):
                enter = np.concatenate([track.enter for track in graph.tracks()])
                assert graph.give_all(whole)
                again = np.concatenate([track.enter for track in graph.tracks()])
                assert enter.tolist() == again.tolist()
            graph.rollback(mark)


def test_lanes_that_cross_are_one_decision() -> None:
    """R1 drives from A to B, R2 from C to D; only the two drives exclude each other."""
    graph = undecided(crossing())
    meeting = graph.next_meeting()
    assert meeting is not None
    segment = graph.segment(*meeting.visits)
    assert isinstance(segment, SegmentOfSizes)
    assert segment.kind == "crossing"
    assert segment.if_j_waits() == [(0, 1)]  # R1 has left A before R2 starts to drive to D
    assert segment.if_i_waits() == [(1, 0)]
    assert segment.i_vertices == (0, 1)


@pytest.mark.parametrize("seed", seeds(60, 3))
def test_the_order_of_a_plan_gives_the_earliest_times(seed: int) -> None:
    plan = some_plan(seed)
    graph = graph_of(plan.scenario, plan.tracks)
    dwell, drive = ([getattr(route, name) for route in graph.routes] for name in ("dwell", "drive"))
    _, enter = executed(plan.scenario, plan.tracks, dwell, drive)
    assert [track.enter.tolist() for track in graph.tracks()] == enter
    assert graph.next_meeting() is None


@pytest.mark.parametrize("delays", DELAYS)
@pytest.mark.parametrize("seed", seeds(40, 3))
def test_delayed_robots_wait_just_as_long_as_they_must(seed: int, delays: str) -> None:
    """Times are those of the oracle; bookings never overlap, discs never meet."""
    plan = some_plan(seed)
    scenario = plan.scenario
    model = delay_model_of(read_delays(delays, scenario), scenario)
    adg = ActionDependencyGraph(scenario, plan.tracks, model)
    assert adg.deadlocked() == []
    sample = adg.delay_sample(seed, 1)
    run = adg.execute(sample)
    own = adg.first_visit[1:-1]
    dwell, drive = (
        [part.tolist() for part in np.split(each, own)] for each in (sample.dwell, sample.drive)
    )
    start, enter = executed(scenario, plan.tracks, dwell, drive)
    assert [part.tolist() for part in np.split(run.enter, own)] == enter
    assert [part.tolist() for part in np.split(run.start, own)] == start
    tracks = adg.tracks_at(run.enter)
    assert not bookings_meet(scenario, tracks, start)
    assert not discs_meet(scenario, tracks, start)
    assert run.collisions[:3].tolist() == [0, 0, 0]


@pytest.mark.parametrize("seed", seeds(40, 3))
def test_the_kernel_counts_what_meets_by_the_clock(seed: int) -> None:
    """Robots that keep their planned times collide; the oracle finds just as well whether."""
    plan, draw = some_plan(seed), random.Random(seed)  # noqa: S311
    scenario = plan.scenario
    model = delay_model_of(read_delays("exponential:0.7", scenario), scenario)
    adg = ActionDependencyGraph(scenario, plan.tracks, model)
    run = adg.execute(adg.delay_sample(draw.randrange(1000), 0), clock=True)
    start = [part.tolist() for part in np.split(run.start, adg.first_visit[1:-1])]
    meets = bookings_meet(scenario, adg.tracks_at(run.enter), start)
    assert (run.collisions[:3].sum() > 0) == meets


@pytest.mark.parametrize("seed", seeds(30, 3))
def test_robots_that_break_down_are_waited_for(seed: int) -> None:
    plan = some_plan(seed)
    model = delay_model_of(read_delays("breaks:0.4,chance:0.3x5", plan.scenario), plan.scenario)
    adg = ActionDependencyGraph(plan.scenario, plan.tracks, model)
    batch = adg.runs(seed, 0, 50)
    assert not batch.by_right_of_way[:, :3].any()
    stuck = (batch.completion >= NEVER).any(axis=1)
    assert batch.is_broken[stuck].any(axis=1).all()


@pytest.mark.parametrize("seed", seeds(20, 2))
def test_rights_of_way_are_switched_without_collision_and_deadlock(seed: int) -> None:
    outcome = simulate(some_plan(seed), "chance:0.4x9", runs=10, seed=seed, switch=True)
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
