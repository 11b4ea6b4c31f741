"""The page of a plan as a person uses it: what it says, and what it draws on its canvases."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from tests.builders.browsers import Viewer
from tests.builders.canvases import Canvases, Point, Text

if TYPE_CHECKING:
    from playwright.sync_api import Locator


class Player(Canvases):
    """A page that plays a plan."""

    @property
    def slider(self) -> Locator:
        """The slider of time."""
        return self.page.get_by_role("slider")

    @property
    def tick(self) -> float:
        """The moment shown."""
        self.painted()
        return float(self.slider.input_value())

    @property
    def end(self) -> float:
        """The last moment that can be shown."""
        return float(self.slider.get_attribute("max") or "nan")

    def seek(self, tick: float) -> None:
        """Show a moment, as one who moves the slider."""
        self.slider.fill(str(tick))
        self.painted()

    def press(self, *keys: str) -> None:
        """Press keys one after the other."""
        for key in keys:
            self.page.keyboard.press(key)
        self.painted()

    @property
    def chosen(self) -> str | None:
        """What the card is about; None where nothing is chosen."""
        card = self.page.locator("#card")
        return card.get_by_role("heading").first.inner_text() if card.is_visible() else None

    def is_pressed(self, name: str) -> bool:
        """Return whether a button that stays pressed is so."""
        button = self.page.get_by_role("button", name=name, exact=True)
        return button.get_attribute("aria-pressed") == "true"

    def robot(self, name: str) -> Locator:
        """Return a robot's row in the list."""
        return self.page.locator("#robot-list").get_by_role("option").filter(has_text=name)

    def box(self, place: str | Locator = "#map") -> dict[str, float]:
        """Return where an element is on the page [pixels]."""
        found = self.page.locator(place) if isinstance(place, str) else place
        box = found.bounding_box()
        assert box is not None
        return {"x": box["x"], "y": box["y"], "width": box["width"], "height": box["height"]}

    @property
    def view(self) -> tuple[float, ...]:
        """How places of the site are shown, see `data-view` in ``map_view.js``."""
        self.painted()
        view = self.page.locator("section.map").first.get_attribute("data-view")
        assert view is not None
        return tuple(map(float, view.split()))

    def on_map(self, place: Point) -> Point:
        """Return where a place of the site [length unit] is on the map [pixels]."""
        return self.all_on_map([place])[0]

    def all_on_map(self, places: Iterable[Sequence[float]]) -> list[Point]:
        """Return where places of the site [length unit] are on the map [pixels]."""
        a, b, c, d, e, f = self.view
        return [(a * x + c * y + e, b * x + d * y + f) for x, y in places]

    def on_site(self, spot: Point) -> Point:
        """Return the place of the site [length unit] that is at a spot of the map [pixels]."""
        a, b, c, d, e, f = self.view
        x, y = spot[0] - e, spot[1] - f
        unit = a * d - b * c
        return (d * x - c * y) / unit, (a * y - b * x) / unit

    def at(self, place: Point) -> Point:
        """Return where a place of the site [length unit] is on the page [pixels]."""
        (x, y), box = self.on_map(place), self.box()
        return box["x"] + x, box["y"] + y

    def colour(self, place: Point) -> tuple[int, ...]:
        """Return the colour of a pixel of the map as red, green, blue and opacity."""
        return self.pixel("map", *place)

    def diagram_x(self, time: float, diagram: str | Locator = "diagram") -> float:
        """Return where a time is in a diagram [pixels], by the times written below it."""
        written = [each for each in self.texts(diagram) if re.match(r"^[0-9.]+$", each.text)]
        (first, *_, last) = sorted(written, key=lambda each: each.at[0])
        share = (time - float(first.text)) / (float(last.text) - float(first.text))
        return first.at[0] + share * (last.at[0] - first.at[0])

    def diagram_y(self, name: str) -> float:
        """Return the height of a place or a robot in the diagram [pixels], by its name there."""
        (found,) = {each.at[1] for each in self.texts("diagram") if each.text == name}
        return found - 0.5  # names stand half a pixel below the middle of their rows

    def names(self) -> list[Text]:
        """Return the names on the map."""
        return [each for each in self.texts() if each.moves]

    def is_as_wide_as(self, width: int) -> bool:
        """Return whether nothing has to be scrolled to the side in a window of this width."""
        return self.size[0] == width

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of all of the page, what has to be scrolled included [pixels]."""
        html = self.page.locator("html")
        found: list[int] = html.evaluate("(it) => [it.scrollWidth, it.scrollHeight]")
        return found[0], found[1]

    def lay_on_paper(self) -> None:
        """Get the page ready for paper, as a browser does before it prints."""
        self.page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
        self.page.emulate_media(media="print")

    def take_from_paper(self) -> None:
        """Show the page on the screen again."""
        self.page.emulate_media(media="screen")
        self.page.evaluate("() => dispatchEvent(new Event('afterprint'))")
        self.painted()


def nameless_on(viewer: Viewer) -> list[str]:
    """Return the controls of a page, hidden ones too, that have no name for who cannot see it."""
    found: list[str] = viewer.page.locator(
        "button, input, select, canvas, [role=listbox]"
    ).evaluate_all(
        "(controls) => controls"
        ".filter((it) => !(it.ariaLabel || it.textContent.trim() || it.labels?.length))"
        ".map((it) => it.id)"
    )
    return found


def overlap(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    """Return whether two boxes (left, top, right, bottom) share more than an edge."""
    return (
        min(one[2], other[2]) - max(one[0], other[0]) > 0.01
        and min(one[3], other[3]) - max(one[1], other[1]) > 0.01
    )
