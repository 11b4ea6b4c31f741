"""Jobs made of orders of other programs: documents with places in the file, instants and loads."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from fractions import Fraction
from typing import Any

from rightofway.errors import InputError, Location, Steps, Where
from rightofway.facts import Fact
from rightofway.io.faults import Faults
from rightofway.io.source import Source
from rightofway.kinds.numbers import format_number

NEVER = re.compile(r"\+?[0-9]{5,}-.*")
"""An instant after the year 9999, which stands for none."""


@dataclass(slots=True, kw_only=True)
class OrderStop:
    """A stop of an order: its place as written, work time [s], change of load and actions."""

    at: Source
    work: Fraction | None = None
    load: int = 0
    actions: tuple[str, ...] = ()


@dataclass(slots=True, kw_only=True)
class ForeignOrder:
    """An order of another program; instants are seconds since 1970.

    Attributes
    ----------
    source
        Its place in the file.
    name
        A name of its own.
    stops
        Its stops, in order.
    known, earliest, due
        When it was made, when it may begin, and until when it is wanted; None where the file does
        not say it.
    weight
        How much it counts.
    robot, kind
        The only robot, and the only type of robots that may do it.
    after
        Orders that end before it begins.
    keys
        For keys of a job, the values in the file.
    """

    source: Source
    name: str
    stops: list[OrderStop] = field(default_factory=list)
    known: Fraction | None = None
    earliest: Fraction | None = None
    due: Fraction | None = None
    weight: Fraction = Fraction(1)
    robot: str | None = None
    kind: str | None = None
    after: list[str] = field(default_factory=list)
    keys: dict[str, Source] = field(default_factory=dict)


@dataclass(slots=True, kw_only=True)
class OrderFile:
    """The orders of a file, and what was left out of it.

    Attributes
    ----------
    orders
        In the order of the file.
    faults
        Faults of orders that cannot be read.
    left_out
        For each reason the names of orders.
    """

    orders: list[ForeignOrder] = field(default_factory=list)
    faults: Faults = field(default_factory=Faults)
    left_out: dict[str, list[str]] = field(default_factory=dict)

    def leave_out(self, name: str, why: str) -> None:
        """Note that an order, or a part of one, is left out; ``why`` is a kind of facts."""
        self.left_out.setdefault(why, []).append(name)

    def list_notes(self) -> Iterator[Fact]:
        """Yield a note on each reason for which orders are left out."""
        for why, names in self.left_out.items():
            yield Fact("orders left out", names=tuple(names), number=len(names), why=Fact(why))


def read_instant(source: Source) -> Fraction | None:
    """Return an instant as ISO 8601 has it [s since 1970]; None for one that is never.

    An instant without a zone is in UTC.
    """
    text = source.read_text()
    if NEVER.fullmatch(text):
        return None
    try:
        instant = datetime.fromisoformat(text)
    except ValueError:
        message = f"{text!r} is no instant (give one like 2026-11-28T06:00:00Z)"
        raise source.make_fault(message) from None
    instant = instant if instant.tzinfo else instant.replace(tzinfo=UTC)
    passed = instant - datetime(1970, 1, 1, tzinfo=UTC)
    return Fraction(passed.days * 86400 + passed.seconds) + Fraction(passed.microseconds, 10**6)


def balance_loads(order: ForeignOrder, file: OrderFile) -> None:
    """Take the loads of an order away if they do not sum to 0, or unload more than is loaded."""
    load, is_possible = 0, True
    for stop in order.stops:
        load += stop.load
        is_possible &= load >= 0
    if load or not is_possible:
        file.leave_out(order.name, "loads do not match")
        for stop in order.stops:
            stop.load = 0


def make_documents(
    file: OrderFile, begin: Fraction | None, work: Fraction, second: Fraction
) -> tuple[list[dict[str, Any]], dict[Steps, Source]]:
    """Return the orders of a file as jobs of a document, and the places of their values.

    Time 0 is ``begin`` [s since 1970], by default the first instant at which an order was made or
    may begin. ``work`` is the work time at stops without one [s], ``second`` a second [time unit].
    """
    known = [at for order in file.orders for at in (order.known, order.earliest) if at is not None]
    begin = min(known, default=None) if begin is None else begin
    jobs, places = list[dict[str, Any]](), dict[Steps, Source]()
    for order in file.orders:
        job: dict[str, Any] = {"name": order.name}
        path: Steps = ("jobs", len(jobs))
        places[path] = order.source
        job["stops"] = list(_dump_stops(order.stops, work, second))
        for number, stop in enumerate(order.stops):
            places[*path, "stops", number] = stop.at
            places[*path, "stops", number, "at"] = stop.at
        for key in ("earliest", "due"):
            instant = getattr(order, key)
            if instant is not None:
                job[key] = _count(order.keys[key], instant, begin, second)
        job |= {"robot": order.robot} if order.robot else {}
        job |= {"types": [order.kind]} if order.kind else {}
        job |= {"after": order.after} if order.after else {}
        job |= {"weight": format_number(order.weight)} if order.weight != 1 else {}
        names = {"kind": "types"}
        places |= {(*path, names.get(k, k)): value for k, value in order.keys.items()}
        jobs.append(job)
    return jobs, places


def _dump_stops(
    stops: Sequence[OrderStop], work: Fraction, second: Fraction
) -> Iterable[dict[str, Any]]:
    for stop in stops:
        seconds = work if stop.work is None else stop.work
        yield {
            "at": stop.at.value,
            **({"work": format_number(seconds * second)} if seconds else {}),
            **({"load": stop.load} if stop.load else {}),
            **({"actions": list(stop.actions)} if stop.actions else {}),
        }


def _count(source: Source, instant: Fraction, begin: Fraction | None, second: Fraction) -> Any:
    """Return an instant as a time of the scenario; one before time 0 is time 0."""
    if begin is None:
        message = "needs the instant of time 0 (give jobs: {table: …, begin: 2026-11-28T06:00:00Z})"
        raise InputError.at(source.location, message)
    return format_number(max(instant - begin, Fraction(0)) * second)


def locate_file(places: dict[Steps, Source], file: str, names_it: Steps) -> dict[Steps, Where]:
    """Return values of a file as places of the document that names the file."""
    return {
        steps: Location(
            path=names_it, inner=Location(file=file, line=source.line, path=source.path)
        )
        for steps, source in places.items()
    }
