"""JSON for programs has kinds and numbers: no templates, and no sentences instead of kinds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.builders.sentences import find_sentences
from tests.cli.conftest import EXAMPLES, Cli


def test_sentences_in_data_are_found() -> None:
    data = {"why": "time ran out", "kind": "{robot} waits", "text": "R1 waits for R2", "a": ["R1"]}
    assert find_sentences(data) == [("why", "time ran out"), ("kind", "{robot} waits")]


@pytest.mark.parametrize("planner", ["auto", "two-level", "random-priority", "cbs", "paper"])
def test_plan_files_have_kinds_and_numbers(cli: Cli, planner: str) -> None:
    command = ("plan", EXAMPLES / "door.yaml", "--planner", planner, "-o", "plan.json", "--json")
    assert find_sentences(json.loads(cli(*command).out)) == []
    assert find_sentences(json.loads(Path("plan.json").read_text("utf-8"))) == []


@pytest.mark.parametrize(
    "command",
    [
        ("simulate", "plan.json", "--runs", 3),
        ("collisions", EXAMPLES / "door.yaml"),
        ("table", "plan.json", "--events"),
        ("bound", EXAMPLES / "door.yaml"),
        ("laps", EXAMPLES / "door.yaml"),
        ("laps", EXAMPLES / "crossroad.yaml", "--rule", "two-level"),
        ("inspect", EXAMPLES / "floor.yaml"),
    ],
)
def test_reports_for_programs_have_kinds_and_numbers(cli: Cli, command: tuple[Any, ...]) -> None:
    assert cli("plan", EXAMPLES / "door.yaml", "-o", "plan.json", "--planner", "paper").code < 2
    ended = cli(*command, "--json")
    assert find_sentences(json.loads(ended.out)) == []


def test_the_reason_of_a_deadlock_of_laps_is_a_fact(cli: Cli) -> None:
    """Two robots face each other in a lane without a way round."""
    Path("lane.yaml").write_text(
        "format: rightofway-scenario/1\n"
        'map: {grid: ["...."]}\n'
        "robots:\n"
        "  - {name: R1, home: N0, target: N3}\n"
        "  - {name: R2, home: N3, target: N0}\n",
        encoding="utf-8",
    )
    (group,) = json.loads(cli("laps", "lane.yaml", "--json").out)["groups"]
    assert group["ends"] == "deadlock"
    assert group["why"]["kind"] == "deadlock"
    assert {group["why"]["values"][name] for name in ("one", "other")} == {"R1", "R2"}
