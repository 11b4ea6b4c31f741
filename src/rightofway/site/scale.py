"""How large a site is, and sizes that only another unit explains: metres that are millimetres.

The thresholds are far outside of sites and robots that were seen: samples and benchmark maps are
from 0.4 m to 250 m wide.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from rightofway.phrases import Phrase
from rightofway.quantities import Units, format_decimal
from rightofway.site.roadmap import Roadmap

LARGEST, SMALLEST = 5000, Fraction(1, 10)
"""Sites are not wider, and not smaller both ways [m]."""

WIDEST = 20
"""Robots have no larger radius [m]."""

LONGITUDES, LATITUDES = 180, 90
"""Coordinates in degrees are within these, both ways."""

FINER: dict[str, str] = {"m": "mm", "cm": "mm", "mm": "µm"}
COARSER: dict[str, str] = {"m": "km", "cm": "m", "mm": "m"}
"""Units that lengths may be in where they are far too large, or too small."""


def compute_extent(roadmap: Roadmap) -> tuple[Fraction, Fraction]:
    """Return how wide and high a roadmap is; cells reach beyond their middles [length unit]."""
    if roadmap.grid is not None:
        grid = roadmap.grid
        return grid.columns * grid.cell_size, grid.rows * grid.cell_size
    reach = 0.0 if roadmap.sides is None else np.asarray(roadmap.sides)[:, None] / 2
    spans = (roadmap.positions + reach).max(axis=0) - (roadmap.positions - reach).min(axis=0)
    width, height = (Fraction(repr(span)) for span in spans.tolist())
    return width, height


def find_odd_sizes(
    roadmap: Roadmap, units: Units, largest_radius: Fraction
) -> Iterator[tuple[Phrase, Phrase]]:
    """Yield sizes that no site or robot has in their unit, each with the unit that would fit.

    Nothing is known of sites whose lengths have no unit.
    """
    if units.metres is None or units.length is None:
        return
    own, extent = units.length, compute_extent(roadmap)
    most, length = max(extent), units.format_length
    size = Phrase("{width} x {height}", width=format_decimal(extent[0]), height=length(extent[1]))
    unit = ""
    if most * units.metres > LARGEST:
        unit = FINER[own]
    elif 0 < most * units.metres < SMALLEST:
        unit = Phrase("degrees") if _is_geographic(roadmap, most) else COARSER[own]
    if unit:
        yield (
            Phrase("The site is {size} large", size=size),
            Phrase("if its numbers are {unit}, convert them to {own}", unit=unit, own=own),
        )
    radius = largest_radius
    if radius * units.metres > WIDEST or (not unit and 2 * radius > most > 0):
        yield (
            Phrase("A robot has a radius of {radius}", radius=length(radius)),
            Phrase(
                "if it is {number} {unit}, convert it to {own}",
                number=format_decimal(radius),
                unit=FINER[own],
                own=own,
            ),
        )


def _is_geographic(roadmap: Roadmap, extent: Fraction) -> bool:
    """Whether coordinates may be degrees: in their range, and much larger than the site."""
    x, y = map(abs, roadmap.get_point(0))
    return x <= LONGITUDES and y <= LATITUDES and max(x, y) > 100 * extent
