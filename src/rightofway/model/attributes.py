"""Attributes of robots and rules: one field of a dataclass each, which everything else follows.

The check of values, the schema of files, readers, writers, the hints of workbooks and the list of
changes take kinds, keys and sentences from here.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from fractions import Fraction
from functools import cache
from typing import Any, Literal

from rightofway.kinds.numbers import format_number
from rightofway.kinds.table import TRUTH, Kind, allow_none


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribute:
    """An attribute of robots or rules.

    Attributes
    ----------
    name, key
        Its name in Python and its key in files, which is the name unless that is another word.
    kind
        The kind of its values.
    description
        What to give: in the schema, in messages (in brackets) and as a hint in workbooks.
    default
        Its value where none is given; None in a robot follows the rules.
    measure
        The quantity that it measures, for reports.
    unset
        What reports say for None.
    is_always_written
        Whether files have it although it has its default.
    """

    name: str
    key: str
    kind: Kind[Any]
    description: str
    default: Any
    measure: Literal["speed", "length", "time", ""]
    unset: str
    is_always_written: bool

    @property
    def words(self) -> tuple[str, ...]:
        """The words that it may hold, where these are few."""
        return ("true", "false") if self.kind is TRUTH else self.kind.words

    @property
    def is_text(self) -> bool:
        """Whether its values are text, also where they look like numbers."""
        return self.kind.schema.get("type") == "string"


def make_attribute(
    kind: Kind[Any],
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
def list_kinds(owner: Any) -> dict[str, Kind[Any]]:
    """Return the kinds of the attributes of a dataclass by name, for `coerce_fields`."""
    return {
        attribute.name: allow_none(attribute.kind) if attribute.default is None else attribute.kind
        for attribute in list_attributes(owner)
    }


def list_plain_attributes(value: Any) -> dict[str, Any]:
    """Return the attributes of a robot or of rules by their keys in files, as plain data."""
    owner: Any = type(value)
    return {
        own_attribute.key: format_number(own) if isinstance(own, Fraction) else own
        for own_attribute in list_attributes(owner)
        if (own := getattr(value, own_attribute.name)) is not None
        and (own_attribute.is_always_written or own != own_attribute.default)
    }
