"""Fields of documents: the base of all documents, and their kinds of values.

A document declares its fields once. `quick_reader` reads documents without faults by these
declarations, and `models` makes the model of pydantic for all other data and for JSON Schema.
"""

from __future__ import annotations

from collections.abc import Callable, KeysView, Mapping
from dataclasses import FrozenInstanceError, dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NoReturn, TypeVar

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

if TYPE_CHECKING:
    from pydantic_core import CoreSchema

REQUIRED = object()
"""The default of fields without one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DocumentField:
    """A field of a document.

    Attributes
    ----------
    description
        What to give: in the schema, and in messages.
    default
        Its value where none is given, or `REQUIRED`.
    alias
        Its key in files; by default the name of the field.
    limits
        Limits on its value by the names that pydantic has for them.
    """

    description: str
    default: Any
    alias: str | None
    limits: Mapping[str, int]


def make_field(
    description: str, *, default: Any = REQUIRED, alias: str | None = None, **limits: int
) -> Any:
    """Return a field of a document; one without a default must be given."""
    return DocumentField(description=description, default=default, alias=alias, limits=limits)


def make_optional(description: str, **more: Any) -> Any:
    """Return a field that may be left out, and holds None then; a written null is refused."""
    return make_field(description, default=None, **more)


class Document:
    """A mapping in a document.

    A subclass may define ``read_short``, which makes a mapping of a shorter form of the data, and
    ``extend_schema``, which adds this form to the JSON Schema of the mapping.

    Parameters
    ----------
    values
        The fields that were written, by name, each of its kind; others have their defaults.

    Raises
    ------
    ValueError
        If the fields do not fit each other.
    """

    fields: ClassVar[Mapping[str, DocumentField]] = {}
    """The fields by name, in the order of the declarations."""
    schema_extra: ClassVar[Schema] = {}
    """Entries of the JSON Schema that the fields do not give."""

    def __init_subclass__(cls) -> None:
        cls.adopt_fields()

    def __init__(self, values: Mapping[str, Any]) -> None:
        vars(self).update(values)
        self.check()

    def __setattr__(self, name: str, _value: Any) -> NoReturn:
        raise FrozenInstanceError(name)

    @classmethod
    def adopt_fields(cls) -> None:
        """Move the fields of the class to `fields`; their defaults become class attributes."""
        own = {name: value for name, value in vars(cls).items() if isinstance(value, DocumentField)}
        cls.fields = {**cls.fields, **own}
        for name, field in own.items():
            if field.default is REQUIRED:
                delattr(cls, name)
            else:
                setattr(cls, name, field.default)

    @classmethod
    def __get_pydantic_core_schema__(cls, _source: Any, handler: Any) -> CoreSchema:
        from rightofway.io.models import make_core_schema

        return make_core_schema(cls, handler)

    def check(self) -> None:
        """Raise a ValueError if the fields do not fit each other."""

    @property
    def given(self) -> KeysView[str]:
        """The names of the fields that were written."""
        return vars(self).keys()

    def get_given(self, *fields: str) -> dict[str, Any]:
        """Return those of the fields that were written."""
        return {name: getattr(self, name) for name in fields if name in self.given}

    def get_all(self) -> dict[str, Any]:
        """Return all fields by name."""
        return {name: getattr(self, name) for name in self.fields}

    def get_own_attributes(self, owner: type) -> dict[str, Any]:
        """Return those of the attributes of robots or rules that were written."""
        return self.get_given(*(attribute.name for attribute in list_attributes(owner)))


def choose_exactly_one(document: Document, kinds: tuple[str, ...]) -> str:
    """Return which one of several keys for a map was written; ValueError if not exactly one."""
    given_kinds = [kind for kind in kinds if kind in document.given]
    if len(given_kinds) != 1:
        subject = f"{' and '.join(given_kinds)} are" if given_kinds else "no map is"
        raise ValueError(f"{subject} given (give exactly one of {', '.join(kinds)})")
    return given_kinds[0]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class FieldReader:
    """The reader of a field for which a kind is not enough.

    Attributes
    ----------
    read
        Returns the value of the field from the data and the context of the document, or raises a
        ValueError.
    schema
        Its JSON Schema; None for that of the type.
    is_first
        Whether its result is still read by the type of the field.
    """

    read: Callable[[Any, Any], Any]
    schema: Schema | None = None
    is_first: bool = False

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> CoreSchema:
        from pydantic_core import core_schema as core

        def read(value: Any, info: core.ValidationInfo) -> Any:
            return self.read(value, info.context)

        if self.is_first:
            return core.with_info_before_validator_function(read, handler(source))
        return core.with_info_plain_validator_function(read)

    def __get_pydantic_json_schema__(self, core: Any, handler: Any) -> Schema:
        schema: Schema = handler(core) if self.schema is None else dict(self.schema)
        return schema


def _read_place(value: object, context: Any) -> Any:
    """Return the vertex at a place of the map in the context; without one, the place as written."""
    return context.find(value) if context else value


def _make_moment_reader(kind: Kind[Fraction]) -> Callable[[Any, Any], Fraction]:
    """Return the reader of points in time: numbers of a kind, or times of day.

    The map in the context has the start. Without one, a time of day is any time: its faults would
    follow from those of the map.
    """

    def read(value: object, context: Any) -> Fraction:
        if not is_clock_time(value):
            return kind.read(value)
        time: Fraction = context.units.read_clock_time(value) if context else Fraction(1)
        return kind.read(time)

    return read


def _split_lines(value: object, _context: Any) -> object:
    return value.strip("\n").split("\n") if isinstance(value, str) else value


def _pair_items(value: object, _context: Any) -> object:
    pairs = isinstance(value, list) and all(isinstance(pair, list) for pair in value)
    return [tuple(pair) for pair in value] if pairs else value  # type: ignore[attr-defined]


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
Moment = Annotated[Fraction, FieldReader(read=_make_moment_reader(NOT_NEGATIVE), schema=_MOMENT)]
End = Annotated[Fraction, FieldReader(read=_make_moment_reader(POSITIVE), schema=_MOMENT)]
Place = Annotated[
    VertexId, FieldReader(read=_read_place, schema={"anyOf": [NAME.schema, _CELL, _SPOT]})
]
Actions = Annotated[tuple[StopAction, ...], ACTIONS]
Lines = Annotated[
    list[str],
    FieldReader(read=_split_lines, schema={"anyOf": [TEXT.schema, _TEXTS]}, is_first=True),
]
Pairs = Annotated[list[tuple[Name, Name]], FieldReader(read=_pair_items, is_first=True)]

D = TypeVar("D", bound=type[Document])


def add_attributes(owner: type, but: str = "") -> Callable[[D], D]:
    """Return a decorator that adds the attributes of robots or rules to a document, ``but`` one."""

    def add(document: D) -> D:
        for attribute in list_attributes(owner):
            if attribute.name != but:
                alias = None if attribute.key == attribute.name else attribute.key
                field = make_optional(attribute.description, alias=alias)
                setattr(document, attribute.name, field)
                document.__annotations__[attribute.name] = Annotated[Any, attribute.kind]
        document.adopt_fields()
        return document

    return add
