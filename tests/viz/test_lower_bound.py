"""The lower bound of the flowtime is one number, wherever it is shown."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO

import pytest

import rightofway
from rightofway.io import dump_plan
from rightofway.metrics import compare, measure
from rightofway.model import Objective, Outcome, OutcomeKind, Tick
from rightofway.report.plan import summarize_plan
from rightofway.report.plan_data import make_summary_data
from rightofway.report.quantities import Quantities
from rightofway.studio.tasks.documents import compute_figures
from rightofway.viz.page.payload import make_payload
from rightofway.viz.table.result import make_result
from tests.builders.fleets import EXAMPLES


@pytest.fixture(scope="module")
def plan() -> rightofway.Plan:
    """Table 5 of the paper: a flowtime of 47; robots alone need 45, and 46 is said to be proven."""
    plan = rightofway.solve(rightofway.load(EXAMPLES / "paper" / "door-2.yaml"), "paper")
    proven = Outcome(kind=OutcomeKind.BEST_FOUND, objective=Objective.FLOWTIME, bound=Tick(46))
    return replace(plan, run=replace(plan.run, outcome=proven))


def test_a_bound_that_is_proven_is_shown_rather_than_the_sum_of_robots_alone(
    plan: rightofway.Plan,
) -> None:
    assert (plan.flowtime, measure(plan).flowtime_alone) == (47, 45)
    assert measure(plan).lower_bound == 46
    assert dump_plan(plan)["metrics"]["lower_bound"] == 46
    assert make_summary_data(plan)["metrics"]["lower_bound"] == 46
    assert make_payload(plan)["metrics"]["lowerBound"] == 46
    assert compute_figures(plan)["lower_bound"] == 46
    assert compare([plan, plan]).as_dict()["plans"][0]["lower_bound"] == 46
    summary = " ".join(str(summarize_plan(plan, Quantities.of(plan.scenario))).split())
    assert "47 time units, 2.2% above the lower bound of 46 time units" in summary


def test_a_workbook_names_it_as_the_page_does(plan: rightofway.Plan) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    summary = openpyxl.load_workbook(BytesIO(make_result(plan)))["summary"]
    figures = dict(row[:2] for row in summary.values)
    assert figures["flowtime"] == "47 time units"
    assert figures["lower bound of the flowtime"] == "46 time units; this plan is 2.2% above it"


def test_a_bound_that_the_plan_refutes_is_not_shown(plan: rightofway.Plan) -> None:
    assert plan.run.outcome
    refuted = replace(plan.run, outcome=replace(plan.run.outcome, bound=Tick(48)))
    assert measure(replace(plan, run=refuted)).lower_bound == 45
