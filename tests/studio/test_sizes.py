"""The page in windows of every size: whatever a large window offers, a small one offers, too."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import expect, needs_browser
from tests.builders.drawing import StudioPage, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser

LARGE = (1280, 800)
LEAST = 300
"""The narrowest panel that can be chosen [pixels]."""

SIZES = [(320, 480), (390, 844), (640, 400), (844, 390), (1024, 500), (1280, 520), (1366, 480)]

REACHED = """() => {
  const found = new Set();
  for (const it of document.querySelectorAll("button, select, input, textarea, summary")) {
    if (it.disabled || !it.checkVisibility()) continue;
    it.scrollIntoView({ block: "center", inline: "center" });
    const { left, top, width, height } = it.getBoundingClientRect();
    const over = document.elementFromPoint(left + width / 2, top + height / 2);
    const text = (it.querySelector(".name") ?? it).textContent.trim(); // of a card its name alone
    const named = it.ariaLabel || text || it.labels?.[0]?.textContent.trim();
    if (over && (it.contains(over) || over.contains(it))) found.add(named);
  }
  return [...found].filter(Boolean);
}"""
"""Names of all controls that a pointer reaches, perhaps after scrolling."""


@pytest.fixture
def studio(browser: Browser, site: Client) -> Iterator[StudioPage]:
    """Return the page of a studio with a plan of a door."""
    site.studio.file = "door.yaml"
    with studio_page(browser, site) as studio:
        studio.opened()
        studio.tab("Plan")
        studio.page.fill("#limit", "0.5")
        studio.button("Plan").click()
        studio.planned()
        yield studio


def list_reached(studio: StudioPage, size: tuple[int, int]) -> set[str]:
    """Return the names of all controls that a pointer reaches in a window of a size."""
    studio.page.set_viewport_size({"width": size[0], "height": size[1]})
    studio.settle()
    studio.painted()
    assert studio.page.evaluate("document.documentElement.scrollWidth") <= size[0]
    return set(studio.page.evaluate(REACHED))


def test_all_that_a_large_window_offers_is_reached_in_a_small_one(studio: StudioPage) -> None:
    for tab in ("Plan", "Robots", "Map"):
        studio.tab(tab)
        offered = list_reached(studio, LARGE)
        assert {"Files", "Save", "Language", "Help and keys", "Plan"} <= offered
        for size in SIZES:
            assert offered - list_reached(studio, size) == set(), (tab, size)


def test_all_ways_to_begin_are_reached_in_a_small_window(studio: StudioPage) -> None:
    studio.start()
    offered = list_reached(studio, LARGE)
    assert {"Create the floor", "Choose files", "Language"} <= offered
    for size in SIZES:
        assert offered - list_reached(studio, size) == set(), size


def test_help_can_be_read_and_closed_in_a_small_window(studio: StudioPage) -> None:
    studio.button("Help and keys").click()
    for size in SIZES:
        assert "Close" in list_reached(studio, size), size


def read_width(studio: StudioPage) -> int:
    """Return the width of the panel [pixels], as its edge says it, too."""
    studio.settle()
    box = studio.page.locator(".side").bounding_box()
    assert box is not None
    edge = studio.page.get_by_role("separator", name="Width of the panel")
    expect(edge).to_have_attribute("aria-valuenow", str(round(box["width"])))
    return round(box["width"])


def drag_edge(studio: StudioPage, x: float) -> None:
    """Drag the edge of the panel to a position on the screen [pixels]."""
    box = studio.page.locator(".side-edge").bounding_box()
    assert box is not None
    mouse = studio.page.mouse
    mouse.move(box["x"] + box["width"] / 2, box["y"] + 200)
    mouse.down()
    mouse.move(x, box["y"] + 220, steps=4)
    mouse.up()


@pytest.mark.parametrize("size", [LARGE, (1920, 1080), (960, 600), (1024, 500)])
def test_the_panel_is_widened_by_hand_and_keys_and_remembered(
    studio: StudioPage, size: tuple[int, int]
) -> None:
    width, height = size
    studio.page.set_viewport_size({"width": width, "height": height})
    usual = read_width(studio)
    drag_edge(studio, width - 520)
    assert read_width(studio) == 520
    studio.reload()
    assert read_width(studio) == 520
    drag_edge(studio, 5)
    most = read_width(studio)
    assert 0.59 * width < most < 0.66 * width  # the map keeps room
    drag_edge(studio, width - 5)
    assert read_width(studio) == LEAST
    edge = studio.page.locator(".side-edge")
    moment = studio.moment()
    for key, wanted in (("ArrowLeft", LEAST + 24), ("End", most), ("Home", LEAST)):
        edge.press(key)
        assert read_width(studio) == wanted
    assert studio.moment() == moment  # arrows of the edge do not move time
    edge.dblclick()
    assert read_width(studio) == usual
    studio.reload()
    assert read_width(studio) == usual


def test_a_chosen_width_of_the_panel_hides_nothing_in_other_windows(studio: StudioPage) -> None:
    drag_edge(studio, 5)
    studio.tab("Robots")
    offered = list_reached(studio, LARGE)
    for size in [*SIZES, (700, 800), (1080, 700)]:
        assert offered - list_reached(studio, size) == set(), size
