"""``rightofway shift`` as a user meets it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rightofway.check import check
from rightofway.dispatch.record_file import dump_shift, load_shift
from tests.builders.shifts import SHIFT
from tests.cli.conftest import Cli


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """Return a scenario with jobs that become known one after another."""
    path = tmp_path / "shift.yaml"
    path.write_text(SHIFT)
    return path


def test_the_report_says_what_is_done_and_what_robots_do(cli: Cli, scenario: Path) -> None:
    ended = cli("shift", scenario, "--lead", "0")
    assert ended.code == 0
    lines = ended.out.splitlines()
    # J3 is known at 30 and due at 31; nobody is at N3 by 2.
    assert "jobs          3 of 4 done, 2 in time and 1 late" in lines
    assert "not served    1: no robot would end it in time" in lines
    assert any(line.startswith("R1 ") for line in lines)
    assert max(map(len, lines)) <= 80


def test_robots_that_break_down_are_named_with_their_time(cli: Cli, scenario: Path) -> None:
    ended = cli("shift", scenario, "--lead", "0", "--delays", "stop:R2@1", "--until", "40")
    assert "robots lost   R2 from 1 s" in ended.out.splitlines()


def test_the_record_is_a_file_that_plays_again(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    path = tmp_path / "record.json"
    cli("shift", scenario, "--lead", "0", "-o", path)
    record = load_shift(path)
    assert check(record.make_plan()).ok
    assert dump_shift(record) == json.loads(path.read_text())


def test_the_figures_for_programs(cli: Cli, scenario: Path) -> None:
    data = json.loads(cli("shift", scenario, "--lead", "0", "--json").out)
    assert (data["known"], data["done"], data["late"], data["under_way"]) == (4, 3, 1, 0)
    assert data["unserved"] == {"latest": 1}
    assert {"median", "p95"} <= data["service_time"].keys()
    use = data["robots"][0]
    parts = ("driving", "waiting", "working", "charging", "idle")
    assert sum(use[part] for part in parts) == data["until"]
    assert [job["ended"] is None for job in data["jobs"]] == [False, True, False, False]


def test_jobs_become_known_before_their_earliest(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    (tmp_path / "known.csv").write_text("name,known\nJ3,10\n")
    for known, ticks in ((str(tmp_path / "known.csv"), 10), ("25", 5)):
        data = json.loads(cli("shift", scenario, "--lead", "0", "--json", "--known", known).out)
        assert {job["name"]: job["known"] for job in data["jobs"]}["J3"] == ticks


def test_jobs_arrive_at_random_by_a_seed(cli: Cli, scenario: Path) -> None:
    args = ("shift", scenario, "--lead", "0", "--json", "--known", "poisson:1/20", "--seed")
    first, again, other = (json.loads(cli(*args, seed).out) for seed in ("4", "4", "5"))
    known = [[job["known"] for job in data["jobs"]] for data in (first, again, other)]
    assert known[0] == known[1] != known[2]


def test_a_shift_ends_at_its_time(cli: Cli, scenario: Path) -> None:
    data = json.loads(cli("shift", scenario, "--until", "8", "--lead", "0", "--json").out)
    assert data["until"] == 8
    assert data["under_way"] == 1


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--reveal", "1", "--known", "3"], "--reveal and --known both say when jobs become known"),
        (["--known", "none.csv"], "none.csv"),
        (["--round-time", "0"], "0 is not positive (give seconds)"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    cli: Cli, scenario: Path, args: list[str], message: str
) -> None:
    ended = cli("shift", scenario, *args)
    assert ended.code == 2
    assert message in ended.err


def test_a_scenario_without_jobs_is_refused(cli: Cli, door: Path) -> None:
    ended = cli("shift", door)
    assert ended.code == 2
    assert "has no jobs (a shift needs jobs: [], at least)" in ended.err


def test_a_page_plays_the_shift(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    page = tmp_path / "shift.html"
    ended = cli("shift", scenario, "--lead", "0", "--page", page)
    assert ended.code == 0
    assert f"wrote {page}" in ended.err
    assert "<title>shift.yaml: a shift of 2 robots</title>" in page.read_text()
