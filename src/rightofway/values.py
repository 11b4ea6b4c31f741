"""Values as users write them: kept exactly, or refused with the value and what to do."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from functools import cache
from numbers import Rational, Real
from typing import Any, Literal, TypeVar

from rightofway.arguments import is_whole
from rightofway.errors import InputError, InputFault, Where, quote

T = TypeVar("T")

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
    if not isinstance(value, str) and isinstance(value, Rational) and not isinstance(value, bool):
        return _in_range(Fraction(int(value.numerator), int(value.denominator)), value, digits)
    text = str(value) if isinstance(value, str | Decimal | float) else ""
    most = 2 * COORDINATE_DIGITS  # to compute 1e999999999 would fill the memory
    whole, _, decimals = text.partition(".")
    figures = whole + decimals
    if figures.isdecimal() and figures.isascii() and len(text) <= most:  # a map has a million
        return _in_range(Fraction(int(figures), 10 ** len(decimals)), value, digits)
    match = _NUMBER.fullmatch(text)
    if not match:
        raise ValueError(f"{quote(value)} is not a number (write it like 3, 0.5 or 1/3)")
    if len(text) > most or abs(int(match["exponent"] or "0")) > most:
        raise _out_of_range(value, digits)
    try:
        return _in_range(Fraction(text), value, digits)
    except ZeroDivisionError:
        raise ValueError(f"{quote(value)} divides by zero (give another denominator)") from None


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


def format_number(number: Fraction) -> int | str:
    """Return a fraction as documents have it: a whole number, or text like ``1/3``."""
    return number.numerator if number.denominator == 1 else str(number)


def coerce_fields(value: object, source: str, **readers: Callable[[object], object]) -> None:
    """Replace fields of a frozen value by what their readers make of them.

    Raises
    ------
    InputError
        With every field that its reader refuses.
    """
    faults = list[InputFault]()
    for name, read in readers.items():
        try:
            object.__setattr__(value, name, read(getattr(value, name)))
        except ValueError as error:
            faults += _faults_at(name, error)
    if faults:
        raise InputError(faults, source)


def allow_none(read: Callable[[object], T]) -> Callable[[object], T | None]:
    """Return a reader that also takes None."""
    return lambda value: None if value is None else read(value)


def read_vertex(value: object) -> int:
    """Return a vertex; a name is refused."""
    if is_whole(value):
        return int(value)
    raise ValueError(
        f"{quote(value)} is no vertex number"
        " (give roadmap.get_vertex(name), or build the fleet with FleetBuilder, which takes names)"
    )


def read_number(value: object) -> Fraction:
    """Return an exact number; one that is exact already may have any number of digits."""
    return value if type(value) is Fraction else read_exact(value)


def read_turning(value: object) -> Literal["cell"] | Fraction:
    """Return a turning time."""
    if isinstance(value, str) and value == "cell":
        return "cell"
    try:
        return read_number(value)
    except ValueError as error:
        raise ValueError(f"{error}; 'cell' is possible too") from None


def read_whole_number(value: object) -> int:
    """Return a whole number."""
    if is_whole(value):
        return int(value)
    raise ValueError(f"{quote(value)} is no whole number (give 1 or more)")


def read_integer(value: object) -> int:
    """Return a whole number that may be 0 or negative."""
    if is_whole(value):
        return int(value)
    raise ValueError(f"{quote(value)} is no whole number (give one)")


def make_word_reader(words: Sequence[str]) -> Callable[[object], str]:
    """Return a reader of one of these words."""

    def read(value: object) -> str:
        if isinstance(value, str) and value in words:
            return value
        *others, last = words
        raise ValueError(f"{quote(value)} is unknown (give {', '.join(others)} or {last})")

    return read


def read_names(value: object) -> frozenset[str]:
    """Return a set of names."""
    if isinstance(value, list | tuple | set | frozenset) and all(
        isinstance(name, str) for name in value
    ):
        return frozenset(value)
    raise ValueError(f"{quote(value)} are no names (give a list of texts)")


TypeSpeeds = tuple[tuple[str, Fraction], ...]
"""Types of robots, each once, with a speed [length unit per time unit]; sorted by their names."""


def read_type_speeds(value: object) -> TypeSpeeds:
    """Return speeds by types of robots."""
    is_pairs = isinstance(value, tuple) and all(
        isinstance(pair, tuple) and len(pair) == 2  # noqa: PLR2004 (a type and its speed)
        for pair in value
    )
    speeds = dict(value) if isinstance(value, tuple) and is_pairs else value
    if isinstance(speeds, Mapping) and all(isinstance(name, str) for name in speeds):
        return tuple((name, read_at(name, read_number, speeds[name])) for name in sorted(speeds))
    raise ValueError(f"{quote(value)} are no speeds of types (give a mapping of types to speeds)")


def read_label(value: object) -> str:
    """Return a name."""
    if isinstance(value, str):
        return value
    raise ValueError(f"{quote(value)} is no name (give text)")


def read_truth(value: object) -> bool:
    """Return a truth value."""
    if isinstance(value, bool):
        return value
    raise ValueError(f"{quote(value)} is neither true nor false (give True or False)")


def make_class_reader(kind: type[T], fault: str, remedy: str) -> Callable[[object], T]:
    """Return a reader of values of a class; ``fault`` is said of others, as in "no plan"."""

    def read(value: object) -> T:
        if isinstance(value, kind):
            return value
        raise ValueError(f"{quote(value)} is {fault} ({remedy})")

    return read


def list_of(read: Callable[[object], T]) -> Callable[[object], tuple[T, ...]]:
    """Return a reader of a list, by the reader of its items; text and mappings are no lists."""

    def read_each(values: object) -> tuple[T, ...]:
        if not isinstance(values, Iterable) or isinstance(values, str | bytes | Mapping):
            raise ValueError(f"{quote(values)} is no list (give a list)")  # noqa: TRY004 (readers raise it)
        return tuple(read_at(index, read, value) for index, value in enumerate(values))

    return read_each


def read_at(where: Where, read: Callable[[object], T], value: object) -> T:
    """Return what a reader makes of a value.

    Raises
    ------
    InputError
        At the place, if the reader refuses the value.
    """
    try:
        return read(value)
    except ValueError as error:
        raise InputError(_faults_at(where, error)) from None


def _faults_at(where: Where, error: ValueError) -> list[InputFault]:
    """Return the faults of a value that was refused, at its place."""
    if isinstance(error, InputError):
        return [fault.nest(where) for fault in error.faults]
    return [InputFault(where, str(error))]


def read_function(value: object) -> Callable[..., Any]:
    """Return a function."""
    if callable(value):
        return value
    raise ValueError(f"{quote(value)} is no function (give one that takes one argument, or None)")


def make_range_reader(least: float, most: float) -> Callable[[object], float]:
    """Return a reader of a number from ``least`` to ``most``, both included."""

    def read(value: object) -> float:
        is_number = isinstance(value, Real) and not isinstance(value, bool)
        if is_number and least <= value <= most:  # type: ignore[operator]
            return float(value)  # type: ignore[arg-type]
        raise ValueError(f"{quote(value)} is no number from {least:g} to {most:g} (give one)")

    return read


def read_length(value: object, where: Where) -> Fraction:
    """Return a length.

    Raises
    ------
    InputError
        If it is no number, or not positive.
    """
    checked = read_at(where, read_number, value)
    if checked <= 0:
        raise InputError.at(where, f"{quote(value)} is not positive (give a length above 0)")
    return checked
