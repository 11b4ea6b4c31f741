"""What planners prove, and what solve makes of it."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

import rightofway
from rightofway import FleetBuilder, Outcome, OutcomeKind, improve, solve
from rightofway.cli.main import main
from rightofway.errors import InvalidPlan
from rightofway.io.plan.reader import parse_plan
from rightofway.io.plan.writer import dump_plan
from rightofway.metrics import derive_outcome
from rightofway.model import Objective, Proof, Scenario, Tick
from rightofway.model.outcome import classify_cost
from rightofway.report.phrases import to_parts
from rightofway.report.plan import describe_planning
from rightofway.report.quantities import Quantities
from rightofway.report.sentences import describe_proof
from rightofway.viz.page.payload import make_payload
from tests.builders.fleets import grid_fleet

CLAIMANT = """
from dataclasses import dataclass, replace
from pathlib import Path
from fractions import Fraction
from typing import Annotated
from rightofway.model import Proof
from rightofway.kinds.table import make_number
from rightofway.planners import PlannerOptions, PlannerSpec
from rightofway.planners.priorities import fixed_priority

@dataclass(frozen=True, slots=True, kw_only=True)
class ClaimOptions(PlannerOptions):
    bound: Annotated[int, "The bound that it claims; 0: none."] = 0
    factor: Annotated[Fraction, make_number(1), "The factor that it claims."] = Fraction(1)

def claimant(task):
    draft = fixed_priority(replace(task, options={"routes": "shortest"}))
    bound, factor = task.options["bound"], task.options["factor"]
    return replace(draft, proof=Proof(bound=bound, factor=factor) if bound else None)

SPEC = PlannerSpec("claimant", "claimant:claimant", "Claims what it is told.", ClaimOptions)
"""


@pytest.fixture(autouse=True)
def _claimant(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Install a planner of another package."""
    metadata = tmp_path / "claimant-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: claimant\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text("[rightofway.planners]\nclaimant = claimant:SPEC\n")
    (tmp_path / "claimant.py").write_text(CLAIMANT)
    monkeypatch.syspath_prepend(tmp_path)


def crossing() -> Scenario:
    """Two robots that cross in the middle of a plus, one way: alone 2 ticks each, 5 together."""
    rows, trips = ["@.@", "...", "@.@"], [("N1", "N7"), ("N3", "N5")]
    rules = rightofway.Rules(ends="none")
    return grid_fleet(rows, trips, rules=rules)


def test_a_plan_is_optimal_where_the_flowtime_is_the_sum_alone() -> None:
    plan = solve(grid_fleet(["..."], [("N0", "N2")]))
    bound = plan.flowtime
    assert plan.run.outcome == Outcome(kind=OutcomeKind.OPTIMAL, bound=bound)


def test_without_a_claim_a_plan_above_the_bound_is_the_best_found() -> None:
    plan = solve(crossing(), "claimant")
    assert (plan.flowtime, plan.run.outcome) == (
        5,
        Outcome(kind=OutcomeKind.BEST_FOUND, bound=Tick(4)),
    )


def test_a_planner_may_prove_more_than_the_sum_alone() -> None:
    plan = solve(crossing(), "claimant", bound=5)
    assert plan.run.outcome == Outcome(kind=OutcomeKind.OPTIMAL, bound=Tick(5))
    said = describe_planning(plan, Quantities.of(plan.scenario))
    assert "optimal, no plan has a smaller flowtime" in said


@pytest.mark.parametrize(
    ("factor", "kind"), [("5/4", OutcomeKind.BOUNDED), ("6/5", OutcomeKind.BEST_FOUND)]
)
def test_a_factor_holds_only_where_the_bound_proves_it(factor: str, kind: OutcomeKind) -> None:
    """The flowtime is 5 and the bound 4: 5/4 is proven, 6/5 is not."""
    plan = solve(crossing(), "claimant", bound=4, factor=factor)
    outcome = plan.run.outcome
    assert outcome is not None
    assert outcome.kind is kind
    assert plan.run.options == {"bound": 4, "factor": factor}
    is_said = "at most 5/4 times the least flowtime" in describe_planning(
        plan, Quantities.of(plan.scenario)
    )
    assert is_said == (kind is OutcomeKind.BOUNDED)
    page = make_payload(plan)["planner"].get("proven", "")
    assert page == to_parts(describe_proof(plan))


def test_a_bound_above_the_own_plan_is_a_fault_of_the_planner() -> None:
    message = "claimant claims that no flowtime is below 6 ticks, but its plan has 5"
    with pytest.raises(InvalidPlan, match=message):
        solve(crossing(), "claimant", bound=6)


def test_plan_files_keep_the_outcome_and_older_ones_open_without_it() -> None:
    plan = solve(crossing(), "fixed-priority")
    document = dump_plan(plan)
    assert document["planner"]["outcome"] == {
        "kind": "best found", "objective": "flowtime", "bound": 4,
    }  # fmt: skip
    assert parse_plan(document).run.outcome == plan.run.outcome
    del document["planner"]["outcome"]
    old = parse_plan(document)
    assert old.run.outcome is None
    assert derive_outcome(old) == plan.run.outcome


def test_an_outcome_that_its_plan_refutes_counts_for_nothing() -> None:
    """Neither a bound above the flowtime of 5, nor "optimal" with a bound below it."""
    plan = solve(crossing(), "fixed-priority")
    for said in (
        Outcome(kind=OutcomeKind.OPTIMAL, bound=Tick(6)),
        Outcome(kind=OutcomeKind.OPTIMAL, bound=Tick(4)),
    ):
        claimed = replace(plan, run=replace(plan.run, outcome=said))
        assert derive_outcome(claimed).kind is OutcomeKind.BEST_FOUND


def test_an_improved_plan_has_an_outcome() -> None:
    plan = improve(solve(crossing(), "fixed-priority"), iterations=1)
    assert plan.run.outcome == Outcome(kind=OutcomeKind.BEST_FOUND, bound=Tick(4))


def test_objectives_are_measured_by_one_method() -> None:
    """One robot takes 2 ticks, the other one waits for it: 3."""
    plan = solve(crossing(), "fixed-priority")
    values = [objective.compute_cost(plan.scenario, plan.tracks) for objective in Objective]
    assert values == [5, 5, 5, 3, 2 * 3 + 5, 2 * 3 + 5]
    assert classify_cost(Tick(5), Proof(bound=Tick(5))).kind is OutcomeKind.OPTIMAL


def code(args: list[str]) -> int:
    """Return the exit code of a command."""
    with pytest.raises(SystemExit) as ended:
        main(args)
    assert isinstance(ended.value.code, int)
    return ended.value.code


PLAN_COMMAND = ["plan", "fleet.yaml", "--planner", "claimant", "--option", "bound=4"]


def test_the_command_line_takes_an_exact_option_and_shows_the_factor(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    rightofway.write_scenario(crossing(), "fleet.yaml")
    assert code([*PLAN_COMMAND, "--option", "factor=1.25", "--json"]) == 0
    planner = json.loads(capsys.readouterr().out)["planner"]
    assert planner["options"] == {"bound": 4, "factor": "5/4"}
    assert planner["outcome"] == {
        "kind": "bounded", "objective": "flowtime", "bound": 4, "factor": "5/4",
    }  # fmt: skip
    assert code([*PLAN_COMMAND, "--option", "factor=0.9"]) == 2
    assert (
        "options.factor: '0.9' does not fit (give a number of 1 or more)" in capsys.readouterr().err
    )


def test_a_spare_tick_against_rotations_is_no_proof() -> None:
    """R1 makes room at its home for R2, which has a stop there.

    Planners keep a spare tick between two robots where rotations are forbidden, which the rules do
    not ask for. So the best plan with spare ticks is not the best plan.
    """
    fleet = FleetBuilder(occupancy="both", rotations=False)
    fleet.add_vertex("A", 0, 0).add_vertex("B", 1, 0).add_vertex("C", 0, 1)
    fleet.add_edge("A", "B", both_ways=False, max_speed="17/20")
    fleet.add_edge("B", "A", both_ways=False).add_edge("A", "C")
    fleet.add_robot("R1", home="A", target="A", radius="0.3")
    fleet.add_robot("R2", home="B", stops=["A", "B"], radius="0.3")
    scenario = fleet.build_scenario()
    outcome = solve(scenario, "lns", iterations=10).run.outcome
    assert outcome is not None
    assert outcome.bound is not None
    assert outcome.bound <= solve(scenario, "local-search").flowtime
