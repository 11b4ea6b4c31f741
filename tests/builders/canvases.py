"""What a page draws on its canvases: texts, discs, lines, pictures and colours."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.builders.browsers import Viewer

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

Point = tuple[float, float]

WATCH = (Path(__file__).parent / "drawn.js").read_text(encoding="utf-8")
"""Notes what a page draws, by the browser's own interface of canvases; loaded before the page."""


@dataclass(frozen=True, slots=True)
class Text:
    """A text on a canvas; the box of its ink is left, top, right, bottom [pixels]."""

    text: str
    box: tuple[float, float, float, float]
    at: tuple[float, float]  # the point that it is aligned with
    moves: bool  # not in the picture below that is painted once


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc or a ring on a canvas [pixels]."""

    x: float
    y: float
    radius: float
    colour: str
    is_filled: bool
    is_dashed: bool


@dataclass(frozen=True, slots=True)
class Line:
    """A line on a canvas through some points [pixels]."""

    points: tuple[Point, ...]
    colour: str
    width: float
    opacity: float


@dataclass(frozen=True, slots=True)
class Field:
    """A rectangle with round corners on a canvas: left, top, right, bottom [pixels]."""

    box: tuple[float, float, float, float]
    colour: str
    is_filled: bool


class Canvases(Viewer):
    """A page with canvases; what it draws is noted from its beginning on."""

    def __init__(self, page: Page) -> None:
        super().__init__(page)
        page.add_init_script(WATCH)

    def pixel(self, canvas: str | Locator, x: float, y: float) -> tuple[int, ...]:
        """Return the colour of a pixel of a canvas as red, green, blue and opacity."""
        return tuple(self._seen("colour", canvas, x, y))

    def texts(self, canvas: str | Locator = "map") -> list[Text]:
        """Return the texts that a canvas shows."""
        self.painted()
        return [
            Text(each["text"], tuple(each["box"]), tuple(each["at"]), each["moves"])
            for each in self._seen("texts", canvas)
        ]

    def discs(self, canvas: str | Locator = "map") -> list[Disc]:
        """Return the discs and rings that a canvas shows, those below first."""
        self.painted()
        return [Disc(**each) for each in self._seen("discs", canvas)]

    def lines(self, canvas: str | Locator = "map") -> list[Line]:
        """Return the lines that a canvas shows, outlines of arcs and fields apart."""
        self.painted()
        return [
            Line(**{**each, "points": tuple(map(tuple, each["points"]))})
            for each in self._seen("lines", canvas)
        ]

    def fields(self, canvas: str | Locator = "map") -> list[Field]:
        """Return the rectangles with round corners that a canvas shows."""
        self.painted()
        return [
            Field(**{**each, "box": tuple(each["box"])}) for each in self._seen("fields", canvas)
        ]

    def pictures(self, canvas: str | Locator = "map") -> list[tuple[Point, ...]]:
        """Return where pictures lie: their upper left, upper right and lower left corners."""
        self.painted()
        return [tuple(map(tuple, each)) for each in self._seen("pictures", canvas)]

    def calls(self, canvas: str | Locator | None = None) -> Counter[str]:
        """Return how often the page has drawn on a canvas, or on all, by the name of the method."""
        return Counter(self._seen("calls", canvas))

    def _seen(self, what: str, canvas: str | Locator | None, *more: object) -> Any:
        """Ask what was noted of a canvas: its id, or where it is."""
        if canvas is None or isinstance(canvas, str):
            names = [what, [canvas, *more]]
            return self.page.evaluate("([what, more]) => drawn[what](...more)", names)
        asked = "(canvas, [what, more]) => drawn[what](canvas, ...more)"
        return canvas.evaluate(asked, [what, [*more]])
