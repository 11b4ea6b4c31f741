"""Files of older versions keep their meaning.

They are in `tests/data/older`, a folder for each version. `tests/builders/older_files.py` writes
those of a release. They stay as
they are: a reader that refuses one breaks a promise (`docs/promises.md`).
"""

from __future__ import annotations

import json
import shutil
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rightofway import check, load, load_plan, write_plan
from rightofway.bench import read_suite
from rightofway.control import FleetControl, JournalReader, SqliteJournal
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.identities import load_identities
from rightofway.control.names import list_jobs
from rightofway.control.recording import Recording
from rightofway.site import Roadmap
from rightofway.site.geometry import Point
from rightofway.site.roadmap import EdgeClass
from tests.builders.floors import Floor
from tests.builders.older_files import OLDER
from tests.builders.pages import ROOT

PLANS = sorted(OLDER.glob("*/*.json"))
SCENARIOS = sorted(OLDER.glob("*/*.yaml"))


def under(paths: list[Path]) -> list[str]:
    return [f"{path.parent.name}/{path.name}" for path in paths]


def test_there_are_files_of_older_versions() -> None:
    """Those of the first version have each kind of file that has a promise."""
    written = {path.name for path in (OLDER / "0.9.0").rglob("*") if path.is_file()}
    assert written >= {"site.yaml", "site.json", "laps.json", "door.xlsx", "suite.toml"}
    assert written >= {"door.journal", "robots.yaml"}


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
    """Between pieces of a lane, each direction has vertices of its own since version 1.2."""
    scenario, older = load(path), load_plan(path.with_suffix(".json")).scenario
    assert list_lanes(scenario.roadmap) == list_lanes(older.roadmap)
    if scenario.roadmap.opposite:
        scenario, older = (replace(each, roadmap=older.roadmap) for each in (scenario, older))
    assert scenario == older


def list_lanes(roadmap: Roadmap) -> list[tuple[Point, Point, EdgeClass]]:
    """Return the ends of all edges, and how each is driven."""
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    points = roadmap.get_point
    edges = [
        (points(tail), points(head), roadmap.get_edge_class(edge))
        for edge, (tail, head) in enumerate(zip(tails, roadmap.heads.tolist(), strict=True))
    ]
    return sorted(edges, key=lambda edge: edge[:2])


@pytest.mark.parametrize(
    ("version", "by_map", "by_planner"),
    [
        # 2 planners and 2 seeds: 2 counts; a scenario; another
        ("0.9.0", [8, 4, 4], {"two-level": 8, "lns": 8}),
    ],
)
def test_an_older_suite_has_the_cases_that_it_had(
    tmp_path: Path, version: str, by_map: list[int], by_planner: dict[str, int]
) -> None:
    (tmp_path / "maps").symlink_to(ROOT / "examples" / "maps")
    for path in (OLDER / version).iterdir():
        if path.is_file():
            shutil.copy(path, tmp_path)
    cases = read_suite(tmp_path / "suite.toml")
    assert list(Counter(case.labels["map"] for case in cases).values()) == by_map
    assert Counter(case.labels["planner"] for case in cases) == by_planner


WORKBOOKS = sorted(OLDER.glob("*/*.xlsx"))


@pytest.mark.parametrize("path", WORKBOOKS, ids=under(WORKBOOKS))
def test_an_older_workbook_is_the_scenario_of_its_plan(path: Path) -> None:
    assert load(path) == load_plan(path.with_suffix(".json")).scenario


JOURNALS = sorted(OLDER.glob("*/control/*.journal"))


@pytest.mark.parametrize("path", JOURNALS, ids=under(JOURNALS))
def test_a_control_goes_on_with_an_older_journal(path: Path, tmp_path: Path) -> None:
    """R2 had come to N1 of the door, R1 had got one more job, at N7, when the control ended."""
    kept = Path(shutil.copy(path, tmp_path))
    journal = SqliteJournal(kept)
    plan = load_plan(path.parents[1] / "door.json")
    dispatcher = Dispatcher(FleetControl(journal), plan)
    assert dispatcher.ledger.arrived == [0, 1]
    waiting = [(job["name"], job["at"]) for job in list_jobs(dispatcher.ledger)]
    assert waiting == [("R1/job1", "N7"), ("R1/job0", "N6"), ("R2/job0", "N8")]
    floor = Floor(dispatcher, ["N0", "N1"])
    floor.drive(40)
    assert list_jobs(dispatcher.ledger) == []
    assert [robot.place for robot in floor.robots] == ["N0", "N2"]
    journal.close()
    recording = Recording(plan, JournalReader(kept))
    recording.read_on()
    assert recording.count > 0


IDENTITIES = sorted(OLDER.glob("*/control/robots.yaml"))


@pytest.mark.parametrize("path", IDENTITIES, ids=under(IDENTITIES))
def test_older_identities_name_the_robots_that_they_named(path: Path) -> None:
    first, second = load_identities(path, ["R1", "R2"])
    assert (first.serial_number, first.version, first.map_id) == ("A-001", "2.1.0", "hall-1")
    assert (second.serial_number, second.version) == ("A-002", "3.0.0")
    assert (first.work.action, second.work.action) == ("pick", "drop")
    assert first.deviation == 0.05
