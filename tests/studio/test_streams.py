"""The page's side of the API in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from tests.builders.browsers import Viewer, needs_browser
from tests.builders.studios import DOOR, running

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = needs_browser

BEGIN = """async (document) => {
  const { listen, post } = await import("/assets/api.js");
  window.states = {};
  for (let i = 0; i < 10; i++) {
    const run = await post("/runs", { document, planner: "two-level", name: `${i}` });
    listen(run.number, { run: ({ name, state }) => (window.states[name] = state) });
  }
}"""


def test_ten_runs_at_once_are_heard_by_one_connection(browser: Browser, folder: Path) -> None:
    """A browser has six connections to a server; a seventh request would wait for ever."""
    with running(folder, keeps=False) as client:
        context = browser.new_context()
        viewer = Viewer(context.new_page())
        viewer.page.goto(str(client.base_url).removesuffix("api/v1/"))
        viewer.page.evaluate(BEGIN, DOOR)
        viewer.wait_for("Object.values(states).filter((state) => state === 'done').length === 10")
        streams = [url for url in viewer.requests if url.endswith("/events")]
        assert streams
        assert all(url.endswith("/api/v1/events") for url in streams)
        context.close()
