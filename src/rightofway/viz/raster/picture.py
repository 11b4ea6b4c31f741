"""A plan as one picture, for papers and slides."""

from __future__ import annotations

import io
import os

from PIL import Image

from rightofway.errors import InputError
from rightofway.files import write_whole
from rightofway.model import Plan
from rightofway.viz.palette import LIGHT, Theme
from rightofway.viz.raster.diagram import Diagram
from rightofway.viz.raster.ground import draw_ground
from rightofway.viz.raster.pen import Pen
from rightofway.viz.raster.robots import draw_robots
from rightofway.viz.raster.scene import Scene

__all__ = ["draw_picture", "write_png"]

MARGIN = 24
FINENESS = 3
PLEASANT_WIDTH = 1400
LEAST_DIAGRAM_WIDTH = 720
MOST_PIXELS = 60_000_000


def write_png(
    plan: Plan,
    path: str | os.PathLike[str],
    tick: int | None = None,
    *,
    scale: float | None = None,
    diagram: bool = False,
    theme: Theme = LIGHT,
) -> None:
    """Write a picture of a plan: the map with homes, stops, faint routes and the robots.

    Parameters
    ----------
    plan
        The plan.
    path
        Where, usually ``….png``; the file is there whole or not at all.
    tick
        The instant to show [ticks]. None shows the robots at home, and no instant in the diagram.
    scale
        Pixels for a cell. None chooses so that the picture is about as wide as a page.
    diagram
        Whether to draw the space-time diagram below.
    theme
        Colours of everything but the robots.

    Raises
    ------
    InputError
        For a tick below 0, a scale that makes the picture empty or too large to draw, or a file
        that cannot be written.
    """
    if tick is not None and tick < 0:
        raise InputError.at("tick", f"{tick} is negative (give 0 or more)")
    content = io.BytesIO()
    scene = Scene(plan=plan, theme=theme)
    draw_picture(scene, tick, scale=scale, diagram=diagram).save(content, "png", optimize=True)
    write_whole(path, content.getvalue())


def draw_picture(
    scene: Scene, tick: int | None, *, scale: float | None, diagram: bool
) -> Image.Image:
    """Return the picture that `write_png` writes."""
    scale = fitting_scale(scene, PLEASANT_WIDTH, 110) if scale is None else scale
    map_size = map_size_of(scene, scale)
    below = Diagram(scene) if diagram else None
    width = max(map_size[0], LEAST_DIAGRAM_WIDTH if below else 0)
    height = map_size[1] + (round(below.height) if below else 0)
    image = blank(scene, (width, height), FINENESS)
    left = (width - map_size[0]) / 2 + MARGIN + scale / 2
    pen = Pen(image, origin=(left, MARGIN + scale / 2), scale=scale, fineness=FINENESS)
    draw_ground(pen, scene, routes=True)
    draw_robots(pen, scene, tick or 0)
    if below:
        below.draw(Pen(image, origin=(0, map_size[1]), scale=1, fineness=FINENESS), width, tick)
    return image.reduce(FINENESS)


def fitting_scale(scene: Scene, width: int, largest: float) -> float:
    """Return the pixels for a cell that make a picture of about this width."""
    return min(max((width - 2 * MARGIN) / max(scene.plane.width, scene.plane.height), 2), largest)


def map_size_of(scene: Scene, scale: float) -> tuple[int, int]:
    """Return the size of the map with its margins [pixels]."""
    plane = scene.plane
    return round(plane.width * scale) + 2 * MARGIN, round(plane.height * scale) + 2 * MARGIN


def blank(scene: Scene, size: tuple[int, int], fineness: int) -> Image.Image:
    """Return an empty picture.

    Raises
    ------
    InputError
        If it would have no pixel, or too many.
    """
    width, height = size
    pixels = width * height
    if min(size) <= 2 * MARGIN or pixels > MOST_PIXELS:
        limits = f"(choose a scale that makes 1 to {MOST_PIXELS} pixels)"
        raise InputError.at("scale", f"makes a picture of {width} by {height} pixels {limits}")
    return Image.new("RGB", (width * fineness, height * fineness), scene.theme.paper)
