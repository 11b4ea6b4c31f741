"""Facts that plan files keep: the status of a planner, and the reasons of reroutes.

Each kind has a table of its values with their types. It is checked when a fact is made, so that
the sentences of a file from elsewhere can be written.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, ClassVar, Self

from rightofway.errors import InputError, find_nearest, is_printable, locate_faults, quote
from rightofway.facts import Fact
from rightofway.model.outcome import Objective
from rightofway.values import (
    format_number,
    list_of,
    make_word_reader,
    read_at,
    read_label,
    read_number,
    read_whole_number,
)

Reader = Callable[[object], Any]
"""Returns a value of a fact as it is kept; raises ValueError for a value of another type."""

DEEPEST = 20
"""Levels of statuses of first plans in a status."""


def _read_status(value: object) -> Status:
    if isinstance(value, Status | str):
        return Status.of(value)
    raise ValueError(f"{quote(value)} is no status (give {{kind, counts}})")


_read_names = list_of(read_label)
_read_objective = make_word_reader([objective.value for objective in Objective])


class KeptFact(Fact):
    """A fact of a plan, without a scenario: robots and vertices have their names.

    Parameters
    ----------
    kind
        One of `KINDS`.
    **values
        The values of that kind.

    Raises
    ------
    InputError
        For an unknown kind, missing or additional values, and values of another type.
    """

    __slots__ = ()

    KINDS: ClassVar[Mapping[str, Mapping[str, Reader]]] = {}
    """The values of each kind."""

    KEY: ClassVar[str] = "values"
    """The key of the values in plan files."""

    def __init__(self, kind: str, /, **values: Any) -> None:
        readers = self.KINDS.get(kind) if isinstance(kind, str) else None
        if readers is None:
            near = find_nearest(str(kind), self.KINDS)
            hint = f"did you mean {near!r}?" if near else f"the first is {next(iter(self.KINDS))!r}"
            raise InputError.at("kind", f"{quote(kind)} is unknown ({hint})")
        if missing := [name for name in readers if name not in values]:
            raise InputError.at((self.KEY, missing[0]), "is missing")
        if unknown := [name for name in values if name not in readers]:
            message = f"is no value of {quote(kind)} (take it out)"
            raise InputError.at((self.KEY, unknown[0]), message)
        read = {name: read_at((self.KEY, name), readers[name], values[name]) for name in readers}
        super().__init__(kind, **read)

    def __reduce__(self) -> tuple[Any, ...]:
        return _remake, (type(self), self.kind, dict(self.values))

    @classmethod
    def of(cls, reason: Self | str) -> Self:
        """Return a fact as it is; text, by planners of other packages, becomes a fact."""
        return reason if isinstance(reason, cls) else cls("other", text=reason)

    def as_dict(self) -> dict[str, Any]:
        """Return the fact as plan files have it."""
        values = {name: _as_plain(value) for name, value in self.values.items()}
        return {"kind": self.kind, self.KEY: values}

    @classmethod
    def read(cls, data: Any, depth: int = DEEPEST) -> Self:
        """Return the fact of plain data.

        Raises
        ------
        InputError
            If the data are no such fact, at the place of the fault.
        """
        is_mapping = isinstance(data, Mapping) and data.keys() == {"kind", cls.KEY}
        if not is_mapping or not isinstance(data[cls.KEY], Mapping):
            raise InputError.at("", f"{quote(data)} is no mapping of kind and {cls.KEY}")
        if not depth:
            raise InputError.at("", f"lies too deep (give {DEEPEST} levels at most)")
        values = dict(data[cls.KEY])
        for name, value in values.items():
            with locate_faults((cls.KEY, name)):
                if isinstance(value, Mapping):
                    values[name] = Status.read(value, depth - 1)
                _refuse_unprintable(value)
        return cls(data["kind"], **values)


def _refuse_unprintable(value: Any) -> None:
    """Refuse text of a file that terminals and pages cannot show."""
    for text in value if isinstance(value, list) else [value]:
        if isinstance(text, str) and text and not is_printable(text):
            message = f"{quote(text)} cannot be shown (give printable text on one line)"
            raise InputError.at("", message)


def _remake(kind: type[KeptFact], key: str, values: Mapping[str, Any]) -> KeptFact:
    return kind(key, **values)


def _as_plain(value: Any) -> Any:
    match value:
        case Status():
            return value.as_dict()
        case Fraction():
            return format_number(value)
        case tuple():
            return list(value)
        case _:
            return value


class Status(KeptFact):
    """The method by which a planner found a plan: a kind with counts.

    Notes
    -----
    ``str(status)`` is an English sentence.
    """

    __slots__ = ()

    KEY = "counts"

    KINDS: ClassVar = {
        "waits only": {},
        "re-routed": {"robots": _read_names},
        "re-routed together": {},
        "by planner": {"planner": read_label, "status": _read_status},
        "best of orders": {"number": read_whole_number, "status": _read_status},
        "reversals": {
            "objective": _read_objective,
            "before": read_whole_number,
            "after": read_whole_number,
        },
        "then": {"first": _read_status, "second": _read_status},
        "in turn": {},
        "in turn at one pace": {},
        "together": {},
        "together after in turn": {},
        "instants": {},
        "moves": {},
        "joint states": {},
        "given": {},
        "adapted": {},
        "improved": {"neighbourhoods": read_whole_number, "status": _read_status},
        "not improved": {"neighbourhoods": read_whole_number, "status": _read_status},
        "as fast as alone": {"status": _read_status},
        "no longer headways": {},
        "found": {"claim": _read_status, "nodes": read_whole_number},
        "proven": {"claim": _read_status, "nodes": read_whole_number, "status": _read_status},
        "searched": {
            "claim": _read_status,
            "nodes": read_whole_number,
            "objective": _read_objective,
            "status": _read_status,
        },
        "nothing better": {"nodes": read_whole_number, "status": _read_status},
        "optimal": {},
        "within factor": {"factor": read_number},
        "best found": {},
        "found by search": {"nodes": read_whole_number},
        "optimum found by search": {"nodes": read_whole_number},
        "proven by search": {"nodes": read_whole_number, "status": _read_status},
        "interrupted": {"status": _read_status},
        "stopped": {},
        "so far": {},
        "reversed": {"waits": read_label, "goes_first": read_label},
        "reversed and replanned": {"waits": read_label, "goes_first": read_label},
        "whole laps": {},
        "excerpt of laps": {"rule": read_label},
        "no plan exists": {},
        "other": {"text": read_label},
    }

    @property
    def counts(self) -> Mapping[str, Any]:
        """The values of its kind: counts, names, and statuses of first plans."""
        return self.values


class RerouteReason(KeptFact):
    """The reason why a robot was rerouted."""

    __slots__ = ()

    KINDS: ClassVar = {
        "deadlock of two": {"one": read_label, "other": read_label, "place": read_label},
        "deadlock in circle": {
            "one": read_label,
            "other": read_label,
            "place": read_label,
            "robots": _read_names,
        },
        "rotation": {"robots": _read_names},
        "makes way": {},
        "makes way for": {"robot": read_label},
        "short time": {},
        "no way in turn": {},
        "other": {"text": read_label},
    }
