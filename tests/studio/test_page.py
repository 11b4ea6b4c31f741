"""The page of the studio in a browser: open, plan, ask; nothing from elsewhere, nothing inline."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING
from urllib.parse import urljoin

import pytest

from tests.builders.browsers import Viewer, needs_browser
from tests.builders.drawing import StudioPage, nameless, studio_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.builders.studios import Client

pytestmark = needs_browser


@pytest.fixture
def studio(browser: Browser, site: Client) -> Iterator[StudioPage]:
    """Return the page of a studio that opens a door."""
    site.studio.file = "door.yaml"
    with studio_page(browser, site) as studio:
        studio.opened()
        yield studio


def plan(studio: StudioPage, seconds: str = "1") -> None:
    """Plan what is shown."""
    studio.tab("Plan")
    studio.page.fill("#limit", seconds)
    studio.button("Plan").click()
    studio.planned()


def test_a_file_is_opened_planned_and_played(studio: StudioPage) -> None:
    assert [robot["name"] for robot in studio.document["robots"]] == ["R1", "R2"]
    studio.page.get_by_role("application", name="Map with 2 robots").wait_for()
    plan(studio)
    assert "19 time units" in studio.text(".curve")
    studio.button("Play").click()
    studio.poll(studio.moment, "time goes on")
    assert studio.complaints == []


def test_another_file_is_opened_from_the_list(studio: StudioPage) -> None:
    studio.button("Files").click()
    studio.page.get_by_role("button", name="bay.yaml").click()
    studio.page.get_by_role("application", name="Map with 3 robots").wait_for()


def test_faults_of_a_file_stand_in_the_list_and_at_the_field(
    studio: StudioPage, site: Client
) -> None:
    (site.folder / "wrong.yaml").write_text(
        "format: rightofway-scenario/1\nmap: {grid: ['...']}\nrobots: [{name: R1, home: N9}]\n"
    )
    studio.button("Files").click()
    studio.page.get_by_role("button", name="wrong.yaml").click()
    fault = studio.page.locator(".findings").get_by_text("R1: home")
    fault.click()
    field = studio.page.get_by_label("Home, R1")
    field.and_(studio.page.locator("[aria-invalid=true]")).wait_for()
    assert "outside the map" in (field.get_attribute("title") or "")


def test_a_wait_is_explained_and_the_right_of_way_flipped(studio: StudioPage) -> None:
    plan(studio)
    waits = studio.page.locator(".waits")
    assert "At time 0, R1 waits 1 time unit in N0 for R2 to leave N1." in waits.inner_text()
    studio.button("Let R1 go first").click()
    studio.page.locator(".change").get_by_text("was 19 time units").wait_for()


def test_a_change_is_planned_at_once_and_compared(studio: StudioPage) -> None:
    plan(studio)
    studio.page.get_by_label("Plan again at each change").check()
    studio.tab("Robots")
    speed = studio.page.get_by_label("Speed, R1")
    speed.fill("2")
    speed.press("Enter")
    studio.page.locator(".status .change").get_by_text("Earlier: R1").wait_for()


def test_a_plan_opens_in_a_page_of_its_own(studio: StudioPage) -> None:
    plan(studio)
    played = Viewer(studio.page.context.new_page())
    played.page.goto(urljoin(studio.page.url, "/api/v1/runs/1/page"))
    played.page.get_by_role("slider", name="Time").wait_for()
    assert played.page.evaluate("origin") == "null"  # its scripts cannot use the API


def test_the_command_line_of_a_plan_is_shown(studio: StudioPage) -> None:
    plan(studio)
    command = studio.page.locator(".command code")
    command.wait_for(state="attached")
    studio.page.locator(".exports summary").click()
    assert command.inner_text().startswith("rightofway plan door.yaml --planner auto")


INJECT = """() => document.body.append(
  Object.assign(document.createElement("script"), { textContent: "window.injected = true" }))"""


def test_everything_is_the_studios_own(studio: StudioPage) -> None:
    base = urljoin(studio.page.url, "/")
    assert [url for url in studio.requests if not url.startswith((base, "data:"))] == []
    studio.page.evaluate(INJECT)
    assert studio.page.evaluate("window.injected") is None


def test_the_page_speaks_german_to_a_german_browser_and_english_on_request(
    browser: Browser, site: Client
) -> None:
    with studio_page(browser, site, locale="de-DE") as studio:
        page = studio.page
        page.get_by_text("Neuer Grundriss").wait_for()
        assert page.locator("html").get_attribute("lang") == "de"
        page.get_by_label("Sprache").select_option("en")
        page.get_by_text("New floor").wait_for()


def test_every_button_and_field_has_a_name(studio: StudioPage) -> None:
    plan(studio)
    for tab in ("Map", "Robots", "Plan"):
        studio.tab(tab)
        assert nameless(studio.page) == []
