"""The page of the studio in a browser: open, plan, watch; nothing from elsewhere or inline."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.studios import running
from tests.viewer.conftest import ARGUMENTS, CHROMIUM, Viewer

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.skipif(not CHROMIUM, reason="there is no browser")


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    playwright_api = pytest.importorskip("playwright.sync_api")
    with playwright_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*ARGUMENTS])
        yield browser
        browser.close()


@pytest.fixture
def studio(browser: Browser, folder: Path) -> Iterator[Viewer]:
    """Return the page of a studio that opens a door."""
    with running(folder, file="door.yaml", keeps=False) as client:
        context = browser.new_context(locale="en-GB", reduced_motion="reduce")
        viewer = Viewer(context.new_page())
        viewer.page.goto(str(client.base_url).removesuffix("api/v1/"))
        viewer.wait_for("Boolean(window.stage?.view)")
        yield viewer
        context.close()


def test_a_file_is_opened_planned_and_played(studio: Viewer) -> None:
    page = studio.page
    assert studio.ask("stage.plan.robots.map(({ name }) => name)") == ["R1", "R2"]
    page.fill("input[type=number]", "1")
    page.get_by_role("button", name="Plan", exact=True).click()
    page.get_by_text("done").wait_for()
    studio.wait_for("stage.plan.end > 5")
    assert "time units" in studio.text(".curve")
    page.get_by_role("button", name="Play or pause").click()
    studio.wait_for("stage.clock.tick > 0")
    assert studio.complaints == []


def test_another_file_is_opened_from_the_list(studio: Viewer) -> None:
    studio.page.get_by_role("button", name="bay.yaml").click()
    studio.wait_for("stage.plan.robots.length === 3")


def test_faults_of_a_file_are_listed_with_their_places(studio: Viewer, folder: Path) -> None:
    (folder / "wrong.yaml").write_text(
        "format: rightofway-scenario/1\nmap: {grid: ['...']}\nrobots: [{name: R1, home: N9}]\n"
    )
    studio.page.reload()
    studio.page.get_by_role("button", name="wrong.yaml").click()
    listed = studio.page.get_by_role("alert")
    listed.wait_for()
    assert "robots[0] (R1): home" in listed.inner_text()


def test_a_plan_opens_in_a_page_of_its_own(studio: Viewer) -> None:
    page = studio.page
    page.fill("input[type=number]", "1")
    page.get_by_role("button", name="Plan", exact=True).click()
    with page.context.expect_page() as opened:
        page.get_by_role("link", name="Open the plan").first.click()
    played = Viewer(opened.value)
    played.wait_for("frames.count > 0")
    assert played.ask("origin") == "null"  # its scripts cannot use the API


def test_everything_is_the_studios_own(studio: Viewer) -> None:
    base = studio.ask("location.origin")
    assert [url for url in studio.requests if not url.startswith((base, "data:"))] == []
    studio.ask("document.body.append(Object.assign(document.createElement('script'),"
               " { textContent: 'window.injected = true' }))")  # fmt: skip
    assert studio.ask("window.injected") is None


def test_the_page_speaks_german_to_a_german_browser(browser: Browser, folder: Path) -> None:
    with running(folder, keeps=False) as client:
        context = browser.new_context(locale="de-DE")
        page = context.new_page()
        page.goto(str(client.base_url).removesuffix("api/v1/"))
        page.get_by_text("Zum Anfangen eine Datei öffnen.").wait_for()
        assert page.locator("html").get_attribute("lang") == "de"
        context.close()
