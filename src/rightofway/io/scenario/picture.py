"""The picture that a scenario's map is drawn over, looked at before anything draws it."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

from rightofway.errors import InputError, locate_faults, quote
from rightofway.facts import Fact
from rightofway.io.content import refuse_special
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.site.drawing import Picture

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import PictureDocument

KINDS = ("PNG", "JPEG", "WEBP", "BMP", "PPM", "GIF", "TIFF")
"""Formats of pictures; PGM is a kind of PPM."""

MOST_PIXELS = 50_000_000
"""Pixels of the largest picture that is read; a floor plan of 7000 x 7000."""


def add_picture(
    loaded: LoadedMap, document: PictureDocument | None, base: Path | None
) -> LoadedMap:
    """Return a map with the picture that it is drawn over; a note where the file is missing."""
    if document is None:
        return loaded
    with locate_faults("picture"):
        picture, is_there = read_picture(document, base)
    note = Fact("picture of map missing", file=quote(document.file))
    return replace(
        loaded,
        roadmap=replace(loaded.roadmap, drawing=replace(loaded.roadmap.drawing, picture=picture)),
        notes=loaded.notes if is_there else (*loaded.notes, note),
    )


def read_picture(document: PictureDocument, base: Path | None) -> tuple[Picture, bool]:
    """Return a picture, and whether its file is there; no plan depends on it.

    Raises
    ------
    InputError
        If the file is no picture, or too large.
    """
    file = Path(document.file) if base is None else base / document.file
    picture = Picture(
        file=file,
        pixel=document.scale,
        origin=document.origin,
        yaw=document.yaw or Fraction(0),
        opacity=document.opacity,
        name=document.file,
    )
    return picture, _is_there(file, document.file)


def _is_there(file: Path, name: str) -> bool:
    """Return whether a picture is there; its first bytes say how large it is."""
    from PIL import Image

    with locate_faults("file"):
        refuse_special(file)
    try:
        with Image.open(file, formats=KINDS) as image:
            columns, rows = image.size
    except FileNotFoundError:
        return False
    except Image.DecompressionBombError:
        columns = rows = MOST_PIXELS  # more than Pillow would read
    except (OSError, ValueError, SyntaxError) as error:
        reason = f" ({error.strerror})" if isinstance(error, OSError) and error.strerror else ""
        message = f"{quote(name)} is no picture that can be read{reason} (give a PNG or JPEG file)"
        raise InputError.at("file", message) from None
    if columns * rows > MOST_PIXELS:
        message = f"{quote(name)} has more than {MOST_PIXELS} pixels (save it smaller)"
        raise InputError.at("file", message)
    return True
