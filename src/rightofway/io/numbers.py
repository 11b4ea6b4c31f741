"""Numbers of files, read without a float on the way."""

from __future__ import annotations

import math
from decimal import Decimal

__all__ = ["decimal", "whole"]

LONGEST_TOKEN = 40
"""A number of more characters stays text when a file is read, and is refused as a number."""

LARGEST_EXPONENT = 400
"""A decimal with a larger exponent stays text, too."""


def whole(token: str) -> int | str:
    """Return a whole number of a file, or its text where it is too long."""
    return int(token) if len(token) <= LONGEST_TOKEN else token


def decimal(token: str) -> Decimal | str:
    """Return a decimal of a file exactly, or its text where no float comes near it."""
    _, _, exponent = token.lower().partition("e")
    if len(token) > LONGEST_TOKEN or abs(int(exponent or "0")) > LARGEST_EXPONENT:
        return token
    return Decimal(token) if math.isfinite(float(token)) else token
