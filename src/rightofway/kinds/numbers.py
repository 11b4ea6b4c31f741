"""Exact numbers: the text, decimals and fractions that users write, and the text of a fraction."""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction
from functools import cache
from numbers import Rational

from rightofway.errors import quote

Number = int | float | str | Decimal | Fraction
"""A number as users write it: ``2``, ``0.5``, ``"1/3"``; never rounded, see `read_exact`."""

DIGITS = 18
"""Numerator and denominator of a speed, a length or a time have at most that many digits."""

COORDINATE_DIGITS = 400
"""The same for coordinates and the tick: any decimal that stands for a float fits in."""

PATTERN = r"[+-]?([0-9]+/[0-9]+|([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?)"
"""How a number may be written as text; a dialect that JSON Schema understands too."""

_NUMBER = re.compile(PATTERN.replace("([eE][+-]?[0-9]+)", "([eE](?P<exponent>[+-]?[0-9]+))"))


def read_exact(value: object, *, digits: int = DIGITS) -> Fraction:
    """Return the number that was written, exactly.

    Raises
    ------
    ValueError
        For anything else: words, true and false, NaN, infinity, 1/0, and numbers out of range.
    """
    if type(value) is int:  # spares a search of the registry of `Rational`
        return _in_range(Fraction(value), value, digits)
    if not isinstance(value, str) and isinstance(value, Rational) and not isinstance(value, bool):
        return _in_range(Fraction(int(value.numerator), int(value.denominator)), value, digits)
    text = str(value) if isinstance(value, str | Decimal | float) else ""
    most = 2 * COORDINATE_DIGITS  # to compute 1e999999999 would fill the memory
    whole, _, decimals = text.partition(".")
    figures = whole + decimals
    if figures.isdecimal() and figures.isascii() and len(text) <= most:  # a map has a million
        return _in_range(Fraction(int(figures), 10 ** len(decimals)), value, digits)
    numerator, _, denominator = text.partition("/")
    is_plain = numerator.isdecimal() and denominator.isdecimal() and text.isascii()
    if is_plain and len(text) <= most and int(denominator):  # a shift, too
        return _in_range(Fraction(int(numerator), int(denominator)), value, digits)
    match = _NUMBER.fullmatch(text)
    if not match:
        raise ValueError(f"{quote(value)} is not a number (write it like 3, 0.5 or 1/3)")
    if len(text) > most or abs(int(match["exponent"] or "0")) > most:
        raise _out_of_range(value, digits)
    try:
        return _in_range(Fraction(text), value, digits)
    except ZeroDivisionError:
        raise ValueError(f"{quote(value)} divides by zero (give another denominator)") from None


def read_number(value: object) -> Fraction:
    """Return an exact number; one that is exact already may have any number of digits."""
    return value if type(value) is Fraction else read_exact(value)


def read_coordinate(value: object) -> Fraction:
    """Return a coordinate exactly, as `read_exact` does, with as many decimals as a float has."""
    number = read_exact(value, digits=COORDINATE_DIGITS)
    if abs(number.numerator) > 10**DIGITS * number.denominator:
        raise ValueError(f"{quote(value)} is out of range (give at most {DIGITS} digits)")
    return number


@cache
def _compute_most(digits: int) -> int:
    most: int = 10**digits
    return most


def _in_range(number: Fraction, value: object, digits: int) -> Fraction:
    if max(abs(number.numerator), number.denominator) > _compute_most(digits):
        raise _out_of_range(value, digits)
    return number


def _out_of_range(value: object, digits: int) -> ValueError:
    return ValueError(
        f"{quote(value)} is out of range (give at most {digits} digits before and after the point)"
    )


def parse_digits(given: object) -> object:
    """Return the whole number that a text of digits is, and anything else as it is."""
    text = given if isinstance(given, str) and len(given) <= COORDINATE_DIGITS else ""
    return int(text) if text.isascii() and text.isdecimal() else given


def format_number(number: Fraction) -> int | str:
    """Return a fraction as documents have it: a whole number, or text like ``1/3``."""
    return number.numerator if number.denominator == 1 else str(number)
