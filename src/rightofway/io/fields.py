"""The kinds of values that documents are made of, each with its JSON Schema.

The check of a kind and its schema stand side by side, so that they agree.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Annotated, Any, Literal, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PlainValidator,
    ValidationInfo,
    WithJsonSchema,
    create_model,
)
from pydantic_core import CoreSchema, core_schema

from rightofway.errors import is_printable, quote
from rightofway.model.attributes import list_attributes
from rightofway.phrases import join_parts
from rightofway.site import VertexId
from rightofway.values import COORDINATE_DIGITS, PATTERN, read_coordinate, read_exact

MAX_TICK = 2**53 - 1
"""Times in a plan lie within this, so that every reader holds them exactly; JavaScript too."""

Schema = dict[str, Any]


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """What pydantic needs to know of a kind of values."""

    read: Callable[[Any], Any]  # raises a ValueError with the message for what does not fit
    schema: Schema

    def __get_pydantic_core_schema__(self, _source: Any, _handler: Any) -> CoreSchema:
        """Return the check."""
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, _core: Any, _handler: Any) -> Schema:
        """Return the JSON Schema."""
        return dict(self.schema)


def finish_schema(**extra: Any) -> Callable[[Schema], None]:
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
        json_schema_extra=finish_schema(),
    )

    def get_given(self, *fields: str) -> dict[str, Any]:
        """Return those of the fields that were written."""
        return {name: getattr(self, name) for name in fields if name in self.model_fields_set}

    def get_own_attributes(self, owner: type) -> dict[str, Any]:
        """Return those of the attributes of robots or rules that were written."""
        return self.get_given(*(attribute.name for attribute in list_attributes(owner)))


def make_optional(description: str, **limits: Any) -> Any:
    """Return a field that may be left out, and holds None then; a written null is refused."""
    return Field(default=None, description=description, **limits)


def choose_exactly_one(document: Document, kinds: tuple[str, ...]) -> str:
    """Return which one of several keys for a map was written; ValueError if not exactly one."""
    given_kinds = [kind for kind in kinds if kind in document.model_fields_set]
    if len(given_kinds) != 1:
        subject = f"{' and '.join(given_kinds)} are" if given_kinds else "no map is"
        raise ValueError(f"{subject} given (give exactly one of {', '.join(kinds)})")
    return given_kinds[0]


def read_positive(value: object) -> Fraction:
    """Return a number above 0; ValueError for any other value."""
    number = read_exact(value)
    if number <= 0:
        raise ValueError(f"{quote(value)} is not positive (give a number above 0)")
    return number


def _not_negative(value: object) -> Fraction:
    number = read_exact(value)
    if number < 0 or str(value).startswith("-"):
        raise ValueError(f"{quote(value)} is negative (give 0 or more)")
    return number


def _share(value: object) -> Fraction:
    number = _not_negative(value)
    if number > 1:
        raise ValueError(f"{quote(value)} is above 1 (give a share from 0 to 1)")
    return number


def _number_schema(**bounds: int) -> Schema:
    pattern = PATTERN.replace("[+-]?", "[+]?" if bounds else "[+-]?", 1)
    return {"anyOf": [{"type": "number", **bounds}, {"type": "string", "pattern": f"^{pattern}$"}]}


_ANY = _number_schema()
_NOT_NEGATIVE = _number_schema(minimum=0)
_POSITIVE = _number_schema(exclusiveMinimum=0)

Positive = Annotated[Fraction, Kind(read_positive, _POSITIVE)]
NotNegative = Annotated[Fraction, Kind(_not_negative, _NOT_NEGATIVE)]
Share = Annotated[Fraction, Kind(_share, _number_schema(minimum=0, maximum=1))]
Angle = Annotated[Fraction, Kind(read_exact, _ANY)]
TickLength = Annotated[Fraction, Kind(partial(read_exact, digits=COORDINATE_DIGITS), _ANY)]
Count = Annotated[int, Field(ge=1)]
Ticks = Annotated[int, Field(ge=-MAX_TICK, le=MAX_TICK)]


def _or_word(number: Callable[[object], Fraction], schema: Schema, *words: str) -> Kind:
    possible = f"{' and '.join(map(repr, words))} {'are' if len(words) > 1 else 'is'} possible too"

    def read(value: object) -> str | Fraction:
        if isinstance(value, str) and value in words:
            return value
        try:
            return number(value)
        except ValueError as error:
            raise ValueError(f"{error}; {possible}") from None

    return Kind(read, {"anyOf": [*({"const": word} for word in words), schema]})


CellSize = Annotated[
    Fraction | Literal["clustered", "adaptive"],
    _or_word(read_positive, _POSITIVE, "clustered", "adaptive"),
]
Spacing = Annotated[
    Fraction | Literal["auto", "whole"], _or_word(read_positive, _POSITIVE, "auto", "whole")
]
Turning = Annotated[Fraction | Literal["cell"], _or_word(_not_negative, _NOT_NEGATIVE, "cell")]


def _list_of(count: int, numbers: str, number: Callable[[object], Fraction]) -> Kind:
    def read(value: object) -> tuple[Fraction, ...]:
        if not isinstance(value, list | tuple) or len(value) != count:
            raise ValueError(f"{quote(value)} does not fit (give {numbers})")
        return tuple(number(item) for item in value)

    return Kind(read, {"type": "array", "items": _ANY, "minItems": count, "maxItems": count})


_Pair = tuple[Fraction, Fraction]
_Four = tuple[Fraction, Fraction, Fraction, Fraction]

POSITION = _list_of(2, "[x, y]", read_coordinate)

Position = Annotated[_Pair, POSITION]
Size = Annotated[_Pair, _list_of(2, "[width, height]", read_exact)]
RobotSize = Annotated[_Pair, _list_of(2, "[length, width]", read_exact)]
Rectangle = Annotated[_Four, _list_of(4, "[x, y, width, height]", read_exact)]


def _name(value: str) -> str:
    if not is_printable(value):
        raise ValueError(f"{quote(value)} is no name (give characters that can be printed)")
    return value


def _words(value: str) -> str:
    if value and not is_printable(value):
        raise ValueError(f"{quote(value)} cannot be shown (give printable text on one line)")
    return value


def _sentence(value: object) -> str:
    return _words(join_parts(value))


def _place(value: object, info: ValidationInfo) -> Any:
    """Return the vertex at a place of the map in the context; without one, the place as written."""
    return info.context.find(value) if info.context else value


def _lines(value: object) -> object:
    return value.strip("\n").split("\n") if isinstance(value, str) else value


_TEXT: Schema = {"type": "string", "minLength": 1}
_CELL: Schema = {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2}
_SPOT: Schema = {
    "type": "object",
    "properties": {"x": _ANY, "y": _ANY},
    "required": ["x", "y"],
    "additionalProperties": False,
}
_SENTENCE: Schema = {
    "anyOf": [
        {"type": "string"},
        {"type": "array", "prefixItems": [{"type": "string"}, {"type": "object"}], "minItems": 2},
    ]
}
_TEXTS: Schema = {"type": "array", "items": {"type": "string"}}

Name = Annotated[str, AfterValidator(_name), WithJsonSchema(_TEXT)]
Words = Annotated[str, AfterValidator(_words)]
Sentence = Annotated[str, Kind(_sentence, _SENTENCE)]
Place = Annotated[
    VertexId, PlainValidator(_place), WithJsonSchema({"anyOf": [_TEXT, _CELL, _SPOT]})
]
Lines = Annotated[
    list[str], BeforeValidator(_lines), WithJsonSchema({"anyOf": [{"type": "string"}, _TEXTS]})
]

KINDS: dict[str, Any] = {
    "positive": Positive,
    "not negative": NotNegative,
    "turning": Turning,
    "count": Count,
    "name": Name,
    "truth": bool,
}
"""How files hold the kinds of values of attributes; words are a ``Literal`` of their own."""

D = TypeVar("D", bound=type[Document])


def add_attributes(owner: type, but: str = "") -> Callable[[D], D]:
    """Return a decorator that adds the attributes of robots or rules to a document, ``but`` one."""

    def add(document: D) -> D:
        fields: dict[str, Any] = {
            attribute.name: (
                KINDS.get(attribute.kind, attribute.kind),
                make_optional(
                    attribute.description,
                    **({} if attribute.key == attribute.name else {"alias": attribute.key}),
                ),
            )
            for attribute in list_attributes(owner)
            if attribute.name != but
        }
        return create_model(  # type: ignore[return-value]
            document.__name__,
            __base__=document,
            __module__=document.__module__,
            __doc__=document.__doc__,
            **fields,
        )

    return add
