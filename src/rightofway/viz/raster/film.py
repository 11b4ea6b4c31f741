"""A plan as a film that every browser, chat and slide plays: an animated GIF, kept small."""

from __future__ import annotations

import io
import os
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from PIL import Image

from rightofway.errors import InputError
from rightofway.files import write_whole
from rightofway.model import Plan
from rightofway.viz.palette import LIGHT, Theme
from rightofway.viz.raster.ground import draw_ground
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.picture import MARGIN, blank, fitting_scale, map_size_of
from rightofway.viz.raster.robots import draw_robots
from rightofway.viz.raster.scene import Scene

__all__ = ["Film", "write_gif"]

FINENESS = 2
PLEASANT_WIDTH = 800
FRAME_MILLISECONDS = 50
LAST_MILLISECONDS = 1500
FRAMES_PER_TICK = 8
"""At most: more cannot be told apart."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Film:
    """How a film was cut, to be told to whoever asked for it.

    Attributes
    ----------
    frames
        How many pictures it has.
    ticks_per_frame
        How far apart in the plan they are [ticks].
    seconds
        How long it plays [s].
    """

    frames: int
    ticks_per_frame: Fraction
    seconds: float


def write_gif(
    plan: Plan,
    path: str | os.PathLike[str],
    *,
    max_frames: int = 240,
    scale: float | None = None,
    theme: Theme = LIGHT,
) -> Film:
    """Write a plan as an animated GIF.

    Parameters
    ----------
    plan
        The plan.
    path
        Where, usually ``….gif``; the file is there whole or not at all.
    max_frames
        The most pictures. A long plan plays faster instead of becoming a large file.
    scale
        Pixels for a cell. None chooses so that the film is as wide as a column of text.
    theme
        Colours of everything but the robots.

    Returns
    -------
    Film
        How many pictures were made, and how far apart.

    Raises
    ------
    InputError
        For fewer than two frames, a scale that makes pictures empty or too large to draw, or a file
        that cannot be written.
    """
    if max_frames <= 1:
        raise InputError.at("max_frames", f"{max_frames} is less than a film (give 2 or more)")
    scene = Scene(plan=plan, theme=theme)
    frames = min(FRAMES_PER_TICK * scene.end + 1, max_frames)
    step = Fraction(scene.end, frames - 1)
    pictures = _Studio(scene, scale).pictures([float(frame * step) for frame in range(frames)])
    durations = [FRAME_MILLISECONDS] * (frames - 1) + [LAST_MILLISECONDS]
    write_whole(path, _gif(pictures, durations))
    return Film(frames=frames, ticks_per_frame=step, seconds=sum(durations) / 1000)


def _gif(pictures: Iterator[Image.Image], durations: list[int]) -> bytes:
    content = io.BytesIO()
    first = next(pictures)
    first.save(
        content,
        "gif",
        save_all=True,
        append_images=pictures,
        duration=durations,
        loop=0,
        optimize=True,  # what has not changed since the last picture becomes transparent
    )
    return content.getvalue()


class _Studio:
    """Draws the pictures of a film: what does not move once, robots on a copy of it."""

    def __init__(self, scene: Scene, scale: float | None) -> None:
        self.scene = scene
        self.scale = fitting_scale(scene, PLEASANT_WIDTH, 64) if scale is None else scale
        self.ground = blank(scene, map_size_of(scene, self.scale), FINENESS)
        draw_ground(self._pen(self.ground), scene, routes=False)

    def pictures(self, ticks: list[float]) -> Iterator[Image.Image]:
        """Yield a picture for each instant, all in one palette of 255 colours."""
        middle = self._picture(ticks[len(ticks) // 2])
        palette = middle.quantize(255, Image.Quantize.MEDIANCUT)
        for tick in ticks:
            yield self._picture(tick).quantize(palette=palette, dither=Image.Dither.NONE)

    def _picture(self, tick: float) -> Image.Image:
        image = self.ground.copy()
        draw_robots(self._pen(image), self.scene, tick)
        return image.reduce(FINENESS)

    def _pen(self, image: Image.Image) -> Pen:
        origin = MARGIN + self.scale / 2
        return Pen(image, origin=(origin, origin), scale=self.scale, fineness=FINENESS)
