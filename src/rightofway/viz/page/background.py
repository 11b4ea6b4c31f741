"""A picture under the map: a floor plan, or the map that a robot has recorded."""

from __future__ import annotations

import base64
import io
import os
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.model import Roadmap
from rightofway.viz.placement import plane_of

PLAIN_KINDS = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp"}
"""Kinds of pictures that every browser shows; others are converted to PNG."""


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
    opacity
        From 0 to 1.
    """

    picture: str | os.PathLike[str]
    scale: float | None = None
    origin: tuple[float, float] | None = None
    opacity: float = 0.6

    def __post_init__(self) -> None:
        if self.scale is not None and not self.scale > 0:
            raise InputError.at("background.scale", f"{self.scale} is not positive (give a length)")
        if not 0 <= self.opacity <= 1:
            fault = f"{self.opacity} is not from 0 to 1 (give a share)"
            raise InputError.at("background.opacity", fault)


def background_data(roadmap: Roadmap, background: Background) -> dict[str, Any]:
    """Return the picture and where it lies in the drawing, as plain data for JSON.

    Parameters
    ----------
    roadmap
        The roadmap that the picture lies under.
    background
        The picture and its place.

    Returns
    -------
    dict
        ``href`` (a data URI), ``opacity``, and ``x``, ``y`` (the upper left corner), ``width`` and
        ``height`` in units of the drawing.

    Raises
    ------
    InputError
        If the file is no picture that can be read.
    """
    href, columns, rows = _data_uri(background.picture)
    plane = plane_of(roadmap)
    has_cells = roadmap.grid is not None or roadmap.sides is not None
    margin = 0.5 if has_cells else 0.0  # cells reach beyond their centres
    left, bottom = -margin, plane.height - 1 + margin
    if background.origin is not None:
        x, y = roadmap.frame.to_plane(
            (Fraction(background.origin[0]), Fraction(background.origin[1]))
        )
        left = (float(x) - plane.corner[0]) / plane.unit
        bottom = (float(y) - plane.corner[1]) / plane.unit
    pixel = (plane.width - 1 + 2 * margin) / columns
    if background.scale is not None:
        pixel = background.scale / plane.unit
    return {
        "href": href,
        "opacity": background.opacity,
        "x": left,
        "y": bottom - rows * pixel,
        "width": columns * pixel,
        "height": rows * pixel,
    }


def _data_uri(path: str | os.PathLike[str]) -> tuple[str, int, int]:
    """Return a picture as data URI, and its size [pixels]."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            image.load()
            kind, (columns, rows) = PLAIN_KINDS.get(image.format or ""), image.size
            content = io.BytesIO()
            if kind is None:
                image.convert("RGBA" if "A" in image.getbands() else "L").save(content, "png")
            else:
                content.write(Path(path).read_bytes())
    except (OSError, ValueError, SyntaxError) as error:
        raise InputError.at(
            str(path), "is no picture that can be read (give a PNG, JPEG or PGM file)"
        ) from error
    encoded = base64.b64encode(content.getvalue()).decode()
    return f"data:{kind or 'image/png'};base64,{encoded}", columns, rows
