"""The studio as somebody new uses it, with a stop-watch: a floor, a ROS map, a LIF file.

With ``RIGHTOFWAY_PICTURES=docs/images`` the pictures of docs/studio/index.md are written again.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import needs_browser
from tests.builders.drawing import StudioPage, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"
TWO_MINUTES = 120


@pytest.fixture
def studio(browser: Browser, empty: Client) -> Iterator[StudioPage]:
    """Return the page of a studio in an empty folder."""
    with studio_page(browser, empty) as studio:
        yield studio


def exported(studio: StudioPage) -> bytes:
    """Return the page that the studio exports."""
    with studio.page.expect_download() as download:
        studio.page.get_by_role("link", name="Web page").click()
    return Path(download.value.path()).read_bytes()


def test_a_floor_is_drawn_planned_watched_understood_and_exported(studio: StudioPage) -> None:
    """12 x 8 m, two walls, a door, three robots."""
    began = time.monotonic()
    studio.button("Create the floor").click()
    studio.opened()
    studio.drag((7.25, 0.25), (7.25, 7.75))
    studio.drag((2.25, 5.25), (5.25, 5.25))
    studio.button("Door").click()
    studio.press((7.25, 3.75))
    studio.tab("Robots")
    for home, stop in (
        ((1.25, 3.75), (10.25, 3.75)),
        ((3.25, 1.75), (10.25, 1.75)),  # as far from the door as the first one
        ((1.25, 6.75), (10.75, 6.25)),
    ):
        studio.press(home)
        studio.press(stop)
    assert len(studio.document["robots"]) == 3
    assert studio.page.get_by_role("alert").count() == 0
    studio.keep("studio-draw")
    studio.button("Plan").click()
    studio.planned()
    studio.button("Play").click()
    studio.poll(studio.moment, "time goes on")
    studio.button("Pause").click()
    why = studio.page.locator(".waits .watch").first
    assert " waits " in why.inner_text()
    why.click()
    assert studio.page.locator("#card").is_visible()
    studio.keep("studio-plan")
    assert b"<!doctype html>" in exported(studio)[:200].lower()
    assert time.monotonic() - began < TWO_MINUTES
    assert studio.complaints == []


def test_a_ros_map_is_dropped_drawn_on_and_planned(studio: StudioPage) -> None:
    studio.drop(LAYOUTS / "room.yaml", LAYOUTS / "room.pgm")
    studio.opened()
    studio.page.get_by_text("The map is the file room.yaml").wait_for()
    studio.button("Draw on a copy of it").click()
    studio.settle()
    rows = studio.document["map"]["grid"]
    studio.button("Brush").click()
    studio.press((1.25, 3.25))  # from -1, 2 on: cell 4 of row 2 of 4 from below
    assert studio.document["map"]["grid"] == [rows[0], f"{rows[1][:4]}@{rows[1][5:]}", *rows[2:]]
    studio.page.keyboard.press("Control+z")
    studio.settle()
    assert studio.document["map"]["grid"] == rows
    studio.tab("Robots")
    studio.button("Add 3 at random").click()
    studio.settle()
    assert len(studio.document["robots"]) == 3
    studio.button("Plan").click()
    studio.planned()
    slider = studio.page.get_by_role("slider", name="Time")
    assert float(slider.get_attribute("max") or 0) > 0
    assert b"<!doctype html>" in exported(studio)[:200].lower()


def test_a_lif_file_is_dropped_drawn_on_and_planned(studio: StudioPage, empty: Client) -> None:
    studio.drop(LAYOUTS / "hall.lif.json")
    studio.opened()
    before = (empty.folder / "hall.lif.json").read_bytes()
    studio.button("Draw on a copy of it").click()
    studio.settle()
    studio.button("Lane").click()
    studio.press((3.5, 5.25))  # from B ...
    studio.press((3.5, -2.75))  # ... to C
    studio.page.keyboard.press("Escape")
    assert ["B", "C"] in studio.document["map"]["roadmap"]["edges"]
    studio.tab("Robots")
    studio.button("Add 3 between stations").click()
    studio.settle()
    assert len(studio.document["robots"]) == 3
    assert studio.page.get_by_role("alert").count() == 0
    studio.button("Plan").click()
    studio.planned()
    studio.button("Save").click()
    studio.saved()
    assert "roadmap:" in (empty.folder / "hall.scenario.yaml").read_text()
    assert (empty.folder / "hall.lif.json").read_bytes() == before
