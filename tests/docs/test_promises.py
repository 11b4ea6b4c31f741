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
from rightofway.quantities import Quantities
from tests.builders.older_files import OLDER
from tests.builders.pages import DOCS

PAGE = (DOCS / "promises.md").read_text("utf-8")
ROWS = re.findall(r"^\| `?(\w[\w ]*?)`? \| (`.*`|its.*) \| (.*) \|$", PAGE, re.MULTILINE)
CLASSES = {
    "CyclicResult": rightofway.CyclicResult,
    "FleetBuilder": rightofway.FleetBuilder,
    "SimulationResult": rightofway.SimulationResult,
    "Quantities": Quantities,
}


def names_in(cell: str) -> list[str]:
    return re.findall(r"`(\w+)`", cell)


@pytest.mark.parametrize("owner", CLASSES)
def test_methods_that_have_been_renamed_are_there_under_both_names(owner: str) -> None:
    [(earlier, now)] = [row[1:] for row in ROWS if row[0] == owner]
    for name in names_in(earlier) + names_in(now):
        assert hasattr(CLASSES[owner], name), f"{owner}.{name}"


def test_functions_that_have_been_renamed_are_there_under_both_names() -> None:
    pairs = re.findall(r"`rightofway\.(\w+)`, which is `(\w+)`", PAGE)
    assert len(pairs) == 4
    for earlier, now in pairs:
        with pytest.warns(DeprecationWarning, match=now):
            assert callable(getattr(rightofway, earlier))
        assert now in rightofway.__all__


def test_formats_and_addresses_are_there() -> None:
    numbers = {"scenario": SCENARIO_FORMAT, "plan": PLAN_FORMAT, "suite": SUITE_FORMAT}
    for name, number in {**numbers, "identities": IDENTITIES_FORMAT}.items():
        assert re.fullmatch(rf"rightofway-{name}/\d+", number)
        assert name in PAGE
    assert "/api/v1" in (DOCS / "studio" / "api.md").read_text("utf-8")


@pytest.mark.parametrize("name", ["door.json", "door.yaml"])
def test_convert_writes_an_older_file_in_the_newest_format(name: str, tmp_path: Path) -> None:
    """The format of today: its number is the one that `write_plan` and `write_scenario` write."""
    older = Path(shutil.copy(OLDER / "2026-11-21" / name, tmp_path))
    newer = tmp_path / f"new{older.suffix}"
    assert run(["convert", "-q", str(older), str(newer)]) == 0
    load = rightofway.load_plan if name == "door.json" else rightofway.load
    number = PLAN_FORMAT if name == "door.json" else SCENARIO_FORMAT
    assert number in newer.read_text("utf-8")
    assert load(newer) == load(older)
