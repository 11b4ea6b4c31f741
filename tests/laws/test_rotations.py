"""A rule that forbids rotations costs nothing where bookings leave no room for any."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st

import rightofway
from rightofway.cyclic import run_laps
from rightofway.errors import InputError, RightOfWayError
from rightofway.model import Scenario
from tests.builders.any_fleet import LAPS_REFUSE, any_fleet
from tests.builders.laws import law, leave

PLANNERS = ["lacam", "lns", "prioritized", "two-level", "priority-search", "local-search", "cbs"]

WITHOUT_ROOM = any_fleet(without={"no rotations"}, always={"both"}) | any_fleet(
    without={"no rotations"}, always={"headway"}
)
"""A robot never enters a vertex at the instant at which another one leaves it."""


def forbid_rotations(fleet: Scenario) -> Scenario:
    return replace(fleet, rules=replace(fleet.rules, rotations=False))


def list_enters(fleet: Scenario, planner: str) -> list[list[int]] | str:
    """Return the enters of each robot, or why there is no plan."""
    effort = {"iterations": 50} if planner == "lns" else {}
    try:
        plan = rightofway.solve(fleet, planner, time_limit=20, **effort)
    except InputError:
        leave("the planner refuses the fleet")
    except RightOfWayError as refused:
        return str(refused)
    return [track.enter.tolist() for track in plan.tracks]


@law(WITHOUT_ROOM, st.sampled_from(PLANNERS))
def test_plans_are_equal_where_no_robot_can_follow_at_once(fleet: Scenario, planner: str) -> None:
    assert list_enters(forbid_rotations(fleet), planner) == list_enters(fleet, planner)


@law(
    any_fleet(
        robots=(2, 4),
        without={*LAPS_REFUSE, "no rotations"},
        always={"both"},
        apart=True,
        joined=True,
    )
)
def test_laps_are_equal_where_no_robot_can_follow_at_once(fleet: Scenario) -> None:
    try:
        run = run_laps(fleet, "first-come", time_limit=5)
    except RightOfWayError:
        leave("no laps exist")
    strict = run_laps(forbid_rotations(fleet), "first-come", time_limit=5)
    for group, other in zip(run.groups, strict.groups, strict=True):
        assert [*map(list, other.history)] == [*map(list, group.history)]
