"""Attributes of robots and rules: one field of a dataclass each, which everything else follows.

The check of values, the schema of files, readers, writers, the hints of workbooks and the list of
changes take kinds, keys and sentences from here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import cache
from typing import Any, Literal, get_args

from rightofway.values import (
    allow_none,
    format_number,
    make_word_reader,
    read_label,
    read_number,
    read_truth,
    read_turning,
    read_whole_number,
)

Kind = Literal["positive", "not negative", "turning", "count", "name", "truth"]

READERS: dict[Kind, Callable[[object], object]] = {
    "positive": read_number,
    "not negative": read_number,
    "turning": read_turning,
    "count": read_whole_number,
    "name": read_label,
    "truth": read_truth,
}
"""How a value of each kind is checked in Python; `Scenario` checks the ranges."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribute:
    """An attribute of robots or rules.

    Attributes
    ----------
    name, key
        Its name in Python and its key in files, which is the name unless that is another word.
    kind
        The kind of its values; for words the ``Literal`` of them.
    description
        What to give: in the schema, in messages (in brackets) and as a hint in workbooks.
    default
        Its value where none is given; None in a robot follows the rules.
    measure
        What it measures, for reports.
    unset
        What reports say for None.
    is_always_written
        Whether files have it although it has its default.
    """

    name: str
    key: str
    kind: Any
    description: str
    default: Any
    measure: Literal["speed", "length", "time", ""]
    unset: str
    is_always_written: bool

    @property
    def words(self) -> tuple[str, ...]:
        """The words that it may hold, where these are few."""
        return ("true", "false") if self.kind == "truth" else get_args(self.kind)

    @property
    def is_text(self) -> bool:
        """Whether its values are text, also where they look like numbers."""
        return self.kind == "name" or bool(get_args(self.kind))


def make_attribute(
    kind: Any,
    description: str,
    *,
    key: str | None = None,
    measure: Literal["speed", "length", "time", ""] = "",
    unset: str = "as the rules say",
    always: bool = False,
) -> dict[str, Any]:
    """Return the metadata of a dataclass's field that is an `Attribute`."""
    known = {"kind": kind, "description": description, "measure": measure, "unset": unset}
    return {"attribute": known | {"key": key, "is_always_written": always}}


@cache
def list_attributes(owner: Any) -> tuple[Attribute, ...]:
    """Return the attributes of a dataclass in the order of files."""
    return tuple(
        Attribute(
            name=attribute_field.name,
            default=attribute_field.default,
            **{**known, "key": known["key"] or attribute_field.name},
        )
        for attribute_field in fields(owner)
        if (known := attribute_field.metadata.get("attribute"))
    )


@cache
def list_readers(owner: Any) -> dict[str, Callable[[object], object]]:
    """Return for each attribute of a dataclass how its value is checked, for `coerced`."""
    readers = {}
    for attribute_of_owner in list_attributes(owner):
        read = (
            make_word_reader(words)
            if (words := get_args(attribute_of_owner.kind))
            else READERS[attribute_of_owner.kind]
        )
        readers[attribute_of_owner.name] = (
            allow_none(read) if attribute_of_owner.default is None else read
        )
    return readers


def list_plain_attributes(value: Any) -> dict[str, Any]:
    """Return the attributes of a robot or of rules by their keys in files, as plain data."""
    owner: Any = type(value)
    return {
        own_attribute.key: format_number(own) if isinstance(own, Fraction) else own
        for own_attribute in list_attributes(owner)
        if (own := getattr(value, own_attribute.name)) is not None
        and (own_attribute.is_always_written or own != own_attribute.default)
    }
