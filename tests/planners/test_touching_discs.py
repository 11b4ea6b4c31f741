"""Discs that touch are apart, and nothing that comes before the decision rounds a position."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rightofway import FleetBuilder, check, solve
from rightofway.errors import NoPlanExists
from rightofway.io import (
    dump_plan,
    dump_scenario,
    load,
    load_plan,
    parse_plan,
    parse_scenario,
    write_plan,
    write_scenario,
)
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.site import VertexId
from rightofway.site.quadtree import build_roadmap_of_squares

TRIPLES = [(3, 4, 5), (5, 12, 13), (8, 15, 17)]
"""Sides of right-angled triangles: lanes of rational directions have rational normals."""

lanes = pytest.mark.parametrize("triple", TRIPLES)
cuts = pytest.mark.parametrize("pieces", [2, 3, 6, 7])


def side_by_side(
    triple: tuple[int, int, int], pieces: int, *, apart: Fraction = Fraction(1, 2)
) -> FleetBuilder:
    """Return two lanes of length 5 side by side, and two robots of radius 1/4 in opposite ways."""
    x, y, whole = triple
    fleet = FleetBuilder(ends="none", spacing=Fraction(5, pieces))
    for name, along, across in (("A", 0, 0), ("B", 5, 0), ("C", 0, 1), ("D", 5, 1)):
        at = (along * x - across * apart * y, along * y + across * apart * x)
        fleet.add_vertex(name, *(Fraction(part) / whole for part in at))
    fleet.add_edge("A", "B", 5).add_edge("C", "D", 5)
    fleet.add_robot("R1", home="A", target="B", radius="1/4")
    return fleet.add_robot("R2", home="D", target="C", radius="1/4")


@lanes
@cuts
def test_robots_on_lanes_that_touch_drive_past_each_other(
    triple: tuple[int, int, int], pieces: int
) -> None:
    """Joints of the two lanes are 1/2 apart, where the discs touch. Each robot needs 5 alone."""
    plan = solve(side_by_side(triple, pieces).build_scenario(), "lns", iterations=1)
    assert plan.flowtime * plan.scenario.problem.clock.tick == 10
    assert check(plan).ok


@lanes
def test_robots_on_lanes_that_are_any_nearer_do_not(triple: tuple[int, int, int]) -> None:
    nearer = side_by_side(triple, 3, apart=Fraction(1, 2) - Fraction(1, 10**12))
    with pytest.raises(NoPlanExists, match="have no room to pass each other"):
        solve(nearer.build_scenario())


@lanes
@cuts
def test_a_closure_that_touches_a_lane_leaves_it_open(
    triple: tuple[int, int, int], pieces: int
) -> None:
    """Without R2, and with a joint of its lane closed as far as 1/4 around."""
    fleet = side_by_side(triple, pieces).add_closure(at="C-D/1", radius="1/4")
    whole = fleet.build_scenario()
    alone = Scenario(
        roadmap=whole.roadmap, robots=whole.robots[:1], rules=whole.rules, closures=whole.closures
    )
    plan = solve(alone, "lns", iterations=1)
    assert check(plan).ok


@lanes
@cuts
@pytest.mark.parametrize("ending", ["yaml", "json", "xlsx"])
def test_a_file_keeps_positions_exactly(
    triple: tuple[int, int, int], pieces: int, ending: str, tmp_path: Path
) -> None:
    scenario = side_by_side(triple, pieces).build_scenario()
    file = tmp_path / f"touching.{ending}"
    write_scenario(scenario, file)
    roadmap = load(file).roadmap
    assert roadmap.list_positions() == scenario.roadmap.list_positions()
    x, y, whole = triple
    joint = Fraction(5 * x, whole * pieces), Fraction(5 * y, whole * pieces)
    assert roadmap.get_point(roadmap.get_vertex("A-B/1")) == joint


def test_a_plan_file_keeps_positions_exactly(tmp_path: Path) -> None:
    plan = solve(side_by_side((3, 4, 5), 3).build_scenario(), "lns", iterations=1)
    file = tmp_path / "plan.json"
    write_plan(plan, file)
    again = load_plan(file)
    assert again.scenario.roadmap == plan.scenario.roadmap
    assert check(again).ok
    assert parse_plan(dump_plan(again)).scenario.roadmap == plan.scenario.roadmap


def document(**changes: Any) -> dict[str, Any]:
    """Return two vertices at thirds, 2/3 apart, and robots that live there."""
    return {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {"A": ["1/3", "1/7"], "B": [1, "1/7"], "C": ["1/3", 9], "D": [1, 9]},
                "edges": [["A", "C"], ["B", "D"]],
            },
            **changes,
        },
        "robots": [
            {"name": "R1", "home": "A", "target": "C", "radius": "1/3"},
            {"name": "R2", "home": "B", "target": "D", "radius": "1/3"},
        ],
        "rules": {"return": "none"},
    }


@pytest.mark.parametrize("changes", [{}, {"y": "up"}, {"spacing": "3/7"}], ids=str)
def test_coordinates_given_as_fractions_stay_exact(changes: dict[str, Any]) -> None:
    """The robots touch all the way: they need 2/3, which is how far their lanes are apart."""
    scenario = parse_scenario(document(**changes))
    assert scenario.roadmap.get_point(0) == (Fraction(1, 3), Fraction(1, 7))
    plan = solve(scenario, "lns", iterations=1)
    assert check(plan).ok
    assert parse_plan(dump_plan(plan)).scenario.roadmap == scenario.roadmap


@pytest.mark.parametrize("yaw", ["0", "1/2"])
def test_adaptive_cells_of_a_third_lie_at_thirds(yaw: str) -> None:
    """A corner at 1/10 of a floor that begins at 1/5: the writer adds both exactly."""
    roadmap = build_roadmap_of_squares(
        np.ones((2, 4), bool),
        Fraction(1, 3),
        corner=(Fraction(1, 10), Fraction(1, 5)),
        origin=(Fraction(1, 5), Fraction(1, 10)),
        yaw=Fraction(yaw),
        y_up=True,
    )
    assert roadmap.sides == (Fraction(2, 3), Fraction(2, 3))
    (x, y), (to_x, to_y) = roadmap.list_positions()
    assert (to_x - x, to_y - y) == (Fraction(2, 3), Fraction(0))
    robot = Robot(name="R1", home=VertexId(0), stops=(Stop(at=VertexId(1)),))
    scenario = Scenario(roadmap=roadmap, robots=(robot,), rules=Rules())
    assert parse_scenario(dump_scenario(scenario)).roadmap == roadmap


def test_positions_without_a_common_measure_are_refused() -> None:
    """The product of all primes below 12 000 has more than 2**14 bits: about 12 000 / ln 2."""
    primes = [n for n in range(2, 12_000) if all(n % k for k in range(2, int(n**0.5) + 1))]
    fleet = FleetBuilder(ends="none")
    for k, prime in enumerate(primes):
        fleet.add_vertex(f"V{k}", Fraction(k * prime + 1, prime), 0)
    with pytest.raises(ValueError, match=r"too large a common multiple .give decimals"):
        fleet.add_edge("V0", "V1").add_robot("R1", home="V0", target="V1").build_scenario()
