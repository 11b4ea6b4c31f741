"""What planners are asked to minimize, and how they and reports say so."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

import rightofway
from rightofway import FleetBuilder, InputError, Objective, Plan
from rightofway.model import Robot, Rules, Scenario, Stop
from rightofway.report.plan import summarize_plan
from rightofway.report.quantities import Quantities
from rightofway.site import VertexId, make_grid_roadmap


def fleet(homes: list[int], targets: list[int], speeds: list[str], works: list[int]) -> Scenario:
    """Return robots on a grid of three by three cells."""
    rows = enumerate(zip(homes, targets, speeds, works, strict=True), 1)
    robots = tuple(
        Robot(
            name=f"R{k}",
            home=VertexId(home),
            stops=(Stop(at=VertexId(target), work=Fraction(work)),),
            speed=Fraction(speed),
        )
        for k, (home, target, speed, work) in rows
    )
    return Scenario(roadmap=make_grid_roadmap(["..."] * 3), robots=robots, rules=Rules())


SLOW = fleet([3, 0, 4], [0, 2, 1], ["1", "1/3", "1"], [0, 1, 2])
"""The slow R2 completes last: the sum of two completions lets it wait, the later one does not."""


def _report(plan: Plan) -> str:
    return " ".join(summarize_plan(plan, Quantities.of(plan.scenario)).split())


def test_the_robot_level_of_two_level_reads_the_objective() -> None:
    by_sum, by_last = (
        rightofway.solve(SLOW, "two-level", objective=name) for name in ("flowtime", "makespan")
    )
    assert (by_sum.makespan, by_sum.flowtime) == (18, 30)
    assert (by_last.makespan, by_last.flowtime) == (16, 31)


def test_the_robot_level_of_two_level_reads_weights() -> None:
    """A tick of R2 counts as ten of another robot: it goes first, as for the makespan."""
    robots = tuple(
        replace(robot, weight=Fraction(10 if robot.name == "R2" else 1)) for robot in SLOW.robots
    )
    plan = rightofway.solve(replace(SLOW, robots=robots), "two-level")
    assert plan["R2"].completion == plan.makespan == 16


@pytest.mark.parametrize("planner", ["auto", "cbs", "lns", "two-level"])
@pytest.mark.parametrize("name", ["makespan", "both"])
def test_an_outcome_names_the_objective_that_was_asked_for(planner: str, name: str) -> None:
    limits = {"lns": {"iterations": 20}, "auto": {"iterations": 20}}
    options = {"objective": name, **limits.get(planner, {})}
    plan = rightofway.solve(SLOW, planner, options=options)
    assert plan.run.outcome is not None
    assert plan.run.outcome.objective is {"makespan": Objective.MAKESPAN}.get(name, Objective.BOTH)


@pytest.mark.parametrize("planner", ["auto", "cbs", "lns", "two-level"])
def test_a_makespan_leaves_out_surcharges_and_is_refused_with_them(planner: str) -> None:
    floor = FleetBuilder(ends="none").add_vertex("A", 0, 0).add_vertex("B", 1, 0)
    floor = floor.add_edge("A", "B", 1, surcharge="1")
    scenario = floor.add_robot("R1", home="A", target="B").build_scenario()
    with pytest.raises(InputError, match=r"options\.objective: makespan leaves out the surcharges"):
        rightofway.solve(scenario, planner, objective="makespan")


def test_a_report_says_what_was_minimized_and_how_far_the_bound_is() -> None:
    """Without a proof, the robot that takes longest alone bounds the makespan: 16 ticks."""
    plan = rightofway.solve(SLOW, "two-level", objective="makespan")
    assert "optimal, no plan has a smaller makespan" in _report(plan)
    waits = rightofway.solve(SLOW, "two-level", objective="both")
    assert "above the least makespan and flowtime" in _report(waits)


def test_a_report_on_a_proven_plan_of_a_fleet_with_weights_names_them() -> None:
    robots = tuple(replace(robot, weight=Fraction(k + 1)) for k, robot in enumerate(SLOW.robots))
    plan = rightofway.solve(replace(SLOW, robots=robots), "cbs")
    report = _report(plan)
    assert "optimal, no plan has a smaller weighted flowtime" in report
