"""Closures on random fleets: every planner, the judge, and the optimum of tiny fleets."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest

from rightofway import check, solve
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution import delay_model_of, read_delays, simulate
from rightofway.model import NEVER, Closure, Plan, Scenario, VertexId, route_of
from rightofway.planners import registered
from rightofway.precedence import ActionDependencyGraph, DelaySample, graph_on
from rightofway.precedence.adg import Execution
from rightofway.search import Bookings, Distances, earliest_track
from tests.builders.closures import closed_fleet, tiny_closed, with_closures
from tests.builders.seeds import seeds
from tests.oracles.closures import breaks_a_closure, earliest_times, is_shut
from tests.oracles.joint_space import least_flowtime

PLANNERS = [name for name, spec in registered().items() if spec.knows_closures]


@pytest.mark.parametrize("seed", seeds(60, 2))
def test_plans_of_all_planners_keep_clear_of_closures(seed: int) -> None:
    """Where one planner proves that there is no plan, no other one finds a plan."""
    scenario, proven, found = closed_fleet(seed), False, False
    for planner in PLANNERS:
        options = {"iterations": 20} if planner in {"auto", "lns"} else None
        try:
            plan = solve(scenario, planner, time_limit=2, options=options)
        except NoPlanExists:
            proven = True
        except GaveUp:
            continue
        else:
            found = True
            assert check(plan).ok
            assert not breaks_a_closure(plan)
            assert plan.flowtime >= plan.lower_bound
    assert not (proven and found)


@pytest.mark.parametrize("seed", seeds(200, 15))
def test_auto_finds_the_optimum_of_two_robots_among_closures_or_proves_that_there_is_none(
    seed: int,
) -> None:
    """Points that book one vertex or two, and robots with sizes, on lanes that cross."""
    scenario = tiny_closed(seed)
    least = least_flowtime(scenario)
    try:
        plan = solve(scenario, options={"iterations": 50})
    except NoPlanExists:
        assert least is None
        return
    assert check(plan).ok
    assert plan.flowtime == least


@pytest.mark.parametrize("seed", seeds(100, 5))
def test_the_judge_finds_planted_closures_where_the_oracle_does(seed: int) -> None:
    scenario = replace(closed_fleet(seed), closures=())
    try:
        plan = solve(scenario, "prioritized", time_limit=2)
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan to plant closures in")
    planted = replace(plan, scenario=with_closures(scenario, seed + 1, most=1))
    report = check(planted)
    assert set(report.counts) <= {"closed"}
    assert report.ok is not breaks_a_closure(planted)


@pytest.mark.parametrize("seed", seeds(60, 2))
def test_one_more_closure_never_lowers_the_optimum(seed: int) -> None:
    scenario = tiny_closed(seed)
    before, after = least_of(replace(scenario, closures=())), least_of(scenario)
    assert after is None or (before is not None and before <= after)


def least_of(scenario: Scenario) -> int | None:
    """Return the flowtime that auto finds, None where there is no plan."""
    try:
        return solve(scenario, options={"iterations": 50}).flowtime
    except NoPlanExists:
        return None


@pytest.mark.parametrize("seed", seeds(60, 2))
def test_a_closure_of_a_place_that_a_plan_leaves_alone_changes_no_verdict(seed: int) -> None:
    scenario = replace(closed_fleet(3 * seed), closures=())  # points
    try:
        plan = solve(scenario, "prioritized", time_limit=2)
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    used = {vertex for track in plan.tracks for vertex in track.vertices.tolist()}
    unused = [v for v in range(scenario.roadmap.n_vertices) if v not in used]
    if not unused:
        pytest.skip("all vertices are in use")
    at = VertexId(random.Random(seed).choice(unused))  # noqa: S311 (no secret depends on it)
    closed = replace(scenario, closures=(Closure(at=at, from_=Fraction(0)),))
    assert check(replace(plan, scenario=closed)).ok


@pytest.mark.parametrize("seed", seeds(100, 5))
def test_precedence_graphs_have_the_earliest_times_that_keep_clear_of_closures(seed: int) -> None:
    """Rights of way are given and taken back at random; points, on the routes of robots alone."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    scenario = closed_fleet(3 * seed)
    bookings, distances = Bookings(scenario.problem), Distances(scenario.roadmap)
    tracks = []
    for robot in range(len(scenario.robots)):
        track = earliest_track(robot, bookings, distances)
        if track is None:
            pytest.skip("a robot has no way")
        tracks.append(track)
    itineraries = scenario.problem.itineraries
    routes = [
        route_of(scenario.roadmap, one, track)
        for one, track in zip(itineraries, tracks, strict=True)
    ]
    graph = graph_on(scenario, routes)
    given: list[tuple[int, int]] = []
    for _ in range(30):
        meeting = graph.next_meeting()
        if given and (meeting is None or draw.random() < 0.3):
            right = given.pop(draw.randrange(len(given)))
            assert graph.take_back(*right)
        elif meeting is not None:
            visits = sorted(meeting.visits, key=lambda _: draw.random())
            right = (visits[0], visits[1])
            mark = graph.checkpoint()
            if graph.give_way(*right) and right not in given:
                given.append(right)
                if draw.random() < 0.2:
                    graph.rollback(mark)
                    given.pop()
        expected = earliest_times(scenario, routes, given, scenario.problem.headway)
        times = [tick for track in graph.tracks() for tick in track.enter.tolist()]
        assert times == expected


@pytest.mark.parametrize("seed", seeds(60, 3))
def test_robots_on_the_floor_are_caught_where_the_oracle_sees_it_and_never_without_delays(
    seed: int,
) -> None:
    scenario = closed_fleet(seed)
    try:
        plan = solve(scenario, "prioritized", time_limit=2)
    except (NoPlanExists, GaveUp):
        pytest.skip("no plan")
    exact = simulate(plan, "uniform:0..0", runs=1)
    assert (exact.caught, exact.stranded, exact.collisions, exact.deadlocks) == (0, 0, 0, 0)
    last = [int(track.enter[-1]) for track in exact.trace().tracks]
    assert all(tick <= track.enter[-1] for tick, track in zip(last, plan.tracks, strict=True))
    causes = read_delays(["exponential:0.4", "chance:0.2x9"], scenario)
    adg = ActionDependencyGraph(scenario, plan.tracks, delay_model_of(causes, scenario))
    for run in range(5):
        sample = adg.delay_sample(seed, run)
        found = adg.execute(sample)
        assert not found.collisions[:3].any()
        assert found.is_caught.tolist() == _caught(plan, adg, found, sample)
        _assert_no_drive_begins_into_a_closure(plan, adg, found)


def _caught(
    plan: Plan, adg: ActionDependencyGraph, found: Execution, sample: DelaySample
) -> list[bool]:
    """Return whether the actual bookings of each robot overlap closures."""
    caught = []
    for robot in range(len(plan.tracks)):
        visits = range(adg.first_visit[robot], adg.first_visit[robot + 1])
        caught.append(
            any(
                is_shut(plan.scenario, robot, shape, Fraction(start), Fraction(end))
                for visit in visits
                for shape, start, end in _bookings(plan, adg, found, sample, visit)
            )
        )
    return caught


def _bookings(
    plan: Plan,
    adg: ActionDependencyGraph,
    found: Execution,
    sample: DelaySample,
    visit: int,
) -> list[tuple[tuple[int, ...], int, int]]:
    """Return what a visit has booked in a run: its vertex, and the edge driven in."""
    start, enter = int(found.start[visit]), int(found.enter[visit])
    if start == NEVER:
        return []
    headway, is_last = plan.scenario.problem.headway, visit + 1 in adg.first_visit
    leave = NEVER if is_last else int(found.enter[visit + 1])
    vertex = int(adg.vertex[visit])
    booked: list[tuple[tuple[int, ...], int, int]] = [((vertex,), start, leave + headway)]
    if visit not in adg.first_visit:
        ahead = plan.scenario.rules.occupancy == "both"
        begin = start if ahead else start - int(sample.drive[visit])
        booked.append(((int(adg.vertex[visit - 1]), vertex), begin, enter + headway))
    return booked


def _assert_no_drive_begins_into_a_closure(
    plan: Plan, adg: ActionDependencyGraph, found: Execution
) -> None:
    """As planned, a drive that begins and the stay after it overlap no closure."""
    headway, ahead = plan.scenario.problem.headway, plan.scenario.rules.occupancy == "both"
    for visit in range(len(adg.vertex)):
        start = int(found.start[visit])
        if visit in adg.first_visit or start == NEVER:
            continue
        drive, vertex, robot = int(adg.drive[visit]), int(adg.vertex[visit]), adg.robot_of(visit)
        begin = start if ahead else start - drive
        end, is_last = begin + drive, visit + 1 in adg.first_visit
        stay = NEVER if is_last else end + int(adg.dwell[visit]) + int(adg.drive[visit + 1])
        edge = (int(adg.vertex[visit - 1]), vertex)
        for shape, since, until in (
            (edge, begin, end + headway),
            ((vertex,), start, stay + headway),
        ):
            assert not is_shut(plan.scenario, robot, shape, Fraction(since), Fraction(until))
