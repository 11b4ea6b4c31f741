"""The period as a function of a speed, a work time or the headway is that of the changed scenario.

So is the period that the sensitivity names for ten per cent of a parameter.

The slow and obvious way: change the scenario, let it choose its ticks, give the same laps in the
same order their new durations, and ask for the critical circuit.
"""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from functools import partial

import pytest

from rightofway.cyclic import (
    ParameterCurve,
    ParameterEffect,
    compute_parameter_curves,
    compute_parameter_effects,
    run_laps,
)
from rightofway.cyclic.sensitivity import find_stages_at
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.model import Lap, Rules, Scenario, Tick
from rightofway.model.lap import compute_turns_of_lap
from rightofway.model.route import compute_drives_along
from rightofway.native import BookedRows
from rightofway.precedence import CyclicSchedule, TimedEventGraph
from tests.builders.fleets import random_fleet
from tests.builders.sizes import repeated

RULES = [Rules(), Rules(headway=Fraction(1)), Rules(occupancy="both"), Rules(turn=Fraction(2))]
MOST_CURVES = 7


def changed(
    scenario: Scenario, curve: ParameterCurve | ParameterEffect, value: Fraction
) -> Scenario:
    """Return the scenario with another value of a parameter."""
    if curve.robot is None:
        return replace(scenario, rules=replace(scenario.rules, headway=value))
    robots = list(scenario.robots)
    robot = robots[curve.robot]
    if curve.stop is None:
        robots[curve.robot] = replace(robot, speed=value)
    else:
        stops = list(robot.stops)
        stops[curve.stop] = replace(stops[curve.stop], work=value)
        robots[curve.robot] = replace(robot, stops=tuple(stops))
    return replace(scenario, robots=tuple(robots))


def period_by_hand(timetable: CyclicSchedule, old: Scenario, scenario: Scenario) -> Fraction | None:
    """Return the period of the timetable's laps in their order in a changed scenario [time unit].

    None if robots wait for each other for ever.
    """
    laps = []
    for number, lap in zip(timetable.robots, timetable.laps, strict=True):
        itinerary = scenario.problem.itineraries[number]
        at = find_stages_at(old.roadmap, old.problem.itineraries[number], lap)
        turns = compute_turns_of_lap(scenario.roadmap, itinerary, lap.vertices).tolist()
        dwell = [
            sum((itinerary.stages[k].work + itinerary.stages[k].turn for k, _ in stages), turn)
            for stages, turn in zip(at, turns, strict=True)
        ]
        drive = compute_drives_along(scenario.roadmap, itinerary, [lap.vertices[-1], *lap.vertices])
        laps.append(
            Lap(
                vertices=lap.vertices,
                dwell=tuple(map(Tick, dwell)),
                drive=tuple(map(Tick, drive)),
            )
        )
    after = replace(timetable, laps=tuple(laps))
    rows = BookedRows.of_laps(old.problem, timetable.robots, timetable.laps, timetable.counts)
    graph = TimedEventGraph(after, rules=scenario.problem.booking_rules.keep_apart(), rows=rows)
    found = graph.find_critical_circuit_if_live()
    return None if found is None else found.cycle_time * scenario.problem.clock.tick


def values_of(curve: ParameterCurve, draw: random.Random) -> set[Fraction]:
    """Return breakpoints, values between them, and random ones of a curve."""
    least, most = curve.pieces[0].start, curve.pieces[-1].until
    ends = {piece.until for piece in curve.pieces} | {curve.value, least}
    middles = {(one + other) / 2 for one in ends for other in ends}
    drawn = {curve.value * Fraction(draw.randint(1, 40), 10) for _ in range(3)}
    found = sorted(value for value in ends | middles | drawn if least <= value <= most)
    return set(draw.sample(found, min(len(found), 6)))


def take_ten_per_cent(scenario: Scenario, effect: ParameterEffect) -> Scenario | None:
    """Return the scenario with ten per cent of a parameter; None where no file can have that."""
    if effect.kind == "turn":
        return None  # in a cell's crossing time
    if effect.robot is None:
        return changed(scenario, effect, scenario.rules.headway * Fraction(9, 10))
    robot = scenario.robots[effect.robot]
    if effect.kind == "speed":
        return changed(scenario, effect, robot.speed * Fraction(11, 10))
    if effect.stop is None or effect.stop == len(robot.stops):
        return None
    return changed(scenario, effect, robot.stops[effect.stop].work * Fraction(9, 10))


def check_ten_per_cent(scenario: Scenario, graph: TimedEventGraph, old: Scenario) -> int:
    """Compare what ten per cent of each parameter does; return the number of parameters."""
    compared = 0
    for effect in compute_parameter_effects(scenario, graph, most=MOST_CURVES):
        other = take_ten_per_cent(scenario, effect)
        if other is not None and other.problem.clock.exact:
            ticks = effect.ten_per_cent * scenario.problem.clock.tick
            assert ticks == period_by_hand(graph.timetable, old, other)
            compared += 1
    return compared


def check_curves(scenario: Scenario, draw: random.Random) -> int:
    """Compare the curves of all groups that repeat; return the number of breakpoints."""
    breakpoints = 0
    for group in run_laps(scenario, draw.choice(["first-come", "two-level"]), time_limit=2).groups:
        graph, timetable = group.build_graph(), group.timetable
        if graph is None or timetable is None or not scenario.problem.clock.exact:
            continue
        assert check_ten_per_cent(scenario, graph, group.context.scenario)
        by_hand = partial(period_by_hand, timetable, group.context.scenario)
        curves = compute_parameter_curves(scenario, graph, most_visits=MOST_CURVES * len(graph))
        assert len(curves) <= MOST_CURVES
        period = graph.find_critical_circuit().cycle_time * scenario.problem.clock.tick
        for curve in curves:
            breakpoints += len(curve.pieces) - 1
            assert curve.compute_period(curve.value) == period
            for one, then in zip(curve.pieces, curve.pieces[1:], strict=False):
                assert one.until == then.start > one.start
            if curve.pieces[0].start == curve.pieces[-1].until:
                # A circle of robots leaves no room for a headway.
                assert curve.kind == "headway"
                assert by_hand(changed(scenario, curve, Fraction(1))) is None
                continue
            for value in values_of(curve, draw):
                other = changed(scenario, curve, value)
                if other.problem.clock.exact:
                    assert curve.compute_period(value) == by_hand(other)
    return breakpoints


@pytest.mark.parametrize("rules", RULES, ids=["one", "headway", "both", "turn"])
def test_the_curve_is_the_period_of_the_changed_scenario(rules: Rules) -> None:
    breakpoints = 0
    for seed in range(14):
        draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
        scenario = random_fleet(seed, size=4 + seed % 4, robots=2 + seed % 4, rules=rules)
        try:
            breakpoints += check_curves(scenario, draw)
        except InputError:
            continue  # a robot that works where it lives
    assert breakpoints > 40


def test_sizes_lie_on_the_curve() -> None:
    breakpoints = 0
    for seed in range(1, 16, 2):  # those on grids: their ticks are exact
        draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
        breakpoints += check_curves(repeated(seed), draw)
    assert breakpoints > 10


def on_limited_lanes(draw: random.Random) -> Scenario:
    """Return robots on a lattice of lanes, some of which have a speed limit."""
    at = {f"v{x}{y}": [2 * x, 3 * y] for x in range(4) for y in range(3)}
    lanes = [
        [f"v{x}{y}", f"v{x + right}{y + 1 - right}"]
        for x in range(4)
        for y in range(3)
        for right in (0, 1)
        if f"v{x + right}{y + 1 - right}" in at
    ]
    limits = ["1/2", "3/4", 1, "3/2"]
    edges = [
        {
            "from": one,
            "to": other,
            **({"max_speed": draw.choice(limits)} if k % 3 else {}),
            **({"max_speed_by_type": {"wide": draw.choice(limits)}} if k % 4 else {}),
        }
        for k, (one, other) in enumerate(lanes)
    ]
    homes, stops = sorted(at)[:3], draw.sample(sorted(at)[3:], 3)
    robots = [
        {
            "name": f"R{k}",
            "home": home,
            "target": stop,
            "work": k,
            "speed": speed,
            **({"type": "wide"} if k == 2 else {}),
        }
        for k, (home, stop, speed) in enumerate(zip(homes, stops, [1, "1/2", 2], strict=True))
    ]
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": at, "edges": edges}},
            "robots": robots,
            "rules": {"occupancy": draw.choice(["one", "both"])},
        }
    )


def test_speed_limits_bend_the_curve_of_a_speed() -> None:
    breakpoints = 0
    for seed in range(12):
        draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
        breakpoints += check_curves(on_limited_lanes(draw), draw)
    assert breakpoints > 20
