"""Small pictures of sites: every shape of a map can be drawn, however long and thin it is."""

from __future__ import annotations

import io
from typing import Any

import pytest
from PIL import Image

from rightofway.io import parse_scenario
from rightofway.metrics import Site
from rightofway.model import Scenario
from rightofway.solve import solve
from rightofway.viz import make_png, make_preview

COUNTS = (1, 2, 30, 300)


def make_line(count: int, step: tuple[float, float]) -> dict[str, Any]:
    """Return a roadmap of vertices in a line; a step of (0, 0) puts them all on one point."""
    vertices = {f"V{index}": [index * step[0], index * step[1]] for index in range(count)}
    edges = [
        {"from": f"V{index}", "to": f"V{index + 1}", "length": 1} for index in range(count - 1)
    ]
    return {"roadmap": {"vertices": vertices, "edges": edges}}


def make_fan(count: int) -> dict[str, Any]:
    """Return a roadmap of many short lanes in a wide hall: its lanes are a fraction of a pixel."""
    vertices = {f"V{index}": [index % 2, 40 * index] for index in range(2 * count)}
    edges = [[f"V{2 * index}", f"V{2 * index + 1}"] for index in range(count)]
    return {"roadmap": {"vertices": {**vertices, "E": [9000, 0.5]}, "edges": [*edges, ["V0", "E"]]}}


MAPS = {
    f"{name} of {count}": shape
    for count in COUNTS
    for name, shape in (
        ("row of cells", {"grid": ["." * count]}),
        ("column of cells", {"grid": ["."] * count}),
        ("line to the right", make_line(count, (1, 0))),
        ("line down", make_line(count, (0, 1))),
        ("line across", make_line(count, (1000, 0.001))),
        ("point", make_line(count, (0, 0))),
        ("fan", make_fan(count)),
    )
}


def read_map(shape: dict[str, Any]) -> Scenario:
    """Return a scenario with one robot that works at home."""
    home = "N0" if "grid" in shape else "V0"
    document = {
        "format": "rightofway-scenario/1",
        "map": shape,
        "robots": [{"name": "R1", "home": home, "target": home, "work": 1}],
    }
    return parse_scenario(document)


@pytest.mark.parametrize("shape", MAPS.values(), ids=MAPS)
def test_a_map_of_any_shape_has_a_preview(shape: dict[str, Any]) -> None:
    scenario = read_map(shape)
    content = make_preview(Site(roadmap=scenario.roadmap, robots=scenario.robots))
    with Image.open(io.BytesIO(content)) as picture:
        assert picture.size == (640, 360)
        assert len(picture.convert("RGB").getcolors() or ()) > 1, "nothing is drawn"


@pytest.mark.parametrize("scale", [None, 1, 2, 40])
@pytest.mark.parametrize("name", [name for name in MAPS if "fan" not in name and "300" not in name])
def test_a_map_of_any_shape_has_a_picture_at_any_scale(name: str, scale: float | None) -> None:
    assert make_png(solve(read_map(MAPS[name])), scale=scale)
