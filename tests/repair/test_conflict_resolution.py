"""What all rules for conflicts share."""

from __future__ import annotations

from fractions import Fraction

from rightofway.model import Rules
from rightofway.planners import PlanRequest
from rightofway.planners.two_level import plan_by_two_levels
from rightofway.repair.conflict_resolution import PartialPlan
from rightofway.repair.routing import find_shortest_routes
from rightofway.search import Distances
from tests.builders.fleets import grid_fleet


def test_a_deadlock_is_explained_by_its_circle() -> None:
    """Four robots fill a ring, each wants the next place and books it before it moves."""
    trips = [("N0", "N1"), ("N1", "N3"), ("N3", "N2"), ("N2", "N0")]
    rules = Rules(occupancy="both", ends="none", turn=Fraction(0))
    scenario = grid_fleet(["..", ".."], trips, rules=rules)
    routes = find_shortest_routes(scenario, Distances(scenario.roadmap))
    plan = PartialPlan(PlanRequest(scenario=scenario), routes)
    plan.resolve_all(plan_by_two_levels)
    [why] = plan.deferred.values()
    apart, _, circle = str(why).partition(": in a circle, ")
    assert apart.startswith("waiting cannot keep ")
    names = circle.removesuffix(" would each wait for the next").split(", ")
    start = names.index("R1")
    assert names[start:] + names[:start] == ["R1", "R2", "R3", "R4"]
