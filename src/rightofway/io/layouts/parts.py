"""Values inside layout files of JSON or YAML, each with its place; what does not fit is a fault."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from rightofway.errors import InputError, is_printable, shown
from rightofway.io.faults import place_of
from rightofway.values import DIGITS, coordinate

BILLION = 10**9

LONGEST_NAME = 200
"""Characters of the longest name."""


@dataclass(frozen=True, slots=True)
class Part:
    """A value inside a document, and the steps that lead to it."""

    value: Any
    steps: tuple[str | int, ...] = ()

    @property
    def place(self) -> str:
        """The place in the document."""
        return place_of(self.steps)

    def fault(self, message: str) -> InputError:
        """Return the fault that this value is."""
        return InputError.at(self.place, message)

    def get(self, key: str) -> Part | None:
        """Return the value under a key of a mapping, or None where it is missing or empty."""
        found = self.mapping().get(key)
        return None if found is None else Part(found, (*self.steps, key))

    def need(self, key: str) -> Part:
        """Return the value under a key of a mapping."""
        found = self.get(key)
        if found is None:
            raise Part(None, (*self.steps, key)).fault("is missing (add it)")
        return found

    def mapping(self) -> dict[str, Any]:
        """Return the value as a mapping."""
        if not isinstance(self.value, dict):
            raise self.fault(f"{shown(self.value)} is not a mapping of keys to values (mend it)")
        return self.value

    def entries(self) -> Iterator[tuple[str, Part]]:
        """Yield keys and values of a mapping."""
        for key, value in self.mapping().items():
            yield key, Part(value, (*self.steps, key))

    def items(self) -> list[Part]:
        """Return the items of a list."""
        if not isinstance(self.value, list):
            raise self.fault(f"{shown(self.value)} is not a list (mend it)")
        return [Part(item, (*self.steps, index)) for index, item in enumerate(self.value)]

    def text(self) -> str:
        """Return the value as text that can be shown; whole numbers count as text."""
        value = self.value
        if isinstance(value, int) and not isinstance(value, bool):
            value = str(value)
        if not isinstance(value, str) or not is_printable(value) or len(value) > LONGEST_NAME:
            raise self.fault(f"{shown(self.value)} is no name (give printable text)")
        return value

    def number(self) -> Fraction:
        """Return the value as a number; text counts where a number is written in it."""
        try:
            return number_in(self.value, "")
        except InputError as error:
            raise self.fault(error.faults[0].message) from None

    def flag(self) -> bool:
        """Return the value as true or false; 0 and 1 count, too."""
        if self.value not in (True, False):
            raise self.fault(f"{shown(self.value)} is neither true nor false (mend it)")
        return bool(self.value)


def number_in(value: object, place: str) -> Fraction:
    """Return a number of a file, to a billionth where it has more decimals.

    Raises
    ------
    InputError
        For anything else, and for numbers above a thousand million.
    """
    try:
        return _number(value) if isinstance(value, Hashable) else _number.__wrapped__(value)
    except ValueError as error:
        raise InputError.at(place, str(error)) from None


@lru_cache(maxsize=2**16, typed=True)  # the numbers of a site repeat
def _number(value: Hashable) -> Fraction:
    found = coordinate(value.strip() if isinstance(value, str) else value)
    if abs(found) > 10 ** (DIGITS // 2):
        raise ValueError(f"{shown(value)} is out of range (check the unit)")
    return found if BILLION % found.denominator == 0 else Fraction(round(found * BILLION), BILLION)
