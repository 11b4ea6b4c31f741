"""What the map shows beside its robots: names, lanes, routes, the scale, what is at the pointer."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from pathlib import Path

import pytest
from PIL import Image

from rightofway.model import Plan
from rightofway.site import Obstacle
from rightofway.viz import Background
from tests.builders.plans import crowd, door, loop, yard
from tests.builders.players import overlap
from tests.viewer.conftest import Opener, pixel

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
    assert viewer.ask("mapView.sizes.robot") >= 4.5
    assert viewer.ask("mapView.sizes.homeOf(plan.robots[0]) > mapView.sizes.robot")


def test_a_small_grid_fills_the_height_of_its_pane(show: Opener) -> None:
    viewer = show(door(), viewport={"width": 1600, "height": 1000})
    assert 3 * viewer.view[0] / viewer.box()["height"] > 0.8


def test_routes_along_one_way_lie_side_by_side(show: Opener) -> None:
    viewer = show(door(), "#decision=1")
    first, second, line = viewer.ask(
        "[mapView.route.aside(0), mapView.route.aside(1), mapView.sizes.route.line]"
    )
    assert second - first > line
    assert 2 * first > line  # the way back is on the other side of the middle


def test_the_scale_bar_is_a_round_length(show: Opener) -> None:
    viewer = show(yard())
    per_pixel = viewer.ask("plan.roadmap.unit / mapView.viewport.scale")
    length = viewer.ask(f"roundLength({per_pixel})")
    assert f"{length:e}"[0] in "125"
    assert 50 < length / per_pixel <= 130
    assert viewer.ask("[0.9, 4, 13].map((width) => roundLength(width / 130))") == [0.5, 2, 10]


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
    box = "[...document.querySelectorAll('.tools, #map')].map((it) =>"
    where = f"{box} it.getBoundingClientRect().toJSON())"
    before = viewer.ask(where)
    viewer.page.keyboard.press("h")
    assert viewer.page.locator("#heat-legend").is_visible()
    assert viewer.ask(where) == before


def test_a_picture_lies_under_the_map(show: Opener, tmp_path: Path) -> None:
    """The right half of the picture is black; cells are white without it."""
    picture = Image.new("L", (30, 30), 255)
    picture.paste(0, (15, 0, 30, 30))
    picture.save(tmp_path / "hall.png")
    viewer = show(door(), background=Background(picture=tmp_path / "hall.png", opacity=1))
    viewer.wait_for("mapView.base.paintings > 1 && !frames.asked")
    left, top, scale = viewer.ask("(({left, top, scale}) => [left, top, scale])(mapView.viewport)")
    floor = {x: pixel(viewer, "map", left + x * scale, top + scale)[0] for x in (0.7, 1.3)}
    assert floor == {0.7: 255, 1.3: 0}
    assert viewer.requests == []  # the picture is in the page


def test_lanes_out_of_sight_are_not_drawn(show: Opener) -> None:
    viewer = show(yard())
    drawn = """(right) => {
      let lines = 0;
      const draw = CanvasRenderingContext2D.prototype.lineTo;
      CanvasRenderingContext2D.prototype.lineTo = function (...args) {
        lines++;
        draw.apply(this, args);
      };
      mapView.viewport.pan(right, 0);
      mapView.paint();
      CanvasRenderingContext2D.prototype.lineTo = draw;
      return lines;
    }"""
    in_sight, out_of_sight = (viewer.page.evaluate(drawn, right) for right in (0, 5000))
    assert in_sight - out_of_sight >= 5  # a lane for both ways and its dashes, three for one way


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
    place = "document.getElementById('diagram').getBoundingClientRect().left"
    assert viewer.ask(f"{place} >= mapView.canvas.getBoundingClientRect().right")
    assert viewer.ask("mapView.viewport.scale") > 130
    viewer.page.set_viewport_size({"width": 1600, "height": 1000})
    viewer.wait_for(f"{place} === 0")
    viewer.page.set_viewport_size({"width": 1280, "height": 720})
    viewer.ask("paper.lay(true)")
    assert viewer.ask(f"{place} === 0")
    assert viewer.complaints == []
