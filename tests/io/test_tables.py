"""Robots from the rows of a CSV file."""

from __future__ import annotations

from pathlib import Path

import pytest

import rightofway
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.io.tables import find_heading_key
from tests.builders.broken_files import limited

SCENARIO = """\
format: rightofway-scenario/1
map: {grid: ["...", "@.@", "..."]}
robots: {table: robots.csv}
"""


def scenario(folder: Path, table: str) -> Path:
    (folder / "hall.yaml").write_text(SCENARIO, encoding="utf-8")
    (folder / "robots.csv").write_text(table, encoding="utf-8")
    return folder / "hall.yaml"


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_a_row_is_a_robot(tmp_path: Path, delimiter: str) -> None:
    table = 'Name,Home,target,Speed [m/s],note\nR1,N0,N6,1/2,"old, slow"\n\nR2,N2,N8,,\n'
    found = rightofway.load(scenario(tmp_path, table.replace(",", delimiter)))
    rows = [(each.name, each.home, each.stops[0].at, str(each.speed)) for each in found.robots]
    assert rows == [("R1", 0, 4, "1/2"), ("R2", 2, 6, "1")]


@pytest.mark.parametrize(("text", "speed"), [("0,5", "1/2"), ("1,25", "5/4"), ("0,125", "1/8")])
def test_a_decimal_comma_is_read(tmp_path: Path, text: str, speed: str) -> None:
    found = rightofway.load(scenario(tmp_path, f"name;home;target;speed\nR1;N0;N6;{text}\n"))
    assert str(found.robots[0].speed) == speed


def test_a_comma_that_may_stand_for_thousands_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="'1,000' is not a number"):
        rightofway.load(scenario(tmp_path, "name;home;target;speed\nR1;N0;N6;1,000\n"))


def test_a_plan_holds_the_robots_of_the_table(tmp_path: Path) -> None:
    loaded = rightofway.load(scenario(tmp_path, "name,home,stop 1,work 1,stop 2\nR1,N0,N6,2,N8\n"))
    rightofway.write_plan(rightofway.solve(loaded), tmp_path / "plan.json")
    (tmp_path / "robots.csv").unlink()
    assert rightofway.load_plan(tmp_path / "plan.json").scenario == loaded


def test_all_faults_are_named_by_line_and_heading(tmp_path: Path) -> None:
    table = "name,home,target,speed\nR1,N0,N6,0\nR1,N3,N8,fast\n"
    with pytest.raises(InputError) as raised:
        rightofway.load(scenario(tmp_path, table))
    source = f"line 3: robots.table: {tmp_path / 'robots.csv'}"
    assert [str(fault.name_file("")) for fault in raised.value.faults] == [
        f"{source}:2: speed: 0 is not positive (give a number above 0)",
        f"{source}:3: home: N3, row 1, column 0, is blocked by '@' (N0 is free)",
        f"{source}:3: speed: 'fast' is not a number (write it like 3, 0.5 or 1/3)",
    ]


def test_a_table_that_is_not_there_is_reported_at_its_key(tmp_path: Path) -> None:
    path = scenario(tmp_path, "x")
    (tmp_path / "robots.csv").unlink()
    with pytest.raises(InputError, match=r"robots\.table: .*robots\.csv: there is no such file"):
        rightofway.load(path)


def test_a_long_heading_of_brackets_is_read_soon() -> None:
    """A search that began again at each bracket would take a minute of the processor."""
    with limited(5):
        assert find_heading_key("[" * 300_000 + " work [s]") == "[" * 300_000 + "_work"


def test_a_table_without_a_line_is_refused(tmp_path: Path) -> None:
    (tmp_path / "fleet.csv").write_bytes(b"")
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["..."]},
        "robots": {"table": "fleet.csv"},
    }
    with pytest.raises(InputError):
        parse_scenario(document, tmp_path)
