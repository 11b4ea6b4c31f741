"""A value of a file and its place in that file: the input of the readers of all formats.

JSON, YAML and graphs become mappings and lists, with a path; elements of XML and rows of CSV become
mappings, with a line. A value that does not fit is a fault at its place.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from rightofway.errors import InputError, Location, Steps, is_printable, quote
from rightofway.kinds.numbers import read_coordinate

BILLION = 10**9

LONGEST_NAME = 200
"""Characters of the longest name."""

TRUE, FALSE = ("true", "yes", "1"), ("false", "no", "0", "")
"""How files write whether something holds, in any case of letters."""


@dataclass(slots=True)
class Source:
    """A value of a file, and the keys, the indices and the line that lead to it."""

    value: Any
    path: Steps = ()
    line: int | None = None

    @property
    def location(self) -> Location:
        """Its place in the file."""
        return Location(path=self.path, line=self.line)

    def make_fault(self, message: str) -> InputError:
        """Return the fault that this value is."""
        return InputError.at(self.location, message)

    def make_child(self, step: str | int, value: Any) -> Source:
        """Return a value inside this one."""
        return Source(value, (*self.path, step), self.line)

    def get(self, *keys: str) -> Source | None:
        """Return the value under the first of several keys that has one, or None."""
        mapping = self.value if type(self.value) is dict else self.read_mapping()
        for key in keys:
            value = mapping.get(key)
            if value is not None:
                return Source(value, (*self.path, key), self.line)
        return None

    def need(self, *keys: str) -> Source:
        """Return the value under the first of several keys that has one."""
        value_found = self.get(*keys)
        if value_found is None:
            raise self.make_child(keys[0], None).make_fault("is missing (add it)")
        return value_found

    def read_mapping(self) -> dict[str, Any]:
        """Return the value as a mapping."""
        if not isinstance(self.value, dict):
            raise self.make_fault(
                f"{quote(self.value)} is not a mapping of keys to values (mend it)"
            )
        return self.value

    def read_entries(self) -> Iterator[tuple[str, Source]]:
        """Yield keys and values of a mapping."""
        for key, value in self.read_mapping().items():
            yield key, self.make_child(key, value)

    def read_items(self) -> list[Source]:
        """Return the items of a list."""
        if not isinstance(self.value, list):
            raise self.make_fault(f"{quote(self.value)} is not a list (mend it)")
        return [self.make_child(index, item) for index, item in enumerate(self.value)]

    def read_items_under(self, *keys: str) -> list[Source]:
        """Return the items of all lists that stand under some keys; none for a missing one."""
        lists = (self.get(key) for key in keys)
        return [item for listed in lists if listed is not None for item in listed.read_items()]

    def read_text(self) -> str:
        """Return the value as text that can be shown; whole numbers count as text."""
        value = self.value
        if isinstance(value, int) and not isinstance(value, bool):
            value = str(value)
        if not isinstance(value, str) or not is_printable(value) or len(value) > LONGEST_NAME:
            raise self.make_fault(f"{quote(self.value)} is no name (give printable text)")
        return value

    def number(self, most: int = BILLION) -> Fraction:
        """Return the value as a number, to a billionth; text counts where a number is written.

        ``most`` is the largest number.
        """
        value = self.value
        read = _number if isinstance(value, Hashable) else _number.__wrapped__
        try:
            return read(value, most)
        except ValueError as error:
            raise self.make_fault(str(error)) from None

    def read_whole(self, least: int, most: int) -> int:
        """Return the value as a whole number within bounds."""
        if type(self.value) is not int or not least <= self.value <= most:
            message = f"{quote(self.value)} does not fit"
            raise self.make_fault(f"{message} (give a whole number from {least} to {most})")
        return self.value

    def read_flag(self) -> bool:
        """Return the value as true or false; 0 and 1 count, too."""
        word = self.value.lower() if isinstance(self.value, str) else self.value
        if word in (True, *TRUE):
            return True
        if word in (False, *FALSE):
            return False
        raise self.make_fault(f"{quote(self.value)} is neither true nor false (mend it)")


@lru_cache(maxsize=2**16, typed=True)  # the numbers of a site repeat
def _number(value: Hashable, most: int) -> Fraction:
    number = read_coordinate(value.strip() if isinstance(value, str) else value)
    if abs(number.numerator) > most * number.denominator:
        raise ValueError(f"{quote(value)} is out of range (check the unit)")
    return (
        number if BILLION % number.denominator == 0 else Fraction(round(number * BILLION), BILLION)
    )
