"""The check of arguments at the front door, by the annotations of parameters.

The functions that `rightofway` exports, and methods of its classes, have ``@checks_arguments``.
They refuse arguments of other kinds by name, with the value and a remedy, before they do anything.
Only calls from outside the package are checked. Ranges, names, and values that have to fit together
are checked by the functions.
"""

from __future__ import annotations

import functools
import inspect
import math
import os
import sys
import types
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from fractions import Fraction
from itertools import chain, repeat
from numbers import Real
from pathlib import Path
from typing import Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from rightofway.errors import InputError, InputFault, quote
from rightofway.kinds.table import (
    ANYTHING,
    FUNCTION,
    NUMBER,
    PATH,
    TEXT,
    TRUTH,
    WHOLE,
    Kind,
    make_class,
    make_kind,
    make_words,
)

P = ParamSpec("P")
R = TypeVar("R")

MARK = "checks_arguments"
"""Attribute of functions that check their arguments."""

PACKAGE = "rightofway"

BORDERS = (f"{PACKAGE}.cli", f"{PACKAGE}.studio")
"""The rooms that pass on input of people: their calls come from outside, too."""

ADMITTED: dict[type, Any] = {
    Iterable: Iterable,
    Collection: Collection,
    set: AbstractSet,
    frozenset: AbstractSet,
    **dict.fromkeys((Sequence, list, tuple), (Sequence, np.ndarray)),
}
"""The collections that an annotation admits; text and mappings are none."""


def _is_real(value: object) -> bool:
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        return not math.isnan(value)
    except OverflowError:  # 10**400
        return False


PLAIN: dict[object, Kind[Any]] = {
    Any: ANYTHING,
    object: ANYTHING,
    type(None): make_kind("None", lambda value: value is None),
    bool: TRUTH,
    int: WHOLE,
    float: make_kind("a number", _is_real),
    str: TEXT,
    Path: PATH,
    os.PathLike: PATH,
    Fraction: NUMBER,
    np.ndarray: make_kind("an array", lambda value: isinstance(value, np.ndarray)),
    Callable: FUNCTION,
}
"""The kinds of plain annotations."""


def read_annotation(annotation: Any) -> Kind[Any]:
    """Return the kind of an annotation; protocols and type variables admit anything."""
    annotation = getattr(annotation, "__supertype__", annotation)  # a NewType
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin in (Union, types.UnionType):
        kinds = [read_annotation(choice) for choice in inner]
        name = " or ".join(kind.name for kind in kinds)
        return make_kind(name, lambda value: any(_fits(kind, value) for kind in kinds))
    if origin is Literal:
        return make_words(*inner)
    base = origin or annotation
    return PLAIN[base] if base in PLAIN else _read_class(base, inner)


def _read_class(base: Any, inner: tuple[Any, ...]) -> Kind[Any]:
    """Return the kind of a class, with the classes that it is subscripted with."""
    if base in ADMITTED:
        return _read_collection(base, inner)
    if not inspect.isclass(base) or getattr(base, "_is_protocol", False):
        return ANYTHING
    if issubclass(base, Mapping):
        values = read_annotation(inner[1]) if inner else ANYTHING
        return _check_items("a mapping", lambda value: isinstance(value, Mapping), repeat(values))
    return make_class(base)


def _fits(kind: Kind[Any], value: object) -> bool:
    try:
        kind.read(value)
    except ValueError:
        return False
    return True


def _read_collection(base: type, inner: tuple[Any, ...]) -> Kind[Any]:
    """Return the kind of a list of items, or of a tuple with a kind for each of its items."""
    is_uniform = len(inner) == 1 or inner[1:] == (Ellipsis,) or base is not tuple
    kinds = [read_annotation(item) for item in inner if item is not Ellipsis]

    def holds(value: Any) -> bool:
        if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, ADMITTED[base]):
            return False
        return is_uniform or len(value) == len(kinds)

    if is_uniform:
        return _check_items("a list", holds, repeat(kinds[0] if kinds else ANYTHING))
    return _check_items(f"[{', '.join(kind.name for kind in kinds)}]", holds, kinds)


def _check_items(name: str, holds: Callable[[Any], bool], kinds: Iterable[Kind[Any]]) -> Kind[Any]:
    """Return the kind of a collection; the items of an iterator can be read only once."""
    if isinstance(kinds, repeat) and next(kinds) is not ANYTHING:
        name = f"{name}, each {next(kinds).name}"

    def read(value: Any) -> Any:
        if not holds(value):
            raise ValueError(f"{quote(value)} does not fit (give {name})")
        entries: Iterable[tuple[Any, object]] = ()
        if isinstance(value, Mapping):
            entries = ((str(key), item) for key, item in value.items())
        elif isinstance(value, Sequence | AbstractSet | np.ndarray):
            entries = enumerate(value)
        for (key, item), kind in zip(entries, kinds, strict=False):
            kind.read_at(key, item)
        return value

    return Kind(name, {}, read)


@functools.cache
def _is_inside(module: str) -> bool:
    """Return whether calls from a module come from inside the package."""
    return f"{module}.".startswith(f"{PACKAGE}.") and not module.startswith(BORDERS)


def checks_arguments(call: Callable[P, R]) -> Callable[P, R]:
    """Make a function refuse arguments that are not of the kinds of its annotations.

    All annotations can be evaluated in the module of the function. It raises `InputError` with all
    arguments that do not fit. The module of the calling frame tells whether the call comes from
    outside, in any thread, generator or callback; no state is kept.
    """
    parameters = inspect.signature(call).parameters
    by_position = [
        name
        for name, parameter in parameters.items()
        if parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD)
    ]

    @functools.cache
    def read_kinds() -> dict[str, Kind[Any]]:
        hints = get_type_hints(call)
        return {
            name: read_annotation(hints.get(name, Any))
            for name, parameter in parameters.items()
            if parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
        }

    @functools.wraps(call)
    def checked(*given: P.args, **named: P.kwargs) -> R:
        if _is_inside(sys._getframe(1).f_globals.get("__name__", "")):  # noqa: SLF001
            return call(*given, **named)
        kinds, faults = read_kinds(), list[InputFault]()
        for name, value in chain(zip(by_position, given, strict=False), named.items()):
            try:
                kinds.get(name, ANYTHING).read_at(name, value)
            except InputError as error:
                faults += error.faults
        if faults:
            raise InputError(faults)
        return call(*given, **named)

    checked.__dict__[MARK] = True
    return checked
