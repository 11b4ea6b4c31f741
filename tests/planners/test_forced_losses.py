"""Optimal plans come with the losses that force their flowtime, and keep them in files."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

import rightofway
from rightofway.errors import InputError
from rightofway.io import dump_plan, parse_plan
from rightofway.metrics import find_forced_losses, find_forced_makespan
from rightofway.model import ForcedLoss, Objective, Outcome, OutcomeKind, Plan, Scenario, Tick
from rightofway.report.plan import summarize_plan
from rightofway.report.plan_data import make_summary_data
from rightofway.report.quantities import Quantities
from rightofway.site import VertexId
from tests.builders.fleets import grid_fleet

DOOR = grid_fleet(["...", "@.@", "..."], [("N0", "N6"), ("N2", "N8")])


def lines_of(plan: Plan) -> list[str]:
    return summarize_plan(plan, Quantities.of(plan.scenario)).splitlines()


def alley() -> Scenario:
    """Return R1, R2 and R3, who all pass the door in N7 on their ways out and back."""
    rows = [".....", "@@.@@", "....."]
    return grid_fleet(rows, [("N0", "N10"), ("N4", "N14"), ("N2", "N12")])


@pytest.mark.parametrize("planner", ["auto", "cbs"])
def test_an_optimal_plan_says_which_robots_lose_time_in_every_plan(planner: str) -> None:
    """Alone both would be in N1 at tick 1, so one of them is a tick late: 9 + 10."""
    plan = rightofway.solve(DOOR, planner, time_limit=None)
    assert plan.flowtime == 19
    loss = ForcedLoss(robots=(0, 1), ticks=Tick(1), vertex=VertexId(1))
    assert plan.run.forced_losses == (loss,)
    assert lines_of(plan)[-2:] == [
        "In every plan, R1 and R2 lose at least 1 time unit to each other: alone they",
        "    would meet in N1.",
    ]
    data = make_summary_data(plan)["planner"]["forced_losses"]
    assert data == [{"robots": ["R1", "R2"], "ticks": 1, "vertex": "N1"}]


def test_where_no_robot_loses_time_nothing_is_to_be_explained() -> None:
    fleet = grid_fleet(["..", "..", ".."], [("N0", "N1"), ("N4", "N5")])
    plan = rightofway.solve(fleet, "cbs", time_limit=None)
    assert plan.run.forced_losses == ()
    assert "forced_losses" not in dump_plan(plan)["planner"]


def test_a_plan_that_is_not_optimal_explains_nothing() -> None:
    """Files can be changed: their outcome is only the best plan found, so no plan is excluded."""
    plan = rightofway.solve(DOOR, "cbs", time_limit=None)
    found = Outcome(kind=OutcomeKind.BEST_FOUND, bound=Tick(18))
    claimed = replace(plan, run=replace(plan.run, outcome=found))
    assert not any("In every plan" in line for line in lines_of(claimed))


def test_three_robots_lose_more_together_than_their_pairs() -> None:
    """All three pass the door, out and back.

    Each pair loses what one of them waits; no two pairs are without a common robot, so that pairs
    prove no more than one loss, and the three together prove more.
    """
    losses = find_forced_losses(alley())
    group = next(loss for loss in losses if loss.robots == (0, 1, 2))
    pairs = [loss for loss in losses if len(loss.robots) == 2]
    assert losses[0] == group
    assert group.ticks > max(loss.ticks for loss in pairs)
    plan = rightofway.solve(alley(), "cbs", time_limit=None)
    assert plan.flowtime - plan.lower_bound == group.ticks
    text = " ".join(" ".join(lines_of(plan)).split())
    assert "In every plan, R1, R2 and R3 lose at least" in text
    assert "to each other: alone, two of them would meet in" in text


def test_robots_with_weights_lose_time_by_weight() -> None:
    """One of the two is a tick late; best the lighter one, of weight 2 beside 3."""
    first, second = DOOR.robots
    robots = replace(first, weight=Fraction(3, 2)), replace(second, weight=Fraction(1))
    plan = rightofway.solve(replace(DOOR, robots=robots), "cbs", time_limit=None)
    loss = ForcedLoss(
        robots=(0, 1), ticks=Tick(2), vertex=VertexId(1), objective=Objective.WEIGHTED
    )
    assert plan.run.forced_losses == (loss,)
    assert lines_of(plan)[-2:] == [
        "In every plan, R1 and R2 lose at least 2 time units by weight to each other:",
        "    alone they would meet in N1.",
    ]


def test_robots_lose_time_or_surcharges_in_every_plan() -> None:
    """Each edge costs 2 beside its time: a tick of waiting is cheaper than any way round."""
    roadmap = DOOR.roadmap
    charged = tuple(replace(each, surcharge=Fraction(2)) for each in roadmap.edge_classes)
    scenario = replace(DOOR, roadmap=replace(roadmap, edge_classes=charged))
    plan = rightofway.solve(scenario, "cbs", time_limit=None)
    loss = ForcedLoss(robots=(0, 1), ticks=Tick(1), vertex=VertexId(1), objective=Objective.COST)
    assert plan.run.forced_losses == (loss,)
    assert lines_of(plan)[-2:] == [
        "In every plan, R1 and R2 lose at least 1 time unit with surcharges to each",
        "    other: alone they would meet in N1.",
    ]
    assert parse_plan(dump_plan(plan)).run.forced_losses == (loss,)


@pytest.mark.parametrize("planner", ["auto", "cbs"])
def test_the_least_makespan_is_forced_by_the_robots_that_need_as_long(planner: str) -> None:
    """Alone both would be home at tick 9, and in N1 at tick 1, so one of them is home at 10."""
    plan = rightofway.solve(DOOR, planner, time_limit=None, options={"objective": "makespan"})
    loss = ForcedLoss(
        robots=(0, 1), ticks=Tick(10), vertex=VertexId(1), objective=Objective.MAKESPAN
    )
    assert plan.run.forced_losses == (loss,)
    assert lines_of(plan)[-2:] == [
        "No plan ends before 10 time units: R1 and R2 need as long however they pass each",
        "    other; alone they would meet in N1.",
    ]


def test_one_robot_that_needs_as_long_alone_forces_the_makespan() -> None:
    """R1 drives 4 cells each way and turns, all in 2 ticks a cell."""
    first, second = DOOR.robots
    fleet = replace(DOOR, robots=(replace(first, speed=Fraction(1, 2)), second))
    plan = rightofway.solve(fleet, "cbs", time_limit=None, options={"objective": "makespan"})
    loss = ForcedLoss(robots=(0,), ticks=Tick(18), vertex=VertexId(4), objective=Objective.MAKESPAN)
    assert plan.run.forced_losses == (loss,)
    assert lines_of(plan)[-1] == "No plan ends before 18 time units: R1 alone needs as long."
    assert parse_plan(dump_plan(plan)).run.forced_losses == (loss,)


def test_three_robots_force_a_makespan_that_none_of_their_pairs_forces() -> None:
    plan = rightofway.solve(alley(), "cbs", time_limit=None, options={"objective": "makespan"})
    assert [loss.robots for loss in plan.run.forced_losses] == [(0, 1, 2)]
    text = " ".join(" ".join(lines_of(plan)).split())
    assert "R1, R2 and R3 need as long however they pass each other; alone, two of them" in text
    before = find_forced_makespan(alley(), plan.makespan - 1)
    assert before, "sooner than the least makespan, more is forced"
    assert find_forced_makespan(alley(), plan.makespan + 1) == ()


def test_makespan_and_flowtime_are_forced_by_losses_of_both() -> None:
    plan = rightofway.solve(DOOR, "cbs", time_limit=None, options={"objective": "both"})
    objectives = [loss.objective for loss in plan.run.forced_losses]
    assert objectives == [Objective.MAKESPAN, Objective.FLOWTIME]


def test_forced_losses_are_kept_in_files_and_older_files_open_without_them() -> None:
    plan = rightofway.solve(DOOR, "cbs", time_limit=None)
    document = dump_plan(plan)
    assert parse_plan(document).run.forced_losses == plan.run.forced_losses
    del document["planner"]["forced_losses"]
    assert parse_plan(document).run.forced_losses == ()


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"robots": ["R1"]}, "planner.forced_losses[0].robots: 'R1' loses no time to itself"),
        ({"robots": []}, "planner.forced_losses[0].robots: "),
        ({"objective": "makespan and flowtime"}, "planner.forced_losses[0].objective: "),
        ({"robots": ["R1", "R1"]}, "planner.forced_losses[0].robots: a robot is named twice"),
        ({"robots": ["R1", "R9"]}, "planner.forced_losses[0].robots: no robot is named 'R9'"),
        ({"vertex": "N3"}, "planner.forced_losses[0].vertex: "),
        ({"ticks": 0}, "planner.forced_losses[0].ticks: "),
    ],
)
def test_a_forced_loss_that_cannot_be_is_refused_with_its_place(
    change: dict[str, Any], fault: str
) -> None:
    document = dump_plan(rightofway.solve(DOOR, "cbs", time_limit=None))
    document["planner"]["forced_losses"][0] |= change
    with pytest.raises(InputError) as caught:
        parse_plan(document)
    assert fault in str(caught.value)
