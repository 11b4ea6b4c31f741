"""Every fault of a document at once: collected, put in order, in words for the user."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from rightofway.errors import InputError, InputFault, Where, find_nearest, quote

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic.fields import FieldInfo
    from pydantic_core import ErrorDetails

    from rightofway.io.fields import Document

MAX_FAULTS = 50
"""Faults of one document that are listed; further ones are counted."""


T = TypeVar("T")
U = TypeVar("U")
M = TypeVar("M", bound="Document | BaseModel")


class Faults:
    """The faults found so far in one document."""

    def __init__(self) -> None:
        self._faults: list[InputFault] = []

    def attempt(self, where: Where, read: Callable[..., T], *arguments: Any) -> T | None:
        """Return ``read(*arguments)``, or None after noting its faults under a place."""
        try:
            return read(*arguments)
        except InputError as error:
            self._faults += [fault.nest(where) for fault in error.faults]
            return None

    def __len__(self) -> int:
        return len(self._faults)

    def read_part(
        self, document: Mapping[str, Any], key: str, read: Callable[..., T], *arguments: Any
    ) -> T | None:
        """Attempt to read the part under a key; the document's frame reports a missing key."""
        return self.attempt(key, read, document[key], *arguments) if key in document else None

    def note(self, where: Where, message: str, other: Where | None = None) -> None:
        """Note one fault."""
        self._faults.append(InputFault(where, message, other))

    def add(self, faults: Iterable[InputFault]) -> None:
        """Note faults that were found elsewhere."""
        self._faults += faults

    @property
    def found(self) -> tuple[InputFault, ...]:
        """The faults noted so far."""
        return tuple(self._faults)

    def stop(self, order: Iterable[str] = ()) -> None:
        """Raise the noted faults, if there are any: each once, in the order of the keys given."""
        if not self._faults:
            return
        ranks = {key: rank for rank, key in enumerate(order)}
        faults = sorted(dict.fromkeys(self._faults), key=lambda fault: _rank(fault, ranks))
        left = len(faults) - MAX_FAULTS
        more = [InputFault("", f"and {left} more (mend these first)")] if left > 0 else []
        raise InputError([*faults[:MAX_FAULTS], *more])


def read_both(first: Callable[[], T], second: Callable[[], U]) -> tuple[T, U]:
    """Return the results of two readers, or raise the faults of both."""
    try:
        return first(), second()
    except InputError:
        faults = Faults()
        for read in (first, second):
            faults.attempt("", read)
        faults.stop()
        raise


def _rank(fault: InputFault, ranks: dict[str, int]) -> tuple[int, int]:
    key, index = (*fault.path, "", "")[:2]
    return ranks.get(str(key), len(ranks)), index if isinstance(index, int) else -1


def validate(model: type[M], data: Any, context: Any = None) -> M:
    """Return data as a document or a pydantic model, or raise all its faults in words for the user.

    Names and places in the data are looked up in the context.
    """
    from rightofway.io.fields import Document
    from rightofway.io.quick_reader import read_quickly

    document = read_quickly(model, data, context) if issubclass(model, Document) else None
    return _validate_thoroughly(model, data, context) if document is None else document


def _validate_thoroughly(model: type[M], data: Any, context: Any) -> M:
    from pydantic import ValidationError

    from rightofway.io.models import find_model, make_adapter

    adapter: Any = make_adapter(model)  # type: ignore[arg-type]
    try:
        document: M = adapter.validate_python(data, context=context)
    except ValidationError as error:
        faults, owner = error.errors(), find_model(model)
    else:
        return document
    assert owner is not None, "it is a document or a model"
    raise InputError(
        fault_of_part for fault in faults for fault_of_part in _list_faults(fault, owner)
    )


def _list_faults(details: ErrorDetails, model: type[BaseModel]) -> Iterator[InputFault]:
    path = tuple(step for step in details["loc"] if step != "[key]")
    error = details.get("ctx", {}).get("error")
    if isinstance(error, InputError):  # raised by a validator of ours, perhaps at places inside
        yield from (fault.nest(path) for fault in error.faults)
    else:
        yield InputFault(path, _write_message(details, model))


_KINDS = {
    "bool_type": "true or false",
    "dict_type": "a mapping of keys to values",
    "int_type": "a whole number",
    "list_type": "a list",
    "model_type": "a mapping of keys to values",
    "string_type": "text",
}


def _write_message(details: ErrorDetails, model: type[BaseModel]) -> str:
    kind, value = details["type"], details["input"]
    owner, field = _walk(model, details["loc"])
    remedy = field.description if field else f"keys {', '.join(_list_fields(owner))}"
    if kind == "missing":
        return f"is missing (give {remedy})"
    if kind in {"extra_forbidden", "invalid_key"}:
        return _describe_unknown_key(details["loc"][-1], owner)
    if value is None:
        is_needed = field is None or field.is_required()
        return f"is empty (give {remedy}{'' if is_needed else ', or take the key out'})"
    if kind == "value_error":
        return str(details["ctx"]["error"])
    if kind in _KINDS:
        return f"{quote(value)} is not {_KINDS[kind]} (give {remedy})"
    return f"{quote(value)} does not fit (give {remedy})"


MEANT = {
    "one_way": "both_ways: false",
    "oneway": "both_ways: false",
    "directed": "both_ways: false",
    "bidirectional": "both_ways: true",
    "start": "home",
    "goal": "target",
    "goals": "stops",
    "tasks": "stops",
    "velocity": "speed",
    "resolution": "cell_size",
}
"""Words of other programs, and what to write here."""


def _describe_unknown_key(key: int | str, owner: type[BaseModel]) -> str:
    known = list(_list_fields(owner))
    meant = MEANT.get(str(key).lower(), "")
    if meant.partition(":")[0] in known:
        return f"unknown key (write {meant})"
    near = find_nearest(str(key).lower(), known)
    return (
        f"unknown key (did you mean {near}?)"
        if near
        else f"unknown key (known: {', '.join(known)})"
    )


def _walk(
    model: type[BaseModel], location: tuple[int | str, ...]
) -> tuple[type[BaseModel], FieldInfo | None]:
    """Return the innermost model on the way to a place, and the last field on it."""
    from rightofway.io.models import find_model

    owner, field = model, None
    for part in (part for part in location if isinstance(part, str)):
        model_field = _list_fields(owner).get(part)
        if model_field is None:
            break
        field = model_field
        inner = find_model(model_field.annotation)
        if inner is None:
            break
        owner = inner
    return owner, field


def _list_fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Return the fields of a model by key, those first that must be there."""
    fields = sorted(model.model_fields.items(), key=lambda item: not item[1].is_required())
    return {field.alias or name: field for name, field in fields}


def list_keys(document: type[Document]) -> list[str]:
    """Return the keys of a document, in the order in which it declares them."""
    return [field.alias or name for name, field in document.fields.items()]
