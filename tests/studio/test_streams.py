"""The page's side of the API in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.builders.browsers import Viewer, needs_browser
from tests.builders.studios import DOOR, running

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = needs_browser

BEGIN = """async (document) => {
  const { post } = await import("/assets/api.js");
  const { listen } = await import("/assets/events.js");
  window.states = {};
  for (let i = 0; i < 10; i++) {
    const run = await post("/runs", { document, planner: "two-level", name: `${i}` });
    listen(run.number, { run: ({ name, state }) => (window.states[name] = state) });
  }
}"""

ENDED = "Object.values(states).filter((state) => state === 'done').length === 10"
LISTED = "studio.runs.runs.filter(({ state }) => state === 'done').map(({ name }) => name).sort()"


@pytest.mark.parametrize("script", ["", "delete window.SharedWorker"])
def test_ten_runs_at_once_are_heard_by_one_connection(
    browser: Browser, tmp_path: Path, script: str
) -> None:
    """A browser has six connections to a server; a seventh request would wait for ever."""
    with running(tmp_path, keeps=False) as client:
        context = browser.new_context()
        context.add_init_script(script)
        viewer = Viewer(context.new_page())
        viewer.page.goto(str(client.base_url).removesuffix("api/v1/"))
        viewer.page.evaluate(BEGIN, DOOR)
        viewer.wait_for(ENDED)
        streams = [url for url in viewer.requests if url.endswith("/events")]
        assert all(url.endswith("/api/v1/events") for url in streams)
        assert bool(streams) == bool(script)  # a shared worker asks for the others
        context.close()


def test_eight_pages_of_a_browser_hear_what_one_of_them_begins_and_deletes(
    browser: Browser, tmp_path: Path
) -> None:
    with running(tmp_path, keeps=False) as client:
        context = browser.new_context()
        viewers = [Viewer(context.new_page()) for _ in range(8)]
        for viewer in viewers:
            viewer.page.goto(str(client.base_url).removesuffix("api/v1/"))
            viewer.wait_for("Boolean(window.studio?.about.version)")
        viewers[3].page.evaluate(BEGIN, DOOR)
        for viewer in viewers:
            viewer.wait_for(f"{LISTED}.join('') === '0123456789'")
        viewers[3].page.reload()
        client.delete(f"/runs/{client.get('/runs').json()['runs'][0]['number']}")
        for viewer in viewers:
            viewer.wait_for(f"window.studio?.about.version && {LISTED}.length === 9")
            assert viewer.complaints == []
        context.close()
