"""The rule of release in chaos, on any fleet."""

from __future__ import annotations

from hypothesis import strategies as st

from rightofway.model import Scenario
from rightofway.precedence import ReleaseGraph
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, planned
from tests.builders.chaos import KINDS, knows, run_chaos
from tests.builders.laws import law, leave
from tests.builders.standstill import StandingFleet

planners, seeds = st.sampled_from(STRICT), st.integers(0, 2**32 - 1)


@law(any_fleet(without={"closures"}), planners, seeds, st.sampled_from(sorted(KINDS)))
def test_no_chaos_makes_robots_meet_or_lose_work(
    fleet: Scenario, planner: str, chance: int, kind: str
) -> None:
    """Closures are kept by the clock, and the rule reads none."""
    plan = planned(fleet, planner)
    if ReleaseGraph.of(fleet, plan.tracks).find_rotation():
        leave("a rotation is released by no order")
    if not knows(kind, plan):
        leave("laps need robots that return home")
    run_chaos(plan, chance, KINDS[kind])


@law(any_fleet(without={"closures"}), planners, seeds)
def test_no_robot_that_could_drive_stands_without_a_line(
    fleet: Scenario, planner: str, chance: int
) -> None:
    """Robots are held, places closed; work that can be reached is done, or the log says why not."""
    plan = planned(fleet, planner)
    if ReleaseGraph.of(fleet, plan.tracks).find_rotation():
        leave("a rotation is released by no order")
    standing = StandingFleet(plan, chance)
    standing.drive(30)
    assert standing.list_silent() == []
    assert standing.trouble or standing.list_free() == []
