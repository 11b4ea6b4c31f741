"""Robots with a size that repeat their laps: bookings never overlap, period after period."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import rightofway
from rightofway.cyclic import RULES, CyclicResult, best_timetable, in_words, run_laps
from rightofway.cyclic.route import CyclicRoute, GroupContext, cyclic_routes, independent_groups
from rightofway.cyclic.to_plan import plan_of, whole_laps
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import (
    Edge,
    Lap,
    Plan,
    Robot,
    Rules,
    Scenario,
    Stop,
    Tick,
    VertexId,
    roadmap_of_edges,
)
from rightofway.model.zones import Zone
from rightofway.precedence import CyclicSchedule
from rightofway.search import PeriodicBookings, RowsOfLaps
from tests.builders.seeds import seeds
from tests.builders.sizes import crossing, repeated
from tests.oracles import periodic_space as oracle


def check_result(run: CyclicResult) -> None:
    """Check each period against the oracle, and the bottleneck against the period."""
    for group in run.groups:
        graph, timetable = group.graph(), group.timetable
        if graph is None or timetable is None:
            continue
        cycles, period = oracle.cycles_of(timetable), int(timetable.period)
        assert all(oracle.is_kept(cycle, period) for cycle in cycles)
        assert not oracle.conflicts(run.scenario, cycles, period)
        assert graph.slack().min() >= 0
        found = graph.critical_circuit()
        assert oracle.load(run.scenario, timetable) <= found.cycle_time <= period
        # The earliest timetable of the same orders keeps the rules, too.
        shortest = Tick(-(-found.cycle_time.numerator // found.cycle_time.denominator))
        again = oracle.cycles_of(graph.earliest(shortest))
        assert all(oracle.is_kept(cycle, shortest) for cycle in again)
        assert not oracle.conflicts(run.scenario, again, shortest)


def check_plan(plan: Plan, since: int = 0) -> None:
    """Let the judge look at unrolled laps, until the first robot stays at home."""
    ends = min(int(track.enter[-1]) for track in plan.tracks)
    found = rightofway.check(plan).faults
    assert not [fault for fault in found if fault.tick is None or since <= fault.tick < ends]


@pytest.mark.parametrize("seed", seeds(40, 3))
def test_laps_by_every_rule_have_no_fault(seed: int) -> None:
    scenario = repeated(seed)
    for rule in RULES:
        run = run_laps(scenario, rule, time_limit=3)
        check_result(run)
        try:
            plan = whole_laps(run)
        except GaveUp:  # a robot waits for ever
            continue
        check_plan(plan)


@pytest.mark.parametrize("seed", seeds(24, 2))
def test_a_chosen_timetable_has_no_fault_and_is_not_below_first_come_first_served(
    seed: int,
) -> None:
    try:
        run = best_timetable(repeated(seed), time_limit=None, rounds=5)
    except (GaveUp, NoPlanExists):
        pytest.skip("no timetable")
    check_result(run)
    starts = max(group.pattern.transient for group in run.groups if group.pattern)
    check_plan(whole_laps(run, 5), since=starts)
    for group in run.groups:
        if group.comparison is not None and group.comparison.baseline_ends == "repeats":
            assert group.comparison.throughput >= group.comparison.baseline


def laps_of(scenario: Scenario) -> list[Lap]:
    return [route.lap for route in cyclic_routes(scenario, "shortest")]


def crossing_lanes(draw: random.Random, ends_of_r1: str = "BE") -> Scenario:
    """Return two robots on lanes that cross; laps of two visits, or of four to E."""
    size = draw.choice(["0.2", "0.5", "0.7"])
    at = {"A": (0.0, 0.0), "B": (2.0, 0.0), "C": (1.0, -1.0), "D": (1.0, 1.0), "E": (3.0, 0.0)}
    lanes = [("A", "B", 2), ("C", "D", 2), ("B", "E", 1)]
    edges = [
        Edge(tail=tail, head=head, length=Fraction(length))
        for a, b, length in lanes
        for tail, head in ((a, b), (b, a))
    ]
    roadmap = roadmap_of_edges(at, edges)
    ends = [("A", draw.choice(ends_of_r1)), ("C", "D")]
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=name,
                home=roadmap.vertex(home),
                stops=(Stop(at=roadmap.vertex(target), work=Fraction(draw.randint(0, 2))),),
                radius=Fraction(size),
                speed=Fraction(draw.choice([1, 2])),
            )
            for name, (home, target) in zip(("R1", "R2"), ends, strict=True)
        ),
        rules=Rules(headway=Fraction(draw.choice([0, 1]))),
    )


def bookings_of(scenario: Scenario, period: int) -> PeriodicBookings:
    resources = scenario.problem.resources
    assert resources is not None
    robots = tuple(range(len(scenario.robots)))
    return PeriodicBookings(
        scenario.roadmap.n_vertices,
        Tick(period),
        headway=scenario.problem.headway,
        books_ahead=True,
        rows=RowsOfLaps(roadmap=scenario.roadmap, resources=resources, robots=robots),
    )


@pytest.mark.parametrize("seed", seeds(60, 3))
def test_a_lap_among_bookings_is_found_exactly_where_there_is_one(seed: int) -> None:
    """R1 waits here and there; all phases and waits of R2 are tried by the oracle."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    scenario = crossing_lanes(draw)
    laps = laps_of(scenario)
    period = max(lap.duration for lap in laps) + draw.randint(0, 8)
    own = draw.choice(list(oracle.all_cycles(0, laps[0], period, phases=[draw.randrange(period)])))
    bookings = bookings_of(scenario, period)
    bookings.add(0, laps[0], 1, np.array(own.enter))
    found = (bookings.search(laps[1], 1, phase, robot=1) for phase in range(period))
    ways = [oracle.Cycle(1, laps[1], tuple(way.tolist())) for way in found if way is not None]
    exists = any(
        not oracle.conflicts(scenario, [own, other], period)
        for other in oracle.all_cycles(1, laps[1], period, phases=range(period))
    )
    assert bool(ways) == exists
    for way in ways:
        assert oracle.is_kept(way, period)
        assert not oracle.conflicts(scenario, [own, way], period)


@pytest.mark.parametrize("seed", seeds(12, 2))
def test_crossing_lanes_get_the_least_period_of_one_lap_each(seed: int) -> None:
    """No timetable has fewer laps per tick than the best one with a lap of each robot."""
    scenario = crossing_lanes(random.Random(seed), "B")  # noqa: S311
    laps = laps_of(scenario)
    least = oracle.least_period(scenario, laps, most=sum(lap.duration for lap in laps) + 4)
    if least is None:  # each robot is in the other one's way wherever it is
        with pytest.raises((GaveUp, NoPlanExists)):
            best_timetable(scenario, time_limit=None, rounds=10)
        return
    run = best_timetable(scenario, time_limit=None, rounds=10)
    check_result(run)
    assert sum((group.rate() for group in run.groups), Fraction(0)) >= Fraction(2, least)


def test_lanes_that_cross_are_used_in_turn() -> None:
    """Each lap drives 4 ticks across and 4 back; no two drives overlap: 16 ticks for two laps."""
    scenario = replace(
        crossing(),
        robots=tuple(replace(robot, ends="home") for robot in crossing().robots),
    )
    assert [lap.duration for lap in laps_of(scenario)] == [9, 9]
    run = best_timetable(scenario, time_limit=None, rounds=10)
    [group] = run.groups
    assert group.rate() == Fraction(1, 8)
    run = run_laps(scenario, "first-come")
    [group] = run.groups
    assert (group.ends, group.rate()) == ("repeats", Fraction(1, 8))


def test_waits_and_the_bottleneck_name_both_places() -> None:
    scenario = replace(
        crossing(),
        robots=tuple(replace(robot, ends="home") for robot in crossing().robots),
    )
    [group] = run_laps(scenario, "first-come").groups
    name = scenario.roadmap.name
    beside = {(name(wait.vertex), name(wait.beside)) for wait in group.waits() if wait.beside}
    assert beside
    assert all({one, other} & set("AB") and {one, other} & set("CD") for one, other in beside)
    bottleneck = group.bottleneck()
    assert bottleneck is not None
    assert " beside " in in_words(bottleneck, scenario)


def test_groups_are_connected_by_what_excludes_each_other() -> None:
    """Lanes side by side, 2 apart: robots with a radius of 0.9 do not meet, with 1.1 they do."""
    at = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (0.0, 2.0), "D": (4.0, 2.0)}
    edges = [
        Edge(tail=tail, head=head, length=Fraction(4)) for tail, head in ("AB", "BA", "CD", "DC")
    ]
    roadmap = roadmap_of_edges(at, edges)

    def groups(radius: str) -> list[list[CyclicRoute]]:
        robots = tuple(
            Robot(
                name=name,
                home=roadmap.vertex(home),
                stops=(Stop(at=roadmap.vertex(target)),),
                radius=Fraction(radius),
            )
            for name, home, target in [("R1", "A", "B"), ("R2", "D", "C")]
        )
        scenario = Scenario(roadmap=roadmap, robots=robots)
        return independent_groups(scenario, cyclic_routes(scenario))

    assert [len(groups(radius)) for radius in ("0.9", "1.1")] == [2, 1]


@pytest.mark.parametrize("seed", seeds(10, 2))
def test_laps_keep_zones(seed: int) -> None:
    """Points; some places of a zone lie on several laps."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    scenario = repeated(2 * seed + 1)
    places = {one.home for one in scenario.robots}
    places |= {stop.at for one in scenario.robots for stop in one.stops}
    free = [VertexId(v) for v in range(scenario.roadmap.n_vertices) if v not in places]
    zone = Zone(name="Z", vertices=tuple(draw.sample(free, 6)))
    robots = tuple(replace(robot, radius=Fraction(0)) for robot in scenario.robots)
    roadmap = replace(scenario.roadmap, zones=(zone,))
    scenario = replace(scenario, roadmap=roadmap, robots=robots)
    for run in (
        run_laps(scenario, "first-come", time_limit=20),
        best_timetable(scenario, time_limit=None, rounds=3),
    ):
        for group in run.groups:
            timetable = group.timetable
            if timetable is not None:
                assert oracle.load(scenario, timetable) <= timetable.period
        starts = max((one.pattern.transient for one in run.groups if one.pattern), default=0)
        try:
            check_plan(whole_laps(run), since=starts)
        except GaveUp:
            continue


@pytest.mark.parametrize("seed", seeds(12, 2))
def test_laps_that_are_late_keep_their_rights_of_way_without_contact(seed: int) -> None:
    scenario = repeated(seed + 100)
    try:
        plan = plan_of(run_laps(scenario, "first-come", time_limit=20), 3)
    except GaveUp:
        pytest.skip("no plan of whole laps")
    outcome = rightofway.simulate(plan, "exponential:0.5", runs=20)
    assert (outcome.collisions, outcome.deadlocks, outcome.stranded) == (0, 0, 0)
    assert rightofway.check(replace(plan, tracks=outcome.trace(3).tracks)).ok
    replanned = rightofway.simulate(plan, "chance:0.05x20", runs=2, replan=True)
    assert (replanned.collisions, replanned.deadlocks, replanned.stranded) == (0, 0, 0)


def test_rights_of_way_are_those_of_some_periods_laid_out_one_by_one() -> None:
    """Each arc leads from the latest end before a start, counted by hand."""
    scenario = replace(
        crossing(),
        robots=tuple(replace(robot, ends="home") for robot in crossing().robots),
    )
    laps = tuple(laps_of(scenario))  # A, B and C, D; each drive takes 4, the work 1
    timetable = CyclicSchedule(
        robots=(0, 1),
        laps=laps,
        counts=(1, 1),
        period=Tick(16),
        # R1 drives 0..4 to B and 8..12 to A, R2 4..8 to D and 12..16 to C.
        enter=(np.array([12, 20]), np.array([0, 8])),
    )
    context = GroupContext(scenario=scenario, routes=tuple(cyclic_routes(scenario, "shortest")))
    graph = context.graph(timetable)
    rights = graph.arcs.chosen(graph.arcs.first >= 0)
    assert graph.slack().min() == 0
    assert graph.critical_circuit().cycle_time == 16
    # R1 to B, R2 to D, R1 to A, R2 to C: each drive waits for the end of the drive before it.
    assert sorted(zip(rights.tail.tolist(), rights.head.tolist(), strict=True)) == [
        (0, 2),
        (1, 3),
        (2, 1),
        (3, 0),
    ]
