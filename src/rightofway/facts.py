"""Facts: a kind and values, which rooms below `report` return instead of sentences.

A fact has no words. `rightofway.report` has a template for each kind in each language, and shows
the values as people read them: a robot by its name, ticks as a time.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Protocol, cast

from rightofway.provision import provided

__all__ = ["Fact", "get_teller", "note_pieces", "read_fact"]


class Fact:
    """A fact about a scenario, or about a call.

    Parameters
    ----------
    kind
        The key of its templates.
    about
        The scenario whose robots, vertices and ticks the values are; None where there are none.
    **values
        Robots and vertices by index, times in ticks, lengths as fractions, counts, names, or facts.

    Notes
    -----
    Facts are equal if kind and values are. ``str(fact)`` is the English sentence.
    """

    __slots__ = ("about", "kind", "values")

    def __init__(self, kind: str, /, about: Any = None, **values: Any) -> None:
        self.kind = kind
        self.about = about
        self.values: Mapping[str, Any] = values

    def bind(self, about: Any) -> Fact:
        """Return the fact about a scenario."""
        return Fact(self.kind, about, **self.values)

    def detach(self, since: int = 0) -> Fact:
        """Return the fact for readers without its scenario: names and quantities are text.

        Parameters
        ----------
        since
            Ticks after which its points in time begin to count.
        """
        return self if self.about is None else get_teller().name_values(self, since)

    def as_dict(self) -> dict[str, Any]:
        """Return kind and values as JSON has them; facts among the values likewise."""
        values = {name: _pack(value) for name, value in self.values.items()}
        return {"kind": self.kind, "values": values}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Fact):
            return NotImplemented
        return (self.kind, self.values) == (other.kind, other.values)

    def __hash__(self) -> int:
        return hash((self.kind, tuple(self.values.items())))

    def __repr__(self) -> str:
        values = "".join(f", {name}={value!r}" for name, value in self.values.items())
        return f"{type(self).__name__}({self.kind!r}{values})"

    def __str__(self) -> str:
        return get_teller().tell_fact(self)


def _pack(value: Any) -> Any:
    if isinstance(value, Fact):
        return value.as_dict()
    return [_pack(item) for item in value] if isinstance(value, list | tuple) else value


def note_pieces(sentence: Fact, names: Iterable[str | Fact]) -> Fact:
    """Return a note on some pieces: the fact, and the name of each piece."""
    return Fact("note on pieces", sentence.about, sentence=sentence, names=tuple(names))


def read_fact(data: Mapping[str, Any], about: Any = None) -> Fact:
    """Return the fact of `Fact.as_dict`, about a scenario."""
    values = {name: _unpack(value) for name, value in data["values"].items()}
    return Fact(data["kind"], about=about, **values)


def _unpack(value: Any) -> Any:
    if isinstance(value, dict):
        return read_fact(value)
    return tuple(map(_unpack, value)) if isinstance(value, list) else value


class Teller(Protocol):
    """The room that makes sentences, as rooms below it see it."""

    def tell_fact(self, fact: Any) -> str:
        """Return a fact, a fault or a report of the judge in English."""

    def name_values(self, fact: Fact, since: int) -> Fact:
        """Return a fact about no scenario, as `Fact.detach`."""

    def write_message(self, fault: Any) -> str:
        """Return the reason of a fault and its remedy in English."""

    def summarize_report(self, report: Any) -> str:
        """Return the number of faults of each kind in English."""


def get_teller() -> Teller:
    """Return the object that makes sentences; the package provides it when it is imported."""
    return cast("Teller", provided["teller"])
