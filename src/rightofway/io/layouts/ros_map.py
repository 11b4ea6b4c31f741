"""Maps of ROS: a YAML file with resolution, origin and thresholds, and a picture beside it.

References
----------
Nav2, *nav2_map_server*: ``map_io.cpp`` says how pixels become free, occupied or unknown.
"""

from __future__ import annotations

import struct
import warnings
import zlib
from fractions import Fraction
from math import ceil, floor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, locate_faults, quote
from rightofway.facts import Fact
from rightofway.io.content import refuse_special
from rightofway.io.source import Source
from rightofway.site.drawing import Picture
from rightofway.site.geometry import Frame
from rightofway.site.occupancy import FREE, OCCUPIED, UNKNOWN, Occupancy

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_PIXELS = 64_000_000
"""The most pixels of a picture."""

KEYS = {"resolution", "origin", "occupied_thresh", "free_thresh", "negate"}
"""Keys that say how to read the picture of a map."""

MODES = ("trinary", "scale", "raw")
PICTURES = ("PPM", "PNG", "BMP", "GIF", "JPEG", "TIFF")
BROKEN = (
    OSError,
    SyntaxError,
    ValueError,
    EOFError,
    OverflowError,
    MemoryError,
    struct.error,
    zlib.error,
)
"""Exceptions of the picture library for a truncated or damaged picture."""

OPAQUE = 255
FULL = 100
"""Occupancy of a pixel that is occupied; larger values of ``mode: raw`` are unknown."""

GREY, GREY_16, COLOUR = 255, 65_535, 765
"""The largest value of a pixel: grey, grey of 16 bits, the sum of three colours."""


def recognizes(document: Any) -> bool:
    """Return whether a document names a picture, and says how to read it."""
    return isinstance(document, dict) and "image" in document and bool(KEYS & set(document))


def read(document: Any, path: Path) -> Occupancy:
    """Return the map of a document; its picture lies beside the file.

    Raises
    ------
    InputError
        With every key that does not fit, and for a picture that cannot be read.
    """
    root, notes = Source(document), list[Fact]()
    resolution, mode = root.need("resolution"), root.get("mode")
    if resolution.number() <= 0:
        raise resolution.make_fault(f"{quote(resolution.value)} is not positive (give metres)")
    if mode is not None and mode.value not in MODES:
        raise mode.make_fault(f"{quote(mode.value)} is unknown (give one of {', '.join(MODES)})")
    origin = root.need("origin")
    numbers = [coordinate.number() for coordinate in origin.read_items()]
    if len(numbers) not in {2, 3}:
        raise origin.make_fault(f"{quote(origin.value)} does not fit (give [x, y, yaw])")
    negate = root.get("negate")
    if negate is None:
        notes.append(Fact("negate missing"))
    is_raw = mode is not None and mode.value == "raw"
    thresholds = Fraction(0), Fraction(1)
    if not is_raw:
        thresholds = root.need("free_thresh").number(), root.need("occupied_thresh").number()
    if thresholds[0] > thresholds[1]:
        raise root.need("free_thresh").make_fault("is above occupied_thresh (mend one)")
    values, largest, is_clear = _read_picture(root.need("image"), path)
    table = (
        _make_raw_table(largest)
        if is_raw
        else _make_table(largest, *thresholds, negate=negate is not None and negate.read_flag())
    )
    pixels = table[values]
    if is_clear is not None and not is_raw:
        pixels[is_clear] = UNKNOWN
    (x, y), pixel = numbers[:2], resolution.number()
    yaw = numbers[2] if len(numbers) > 2 else Fraction(0)  # noqa: PLR2004 - x, y, yaw
    height = len(pixels) * pixel
    picture = Picture(
        file=path.parent / root.need("image").read_text(),
        pixel=pixel,
        corner=Frame(x=x, y=y, y_up=True, yaw=yaw).to_site((Fraction(0), -height)),
        yaw=yaw,
    )
    return Occupancy(
        pixels=pixels,
        resolution=pixel,
        origin=(x, y),
        yaw=yaw,
        picture=picture,
        notes=tuple(notes),
    )


def _make_table(
    largest: int, free: Fraction, occupied: Fraction, *, negate: bool
) -> NDArray[np.uint8]:
    """Return the meaning of a pixel of each value; dark is occupied unless negated.

    Between the thresholds it is unknown (``trinary``) or costly (``scale``), and not free for us.
    """
    values = np.arange(largest + 1)
    dark = values if negate else largest - values
    table = np.full(largest + 1, UNKNOWN, np.uint8)
    table[dark <= floor(free * largest)] = FREE
    table[dark >= ceil(occupied * largest)] = OCCUPIED
    return table


def _make_raw_table(largest: int) -> NDArray[np.uint8]:
    """Return the meaning of a pixel of each value where values are occupancies from 0 to 100."""
    table = np.full(largest + 1, UNKNOWN, np.uint8)
    scaled = np.arange(largest + 1) * OPAQUE // largest
    table[scaled == 0], table[scaled == FULL] = FREE, OCCUPIED
    return table


def _read_picture(image: Source, path: Path) -> tuple[NDArray[Any], int, NDArray[np.bool_] | None]:
    """Return the values of a picture's pixels, the largest possible one, and which are clear."""
    from PIL import Image

    file = path.parent / image.read_text()
    with locate_faults(image.location):
        refuse_special(file)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # large pictures are refused below, by a limit of ours
            with Image.open(file, formats=PICTURES) as picture:
                if picture.width * picture.height > MAX_PIXELS:
                    size = f"{picture.width} x {picture.height} pixels"
                    raise image.make_fault(f"{size} are more than {MAX_PIXELS} (give a part of it)")
                picture.load()
                return _read_values(picture)
    except InputError:
        raise
    except FileNotFoundError:
        message = f"there is no picture {image.value!r} beside the file (put it there)"
        raise image.make_fault(message) from None
    except Image.DecompressionBombError:
        message = f"the picture has more than {MAX_PIXELS} pixels (give a part of it)"
        raise image.make_fault(message) from None
    except BROKEN as error:
        reason = quote(str(error).replace(str(file), file.name))
        raise image.make_fault(f"the picture cannot be read: {reason} (write it again)") from None


def _read_values(picture: Image) -> tuple[NDArray[Any], int, NDArray[np.bool_] | None]:
    if picture.mode.startswith("I"):
        wide = np.clip(np.asarray(picture), 0, GREY_16).astype(np.uint16)
        return wide, GREY_16, None
    if picture.mode == "L":
        return np.asarray(picture), GREY, None
    if picture.mode == "1":
        return np.asarray(picture.convert("L")), GREY, None
    has_alpha = picture.mode in {"LA", "RGBA", "PA", "La", "RGBa"} or "transparency" in picture.info
    colours = np.asarray(picture.convert("RGBA" if has_alpha else "RGB"))
    total = colours[..., :3].sum(axis=2, dtype=np.uint16)
    return total, COLOUR, colours[..., 3] < OPAQUE if has_alpha else None
