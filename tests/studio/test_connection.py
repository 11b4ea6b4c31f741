"""The page while the studio is away: what is drawn is saved as soon as it is back."""

from __future__ import annotations

import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from tests.builders.browsers import expect, needs_browser
from tests.builders.crowds import CROWD
from tests.builders.drawing import StudioPage
from tests.builders.studios import Client, Command, command

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Route

pytestmark = needs_browser

EXAMPLES = Path(__file__).parents[2] / "examples"
LANGUAGES = {
    "en-GB": ("No connection to the studio.", "Not saved", "Unknown: no connection to the studio."),
    "de-DE": ("Keine Verbindung zum Studio.", "Nicht gespeichert",
              "Unbekannt: keine Verbindung zum Studio."),
}  # fmt: skip


@contextmanager
def process_page(browser: Browser, studio: Command, **settings: Any) -> Iterator[StudioPage]:
    """Yield the page of a studio that is a process, at a door."""
    address = str(studio.client.base_url).removesuffix("api/v1/")
    context = browser.new_context(reduced_motion="reduce", **settings)
    page = StudioPage(context.new_page(), f"{address}#file=door.yaml")
    page.opened()
    yield page
    context.close()


def write_work(studio: StudioPage, work: str) -> None:
    """Write the work of the first robot into the table."""
    field = studio.page.locator("table.robots tr[data-row='0'] td.work input")
    field.fill(work)
    field.press("Enter")


def port_of(studio: Command) -> str:
    """Return the port of a studio."""
    return str(studio.client.base_url.port)


@pytest.mark.parametrize("locale", LANGUAGES)
def test_what_is_drawn_while_the_studio_is_away_is_saved_when_it_is_back(
    browser: Browser, tmp_path: Path, locale: str
) -> None:
    lost, unsaved, _ = LANGUAGES[locale]
    shutil.copy(EXAMPLES / "door.yaml", tmp_path)
    with command(tmp_path) as first, process_page(browser, first, locale=locale) as studio:
        port, alert = port_of(first), studio.page.get_by_role("banner").get_by_role("alert")
        studio.page.locator("#tab-robots").click()
        write_work(studio, "5")
        studio.settle()
        first.end(signal.SIGKILL)
        write_work(studio, "77")
        expect(alert).to_contain_text(f"{unsaved}. {lost}")
        write_work(studio, "78")
        expect(alert).to_contain_text(lost)
        assert "fetch" not in studio.page.locator("body").inner_text().lower()
        with command(tmp_path, "--port", port) as second:
            expect(alert).to_have_count(0)
            kept = second.client.get("/drafts/door.yaml").json()["document"]
            assert kept["robots"][0]["work"] == 78
            studio.reload()
            assert studio.document["robots"][0]["work"] == 78


@pytest.mark.parametrize("keeps", [True, False])
def test_a_studio_that_starts_without_the_draft_gets_it_again(
    browser: Browser, tmp_path: Path, *, keeps: bool
) -> None:
    shutil.copy(EXAMPLES / "door.yaml", tmp_path)
    options = [] if keeps else ["--no-history"]
    with command(tmp_path, *options) as first, process_page(browser, first) as studio:
        port = port_of(first)
        studio.page.locator("#tab-robots").click()
        write_work(studio, "5")
        studio.settle()
        first.end(signal.SIGKILL)
        write_work(studio, "6")
        expect(studio.page.get_by_role("alert")).to_have_count(1)
        with command(tmp_path, "--port", port, *options) as second:
            expect(studio.page.get_by_role("alert")).to_have_count(0)
            kept = second.client.get("/drafts/door.yaml").json()["document"]
            assert kept["robots"][0]["work"] == 6


@pytest.mark.parametrize("locale", LANGUAGES)
def test_a_run_that_went_down_with_the_studio_is_not_shown_as_running(
    browser: Browser, tmp_path: Path, locale: str
) -> None:
    lost, _, unknown = LANGUAGES[locale]
    shutil.copy(EXAMPLES / "door.yaml", tmp_path)
    with command(tmp_path) as first, process_page(browser, first, locale=locale) as studio:
        first.client.put("/drafts/crowd", json={"document": CROWD})
        studio.go("draft", "crowd")
        studio.page.locator("#tab-plan").click()
        studio.page.fill("#limit", "60")
        studio.page.locator("#panel button[type=submit].strong").click()
        row = studio.page.locator("tr[data-run='1']")
        expect(row).to_have_attribute("data-state", "running")
        port = port_of(first)
        first.end(signal.SIGKILL)
        expect(studio.page.get_by_role("banner").get_by_role("alert")).to_contain_text(lost)
        expect(row).to_contain_text(unknown)
        expect(studio.page.locator(".curve figcaption")).to_contain_text(unknown)
        with command(tmp_path, "--port", port):
            expect(row).to_have_attribute("data-state", "interrupted")
            expect(studio.page.get_by_role("alert")).to_have_count(0)


@pytest.mark.parametrize("status", [500, 502, 507])
def test_a_draft_that_is_refused_is_not_saved_until_it_is(
    studio: StudioPage, site: Client, status: int
) -> None:
    """A disk that is full, a proxy without a server behind it, a fault of the studio."""
    studio.go("file", "door.yaml")
    refusal = {"status": status, "kind": "refused", "message": "there is no room", "faults": []}

    def refuse(route: Route) -> None:
        if status == 502:
            route.fulfill(status=status, body="<html>Bad Gateway</html>")
        else:
            route.fulfill(status=status, json={"error": refusal})

    studio.page.route("**/drafts/*", refuse)
    studio.tab("Robots")
    write_work(studio, "9")
    alert = studio.page.get_by_role("banner").get_by_role("alert")
    expect(alert).to_contain_text("Not saved")
    studio.page.get_by_title("All files, drafts and examples").click()
    expect(studio.page.locator(".notice")).to_contain_text("stay on this page")
    studio.page.unroute("**/drafts/*")
    expect(alert).to_have_count(0)
    assert site.get("/drafts/door.yaml").json()["document"]["robots"][0]["work"] == 9


def test_a_draft_that_was_kept_while_its_answer_was_lost_is_of_this_page(
    studio: StudioPage, site: Client
) -> None:
    studio.go("file", "door.yaml")

    def lose_answer(route: Route) -> None:
        route.fetch()
        route.abort()

    studio.page.route("**/drafts/*", lose_answer, times=1)
    studio.tab("Robots")
    write_work(studio, "9")
    expect(studio.page.get_by_role("banner").get_by_role("alert")).to_contain_text("Not saved")
    expect(studio.page.get_by_role("alert")).to_have_count(0)
    write_work(studio, "10")
    studio.settle()
    assert site.get("/drafts/door.yaml").json()["document"]["robots"][0]["work"] == 10
