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
    """Two robots: planned rows of Tables 1 to 3, planned and final rows of Tables 4 to 11."""
    ended = cli("paper")
    assert ended.code == 0
    assert ended.out.splitlines()[-1] == "38 of 38 published rows equal"


def test_a_table_says_which_swap_the_published_method_leaves(cli: Cli) -> None:
    words = " ".join(cli("paper", "8", "--log").out.split())
    assert "swap conflict: R1 and R2 exchange N7 and N4" in words
    assert "R2 waits 1" in words


@pytest.mark.parametrize(("number", "last"), [(2, 5), (3, 6)])
def test_a_table_that_is_read_in_two_ways_is_printed_in_both(
    cli: Cli, number: int, last: int
) -> None:
    """R2 is at P3 in Figure 1; the columns of the table have P2 from t5 on."""
    ended = cli("paper", str(number), "--json")
    assert ended.code == 0
    report = json.loads(ended.out)
    assert (report["rows"], report["equal"]) == (2, 2)
    figure, printed = (
        next(row for row in table["rows"] if (row["robot"], row["kind"]) == ("R2", "planned"))
        for table in report["tables"]
    )
    assert figure["published"] == printed["published"] == printed["ours"]
    ticks = range(last)
    assert [t for t in ticks if figure["ours"][t] != figure["published"][t]] == [*range(4, last)]
    assert figure["ours"][4:] == ["P3"] * (last - 4)


def test_table_3_as_printed_has_a_swap_that_the_paper_does_not_count(cli: Cli) -> None:
    """R1 is at P2 at t4 and at P1 at t5, R2 the other way round."""
    words = " ".join(cli("paper", "3").out.split())
    assert words.count("swap conflict") == 1
    assert "time 4: swap conflict: R1 and R2 exchange P2 and P1" in words


def test_in_table_3_robot_one_works_longer_than_robot_two(cli: Cli) -> None:
    """The caption says so; the six time steps that the paper prints stay, and they never meet."""
    robots = load(EXAMPLES / "paper" / "table-3.yaml").robots
    assert [robot.stops[0].work for robot in robots] == [1, 0]
    out = cli("paper", "3", "--log").out
    # R1 drives 1 + 1, works 1, drives 1 + 1. R2 takes 2 for each edge.
    assert "ours      PI1  P1  P2  P2  P1 PI1  equal\n" in out
    assert "ours      PI2 PI2  P1  P1  P3  P3  differs\n" in out
    assert "No decision was needed: no two robots meet." in out


def test_a_row_that_differs_ends_with_1(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(EXAMPLES / "paper", tmp_path / "examples" / "paper")
    tables = tmp_path / "examples" / "paper" / "tables.json"
    found = json.loads(tables.read_text(encoding="utf-8"))
    found["tables"][5]["final"]["R1"][2] = 4
    tables.write_text(json.dumps(found), encoding="utf-8")
    monkeypatch.setattr(paper, "find_examples_folder", lambda: tmp_path / "examples")

    ended = cli("paper", "4", "--json")

    assert ended.code == 1
    report = json.loads(ended.out)
    assert (report["rows"], report["equal"]) == (4, 3)
    [wrong] = [row for row in report["tables"][0]["rows"] if not row["equal"]]
    assert (wrong["robot"], wrong["kind"], wrong["ours"][:3]) == ("R1", "final", [0, 0, 1])
