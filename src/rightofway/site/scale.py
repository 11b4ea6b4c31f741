"""How large a site is, and sizes that only another unit explains: metres that are millimetres.

The thresholds are far outside of sites and robots that were seen: samples and benchmark maps are
from 0.4 m to 250 m wide.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Protocol

import numpy as np

from rightofway.facts import Fact
from rightofway.site.roadmap import Roadmap
from rightofway.units import Units

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


class Measured(Protocol):
    """A scenario or a site: a roadmap with units."""

    @property
    def roadmap(self) -> Roadmap:
        """The roadmap."""

    @property
    def units(self) -> Units:
        """Units of its lengths."""


def find_odd_sizes(measured: Measured, largest_radius: Fraction) -> Iterator[tuple[Fact, Fact]]:
    """Yield sizes that no site or robot has in their unit, each with the unit that would fit.

    Nothing is known of sites whose lengths have no unit.
    """
    roadmap, units = measured.roadmap, measured.units
    if units.metres is None or units.length is None:
        return
    own, extent = units.length, compute_extent(roadmap)
    most = max(extent)
    unit: str | Fact | None = None
    if most * units.metres > LARGEST:
        unit = FINER[own]
    elif 0 < most * units.metres < SMALLEST:
        unit = Fact("degrees") if _is_geographic(roadmap, most) else COARSER[own]
    if unit:
        size = Fact("extent", width=extent[0], height=extent[1])
        yield (
            Fact("size of site", measured, size=size),
            Fact("convert the numbers", unit=unit, own=own),
        )
    radius = largest_radius
    if radius * units.metres > WIDEST or (not unit and 2 * radius > most > 0):
        yield (
            Fact("size of robot", measured, radius=radius),
            Fact("convert the radius", number=radius, unit=FINER[own], own=own),
        )


def _is_geographic(roadmap: Roadmap, extent: Fraction) -> bool:
    """Whether coordinates may be degrees: in their range, and much larger than the site."""
    x, y = map(abs, roadmap.get_point(0))
    return x <= LONGITUDES and y <= LATITUDES and max(x, y) > 100 * extent
