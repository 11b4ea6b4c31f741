"""A robot that waits goes first instead: on the same routes, on others, or not, with a reason."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import strategies as st

import rightofway
from rightofway.check import check
from rightofway.errors import GaveUp, InputError
from rightofway.facts import Fact
from rightofway.model import Plan, Rules, Scenario, Tick, compute_completions
from rightofway.repair.flip import Flipped, flip_right_of_way
from tests.builders.any_fleet import any_fleet
from tests.builders.any_plan import STRICT, by_both_judges, planned
from tests.builders.fleets import grid_fleet
from tests.builders.laws import law
from tests.builders.planned_jobs import make_plan


def longest_wait(plan: Plan) -> tuple[int, int, Tick]:
    """Return the robot of the longest wait for another one, that one, and when the wait ends."""
    losses = [loss for one in plan.lost_time for loss in one.losses if loss.for_robot is not None]
    loss = max(losses, key=lambda loss: loss.ticks)
    assert loss.for_robot is not None
    return loss.robot, loss.for_robot, loss.end


def answered(plan: Plan, waits: int, goes_first: int, end: Tick) -> Flipped | None:
    """Return the answer; None where it is a reason."""
    try:
        return flip_right_of_way(plan, waits, goes_first, end)
    except GaveUp:
        return None


def test_where_both_share_a_door_the_routes_stay() -> None:
    """Both need four moves through the middle; who goes second comes a move later."""
    rows, rules = ["...", "@.@", "..."], Rules(ends="none")
    fleet = grid_fleet(rows, [("N0", "N6"), ("N2", "N8")], rules=rules)
    plan = rightofway.solve(fleet, "two-level")
    waits, goes_first, end = longest_wait(plan)
    answer = flip_right_of_way(plan, waits, goes_first, end)
    assert answer.keeps_routes
    before, after = (compute_completions(fleet, one) for one in (plan.tracks, answer.tracks))
    assert (before[waits], before[goes_first]) == (5, 4)
    assert (after[waits], after[goes_first]) == (4, 5)


def test_a_robot_that_starts_or_ends_in_the_way_is_named_where_there_is_no_other_way() -> None:
    """R1 follows the slow R2 along a line: out of N0, and on to N3, which R2 passes."""
    fleet = grid_fleet(
        ["....."],
        [("N0", "N3"), ("N1", "N4")],
        rules=Rules(ends="none"),
        speeds=(Fraction(1), Fraction(1, 3)),
    )
    plan = rightofway.solve(fleet, "two-level")
    why = "R1 cannot go before R2: R2 starts in its way, and no other way brings R1 home sooner"
    with pytest.raises(GaveUp, match=why):
        flip_right_of_way(plan, 0, 1, Tick(0))
    with pytest.raises(GaveUp, match="R1 ends in the way of R2"):
        flip_right_of_way(plan, *longest_wait(plan))


def test_a_plan_with_jobs_is_refused() -> None:
    with pytest.raises(InputError, match="of a plan with jobs are not reversed"):
        flip_right_of_way(make_plan(), 0, 1, Tick(0))


def test_a_plan_with_swaps_is_refused() -> None:
    plan = rightofway.solve(grid_fleet(["....", "...."], [("N0", "N3"), ("N3", "N0")]), "paper")
    assert not check(plan).ok
    with pytest.raises(GaveUp, match="the plan has 2 faults: no right of way can be") as refused:
        flip_right_of_way(plan, 0, 1, Tick(1))
    assert refused.value.reason == Fact("plan with faults", faults=2)


@law(any_fleet(robots=(2, 4)), st.sampled_from(STRICT))
def test_answers_are_plans_that_keep_all_rules(fleet: Scenario, planner: str) -> None:
    plan = planned(fleet, planner)
    for one in plan.lost_time:
        for loss in one.losses:
            if loss.for_robot is None:
                continue
            answer = answered(plan, loss.robot, loss.for_robot, loss.end)
            if answer is None:
                continue
            found = Plan(scenario=plan.scenario, tracks=answer.tracks, run=plan.run)
            assert by_both_judges(found) == (set(), set())
            is_same = all(
                len(new) == len(old) and (new.vertices == old.vertices).all()
                for new, old in zip(answer.tracks, plan.tracks, strict=True)
            )
            assert is_same or not answer.keeps_routes
