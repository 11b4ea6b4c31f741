"""A picture under the map: a floor plan, or the map that a robot has recorded."""

from __future__ import annotations

import base64
import io
import os
from dataclasses import dataclass
from fractions import Fraction
from math import cos, sin
from pathlib import Path
from typing import TYPE_CHECKING, cast

from rightofway.errors import InputError
from rightofway.kinds.table import (
    COORDINATE,
    PATH,
    POSITION,
    POSITIVE,
    SHARE,
    allow_none,
    make_class,
)
from rightofway.site import Roadmap
from rightofway.site.drawing import Picture
from rightofway.viz.page.schema import BackgroundData, PlaceData
from rightofway.viz.placement import lay_out_roadmap

if TYPE_CHECKING:
    from PIL.Image import Image

PLAIN_KINDS = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp"}
"""Kinds of pictures that every browser shows; others are converted to PNG."""

MOST_PIXELS = 4096
"""The longer side of a picture in the page; a larger one is made smaller."""

OPACITY = 0.6


@dataclass(frozen=True, slots=True, kw_only=True)
class Background:
    """A picture that the page draws under the map.

    Attributes
    ----------
    picture
        The file: PNG, JPEG, PGM, or another kind that Pillow reads.
    scale
        Length of a pixel [length unit], above 0. None makes the picture as wide as the map.
    origin
        The picture's lower left corner in the site's frame [length unit]. None puts it on the
        lower left corner of the map.
    corner
        The picture's upper left corner in the site's frame, instead of the origin [length unit].
    yaw
        Angle by which the picture is turned about that corner, from the site's x to its y [rad].
    opacity
        From 0 to 1.
    """

    picture: str | os.PathLike[str]
    scale: float | None = None
    origin: tuple[float, float] | None = None
    corner: tuple[float, float] | None = None
    yaw: float = 0
    opacity: float = OPACITY

    def __post_init__(self) -> None:
        kinds = {
            "picture": PATH,
            "scale": allow_none(POSITIVE),
            "yaw": COORDINATE,
            "opacity": SHARE,
            "origin": allow_none(POSITION),
            "corner": allow_none(POSITION),
        }
        for name, kind in kinds.items():
            kind.read_at(("background", name), getattr(self, name))
        if self.origin is not None and self.corner is not None:
            raise InputError.at("background", "has both origin and corner (give one of them)")

    @classmethod
    def of(cls, picture: Picture) -> Background:
        """Return the picture of a map where its scenario or layout says that it lies."""
        make_class(Picture).read_at("picture", picture)
        origin, corner = picture.origin, picture.corner
        return cls(
            picture=picture.file,
            scale=None if picture.pixel is None else float(picture.pixel),
            origin=origin and (float(origin[0]), float(origin[1])),
            corner=corner and (float(corner[0]), float(corner[1])),
            yaw=float(picture.yaw),
            opacity=OPACITY if picture.opacity is None else float(picture.opacity),
        )


def find_background(roadmap: Roadmap) -> Background | None:
    """Return the picture that a roadmap is drawn over; None where a scenario's is missing."""
    picture = roadmap.drawing.picture
    is_missing = picture is None or (picture.name and not picture.file.is_file())
    return None if is_missing or picture is None else Background.of(picture)


def make_background_data(roadmap: Roadmap, background: Background) -> BackgroundData:
    """Return the picture and where it lies in the drawing, as plain data for JSON.

    Returns
    -------
    dict
        ``href`` (a data URI), ``opacity``, and in units of the drawing ``x``, ``y`` (the upper left
        corner), ``width`` and ``height``; ``turn`` is the angle by which the picture is turned
        about that corner, from right to down [rad], left out where it is 0.

    Raises
    ------
    InputError
        If the file is no picture that can be read.
    """
    href, columns, rows = _make_data_uri(background.picture)
    place = place_of(roadmap, background, columns, rows)
    return {**place, "href": href, "opacity": background.opacity}


def place_of(roadmap: Roadmap, background: Background, columns: int, rows: int) -> PlaceData:
    """Return where a picture lies in the drawing, as `make_background_data` has it."""
    plane, frame = lay_out_roadmap(roadmap), roadmap.frame

    def drawn(point: tuple[float, float]) -> tuple[float, float]:
        x, y = frame.to_plane((Fraction(point[0]), Fraction(point[1])))
        return (float(x) - plane.corner[0]) / plane.unit, (float(y) - plane.corner[1]) / plane.unit

    turn = float(Fraction(background.yaw) - frame.yaw) * (-1 if frame.y_up else 1)
    margin = 0.5 if roadmap.has_cells else 0.0  # cells reach beyond their centres
    pixel = (plane.width - 1 + 2 * margin) / columns
    if background.scale is not None:
        pixel = background.scale / plane.unit
    if background.corner is not None:
        x, y = drawn(background.corner)
    else:
        x, y = -margin, plane.height - 1 + margin
        if background.origin is not None:
            x, y = drawn(background.origin)
        x, y = x + rows * pixel * sin(turn), y - rows * pixel * cos(turn)
    place: PlaceData = {"x": x, "y": y, "width": columns * pixel, "height": rows * pixel}
    return {**place, "turn": turn} if turn else place


def place_background(roadmap: Roadmap, background: Background) -> BackgroundData:
    """Return where a picture lies in the drawing, for a page that has the picture itself.

    Returns
    -------
    dict
        As from `make_background_data`, without ``href``.

    Raises
    ------
    InputError
        If the file is no picture that can be read.
    """
    from PIL import Image

    try:
        with Image.open(background.picture) as image:
            place = place_of(roadmap, background, *image.size)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise explain_unreadable(background.picture) from error
    return cast("BackgroundData", {"opacity": background.opacity, **place})


def _make_data_uri(path: str | os.PathLike[str]) -> tuple[str, int, int]:
    """Return a picture as data URI, and its size [pixels]."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            image.load()
            kind, (columns, rows) = PLAIN_KINDS.get(image.format or ""), image.size
            content = io.BytesIO()
            if kind is None or max(columns, rows) > MOST_PIXELS:
                kind = None
                converted = image.convert(_choose_mode(image))
                converted.thumbnail((MOST_PIXELS, MOST_PIXELS))
                converted.save(content, "png")
            else:
                content.write(Path(path).read_bytes())
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise explain_unreadable(path) from error
    encoded = base64.b64encode(content.getvalue()).decode()
    return f"data:{kind or 'image/png'};base64,{encoded}", columns, rows


def explain_unreadable(path: str | os.PathLike[str]) -> InputError:
    """Return the error for a file that is not a picture."""
    message = "is no picture that can be read (give a PNG, JPEG or PGM file)"
    return InputError.at(str(path), message)


def _choose_mode(image: Image) -> str:
    """Return the mode that a PNG keeps the colours of a picture in."""
    if "A" in image.getbands() or "transparency" in image.info:
        return "RGBA"
    return "L" if image.mode in {"1", "L", "I", "F"} or image.mode.startswith("I;") else "RGB"
