"""Vertices that robots only drive through, with breakdowns on the way through."""

from __future__ import annotations

from fractions import Fraction

import rightofway
from rightofway import FleetBuilder, solve


def test_closures_are_known_where_a_robot_that_broke_down_blocks_every_lane() -> None:
    """R1 breaks down on the way through P and blocks all lanes: nothing is near to the closure."""
    fleet = FleetBuilder(ends="none")
    for name, x, y in [("A", 0, 0), ("B", 4, 0), ("C", 2, 3)]:
        fleet.add_vertex(name, x, y)
    fleet.add_vertex("P", 2, 0, is_passed=True)
    for name in "ABC":
        fleet.add_edge(name, "P")
    fleet.add_robot("R1", home="A", target="B").add_robot("R2", home="C", target="A")
    fleet.add_closure(at="C", from_=90, until=99, radius=Fraction(1, 2))
    plan = solve(fleet.build_scenario(), "prioritized")
    result = rightofway.simulate(plan, delays=["stop:R1@3"], runs=1, replan=True)
    assert result.runs == 1
    assert result.collisions == 0
