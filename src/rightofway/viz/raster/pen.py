"""Draws smooth shapes in units of the map: large first, then made smaller."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from PIL import Image, ImageDraw, ImageFont

__all__ = ["Pen", "Point"]

Point = tuple[float, float]


class Pen:
    """A drawing in its own units.

    Parameters
    ----------
    image
        What to draw on, ``fineness`` times as large as the picture will be.
    origin
        Where the point (0, 0) is [pixels of the picture].
    scale
        Pixels of the picture in a unit.
    fineness
        How much larger ``image`` is than the picture.
    """

    def __init__(self, image: Image.Image, *, origin: Point, scale: float, fineness: int) -> None:
        self.draw = ImageDraw.Draw(image)
        self.origin = origin
        self.scale = scale
        self.fineness = fineness

    def pixels(self, length: float) -> float:
        """Return a length in pixels of the picture, in units."""
        return length / self.scale

    def line(self, points: Sequence[Point], colour: str, width: float) -> None:
        """Draw a line through points."""
        self.draw.line([self._at(point) for point in points], colour, self._thick(width), "curve")

    def box(self, corner: Point, opposite: Point, colour: str) -> None:
        """Fill a rectangle; boxes that share a side neither overlap nor leave a gap."""
        x0, y0, x1, y1 = map(round, (*self._at(corner), *self._at(opposite)))
        self.draw.rectangle((x0, y0, max(x1 - 1, x0), max(y1 - 1, y0)), colour)

    def disc(self, middle: Point, radius: float, colour: str) -> None:
        """Fill a circle."""
        self.draw.ellipse(self._around(middle, radius), colour)

    def ring(self, middle: Point, radius: float, colour: str, width: float) -> None:
        """Draw a circle; the line lies inside the radius."""
        self.draw.ellipse(self._around(middle, radius), None, colour, self._thick(width))

    def arc(
        self, middle: Point, radius: float, turns: tuple[float, float], colour: str, width: float
    ) -> None:
        """Draw a part of a circle, clockwise from the top [turns]; the line lies inside."""
        begin, end = (360 * turn - 90 for turn in turns)
        self.draw.arc(self._around(middle, radius), begin, end, colour, self._thick(width))

    def field(self, middle: Point, side: float, colour: str) -> None:
        """Fill a square with round corners."""
        corner = side * 0.16 * self.scale * self.fineness
        self.draw.rounded_rectangle(self._around(middle, side / 2), corner, colour)

    def frame(self, middle: Point, side: float, colour: str, width: float) -> None:
        """Draw a square with round corners; the line lies inside."""
        corner = side * 0.16 * self.scale * self.fineness
        around, thick = self._around(middle, side / 2), self._thick(width)
        self.draw.rounded_rectangle(around, corner, None, colour, thick)

    def diamond(self, middle: Point, radius: float, colour: str) -> None:
        """Fill a square that stands on a corner."""
        x, y = middle
        corners = [(x, y - radius), (x + radius, y), (x, y + radius), (x - radius, y)]
        self.draw.polygon([self._at(corner) for corner in corners], colour)

    def text(self, at: Point, text: str, colour: str, *, size: float, anchor: str) -> None:
        """Write; ``size`` in pixels of the picture, ``anchor`` as in Pillow."""
        text = text.encode("utf-8", "replace").decode()  # a lone surrogate cannot be drawn
        self.draw.text(self._at(at), text, colour, self._font(size), anchor)

    def text_width(self, text: str, size: float) -> float:
        """Return how wide a text is, in units."""
        return self.draw.textlength(text, self._font(size)) / self.fineness / self.scale

    def _at(self, point: Point) -> Point:
        (x, y), (left, top) = point, self.origin
        return (left + x * self.scale) * self.fineness, (top + y * self.scale) * self.fineness

    def _around(self, middle: Point, radius: float) -> tuple[float, float, float, float]:
        x, y = middle
        return (*self._at((x - radius, y - radius)), *self._at((x + radius, y + radius)))

    def _thick(self, width: float) -> int:
        return max(round(width * self.scale * self.fineness), 1)

    def _font(self, size: float) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
        return _font(round(size * self.fineness))


@cache
def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)
