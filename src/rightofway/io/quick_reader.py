"""Documents without faults, read by the declarations of their fields, without pydantic.

The import of pydantic and its models takes longer than all else that a small scenario needs. This
reader knows the types that most fields have. Data with a fault, or of a type that it does not
know, are left to pydantic (`models`), which also makes the messages.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from rightofway.io.fields import REQUIRED, Document, FieldReader
from rightofway.kinds.table import Kind

D = TypeVar("D", bound=Document)

Reader = Callable[[Any, Any], Any]
"""Return the value of data, with the context of the document; or raise a ValueError."""

_LIMITS: dict[str, Callable[[Any, int], bool]] = {
    "min_length": lambda value, limit: len(value) >= limit,
    "max_length": lambda value, limit: len(value) <= limit,
    "ge": lambda value, limit: value >= limit,
    "le": lambda value, limit: value <= limit,
}

_TYPES = {"boolean": bool, "integer": int, "string": str}
"""The types that data of a kind must have, by its JSON Schema."""


class _Doubt(ValueError):
    """Data that pydantic has to read."""


def read_quickly(document: type[D], data: Any, context: Any = None) -> D | None:
    """Return data as a document, equal to that of pydantic; None if pydantic has to read them."""
    try:
        read: D = _make_document_reader(document)(data, context)  # type: ignore[arg-type]
    except ValueError:
        return None
    return read


@cache
def _make_document_reader(document: type[Document]) -> Reader:
    hints = get_type_hints(document, include_extras=True)
    readers = {
        field.alias or name: (name, _limit(_make_reader(hints[name]), field.limits))
        for name, field in document.fields.items()
    }
    required = {name for name, field in document.fields.items() if field.default is REQUIRED}
    read_short = getattr(document, "read_short", None)

    def read(data: Any, context: Any) -> Document:
        if read_short:
            data = read_short(data)
        _require(type(data) is dict and readers.keys() >= data.keys())
        values = {}
        for key, item in data.items():
            name, read_item = readers[key]
            values[name] = read_item(item, context)
        _require(required <= values.keys())
        return document(values)

    return read


def _require(holds: bool) -> None:
    if not holds:
        raise _Doubt


def _limit(read: Reader, limits: Any) -> Reader:
    """Return a reader that also checks limits on the value."""
    if not limits:
        return read

    def read_within(data: Any, context: Any) -> Any:
        value = read(data, context)
        _require(all(_LIMITS[name](value, limit) for name, limit in limits.items()))
        return value

    return read_within


def _make_reader(annotation: Any) -> Reader:
    """Return the reader of a type; of an unknown one, the reader that always doubts."""
    if isinstance(annotation, type) and issubclass(annotation, Document):
        return _make_document_reader(annotation)  # type: ignore[arg-type]
    make = _MAKERS.get(get_origin(annotation) or annotation)
    return make(*get_args(annotation)) if make else _doubt


def _doubt(_data: Any, _context: Any) -> Any:
    raise _Doubt


def _make_annotated_reader(inner: Any, extra: Any, *others: Any) -> Reader:
    if isinstance(extra, FieldReader) and not others:
        if not extra.is_first:
            return extra.read
        read_inner = _make_reader(inner)
        return lambda data, context: read_inner(extra.read(data, context), context)
    if not isinstance(extra, Kind) or others:
        return _doubt
    if extra.words:
        return _make_word_reader(*extra.words)
    read = extra.read
    wanted = _TYPES.get(extra.schema.get("type", ""))
    if wanted is None:
        return lambda data, _context: read(data)

    def read_of_type(data: Any, _context: Any) -> Any:
        _require(type(data) is wanted)
        return read(data)

    return read_of_type


def _make_type_reader(wanted: type) -> Reader:
    def read(data: Any, _context: Any) -> Any:
        _require(type(data) is wanted)
        return data

    return read


def _make_word_reader(*words: Any) -> Reader:
    def read(data: Any, _context: Any) -> Any:
        _require(any(type(data) is type(word) and data == word for word in words))
        return data

    return read


def _make_list_reader(item: Any) -> Reader:
    read_item, kind = _make_reader(item), get_args(item)[-1] if get_args(item) else None
    if item is str or (isinstance(kind, Kind) and kind.schema.get("type") == "integer"):
        return _make_long_list_reader(item, read_item)

    def read(data: Any, context: Any) -> Any:
        _require(type(data) is list)
        return [read_item(part, context) for part in data]

    return read


def _make_long_list_reader(item: Any, read_item: Reader) -> Reader:
    """Return a reader of texts or whole numbers: a large plan has millions."""
    wanted = str if item is str else int

    def read(data: Any, context: Any) -> Any:
        _require(type(data) is list and set(map(type, data)) <= {wanted})
        if wanted is int and data:  # all others are within the same bounds
            read_item(min(data), context)
            read_item(max(data), context)
        return list(data)

    return read


def _make_tuple_reader(*items: Any) -> Reader:
    readers = [_make_reader(item) for item in items]

    def read(data: Any, context: Any) -> Any:
        _require(type(data) is tuple and len(data) == len(readers))
        return tuple(own(part, context) for own, part in zip(readers, data, strict=True))

    return read


def _make_mapping_reader(key: Any, item: Any) -> Reader:
    read_key, read_item = _make_reader(key), _make_reader(item)

    def read(data: Any, context: Any) -> Any:
        _require(type(data) is dict)
        return {read_key(name, context): read_item(part, context) for name, part in data.items()}

    return read


def _make_optional_reader(inner: Any, other: Any, *others: Any) -> Reader:
    if others or other is not NoneType:
        return _doubt
    read = _make_reader(inner)
    return lambda data, context: None if data is None else read(data, context)


_MAKERS: dict[Any, Callable[..., Reader]] = {
    Any: lambda: lambda data, _context: data,
    bool: partial(_make_type_reader, bool),
    int: partial(_make_type_reader, int),
    str: partial(_make_type_reader, str),
    Annotated: _make_annotated_reader,
    Literal: _make_word_reader,
    list: _make_list_reader,
    tuple: _make_tuple_reader,
    dict: _make_mapping_reader,
    Union: _make_optional_reader,
    UnionType: _make_optional_reader,
}
"""The function that makes the reader of a type of its arguments, by its origin."""
