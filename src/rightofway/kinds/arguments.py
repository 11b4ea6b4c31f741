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
from itertools import chain
from numbers import Real
from pathlib import Path
from typing import Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from rightofway.errors import InputError, InputFault
from rightofway.kinds.table import (
    ANYTHING,
    FUNCTION,
    NUMBER,
    PATH,
    TEXT,
    TIME_LIMIT,
    TRUTH,
    WHOLE,
    Kind,
    list_of,
    make_class,
    make_kind,
    make_words,
    tuple_of,
)

P = ParamSpec("P")
R = TypeVar("R")

PACKAGE = "rightofway"

BORDERS = (f"{PACKAGE}.cli", f"{PACKAGE}.studio")
"""The rooms that pass on input of people: their calls come from outside, too."""

MAPPING = make_kind("a mapping", Mapping)

LISTS: dict[object, Any] = {
    Collection: Collection,
    set: AbstractSet,
    frozenset: AbstractSet,
    **dict.fromkeys((Sequence, list, tuple), (Sequence, np.ndarray)),
}
"""The classes that annotations of lists admit."""


def _is_real(value: object) -> bool:
    try:
        return isinstance(value, Real) and not isinstance(value, bool) and not math.isnan(value)
    except OverflowError:  # 10**400
        return False


PLAIN: dict[object, Kind[Any]] = {
    Any: ANYTHING,
    object: ANYTHING,
    type(None): make_kind("None", type(None)),
    bool: TRUTH,
    int: WHOLE,
    float: make_kind("a number", _is_real),
    Fraction: NUMBER,
    str: TEXT,
    Path: PATH,
    os.PathLike: PATH,
    Mapping: MAPPING,
    dict: MAPPING,
    np.ndarray: make_kind("an array", np.ndarray),
    Callable: FUNCTION,
    # The items of an iterator can be read only once, and not here.
    Iterable: make_kind(
        "a list",
        lambda value: isinstance(value, Iterable) and not isinstance(value, str | bytes | Mapping),
    ),
}
"""The kinds of plain annotations."""


def read_annotation(annotation: Any) -> Kind[Any]:
    """Return the kind of an annotation; protocols and type variables admit anything."""
    annotation = getattr(annotation, "__supertype__", annotation)  # a NewType
    base, inner = get_origin(annotation) or annotation, get_args(annotation)
    if base in (Union, types.UnionType):
        return _join_kinds([read_annotation(choice) for choice in inner])
    if base is Literal:
        return make_words(*inner)
    if base is tuple and inner and inner[1:] != (Ellipsis,):
        kinds = tuple(map(read_annotation, inner))
        return tuple_of(kinds, *(kind.name for kind in kinds))
    if base in LISTS:
        return list_of(read_annotation(inner[0]) if inner else ANYTHING, admits=LISTS[base])
    is_open = not inspect.isclass(base) or getattr(base, "_is_protocol", False)
    return PLAIN.get(base) or (ANYTHING if is_open else make_class(base))


def _join_kinds(kinds: list[Kind[Any]]) -> Kind[Any]:
    def fits(kind: Kind[Any], value: object) -> bool:
        try:
            kind.read(value)
        except ValueError:
            return False
        return True

    name = " or ".join(kind.name for kind in kinds)
    return make_kind(name, lambda value: any(fits(kind, value) for kind in kinds))


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
    variadic = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    named_ones = [name for name, parameter in parameters.items() if parameter.kind not in variadic]

    @functools.cache
    def read_kinds() -> dict[str, Kind[Any]]:
        hints = get_type_hints(call)
        kinds = {name: read_annotation(hints.get(name, Any)) for name in named_ones}
        return {**kinds, "time_limit": TIME_LIMIT} if "time_limit" in kinds else kinds

    @functools.wraps(call)
    def checked(*given: P.args, **named: P.kwargs) -> R:
        if _is_inside(sys._getframe(1).f_globals.get("__name__", "")):  # noqa: SLF001
            return call(*given, **named)
        kinds, faults = read_kinds(), list[InputFault]()
        for name, value in chain(zip(named_ones, given, strict=False), named.items()):
            try:
                kinds.get(name, ANYTHING).read_at(name, value)
            except InputError as error:
                faults += error.faults
        if faults:
            raise InputError(faults)
        return call(*given, **named)

    return checked
