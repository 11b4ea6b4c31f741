"""The page at the sizes that people have: telephones, upright or not, tablets and screens."""

import pytest

from tests.builders.plans import crowd, door
from tests.viewer.conftest import Opener

BOXES = """(ids) => ids.map((id) => {
  const { left, top, right, bottom } = document.getElementById(id).getBoundingClientRect();
  return left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight && bottom > top;
})"""
"""Whether elements are in sight as a whole, without scrolling."""

CONTROLS = "button:not(.link), select, input:not([type=radio])"
SMALL = """(controls) => controls.filter((it) => {
  const { width, height } = it.getBoundingClientRect();
  return width && (width < 44 || height < 44);
}).map((it) => it.id)"""
"""Controls that a finger may miss; names in a line of text apart."""


@pytest.mark.parametrize(
    "size", [(390, 844), (844, 390), (768, 1024), (1280, 720), (1600, 1000)], ids=str
)
def test_play_slider_and_map_are_in_sight(show: Opener, size: tuple[int, int]) -> None:
    touch = min(size) < 800 and size != (1280, 720)
    viewer = show(
        crowd(30), viewport={"width": size[0], "height": size[1]}, has_touch=touch, is_mobile=touch
    )
    assert viewer.page.evaluate(BOXES, ["play", "slider", "readout", "map"]) == [True] * 4
    assert viewer.is_as_wide_as(size[0])


@pytest.mark.parametrize("size", [(390, 844), (844, 390)], ids=str)
def test_controls_are_large_enough_for_fingers(show: Opener, size: tuple[int, int]) -> None:
    viewer = show(
        door(),
        "#robot=R1",
        viewport={"width": size[0], "height": size[1]},
        has_touch=True,
        is_mobile=True,
    )
    assert viewer.page.locator(CONTROLS).evaluate_all(SMALL) == []


def test_the_card_of_a_robot_is_in_sight_where_one_taps(show: Opener) -> None:
    viewer = show(crowd(30), viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    viewer.page.tap("#tab-robots")
    viewer.page.tap("#robot-list .row:has-text('Robot 3')")
    assert viewer.page.evaluate(BOXES, ["card", "play"]) == [True, True]


def test_a_low_screen_needs_no_scrolling(show: Opener) -> None:
    viewer = show(door(), viewport={"width": 844, "height": 390})
    assert viewer.size[1] == 390
