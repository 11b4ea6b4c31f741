"""``cell_size: adaptive``: floors and maps in pixels as squares of a quadtree."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import rightofway
from rightofway.errors import InputError
from rightofway.io import dump_plan, dump_scenario, parse_plan, parse_scenario
from rightofway.io.readers import load_with_notes
from rightofway.metrics import Site, inspect
from rightofway.units import Units
from tests.builders.sentences import tell_notes

FLOOR = {"size": [8, 4], "obstacles": [{"name": "rack", "rect": [2, 1, 3, 2]}]}
ROBOT = {"name": "R1", "home": {"x": 0.5, "y": 0.5}, "target": {"x": 7, "y": 3}}


def document(where: dict[str, Any], **robot: Any) -> dict[str, Any]:
    robots = [{**ROBOT, **robot}]
    return {"format": "rightofway-scenario/1", "map": where, "robots": robots}


def test_a_floor_is_cut_into_squares_of_several_sizes() -> None:
    """Cells of 1; what is left of the rack makes one square of 2 by 2, right of it are two."""
    where = {"floor": FLOOR, "cell_size": "adaptive", "smallest": 1}
    scenario = parse_scenario(document(where))
    labels = scenario.roadmap.labels or ()
    assert {name for name in labels if "x" in name} == {"Q0-0x2", "Q0-2x2", "Q6-0x2", "Q6-2x2"}
    assert len(labels) == 4 + 6 + 4  # beside the squares: 3 above and below the rack, 4 right of it
    assert scenario.roadmap.name(scenario.robots[0].home) == "Q0-0x2"
    assert scenario.roadmap.name(scenario.robots[0].stops[0].at) == "Q6-2x2"


def test_the_smallest_cell_is_as_wide_as_the_largest_robot_or_as_node_clustering_has_it() -> None:
    narrow = {"size": [8, 4], "obstacles": [{"rect": ["2.5", "1.25", 3, 2]}]}
    where = {"floor": narrow, "cell_size": "adaptive", "largest": 1}
    wide = parse_scenario(document(where, radius="0.25", home={"x": 0.1, "y": 0.1}))
    assert wide.roadmap.sides is not None
    assert set(wide.roadmap.sides) == {0.5, 1.0}
    fast = parse_scenario(document(where, speed=4))
    assert fast.roadmap.sides is not None
    assert set(fast.roadmap.sides) == {0.25, 0.5, 1.0}


@pytest.mark.parametrize("y", ["up", "down"])
@pytest.mark.parametrize("more", [{}, {"origin": [10, -3]}, {"origin": [10, -3], "yaw": 0.5}])
def test_a_plan_of_adaptive_cells_is_read_as_it_was_written(y: str, more: dict[str, Any]) -> None:
    where = {"floor": {"size": [8, 4]}, "cell_size": "adaptive", "smallest": "0.1", "y": y, **more}
    document_ = document(where, home="Q0-0x4", target="Q40-24x4", radius="0.05")
    scenario = parse_scenario(document_)
    assert parse_scenario(dump_scenario(scenario)) == scenario
    plan = rightofway.solve(scenario, time_limit=None, options={"iterations": 1})
    assert rightofway.check(plan).ok
    assert parse_plan(dump_plan(plan)).scenario == scenario


@pytest.mark.parametrize(
    ("where", "message"),
    [
        ({"grid": ["..."], "cell_size": "adaptive"}, "a grid has cells already"),
        ({"floor": FLOOR, "smallest": 1}, "smallest is for cell_size: adaptive"),
        ({"floor": FLOOR, "cell_size": "adaptive", "smallest": 9}, "smallest: 9 is longer"),
        (
            {"floor": FLOOR, "cell_size": "adaptive", "smallest": 1, "largest": "1/2"},
            "largest: 1/2 is below the smallest cell, 1",
        ),
    ],
)
def test_what_does_not_fit_is_said(where: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_scenario(document(where))


def test_a_point_beside_all_squares_is_an_error_with_the_nearest() -> None:
    where = {"floor": FLOOR, "cell_size": "adaptive", "smallest": 1}
    with pytest.raises(InputError, match=r"target: \{x: 3, y: 2\} is in no free cell \(the near"):
        parse_scenario(document(where, target={"x": 3, "y": 2}))


def test_a_map_in_pixels_lies_where_its_frame_says(tmp_path: Path) -> None:
    """8 x 8 pixels of 0.5 m from (-1, 2) on; the upper right quarter is occupied."""
    pixels = np.full((8, 8), 254, np.uint8)
    pixels[:4, 4:] = 0
    Image.fromarray(pixels).save(tmp_path / "room.png")
    (tmp_path / "room.yaml").write_text(
        "image: room.png\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    (tmp_path / "s.yaml").write_text(
        "format: rightofway-scenario/1\n"
        "map: {layout: room.yaml, cell_size: adaptive, smallest: 0.5}\n"
        "robots: [{name: R1, home: {x: -1, y: 2}, target: {x: 0.9, y: 5.9}}]\n"
    )
    loaded = load_with_notes(tmp_path / "s.yaml")
    roadmap = loaded.scenario.roadmap
    assert roadmap.labels == ("Q0-0x4", "Q4-0x4", "Q0-4x4")
    points = [tuple(map(int, roadmap.get_point(vertex))) for vertex in range(3)]
    assert points == [(0, 3), (2, 3), (0, 5)]
    assert tell_notes(loaded) == ("map cut into 3 squares of 2 m, from 48 free cells",)
    assert roadmap.lengths == (Fraction(2),)


def test_inspect_speaks_of_the_smallest_cells_once() -> None:
    """Each pair of squares that is too near would be hundreds of findings on a real map."""
    where = {"floor": FLOOR, "cell_size": "adaptive", "smallest": 1}
    scenario = parse_scenario(document(where, radius="0.6"))
    site = Site(
        roadmap=scenario.roadmap,
        units=Units(length="m"),
        robots=scenario.robots,
        rules=scenario.rules,
    )
    result = inspect(site)
    assert [str(each.fact) for each in result.findings if each.kind == "too near"] == [
        "The middles of the smallest cells are 1 m apart; robots of radius 0.6 m need 1.2 m"
    ]
