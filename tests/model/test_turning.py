"""Turning on the spot: angles, ticks, and what a fleet with turn rates is made of."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import networkx as nx  # type: ignore[import-untyped]
import pytest

from rightofway import solve
from rightofway.errors import InputError
from rightofway.fleet_builder import FleetBuilder
from rightofway.model import Clock, Robot, Rules, Scenario, Stop, Track, make_route_through
from rightofway.model.turning import compute_turnings, measure_angles
from rightofway.site import Edge, Roadmap, VertexId, make_grid_roadmap, make_roadmap
from tests.builders.fleets import grid_fleet


def lanes(positions: dict[str, tuple[float, float]], *pairs: str) -> Roadmap:
    """Return lanes of length 1 between vertices of one letter: ``AB`` leads from A to B."""
    edges = [Edge(tail=pair[0], head=pair[1], length=Fraction(1)) for pair in pairs]
    return make_roadmap(positions, edges)


def angle(roadmap: Roadmap, before: int, after: int) -> int:
    angles = measure_angles(roadmap)
    return angles.angles[int(angles.kind[angles.offset[before] + after])]


def test_a_grid_has_three_kinds_of_angles() -> None:
    assert measure_angles(make_grid_roadmap(["...", "..."])).angles == (0, 90_000_000, 180_000_000)


@pytest.mark.parametrize(
    ("to", "micro"),
    [
        ((2.0, 0.0), 0),
        ((2.0, 1.0), 45_000_000),
        ((1.0, 1.0), 90_000_000),
        ((0.5, -0.5), 135_000_000),
        ((0.0, 0.0), 180_000_000),
        ((3.0, 1.0), 26_565_051),  # atan(1/2) = 26.5650511...
    ],
)
def test_an_angle_is_the_shorter_way_round_to_a_millionth_of_a_degree(
    to: tuple[float, float], micro: int
) -> None:
    roadmap = lanes({"A": (0.0, 0.0), "B": (1.0, 0.0), "C": to}, "AB", "BC")
    assert angle(roadmap, 0, 1) == micro


def test_headings_on_both_sides_of_west_are_close_to_each_other() -> None:
    """From 179.4 degrees to -179.4: 1.145842 degrees, twice atan(0.01)."""
    roadmap = lanes({"A": (200.0, 0.0), "B": (100.0, 1.0), "C": (0.0, 0.0)}, "AB", "BC")
    assert angle(roadmap, 0, 1) == 1_145_877


def test_pieces_of_a_straight_lane_make_no_angle() -> None:
    """Thirds have no exact coordinates: the angles between them are rounded away."""
    third, twice = 1 / 3, 2 / 3
    at = {"A": (0.0, 0.0), "B": (third, third / 7), "C": (twice, twice / 7), "D": (1.0, 1 / 7)}
    roadmap = lanes(at, "AB", "BC", "CD")
    assert measure_angles(roadmap).angles == (0,)


def test_an_edge_without_a_length_in_the_plane_has_no_heading() -> None:
    """A lift from B to C: no turn into it, and none out of it."""
    at = {"A": (0.0, 0.0), "B": (1.0, 0.0), "C": (1.0, 0.0), "D": (1.0, 1.0)}
    assert measure_angles(lanes(at, "AB", "BC", "CD")).angles == (0,)


def test_moving_a_roadmap_changes_no_angle() -> None:
    at = {"A": (0.1, 0.2), "B": (1.3, 0.7), "C": (2.9, -0.4), "D": (0.6, 3.3)}
    moved = {name: (x + 1234.5, y - 0.3) for name, (x, y) in at.items()}
    pairs = ("AB", "BC", "CD", "DB", "BA")
    rounded = {name: (round(x, 6), round(y, 6)) for name, (x, y) in moved.items()}
    assert measure_angles(lanes(at, *pairs)).angles == measure_angles(lanes(rounded, *pairs)).angles


def test_a_turn_is_rounded_up_to_ticks() -> None:
    """At 40 degrees per time unit: 90 degrees take 2.25, 180 take 4.5; ticks last 1/2."""
    roadmap = make_grid_roadmap(["...", "..."])
    (turning,) = compute_turnings(roadmap, [Fraction(40)], Clock(tick=Fraction(1, 2)))
    assert turning is not None
    assert turning.ticks.tolist() == [0, 5, 9]


def test_robots_of_one_rate_share_their_turns() -> None:
    one, none, other = compute_turnings(
        make_grid_roadmap(["...", "..."]),
        [Fraction(45), None, Fraction(45)],
        Clock(tick=Fraction(1)),
    )
    assert one is other
    assert none is None


def corner(rules: Rules) -> Scenario:
    return grid_fleet(["..", "@."], [("N0", "N3")], rules=rules)


def test_a_route_turns_at_corners_and_stops_alike() -> None:
    """East, south; back north, west: 90 degrees at the corner, twice, and 180 at the stop."""
    scenario = corner(Rules(turn_rate=Fraction(90)))
    roadmap, itinerary = scenario.roadmap, scenario.problem.itineraries[0]
    vertices = [roadmap.get_vertex(name) for name in ("N0", "N1", "N3", "N1", "N0")]
    assert make_route_through(roadmap, itinerary, vertices).dwell == (0, 1, 2, 1, 0)


@pytest.mark.parametrize(
    ("rules", "turn"),
    [
        (Rules(), 1),
        (Rules(turn_rate=Fraction(90)), 0),
        (Rules(turn_rate=Fraction(90), turn=Fraction(3)), 3),
        (Rules(turn_rate=Fraction(90), turn="cell"), 1),
    ],
)
def test_a_stop_has_no_turn_beside_a_turn_rate_unless_one_is_given(rules: Rules, turn: int) -> None:
    assert corner(rules).problem.itineraries[0].stages[0].turn == turn


def test_a_rate_of_its_own_stands_above_that_of_the_rules() -> None:
    scenario = corner(Rules(turn_rate=Fraction(90)))
    robot = replace(scenario.robots[0], turn_rate=Fraction(45))
    turning = replace(scenario, robots=(robot,)).problem.itineraries[0].turning
    assert turning is not None
    assert turning.ticks.tolist() == [2, 4]


def test_the_tick_does_not_depend_on_the_rate() -> None:
    """At 77 degrees per time unit a quarter turn takes 90/77, rounded up to 2 ticks of 1."""
    scenario = corner(Rules(turn_rate=Fraction(77)))
    assert scenario.problem.clock == Clock(tick=Fraction(1))
    turning = scenario.problem.itineraries[0].turning
    assert turning is not None
    assert turning.ticks.tolist() == [2, 3]


def test_rates_that_are_not_positive_are_refused() -> None:
    with pytest.raises(InputError, match="rules: turn_rate: 0 is not positive"):
        Rules(turn_rate=Fraction(0))
    with pytest.raises(InputError, match="robot 'R1': turn_rate: -1 is not positive"):
        replace(corner(Rules()).robots[0], turn_rate=Fraction(-1))


def test_a_rate_that_takes_too_many_ticks_is_refused() -> None:
    with pytest.raises(InputError) as caught:
        corner(Rules(turn_rate=Fraction(1, 10**8)))
    assert [str(fault) for fault in caught.value.faults] == [
        (
            "robots[0].turn_rate: 1/100000000 is too slow: a turn takes 18000000000 ticks of 1"
            " (give a faster one)"
        )
    ]


def test_a_graph_without_positions_has_no_headings() -> None:
    fleet = FleetBuilder(graph=nx.path_graph(["A", "B", "C"]), turn_rate=90)
    fleet.add_robot("R1", home="A", target="C")
    with pytest.raises(InputError, match="turn_rate: needs positions, and the graph has none"):
        fleet.build_scenario()


def test_a_roadmap_without_edges_that_follow_each_other_is_planned() -> None:
    scenario = Scenario(
        roadmap=lanes({"A": (0.0, 0.0), "B": (1.0, 0.0)}, "AB"),
        robots=(Robot(name="R1", home=VertexId(0), stops=(Stop(at=VertexId(1)),)),),
        rules=Rules(turn_rate=Fraction(90), ends="none"),
    )
    assert solve(scenario).tracks == (Track.of([0, 1], [0, 1]),)


def test_a_builder_takes_rates_of_the_fleet_and_of_a_robot() -> None:
    fleet = FleetBuilder(grid=["..", ".."], turn_rate=60)
    fleet.add_robot("R1", home="N0", target="N3", turn_rate="45/2")
    scenario = fleet.add_robot("R2", home="N1", target="N2").build_scenario()
    assert scenario.rules.turn_rate == 60
    assert [robot.turn_rate for robot in scenario.robots] == [Fraction(45, 2), None]
