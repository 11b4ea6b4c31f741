"""What is no file follows the tables of attributes, too."""

import inspect
from pathlib import Path

import openpyxl  # type: ignore[import-untyped]

from rightofway import FleetBuilder
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.io.workbook import write_template
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES


def test_the_builder_takes_every_attribute_of_a_robot() -> None:
    parameters = inspect.signature(FleetBuilder.add_robot).parameters
    assert {it.name for it in ROBOT_ATTRIBUTES} - set(parameters) == set()


def test_every_attribute_of_a_robot_has_a_title_and_a_hint_for_tables() -> None:
    """The studio makes its columns of them."""
    for it in ROBOT_ATTRIBUTES:
        assert str(Fact(f"title of {it.key}")), it.key
        assert str(Fact(f"hint of {it.key}")), it.key


def test_a_workbook_has_a_hint_for_every_attribute(tmp_path: Path) -> None:
    path = tmp_path / "fleet.xlsx"
    write_template(path)
    workbook = openpyxl.load_workbook(path)
    hints = {
        sheet: {
            rule.promptTitle: rule.prompt
            for rule in workbook[sheet].data_validations.dataValidation
        }
        for sheet in ("robots", "rules")
    }
    for sheet, table in (("robots", ROBOT_ATTRIBUTES), ("rules", RULE_ATTRIBUTES)):
        assert {it.key: it.description for it in table}.items() <= hints[sheet].items()


def test_robots_of_a_scen_file_may_have_a_type(tmp_path: Path) -> None:
    (tmp_path / "a.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    (tmp_path / "a.scen").write_text("version 1\n0\ta.map\t3\t1\t0\t0\t1\t0\t1\n")
    document = {
        "format": "rightofway-scenario/1",
        "map": {"file": "a.map"},
        "robots": {"scen": "a.scen", "type": "wide"},
    }
    assert parse_scenario(document, tmp_path).robots[0].type == "wide"
