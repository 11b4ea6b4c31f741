"""``rightofway simulate`` as a user meets it."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

import rightofway
from tests.cli.conftest import SWAP, Cli


@pytest.fixture
def plan(cli: Cli, door: Path, tmp_path: Path) -> Path:
    """Return a plan of two robots that share a door."""
    path = tmp_path / "plan.json"
    cli("plan", door, "--planner", "two-level", "-o", path)
    return path


def test_the_report_says_what_collides_who_is_late_and_why_in_80_columns(
    cli: Cli, plan: Path
) -> None:
    ended = cli("simulate", plan, "--delays", "exponential:0.3,stop:R1@2+5")
    assert ended.code == 0
    lines = ended.out.splitlines()
    assert lines[:2] == [
        "runs          1000 with exponential:0.3, stop:R1@2+5; seed 0",
        "right of way  no collisions, no deadlocks",
    ]
    assert "% of runs collide, " in lines[2]
    assert any(line.startswith("R2 ") and "R1 " in line for line in lines)
    assert "\nwhere most lateness begins, mean per run\n" in ended.out
    assert "\nR1 at N" in ended.out
    assert max(map(len, lines)) <= 80


def test_the_contract_for_programs_is_kept(cli: Cli, plan: Path) -> None:
    ended = cli("simulate", plan, "--runs", 50, "--seed", 3, "--json")
    data = json.loads(ended.out)
    assert (data["runs"], data["collisions"], data["deadlocks"]) == (50, 0, 0)
    assert {"mean", "median", "p90", "p95", "max", "robots", "sources"} <= set(data["lateness"])
    assert data["by_clock"]["runs_with_collisions"] > 0
    assert data["delays"] == ["exponential:0.2"]


def test_a_broken_robot_is_counted_apart_from_those_that_wait_for_it(cli: Cli, plan: Path) -> None:
    ended = cli("simulate", plan, "--delays", "stop:R2@2", "--runs", 10)
    words = " ".join(ended.out.split())
    assert "broken robots per run: 1 break down, 1 wait for them permanently" in words
    assert "R1 never completes" in words


def test_switching_and_replanning_are_reported(cli: Cli, plan: Path) -> None:
    ended = cli("simulate", plan, "--delays", "stop:R2@1", "--runs", 5, "--replan", "--switch")
    words = " ".join(ended.out.split())
    assert "1 are cut off from a place" in words
    assert "replanned 1 time per run on average" in words


def test_a_deadlock_would_be_told_by_the_exit_code(
    cli: Cli, plan: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There is none, so one is made up."""
    outcome = replace(rightofway.simulate(rightofway.load_plan(plan), runs=1), deadlocks=1)
    monkeypatch.setattr("rightofway.execution.simulate", lambda *_, **__: outcome)
    ended = cli("simulate", plan)
    assert ended.code == 1
    assert "right of way  no collisions, 1 deadlock\n" in ended.out


@pytest.mark.parametrize(
    ("delays", "complaint"),
    [
        ("stop:R9@1", "delays: stop:R9@1: there is no robot 'R9' (there are R1, R2)\n"),
        ("oops.yaml", "oops.yaml: there is no such file (check the path)\n"),
    ],
)
def test_delays_that_cannot_be_read_are_refused(
    cli: Cli, plan: Path, delays: str, complaint: str
) -> None:
    ended = cli("simulate", plan, "--delays", delays)
    assert (ended.code, ended.out, ended.err) == (2, "", complaint)


def test_plans_with_swaps_left_in_are_refused(cli: Cli, tmp_path: Path) -> None:
    scenario, plan = tmp_path / "swap.yaml", tmp_path / "swap.json"
    scenario.write_text(SWAP, encoding="utf-8")
    cli("plan", scenario, "--planner", "two-level", "--option", "swaps=leave", "-o", plan)
    ended = cli("simulate", plan)
    assert ended.code == 2
    assert "the plan has 1 fault: 1 swap conflict (only one without can be run)" in ended.err
