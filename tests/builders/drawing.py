"""The page of a studio as a person uses it: presses and drags at places of the site."""

from __future__ import annotations

import base64
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.builders.browsers import Viewer

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page

    from tests.builders.studios import Client

PICTURES = os.environ.get("RIGHTOFWAY_PICTURES", "")
"""A folder that pictures of the page are written to, for the documentation; empty for none."""

BROWSER: dict[str, Any] = {
    "locale": "en-GB",
    "reduced_motion": "reduce",
    "viewport": {"width": 1280, "height": 760},
}
"""A small window in English."""

Point = tuple[float, float]

DROP = """([files]) => {
  const transfer = new DataTransfer();
  for (const [name, content] of files) {
    const bytes = Uint8Array.from(atob(content), (character) => character.charCodeAt(0));
    transfer.items.add(new File([bytes], name));
  }
  document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true }));
}"""


class StudioPage(Viewer):
    """The page, and a pointer on its map."""

    def __init__(self, page: Page, address: str) -> None:
        super().__init__(page)
        page.goto(address)
        self.wait_for("Boolean(window.studio?.about.version)")

    def button(self, name: str) -> Locator:
        """Return the button of a name; that of the head where there are two."""
        return self.page.get_by_role("button", name=name, exact=True).first

    def tab(self, name: str) -> None:
        """Show a tab."""
        self.page.get_by_role("tab", name=name).click()

    def where(self, place: Point) -> Point:
        """Return where a place of the site is on the page [pixels], as the map says."""
        holder = self.page.locator(".holder")
        view, box = holder.get_attribute("data-view"), holder.bounding_box()
        assert view is not None
        assert box is not None
        a, b, c, d, e, f = map(float, view.split())
        x, y = place
        return box["x"] + a * x + c * y + e, box["y"] + b * x + d * y + f

    def press(self, place: Point, *keys: str) -> None:
        """Press at a place of the site, perhaps with keys held."""
        for key in keys:
            self.page.keyboard.down(key)
        self.page.mouse.click(*self.where(place))
        for key in keys:
            self.page.keyboard.up(key)
        self.settle()

    def drop(self, *files: Path) -> None:
        """Drop files onto the page."""
        given = [[file.name, base64.b64encode(file.read_bytes()).decode()] for file in files]
        self.page.evaluate(DROP, [given])

    def drag(self, start: Point, end: Point) -> None:
        """Drag from a place of the site to another one."""
        mouse = self.page.mouse
        mouse.move(*self.where(start))
        mouse.down()
        mouse.move(*self.where(end), steps=6)
        mouse.up()
        self.settle()

    def settle(self) -> None:
        """Wait until nothing is under way: what is drawn was looked at, kept and painted."""
        self.page.locator("[aria-busy=false] #map").wait_for(state="attached")
        self.page.locator(".change[aria-busy=true]").wait_for(state="detached")

    def opened(self) -> None:
        """Wait until a document is on the screen."""
        self.page.get_by_role("application").wait_for()
        self.settle()

    def saved(self) -> None:
        """Wait until the document is saved as a file."""
        self.page.get_by_role("banner").get_by_role("status").get_by_text("Saved").wait_for()
        self.settle()

    def keep(self, name: str) -> None:
        """Write a picture of the page, where pictures are wanted."""
        if PICTURES:
            self.page.screenshot(path=Path(PICTURES, f"{name}.png"))

    @property
    def document(self) -> Any:
        """The document that is drawn."""
        return self.ask("studio.store.document")

    def planned(self) -> None:
        """Wait until the run that was begun last is over, and its plan shown with all waits."""
        self.wait_for(
            "studio.runs.runs.length && !studio.runs.running && studio.runs.losses !== null"
        )


@contextmanager
def studio_page(browser: Browser, client: Client, **more: Any) -> Iterator[StudioPage]:
    """Yield the page of a studio, in a browser of its own.

    Parameters
    ----------
    browser, client
        The browser, and a client of the studio.
    more
        Options of the browser, instead of those of `BROWSER`.
    """
    context = browser.new_context(**{**BROWSER, **more})
    context.grant_permissions(["clipboard-read", "clipboard-write"], origin=client.address)
    yield StudioPage(context.new_page(), client.address)
    context.close()


Opener = Callable[[str], StudioPage]
"""What opens a scenario in a studio of its own."""


def begin(studio: StudioPage, *, seconds: float = 1, planner: str = "auto") -> None:
    """Fill the form, which is folded once there is a plan, and begin a run."""
    # A press on the summary could come just when the page unfolds the form by itself.
    studio.page.locator(".settings > details").evaluate("(details) => (details.open = true)")
    studio.page.select_option("#planner", planner)
    studio.page.fill("#limit", str(seconds))
    studio.page.locator(".settings [type=submit]").click()
