"""Real layouts: six robots get a checked plan on each, or it is refused with the reason."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from rightofway import check, solve
from rightofway.errors import InputError
from rightofway.io import make_example, parse_scenario
from rightofway.io.yaml_text import parse_yaml

SAMPLES = Path(__file__).parents[1] / "data" / "samples"

REFUSED = {
    "open_rmf/campus.building.yaml": "coordinates are 'wgs84' (give the building's navigation"
    " graph instead)",
    "ros_map/warehouse_keepout.yaml": "there is no picture 'warehouse_keepout.pgm' beside the file"
    " (put it there)",
}

FEWER = {
    "lif": 1,  # the examples of the standard have two to five nodes
    "opentcs/PlantModelV005.sample.xml": 1,
    "opentcs/PlantModelV6.sample.xml": 1,
    "opentcs/PlantModelV7.sample.xml": 1,
    "nav2/sample_graph.geojson": 4,
}
"""Least number of robots where there is no room for six."""

NAMES = [
    path.relative_to(SAMPLES).as_posix()
    for path in sorted(SAMPLES.glob("*/*"))
    if path.suffix not in {".pgm", ".txt", ".md"}
]


@pytest.mark.parametrize("radius", ["0", "0.3"])
@pytest.mark.parametrize("name", sorted(set(NAMES) - set(REFUSED)))
def test_six_robots_get_a_checked_plan(name: str, radius: str) -> None:
    document = parse_yaml(
        make_example(SAMPLES / name, SAMPLES / "scenario.yaml", Fraction(radius)).text
    )
    robots = document["robots"]
    assert len(robots) >= FEWER.get(name, FEWER.get(name.partition("/")[0], 6))
    scenario = parse_scenario(document, SAMPLES)
    assert {robot.radius for robot in scenario.robots} == {Fraction(radius)}
    plan = solve(scenario, time_limit=5)
    assert not check(plan).faults


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_a_layout_that_cannot_be_used_is_refused_with_the_remedy(name: str) -> None:
    with pytest.raises(InputError) as error:
        make_example(SAMPLES / name, "-")
    assert REFUSED[name] in str(error.value)


def test_all_eighteen_examples_of_lif_are_there() -> None:
    assert sum(name.startswith("lif/") for name in NAMES) == 18
