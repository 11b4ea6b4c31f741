"""The colours of page and pictures, each defined once: robots, and a light and a dark theme.

References
----------
Ottosson, *A perceptual color space for image processing* (Oklab), 2020.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import lru_cache

GOLDEN_ANGLE = 137.50776
"""Degrees; turning by it, hues stay apart however many there are."""

FIRST_HUE = 255.0
LIGHTNESS = (0.58, 0.70, 0.64)
"""Readable on white and on near-black; changes from robot to robot, for eyes that see few hues."""

CHROMA = 0.15

STRAIGHT_UNTIL = 0.0031308
"""Up to here the curve of sRGB is a straight line."""

DARK_INK_FROM = 0.25
"""Luminance of a colour from which on dark letters read better on it than white ones."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Theme:
    """Colours of everything but the robots, as ``#rrggbb``.

    Attributes
    ----------
    paper, panel, floor
        Behind the page, behind its controls, and where robots may drive.
    wall, line
        Blocked cells, and hairlines.
    ink, muted
        Text, the moment shown and chosen things; and text of less weight. Both are readable on
        paper, panel and floor. Hues belong to robots, and to their activities.
    focus
        Around the element that has the keyboard.
    heat_low, heat_high
        The ends of the heat map.
    drive, wait, work, turn
        Activities of robots, where they are counted.
    held, broken
        Troubles on the floor.
    lit, lit_edge
        The bottleneck, and the line round it.
    zone
        Vertices and lanes that hold one robot at a time.
    """

    paper: str
    panel: str
    floor: str
    wall: str
    line: str
    ink: str
    muted: str
    focus: str
    heat_low: str
    heat_high: str
    drive: str
    wait: str
    work: str
    turn: str
    held: str
    broken: str
    lit: str
    lit_edge: str
    zone: str

    def as_css(self) -> str:
        """Return the colours as CSS custom properties."""
        names = (field.name for field in fields(self))
        return "".join(f"--{name.replace('_', '-')}:{getattr(self, name)};" for name in names)


LIGHT = Theme(
    paper="#f6f5f1", panel="#fdfcfa", floor="#ffffff", wall="#d3d0c8", line="#e3e1da",
    ink="#1c2025", muted="#5d646c", focus="#1f62c9",
    heat_low="#f7ead0", heat_high="#a4480d",
    drive="#9db4cf", wait="#d9922e", work="#3d5a80", turn="#6c8cb4",
    held="#a3324e", broken="#1c2025", lit="#ffdf6b", lit_edge="#8a6400", zone="#8f7cc6",
)  # fmt: skip

DARK = Theme(
    paper="#121518", panel="#181c20", floor="#1c2126", wall="#3a4149", line="#2b3138",
    ink="#e9e6df", muted="#a0a8b1", focus="#7db2ff",
    heat_low="#2b2724", heat_high="#e08a3c",
    drive="#4a6484", wait="#e0a045", work="#a9c6ea", turn="#7193bd",
    held="#ee7f97", broken="#e9e6df", lit="#6e5600", lit_edge="#f0c948", zone="#8878c8",
)  # fmt: skip


@lru_cache(maxsize=8)
def choose_colours(count: int) -> tuple[str, ...]:
    """Return a colour for each robot; a robot's colour does not depend on how many there are."""
    return tuple(
        _convert_oklch(LIGHTNESS[index % len(LIGHTNESS)], CHROMA, FIRST_HUE + index * GOLDEN_ANGLE)
        for index in range(count)
    )


def mix(low: str, high: str, share: float) -> str:
    """Return the colour at ``share`` (0 to 1) of the way between two."""
    ends = zip(_split_channels(low), _split_channels(high), strict=True)
    return _write_hex(tuple(round(start + (end - start) * share) for start, end in ends))


def choose_ink(colour: str) -> str:
    """Return white or near-black, whichever reads better on a colour."""
    red, green, blue = ((channel / 255) ** 2.2 for channel in _split_channels(colour))
    luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    return "#16191d" if luminance > DARK_INK_FROM else "#ffffff"


def _split_channels(colour: str) -> tuple[int, ...]:
    return tuple(bytes.fromhex(colour[1:]))


def _write_hex(channels: tuple[int, ...]) -> str:
    return "#" + bytes(channels).hex()


def _convert_oklch(lightness: float, chroma: float, hue: float) -> str:
    """Convert to sRGB, with as much of the chroma as that can show."""
    linear = _compute_linear_rgb(lightness, chroma, hue)
    while not all(0 <= channel <= 1 for channel in linear):
        chroma -= 0.002
        linear = _compute_linear_rgb(lightness, chroma, hue)
    curved = (
        12.92 * channel if channel <= STRAIGHT_UNTIL else 1.055 * channel ** (1 / 2.4) - 0.055
        for channel in linear
    )
    return _write_hex(tuple(round(255 * channel) for channel in curved))


def _compute_linear_rgb(lightness: float, chroma: float, hue: float) -> tuple[float, float, float]:
    a, b = chroma * math.cos(math.radians(hue)), chroma * math.sin(math.radians(hue))
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    middle = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    return (
        4.0767416621 * long - 3.3077115913 * middle + 0.2309699292 * short,
        -1.2684380046 * long + 2.6097574011 * middle - 0.3413193965 * short,
        -0.0041960863 * long - 0.7034186147 * middle + 1.7076147010 * short,
    )
