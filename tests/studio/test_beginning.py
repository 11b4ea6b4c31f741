"""How one begins: a gallery with pictures, examples, drafts, files that are dropped."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import expect, needs_browser
from tests.builders.drawing import StudioPage, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser

LAYOUTS = Path(__file__).parents[1] / "data" / "layouts"


@pytest.fixture
def studio(browser: Browser, empty: Client) -> Iterator[StudioPage]:
    """Return the start page of a studio in an empty folder."""
    with studio_page(browser, empty) as studio:
        yield studio


def wall(studio: StudioPage) -> None:
    """Draw a wall on a new floor, and wait until the draft is kept."""
    studio.button("Create the floor").click()
    studio.opened()
    studio.drag((7.25, 0.25), (7.25, 3.75))
    studio.settle()  # and the draft is kept


def test_an_example_is_one_press_away_and_planned_with_a_second(studio: StudioPage) -> None:
    card = studio.page.get_by_role("button", name="Workshop in metres 4 robots")
    studio.page.get_by_role("button", name="Warehouse with jobs 3 robots").wait_for()
    for picture in studio.page.locator("main.start .gallery li").all():
        picture.scroll_into_view_if_needed()  # pictures far below are made when they are near
        picture.locator("img").wait_for()
    studio.keep("studio-start")
    card.click()
    studio.opened()
    studio.button("Plan").click()
    studio.planned()
    studio.page.get_by_role("application", name="Map with 4 robots").wait_for()
    assert studio.complaints == []


def test_the_first_press_of_enter_makes_a_floor(studio: StudioPage) -> None:
    expect(studio.button("Create the floor")).to_be_focused()
    studio.page.keyboard.press("Enter")
    studio.opened()
    assert studio.document["map"]["floor"]["size"] == [12, 8]


def test_files_stand_under_their_folders_with_pictures_of_their_maps(
    studio: StudioPage, empty: Client
) -> None:
    (empty.folder / "hall").mkdir()
    (empty.folder / "hall" / "gate.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    (empty.folder / "notes.yaml").write_text("just: notes\n")
    studio.page.reload()
    hall = studio.page.get_by_label("In the folder hall")
    hall.get_by_role("button", name="gate.map map").locator("img").wait_for()
    studio.button("notes.yaml cannot be opened").wait_for()


def test_a_reload_and_the_way_back_lead_to_the_same_document(studio: StudioPage) -> None:
    wall(studio)
    drawn = studio.document
    studio.page.reload()
    studio.opened()
    assert studio.document == drawn
    studio.button("Files").click()
    studio.page.locator("main.start").wait_for()
    studio.page.go_back()
    studio.page.locator("main.start").wait_for(state="detached")
    assert studio.document == drawn


def test_a_draft_that_is_newer_than_its_file_is_opened_and_the_file_is_one_press_away(
    studio: StudioPage,
) -> None:
    wall(studio)
    studio.button("Save").click()
    studio.saved()
    saved = studio.document
    studio.drag((2.25, 5.25), (5.25, 5.25))
    changed = studio.document
    studio.settle()  # and the draft is kept
    studio.button("Files").click()
    studio.page.get_by_label("In the folder").get_by_role("button", name="floor.yaml").click()
    studio.opened()
    assert studio.document == changed
    studio.button("Open the saved version").click()
    studio.saved()
    assert studio.document == saved


def test_a_draft_is_deleted_and_taken_back(studio: StudioPage) -> None:
    wall(studio)
    studio.button("Files").click()
    studio.page.get_by_label("Delete: Untitled").click()
    draft = studio.page.get_by_role("button", name=re.compile("^Untitled"))
    draft.wait_for(state="detached")
    studio.button("Undo").click()
    draft.wait_for()


def test_a_ros_map_waits_for_its_picture(studio: StudioPage) -> None:
    studio.drop(LAYOUTS / "room.yaml")
    alert = studio.page.get_by_role("alert")
    alert.get_by_text("there is no picture 'room.pgm'").wait_for()
    alert.get_by_text("Drop the picture here, too").wait_for()
    studio.drop(LAYOUTS / "room.pgm")
    studio.opened()
    assert studio.document["map"]["layout"] == "room.yaml"
    assert studio.document["robots"] == []


def test_another_file_of_the_same_name_is_replaced_on_request_only(
    studio: StudioPage, empty: Client
) -> None:
    (empty.folder / "room.yaml").write_text("mine: true\n")
    studio.drop(LAYOUTS / "room.pgm", LAYOUTS / "room.yaml")
    studio.button("Replace").wait_for()
    assert (empty.folder / "room.yaml").read_text() == "mine: true\n"
    studio.button("Replace").click()
    studio.opened()
    assert (empty.folder / "room.yaml").read_bytes() == (LAYOUTS / "room.yaml").read_bytes()


def test_the_plan_button_says_what_is_missing_and_leads_there(studio: StudioPage) -> None:
    studio.button("Create the floor").click()
    studio.opened()
    plan = studio.button("Plan")
    assert "needs robots" in (plan.get_attribute("title") or "")
    plan.click(force=True)
    expect(studio.page.get_by_role("tab", name="Robots")).to_have_attribute("aria-selected", "true")
    studio.page.get_by_text("A plan needs robots").wait_for()


def test_a_name_without_an_ending_is_saved_as_yaml_with_enter(
    studio: StudioPage, empty: Client
) -> None:
    wall(studio)
    field = studio.page.get_by_label("Name of the file")
    field.fill("floor one")
    field.press("Enter")
    studio.saved()
    assert (empty.folder / "floor one.yaml").is_file()


def test_the_keys_stand_beside_the_page_which_stays_usable(studio: StudioPage) -> None:
    studio.page.keyboard.press("?")
    help_ = studio.page.get_by_role("dialog", name="Help and keys")
    help_.wait_for()
    studio.page.keyboard.press("Escape")
    help_.wait_for(state="detached")
    wall(studio)
    studio.page.keyboard.press("?")
    assert "Door" in help_.inner_text()
    assert "Station" not in help_.inner_text()
    studio.page.keyboard.press("Control+z")
    assert studio.document["map"]["floor"]["obstacles"] == []
