"""Facts that plan files keep: the status of a planner, and the reasons of reroutes.

Each kind has a table of its values with their types. It is checked when a fact is made, so that
the sentences of a file from elsewhere can be written.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, ClassVar, Self

from rightofway.errors import InputError, find_nearest, is_printable, locate_faults, quote
from rightofway.facts import Fact
from rightofway.kinds.numbers import format_number
from rightofway.kinds.table import NUMBER, TEXT, WHOLE, Kind, list_of, make_words
from rightofway.model.outcome import Objective

DEEPEST = 20
"""Levels of statuses of first plans in a status."""


def _read_status(value: object) -> Status:
    if isinstance(value, Status | str):
        return Status.of(value)
    raise ValueError(f"{quote(value)} is no status (give {_STATUS.name})")


_STATUS = Kind("{kind, counts}", {}, _read_status)
_NAMES = list_of(TEXT)
_OBJECTIVE = make_words(*(objective.value for objective in Objective))


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

    KINDS: ClassVar[Mapping[str, Mapping[str, Kind[Any]]]] = {}
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
        read = {name: readers[name].read_at((self.KEY, name), values[name]) for name in readers}
        super().__init__(kind, **read)

    def __reduce__(self) -> tuple[Any, ...]:
        return _make_again, (type(self), self.kind, dict(self.values))

    @classmethod
    def of(cls, reason: Self | str) -> Self:
        """Return a fact as it is; text, by planners of other packages, becomes a fact."""
        return reason if isinstance(reason, cls) else cls("other", text=reason)

    def as_dict(self) -> dict[str, Any]:
        """Return the fact as plan files have it."""
        values = {name: _convert_to_plain(value) for name, value in self.values.items()}
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


def _make_again(kind: type[KeptFact], key: str, values: Mapping[str, Any]) -> KeptFact:
    return kind(key, **values)


def _convert_to_plain(value: Any) -> Any:
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
        "re-routed": {"robots": _NAMES},
        "re-routed together": {},
        "by planner": {"planner": TEXT, "status": _STATUS},
        "best of orders": {"number": WHOLE, "status": _STATUS},
        "reversals": {
            "objective": _OBJECTIVE,
            "before": WHOLE,
            "after": WHOLE,
        },
        "then": {"first": _STATUS, "second": _STATUS},
        "in turn": {},
        "one at a time": {},
        "in waves": {},
        "in turn at one pace": {},
        "together": {},
        "together after in turn": {},
        "instants": {},
        "moves": {},
        "joint states": {},
        "given": {},
        "adapted": {},
        "improved": {"neighbourhoods": WHOLE, "status": _STATUS},
        "not improved": {"neighbourhoods": WHOLE, "status": _STATUS},
        "as fast as alone": {"status": _STATUS},
        "found": {"claim": _STATUS, "nodes": WHOLE},
        "proven": {"claim": _STATUS, "nodes": WHOLE, "status": _STATUS},
        "searched": {
            "claim": _STATUS,
            "nodes": WHOLE,
            "objective": _OBJECTIVE,
            "status": _STATUS,
        },
        "nothing better": {"nodes": WHOLE, "status": _STATUS},
        "optimal": {},
        "within factor": {"factor": NUMBER},
        "best found": {},
        "found by search": {"nodes": WHOLE},
        "optimum found by search": {"nodes": WHOLE},
        "proven by search": {"nodes": WHOLE, "status": _STATUS},
        "interrupted": {"status": _STATUS},
        "stopped": {},
        "so far": {},
        "reversed": {"waits": TEXT, "goes_first": TEXT},
        "reversed and replanned": {"waits": TEXT, "goes_first": TEXT},
        "whole laps": {},
        "excerpt of laps": {"rule": TEXT},
        "no plan exists": {},
        "other": {"text": TEXT},
    }

    @property
    def counts(self) -> Mapping[str, Any]:
        """The values of its kind: counts, names, and statuses of first plans."""
        return self.values


class RerouteReason(KeptFact):
    """The reason why a robot was rerouted."""

    __slots__ = ()

    KINDS: ClassVar = {
        "deadlock of two": {"one": TEXT, "other": TEXT, "place": TEXT},
        "deadlock in circle": {
            "one": TEXT,
            "other": TEXT,
            "place": TEXT,
            "robots": _NAMES,
        },
        "rotation": {"robots": _NAMES},
        "makes way": {},
        "makes way for": {"robot": TEXT},
        "short time": {},
        "no way in turn": {},
        "other": {"text": TEXT},
    }
