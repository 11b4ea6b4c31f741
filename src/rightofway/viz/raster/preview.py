"""A site as a small picture, for lists of files: its ground, and where robots live and work."""

from __future__ import annotations

import io

from PIL import Image

from rightofway.errors import InputError
from rightofway.metrics import Site
from rightofway.viz.palette import LIGHT, Theme, choose_colours
from rightofway.viz.raster.canvas import Ground, Pen
from rightofway.viz.raster.map import draw_roadmap
from rightofway.viz.raster.sizes import LaneSizes

SIZE = (320, 180)
MARGIN = 12
FINENESS = 2

LARGEST_UNIT = 40
"""A cell of a small grid need not be larger to be recognized [pixels]."""

THIN = 16
"""Lanes are as wide as at this scale, at most [pixels for a unit]."""

MOST_EDGES = 400_000
"""Of roadmaps that are drawn within a second."""

MOST_TRIPS = 12
"""Robots whose trips are drawn as lines, too."""


def make_preview(site: Site, *, theme: Theme = LIGHT) -> bytes:
    """Return a small picture of a site as PNG: cells or lanes, homes, stops and stations.

    Parameters
    ----------
    site
        The site.
    theme
        Colours of everything but the robots.

    Raises
    ------
    InputError
        For a site that is too large to be drawn at once.
    """
    edges = site.roadmap.n_edges
    if edges > MOST_EDGES:
        raise InputError.at("", f"{edges} edges are too many for a preview (open the file)")
    ground = Ground(site.roadmap, theme)
    (width, height), plane = SIZE, ground.plane
    scale = min((width - 2 * MARGIN) / plane.width, (height - 2 * MARGIN) / plane.height)
    scale = min(scale, LARGEST_UNIT)
    left, top = ((width - plane.width * scale) / 2, (height - plane.height * scale) / 2)
    image = Image.new("RGB", (width * FINENESS, height * FINENESS), theme.paper)
    origin = (left + scale / 2, top + scale / 2)
    pen = Pen(image, origin=origin, scale=scale, fineness=FINENESS)
    is_grid = site.roadmap.grid is not None
    draw_roadmap(pen, ground, LaneSizes.at(min(scale, THIN), is_grid=is_grid))
    _draw_places(pen, ground, site)
    content = io.BytesIO()
    image.quantize(128).save(content, "png", optimize=True)
    return content.getvalue()


def _draw_places(pen: Pen, ground: Ground, site: Site) -> None:
    """Draw stations as diamonds and homes as discs; of few robots with a line between them."""
    least = 3.5 if len(site.robots) <= MOST_TRIPS else 2.5
    radius = min(max(pen.scale * 0.36, least), 8) * pen.hairline
    colours = choose_colours(len(site.robots))
    trips = [
        (colour, ground.points[robot.home], [ground.points[stop.at] for stop in robot.stops])
        for colour, robot in zip(colours, site.robots, strict=True)
    ]
    for colour, home, stops in trips if len(trips) <= MOST_TRIPS else ():
        pen.draw_line([home, *stops], ground.fade(colour, 0.35), 1.25 * pen.hairline)
    ink = ground.theme.muted
    marks = [*((ink, ground.points[at]) for at in site.stations.values())]
    marks += [(colour, stop) for colour, _, stops in trips for stop in stops]
    for colour, (x, y) in marks:
        reach = 0.85 * radius
        corners = [(x, y - reach), (x + reach, y), (x, y + reach), (x - reach, y)]
        pen.fill_polygon(corners, colour)
    for colour, home, _ in trips:
        pen.fill_disc(home, radius + pen.hairline, ground.ground)
        pen.fill_disc(home, radius, colour)
