"""Things on a map beyond the graph: stations, parking places, the picture below.

No plan depends on it, and roadmaps that differ in it alone are equal.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

from rightofway.site.geometry import Point, VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A picture of the site, and where it lies.

    Attributes
    ----------
    file
        The file, in a format that Pillow reads.
    pixel
        Side of a pixel [length unit], above 0; None where the picture is as wide as the map.
    corner
        The upper left corner of the picture in the site's frame [length unit].
    origin
        Its lower left corner, instead of the upper one; without both, that of the map.
    yaw
        Angle by which the picture is turned about that corner, from the site's x to its y [rad].
    opacity
        From 0 to 1; None for the default of a page.
    name
        The file as a scenario names it; empty for the picture of a layout, which a plan file does
        not name.
    """

    file: Path
    pixel: Fraction | None = None
    corner: Point | None = None
    origin: Point | None = None
    yaw: Fraction = Fraction(0)
    opacity: Fraction | None = None
    name: str = ""

    def scale(self, metre: Fraction) -> Picture:
        """Return a picture in metres in another unit; ``metre`` is a metre in it."""
        return replace(
            self,
            pixel=self.pixel and self.pixel * metre,
            corner=self.corner and (self.corner[0] * metre, self.corner[1] * metre),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """Things on a map beyond the graph.

    Attributes
    ----------
    stations
        Names of places to work at, each with its vertex.
    parking, charging
        Vertices to park at, and to charge at.
    curves
        Tail and head of each edge that is one curve, with the points between them in the site's
        frame [length unit].
    controls
        Tail and head of each edge that the scenario draws as a Bézier curve, with its control
        points between the ends in the site's frame [length unit].
    headings
        Vertices at which robots work in a heading, with it: angle from the site's x axis to its y
        axis [degrees].
    orientations
        Tail and head of each edge along which robots drive in an orientation, with the angle from
        the direction of driving, turned as a heading [degrees]; 180 for backwards.
    edge_ids
        Tail and head of each edge that has an id in orders, with the id.
    turning
        Tail and head of each edge for which it is known whether robots may turn along it, with it.
    picture
        The picture that lies below the map.
    """

    stations: tuple[tuple[str, VertexId], ...] = ()
    parking: tuple[VertexId, ...] = ()
    charging: tuple[VertexId, ...] = ()
    curves: tuple[tuple[VertexId, VertexId, tuple[Point, ...]], ...] = ()
    controls: tuple[tuple[VertexId, VertexId, tuple[Point, ...]], ...] = ()
    headings: tuple[tuple[VertexId, Fraction], ...] = ()
    orientations: tuple[tuple[VertexId, VertexId, Fraction], ...] = ()
    edge_ids: tuple[tuple[VertexId, VertexId, str], ...] = ()
    turning: tuple[tuple[VertexId, VertexId, bool], ...] = ()
    picture: Picture | None = None
