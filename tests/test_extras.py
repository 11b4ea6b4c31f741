"""Missing optional libraries, and plugins that fail."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import rightofway
from rightofway.extras import EXTRAS, load_plugins
from rightofway.io.layouts import LayoutFormat
from rightofway.planners import PlannerSpec
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


FAILURES = {
    "an older name": ("from rightofway.io import Earlier", "ImportError: cannot import name"),
    "a missing library": ("import no_such_library", "ModuleNotFoundError: No module named"),
    "a slip": ("SPEC = ", "SyntaxError: invalid syntax"),
    "an error": ("SPEC = 1 / 0", "ZeroDivisionError: division by zero"),
    "an end": ("import sys; sys.exit(3)", "SystemExit: 3"),
    "no object": ("spec = 1", "AttributeError: module 'failing' has no attribute 'SPEC'"),
    "another object": ("SPEC = 'text'", "TypeError: 'text' is no "),
}
"""Content of a plugin's module, and the beginning of the error."""

GROUPS: dict[str, type[object]] = {
    "rightofway.planners": PlannerSpec,
    "rightofway.layouts": LayoutFormat,
}

WORKS = """
from rightofway.io.layouts import LayoutFormat
from rightofway.planners import PlannerSpec

SPEC = PlannerSpec("works", "failing:plan", "Has a module that fails.")
FORMAT = LayoutFormat(summary="", content="text", recognizes=lambda _: False, read=None)
"""


def install_plugins(folder: Path, content: str) -> None:
    """Put a package with plugins that fail and plugins that work into a folder, as pip would."""
    info = folder / "acme_plans-2.1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-plans\nVersion: 2.1\n")
    points = [
        f"[{group}]\nfails = failing:SPEC\nworks = works:{name}\n"
        for group, name in zip(GROUPS, ("SPEC", "FORMAT"), strict=True)
    ]
    (info / "entry_points.txt").write_text("\n".join(points), encoding="utf-8")
    (folder / "failing.py").write_text(content, encoding="utf-8")
    (folder / "works.py").write_text(WORKS, encoding="utf-8")


@pytest.mark.parametrize("group", GROUPS)
@pytest.mark.parametrize("failure", FAILURES)
def test_a_plugin_that_fails_is_left_out_with_a_warning_that_names_it(
    failure: str, group: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    content, error = FAILURES[failure]
    install_plugins(tmp_path, content)
    monkeypatch.syspath_prepend(tmp_path)
    for module in ("failing", "works"):
        monkeypatch.delitem(sys.modules, module, raising=False)
    with pytest.warns(UserWarning, match="is left out") as warned:
        plugins: dict[str, object] = load_plugins(group, GROUPS[group])
    assert set(plugins) == {"works"}
    [message] = [str(warning.message) for warning in warned]
    assert message.startswith(
        f"{group}: the plugin fails of the package acme-plans is left out: {error}"
    )
    assert message.endswith("(update or uninstall acme-plans)")


LAYOUT = ROOT / "tests" / "data" / "samples" / "nav2" / "depot_graph.geojson"


@pytest.mark.parametrize(
    ("words", "code", "left_out"),
    [
        (("inspect", LAYOUT), 0, "rightofway.layouts: the plugin fails of the package acme-plans"),
        (("plan", "--help"), 0, "rightofway.planners: the plugin fails of the package acme-plans"),
        (("plan", DOOR), 0, ""),
        (("plan", DOOR, "--planner", "works"), 2, "planner: works cannot be imported: ImportError"),
        (("plan", DOOR, "--planner", "fails"), 2, "planner: 'fails' is unknown"),
        (("inspect", LAYOUT, "-q"), 0, ""),
    ],
)
def test_commands_work_with_a_package_whose_plugins_fail(
    words: tuple[object, ...], code: int, left_out: str, tmp_path: Path
) -> None:
    install_plugins(tmp_path, FAILURES["an older name"][0])
    paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")]).rstrip(os.pathsep)
    done = subprocess.run(
        [sys.executable, "-m", "rightofway", *map(str, words)],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True, text=True, encoding="utf-8", check=False,
    )  # fmt: skip
    assert done.returncode == code, done.stderr
    assert left_out in done.stderr
    assert left_out or not done.stderr
    assert "report it" not in done.stderr
