"""The table of kinds of values, by which everything that comes from a user is checked.

A `Kind` has a name, a reader, a JSON Schema and a remedy. Fields of documents and options of
planners name a kind in their annotation, ``Annotated[Fraction, POSITIVE]``; attributes of robots
and rules name it in `make_attribute`; other code calls ``POSITIVE.read_at("speed", speed)``.

A reader converts to one type: numbers to exact fractions, whole numbers of NumPy to int, lists to
tuples. A truth value is no number, text is no list, and None belongs to no kind but `allow_none`.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any, Generic, Literal, TypeGuard, TypeVar, cast

import numpy as np

from rightofway.errors import InputError, InputFault, Where, is_printable, quote
from rightofway.kinds.numbers import (
    COORDINATE_DIGITS,
    PATTERN,
    read_coordinate,
    read_exact,
    read_number,
)

if TYPE_CHECKING:
    from pydantic_core import CoreSchema

T = TypeVar("T")

Schema = dict[str, Any]


@dataclass(frozen=True, slots=True, eq=False)
class Kind(Generic[T]):
    """A kind of values.

    Attributes
    ----------
    name
        What to give, with its article: ``a number above 0``.
    schema
        Its JSON Schema; empty for values that no document contains.
    read
        Returns the value in its one type, or raises a ValueError: the value, the fault, and the
        remedy in brackets; an InputError for faults of items.
    """

    name: str
    schema: Schema
    read: Callable[[Any], T]

    @property
    def bounds(self) -> tuple[int | None, int | None]:
        """The least and the largest number; None where there is none."""
        schema = self.schema.get("anyOf", [self.schema])[0]
        return schema.get("minimum"), schema.get("maximum")

    @property
    def words(self) -> tuple[str, ...]:
        """The words of which it is one; empty for other kinds."""
        return tuple(self.schema.get("enum", ()))

    def read_at(self, where: Where, value: object) -> T:
        """Return a value in its one type.

        Raises
        ------
        InputError
            At the place, if the value is of another kind.
        """
        try:
            return self.read(value)
        except ValueError as error:
            raise InputError(_place_faults(where, error)) from None

    def __get_pydantic_core_schema__(self, _source: Any, _handler: Any) -> CoreSchema:
        """Return the check of a field of a document.

        JSON's own types are checked by pydantic: in its faults the remedy is the description of
        the field, and it needs no call of Python for each number of a long list.
        """
        from pydantic_core import core_schema as core

        if self.words:
            return core.literal_schema(list(self.words))
        least, most = self.bounds
        match self.schema.get("type"):
            case "boolean":
                return core.bool_schema(strict=True)
            case "integer":
                return core.int_schema(ge=least, le=most, strict=True)
            case "string":
                text = core.str_schema(strict=True)
                return core.no_info_after_validator_function(self.read, text)
        return core.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, _core: Any, _handler: Any) -> Schema:
        """Return the JSON Schema."""
        return dict(self.schema)


def _place_faults(where: Where, error: ValueError) -> list[InputFault]:
    """Return the faults of a value that was refused, at its place."""
    if isinstance(error, InputError):
        return [fault.nest(where) for fault in error.faults]
    return [InputFault(where, str(error))]


def coerce_fields(value: object, source: str, **kinds: Kind[Any]) -> None:
    """Replace fields of a frozen value by what their kinds read.

    Raises
    ------
    InputError
        With every field that is of another kind.
    """
    faults = list[InputFault]()
    for name, kind in kinds.items():
        try:
            object.__setattr__(value, name, kind.read(getattr(value, name)))
        except ValueError as error:
            faults += _place_faults(name, error)
    if faults:
        raise InputError(faults, source)


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is a whole number, of Python or of NumPy; a truth value is none."""
    # Asking for the type first spares a search of the registry of `Integral` for each int.
    return type(value) is int or (isinstance(value, Integral) and not isinstance(value, bool))


def make_kind(
    name: str,
    holds: Callable[[Any], bool] | type | tuple[type, ...],
    fault: str = "does not fit",
    *,
    remedy: str = "",
    base: Callable[[Any], Any] = lambda value: value,
    convert: Callable[[Any], Any] = lambda value: value,
    schema: Schema | None = None,
) -> Kind[Any]:
    """Return the kind of the values of classes, or of those for which a condition holds.

    The message on another value is its ``fault`` and, in brackets, the ``remedy``. ``base`` reads a
    value before the condition, ``convert`` makes the one type after it.
    """

    def read(value: object) -> Any:
        result = base(value)
        fits = isinstance(result, holds) if isinstance(holds, type | tuple) else holds(result)
        if not fits:
            raise ValueError(f"{quote(value)} {fault} ({remedy or f'give {name}'})")
        return convert(result)

    return Kind(name, schema or {}, read)


def make_number_schema(**bounds: int) -> Schema:
    """Return the schema of exact numbers; with bounds, text has no minus sign."""
    pattern = PATTERN.replace("[+-]?", "[+]?" if bounds else "[+-]?", 1)
    return {"anyOf": [{"type": "number", **bounds}, {"type": "string", "pattern": f"^{pattern}$"}]}


def _name_range(noun: str, least: object, most: object) -> str:
    if most is not None:
        return f"{noun} from {least} to {most}"
    return noun if least is None else f"{noun} of {least} or more"


def _is_between(number: Any, least: float | None, most: float | None) -> bool:
    return (least is None or least <= number) and (most is None or number <= most)


def make_whole(least: int | None = None, most: int | None = None, name: str = "") -> Kind[int]:
    """Return the kind of whole numbers.

    Parameters
    ----------
    least, most
        The bounds, both included; None for no bound.
    name
        A noun phrase with its article; by default, it names the bounds.
    """
    bounds = {"minimum": least, "maximum": most}
    return make_kind(
        name or _name_range("a whole number", least, most),
        lambda value: is_whole(value) and _is_between(value, least, most),
        convert=int,
        schema={"type": "integer"}
        | {key: bound for key, bound in bounds.items() if bound is not None},
    )


def make_number(least: int, most: int | None = None) -> Kind[Fraction]:
    """Return the kind of exact numbers.

    Parameters
    ----------
    least, most
        The bounds, both included; None for no upper bound.
    """
    bounds = {"minimum": least} | ({} if most is None else {"maximum": most})
    return make_kind(
        _name_range("a number", least, most),
        lambda number: _is_between(number, least, most),
        base=read_number,
        schema=make_number_schema(**bounds),
    )


def make_words(*words: str) -> Kind[str]:
    """Return the kind of one of several words.

    Parameters
    ----------
    words
        All of them.
    """
    *others, last = words
    return make_kind(
        f"{', '.join(others)} or {last}" if others else last,
        lambda value: isinstance(value, str) and value in words,
        "is unknown",
        schema={"enum": list(words), "type": "string"},
    )


REMEDIES = {
    "Battery": "give Battery(drive=share)",
    "CyclicResult": "simulate laps with rightofway.run_laps",
    "ExecutionTrace": "give a trace of rightofway.simulate",
    "Job": "give Job(name=text, stops=list)",
    "JobStop": "give JobStop(at=vertex, work=time)",
    "PlaceActions": "give PlaceActions(at=vertex, pick=list)",
    "Plan": "load a file with rightofway.load_plan",
    "RobotState": "give RobotState(at=vertex)",
    "Roadmap": "give a Roadmap, or build the fleet with FleetBuilder",
    "Scenario": "load a file with rightofway.load, or build a fleet with FleetBuilder",
    "Stop": "give Stop(at=vertex, work=time)",
    "Track": "make it with Track.of(vertices, enter)",
}
"""The remedies for objects that are not made by a call of their class."""


def make_class(kind: type[T]) -> Kind[T]:
    """Return the kind of the objects of a class."""
    noun = kind.__name__
    name = f"an {noun}" if noun[0] in "AEIO" else f"a {noun}"
    return make_kind(name, kind, f"is no {noun}", remedy=REMEDIES.get(noun, ""))


def allow_none(kind: Kind[T]) -> Kind[T | None]:
    """Return the kind to which None belongs as well."""
    return Kind(
        f"{kind.name} or None",
        kind.schema,
        lambda value: None if value is None else kind.read(value),
    )


def allow_words(kind: Kind[T], *words: str) -> Kind[T | str]:
    """Return the kind to which some words belong as well."""
    possible = f"{' and '.join(map(repr, words))} {'are' if len(words) > 1 else 'is'} possible too"

    def read(value: object) -> T | str:
        if isinstance(value, str) and value in words:
            return value
        try:
            return kind.read(value)
        except ValueError as error:
            raise ValueError(f"{error}; {possible}") from None

    name = f"{kind.name} or {' or '.join(map(repr, words))}"
    schema = {"anyOf": [*({"const": word} for word in words), kind.schema]}
    return Kind(name, schema, read)


def list_of(kind: Kind[T], *, admits: Any = Iterable) -> Kind[tuple[T, ...]]:
    """Return the kind of lists of the classes ``admits``; text and mappings are none."""

    def read(values: object) -> tuple[T, ...]:
        if not isinstance(values, admits) or isinstance(values, str | bytes | Mapping):
            raise ValueError(f"{quote(values)} is no list (give {name})")  # noqa: TRY004 (readers raise it)
        return tuple(kind.read_at(index, value) for index, value in enumerate(values))

    name = f"a list, each {kind.name}"
    return Kind(name, {"type": "array", "items": kind.schema}, read)


def tuple_of(kinds: Kind[Any] | tuple[Kind[Any], ...], *parts: str) -> Kind[tuple[Any, ...]]:
    """Return the kind of tuples or lists with as many values as parts, all of one kind or each."""
    form = f"[{', '.join(parts)}]"
    items = kinds if isinstance(kinds, tuple) else (kinds,) * len(parts)

    def read(values: object) -> tuple[Any, ...]:
        if not isinstance(values, list | tuple) or len(values) != len(parts):
            raise ValueError(f"{quote(values)} does not fit (give {form})")
        return tuple(kind.read(value) for kind, value in zip(items, values, strict=True))

    length = {"minItems": len(parts), "maxItems": len(parts)}
    return Kind(form, {"type": "array", "items": items[0].schema} | length, read)


def mapping_of(kind: Kind[T], *, in_order: bool = False) -> Kind[tuple[tuple[str, T], ...]]:
    """Return the kind of mappings of names, kept as pairs; pairs may be given, too."""
    name = f"a mapping of names, each to {kind.name}"

    def read(value: object) -> tuple[tuple[str, T], ...]:
        pairs = tuple(value.items()) if isinstance(value, Mapping) else value
        if not isinstance(pairs, list | tuple) or not all(
            isinstance(pair, list | tuple) and len(pair) == 2 and isinstance(pair[0], str)  # noqa: PLR2004
            for pair in pairs
        ):
            raise ValueError(f"{quote(value)} is no mapping (give {name})")
        entries = sorted(dict(pairs).items()) if in_order else pairs
        return tuple((key, kind.read_at(key, item)) for key, item in entries)

    return Kind(name, {}, read)


STRING: Schema = {"type": "string"}


def _is_real(value: object) -> TypeGuard[float]:
    return isinstance(value, Real) and not isinstance(value, bool)


ANYTHING = make_kind("anything", object)
TRUTH = make_kind(
    "true or false",
    (bool, np.bool_),
    "is neither true nor false",
    convert=bool,
    schema={"type": "boolean"},
)
TEXT = make_kind("text", str, "is no text", schema=STRING)
NAME = make_kind(
    "text",
    lambda value: isinstance(value, str) and is_printable(value),
    "is no name",
    remedy="give characters that can be printed",
    schema=STRING | {"minLength": 1},
)
LINE = make_kind(
    "text",
    lambda value: isinstance(value, str) and (not value or is_printable(value)),
    "cannot be shown",
    remedy="give printable text on one line",
    schema=STRING,
)
NAMES: Kind[frozenset[str]] = Kind(
    "a list of texts", {}, lambda value: frozenset(list_of(TEXT).read(value))
)
TIME_LIMIT: Kind[float | None] = make_kind(
    "0 or more, or None for no limit",
    lambda value: value is None or (_is_real(value) and value >= 0),
    "is no number of seconds",
    convert=lambda value: None if value is None or value > sys.float_info.max else float(value),
)
"""Seconds; a limit above every float is none."""
PATH = make_kind("a path", (str, os.PathLike), "is no path")
FUNCTION = make_kind("a function", callable, "is no function")

COUNT = make_whole(1)
AMOUNT = make_whole(0)
WHOLE = make_whole(-(2**63) + 1, 2**63 - 1, "a whole number")
"""Whole numbers that an array can contain."""
SEED = make_whole(0, 2**32 - 1)
"""Planners draw from this many streams."""
TICKS = make_whole(-(2**53) + 1, 2**53 - 1)
"""Times in a plan; every reader represents them exactly, JavaScript too."""
VERTEX = make_kind(
    "a vertex",
    is_whole,
    "is no vertex number",
    convert=int,
    remedy="give roadmap.get_vertex(name), or build the fleet with FleetBuilder, which takes names",
)

NUMBER: Kind[Fraction] = Kind("a number", make_number_schema(), read_number)
COORDINATE: Kind[Fraction] = Kind("a coordinate", make_number_schema(), read_coordinate)
POSITION = tuple_of(COORDINATE, "x", "y")
TICK_LENGTH: Kind[Fraction] = Kind(
    "a number", make_number_schema(), lambda value: read_exact(value, digits=COORDINATE_DIGITS)
)
POSITIVE: Kind[Fraction] = make_kind(
    "a number above 0",
    lambda number: number > 0,
    "is not positive",
    base=read_number,
    schema=make_number_schema(exclusiveMinimum=0),
)


def _read_not_negative(value: object) -> Fraction:
    if type(value) is Fraction and value.numerator >= 0:  # a shift has a million
        return value
    number = read_number(value)
    if number < 0 or (number == 0 and str(value).startswith("-")):
        raise ValueError(f"{quote(value)} is negative (give 0 or more)")
    return number


NOT_NEGATIVE: Kind[Fraction] = Kind(
    "a number of 0 or more", make_number_schema(minimum=0), _read_not_negative
)
SHARE: Kind[Fraction] = make_kind(
    "a share from 0 to 1",
    lambda number: number <= 1,
    "is above 1",
    base=_read_not_negative,
    schema=make_number_schema(minimum=0, maximum=1),
)
TURNING = cast("Kind[Fraction | Literal['cell']]", allow_words(NOT_NEGATIVE, "cell"))


def make_range(least: float, most: float) -> Kind[float]:
    """Return the kind of numbers that need not be exact, from ``least`` to ``most``."""
    return make_kind(
        f"a number from {least:g} to {most:g}",
        lambda value: (
            isinstance(value, Real)
            and not isinstance(value, bool)
            and _is_between(value, least, most)
        ),
        convert=float,
    )


TypeSpeeds = tuple[tuple[str, Fraction], ...]
"""Types of robots, each once, with a speed [length unit per time unit]; sorted by their names."""


TYPE_SPEEDS: Kind[TypeSpeeds] = mapping_of(POSITIVE, in_order=True)


def require_index(where: Where, index: int, count: int) -> int:
    """Return the number of one of ``count`` items.

    Raises
    ------
    InputError
        If there is none of this number.
    """
    if not is_whole(index) or not 0 <= index < count:
        known = f"give 0 to {count - 1}" if count else "there are none"
        raise InputError.at(where, f"{quote(index)} is none of {count} ({known})")
    return int(index)


def require_one_for_each(robots: Any, **lists: Any) -> None:
    """Refuse lists that do not have one item for each robot, by the names of the arguments.

    Raises
    ------
    InputError
        With each list of another length.
    """
    faults = [
        InputFault(name, f"it has {len(items)} (give {len(robots)}, one for each robot)")
        for name, items in lists.items()
        if len(items) != len(robots)
    ]
    if faults:
        raise InputError(faults)
