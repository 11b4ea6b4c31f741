"""Subject and pen of a drawing: a site or a plan prepared for drawing, and a pen over an image."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from rightofway.kinds.table import make_class
from rightofway.model import Plan
from rightofway.site import Roadmap
from rightofway.viz.motion import end_of, make_trips
from rightofway.viz.page.schema import PlaceData
from rightofway.viz.palette import Theme, choose_colours, mix
from rightofway.viz.placement import lay_out_roadmap
from rightofway.viz.verdict import give_verdict

Point = tuple[float, float]

SMALL_CELL = 13
"""Below this size of a cell [pixels] robots fill more of it, and homes and stops are faint."""

CORNER = 0.16
"""Radius of a square's round corners, as a share of its side."""


class Ground:
    """A roadmap prepared for drawing."""

    def __init__(self, roadmap: Roadmap, theme: Theme) -> None:
        roadmap = roadmap.fold()
        self.roadmap, self.theme = roadmap, theme
        self.plane = lay_out_roadmap(roadmap)
        self.points: list[Point] = [(x, y) for x, y in self.plane.points.tolist()]
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        self.edges = list(zip(tails.tolist(), roadmap.heads.tolist(), strict=True))
        self.ground = theme.floor if roadmap.has_cells else theme.paper

    def fade(self, colour: str, share: float) -> str:
        """Return a colour as it looks when it covers only a share of the ground."""
        return mix(self.ground, colour, share)


class Scene(Ground):
    """A plan prepared for drawing; from its tick `end` on nothing happens any more."""

    def __init__(self, plan: Plan, theme: Theme) -> None:
        make_class(Theme).read_at("theme", theme)
        super().__init__(plan.scenario.roadmap, theme)
        self.plan = plan
        self.trips = make_trips(plan)
        self.colours = choose_colours(len(self.trips))
        self.end = max(end_of(self.trips), 1)
        self.verdict = give_verdict(plan)
        self.faulty = sorted({robot for fault in self.verdict.faults for robot in fault.robots})


class Pen:
    """A drawing in its own units: ``scale`` pixels of the picture each, from the pixel ``origin``.

    The image is ``fineness`` times as large as the picture: a smooth picture is drawn large, then
    reduced.
    """

    def __init__(self, image: Image.Image, *, origin: Point, scale: float, fineness: int) -> None:
        self.image, self.draw = image, ImageDraw.Draw(image)
        self.origin = origin
        self.scale = scale
        self.fineness = fineness
        self.hairline = 1 / scale  # a pixel of the picture [units]
        self.is_small = scale < SMALL_CELL

    def draw_line(self, points: Sequence[Point], colour: str, width: float) -> None:
        """Draw a line through points."""
        self.draw.line(
            [self._locate(point) for point in points], colour, self._measure_thick(width), "curve"
        )

    def fill_box(self, corner: Point, opposite: Point, colour: str) -> None:
        """Fill a rectangle; boxes that share a side neither overlap nor leave a gap."""
        x0, y0, x1, y1 = map(round, (*self._locate(corner), *self._locate(opposite)))
        self.draw.rectangle((x0, y0, max(x1 - 1, x0), max(y1 - 1, y0)), colour)

    def draw_picture(self, picture: Image.Image, place: PlaceData, opacity: float) -> None:
        """Lay a picture over the drawing; ``place`` as `place_of` returns it."""
        scale, turn = self.scale * self.fineness, place.get("turn", 0.0)
        left, top = self._locate((place["x"], place["y"]))
        fine = picture.width / place["width"] / scale  # pixels of the picture for one of the image
        if fine >= 2:  # noqa: PLR2004 - else every second pixel would be left out
            picture = picture.convert("RGBA").reduce(int(fine))
            fine = picture.width / place["width"] / scale
        filtered = Image.Resampling.BILINEAR if fine > 1 else Image.Resampling.NEAREST
        cos, sin = fine * math.cos(turn), fine * math.sin(turn)
        back = (cos, sin, -cos * left - sin * top, -sin, cos, sin * left - cos * top)
        laid = picture.convert("RGBA").transform(
            self.image.size, Image.Transform.AFFINE, back, filtered
        )
        cover = laid.getchannel("A").point([round(opacity * level) for level in range(256)])
        self.image.paste(laid.convert("RGB"), (0, 0), cover)

    def fill_disc(self, middle: Point, radius: float, colour: str) -> None:
        """Fill a circle; one that an outline around it leaves no radius is not drawn."""
        if radius > 0:
            self.draw.ellipse(self._make_box(middle, radius), colour)

    def draw_ring(
        self, middle: Point, radius: float, turns: tuple[float, float], colour: str, width: float
    ) -> None:
        """Draw a part of a circle, clockwise from the top [turns]; the line lies inside."""
        begin, end = (360 * turn - 90 for turn in turns)
        self.draw.arc(
            self._make_box(middle, radius), begin, end, colour, self._measure_thick(width)
        )

    def draw_square(
        self,
        middle: Point,
        side: float,
        fill: str | None,
        edge: str | None = None,
        width: float = 0,
    ) -> None:
        """Draw a square with round corners; the line of its edge lies inside."""
        corner = side * CORNER * self.scale * self.fineness
        thick = self._measure_thick(width) if edge else 0
        self.draw.rounded_rectangle(self._make_box(middle, side / 2), corner, fill, edge, thick)

    def fill_polygon(self, points: Sequence[Point], colour: str) -> None:
        """Fill a polygon."""
        self.draw.polygon([self._locate(point) for point in points], colour)

    def write_text(self, at: Point, text: str, colour: str, *, size: float) -> None:
        """Write a line from its left middle on; ``size`` in pixels of the picture."""
        text = text.encode("utf-8", "replace").decode()  # a lone surrogate cannot be drawn
        font = _load_font(round(size * self.fineness))
        self.draw.text(self._locate(at), text, colour, font, "lm")

    def measure_text(self, text: str, size: float) -> float:
        """Return how wide a text is [units]."""
        font = _load_font(round(size * self.fineness))
        return self.draw.textlength(text, font) / self.fineness / self.scale

    def _locate(self, point: Point) -> Point:
        (x, y), (left, top) = point, self.origin
        return (left + x * self.scale) * self.fineness, (top + y * self.scale) * self.fineness

    def _make_box(self, middle: Point, radius: float) -> tuple[float, float, float, float]:
        x, y = middle
        return (*self._locate((x - radius, y - radius)), *self._locate((x + radius, y + radius)))

    def _measure_thick(self, width: float) -> int:
        return max(round(width * self.scale * self.fineness), 1)


@cache
def _load_font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)
