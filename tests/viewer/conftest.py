"""Opens pages in a headless Chromium.

The browser is the one that ``RIGHTOFWAY_CHROMIUM`` names, or the first of the usual names on the
path. Where there is none, or no Playwright, these tests are not collected.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from rightofway.errors import NoPlanExists
from rightofway.model import ExecutionTrace, Plan, SteadyState
from rightofway.viz import Background, write_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

NAMES = ("chromium", "chromium-browser", "google-chrome")
CHROMIUM = os.environ.get("RIGHTOFWAY_CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), "")

collect_ignore_glob = [] if CHROMIUM and find_spec("playwright") else ["test_*.py"]

PATIENCE = 500
"""How often to look, 20 ms apart."""

ARGUMENTS = (
    "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
)  # fmt: skip


class Viewer:
    """A page that plays a plan, and what went wrong in it.

    Attributes
    ----------
    page
        The page.
    complaints
        Messages on the console and uncaught errors.
    requests
        Addresses that the page asked for, itself apart.
    """

    def __init__(self, page: Page) -> None:
        self.page = page
        self.complaints: list[str] = []
        self.requests: list[str] = []
        page.on("console", lambda message: self.complaints.append(message.text))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda request: self.requests.append(request.url))

    def ask(self, expression: str) -> Any:
        """Return the value of a JavaScript expression; the page's own names are in scope."""
        return self.page.evaluate(expression)

    def wait_for(self, expression: str) -> None:
        """Wait until an expression holds; the page's policy forbids it to watch itself."""
        for _ in range(PATIENCE):
            if self.ask(expression):
                return
            self.page.wait_for_timeout(20)
        pytest.fail(f"{expression} did not come true")

    def text(self, selector: str) -> str:
        """Return the text that stands in an element."""
        return self.page.inner_text(selector)


Opener = Callable[..., Viewer]


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*ARGUMENTS])
        yield browser
        browser.close()


@contextmanager
def pages(browser: Browser, directory: Path) -> Iterator[Opener]:
    """Yield a function that opens the page of a plan, still unless ``reduced_motion`` says no."""
    contexts = []

    def open_page(
        plan: Plan,
        fragment: str = "",
        *,
        steady: Sequence[SteadyState] = (),
        actual: ExecutionTrace | None = None,
        no_plan: NoPlanExists | None = None,
        background: Background | None = None,
        title: str = "",
        other: tuple[Plan, str] | None = None,
        **context: Any,
    ) -> Viewer:
        path = directory / "plan.html"
        write_page(
            plan,
            path,
            steady=steady,
            actual=actual,
            no_plan=no_plan,
            background=background,
            title=title,
            other=other,
        )
        contexts.append(browser.new_context(**{"reduced_motion": "reduce", **context}))
        viewer = Viewer(contexts[-1].new_page())
        viewer.page.goto(f"{path.as_uri()}{fragment}")
        viewer.wait_for("frames.count > 0")
        viewer.requests = [url for url in viewer.requests if not url.startswith(path.as_uri())]
        return viewer

    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture
def show(browser: Browser, tmp_path: Path) -> Iterator[Opener]:
    with pages(browser, tmp_path) as open_page:
        yield open_page


PIXEL = """([canvas, x, y]) => {
  const ratio = Math.min(devicePixelRatio, 2);
  return Array.from(document.getElementById(canvas).getContext("2d")
    .getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data);
}"""


def pixel(viewer: Viewer, canvas: str, x: float, y: float) -> list[int]:
    """Return a colour as red, green, blue, opacity."""
    found: list[int] = viewer.page.evaluate(PIXEL, [canvas, x, y])
    return found
