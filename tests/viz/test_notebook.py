"""A scenario in a notebook."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import rightofway
from rightofway.model import Scenario
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario

EXAMPLES = Path(__file__).parents[2] / "examples"


def parsed(scenario: Scenario) -> ET.Element:
    return ET.fromstring(scenario._repr_html_())  # noqa: S314 (our own text)


def test_a_grid_shows_walls_homes_stops_and_robots() -> None:
    """Two walls in the middle row; a disc and a ring for each of two robots."""
    door = paper_scenario(next(case for case in PAPER if case["name"] == "door-2"))
    view = parsed(door)
    [drawing] = view.findall("{*}svg")
    assert drawing.get("viewBox") == "-0.5 -0.5 3 3"
    path = drawing.find("{*}path")
    assert path is not None
    assert path.get("d") == "M-0.5 0.5h1v1h-1zM1.5 0.5h1v1h-1z"
    assert len(drawing.findall("{*}circle")) == 4
    rows = [[cell.text for cell in row] for row in view.iter("tr")]
    assert rows[0] == ["robot", "home", "stops", "speed"]
    assert rows[1] == ["R1", "N0", "N6", "0.5"]


def test_work_and_speed_have_units() -> None:
    view = parsed(rightofway.load(EXAMPLES / "floor.yaml"))
    rows = [[cell.text for cell in row] for row in view.iter("tr")]
    stops = "(2.25, 4.25) (works 1 s), (8.25, 6.25) (works 2 s)"
    assert rows[2] == ["runner", "(0.75, 7.25)", stops, "2 m/s"]


def test_a_roadmap_shows_a_line_for_each_lane() -> None:
    """Two lanes; one of them can be driven both ways."""
    yard = rightofway.FleetBuilder().add_vertex("a", 0, 0).add_vertex("b", 2, 0)
    yard = yard.add_vertex("c", 2, 2).add_edge("a", "b").add_edge("b", "c", both_ways=False)
    view = parsed(yard.add_edge("c", "a").add_robot("R", home="a", target="b").build_scenario())
    path = next(view.iter("{http://www.w3.org/2000/svg}path"))
    assert path.get("d") == "M0 0L1 0M0 0L1 1M1 0L1 1"


def test_names_are_text_and_long_fleets_are_counted() -> None:
    trips = [(f"N{k}", f"N{k}") for k in range(23)]
    fleet = grid_fleet(["." * 23], trips)
    robots = (replace(fleet.robots[0], name="<b>&"), *fleet.robots[1:])
    view = parsed(replace(fleet, robots=robots))
    assert next(cell.text for cell in view.iter("td")) == "<b>&"
    assert [each.text for each in view.iter("p")] == ["… and 3 more robots"]
