"""``rightofway drive`` as a user meets it."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest

from rightofway.control.journal import SqliteJournal
from tests.cli.conftest import Cli


@pytest.fixture
def plan(cli: Cli, door: Path, tmp_path: Path) -> Path:
    """Return a plan of two robots that share a door."""
    path = tmp_path / "plan.json"
    cli("plan", door, "--planner", "two-level", "-o", path)
    return path


DEMO = ("--demo", "--time-scale", "inf")


@pytest.mark.parametrize(("look_ahead", "most"), [("1", 2), ("3", 4)])
def test_the_base_has_at_most_as_many_edges_as_asked_for(
    cli: Cli, plan: Path, look_ahead: str, most: int
) -> None:
    done = cli("drive", plan, "--dry-run", "--look-ahead", look_ahead)
    orders = [json.loads(line.split(" ", 1)[1]) for line in done.out.splitlines()]
    sizes = {len(order["nodes"]) for order in orders if "nodes" in order}
    assert max(sizes) == most


def test_the_story_goes_to_standard_error_and_the_report_to_standard_output(
    cli: Cli, plan: Path
) -> None:
    ended = cli("drive", plan, *DEMO, "--delays", "exponential:0.3")
    assert ended.code == 0
    assert ended.out.splitlines()[0] == "jobs      2 done"
    assert "       0  R2 sets out from N2 to N8\n" in ended.err
    assert ended.err.splitlines()[-1].endswith("is at the end of its way, N0")


def test_the_contract_for_programs_is_kept(cli: Cli, plan: Path) -> None:
    ended = cli("drive", plan, *DEMO, "--seed", 3, "--json")
    data = json.loads(ended.out)
    assert (data["seed"], data["jobs"], data["tick"]) == (3, 2, 1)
    assert [robot["name"] for robot in data["robots"]] == ["R1", "R2"]
    assert {"jobs", "waits", "planned", "completion"} <= set(data["robots"][0])
    assert set(data["messages"]) == {"order", "instantActions", "state"}


def test_the_report_of_a_journal_is_that_of_its_drive(cli: Cli, plan: Path) -> None:
    """Only the number of messages is not in the journal."""
    options = ("--journal", "late.journal")
    driven = cli("drive", plan, *DEMO, *options, "--delays", "stop:R2@2+6").out
    report = cli("drive", plan, "--report", *options).out
    assert "messages" in driven.partition("\n\n")[0]
    assert "messages" not in report
    assert report.partition("\n\n")[2] == driven.partition("\n\n")[2]
    data = json.loads(cli("drive", plan, "--report", *options, "--json").out)
    assert [robot["completion"] for robot in data["robots"]] == [18, 16]


def test_an_empty_journal_has_no_report(cli: Cli, plan: Path, tmp_path: Path) -> None:
    SqliteJournal(tmp_path / "empty.journal").close()
    ended = cli("drive", plan, "--report", "--journal", tmp_path / "empty.journal")
    assert (ended.code, ended.out) == (2, "")
    assert "has no robots yet" in ended.err


def test_quiet_leaves_the_result_for_programs_only(cli: Cli, plan: Path) -> None:
    ended = cli("drive", plan, *DEMO, "--json", "-q")
    assert json.loads(ended.out)["jobs"] == 2
    assert ended.err == ""


def test_the_time_scale_says_how_long_it_takes(cli: Cli, plan: Path) -> None:
    """Twelve time units, thirty of them in a second."""
    began = time.monotonic()
    assert cli("drive", plan, "--demo", "--time-scale", 30).code == 0
    assert time.monotonic() - began >= 0.4


def test_a_page_plays_what_robots_did_beside_the_plan(cli: Cli, plan: Path) -> None:
    ended = cli("drive", plan, *DEMO, "--page", "driven.html", "--delays", "stop:R2@2+10")
    assert ended.code == 0
    assert ended.err.splitlines()[-1] == "wrote driven.html"
    assert (plan.parent / "driven.html").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ((), "--demo"),
        (("--demo", "--time-scale", "0"), "0 is not positive"),
        (("--demo", "--time-scale", "nan"), "nan is not positive"),
        (("--demo", "--delays", "stop:R2@2"), "would never complete"),
        (("--demo", "--delays", "rain:1"), "is no kind of delay"),
    ],
)
def test_bad_input_is_refused(
    cli: Cli, plan: Path, options: tuple[str, ...], complaint: str
) -> None:
    ended = cli("drive", plan, *options)
    assert ended.code == 2
    assert complaint in ended.err


def test_a_plan_whose_robots_move_round_a_circle_is_refused_with_the_rule_that_helps(
    cli: Cli, tmp_path: Path
) -> None:
    """Four robots on four cells, each to the next one: only together can they move."""
    robots = [("N0", "N1"), ("N1", "N3"), ("N3", "N2"), ("N2", "N0")]
    lines = [
        f"  - {{name: R{k}, home: {home}, target: {target}}}"
        for k, (home, target) in enumerate(robots)
    ]
    text = ["format: rightofway-scenario/1", 'map: {grid: ["..", ".."]}']
    text += ["rules: {rotations: true, return: none}", "robots:", *lines]
    (tmp_path / "ring.yaml").write_text("\n".join(text), encoding="utf-8")
    planned = cli("plan", "ring.yaml", "-o", "ring.json", "-q")
    assert planned.code == 0, planned.err
    ended = cli("drive", "ring.json", *DEMO)
    assert ended.code == 2
    assert "rotations: false" in ended.err
