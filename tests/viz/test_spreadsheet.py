"""Our workbooks in a real spreadsheet: LibreOffice without a window, where it is installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import openpyxl  # type: ignore[import-untyped]  # it ships no types
import pytest

import rightofway
from rightofway.io.workbook import write_template
from rightofway.viz.table.result import write_result

pytestmark = pytest.mark.skipif(not shutil.which("soffice"), reason="LibreOffice is not installed")


def through(path: Path, target: str) -> Path:
    """Open a workbook, compute it, and save it in another format; no warning may come up."""
    folder = path.parent / "saved"
    profile = f"-env:UserInstallation=file://{path.parent / 'profile'}"
    command = ["soffice", profile, "--headless", "--convert-to", target, "--outdir", str(folder)]
    ended = subprocess.run([*command, str(path)], capture_output=True, timeout=180, check=True)
    said = [line for line in ended.stderr.decode().splitlines() if "javaldx" not in line]
    assert said == []  # that there is no Java is no matter
    return folder / path.with_suffix(f".{target}").name


def test_a_template_that_a_user_filled_in_comes_back_computed(tmp_path: Path) -> None:
    """The user points to cells and computes a speed; the spreadsheet saves the value beside it."""
    write_template(tmp_path / "door.xlsx")
    workbook = openpyxl.load_workbook(tmp_path / "door.xlsx")
    workbook["robots"]["B2"], workbook["robots"]["E2"] = "=map!A1", "=1/3"
    workbook["robots"]["E2"].number_format = "General"
    workbook.save(tmp_path / "door.xlsx")
    scenario = rightofway.load(through(tmp_path / "door.xlsx", "xlsx"))
    assert (scenario.robots[0].home, str(scenario.robots[0].speed)) == (0, "1/3")


def test_a_result_is_opened_with_its_chart(tmp_path: Path) -> None:
    """What LibreOffice saves has the same figures, and a chart with all lines."""
    write_template(tmp_path / "door.xlsx")
    plan = rightofway.solve(rightofway.load(tmp_path / "door.xlsx"))
    write_result(plan, tmp_path / "result.xlsx")
    before = openpyxl.load_workbook(tmp_path / "result.xlsx")
    after = openpyxl.load_workbook(through(tmp_path / "result.xlsx", "xlsx"))
    assert after.sheetnames == before.sheetnames
    for sheet in ("summary", "time and space", "events", "collisions", "decisions"):
        rows = [list(each[sheet].iter_rows(values_only=True)) for each in (before, after)]
        width = len(rows[0][0])
        assert [row[:width] for row in rows[1][: len(rows[0])]] == rows[0]
    [chart] = after["diagram"]._charts
    assert len(chart.series) == 2 + 7
    assert through(tmp_path / "result.xlsx", "pdf").read_bytes().startswith(b"%PDF")
