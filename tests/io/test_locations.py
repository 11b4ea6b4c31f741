"""Faults name the line of the file and the robot."""

import io
import json
import sys
from pathlib import Path

import pytest

from rightofway.errors import InputError, InputFault
from rightofway.io import load, load_either, load_plan
from rightofway.io.locations import MAX_CHARACTERS, locate

HEAD = "format: rightofway-scenario/1\nmap:\n  grid: |\n    ...\n    ...\nrobots:\n"
GOOD = "  - {name: R1, home: N0, target: N2}\n"


def message(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_either(path)
    return str(caught.value).replace(f"{path}:", "here:")


def test_a_fault_names_its_line_and_its_robot(tmp_path: Path) -> None:
    robots = GOOD + "  - name: R2\n    home: N1\n    target: N2\n    speed: 0\n"
    assert message(tmp_path / "fleet.yaml", HEAD + robots) == (
        "here:11: robots[1] (R2): speed: 0 is not positive (give a number above 0)"
    )


def test_a_missing_key_is_in_the_line_where_its_mapping_begins(tmp_path: Path) -> None:
    found = message(tmp_path / "fleet.yaml", HEAD + GOOD + "  - name: R2\n    target: N2\n")
    assert found.startswith("here:8: robots[1] (R2): home: is missing")


def test_a_row_of_a_grid_in_a_block_has_its_own_line(tmp_path: Path) -> None:
    text = (HEAD + GOOD).replace("    ...\nrobots", "    ..\nrobots")
    assert message(tmp_path / "fleet.yaml", text).startswith("here:5: map.grid[1]: 2 cells")


def test_a_place_behind_an_unusual_key_is_found(tmp_path: Path) -> None:
    text = (
        "format: rightofway-scenario/1\nmap:\n  roadmap:\n    vertices:\n      bay 1: [0, 0]\n"
        "      bay 2: [a, 0]\n    edges: []\nrobots: [{name: R1, home: bay 1, target: bay 1}]\n"
    )
    found = message(tmp_path / "fleet.yaml", text)
    assert found.startswith("here:6: map.roadmap.vertices['bay 2']: 'a' is not a number")


@pytest.mark.parametrize("indent", [1, "\t"])
def test_json_has_lines_too(tmp_path: Path, indent: int | str) -> None:
    robots = [{"name": "R\u00e9\U0001f916/1", "home": "N0", "target": "N7"}]
    document = {"format": "rightofway-scenario/1", "map": {"grid": ["..."]}, "robots": robots}
    text = json.dumps(document, indent=indent).replace('/1",\n\t\t\t"home', '\\/1",\n\t\t\t"home')
    assert message(tmp_path / "fleet.json", text).startswith("here:12: robots[0] (")


def test_a_plan_names_the_robots_of_its_scenario(tmp_path: Path) -> None:
    scenario = (
        '"scenario": {"format": "rightofway-scenario/1", "map": 1,\n"robots": [{"name": "R1"}]}'
    )
    text = '{"format": "rightofway-plan/1",\n' + scenario + "}"
    assert "here:3: scenario.robots[0] (R1): home: is missing" in message(tmp_path / "p.json", text)


def test_standard_input_has_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    text = HEAD + "  - {name: R1, home: N0, target: N2, speed: 0}\n"
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    with pytest.raises(InputError, match=r"^-:7: robots\[0\] \(R1\): speed: 0 is not positive"):
        load("-")


def test_faults_of_another_file_keep_that_file(tmp_path: Path) -> None:
    text = HEAD.replace("grid: |\n    ...\n    ...", "file: no.map") + GOOD
    assert message(tmp_path / "fleet.yaml", text) == (
        f"here:3: map.file: {tmp_path / 'no.map'}: there is no such file (check the path)"
    )


def test_a_very_long_file_is_reported_without_lines(tmp_path: Path) -> None:
    text = HEAD + GOOD + "#" * MAX_CHARACTERS + "\nrules: {laps: 0}\n"
    assert message(tmp_path / "fleet.yaml", text).startswith("here: rules.laps: 0 does not fit")


def test_a_file_without_faults_is_read_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "fleet.yaml"
    path.write_text(HEAD + GOOD, encoding="utf-8")
    monkeypatch.setattr(
        "rightofway.io.locations._read_root", lambda _: pytest.fail("looked for lines")
    )
    assert load(path).robots[0].name == "R1"
    with pytest.raises(pytest.fail.Exception):
        load_plan(path)


def test_a_text_that_is_nested_too_deeply_is_reported_without_lines() -> None:
    """The YAML library reads values in values by recursion, and would end the process."""
    (fault,) = locate([InputFault("planner", "is unknown")], "[" * 100_000)
    assert fault == InputFault("planner", "is unknown")
