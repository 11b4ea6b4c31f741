"""The studio in German: no state of its page says an English word that is not marked as such."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import needs_browser
from tests.builders.drawing import StudioPage, studio_page
from tests.builders.languages import english_on

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser


@pytest.fixture
def german(browser: Browser, site: Client) -> Iterator[StudioPage]:
    """Return the page of a studio in a German browser, with a floor that has findings."""
    (site.folder / "broken.yaml").write_text("a: [1\n")
    site.studio.file = "floor.yaml"
    with studio_page(browser, site, locale="de-DE") as page:
        page.opened()
        yield page


def plan(studio: StudioPage) -> None:
    studio.tab("Plan")
    studio.page.fill("#limit", "1")
    studio.button("Planen").click()
    studio.planned()


def test_map_robots_and_help_are_german(german: StudioPage) -> None:
    for tab in ("Karte", "Roboter", "Plan"):
        german.tab(tab)
        german.settle()
        german.keep(f"german-{tab.lower()}")
        assert english_on(german) == [], tab
    german.button("Hilfe und Tasten").click()
    german.page.get_by_role("dialog").wait_for()
    assert not english_on(german), "\n".join(english_on(german))
    german.page.keyboard.press("Escape")
    german.button("Dateien").click()
    german.page.get_by_text("Neuer Grundriss").wait_for()
    german.page.get_by_text("lässt sich nicht öffnen").wait_for()
    assert not english_on(german), "\n".join(english_on(german))


def test_a_plan_its_robots_and_its_waits_are_german(german: StudioPage) -> None:
    plan(german)
    assert not english_on(german), "\n".join(english_on(german))
    for robot in german.document["robots"]:
        german.press((robot["home"]["x"], robot["home"]["y"]))  # it is there at time 0
        german.page.get_by_role(
            "heading", name=f"Was wäre, wenn {robot['name']} anders wäre"
        ).wait_for()
        assert english_on(german) == [], robot
    german.button("Heatmap der Belegung").click()
    german.seek(9)
    german.keep("german-heat")
    assert not english_on(german), "\n".join(english_on(german))


def test_what_the_reader_notes_is_german(german: StudioPage) -> None:
    notes = german.page.locator("details.notes")
    notes.get_by_text("Grundriss in 24 x 16 = 384 Zellen von 0,5 m geteilt").wait_for()


def test_another_language_is_spoken_at_once(german: StudioPage) -> None:
    plan(german)
    german.page.get_by_label("Sprache").select_option("en")
    german.page.get_by_text("Who waits, and why").wait_for()
    assert "driving" in german.text("#states")
    assert "Flowtime" in german.text(".curve")


def test_the_line_below_the_map_says_the_longest_wait_in_german(
    browser: Browser, site: Client
) -> None:
    site.studio.file = "door.yaml"
    with studio_page(browser, site, locale="de-DE") as german:
        german.opened()
        plan(german)
        assert "wartet" in german.text(".status")
        assert english_on(german) == []
