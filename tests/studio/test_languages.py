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
        assert english_on(german, *NAMES) == [], tab
    german.button("Hilfe und Tasten").click()
    german.page.get_by_role("dialog").wait_for()
    assert_german(german, "help")
    german.page.keyboard.press("Escape")
    german.button("Dateien").click()
    german.page.get_by_text("Neuer Grundriss").wait_for()
    german.page.get_by_text("lässt sich nicht öffnen").wait_for()
    assert_german(german, "help")


def assert_german(studio: StudioPage, where: str = "") -> None:
    """Assert that a page has no English, with all that is folded on it."""
    studio.page.evaluate(
        "for (const each of document.querySelectorAll('details')) each.open = true;"
    )
    studio.settle()
    studio.keep(f"german-{where}")
    assert english_on(studio, *NAMES) == [], where


NAMES = (
    *("League of Robot Runners", "multi_agent_path_planning", "floor.yaml", "bay.yaml"),
    *("two-level", "first-come", "-as-printed", "table-"),
    *("floor", "door", "bay"),
)
"""Names of programs, files, planners and rules."""


def test_each_tool_and_each_thing_on_the_map_is_german(german: StudioPage) -> None:
    german.tab("Karte")
    tools = german.page.get_by_role("toolbar").get_by_role("button")
    for tool in tools.all():
        if tool.is_visible() and tool.is_enabled():
            tool.click()
            german.settle()
            assert_german(german, f"tool-{tool.get_attribute('aria-label')}")
    german.page.keyboard.press("Escape")
    german.page.keyboard.press("v")
    german.page.get_by_role("application").focus()
    german.page.keyboard.press("Control+a")
    assert_german(german, "selected")
    german.page.keyboard.press("Escape")
    x, y = german.where((2.25, 2.25))
    german.page.mouse.click(x, y, button="right")
    assert_german(german, "menu")
    german.page.keyboard.press("Escape")


def test_settings_of_all_planners_are_german(german: StudioPage) -> None:
    german.tab("Plan")
    choice = german.page.locator("#planner")
    for name in choice.locator("option").all_text_contents():
        choice.select_option(name)
        german.settle()
        assert_german(german, f"planner-{name}")
        values = [each.input_value() for each in german.page.locator(".options select").all()]
        assert all(values), name  # the default of each choice is shown


@pytest.fixture
def planned_bay(browser: Browser, site: Client) -> Iterator[StudioPage]:
    """Yield a studio in German that shows a plan of three robots and one bay."""
    site.studio.file = "bay.yaml"
    with studio_page(browser, site, locale="de-DE") as page:
        page.opened()
        plan(page)
        assert_german(page, "plan")
        yield page


def test_laps_are_german(planned_bay: StudioPage) -> None:
    page = planned_bay.page
    page.locator(".groups table").first.wait_for()
    assert_german(planned_bay, "movement-groups")
    for rule in page.locator("#rule option").all():
        page.select_option("#rule", rule.get_attribute("value"))
        assert_german(planned_bay, "rule")
    page.select_option("#rule", "first-come")
    planned_bay.button("Umläufe berechnen").click()
    planned_bay.planned()
    page.locator(".parameter").first.wait_for()
    assert_german(planned_bay, "laps")
    page.locator(".parameter [type=range]").first.press("ArrowRight")
    page.locator(".orders tbody tr:last-child[data-known=true]").wait_for()
    assert_german(planned_bay, "slider")


def test_delays_are_german(planned_bay: StudioPage) -> None:
    page = planned_bay.page
    page.fill("#run-count", "20")
    planned_bay.button("Simulieren").click()
    planned_bay.planned()
    planned_bay.button("Schlechtester").click()
    assert_german(planned_bay, "delays")
    for cause in page.get_by_label("Grund der Verspätung").first.locator("option").all():
        page.get_by_label("Grund der Verspätung").first.select_option(cause.get_attribute("value"))
        assert_german(planned_bay, "cause")


def test_a_drive_and_its_live_page_are_german(planned_bay: StudioPage) -> None:
    page = planned_bay.page
    page.fill("#pace", "0.5")
    planned_bay.button("Fahren").click()
    live = page.frame_locator("dialog iframe")
    live.get_by_role("button", name="Alle Roboter halten").click()
    live.get_by_text("ausgeführt").wait_for()
    frame = page.frames[1]
    assert english_on(frame) == []
    live.get_by_role("tab", name="Verlauf").click()
    assert english_on(frame) == []
    page.get_by_role("dialog").get_by_role("button", name="Die Roboter anhalten").click()
    live.get_by_text("die Steuerung ist zu Ende").wait_for()
    assert english_on(frame) == []
    page.get_by_role("dialog").get_by_role("button", name="Schließen").click()
    assert_german(planned_bay, "driven")


def test_a_changed_plan_and_a_comparison_are_german(planned_bay: StudioPage) -> None:
    page = planned_bay.page
    planned_bay.press((0.5, 0.5))  # R1 at its home
    assert_german(planned_bay, "what-if")
    speed = page.locator(".ask").get_by_label("Tempo", exact=True)
    speed.fill("1,5")
    speed.press("Tab")
    planned_bay.shown(2)
    page.locator(".change[aria-busy=false]").first.wait_for()
    assert_german(planned_bay, "changed")
    for row in page.locator("[data-state] [type=checkbox]").all():
        row.check()
    page.locator(".compared-figures").wait_for()
    assert_german(planned_bay, "comparison")
    planned_bay.button("Nebeneinander zeigen").click()
    page.frame_locator("dialog.beside iframe").get_by_role("tab", name="Vergleich").wait_for()
    assert english_on(page.frames[1]) == []


def test_a_plan_its_robots_and_its_waits_are_german(german: StudioPage) -> None:
    plan(german)
    assert_german(german, "plan")
    for robot in german.document["robots"]:
        german.press((robot["home"]["x"], robot["home"]["y"]))  # it is there at time 0
        german.page.get_by_role(
            "heading", name=f"Was wäre, wenn {robot['name']} anders wäre"
        ).wait_for()
        assert_german(german, "robot")
    german.button("Heatmap der Belegung").click()
    german.seek(9)
    german.keep("german-heat")
    assert_german(german, "plan")


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
        assert english_on(german, *NAMES) == []
