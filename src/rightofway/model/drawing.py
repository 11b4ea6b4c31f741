"""What people see on a map beyond the graph: stations, parking places, the picture below.

No plan depends on it, and roadmaps that differ in it alone are equal.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from rightofway.model.geometry import Point
from rightofway.model.units import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A picture of the site, and where it lies.

    Attributes
    ----------
    file
        The file, in a format that Pillow reads.
    pixel
        Side of a pixel [length unit], above 0.
    corner
        The upper left corner of the picture in the site's frame [length unit].
    yaw
        Angle by which the picture is turned about that corner, from the site's x to its y [rad].
    """

    file: Path
    pixel: Fraction
    corner: Point
    yaw: Fraction = Fraction(0)

    def scaled(self, metre: Fraction) -> Picture:
        """Return a picture in metres in another unit; ``metre`` is a metre in it."""
        x, y = self.corner
        corner = x * metre, y * metre
        return Picture(file=self.file, pixel=self.pixel * metre, corner=corner, yaw=self.yaw)


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """What people see on a map beyond the graph.

    Attributes
    ----------
    stations
        Names of places to work at, each with its vertex.
    parking, charging
        Vertices to park at, and to charge at.
    curves
        Tail and head of each edge that is one curve, with the points between them in the site's
        frame [length unit].
    picture
        The picture that lies below the map.
    """

    stations: tuple[tuple[str, VertexId], ...] = ()
    parking: tuple[VertexId, ...] = ()
    charging: tuple[VertexId, ...] = ()
    curves: tuple[tuple[VertexId, VertexId, tuple[Point, ...]], ...] = ()
    picture: Picture | None = None
