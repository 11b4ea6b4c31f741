"""The judge finds what looking at every tick finds, and judges whatever can be written down."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, pairwise, permutations

import numpy as np
from hypothesis import strategies as st

from rightofway.check import check
from rightofway.model import Occupancy, Plan, PlannerRun, Rules, Track
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law

Told = tuple[int, tuple[int, ...], str, tuple[int, ...]]
"""Tick, robots, kind and vertices of a fault: the order that faults come in."""

BETWEEN_ROBOTS = {"vertex conflict", "headway", "swap conflict", "rotation"}


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    """Draw robots that walk along edges at random times, on floors too small for them."""
    grid = draw(st.sampled_from([["..", ".."], ["...", "..."], ["..", ".@"]]))
    robots = draw(st.integers(2, 4 if grid == ["..", ".."] else 3))
    rules = Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=Fraction(draw(st.integers(0, 2))),
        rotations=draw(st.booleans()),
    )
    free = [f"N{cell}" for cell, character in enumerate("".join(grid)) if character == "."]
    homes = draw(st.permutations(free))[:robots]
    speeds = [Fraction(1, draw(st.integers(1, 2))) for _ in range(robots)]
    scenario = grid_fleet(grid, [(home, home) for home in homes], rules=rules, speeds=speeds)
    tracks = []
    for robot in scenario.robots:
        vertices, enter = [int(robot.home)], [0]
        for _ in range(draw(st.integers(0, 5))):
            begin, end = scenario.roadmap.indptr[vertices[-1] : vertices[-1] + 2]
            vertices.append(draw(st.sampled_from(scenario.roadmap.heads[begin:end].tolist())))
            enter.append(enter[-1] + draw(st.sampled_from([1, 1, 1, 2, 3])))
        tracks.append(Track.of(vertices, enter))
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="at random"))


@st.composite
def merry_go_rounds(draw: st.DrawFn) -> Plan:
    """Draw four robots that go round a square in step, unless one of them misses a beat."""
    clockwise = [0, 1, 3, 2]
    rules = Rules(rotations=draw(st.booleans()))
    scenario = grid_fleet(["..", ".."], [(f"N{k}", f"N{k}") for k in clockwise], rules=rules)
    beats = [0, *sorted(draw(st.sets(st.integers(1, 6))))]
    idler = draw(st.none() | st.integers(0, 3))
    tracks = []
    for place in range(4):
        enter = beats[:-1] if place == idler and len(beats) > 1 else beats
        vertices = [clockwise[(place + step) % 4] for step in range(len(enter))]
        tracks.append(Track.of(vertices, enter))
    return Plan(scenario=scenario, tracks=tuple(tracks), run=PlannerRun(name="at random"))


def horizon(plan: Plan) -> int:
    """Return a tick after everything that happens."""
    return max(int(track.enter[-1]) for track in plan.tracks) + 1


def booked(plan: Plan, robot: int, visit: int, headway: int) -> set[int]:
    """Return every tick that a visit books, up to the horizon."""
    track, itinerary = plan.tracks[robot], plan.scenario.problem.itineraries[robot]
    last = visit == len(track) - 1
    approach = itinerary.edge_ticks[0] if visit and plan.scenario.rules.occupancy == "both" else 0
    leave = horizon(plan) if last else int(track.enter[visit + 1])
    return set(range(int(track.enter[visit]) - approach, leave + headway))


def meetings(plan: Plan) -> Iterator[Told]:
    headway = plan.scenario.problem.booking_rules.headway
    visits = [
        (robot, visit) for robot, track in enumerate(plan.tracks) for visit in range(len(track))
    ]
    for (i, one), (j, other) in combinations(visits, 2):
        vertices = plan.tracks[i].vertices[one], plan.tracks[j].vertices[other]
        common = booked(plan, i, one, headway) & booked(plan, j, other, headway)
        if i != j and vertices[0] == vertices[1] and common:
            bare = booked(plan, i, one, 0) & booked(plan, j, other, 0)
            kind = "vertex conflict" if bare else "headway"
            yield min(common), (i, j), kind, (int(vertices[0]),)


def at(plan: Plan, tick: int) -> list[int]:
    """Return where each robot is."""
    return [int(track.vertices[np.flatnonzero(track.enter <= tick)[-1]]) for track in plan.tracks]


def circles(plan: Plan) -> Iterator[Told]:
    """Try every order of robots at every tick: does each come to where the next one was?"""
    fleet = range(len(plan.tracks))
    largest = 2 if plan.scenario.rules.rotations else len(fleet)
    orders = [order for size in range(2, largest + 1) for order in permutations(fleet, size)]
    for tick in range(1, horizon(plan)):
        before, after = at(plan, tick - 1), at(plan, tick)
        for order in orders:
            vertices = tuple(before[robot] for robot in order)
            comes = all(after[i] == before[j] for i, j in pairwise([*order, order[0]]))
            if comes and order[0] == min(order) and len(set(vertices)) == len(order):
                kind = "swap conflict" if len(order) == 2 else "rotation"
                yield tick, tuple(sorted(order)), kind, vertices


@law(plans() | merry_go_rounds())
def test_the_judge_finds_what_every_tick_shows(plan: Plan) -> None:
    expected = sorted([*meetings(plan), *circles(plan)])
    if any(kind == "vertex conflict" for _, _, kind, _ in expected):
        # Of robots that leave one vertex together, the judge follows only one round a circle.
        expected = [told for told in expected if told[2] != "rotation"]
        kinds = BETWEEN_ROBOTS - {"rotation"}
    else:
        kinds = BETWEEN_ROBOTS
    found = [
        (fault.tick, fault.robots, fault.kind, fault.vertices)
        for fault in check(plan).faults
        if fault.kind in kinds
    ]
    assert found == expected


visits = st.tuples(
    st.integers(-3, 6) | st.integers(-(2**31), 2**31 - 1),
    st.integers(-3, 9) | st.integers(-(2**63), 2**63 - 1),
)


@law(
    st.lists(st.lists(visits, min_size=1, max_size=6), min_size=3, max_size=3),
    st.sampled_from(["one", "both"]),
)
def test_whatever_can_be_written_down_is_judged(
    written: list[list[tuple[int, int]]], occupancy: Occupancy
) -> None:
    rules = Rules(occupancy=occupancy, headway=Fraction(1), rotations=False)
    scenario = grid_fleet(["..", ".."], [("N0", "N1"), ("N1", "N2"), ("N2", "N3")], rules=rules)
    tracks = tuple(
        Track.of([vertex for vertex, _ in track], [tick for _, tick in track]) for track in written
    )
    report = check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="nobody")))
    assert report.total == len(report.faults)
    assert all(fault.message for fault in report.faults)


def test_ticks_beyond_64_bits_that_lie_close_together_are_judged() -> None:
    """Their differences fit into 64 bits, so that they are packed into one integer for sorting."""
    scenario = grid_fleet([".."], [("N0", "N1"), ("N1", "N0")])
    tracks = (Track.of([1], [2**63 - 2]), Track.of([1], [2**63 - 1]))
    report = check(Plan(scenario=scenario, tracks=tracks, run=PlannerRun(name="nobody")))
    assert report.counts["vertex conflict"] == 1
