"""Pictures below a map: pixel, site and page agree to the millimetre."""

from __future__ import annotations

import json
from math import cos, sin
from pathlib import Path
from shutil import copy
from typing import Any

import pytest
from PIL import Image

from rightofway.io import parse_scenario
from rightofway.model import Plan
from rightofway.solve import solve
from rightofway.viz import Background
from tests.builders.players import Player
from tests.viewer.conftest import Opener

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"

MILLIMETRE = 0.001


def plan_on(shape: dict[str, Any], home: Any, target: Any, base: Path | None) -> Plan:
    robots = [{"name": "R1", "home": home, "target": target}]
    document = {"format": "rightofway-scenario/1", "map": shape, "robots": robots}
    return solve(parse_scenario(document, base))


def site_of_pixel(
    viewer: Player, column: float, row: float, columns: int, rows: int
) -> tuple[float, ...]:
    """Return the place of the site [length unit] that a pixel of the picture lies on."""
    viewer.poll(viewer.pictures, "a picture on the map")  # painted again, once it is there
    (corners,) = viewer.pictures()
    origin, right, below = map(viewer.on_site, corners)
    across, down = column / columns, row / rows
    return tuple(
        o + across * (r - o) + down * (b - o) for o, r, b in zip(origin, right, below, strict=True)
    )


@pytest.mark.parametrize("origin", [(0, 0, 0), (-12.34, 5.678, 0), (-3.21, -7.5, 0.3), (4, -1, -2)])
def test_pixels_of_a_ros_map_lie_where_its_frame_says(
    show: Opener, tmp_path: Path, origin: tuple[float, float, float]
) -> None:
    """The origin is the lower left corner of the picture; it turns the picture about itself."""
    Image.new("L", (60, 40), 255).save(tmp_path / "hall.pgm")
    (tmp_path / "hall.yaml").write_text(
        f"image: hall.pgm\nresolution: 0.05\norigin: {list(origin)}\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.2\n"
    )
    shape = {"layout": "hall.yaml", "cell_size": 0.5}
    viewer = show(plan_on(shape, [0, 0], [3, 5], tmp_path))
    x, y, yaw = origin
    for column, row in [(0, 40), (60, 40), (0, 0), (37, 11)]:
        right, up = 0.05 * column, 0.05 * (40 - row)
        assert site_of_pixel(viewer, column, row, 60, 40) == pytest.approx(
            [x + cos(yaw) * right - sin(yaw) * up, y + sin(yaw) * right + cos(yaw) * up],
            abs=MILLIMETRE,
        )


@pytest.mark.parametrize(
    ("level", "pixels"),
    [
        ("L1", {(100, 40): (5, -2), (200, 100): (10, -5)}),
        ("L2", {(50, 10): (0, 0), (40, 10): (0, -1)}),
    ],
)
def test_pixels_of_a_building_lie_where_its_measurements_and_fiducials_say(
    show: Opener, tmp_path: Path, level: str, pixels: dict[tuple[int, int], tuple[float, float]]
) -> None:
    """The second level is turned by 90 degrees and half as large."""
    text = (LAYOUTS / "hall.building.yaml").read_text(encoding="utf-8")
    text = text.replace("  L2:\n", "  L2:\n    drawing: {filename: hall.png}\n")
    (tmp_path / "hall.building.yaml").write_text(text, encoding="utf-8")
    Image.new("L", (220, 120), 200).save(tmp_path / "hall.png")
    home, target = ("dock", "v1") if level == "L1" else ("stairs", "top")
    shape = {"layout": "hall.building.yaml", "level": level}
    viewer = show(plan_on(shape, home, target, tmp_path))
    for pixel, site in pixels.items():
        assert site_of_pixel(viewer, *pixel, 220, 120) == pytest.approx(site, abs=MILLIMETRE)
    assert viewer.complaints == []


def test_a_turned_picture_lies_below_a_roadmap_that_is_not_turned(
    show: Opener, tmp_path: Path
) -> None:
    Image.new("L", (60, 40), 200).save(tmp_path / "hall.png")
    vertices = {"A": [-1.2345, 2.5], "B": [17.001, 2.5]}
    shape = {"roadmap": {"vertices": vertices, "edges": [["A", "B"]]}, "y": "up"}
    background = Background(picture=tmp_path / "hall.png", scale=0.1, origin=(-3.0, -1.5), yaw=0.25)
    viewer = show(plan_on(shape, "A", "B", None), background=background)
    at = site_of_pixel(viewer, 30, 10, 60, 40)
    right, up = 3.0, 3.0  # 30 pixels from the left, 30 from the lower border
    assert at == pytest.approx(
        [-3 + cos(0.25) * right - sin(0.25) * up, -1.5 + sin(0.25) * right + cos(0.25) * up],
        abs=MILLIMETRE,
    )
    ends = {viewer.on_site(end) for line in viewer.lines() for end in line.points}
    for place in vertices.values():  # the lane leads from one to the other
        assert any(end == pytest.approx(place, abs=MILLIMETRE) for end in ends)


def test_the_picture_of_a_layout_is_painted(show: Opener, tmp_path: Path) -> None:
    for name in ("room.yaml", "room.pgm"):
        copy(LAYOUTS / name, tmp_path)
    viewer = show(plan_on({"layout": "room.yaml", "cell_size": 1}, "N3", "N3", tmp_path))
    viewer.poll(viewer.pictures, "a picture on the map")
    assert viewer.complaints == []


def test_a_point_drives_along_the_curve_of_its_lane(show: Opener, tmp_path: Path) -> None:
    """From (0, 0) by way of (0, 4) to (4, 4): a quarter of the way is at (0, 2)."""
    features = [
        {
            "type": "Feature",
            "properties": {"id": index},
            "geometry": {"type": "Point", "coordinates": at},
        }
        for index, at in enumerate([[0, 0], [4, 4]])
    ]
    edge = {
        "type": "Feature",
        "properties": {"id": 9, "startid": 0, "endid": 1},
        "geometry": {"type": "LineString", "coordinates": [[0, 0], [0, 4], [4, 4]]},
    }
    graph = {"type": "FeatureCollection", "features": [*features, edge]}
    (tmp_path / "route.geojson").write_text(json.dumps(graph), encoding="utf-8")
    document: dict[str, Any] = {
        "format": "rightofway-scenario/1",
        "map": {"layout": "route.geojson"},
        "robots": [{"name": "R1", "home": "0", "target": "1", "return": "none"}],
    }
    viewer = show(solve(parse_scenario(document, tmp_path)))
    viewer.seek(viewer.end / 4)
    places = [viewer.on_site((disc.x, disc.y)) for disc in viewer.discs() if disc.is_filled]
    assert any(place == pytest.approx((0, 2), abs=MILLIMETRE) for place in places)
    assert viewer.complaints == []
    document["robots"][0]["radius"] = 1  # judged, and so drawn, on the straight line
    viewer = show(solve(parse_scenario(document, tmp_path)))
    ways = [tuple(map(viewer.on_site, line.points)) for line in viewer.lines()]
    corner = pytest.approx((0, 4), abs=MILLIMETRE)
    assert not any(point == corner for way in ways for point in way)
    viewer.seek(viewer.end / 4)
    places = [viewer.on_site((disc.x, disc.y)) for disc in viewer.discs() if disc.is_filled]
    assert any(place == pytest.approx((1, 1), abs=MILLIMETRE) for place in places)
