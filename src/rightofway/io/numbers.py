"""Exact numbers from what users write: 3, 0.1, 2e-3, 1/3; never a float on the way."""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from numbers import Rational

from rightofway.io.faults import shown

__all__ = ["COORDINATE_DIGITS", "DIGITS", "PATTERN", "decimal", "exact", "whole", "written"]

DIGITS = 18
"""Most digits of numerator and denominator of a speed, a length or a time."""

COORDINATE_DIGITS = 400
"""The same for coordinates and the tick: any decimal that stands for a float fits in."""

PATTERN = r"[+-]?([0-9]+/[0-9]+|([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?)"
"""How a number may be written as text; a dialect that JSON Schema understands too."""

LONGEST_TOKEN = 40
"""A number of more characters stays text when a file is read, and is refused as a number."""

LARGEST_EXPONENT = 400
"""A decimal with a larger exponent stays text, too."""

_NUMBER = re.compile(PATTERN.replace("([eE][+-]?[0-9]+)", "([eE](?P<exponent>[+-]?[0-9]+))"))


def exact(value: object, *, digits: int = DIGITS) -> Fraction:
    """Return a written number exactly.

    Parameters
    ----------
    value
        A whole number, a decimal, a fraction, or text like ``0.1``, ``2e-3``, ``1/3``. A float
        counts as the shortest decimal that stands for it.
    digits
        The most digits of numerator and denominator.

    Raises
    ------
    ValueError
        For anything else: words, true and false, NaN, infinity, 1/0, and numbers out of range.
    """
    if isinstance(value, Rational) and not isinstance(value, bool):
        number = Fraction(int(value.numerator), int(value.denominator))
    else:
        number = _parsed(value, digits)
    if max(abs(number.numerator), number.denominator) > 10**digits:
        raise _out_of_range(value, digits)
    return number


def _parsed(value: object, digits: int) -> Fraction:
    text = str(value) if isinstance(value, str | Decimal | float) else ""
    match = _NUMBER.fullmatch(text)
    if not match:
        raise ValueError(f"{shown(value)} is not a number (write it like 3, 0.5 or 1/3)")
    most = 2 * COORDINATE_DIGITS  # computing 1e999999999 would fill the memory
    if len(text) > most or abs(int(match["exponent"] or "0")) > most:
        raise _out_of_range(value, digits)
    try:
        return Fraction(text)
    except ZeroDivisionError:
        raise ValueError(f"{shown(value)} divides by zero (give another denominator)") from None


def _out_of_range(value: object, digits: int) -> ValueError:
    return ValueError(
        f"{shown(value)} is out of range (give at most {digits} digits before and after the point)"
    )


def written(number: Fraction) -> int | str:
    """Return a fraction as documents have it: a whole number, or text like ``1/3``."""
    return number.numerator if number.denominator == 1 else str(number)


def whole(token: str) -> int | str:
    """Return a whole number of a file, or its text where it is too long."""
    return int(token) if len(token) <= LONGEST_TOKEN else token


def decimal(token: str) -> Decimal | str:
    """Return a decimal of a file exactly, or its text where no float comes near it."""
    _, _, exponent = token.lower().partition("e")
    if len(token) > LONGEST_TOKEN or abs(int(exponent or "0")) > LARGEST_EXPONENT:
        return token
    return Decimal(token) if math.isfinite(float(token)) else token
