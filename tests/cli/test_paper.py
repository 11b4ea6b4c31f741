"""``rightofway paper``: the tables of the paper beside ours."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from rightofway.cli import paper
from rightofway.io import load
from tests.builders.fleets import EXAMPLES
from tests.cli.conftest import Cli


def test_all_published_rows_are_equal(cli: Cli) -> None:
    """Tables 4 to 11 have two robots with a planned and a final row each."""
    ended = cli("paper")
    assert ended.code == 0
    assert ended.out.splitlines()[-1] == "32 of 32 published rows equal, in 8 of 11 tables"


def test_a_table_says_which_swap_the_published_method_leaves(cli: Cli) -> None:
    words = " ".join(cli("paper", "8", "--log").out.split())
    assert "swap conflict: R1 and R2 exchange N7 and N4" in words
    assert "R2 waits 1" in words


def test_tables_without_published_rows_stand_alone(cli: Cli) -> None:
    ended = cli("paper", "3")
    assert ended.code == 0
    assert "R1 planned  ours      PI1  P1  P2  P2  P1 PI1\n" in ended.out
    assert ended.out.splitlines()[-1] == "no published row of these tables is recorded"


def test_in_table_3_robot_one_works_longer_than_robot_two(cli: Cli) -> None:
    """The caption says so; the six time steps that the paper prints stay, and they never meet."""
    robots = load(EXAMPLES / "paper" / "table-3.yaml").robots
    assert [robot.stops[0].work for robot in robots] == [1, 0]
    out = cli("paper", "3", "--log").out
    # R1 drives 1 + 1, works 1, drives 1 + 1. R2 takes 2 for each edge.
    assert "R1 planned  ours      PI1  P1  P2  P2  P1 PI1\n" in out
    assert "R2 planned  ours      PI2 PI2  P1  P1  P3  P3" in out
    assert "No decision was needed: no two robots meet." in out


def test_a_row_that_differs_ends_with_1(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(EXAMPLES / "paper", tmp_path / "examples" / "paper")
    tables = tmp_path / "examples" / "paper" / "tables.json"
    found = json.loads(tables.read_text(encoding="utf-8"))
    found["tables"][3]["final"]["R1"][2] = 4
    tables.write_text(json.dumps(found), encoding="utf-8")
    monkeypatch.setattr(paper, "find_examples_folder", lambda: tmp_path / "examples")

    ended = cli("paper", "4", "--json")

    assert ended.code == 1
    report = json.loads(ended.out)
    assert (report["rows"], report["equal"]) == (4, 3)
    [wrong] = [row for row in report["tables"][0]["rows"] if not row["equal"]]
    assert (wrong["robot"], wrong["kind"], wrong["ours"][:3]) == ("R1", "final", [0, 0, 1])
