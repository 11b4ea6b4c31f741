"""A case in a process of its own: what it costs is its own."""

from __future__ import annotations

import json
import resource
import subprocess
from pathlib import Path

import numpy as np
import pytest

import rightofway
from rightofway.bench import Case, read_suite, run_here
from rightofway.bench.process import Interrupted, Processes, describe_machine
from rightofway.bench.run import run
from rightofway.errors import InputError
from rightofway.processes import count_cores


@pytest.fixture
def case(tmp_path: Path) -> Case:
    path = tmp_path / "suite.toml"
    path.write_text(
        'format = "rightofway-suite/1"\ncounts = [4]\nmaps = [{random = {size = [9, 9]}}]\n'
        'planners = [{name = "two-level"}]\n',
        encoding="utf-8",
    )
    [case] = read_suite(path)
    return case


def test_a_row_has_what_solving_the_case_here_gives(case: Case) -> None:
    plan = rightofway.solve(case.make_scenario(), "two-level")
    metrics = rightofway.measure(plan)
    [row] = run_here([case])
    assert (row["flowtime"], row["makespan"]) == (metrics.flowtime, metrics.makespan)
    assert row["lower_bound"] == metrics.lower_bound
    assert row["message"] == str(plan.run.status)
    assert {name: row[name] for name in case.labels} == case.labels
    assert {name: row[name] for name in describe_machine()} == describe_machine()


def test_the_memory_of_a_case_is_not_that_of_who_started_it(case: Case) -> None:
    much = np.ones(60_000_000)  # 480 MB
    [row] = run_here([case])
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss > much.nbytes / 1024
    assert row["peak_memory"] < 200


def test_the_outcome_of_a_case_in_this_process_has_its_costs(case: Case) -> None:
    outcome = run(case)
    assert outcome["status"] == "solved"
    assert 0 < outcome["cpu_seconds"] < 5
    assert 0 < outcome["first_plan_seconds"] <= outcome["wall_seconds"]


def test_no_process_is_started_after_the_end(case: Case) -> None:
    processes = Processes()
    processes.end()
    with pytest.raises(Interrupted):
        processes.run(case)


def test_the_machine_is_told() -> None:
    found = describe_machine()
    assert found["cores"] == count_cores() >= 1
    assert found["version"] == rightofway.__version__
    assert found["cpu"]
    package = Path(rightofway.__file__).parent
    git = subprocess.run(
        ["git", "-C", package, "rev-parse", "HEAD"], capture_output=True, text=True, check=False
    )
    if git.returncode == 0 and "site-packages" not in package.parts:
        assert git.stdout.startswith(found["commit"].removesuffix("-dirty"))
        assert len(found["commit"].removesuffix("-dirty")) == 12


def laps_case(folder: Path, options: str) -> Case:
    path = folder / "suite.toml"
    path.write_text(
        'format = "rightofway-suite/1"\ncounts = [4]\nmaps = [{random = {size = [9, 9]}}]\n'
        f'planners = [{{name = "laps", options = {options}}}]\n',
        encoding="utf-8",
    )
    [case] = read_suite(path)
    return case


@pytest.mark.parametrize(
    "rule", ["first-come", "two-level", pytest.param("timetable", marks=pytest.mark.slow)]
)
def test_a_case_of_laps_has_the_throughput_and_the_figures_of_each_group(
    tmp_path: Path, rule: str
) -> None:
    outcome = run(laps_case(tmp_path, f'{{rule = "{rule}"}}'))
    assert (outcome["status"], outcome["valid"]) == ("solved", None)
    figures = json.loads(outcome["figures"])
    assert figures["throughput"] > 0
    assert sum(group["robots"] for group in figures["groups"]) == 4
    for group in figures["groups"]:
        assert group["ends"] == "repeats"
        assert group["period"] >= group["longest_lap"]
        assert 0 < group["fairness"] <= 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ('{rule = "last-come"}', "planners[0].options.rule: 'last-come' is none of them (choose"),
        ("{rules = 1}", "planners[0].options.rules: laps has no such option here (it has rule, "),
        ('{rule = "timetable", routes = "clear"}', "planners[0].options.routes: laps has no such"),
    ],
)
def test_wrong_options_of_laps_are_refused(tmp_path: Path, options: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        laps_case(tmp_path, options)
    assert f"suite.toml: {message}" in str(caught.value)


def test_a_plan_has_its_decisions_by_level_among_the_figures(case: Case) -> None:
    plan = rightofway.solve(case.make_scenario(), "two-level")
    figures = json.loads(run(case)["figures"])
    assert sum(figures["decisions"].values()) == len(plan.run.decisions)
    assert figures["rerouted"] == len(plan.run.reroutes)
