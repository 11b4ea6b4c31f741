"""A first scenario for a layout: where robots start, where they drive, what it names."""

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from rightofway.io import load, make_example
from rightofway.io.yaml_text import parse_yaml
from rightofway.metrics.connectivity import find_strong_parts, list_ways
from rightofway.site import Edge, Roadmap, make_roadmap
from rightofway.solve import solve
from tests.builders.sentences import tell_notes

HERE = Path(__file__).parents[2] / "data" / "layouts"


def example(file: str) -> dict[str, Any]:
    document: dict[str, Any] = parse_yaml(make_example(HERE / file, HERE / "scenario.yaml").text)
    return document


def test_robots_start_from_parking_places_and_drive_to_stations() -> None:
    robots = example("hall.lif.json")["robots"]
    assert [robot["home"] for robot in robots] == ["P1", "A"]
    assert robots[0]["target"] == "Press"
    assert example("nodes.csv")["robots"][0]["home"] == "dock"


def test_the_vehicle_type_and_the_level_with_the_most_lanes_are_taken() -> None:
    assert example("hall.lif.json")["map"] == {"layout": "hall.lif.json", "vehicle_type": "tugger"}
    assert example("hall.nav.yaml")["map"] == {"layout": "hall.nav.yaml", "level": "L1"}


def test_a_target_at_a_station_with_the_name_of_another_vertex_is_named_by_its_vertex(
    tmp_path: Path,
) -> None:
    """Station C is at B, where a lane leads from A: the name C would mean the vertex C."""
    text = (HERE / "hall.lif.json").read_text("utf-8").replace('"Press"', '"C"')
    (tmp_path / "hall.lif.json").write_text(text, "utf-8")
    made = make_example(tmp_path / "hall.lif.json", tmp_path / "scenario.yaml")
    robots = parse_yaml(made.text)["robots"]
    assert robots[0]["target"] == "B"
    (tmp_path / "scenario.yaml").write_text(made.text, "utf-8")
    scenario = load(tmp_path / "scenario.yaml")
    assert scenario.roadmap.name(scenario.robots[0].stops[0].at) == "B"
    assert tell_notes(made)[-1].endswith("the name means the vertex: C (station at B)")


def test_cells_of_a_map_in_pixels_are_small_enough_to_get_through(tmp_path: Path) -> None:
    """Corridors of 0.4 m between walls of 0.1 m: a row of cells of 1/8 m fits into each."""
    picture = np.full((50, 200), 254, np.uint8)
    picture[::5] = 0
    picture[:, ::40] = 254  # a door in each wall
    Image.fromarray(picture).save(tmp_path / "a.png")
    yaml = (HERE / "room.yaml").read_text("utf-8").replace("room.pgm", "a.png")
    (tmp_path / "a.yaml").write_text(yaml.replace("0.5\n", "0.1\n"), "utf-8")
    document = parse_yaml(make_example(tmp_path / "a.yaml", tmp_path / "scenario.yaml").text)
    assert document["map"]["cell_size"] == "1/8"


@pytest.mark.parametrize(
    "file",
    ["hall.lif.json", "route.geojson", "hall.graphml", "plant-5.xml", "hall.nav.yaml", "nodes.csv",
     "room.yaml", "two-rooms.map"],
)  # fmt: skip
def test_the_example_can_be_planned(file: str, tmp_path: Path) -> None:
    target = tmp_path / "scenario.yaml"
    target.write_text(make_example(HERE / file, target).text, encoding="utf-8")
    scenario = load(target)
    assert len({robot.home for robot in scenario.robots}) == len(scenario.robots)
    assert solve(scenario, time_limit=5).flowtime > 0


def roadmap(*edges: str) -> Roadmap:
    positions = {name: (float(number), 0.0) for number, name in enumerate("ABCDEF")}
    return make_roadmap(
        positions, [Edge(tail=edge[0], head=edge[1], length=Fraction(1)) for edge in edges]
    )


@pytest.mark.parametrize(
    ("edges", "part"),
    [
        (["AB", "BA", "CD", "DE", "EC"], "CDE"),
        (["AB", "BC", "CD", "DE", "EF"], "F"),  # any single vertex is as large as any other
        (["AB", "BC", "CA", "CD", "DE", "ED"], "ABC"),
        ([], "F"),
    ],
)
def test_the_largest_part_holds_vertices_that_reach_each_other(edges: list[str], part: str) -> None:
    found = roadmap(*edges)
    names = "".join(found.name(vertex) for vertex in find_strong_parts(list_ways(found))[0])
    assert len(names) == len(part)
    assert names == part or len(part) == 1
