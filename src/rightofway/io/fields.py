"""Fields of documents: the base of all documents, and their kinds of values."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Annotated, Any, Literal, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PlainValidator,
    ValidationInfo,
    WithJsonSchema,
    create_model,
)

from rightofway.kinds.table import (
    AMOUNT,
    COUNT,
    LINE,
    NAME,
    NOT_NEGATIVE,
    NUMBER,
    POSITION,
    POSITIVE,
    SEED,
    SHARE,
    TEXT,
    TICK_LENGTH,
    TICKS,
    WHOLE,
    Kind,
    Schema,
    allow_words,
    tuple_of,
)
from rightofway.model.actions import ACTIONS, StopAction
from rightofway.model.attributes import list_attributes
from rightofway.site import VertexId
from rightofway.units import CLOCK_TIME, is_clock_time


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


def _read_place(value: object, info: ValidationInfo) -> Any:
    """Return the vertex at a place of the map in the context; without one, the place as written."""
    return info.context.find(value) if info.context else value


def _make_moment_reader(kind: Kind[Fraction]) -> Callable[[Any, ValidationInfo], Fraction]:
    """Return the reader of points in time: numbers of a kind, or times of day.

    The map in the context has the start. Without one, a time of day is any time: its faults would
    follow from those of the map.
    """

    def read(value: object, info: ValidationInfo) -> Fraction:
        if not is_clock_time(value):
            return kind.read(value)
        time: Fraction = info.context.units.read_clock_time(value) if info.context else Fraction(1)
        return kind.read(time)

    return read


def _split_lines(value: object) -> object:
    return value.strip("\n").split("\n") if isinstance(value, str) else value


_CELL: Schema = {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2}
_SPOT: Schema = {
    "type": "object",
    "properties": {"x": NUMBER.schema, "y": NUMBER.schema},
    "required": ["x", "y"],
    "additionalProperties": False,
}
_MOMENT: Schema = {
    "anyOf": [
        *NOT_NEGATIVE.schema["anyOf"],
        {"type": "string", "pattern": f"^{CLOCK_TIME.pattern}$"},
    ]
}
_TEXTS: Schema = {"type": "array", "items": TEXT.schema}

Positive = Annotated[Fraction, POSITIVE]
NotNegative = Annotated[Fraction, NOT_NEGATIVE]
Share = Annotated[Fraction, SHARE]
Angle = Annotated[Fraction, NUMBER]
TickLength = Annotated[Fraction, TICK_LENGTH]
Count = Annotated[int, COUNT]
Amount = Annotated[int, AMOUNT]
Whole = Annotated[int, WHOLE]
Ticks = Annotated[int, TICKS]
Seed = Annotated[int, SEED]
Name = Annotated[str, NAME]
Words = Annotated[str, LINE]
CellSize = Annotated[
    Fraction | Literal["clustered", "adaptive"], allow_words(POSITIVE, "clustered", "adaptive")
]
Spacing = Annotated[Fraction | Literal["auto", "whole"], allow_words(POSITIVE, "auto", "whole")]
Position = Annotated[tuple[Fraction, Fraction], POSITION]
Size = Annotated[tuple[Fraction, Fraction], tuple_of(NUMBER, "width", "height")]
RobotSize = Annotated[tuple[Fraction, Fraction], tuple_of(NUMBER, "length", "width")]
Rectangle = Annotated[
    tuple[Fraction, Fraction, Fraction, Fraction], tuple_of(NUMBER, "x", "y", "width", "height")
]
Moment = Annotated[
    Fraction, PlainValidator(_make_moment_reader(NOT_NEGATIVE)), WithJsonSchema(_MOMENT)
]
End = Annotated[Fraction, PlainValidator(_make_moment_reader(POSITIVE)), WithJsonSchema(_MOMENT)]
Place = Annotated[
    VertexId,
    PlainValidator(_read_place),
    WithJsonSchema({"anyOf": [NAME.schema, _CELL, _SPOT]}),
]
Actions = Annotated[tuple[StopAction, ...], ACTIONS]
Lines = Annotated[
    list[str], BeforeValidator(_split_lines), WithJsonSchema({"anyOf": [TEXT.schema, _TEXTS]})
]

D = TypeVar("D", bound=type[Document])


def add_attributes(owner: type, but: str = "") -> Callable[[D], D]:
    """Return a decorator that adds the attributes of robots or rules to a document, ``but`` one."""

    def add(document: D) -> D:
        fields: dict[str, Any] = {
            attribute.name: (
                Annotated[Any, attribute.kind],
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
