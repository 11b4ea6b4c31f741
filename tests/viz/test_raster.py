"""Pictures and films: what is where on them."""

import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageColor

from rightofway.check import check
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from rightofway.model import Robot, Scenario, Stop, Track
from rightofway.site import Edge, VertexId, make_roadmap
from rightofway.site.drawing import Drawing, Picture
from rightofway.solve import solve
from rightofway.viz import Film, write_gif, write_png
from rightofway.viz.palette import DARK, LIGHT, choose_colours
from rightofway.viz.raster.canvas import Scene
from rightofway.viz.raster.map import to_the_right
from tests.builders.plans import door, door_shifted, hostile

BLUE, CORAL = choose_colours(2)
MARGIN = 24


def colour_at(path: Path, x: float, y: float, scale: int = 40) -> str:
    """Return the colour at (column, row) of the map."""
    with Image.open(path) as image:
        pixel = image.convert("RGB").getpixel(
            (MARGIN + round((x + 0.5) * scale), MARGIN + round((y + 0.5) * scale))
        )
    assert isinstance(pixel, tuple)
    return "#" + bytes(int(channel) for channel in pixel).hex()


def test_routes_on_one_way_lie_side_by_side() -> None:
    """East, south and west: the line beside it keeps to the right, and turns round at the end."""
    way: list[tuple[float, float]] = [(0, 0), (2, 0), (2, 2), (2, 0)]
    assert to_the_right(way, 0.5) == [(0, 0.5), (1.5, 0.5), (1.5, 2), (2.5, 2), (2.5, 0)]


def test_walls_floor_and_paper_are_where_the_grid_has_them(tmp_path: Path) -> None:
    write_png(door(), tmp_path / "a.png", scale=40)
    assert colour_at(tmp_path / "a.png", 0, 1) == LIGHT.wall
    assert colour_at(tmp_path / "a.png", 0.8, 1.3) == LIGHT.floor
    assert colour_at(tmp_path / "a.png", -1, -1) == LIGHT.paper


def test_the_size_is_that_of_the_grid(tmp_path: Path) -> None:
    write_png(door(), tmp_path / "a.png", scale=40)
    with Image.open(tmp_path / "a.png") as image:
        assert image.size == (3 * 40 + 2 * MARGIN, 3 * 40 + 2 * MARGIN)


def test_robots_are_where_they_are_at_the_tick(tmp_path: Path) -> None:
    # tick 4: R1 has entered N7 and leaves it, R2 has entered N8 and turns
    write_png(door(), tmp_path / "a.png", 4, scale=40)
    assert colour_at(tmp_path / "a.png", 1 - 0.25, 2) == BLUE
    assert colour_at(tmp_path / "a.png", 2 - 0.25, 2) == CORAL


def test_a_waiting_robot_is_hollow(tmp_path: Path) -> None:
    write_png(door(), tmp_path / "a.png", 0, scale=40)
    assert colour_at(tmp_path / "a.png", 0, 0.15) == LIGHT.floor  # R1
    assert colour_at(tmp_path / "a.png", 2, 0.25) == CORAL  # R2 drives


def test_the_dark_theme_is_dark(tmp_path: Path) -> None:
    write_png(door(), tmp_path / "a.png", scale=40, theme=DARK)
    assert colour_at(tmp_path / "a.png", 0, 1) == DARK.wall


def test_a_negative_tick_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"tick: -1 does not fit \(give a whole number of 0"):
        write_png(door(), tmp_path / "a.png", -1)


@pytest.mark.parametrize("scale", [0, 1e5])
def test_a_picture_without_sense_is_refused(tmp_path: Path, scale: float) -> None:
    with pytest.raises(InputError, match="scale: makes a picture of"):
        write_png(door(), tmp_path / "a.png", scale=scale)
    assert list(tmp_path.iterdir()) == []


def test_a_short_film_has_eight_pictures_for_a_tick(tmp_path: Path) -> None:
    # 10 ticks: 80 steps, 81 pictures, each of 50 ms, the last one of 1.5 s
    film = write_gif(door(), tmp_path / "a.gif", scale=20)
    assert film == Film(frames=81, ticks_per_frame=Fraction(1, 8), seconds=80 * 0.05 + 1.5)
    with Image.open(tmp_path / "a.gif") as image:
        assert getattr(image, "n_frames", 1) == 81


def test_a_long_film_goes_in_larger_steps(tmp_path: Path) -> None:
    film = write_gif(door(), tmp_path / "a.gif", max_frames=5, scale=20)
    assert film == Film(frames=5, ticks_per_frame=Fraction(10, 4), seconds=4 * 0.05 + 1.5)


def test_a_film_ends_with_the_robots_at_home(tmp_path: Path) -> None:
    write_gif(door(), tmp_path / "a.gif", max_frames=3, scale=40)
    with Image.open(tmp_path / "a.gif") as image:
        image.seek(2)
        image.convert("RGB").save(tmp_path / "last.png")
    paper, home = LIGHT.floor, colour_at(tmp_path / "last.png", 0, 0.25)
    assert home not in {paper, BLUE}  # done: faint


def test_a_film_of_one_picture_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"max_frames: 1 does not fit \(give a whole number of 2"):
        write_gif(door(), tmp_path / "a.gif", max_frames=1)


def test_the_picture_of_a_faulty_plan_rings_its_robots_and_lists_its_faults(
    tmp_path: Path,
) -> None:
    """R1 drives a tick too early: lines stand below the map, red rings are round robots."""
    write_png(door(), tmp_path / "sound.png", scale=40)
    write_png(door_shifted(-1), tmp_path / "faulty.png", scale=40)
    with Image.open(tmp_path / "sound.png") as sound, Image.open(tmp_path / "faulty.png") as faulty:
        assert faulty.width == sound.width
        assert faulty.height > sound.height
        red = ImageColor.getrgb(LIGHT.held)
        assert (np.asarray(faulty.convert("RGB")) == red).all(axis=2).any()
        assert not (np.asarray(sound.convert("RGB")) == red).all(axis=2).any()


def test_any_name_can_be_drawn(tmp_path: Path) -> None:
    """The robot takes no time for its first edge: a fault, which names it and both vertices."""
    plan = replace(hostile("half \ud800"), tracks=(Track.of([0, 1, 0], [0, 0, 1]),))
    assert "half \ud800" in str(check(plan).faults[0])
    write_png(plan, tmp_path / "a.png", scale=60)
    assert (tmp_path / "a.png").exists()


def test_the_page_needs_no_pillow() -> None:
    code = (
        "import sys, rightofway.viz.page.document, rightofway.viz; sys.exit('PIL' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_robots_with_a_size_have_it_in_a_picture(tmp_path: Path) -> None:
    """R1 has a radius of half an edge of 4 m: its disc ends 2 m from its vertex."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": {"A": [0, 0], "B": [4, 0]}, "edges": [["A", "B"]]}},
        "robots": [{"name": "R1", "home": "A", "target": "B", "radius": 2, "return": "none"}],
    }
    write_png(solve(parse_scenario(document)), tmp_path / "a.png", scale=40)
    with Image.open(tmp_path / "a.png") as image:
        # the robot reaches no farther than the half unit round the map: no margin more
        assert image.size == (2 * MARGIN + 80, 2 * MARGIN + 40)
    assert colour_at(tmp_path / "a.png", 0, 0.4) == BLUE
    assert colour_at(tmp_path / "a.png", 0, 0.49 + 0.1) != BLUE


def test_a_zone_lies_below_its_lanes(tmp_path: Path) -> None:
    shape = {
        "vertices": {"A": [0, 0], "B": [4, 0]}, "edges": [["A", "B"]],
        "zones": [{"name": "aisle", "vertices": ["A"], "edges": [["A", "B"]]}],
    }  # fmt: skip
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": shape},
        "robots": [{"name": "R1", "home": "A", "target": "B"}],
    }
    scene = Scene(solve(parse_scenario(document)), LIGHT)
    write_png(scene.plan, tmp_path / "a.png", scale=40)
    tint = scene.fade(LIGHT.zone, 0.35)
    assert tint in {colour_at(tmp_path / "a.png", 0.5, 0.01 * y) for y in range(20, 50)}


def test_the_picture_of_a_layout_lies_where_it_says(tmp_path: Path) -> None:
    """Its right half is red: pixels of 1 m from x = -1 on, so that red begins at x = 1."""
    picture = Image.new("RGB", (4, 4), "#ffffff")
    picture.paste("#ff0000", (2, 0, 4, 4))
    picture.save(tmp_path / "hall.png")
    edge = Edge(tail="A", head="B", length=Fraction(2))
    roadmap = replace(
        make_roadmap({"A": (0, 0), "B": (2, 0)}, [edge], y_up=True),
        drawing=Drawing(
            picture=Picture(
                file=tmp_path / "hall.png", pixel=Fraction(1), corner=(Fraction(-1), Fraction(2))
            )
        ),
    )
    robot = Robot(name="R1", home=VertexId(0), stops=(Stop(at=VertexId(1)),), ends="none")
    plan = solve(Scenario(roadmap=roadmap, robots=(robot,)))
    write_png(plan, tmp_path / "a.png", scale=40)
    # a unit is the edge of 2 m; 0.4 units above the lane nothing else is drawn
    left, right = (colour_at(tmp_path / "a.png", x, -0.4) for x in (0.4, 0.7))
    assert ImageColor.getrgb(left)[1] > 240
    assert ImageColor.getrgb(right)[1] < 120
