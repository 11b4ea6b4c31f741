"""Numbers of any size, in each key of a scenario: each command answers, or refuses them cleanly."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from rightofway.model.robot import ROBOT_ATTRIBUTES
from tests.cli.conftest import Cli

GRID = {"grid": ["...", "@.@", "..."]}
VERTICES = {"A": [0, 0], "B": [1, 0], "C": [2, 0], "D": [1, 1]}
LANES = [["B", "C"], ["B", "D"]]

OF_ROBOTS = ("work", *(it.key for it in ROBOT_ATTRIBUTES if not it.is_text))
OF_EDGES = ("length", "max_speed", "surcharge")
KEYS = (*OF_ROBOTS, *OF_EDGES, "headway", "cell_size", "spacing", "x", "from", "until")


def make_document(key: str, number: int | str) -> dict[str, Any]:
    """Return two robots on a grid or on lanes, with a number for a key."""
    edge = {"from": "A", "to": "B"} | ({key: number} if key in OF_EDGES else {})
    lanes = {"vertices": VERTICES, "edges": [edge, *LANES]}
    whole: dict[str, Any] = {"map": {"roadmap": lanes}}
    if key in OF_ROBOTS or key == "headway":
        whole = {"map": GRID, "rules": {key: number} if key == "headway" else {}}
    elif key == "cell_size":
        whole = {"map": GRID | {key: number}}
    elif key == "spacing":
        whole["map"][key] = number
    elif key == "x":
        whole["map"]["roadmap"] = lanes | {"vertices": VERTICES | {"A": [number, 0]}}
    elif key in {"from", "until"}:
        whole["closures"] = [{"at": "B", "from": 0, "until": 10**15} | {key: number}]
    homes, targets = (("N0", "N2"), ("N6", "N8")) if "grid" in whole["map"] else ("AC", "CD")
    own = {key: number} if key in OF_ROBOTS else {}
    robots = [
        {"name": name, "home": home, "target": target, **more}
        for name, home, target, more in zip(("R1", "R2"), homes, targets, ({}, own), strict=True)
    ]
    return {"format": "rightofway-scenario/1", **whole, "robots": robots}


NUMBERS = [
    2**31 - 1, 2**31, 2**40, 2**41,
    f"1/{2**31 - 1}", f"1/{2**32}", f"1/{2**41}",
]  # fmt: skip
"""Around the limits of the native core: 31 bits for a drive, 40 for work and headways."""

COMMANDS = [
    ("plan", "--time-limit", "0.1"),
    ("bound",),
    ("bound", "--time-limit", "0.1"),
    ("collisions",),
    ("laps", "--time-limit", "0.1"),
    ("laps", "--rule", "timetable", "--time-limit", "0.1"),
    ("inspect",),
]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("key", KEYS)
def test_each_command_answers_or_refuses(key: str, number: int | str, cli: Cli) -> None:
    path = Path("x.json")  # the directory is the test's own
    path.write_text(json.dumps(make_document(key, number)), encoding="utf-8")
    for command, *options in COMMANDS:
        done = cli(command, path, *options)
        assert done.code in {0, 1, 2, 3}, (command, done.err)
        assert "out of bounds" not in done.err  # a sentence of NumPy
        assert done.err or done.code != 2


def test_a_drive_that_is_too_long_for_the_core_is_refused_with_its_robot(cli: Cli) -> None:
    """R1 drives 1 long at speed 1; at R2's speed a tick is 1/2**31 of a time unit."""
    path = Path("x.json")
    path.write_text(json.dumps(make_document("speed", 2**31)), encoding="utf-8")
    errors = {cli(command, path, *options).err for command, *options in COMMANDS}
    fault = "a drive along an edge takes 2147483648 ticks of 1/2147483648, more than 2147483647"
    remedy = "bring speeds, lengths and times closer together"
    assert errors == {f"x.json:1: robots[0] (R1): {fault} ({remedy})\n"}
