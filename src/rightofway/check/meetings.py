"""Two robots at one vertex: their bookings of it must not overlap."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rightofway.check.pairs import Indices, pairs
from rightofway.check.report import Fault
from rightofway.check.sieve import Sieve
from rightofway.check.visits import Visits
from rightofway.check.words import Words, ticks
from rightofway.model import Plan, Tick, VertexId
from rightofway.model.sorting import order_by

__all__ = ["judge_meetings"]


def judge_meetings(plan: Plan, visits: Visits, words: Words, sieve: Sieve) -> None:
    """Find vertex conflicts, and those that only the headway makes."""
    headway = plan.scenario.problem.headway
    approaches = plan.scenario.rules.occupancy == "both"
    bookings = _crowded_only(_bookings(visits, headway, approaches=approaches))
    judgement = _Meetings(bookings, headway, words, sieve)
    for one, other in pairs(np.arange(len(bookings.start)) + 1, _begun(bookings)):
        strangers = bookings.robot[one] != bookings.robot[other]
        at_once = bookings.start[other] < bookings.leave[one]
        conflict, too_soon = strangers & at_once, strangers & ~at_once
        judgement.take("vertex conflict", one[conflict], other[conflict])
        judgement.take("headway", one[too_soon], other[too_soon])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Bookings:
    """Bookings from `start` to `end`, the headway after `leave` included."""

    robot: NDArray[np.int64]
    vertex: NDArray[np.int64]
    start: NDArray[Any]
    leave: NDArray[Any]
    end: NDArray[Any]
    last: NDArray[np.bool_]

    def only(self, which: NDArray[Any]) -> _Bookings:
        return _Bookings(
            robot=self.robot[which],
            vertex=self.vertex[which],
            start=self.start[which],
            leave=self.leave[which],
            end=self.end[which],
            last=self.last[which],
        )


def _bookings(visits: Visits, headway: int, *, approaches: bool) -> _Bookings:
    """Return all bookings."""
    start = visits.enter
    if approaches:  # a first visit has none: it follows another robot's last one, without a drive
        start = start - np.roll(visits.drive, 1)
    return _Bookings(
        robot=visits.robot,
        vertex=visits.vertex,
        start=start,
        leave=visits.leave,
        end=visits.leave + headway,
        last=visits.last,
    )


def _crowded_only(bookings: _Bookings) -> _Bookings:
    """Return the bookings of vertices where any overlap, by vertex and start.

    Two neighbours in that order overlap then. A booking that does not last at all meets nobody.
    """
    order = order_by(bookings.vertex, bookings.start)
    order = order[bookings.start[order] < bookings.end[order]]
    vertex, start, end = bookings.vertex[order], bookings.start[order], bookings.end[order]
    overlap = (vertex[1:] == vertex[:-1]) & (start[1:] < end[:-1])
    return bookings.only(order[np.isin(vertex, vertex[1:][overlap])])


def _begun(bookings: _Bookings) -> Indices:
    """Return, for each booking, the index after the last one that starts before it ends."""
    count = len(bookings.start)
    times = np.concatenate((bookings.end, bookings.start))
    places = np.concatenate((bookings.vertex, bookings.vertex))
    order = order_by(places, times)  # at one tick, ends come before starts
    is_start = order >= count
    begun = np.empty(count, np.int64)
    begun[order[~is_start]] = np.cumsum(is_start)[~is_start]
    return begun


class _Meetings:
    """Words pairs of bookings that overlap; `one` starts first."""

    def __init__(self, bookings: _Bookings, headway: int, words: Words, sieve: Sieve) -> None:
        self._bookings, self._headway, self._words, self._sieve = bookings, headway, words, sieve

    def take(
        self, kind: Literal["vertex conflict", "headway"], one: Indices, other: Indices
    ) -> None:
        bookings = self._bookings
        message = self._conflict if kind == "vertex conflict" else self._too_soon

        def fault(position: int) -> Fault:
            pair = int(one[position]), int(other[position])
            return Fault(
                kind=kind,
                robots=tuple(sorted(int(bookings.robot[booking]) for booking in pair)),
                vertices=(VertexId(int(bookings.vertex[pair[0]])),),
                tick=Tick(int(bookings.start[pair[1]])),
                message=message(*pair),
            )

        ends = bookings.robot[one], bookings.robot[other]
        robots = np.minimum(*ends), np.maximum(*ends)
        self._sieve.add_all(kind, bookings.start[other], robots, fault)

    def _conflict(self, one: int, other: int) -> str:
        return (
            f"{self._name(one)} books {self._vertex(one)} {self._interval(one)} and"
            f" {self._name(other)} {self._interval(other)} (let one come when the other has left)"
        )

    def _too_soon(self, one: int, other: int) -> str:
        bookings = self._bookings
        gap = bookings.start[other] - bookings.leave[one]
        return (
            f"{self._name(other)} comes to {self._vertex(one)} at tick {bookings.start[other]},"
            f" {ticks(gap)} after {self._name(one)} left, the headway is {self._headway}"
            f" (come at tick {bookings.end[one]} or later)"
        )

    def _name(self, booking: int) -> str:
        return self._words.robot(int(self._bookings.robot[booking]))

    def _vertex(self, booking: int) -> str:
        return self._words.vertex(int(self._bookings.vertex[booking]))

    def _interval(self, booking: int) -> str:
        bookings = self._bookings
        until = "for ever" if bookings.last[booking] else f"to {bookings.leave[booking]}"
        return f"from tick {bookings.start[booking]} {until}"
