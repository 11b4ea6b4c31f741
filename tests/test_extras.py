"""What is done without the libraries of extras, and what is said where one is missing."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import rightofway
from rightofway.extras import EXTRAS
from tests.builders.pages import ROOT

DOOR = ROOT / "examples" / "door.yaml"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def run(missing: tuple[str, ...], *words: object) -> subprocess.CompletedProcess[str]:
    """Run the command where libraries cannot be imported."""
    program = (
        f"import sys; sys.modules.update(dict.fromkeys({missing!r}))\n"
        "from rightofway.cli import main; main()"
    )
    return subprocess.run(
        [sys.executable, "-c", program, *map(str, words)],
        capture_output=True, text=True, encoding="utf-8", check=False,
    )  # fmt: skip


def test_a_scenario_is_planned_checked_and_shown_without_workbooks_and_pictures(
    tmp_path: Path,
) -> None:
    missing = ("openpyxl", "PIL")
    plan, page = tmp_path / "plan.json", tmp_path / "plan.html"
    assert run(missing, "plan", DOOR, "-o", plan, "--page", page).returncode == 0
    assert "no fault" in run(missing, "check", plan).stdout
    assert run(missing, "table", plan, "-o", tmp_path / "plan.csv").returncode == 0
    assert page.stat().st_size > 100_000


MESSAGE = "a workbook needs openpyxl (pip install 'rightofway[xlsx]')"


@pytest.mark.parametrize("words", [("plan", DOOR, "-o"), ("table", DOOR, "--all", "-o")])
def test_a_workbook_that_cannot_be_written_is_refused_before_any_work(
    words: tuple[object, ...], tmp_path: Path
) -> None:
    done = run(("openpyxl",), *words, tmp_path / "plan.xlsx")
    assert done.returncode == 2
    assert MESSAGE in done.stderr
    assert not done.stdout


def test_a_workbook_that_cannot_be_read_is_refused_with_the_remedy(tmp_path: Path) -> None:
    workbook = tmp_path / "door.xlsx"
    rightofway.write_scenario(rightofway.load(DOOR), workbook)
    done = run(("openpyxl",), "plan", workbook)
    assert done.returncode == 2
    assert f"door.xlsx: {MESSAGE}" in done.stderr


def test_a_workbook_from_python_is_refused_with_the_remedy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(rightofway.InputError, match="needs openpyxl"):
        rightofway.write_scenario(rightofway.load(DOOR), "door.xlsx")


def test_each_extra_that_a_message_names_installs_the_library() -> None:
    for library, extra in EXTRAS.items():
        assert any(wanted.startswith(library) for wanted in PROJECT["optional-dependencies"][extra])
        assert not any(wanted.startswith(library) for wanted in PROJECT["dependencies"])
