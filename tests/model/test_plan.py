"""What a plan answers, and how values of the model look in one line."""

from __future__ import annotations

import sys
from types import SimpleNamespace
from typing import Any

import pytest

import rightofway
from rightofway import FleetBuilder, InputError, Objective, Plan, PlannerRun, Track


def waiting() -> Plan:
    """R2 waits two ticks at N5 until R1 is past N4, and both end where they work."""
    fleet = FleetBuilder(grid=["...", "...", "..."], ends="none", turn=0)
    fleet.add_robot("R1", home="N1", target="N7").add_robot("R2", home="N5", target="N3", work=1)
    tracks = (Track.of([1, 4, 7], [0, 1, 2]), Track.of([5, 4, 3], [0, 2, 3]))
    return Plan(scenario=fleet.build_scenario(), tracks=tracks, run=PlannerRun(name="hand"))


def test_a_plan_answers_what_it_costs() -> None:
    """R1 is done at tick 2. R2 would be at N3 at tick 2 and done at 3; it waits a tick."""
    plan = waiting()
    assert plan.completions == (2, 4)
    assert (plan.flowtime, plan.makespan, plan.lower_bound) == (6, 4, 5)
    metrics = rightofway.measure(plan)
    assert (metrics.flowtime, metrics.makespan) == (plan.flowtime, plan.makespan)
    assert metrics.lower_bound == plan.lower_bound


def test_a_plan_has_a_value_by_each_objective() -> None:
    plan = waiting()
    assert plan.compute_value(Objective.MAKESPAN) == plan.makespan
    assert plan.compute_value(Objective.FLOWTIME) == plan.flowtime


def test_a_plan_answers_for_one_robot() -> None:
    part = waiting()["R2"]
    assert part.vertices == ("N5", "N4", "N3")
    assert part.enter == (0, 2, 3)
    assert part.completion == 4
    assert [(wait.tick, wait.ticks, wait.for_robot) for wait in part.waits] == [(0, 1, 0)]
    assert part.track == waiting().tracks[1]
    assert waiting()["R1"].waits == ()


def test_waits_of_a_plan_are_those_of_all_robots() -> None:
    plan = waiting()
    assert plan.waits == rightofway.waits(plan) == plan["R2"].waits


def test_a_robot_that_is_not_there_is_named_with_the_nearest() -> None:
    with pytest.raises(InputError, match=r"no robot is named 'R3' \(the first is 'R1'\)"):
        waiting()["R3"]
    with pytest.raises(InputError, match=r"no robot is named 'R22' \(did you mean 'R2'\?\)"):
        waiting()["R22"]


def test_values_of_the_model_are_shown_on_one_short_line() -> None:
    plan = waiting()
    shown = [repr(each) for each in (plan, plan.scenario, plan["R2"], *plan.tracks)]
    assert shown == [
        "Plan(2 robots by hand, tick 0 to 3)",
        "Scenario(2 robots on Roadmap(9 vertices, 24 edges, grid of 3 x 3 cells), tick 1)",
        "RobotPlan('R2', 3 visits from N5 to N3, completed at tick 4)",
        "Track(3 visits, vertex 1 to 7, tick 0 to 2)",
        "Track(3 visits, vertex 5 to 3, tick 0 to 3)",
    ]
    assert repr(plan.scenario.robots[1]) == "Robot('R2', home 5, stops 3, speed 1)"


ROWS = [
    ("R1", 0, "N1", "home", 0, 1, 0, None, None, 0, 1, 0),
    ("R1", 1, "N4", "drive through", 1, 2, 0, None, None, 1, 2, 0),
    ("R1", 2, "N7", "stop 1", 2, None, 0, None, None, 2, None, 0),
    ("R2", 0, "N5", "home", 0, 2, 1, "R1", "N4", 0, 2, 1),
    ("R2", 1, "N4", "drive through", 2, 3, 0, None, None, 2, 3, 0),
    ("R2", 2, "N3", "work at stop 1", 3, None, 0, None, None, 3, None, 0),
]
COLUMNS = [
    "robot", "visit", "vertex", "purpose", "enter", "leave", "waits", "waits_for", "to_leave",
    "enter_tick", "leave_tick", "wait_ticks",
]  # fmt: skip


def test_a_data_frame_has_a_row_for_each_visit() -> None:
    frame = waiting().to_dataframe("pandas")
    assert list(frame.columns) == COLUMNS
    table = frame.astype(object).where(frame.notna(), None)
    assert list(table.itertuples(index=False, name=None)) == ROWS


def test_an_arrow_table_has_a_row_for_each_visit(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in: Any = SimpleNamespace(table=lambda columns: columns)
    monkeypatch.setitem(sys.modules, "pyarrow", stand_in)
    columns = waiting().to_dataframe("pyarrow")
    assert list(columns) == COLUMNS
    assert list(zip(*columns.values(), strict=True)) == ROWS


def test_the_first_library_that_is_installed_makes_the_frame(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without pandas, polars is asked; a stand-in shows what it is given."""
    stand_in: Any = SimpleNamespace(DataFrame=lambda columns: ("polars", columns))
    monkeypatch.setitem(sys.modules, "pandas", None)
    monkeypatch.setitem(sys.modules, "polars", stand_in)
    made, columns = waiting().to_dataframe()
    assert (made, list(columns)) == ("polars", COLUMNS)


def test_without_a_library_the_remedy_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("pandas", "polars", "pyarrow"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(InputError, match=r"none of pandas, polars, .* \(run: pip install pandas\)"):
        waiting().to_dataframe()
    with pytest.raises(InputError, match=r"polars is not installed \(run: pip install polars\)"):
        waiting().to_dataframe("polars")
    with pytest.raises(InputError, match="'excel' is unknown"):
        waiting().to_dataframe("excel")
