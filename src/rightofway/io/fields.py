"""The kinds of values that documents are made of, each with its JSON Schema.

What is accepted and what the schema says stand side by side here, so that they agree.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PlainValidator,
    WithJsonSchema,
)

from rightofway.io.faults import is_printable, shown
from rightofway.io.numbers import COORDINATE_DIGITS, DIGITS, PATTERN, exact
from rightofway.io.scenario import places

__all__ = [
    "LEFT_OUT",
    "CellSize",
    "Count",
    "Document",
    "Lines",
    "Name",
    "NotNegative",
    "Place",
    "Position",
    "Positive",
    "Rectangle",
    "Size",
    "TickLength",
    "Ticks",
    "Turning",
    "Words",
    "described",
]

MAX_TICK = 2**53 - 1
"""Times in a plan lie within this, so that every reader holds them exactly; JavaScript too."""

LEFT_OUT: Any = None
"""What a key holds that may be left out, and was. It is outside the key's type: a null that
somebody wrote is refused like any other wrong value."""

Schema = dict[str, Any]


def described(**extra: Any) -> Callable[[Schema], None]:
    """Return how a document's schema is finished: with ``extra``, and no null as a default."""

    def finish(schema: Schema) -> None:
        for field in schema.get("properties", {}).values():
            if field.get("default", "") is None:
                del field["default"]
        schema.update(extra)

    return finish


class Document(BaseModel):
    """A mapping in a document."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        strict=True,
        arbitrary_types_allowed=True,
        json_schema_extra=described(),
    )

    def given(self, *fields: str) -> dict[str, Any]:
        """Return those of the fields that were written."""
        return {name: getattr(self, name) for name in fields if name in self.model_fields_set}


def _any_number(value: object) -> Fraction:
    return exact(value)


def _positive(value: object) -> Fraction:
    number = exact(value)
    if number <= 0:
        raise ValueError(f"{shown(value)} is not positive (give a number above 0)")
    return number


def _not_negative(value: object) -> Fraction:
    number = exact(value)
    if number < 0 or str(value).startswith("-"):
        raise ValueError(f"{shown(value)} is negative (give 0 or more)")
    return number


def _coordinate(value: object) -> Fraction:
    number = exact(value, digits=COORDINATE_DIGITS)
    if abs(number) > 10**DIGITS:
        raise ValueError(f"{shown(value)} is out of range (give at most {DIGITS} digits)")
    return number


def _tick_length(value: object) -> Fraction:
    return exact(value, digits=COORDINATE_DIGITS)


def _number_schema(**bounds: int) -> Schema:
    pattern = PATTERN.replace("[+-]?", "[+]?" if bounds else "[+-]?", 1)
    return {"anyOf": [{"type": "number", **bounds}, {"type": "string", "pattern": f"^{pattern}$"}]}


_ANY = _number_schema()
_NOT_NEGATIVE = _number_schema(minimum=0)

Positive = Annotated[
    Fraction, PlainValidator(_positive), WithJsonSchema(_number_schema(exclusiveMinimum=0))
]
NotNegative = Annotated[Fraction, PlainValidator(_not_negative), WithJsonSchema(_NOT_NEGATIVE)]
TickLength = Annotated[Fraction, PlainValidator(_tick_length), WithJsonSchema(_ANY)]
Count = Annotated[int, Field(ge=1)]
Ticks = Annotated[int, Field(ge=-MAX_TICK, le=MAX_TICK)]


def _or_word(word: str, number: Callable[[object], Fraction]) -> PlainValidator:
    def read(value: object) -> str | Fraction:
        if isinstance(value, str) and value == word:
            return word
        try:
            return number(value)
        except ValueError as error:
            raise ValueError(f"{error}; {word!r} is possible too") from None

    return PlainValidator(read)


CellSize = Annotated[
    Fraction | Literal["clustered"],
    _or_word("clustered", _positive),
    WithJsonSchema({"anyOf": [{"const": "clustered"}, _number_schema(exclusiveMinimum=0)]}),
]
Turning = Annotated[
    Fraction | Literal["cell"],
    _or_word("cell", _not_negative),
    WithJsonSchema({"anyOf": [{"const": "cell"}, _NOT_NEGATIVE]}),
]


def _list_of(count: int, what: str, number: Callable[[object], Fraction]) -> PlainValidator:
    def read(value: object) -> tuple[Fraction, ...]:
        if not isinstance(value, list | tuple) or len(value) != count:
            raise ValueError(f"{shown(value)} does not fit (give {what})")
        return tuple(number(item) for item in value)

    return PlainValidator(read)


def _list_schema(count: int) -> WithJsonSchema:
    return WithJsonSchema({"type": "array", "items": _ANY, "minItems": count, "maxItems": count})


Position = Annotated[tuple[Fraction, Fraction], _list_of(2, "[x, y]", _coordinate), _list_schema(2)]
Size = Annotated[
    tuple[Fraction, Fraction], _list_of(2, "[width, height]", _any_number), _list_schema(2)
]
Rectangle = Annotated[
    tuple[Fraction, Fraction, Fraction, Fraction],
    _list_of(4, "[x, y, width, height]", _any_number),
    _list_schema(4),
]


def _name(value: str) -> str:
    if not is_printable(value):
        raise ValueError(f"{shown(value)} is no name (give characters that can be printed)")
    return value


def _words(value: str) -> str:
    if value and not is_printable(value):
        raise ValueError(f"{shown(value)} cannot be shown (give printable text on one line)")
    return value


def _place(value: object) -> places.Place:
    place = places.as_place(value)
    if place is None:
        raise ValueError(f"{shown(value)} is no place (give N<k>, [row, column] or a vertex name)")
    return place


def _lines(value: object) -> object:
    return value.strip("\n").split("\n") if isinstance(value, str) else value


_TEXT: Schema = {"type": "string", "minLength": 1}

Name = Annotated[str, AfterValidator(_name), WithJsonSchema(_TEXT)]
Words = Annotated[str, AfterValidator(_words)]
Place = Annotated[
    places.Place,
    PlainValidator(_place),
    WithJsonSchema(
        {
            "anyOf": [
                _TEXT,
                {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2},
            ]
        }
    ),
]
Lines = Annotated[
    list[str],
    BeforeValidator(_lines),
    WithJsonSchema({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}),
]
