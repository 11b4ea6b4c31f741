"""A headless Chromium for tests, and what goes wrong on a page.

The browser is the one that ``RIGHTOFWAY_CHROMIUM`` names, or the first of the usual names on the
path. The one that has no window comes first: it takes half of the CPU.
"""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
FOUND = os.environ.get("RIGHTOFWAY_CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), "")
CHROMIUM = FOUND if find_spec("playwright") else ""
"""Path of the browser; empty where there is none, or no Playwright."""

expect: Any = None
"""Playwright's `expect`; None where there is no browser, and its tests are skipped."""

if CHROMIUM:
    from playwright.sync_api import expect

    expect.set_options(timeout=30_000)

needs_browser = pytest.mark.skipif(not CHROMIUM, reason="there is no browser")

PATIENCE = 30.0
"""How long to wait for what comes true in a moment on a machine that does nothing else [s]."""

ARGUMENTS = (
    "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
)  # fmt: skip


FRAMES = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"


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

    def poll(self, holds: Callable[[], object], what: str) -> None:
        """Look again and again whether something holds, until `PATIENCE` is over."""
        ends = time.monotonic() + PATIENCE
        while not holds():
            if time.monotonic() > ends:
                pytest.fail(f"{what} did not come true")
            self.page.wait_for_timeout(20)  # a polling helper

    def painted(self) -> None:
        """Wait until what was done last is painted."""
        self.page.evaluate(FRAMES)

    def text(self, selector: str) -> str:
        """Return the text that stands in an element, once what was done last is painted."""
        self.painted()
        return self.page.inner_text(selector)


@contextmanager
def chromium() -> Iterator[Browser]:
    """Yield a browser; a process has one at a time, so tests share it."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*ARGUMENTS])
        yield browser
        browser.close()
