"""Laps on lanes that cross, where all timetables can be tried: rights of way, periods, groups."""

from __future__ import annotations

import random
import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from rightofway.cyclic import find_best_timetable, run_laps
from rightofway.cyclic.route import CyclicRoute, GroupContext, make_cyclic_routes, split_groups
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import BookingRules, Lap, Robot, Rules, Scenario, Stop, Tick
from rightofway.precedence import CyclicSchedule
from rightofway.report.circuits import describe_circuit
from rightofway.search import PeriodicBookings, RowsOfLaps
from rightofway.site import Edge, make_roadmap
from tests.builders.laws import law
from tests.builders.sizes import crossing
from tests.oracles import periodic_space as oracle
from tests.oracles.periodic_space import check_periods


def laps_of(scenario: Scenario) -> list[Lap]:
    return [route.lap for route in make_cyclic_routes(scenario, "shortest")]


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
    roadmap = make_roadmap(at, edges)
    ends = [("A", draw.choice(ends_of_r1)), ("C", "D")]
    return Scenario(
        roadmap=roadmap,
        robots=tuple(
            Robot(
                name=name,
                home=roadmap.get_vertex(home),
                stops=(Stop(at=roadmap.get_vertex(target), work=Fraction(draw.randint(0, 2))),),
                radius=Fraction(size),
                speed=Fraction(draw.choice([1, 2])),
            )
            for name, (home, target) in zip(("R1", "R2"), ends, strict=True)
        ),
        rules=Rules(headway=Fraction(draw.choice([0, 1]))),
    )


def bookings_of(scenario: Scenario, period: int) -> PeriodicBookings:
    resources = scenario.problem.resources
    robots = tuple(range(len(scenario.robots)))
    return PeriodicBookings(
        scenario.roadmap.n_vertices,
        Tick(period),
        rules=BookingRules(headway=scenario.problem.booking_rules.headway, books_ahead=True),
        rows=RowsOfLaps(roadmap=scenario.roadmap, resources=resources, robots=robots),
    )


@law(st.integers(0, 10**9))
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


@law(st.integers(0, 10**9))
def test_crossing_lanes_get_the_least_period_of_one_lap_each(seed: int) -> None:
    """No timetable has fewer laps per tick than the best one with a lap of each robot."""
    scenario = crossing_lanes(random.Random(seed), "B")  # noqa: S311
    laps = laps_of(scenario)
    least = oracle.least_period(scenario, laps, most=sum(lap.duration for lap in laps) + 4)
    if least is None:  # each robot is in the other one's way wherever it is
        with pytest.raises((GaveUp, NoPlanExists)):
            find_best_timetable(scenario, time_limit=None, rounds=10)
        return
    run = find_best_timetable(scenario, time_limit=None, rounds=10)
    check_periods(run)
    assert sum((group.compute_rate() for group in run.groups), Fraction(0)) >= Fraction(2, least)


def test_lanes_that_cross_are_used_in_turn() -> None:
    """Each lap drives 4 ticks across and 4 back; no two drives overlap: 16 ticks for two laps."""
    scenario = replace(
        crossing(),
        robots=tuple(replace(robot, ends="home") for robot in crossing().robots),
    )
    assert [lap.duration for lap in laps_of(scenario)] == [9, 9]
    run = find_best_timetable(scenario, time_limit=None, rounds=10)
    [group] = run.groups
    assert group.compute_rate() == Fraction(1, 8)
    run = run_laps(scenario, "first-come")
    [group] = run.groups
    assert (group.ends, group.compute_rate()) == ("repeats", Fraction(1, 8))


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
    bottleneck = group.find_bottleneck()
    assert bottleneck is not None
    text = describe_circuit(bottleneck.pieces, scenario)
    assert re.search(r"enters (\w) once R\d has left (?!\1)", text)


def test_groups_are_connected_by_what_excludes_each_other() -> None:
    """Lanes side by side, 2 apart: robots with a radius of 0.9 do not meet, with 1.1 they do."""
    at = {"A": (0.0, 0.0), "B": (4.0, 0.0), "C": (0.0, 2.0), "D": (4.0, 2.0)}
    edges = [
        Edge(tail=tail, head=head, length=Fraction(4)) for tail, head in ("AB", "BA", "CD", "DC")
    ]
    roadmap = make_roadmap(at, edges)

    def groups(radius: str) -> list[list[CyclicRoute]]:
        robots = tuple(
            Robot(
                name=name,
                home=roadmap.get_vertex(home),
                stops=(Stop(at=roadmap.get_vertex(target)),),
                radius=Fraction(radius),
            )
            for name, home, target in [("R1", "A", "B"), ("R2", "D", "C")]
        )
        scenario = Scenario(roadmap=roadmap, robots=robots)
        return split_groups(scenario, make_cyclic_routes(scenario))

    assert [len(groups(radius)) for radius in ("0.9", "1.1")] == [2, 1]


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
    context = GroupContext(
        scenario=scenario, routes=tuple(make_cyclic_routes(scenario, "shortest"))
    )
    graph = context.build_graph(timetable)
    rights = graph.arcs.choose(graph.arcs.first >= 0)
    assert graph.compute_slack().min() == 0
    assert graph.find_critical_circuit().cycle_time == 16
    # R1 to B, R2 to D, R1 to A, R2 to C: each drive waits for the end of the drive before it.
    assert sorted(zip(rights.tail.tolist(), rights.head.tolist(), strict=True)) == [
        (0, 2),
        (1, 3),
        (2, 1),
        (3, 0),
    ]
