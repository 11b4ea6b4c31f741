"""Numbers of files, read without a float on the way."""

from __future__ import annotations

import math
from decimal import Decimal

from rightofway.model.values import COORDINATE_DIGITS, DIGITS, PATTERN, exact, written

__all__ = ["COORDINATE_DIGITS", "DIGITS", "PATTERN", "decimal", "exact", "whole", "written"]


LONGEST_TOKEN = 40
"""A number of more characters stays text when a file is read; whoever needs a number refuses it."""

LARGEST_EXPONENT = 400
"""The same for a decimal with a larger exponent."""


def whole(token: str) -> int | str:
    """Return a whole number of a file, or its text where that is too long to be one."""
    return int(token) if len(token) <= LONGEST_TOKEN else token


def decimal(token: str) -> Decimal | str:
    """Return a decimal of a file exactly, or its text where no float comes near it."""
    _, _, exponent = token.lower().partition("e")
    if len(token) > LONGEST_TOKEN or abs(int(exponent or "0")) > LARGEST_EXPONENT:
        return token
    return Decimal(token) if math.isfinite(float(token)) else token
