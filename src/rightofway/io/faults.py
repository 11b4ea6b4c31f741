"""Every fault of a document at once: collected, translated from pydantic, put in order."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar, get_args

from rightofway.errors import InputError, InputFault
from rightofway.io.formats import PLAN_FORMAT, SCENARIO_FORMAT, SUITE_FORMAT
from rightofway.io.words import nearest, place_of, shown

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic.fields import FieldInfo
    from pydantic_core import ErrorDetails

__all__ = ["MAX_PROBLEMS", "Faults", "blaming", "checked", "checked_format", "under"]

MAX_PROBLEMS = 50
"""So many problems of one document are told; the others are counted."""

T = TypeVar("T")
M = TypeVar("M", bound="BaseModel")


class Faults:
    """The problems found so far in one document."""

    def __init__(self) -> None:
        self._faults: list[InputFault] = []

    def attempt(self, place: str, read: Callable[..., T], *arguments: Any) -> T | None:
        """Return what ``read`` makes of a part of the document, or None after noting its faults."""
        try:
            with under(place):
                return read(*arguments)
        except InputError as error:
            self._faults += error.faults
            return None

    def part(
        self, document: Mapping[str, Any], key: str, read: Callable[..., T], *arguments: Any
    ) -> T | None:
        """Do the same with the part under a key; one that is missing is noted by others."""
        return self.attempt(key, read, document[key], *arguments) if key in document else None

    def note(self, place: str, message: str) -> None:
        """Note one problem."""
        self._faults.append(InputFault(place, message))

    def stop(self, order: Iterable[str] = ()) -> None:
        """Raise all problems, if there are any, in the order of the document's keys.

        Raises
        ------
        InputError
            With every problem, each told once.
        """
        if not self._faults:
            return
        ranks = {key: rank for rank, key in enumerate(order)}
        faults = sorted(dict.fromkeys(self._faults), key=lambda fault: _rank(fault, ranks))
        left = len(faults) - MAX_PROBLEMS
        more = [InputFault("", f"and {left} more (mend these first)")] if left > 0 else []
        raise InputError([*faults[:MAX_PROBLEMS], *more])


def _rank(fault: InputFault, ranks: dict[str, int]) -> tuple[int, int]:
    key, index = re.match(r"([^.\[]*)(?:\[(\d+)\])?", fault.place).groups()  # type: ignore[union-attr]
    return ranks.get(key, len(ranks)), int(index or -1)


@contextmanager
def under(place: str) -> Iterator[None]:
    """Show whatever is found wrong here as a fault of the document at ``place``."""
    try:
        yield
    except InputError as error:
        if error.source:  # it lies in another file that the document names
            raise InputError(
                InputFault(place, f"{error.source}: {each}") for each in error.faults
            ) from None
        raise InputError(each.within(place) if place else each for each in error.faults) from None


@contextmanager
def blaming(source: str) -> Iterator[None]:
    """Name the file or argument in which whatever is found wrong here stands."""
    try:
        yield
    except InputError as error:
        raise InputError(error.faults, error.source or source) from None


def checked_format(document: Any, known: str) -> dict[str, Any]:
    """Return a document that claims to be of a known format.

    Raises
    ------
    InputError
        If it does not. Nothing else is said of it then, because nothing else is known.
    """
    line = f'format = "{known}"' if known == SUITE_FORMAT else f"format: {known}"
    if not isinstance(document, dict):
        found = "nothing is in it" if document is None else f"{shown(document)} is no document"
        raise InputError.at("", f"{found} (begin with {line})")
    if "format" not in document:
        raise InputError.at("format", f"is missing (put {line} at the top)")
    found = document["format"]
    if found != known:
        raise InputError.at("format", f"{shown(found)} is {_not_wanted(found, known)}")
    return document


def _not_wanted(found: object, known: str) -> str:
    if found == PLAN_FORMAT and known == SCENARIO_FORMAT:
        return "a plan, not a scenario (its scenario is in it; check or show it as it is)"
    if found == SCENARIO_FORMAT and known == PLAN_FORMAT:
        return "a scenario, not a plan (plan it first)"
    return f"not known here (give {known}, or update)"


def checked(model: type[M], data: Any) -> M:
    """Return data as a model, or raise each of its faults in our words.

    Raises
    ------
    InputError
        With places relative to the data.
    """
    from pydantic import ValidationError

    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise InputError(_problem(details, model) for details in error.errors()) from None


_KINDS = {
    "bool_type": "true or false",
    "dict_type": "a mapping of keys to values",
    "int_type": "a whole number",
    "list_type": "a list",
    "model_type": "a mapping of keys to values",
    "string_type": "text",
}


def _problem(details: ErrorDetails, model: type[BaseModel]) -> InputFault:
    location = tuple(part for part in details["loc"] if part != "[key]")
    return InputFault(place_of(location), _message(details, model))


def _message(details: ErrorDetails, model: type[BaseModel]) -> str:
    kind, value = details["type"], details["input"]
    owner, field = _walk(model, details["loc"])
    remedy = field.description if field else f"keys {', '.join(_fields(owner))}"
    if kind == "missing":
        return f"is missing (give {remedy})"
    if kind in {"extra_forbidden", "invalid_key"}:
        return _unknown_key(details["loc"][-1], owner)
    if value is None:
        is_needed = field is None or field.is_required()
        return f"is empty (give {remedy}{'' if is_needed else ', or take the key out'})"
    if kind == "value_error":
        return str(details["ctx"]["error"])
    if kind in _KINDS:
        return f"{shown(value)} is not {_KINDS[kind]} (give {remedy})"
    return f"{shown(value)} does not fit (give {remedy})"


def _unknown_key(key: int | str, owner: type[BaseModel]) -> str:
    known = list(_fields(owner))
    near = nearest(key, known)
    return (
        f"unknown key (did you mean {near}?)"
        if near
        else f"unknown key (known: {', '.join(known)})"
    )


def _walk(
    model: type[BaseModel], location: tuple[int | str, ...]
) -> tuple[type[BaseModel], FieldInfo | None]:
    """Return the innermost model on the way to a place, and the last field on it."""
    owner, field = model, None
    for part in (part for part in location if isinstance(part, str)):
        found = _fields(owner).get(part)
        if found is None:
            break
        field = found
        inner = _model_in(found.annotation)
        if inner is None:
            break
        owner = inner
    return owner, field


def _fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Return the fields of a model by key, those first that must be there."""
    fields = sorted(model.model_fields.items(), key=lambda item: not item[1].is_required())
    return {field.alias or name: field for name, field in fields}


def _model_in(annotation: Any) -> type[BaseModel] | None:
    if hasattr(annotation, "model_fields"):
        return annotation  # type: ignore[no-any-return]
    inside = (_model_in(argument) for argument in get_args(annotation))
    return next((found for found in inside if found), None)
