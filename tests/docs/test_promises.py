"""What the page on promises lists is there."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

import rightofway
from rightofway.cli.main import run
from rightofway.control.identities import IDENTITIES_FORMAT
from rightofway.io.formats import PLAN_FORMAT, SCENARIO_FORMAT, SUITE_FORMAT
from tests.builders.older_files import OLDER
from tests.builders.pages import DOCS

PAGE = (DOCS / "promises.md").read_text("utf-8")


def test_formats_and_addresses_are_there() -> None:
    numbers = {"scenario": SCENARIO_FORMAT, "plan": PLAN_FORMAT, "suite": SUITE_FORMAT}
    for name, number in {**numbers, "identities": IDENTITIES_FORMAT}.items():
        assert re.fullmatch(rf"rightofway-{name}/\d+", number)
        assert name in PAGE
    assert "/api/v1" in (DOCS / "studio" / "api.md").read_text("utf-8")


@pytest.mark.parametrize("name", ["door.json", "door.yaml"])
def test_convert_writes_an_older_file_in_the_newest_format(name: str, tmp_path: Path) -> None:
    """The format of today: its number is the one that `write_plan` and `write_scenario` write."""
    older = Path(shutil.copy(OLDER / "0.9.0" / name, tmp_path))
    newer = tmp_path / f"new{older.suffix}"
    assert run(["convert", "-q", str(older), str(newer)]) == 0
    load = rightofway.load_plan if name == "door.json" else rightofway.load
    number = PLAN_FORMAT if name == "door.json" else SCENARIO_FORMAT
    assert number in newer.read_text("utf-8")
    assert load(newer) == load(older)
