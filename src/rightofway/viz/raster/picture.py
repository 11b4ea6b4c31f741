"""A plan as one picture for papers and slides, and as a film that every browser and chat plays."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from PIL import Image

from rightofway.errors import InputError
from rightofway.files import write_whole
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import allow_none, make_range, make_whole
from rightofway.model import Plan
from rightofway.viz.palette import LIGHT, Theme
from rightofway.viz.raster.canvas import Pen, Scene
from rightofway.viz.raster.faults import FaultList
from rightofway.viz.raster.map import draw_ground, draw_robots
from rightofway.viz.raster.sizes import compute_sizes

MARGIN = 24
MOST_PIXELS = 60_000_000

PICTURE_WIDTH, LARGEST_CELL, PICTURE_FINENESS = 1400, 110, 3

FILM_WIDTH, LARGEST_FILM_CELL, FILM_FINENESS = 800, 64, 2
FRAME_MILLISECONDS, LAST_MILLISECONDS = 50, 1500
FRAMES_PER_TICK = 8
"""The most frames: more cannot be distinguished."""


def make_png(
    plan: Plan,
    tick: int | None = None,
    *,
    scale: float | None = None,
    theme: Theme = LIGHT,
) -> bytes:
    """Return a picture of a plan as PNG: the map with homes, stops, faint routes and the robots.

    Below the map of a faulty plan stand its faults, and their robots have a red ring.

    Parameters
    ----------
    plan
        The plan.
    tick
        The instant to show [ticks]. None shows the robots at home.
    scale
        Pixels for a cell. None chooses so that the picture is about as wide as a page.
    theme
        Colours of everything but the robots.

    Raises
    ------
    InputError
        For a tick below 0, or a scale that makes the picture empty or too large to draw.
    """
    tick = allow_none(make_whole(0)).read_at("tick", tick)
    _refuse_scale(scale)
    scene, fineness = Scene(plan, theme), PICTURE_FINENESS
    if scale is None:
        scale = _choose_scale(scene, PICTURE_WIDTH, LARGEST_CELL)
    width, height = _map_size(scene, scale)
    faults = FaultList(scene, width)
    image = _make_blank(scene, (width, height + round(faults.height)), fineness)
    first = _measure_margin(scene, scale) + scale / 2
    pen = Pen(image, origin=(first, first), scale=scale, fineness=fineness)
    sizes = compute_sizes(scene, scale)
    draw_ground(pen, scene, sizes, routes=True)
    draw_robots(pen, scene, sizes, tick or 0)
    faults.draw(Pen(image, origin=(0, height), scale=1, fineness=fineness))
    content = io.BytesIO()
    image.reduce(fineness).save(content, "png", optimize=True)
    return content.getvalue()


@checks_arguments
def write_png(
    plan: Plan,
    path: str | os.PathLike[str],
    tick: int | None = None,
    *,
    scale: float | None = None,
    theme: Theme = LIGHT,
) -> None:
    """Write a picture of a plan: the map with homes, stops, faint routes and the robots.

    Parameters
    ----------
    plan, tick, scale, theme
        As for `make_png`.
    path
        Where, usually ``….png``; the file is complete, or not written.

    Raises
    ------
    InputError
        As for `make_png`, or if the file cannot be written.
    """
    write_whole(path, make_png(plan, tick, scale=scale, theme=theme))


@dataclass(frozen=True, slots=True, kw_only=True)
class Film:
    """The number of pictures and the speed of a film.

    Attributes
    ----------
    frames
        Number of pictures.
    ticks_per_frame
        Time in the plan between two pictures [ticks].
    seconds
        Duration [s].
    """

    frames: int
    ticks_per_frame: Fraction
    seconds: float


@checks_arguments
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
    plan, theme
        As for `make_png`.
    path
        Where, usually ``….gif``; the file is complete, or not written.
    max_frames
        The most pictures. A long plan plays faster instead of becoming a large file.
    scale
        Pixels for a cell. None chooses so that the film is as wide as a column of text.

    Returns
    -------
    Film
        The number of pictures, and the time between them.

    Raises
    ------
    InputError
        For fewer than two frames, a scale that makes pictures empty or too large to draw, or a file
        that cannot be written.
    """
    max_frames = make_whole(2).read_at("max_frames", max_frames)
    _refuse_scale(scale)
    scene = Scene(plan, theme)
    frames = min(FRAMES_PER_TICK * scene.end + 1, max_frames)
    step = Fraction(scene.end, frames - 1)
    scale = _choose_scale(scene, FILM_WIDTH, LARGEST_FILM_CELL) if scale is None else scale
    pictures = _draw_pictures(scene, scale, [float(frame * step) for frame in range(frames)])
    durations = [FRAME_MILLISECONDS] * (frames - 1) + [LAST_MILLISECONDS]
    content = io.BytesIO()
    next(pictures).save(
        content,
        "gif",
        save_all=True,
        append_images=pictures,
        duration=durations,
        loop=0,
        optimize=True,  # what has not changed since the last picture becomes transparent
    )
    write_whole(path, content.getvalue())
    return Film(frames=frames, ticks_per_frame=step, seconds=sum(durations) / 1000)


def _draw_pictures(scene: Scene, scale: float, ticks: Sequence[float]) -> Iterator[Image.Image]:
    """Yield a picture for each instant, all in one palette of 255 colours."""
    margin = _measure_margin(scene, scale)
    origin = (margin + scale / 2, margin + scale / 2)
    ground = _make_blank(scene, _map_size(scene, scale), FILM_FINENESS)
    pen = Pen(ground, origin=origin, scale=scale, fineness=FILM_FINENESS)
    sizes = compute_sizes(scene, scale)
    draw_ground(pen, scene, sizes, routes=False)

    def picture(tick: float) -> Image.Image:
        image = ground.copy()
        pen = Pen(image, origin=origin, scale=scale, fineness=FILM_FINENESS)
        draw_robots(pen, scene, sizes, tick)
        return image.reduce(FILM_FINENESS)

    palette = picture(ticks[len(ticks) // 2]).quantize(255, Image.Quantize.MEDIANCUT)
    for tick in ticks:
        yield picture(tick).quantize(palette=palette, dither=Image.Dither.NONE)


def _refuse_scale(scale: float | None) -> None:
    if scale is not None:
        make_range(0, MOST_PIXELS).read_at("scale", scale)


def _choose_scale(scene: Scene, width: int, largest: float) -> float:
    """Return the pixels for a cell that make a picture of about this width."""
    return min(max((width - 2 * MARGIN) / max(scene.plane.width, scene.plane.height), 2), largest)


def _map_size(scene: Scene, scale: float) -> tuple[int, int]:
    """Return the size of the map with its margins [pixels]."""
    plane, margins = scene.plane, 2 * _measure_margin(scene, scale)
    return round(plane.width * scale) + margins, round(plane.height * scale) + margins


def _measure_margin(scene: Scene, scale: float) -> int:
    """Return the margin of a map: robots at its border may reach beyond it [pixels]."""
    largest = max(float(robot.radius) for robot in scene.plan.scenario.robots)
    return MARGIN + max(math.ceil((largest / scene.plane.unit - 0.5) * scale), 0)


def _make_blank(scene: Scene, size: tuple[int, int], fineness: int) -> Image.Image:
    """Return an empty picture, `fineness` times as large; one without a pixel is refused."""
    width, height = size
    if min(size) <= 2 * MARGIN or width * height > MOST_PIXELS:
        limits = f"(choose a scale that makes 1 to {MOST_PIXELS} pixels)"
        raise InputError.at("scale", f"makes a picture of {width} by {height} pixels {limits}")
    return Image.new("RGB", (width * fineness, height * fineness), scene.theme.paper)
