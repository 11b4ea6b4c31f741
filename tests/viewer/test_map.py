"""What the map shows beside its robots: names, lanes, routes, the scale, what is at the pointer."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, pairwise
from pathlib import Path

import pytest
from PIL import Image

from rightofway.model import Plan
from rightofway.site import Obstacle
from rightofway.viz import Background
from rightofway.viz.palette import LIGHT
from tests.builders.plans import crowd, door, loop, yard
from tests.builders.players import overlap
from tests.viewer.conftest import Opener

SIZES = [(1600, 1000), (1280, 720), (390, 844)]


@pytest.mark.parametrize("plan", [door(), loop(), yard(), crowd(50)])
@pytest.mark.parametrize(("width", "height"), SIZES)
def test_no_name_covers_another(show: Opener, plan: Plan, width: int, height: int) -> None:
    viewer = show(plan, viewport={"width": width, "height": height})
    for tick in (0, 3.5, 9, 17.25):
        viewer.seek(min(tick, viewer.end))
        names = viewer.names()
        assert names
        for one, other in combinations(names, 2):
            assert not overlap(one.box, other.box), (tick, one, other)


def test_fifty_robots_have_their_names_at_once(show: Opener) -> None:
    viewer = show(crowd(50), "#tick=80", viewport={"width": 1600, "height": 1000})
    named = {name.text for name in viewer.names()}
    assert (
        len([name for name in named if name.startswith("Robot ")]) >= 40
    )  # some stand one on another


def test_robots_and_places_of_a_roadmap_have_their_names(show: Opener) -> None:
    assert {name.text for name in show(yard()).names()} == {
        "porter", "runner", "dock", "gate", "press", "paint",
    }  # fmt: skip


def test_the_chosen_robot_has_its_name_in_any_crowd(show: Opener) -> None:
    viewer = show(crowd(1000), "#tick=20&robot=Robot 7")
    assert "Robot 7" in [name.text for name in viewer.names()]


def test_names_of_robots_that_meet_do_not_cover_each_other(show: Opener) -> None:
    """Robots 2 and 3 are shown while they drive through each other, others close by."""
    viewer = show(crowd(6), "#fault=1")
    boxes = [name.box for name in viewer.names()]
    assert len(boxes) > 4
    assert not any(overlap(one, other) for one, other in combinations(boxes, 2))


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_robots_can_be_seen_on_every_screen(show: Opener, width: int, height: int) -> None:
    viewer = show(crowd(50), viewport={"width": width, "height": height})
    radii = [disc.radius for disc in viewer.discs() if disc.is_filled]
    assert round(min(radii), 3) >= 4.5
    sides = [right - left for left, _, right, _ in (field.box for field in viewer.fields())]
    assert min(sides) / 2 > min(radii)  # a home is seen round its robot


def test_a_small_grid_fills_the_height_of_its_pane(show: Opener) -> None:
    viewer = show(door(), viewport={"width": 1600, "height": 1000})
    assert 3 * viewer.view[0] / viewer.box()["height"] > 0.8


def test_routes_along_one_way_lie_side_by_side(show: Opener) -> None:
    viewer = show(door(), "#decision=1")
    middle, border = viewer.on_map((1.5, 1))  # between N1 and N4, where both drive both ways
    near = 0.4 * viewer.view[0]
    crossing = sorted(
        (one[0], line.width)
        for line in viewer.lines()
        for one, other in pairwise(line.points)
        if abs(one[0] - middle) < near and (one[1] - border) * (other[1] - border) < 0
    )
    assert len(crossing) == 4
    for (left, width), (right, _) in pairwise(crossing):
        assert right - left > width


def test_the_scale_bar_is_a_round_length(show: Opener) -> None:
    viewer = show(yard())
    (said,) = [each for each in viewer.texts() if re.match(r"[0-9.]+ m$", each.text)]
    length = float(said.text.split()[0])
    assert f"{length:e}"[0] in "125"
    right = said.at[0]  # the text ends where the bar does
    (bar,) = {line.points for line in viewer.lines() if line.points[-1][0] == right}
    width = right - bar[0][0]
    assert 50 < width <= 130
    assert width == pytest.approx(length * viewer.view[0])


def test_what_is_at_the_pointer_stands_beside_it(show: Opener) -> None:
    viewer = show(yard(), "#tick=2")
    box = viewer.page.locator("#map").bounding_box()
    assert box
    x, y = viewer.at((4, 3))  # the press
    viewer.page.mouse.move(x, y)
    tip = viewer.page.locator("#hover")
    assert tip.inner_text().splitlines() == [
        "press, stop of porter",
        "next porter, at 11 s",
        "x 4.00 m, y 3.00 m",
    ]
    at = tip.bounding_box()
    assert at
    near = min(abs(at["x"] - x), abs(at["x"] + at["width"] - x))
    assert near < 40
    viewer.page.mouse.move(*viewer.at((2, 0)))
    assert tip.inner_text().splitlines()[:2] == ["runner", "driving to dock, 0 s to 4 s"]
    viewer.page.mouse.move(box["x"] + box["width"] + 30, 5)
    assert not tip.is_visible()


def test_a_heat_map_leaves_tools_and_map_where_they_are(show: Opener) -> None:
    viewer = show(crowd(50), viewport={"width": 1280, "height": 720})
    places = ("#map", viewer.page.get_by_role("toolbar"))
    before = [viewer.box(place) for place in places]
    viewer.press("h")
    assert viewer.page.locator("#heat-legend").is_visible()
    assert [viewer.box(place) for place in places] == before


def test_a_picture_lies_under_the_map(show: Opener, tmp_path: Path) -> None:
    """The right half of the picture is black; cells are white without it."""
    picture = Image.new("L", (30, 30), 255)
    picture.paste(0, (15, 0, 30, 30))
    picture.save(tmp_path / "hall.png")
    viewer = show(door(), background=Background(picture=tmp_path / "hall.png", opacity=1))
    viewer.poll(viewer.pictures, "the picture on the map")
    floor = {x: viewer.colour(viewer.on_map((x, 1.5)))[0] for x in (1.2, 1.8)}  # in N4
    assert floor == {1.2: 255, 1.8: 0}
    assert viewer.requests == []  # the picture is in the page


def test_lanes_out_of_sight_are_not_drawn(show: Opener) -> None:
    viewer = show(yard())
    lanes = {line.points for line in viewer.lines() if line.colour == LIGHT.wall}
    assert len(lanes) == 4  # one for both ways, three for one way
    box = viewer.box()
    for _ in range(3):
        viewer.page.mouse.move(box["x"] + 5, box["y"] + 30)
        viewer.page.mouse.down()
        viewer.page.mouse.move(box["x"] + box["width"] - 5, box["y"] + 30)
        viewer.page.mouse.up()
    assert {line.points for line in viewer.lines() if line.colour == LIGHT.wall} == set()


def test_obstacles_have_their_names_on_the_map_and_at_the_pointer(show: Opener) -> None:
    side = Fraction(1)
    table = Obstacle(name="table", x=Fraction(0), y=side, width=side, height=side)
    plan = door()
    roadmap = replace(plan.scenario.roadmap, obstacles=(table,))
    viewer = show(replace(plan, scenario=replace(plan.scenario, roadmap=roadmap)))
    assert "table" in [name.text for name in viewer.names()]
    viewer.page.mouse.move(*viewer.at((0.5, 1.5)))
    assert viewer.text("#hover").splitlines()[0] == "table"
    assert viewer.complaints == []


def test_the_diagram_stands_beside_a_map_that_becomes_much_larger_so(show: Opener) -> None:
    """The map of the door grows to 1.4 times at 1280 x 720, to 1.1 times at 1600 x 1000."""
    viewer = show(door(), viewport={"width": 1280, "height": 720})
    diagram, map_ = viewer.box("#diagram"), viewer.box()
    assert diagram["x"] >= map_["x"] + map_["width"]
    assert viewer.view[0] > 130
    viewer.page.set_viewport_size({"width": 1600, "height": 1000})
    viewer.poll(lambda: viewer.box("#diagram")["x"] == 0, "the diagram below the map")
    viewer.page.set_viewport_size({"width": 1280, "height": 720})
    viewer.poll(lambda: viewer.box("#diagram")["x"] > 0, "the diagram beside the map")
    viewer.lay_on_paper()
    assert viewer.box("#diagram")["x"] < map_["width"] / 2
    assert viewer.complaints == []
