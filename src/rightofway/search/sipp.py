"""Safe interval path planning: the earliest track of one robot among the bookings of the others.

A state is (vertex, safe interval, stage). In one safe interval of one vertex, being there earlier
is never worse than being there later, for whoever is early can wait; so each state is expanded
once, at its earliest time. Stops, work and the way home are stages and cost nothing extra.

References
----------
Phillips & Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from rightofway.model import Itinerary, Tick, Track
from rightofway.search.bookings import FOREVER, Booking, Bookings
from rightofway.search.distances import Distances

__all__ = ["earliest_track"]


class _State(NamedTuple):
    """Where the robot is, in which gap between bookings, and how many stages it has done."""

    vertex: int
    gap: int
    stage: int


class _Gap(NamedTuple):
    """A time in which nobody else books a vertex; who books it before and after (-1: nobody)."""

    start: Tick
    end: Tick
    before: int
    after: int


@dataclass(slots=True)
class _Search:
    bookings: Bookings
    distances: Distances
    itinerary: Itinerary
    to_go: list[int]
    """Ticks from each stage's vertex to completion, that stage's dwell included."""
    gaps: dict[int, list[_Gap]]

    def gaps_at(self, vertex: int) -> list[_Gap]:
        if vertex not in self.gaps:
            self.gaps[vertex] = list(_gaps(self.bookings.at(vertex)))
        return self.gaps[vertex]

    def least_rest(self, vertex: int, stage: int) -> int:
        """Return the least ticks from here to completion, -1 if there is no way."""
        if stage == len(self.itinerary.stages):
            return 0
        target = self.itinerary.stages[stage].vertex
        way = int(self.distances.to(target, self.itinerary.edge_ticks)[vertex])
        return way if way < 0 else way + self.to_go[stage]

    def successors(self, state: _State, ready: int) -> Iterator[tuple[_State, int, int]]:
        """Yield (state, when it is entered, when it may be left) for all that can come next."""
        yield from self._serve(state, ready)
        roadmap = self.bookings.roadmap
        for edge in range(int(roadmap.indptr[state.vertex]), int(roadmap.indptr[state.vertex + 1])):
            ticks = self.itinerary.edge_ticks[roadmap.length_class[edge]]
            yield from self._drive(state, ready, int(roadmap.heads[edge]), ticks)

    def _serve(self, state: _State, ready: int) -> Iterator[tuple[_State, int, int]]:
        """Do the work of the next stage, if this is its vertex and the gap is long enough."""
        stages = self.itinerary.stages
        if state.stage == len(stages) or stages[state.stage].vertex != state.vertex:
            return
        stage, gap = stages[state.stage], self.gaps_at(state.vertex)[state.gap]
        last = state.stage == len(stages) - 1
        done = ready + stage.work + (0 if last else stage.turn)
        if gap.end == FOREVER if last else done <= gap.end:
            yield _State(state.vertex, state.gap, state.stage + 1), -1, done

    def _drive(
        self, state: _State, ready: int, head: int, ticks: int
    ) -> Iterator[tuple[_State, int, int]]:
        """Drive an edge into each gap of its head that can be reached before this gap ends."""
        here = self.gaps_at(state.vertex)[state.gap]
        latest = here.end if here.end == FOREVER else here.end - self.bookings.headway
        approach = ticks if self.bookings.books_ahead else 0
        for index, gap in enumerate(self.gaps_at(head)):
            enter = max(ready + ticks, gap.start + approach)
            if gap.start + approach > latest:
                break
            is_swap = enter == gap.start == here.end and gap.before == here.after
            if enter <= latest and enter < gap.end and not is_swap:
                yield _State(head, index, state.stage), enter, enter


def earliest_track(
    itinerary: Itinerary, bookings: Bookings, distances: Distances, *, max_expansions: int = 10**6
) -> Track | None:
    """Find the track of one robot that completes first and overlaps no booking.

    Parameters
    ----------
    itinerary
        What the robot has to do.
    bookings
        What the other robots have booked.
    distances
        Tables for the lower bounds that guide the search.
    max_expansions
        After so many states the search ends without a track.

    Returns
    -------
    Track or None
        None if there is no such track (or the search grew too large).

    Notes
    -----
    Complete and optimal for one robot among fixed bookings, and deterministic.
    """
    search = _Search(bookings, distances, itinerary, _to_go(itinerary, distances), {})
    home = search.gaps_at(itinerary.home)
    if not home or home[0].start > 0 or search.least_rest(itinerary.home, 0) < 0:
        return None
    first = _State(itinerary.home, 0, 0)
    ready: dict[_State, int] = {first: 0}
    came: dict[_State, tuple[_State, int] | None] = {first: None}
    queue = [(search.least_rest(itinerary.home, 0), 0, 0, first)]
    closed: set[_State] = set()
    pushed = 0
    while queue and len(closed) < max_expansions:
        _, _, _, state = heapq.heappop(queue)
        if state in closed:
            continue
        if state.stage == len(itinerary.stages):
            return _unwind(state, came)
        closed.add(state)
        for after, enter, free in search.successors(state, ready[state]):
            rest = search.least_rest(after.vertex, after.stage)
            if rest >= 0 and free < ready.get(after, FOREVER):
                ready[after], came[after] = free, (state, enter)
                pushed += 1
                heapq.heappush(queue, (free + rest, rest, pushed, after))
    return None


def _gaps(bookings: list[Booking]) -> Iterator[_Gap]:
    start, before = Tick(-FOREVER), -1
    for booking in bookings:
        if booking.start > start:
            yield _Gap(start, booking.start, before, booking.robot)
        start, before = booking.end, booking.robot
    if start < FOREVER:
        yield _Gap(start, FOREVER, before, -1)


def _to_go(itinerary: Itinerary, distances: Distances) -> list[int]:
    stages = itinerary.stages
    to_go = [int(stages[-1].work)]
    for stage, after in zip(stages[-2::-1], stages[:0:-1], strict=True):
        way = int(distances.to(after.vertex, itinerary.edge_ticks)[stage.vertex])
        to_go.append(to_go[-1] + way + stage.work + stage.turn)
    return to_go[::-1]


def _unwind(state: _State, came: dict[_State, tuple[_State, int] | None]) -> Track:
    vertices, enters = [], []
    step = came[state]
    while step is not None:
        before, enter = step
        if enter >= 0:  # a move; serving a stage enters nothing
            vertices.append(state.vertex)
            enters.append(enter)
        state, step = before, came[before]
    vertices.append(state.vertex)
    enters.append(0)
    return Track.of(vertices[::-1], enters[::-1])
