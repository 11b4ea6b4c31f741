"""The page of a studio as a person uses it: presses and drags at places of the site."""

from __future__ import annotations

import base64
import math
import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote, unquote, urljoin, urlsplit

from tests.builders.canvases import Canvases

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

SOURCES = {"draft": "drafts", "file": "documents", "example": "examples"}
"""Which documents of the API an address of the page names."""

OVER = ":not([data-state=queued], [data-state=running])"
"""A row of a run that is over."""

MOMENT = re.compile("^(Time|Zeit)$")
"""What the slider of time is called."""

DROP = """([files]) => {
  const transfer = new DataTransfer();
  for (const [name, content] of files) {
    const bytes = Uint8Array.from(atob(content), (character) => character.charCodeAt(0));
    transfer.items.add(new File([bytes], name));
  }
  document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true }));
}"""


class StudioPage(Canvases):
    """The page, and a pointer on its map."""

    def __init__(self, page: Page, address: str) -> None:
        super().__init__(page)
        page.goto(address)
        self.ready()

    def button(self, name: str) -> Locator:
        """Return the button of a name; that of the head where there are two."""
        return self.page.get_by_role("button", name=name, exact=True).first

    def tab(self, name: str) -> None:
        """Show a tab."""
        self.page.get_by_role("tab", name=name).click()

    def where(self, place: Point) -> Point:
        """Return where a place of the site is on the page [pixels], as the map says."""
        a, b, c, d, e, f = self.view()
        box = self.page.locator(".holder").bounding_box()
        assert box is not None
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

    def ready(self) -> None:
        """Wait until the page that was loaded has asked all that it asks by itself."""
        self.page.locator("[aria-busy=false]").wait_for(state="attached")

    def reload(self) -> None:
        """Load the page again, and wait until it shows what it has shown before."""
        self.page.reload()
        self.opened()

    def go(self, kind: str, name: str) -> None:
        """Follow a bookmark of a ``file``, ``draft`` or ``example``, and wait until it is there."""
        address = f"{self.page.url.partition('#')[0]}#{kind}={quote(name, safe='')}"
        with self.page.expect_response(f"**/{SOURCES[kind]}/{quote(name)}"):
            self.page.goto(address)
        self.opened()

    def start(self) -> None:
        """Show the start page, whatever the language."""
        self.page.locator(".file button").first.click()
        self.page.locator(".start").wait_for()
        self.ready()

    def draw(self, document: Any, name: str = "drawn") -> None:
        """Draw a document: keep it as a draft, and follow the bookmark of that."""
        self.put(f"drafts/{name}", {"document": document})
        self.go("draft", name)

    def api(self, path: str) -> Any:
        """Return what the API of the studio answers."""
        return self.page.request.get(self._address(path)).json()

    def put(self, path: str, data: Any) -> None:
        """Put something by the API, as another program does."""
        answer = self.page.request.put(self._address(path), data=data)
        assert answer.ok, answer.text()

    def post(self, path: str, data: Any) -> Any:
        """Post something by the API, as another program does."""
        answer = self.page.request.post(self._address(path), data=data)
        assert answer.ok, answer.text()
        return answer.json()

    def _address(self, path: str) -> str:
        return urljoin(self.page.url, f"/api/v1/{path}")

    @property
    def place(self) -> tuple[str, str]:
        """What the address names, and its name: a ``draft`` that is changed, or a ``file``."""
        kind, _, name = unquote(urlsplit(self.page.url).fragment).partition("=")
        return kind, name

    @property
    def document(self) -> Any:
        """The document that is drawn, as the server keeps it once the page has settled."""
        self.settle()
        kind, name = self.place
        found = self.api(f"{SOURCES[kind]}/{quote(name)}")
        if "run" in found:  # a plan: what it was made from
            found = self.api(f"runs/{found['run']['number']}/document")
        return found["document"]

    @property
    def runs(self) -> list[Any]:
        """All runs of the studio, the latest first."""
        return list(self.api("runs")["runs"])

    def run(self, number: int) -> Any:
        """Return a run."""
        return self.api(f"runs/{number}")

    def planned(self) -> None:
        """Wait until the run that was begun last is over, and its plan shown with all waits."""
        self.settle()
        self.shown(self.runs[0]["number"])

    def shown(self, number: int) -> None:
        """Wait until the list of plans marks a run that is over as the one that is shown."""
        row = self.page.locator(f"[data-run='{number}']{OVER} [aria-pressed=true]")
        row.wait_for()
        self.settle()

    def failed(self, number: int) -> None:
        """Wait until a run is over, and the page knows it."""
        self.page.locator(f"[data-run='{number}']{OVER}").wait_for()
        self.settle()

    def row(self, number: int) -> Locator:
        """Return what the list of plans says of a run."""
        return self.page.locator(f"[data-run='{number}']")

    def chosen(self, robot: str) -> Locator:
        """Return what asks about a robot of the plan, while that robot is chosen."""
        return self.page.get_by_role("region", name=f"What if {robot} were different")

    def is_plan(self) -> bool:
        """Return whether a plan is shown, which can be played."""
        return self.page.get_by_role("slider", name=MOMENT).is_visible()

    def moment(self) -> float:
        """Return the moment that is shown [ticks]."""
        return float(self.page.get_by_role("slider", name=MOMENT).input_value())

    def seek(self, tick: float) -> None:
        """Go to a moment [ticks]."""
        self.page.get_by_role("slider", name=MOMENT).fill(str(tick))
        self.settle()

    def lit(self) -> list[str]:
        """Return the names of the places that are lit on the map."""
        self.settle()
        said = self.page.locator(".holder").get_attribute("data-lit") or ""
        return [name for name in said.split(", ") if name]

    def view(self) -> list[float]:
        """Return how the map is shown: six numbers that lead from the site to pixels."""
        said = self.page.locator(".holder").get_attribute("data-view")
        assert said is not None, "the map is not painted yet"
        return [float(number) for number in said.split()]

    @property
    def scale(self) -> float:
        """How large a unit of length of the site is on the map [pixels]."""
        return math.hypot(*self.view()[:2])


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


USED: tuple[Any, ...] = (
    "button", "link", "textbox", "checkbox", "combobox", "slider", "spinbutton", "tab",
)  # fmt: skip
"""Roles of what can be used."""


def nameless(within: Page | Locator) -> list[str]:
    """Return what can be used and has no name for a screen reader."""
    found = [within.get_by_role(role, name=re.compile("^$")) for role in USED]
    return [str(each.evaluate("(it) => it.outerHTML")) for kind in found for each in kind.all()]
