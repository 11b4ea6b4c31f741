"""The page's side of the API in a browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import expect, needs_browser
from tests.builders.drawing import StudioPage, studio_page
from tests.builders.studios import DOOR, Client, planned

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = needs_browser

BEGIN = """async (document) => {
  const { post } = await import("/studio/assets/api.js");
  const { listen } = await import("/studio/assets/events.js");
  window.states = {};
  for (let i = 0; i < 10; i++) {
    const run = await post("/runs", { document, planner: "two-level", name: `${i}` });
    listen(run.number, { run: ({ name, state }) => (window.states[name] = state) });
  }
}"""

ENDED = "Object.values(states).filter((state) => state === 'done').length === 10"


def list_all(studio: StudioPage) -> None:
    """Have the runs of all documents listed, beside a floor that has none."""
    studio.opened()
    studio.tab("Plan")
    studio.page.get_by_label("Plans to list").select_option("*")


def listed(studio: StudioPage, count: int) -> str:
    """Wait until so many runs that are done are listed, and return their names in order."""
    done = studio.page.locator("[data-run][data-state=done]")
    expect(done).to_have_count(count)
    names = done.get_by_label("Name of the plan").all()
    return "".join(sorted(name.input_value() for name in names))


FAILS = """window.SharedWorker = class {
  port = { postMessage() {} };
  constructor() { setTimeout(() => this.onerror()); }
}"""


@pytest.mark.parametrize("script", ["", "delete window.SharedWorker", FAILS])
def test_ten_runs_at_once_are_heard_by_one_connection(
    browser: Browser, empty: Client, script: str
) -> None:
    """A browser has six connections to a server; a seventh request would wait for ever."""
    with studio_page(browser, empty) as studio:
        studio.page.add_init_script(script)
        studio.page.reload()
        studio.page.evaluate(BEGIN, DOOR)
        studio.poll(lambda: studio.page.evaluate(ENDED), "all runs are over")
        streams = [url for url in studio.requests if url.endswith("/events")]
        assert bool(streams) == bool(script)  # a shared worker asks for the others
        assert all(url.endswith("/api/v1/events") for url in streams)


def test_eight_pages_of_a_browser_hear_what_one_of_them_begins_and_deletes(
    browser: Browser, empty: Client
) -> None:
    with studio_page(browser, empty) as first:
        first.button("Create the floor").click()
        first.opened()
        others = [first.page.context.new_page() for _ in range(7)]
        studios = [first, *(StudioPage(page, first.page.url) for page in others)]
        studios[3].page.evaluate(BEGIN, DOOR)
        for studio in studios:
            list_all(studio)
            assert listed(studio, 10) == "0123456789"
        studios[3].page.reload()
        list_all(studios[3])
        for studio in studios:  # no page asks about a run any more when it is deleted
            expect(studio.page.get_by_text("as good as")).to_have_count(9)
        empty.delete(f"/runs/{empty.get('/runs').json()['runs'][0]['number']}")
        for studio in studios:
            assert len(listed(studio, 9)) == 9
            assert studio.complaints == []


def test_a_page_that_is_given_no_stream_lists_what_there_is(
    browser: Browser, empty: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rightofway.studio.events.MAX_LISTENERS", 0)
    planned(empty, name="0")
    with studio_page(browser, empty) as studio:
        studio.button("Create the floor").click()
        list_all(studio)
        assert listed(studio, 1) == "0"
