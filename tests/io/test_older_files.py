"""Scenarios, plans and suites that older development versions wrote mean what they meant.

The files are in `tests/data/older`, one folder for each version, under the day of its commit. They
stay as they are: a reader that refuses one breaks a promise (`docs/promises.md`).
"""

from __future__ import annotations

import json
import shutil
from collections import Counter
from pathlib import Path

import pytest

from rightofway import check, load, load_plan, write_plan
from rightofway.bench import read_suite
from tests.builders.pages import ROOT

OLDER = Path(__file__).parents[1] / "data" / "older"
PLANS = sorted(OLDER.glob("*/*.json"))
SCENARIOS = sorted(OLDER.glob("*/*.yaml"))


def under(paths: list[Path]) -> list[str]:
    return [f"{path.parent.name}/{path.name}" for path in paths]


def test_there_are_files_of_older_versions() -> None:
    assert len(PLANS) >= 3
    assert len(SCENARIOS) >= 3


@pytest.mark.parametrize("path", PLANS, ids=under(PLANS))
def test_an_older_plan_is_read_and_costs_what_its_file_says(path: Path) -> None:
    """The figures in the file are those of the version that wrote it."""
    written = json.loads(path.read_text("utf-8"))
    plan = load_plan(path)
    assert check(plan).ok
    assert plan.flowtime == written["metrics"]["flowtime"]
    assert plan.makespan == written["metrics"]["makespan"]
    assert [robot.name for robot in plan.scenario.robots] == [
        row["name"] for row in written["robots"]
    ]
    for row in written["robots"]:
        assert list(plan[row["name"]].vertices) == row["vertices"]
        assert list(plan[row["name"]].enter) == row["enter"]


@pytest.mark.parametrize("path", PLANS, ids=under(PLANS))
def test_an_older_plan_is_written_as_a_new_one(path: Path, tmp_path: Path) -> None:
    plan = load_plan(path)
    write_plan(plan, tmp_path / "new.json")
    again = load_plan(tmp_path / "new.json")
    assert (again.scenario, again.tracks) == (plan.scenario, plan.tracks)


@pytest.mark.parametrize("path", SCENARIOS, ids=under(SCENARIOS))
def test_an_older_scenario_is_that_of_its_plan(path: Path) -> None:
    assert load(path) == load_plan(path.with_suffix(".json")).scenario


def test_an_older_suite_has_the_cases_that_it_had(tmp_path: Path) -> None:
    """The version that wrote it counted 27, with 3 seeds: 3 counts and 2 fleets; 2 fleets; 1."""
    [older] = OLDER.glob("*/suite.toml")
    shutil.copy(older, tmp_path)
    for name in ("maps", "door.yaml"):
        (tmp_path / name).symlink_to(ROOT / "examples" / name)
    cases = read_suite(tmp_path / "suite.toml")
    maps = Counter(case.labels["map"] for case in cases)
    assert list(maps.values()) == [18, 6, 3]
    assert {case.labels["planner"] for case in cases} == {"two-level"}
