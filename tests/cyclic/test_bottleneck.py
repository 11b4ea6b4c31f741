"""The bottleneck of two robots at one door, and what would help.

R1 lives in the west (N3) and works in the north (N1), R2 lives in the east (N5) and works in the
south (N7); the door (N4) is in the middle. R1 goes in and comes out, then R2.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from rightofway.cyclic.bottleneck import find_bottleneck
from rightofway.cyclic.route import make_cyclic_routes
from rightofway.cyclic.sensitivity import ParameterEffect, compute_parameter_effects, find_stages_at
from rightofway.model import BookingRules, Lap, Rules, Scenario, Tick
from rightofway.precedence import TimedEventGraph
from rightofway.site import VertexId
from tests.builders.fleets import grid_fleet
from tests.builders.periodic import timetable_of


def crossing(*, work: tuple[int, int] = (4, 2), rules: Rules | None = None) -> Scenario:
    return grid_fleet(
        ["@.@", "...", "@.@"],
        [("N3", "N1"), ("N5", "N7")],
        rules=rules or Rules(turn=Fraction(0)),
        work=work,
    )


def laps_of(scenario: Scenario) -> list[Lap]:
    """Home, door, work, door; the turn at home and at work is as the rules say."""
    door = scenario.roadmap.get_vertex("N4")
    laps = []
    for itinerary in scenario.problem.itineraries:
        stop, home = itinerary.stages
        laps.append(
            Lap(
                vertices=(itinerary.home, door, stop.vertex, door),
                dwell=(Tick(home.turn), Tick(0), Tick(stop.work + stop.turn), Tick(0)),
                drive=(itinerary.edge_ticks[0],) * 4,
            )
        )
    return laps


def build_graph_of_plan(scenario: Scenario) -> TimedEventGraph:
    timetable = timetable_of(
        laps_of(scenario), [[40, 110, 120, 130], [75, 145, 155, 165]], period=100
    )
    return TimedEventGraph(timetable, rules=scenario.problem.booking_rules)


def test_a_bottleneck_is_work_ways_and_rights_of_way() -> None:
    found = find_bottleneck(build_graph_of_plan(crossing()))
    assert [piece.kind for piece in found.pieces] == 2 * ["way", "work", "way", "right of way"]
    assert found.cycle_time == 12
    assert found.periods == 1
    assert found.robots == (0, 1)
    assert sum(piece.ticks for piece in found.pieces) == 12


def test_a_way_ends_at_home() -> None:
    """R2 is in and out while R1 works; R1 does not turn at home between two ways."""
    scenario = crossing(work=(40, 0), rules=Rules(turn=Fraction(0)))
    timetable = timetable_of(
        laps_of(scenario), [[44, 101, 102, 143], [40, 110, 120, 130]], period=100
    )
    found = find_bottleneck(TimedEventGraph(timetable, rules=BookingRules()))
    name = scenario.roadmap.name
    ways = [[name(at) for at in piece.places] for piece in found.pieces if piece.kind == "way"]
    assert ways == [["N3", "N4", "N1"], ["N1", "N4", "N3"]]
    assert found.robots == (0,)
    assert found.cycle_time == 44


def told(lever: ParameterEffect) -> tuple[str, int | None, int | None, float, float, float]:
    effect = lever.effect
    return (
        lever.kind,
        lever.robot,
        lever.stop,
        float(effect.gain),
        float(effect.until),
        float(effect.at_best),
    )


def test_what_helps_is_what_is_on_the_bottleneck_the_best_first() -> None:
    scenario = crossing()
    sensitivity = compute_parameter_effects(scenario, build_graph_of_plan(scenario))
    # R1 drives 3 of its 4 edges between entering the door and leaving it for home, and works for 4.
    assert [told(lever) for lever in sensitivity] == [
        ("work", 0, 0, 4.0, 1.0, 8.0),
        ("speed", 0, None, 3.0, 1.0, 9.0),
        ("speed", 1, None, 3.0, 1.0, 9.0),
        ("work", 1, 0, 2.0, 1.0, 10.0),
    ]
    # A tenth less work; or a tenth faster: 3 ticks of driving become 3 / 1.1.
    assert [lever.ten_per_cent for lever in sensitivity[:2]] == [
        Fraction(12) - Fraction(4, 10),
        Fraction(12) - (3 - Fraction(3) / Fraction(11, 10)),
    ]


def test_turning_and_headway_are_levers_of_their_own() -> None:
    scenario = crossing(rules=Rules(turn=Fraction(5), headway=Fraction(2)))
    sensitivity = {
        (lever.kind, lever.robot): lever
        for lever in compute_parameter_effects(scenario, build_graph_of_plan(scenario), most=9)
    }
    # Each turns once beyond the door; the door changes hands twice.
    assert float(sensitivity["turn", 0].effect.gain) == 5
    assert float(sensitivity["headway", None].effect.gain) == 4
    assert sensitivity["work", 0].effect.cycle_time == 12 + 2 * 5 + 2 * 2


def test_driving_into_a_place_booked_ahead_counts_as_driving() -> None:
    scenario = crossing(rules=Rules(turn=Fraction(0), occupancy="both"))
    sensitivity = {
        (lever.kind, lever.robot): lever
        for lever in compute_parameter_effects(scenario, build_graph_of_plan(scenario), most=9)
    }
    assert float(sensitivity["speed", 0].effect.gain) == 4
    assert sensitivity["speed", 0].effect.cycle_time == 14


def test_stages_are_found_in_the_visits_that_serve_them() -> None:
    scenario = crossing(rules=Rules(turn=Fraction(5)))
    lap, itinerary = laps_of(scenario)[0], scenario.problem.itineraries[0]
    stop, home = itinerary.stages
    assert find_stages_at(scenario.roadmap, itinerary, lap) == [[(1, home)], [], [(0, stop)], []]
    assert lap.vertices[2] == VertexId(scenario.roadmap.get_vertex("N1"))


def test_a_first_stop_at_home_and_the_end_of_a_lap_are_served_in_one_visit() -> None:
    """R1 works for 3 at home, then in the north: its visit at home serves stages 0 and 2."""
    scenario = crossing(rules=Rules(turn=Fraction(5)))
    robot = scenario.robots[0]
    at_home = replace(robot.stops[0], at=robot.home, work=Fraction(3))
    scenario = replace(
        scenario,
        robots=(replace(robot, stops=(at_home, *robot.stops)), *scenario.robots[1:]),
    )
    itinerary = scenario.problem.itineraries[0]
    first, north, end = itinerary.stages
    lap = next(route.lap for route in make_cyclic_routes(scenario) if route.robot == 0)
    tick = scenario.problem.clock.tick
    assert lap.dwell[0] * tick == 3 + 5  # it turns once, after its work at home
    assert find_stages_at(scenario.roadmap, itinerary, lap) == [
        [(0, first), (2, end)],
        [],
        [(1, north)],
        [],
    ]
