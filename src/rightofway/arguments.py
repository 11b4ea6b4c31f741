"""Arguments of public functions, checked by the annotations of their parameters.

A function with ``@checks_arguments`` refuses an argument of another kind by its name, its value and
a remedy, before it does anything. What only the function can know (ranges, names, what fits
together) it checks itself. Only calls that enter the package are checked: one room may call another
for each robot, with what the package has made.
"""

from __future__ import annotations

import functools
import inspect
import math
import sys
import types
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence, Sized
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from itertools import chain
from numbers import Integral, Real
from pathlib import Path
from typing import (
    Any,
    Literal,
    ParamSpec,
    TypeGuard,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

import numpy as np

from rightofway.errors import InputError, InputFault, Steps, quote

__all__ = [
    "checks_arguments",
    "checks_its_arguments",
    "get_value",
    "require_one_for_each",
]


P = ParamSpec("P")
R = TypeVar("R")

MARK = "checks_arguments"
"""Attribute of functions that check their arguments."""

PACKAGE = __name__.rpartition(".")[0]

BORDERS = (f"{PACKAGE}.cli", f"{PACKAGE}.studio")
"""The rooms that pass on what people write: their calls enter the package, too."""

LARGEST = 2**63 - 1
"""Whole numbers of a larger size fit into no array."""

COLLECTIONS = (Iterable, Collection, Sequence, list, tuple, set, frozenset)
"""Annotations of collections; text and mappings are none."""

CAN_BE_READ_AGAIN = (Sequence, AbstractSet, Mapping, np.ndarray)
"""Collections whose items are looked at; an iterator would be empty afterwards."""

ADMITTED: dict[type, Any] = {
    Iterable: Iterable,  # an iterator, too, whose items cannot be looked at before
    Collection: Collection,
    set: AbstractSet,
    frozenset: AbstractSet,
}
"""The collections that an annotation admits; all others want an order."""


@dataclass(frozen=True, slots=True)
class ArgumentKind:
    """What an annotation admits.

    Attributes
    ----------
    holds
        Whether a value is of the kind, itself.
    name
        What a message calls it: ``a Plan``.
    items
        The kind of its items, if it is a collection.
    """

    holds: Callable[[Any], bool]
    name: str
    items: ArgumentKind | None = None

    def find_fault(self, place: Steps, value: object) -> InputFault | None:
        """Return what is wrong with a value, None where it fits."""
        if not self.holds(value):
            return InputFault(place, f"{quote(value)} does not fit (give {self.name})")
        if self.items is None or not isinstance(
            value, Sequence | AbstractSet | Mapping | np.ndarray
        ):
            return None  # an iterator can be read once only
        entries: Iterable[tuple[str | int, object]] = (
            ((str(key), item) for key, item in value.items())
            if isinstance(value, Mapping)
            else enumerate(value)
        )
        faults = (self.items.find_fault((*place, key), item) for key, item in entries)
        return next(filter(None, faults), None)


def is_whole(value: object) -> TypeGuard[int]:
    """Return whether a value is a whole number, of Python or of NumPy; a truth value is none."""
    # Asking for the type first spares a search of the registry of `Integral` for each int.
    return type(value) is int or (isinstance(value, Integral) and not isinstance(value, bool))


def _is_whole_in_range(value: object) -> bool:
    return is_whole(value) and -LARGEST <= value <= LARGEST


def _is_real(value: object) -> bool:
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        return not math.isnan(value)
    except OverflowError:  # 10**400
        return False


ANYTHING = ArgumentKind(lambda _: True, "anything")

PLAIN: dict[object, ArgumentKind] = {
    Any: ANYTHING,
    object: ANYTHING,
    type(None): ArgumentKind(lambda value: value is None, "None"),
    bool: ArgumentKind(lambda value: isinstance(value, bool | np.bool_), "True or False"),
    int: ArgumentKind(_is_whole_in_range, "a whole number"),
    float: ArgumentKind(_is_real, "a number"),
    str: ArgumentKind(lambda value: isinstance(value, str), "text"),
    Path: ArgumentKind(lambda value: isinstance(value, Path), "a path"),
    np.ndarray: ArgumentKind(lambda value: isinstance(value, np.ndarray), "an array"),
    Callable: ArgumentKind(callable, "a function"),
}
"""The kinds of plain annotations."""


def read_annotation(annotation: Any) -> ArgumentKind:
    """Return what an annotation admits; what cannot be judged from outside is admitted."""
    annotation = getattr(annotation, "__supertype__", annotation)  # a NewType
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin in (Union, types.UnionType):
        kinds = [read_annotation(choice) for choice in inner]
        name = " or ".join(kind.name for kind in kinds)
        return ArgumentKind(
            lambda value: any(not kind.find_fault((), value) for kind in kinds), name
        )
    if origin is Literal:
        words = " or ".join(map(repr, inner))
        return ArgumentKind(lambda value: isinstance(value, str) and value in inner, words)
    return _plain_or_class(origin or annotation, inner)


def _plain_or_class(base: Any, inner: tuple[Any, ...]) -> ArgumentKind:
    """Return the kind of a class, without the classes that it is subscripted with, or with them."""
    if base in PLAIN:
        return PLAIN[base]
    if not inspect.isclass(base) or getattr(base, "_is_protocol", False):
        return ANYTHING
    if issubclass(base, Mapping):
        values = read_annotation(inner[1]) if inner else None
        return ArgumentKind(lambda value: isinstance(value, Mapping), "a mapping", values)
    if base in COLLECTIONS:
        return _collection(base, inner)
    return ArgumentKind(lambda value: isinstance(value, base), _with_article(base.__name__))


def _collection(base: type, inner: tuple[Any, ...]) -> ArgumentKind:
    """Return the kind of a list of items; of a tuple whose items differ, the length only."""
    is_uniform = len(inner) == 1 or inner[1:] == (Ellipsis,)
    items = read_annotation(inner[0]) if is_uniform else None
    length = len(inner) if base is tuple and inner and not is_uniform else None
    admitted = ADMITTED.get(base, (Sequence, np.ndarray))

    def holds(value: object) -> bool:
        if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, admitted):
            return False
        return length is None or len(value) == length  # type: ignore[arg-type]

    name = "a list" if length is None else f"a list of {length}"
    return ArgumentKind(holds, f"{name}, each {items.name}" if items else name, items)


def _with_article(noun: str) -> str:
    return f"an {noun}" if noun[0] in "AEIO" else f"a {noun}"


@functools.cache
def _is_inside(module: str) -> bool:
    """Return whether calls out of a module do not enter the package."""
    return f"{module}.".startswith(f"{PACKAGE}.") and not module.startswith(BORDERS)


def checks_arguments(call: Callable[P, R]) -> Callable[P, R]:
    """Have a function refuse arguments that are not of the kinds of its annotations.

    Parameters
    ----------
    call
        A function, all of whose annotations can be evaluated in its module.

    Returns
    -------
    Callable
        The same function; it raises `InputError` with all arguments that do not fit. Calls out of
        the package's own modules are not checked, in whatever thread, generator or callback: the
        module of the calling frame decides, and no state is kept.
    """
    parameters = inspect.signature(call).parameters
    by_position = [
        name
        for name, parameter in parameters.items()
        if parameter.kind in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD)
    ]

    @functools.cache
    def kinds() -> dict[str, ArgumentKind]:
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
        known = kinds()
        arguments = chain(zip(by_position, given, strict=False), named.items())
        faults = [
            fault
            for name, value in arguments
            if name in known and (fault := known[name].find_fault((name,), value))
        ]
        if faults:
            raise InputError(faults)
        return call(*given, **named)

    checked.__dict__[MARK] = True
    return checked


def checks_its_arguments(call: Callable[..., Any]) -> bool:
    """Return whether a function has ``@checks_arguments``."""
    return MARK in getattr(call, "__dict__", {})


def require_one_for_each(robots: Sized, **lists: Sized) -> None:
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


def get_value(table: Mapping[str, R], key: str, place: str) -> R:
    """Return the value of a key that a caller gave.

    Raises
    ------
    InputError
        If the table has no such key.
    """
    if key not in table:
        raise InputError.at(place, f"{quote(key)} is unknown (give {', '.join(sorted(table))})")
    return table[key]
