"""The cheapest track of one robot where it may overlap bookings at a price, by trying every tick.

Slow and obvious: Dijkstra's algorithm over (tick, vertex, stages done, since when free to go, which
bookings of the vertex have been paid for).
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from rightofway.model import Itinerary, Roadmap
from tests.oracles.sipp import Booked

__all__ = ["cheapest_track"]


class _State(NamedTuple):
    tick: int
    vertex: int
    stage: int
    busy_until: int
    paid: frozenset[int]  # indices of bookings at this vertex that this visit overlaps


def cheapest_track(
    roadmap: Roadmap,
    itinerary: Itinerary,
    booked: Sequence[Booked],
    prices: Sequence[int],
    *,
    headway: int,
    books_ahead: bool,
    horizon: int,
) -> int | None:
    """Return the least completion with prices, None if there is none before the horizon.

    Each booking that a visit overlaps, and each swap, is paid once a visit.
    """
    search = _Ticks(roadmap, itinerary, booked, prices, (headway, books_ahead))
    start = search.overlaps(itinerary.home, 0, 1 + headway)
    first = _State(0, itinerary.home, 0, 0, start)
    heap = [(search.price(start), first.tick, first.vertex, first.stage, 0, sorted(start), first)]
    best, known = None, set()
    while heap:
        cost, *_, state = heapq.heappop(heap)
        if state in known:
            continue
        known.add(state)
        done = search.completion(state)
        if done is not None and (best is None or cost + done < best):
            best = cost + done
        for more, after in search.moves(state):
            if after.tick <= horizon and after not in known:
                key = (cost + more, after.tick, after.vertex, after.stage, after.busy_until)
                heapq.heappush(heap, (*key, sorted(after.paid), after))
    return best


class _Ticks:
    def __init__(
        self,
        roadmap: Roadmap,
        itinerary: Itinerary,
        booked: Sequence[Booked],
        prices: Sequence[int],
        rules: tuple[int, bool],
    ) -> None:
        self.roadmap, self.itinerary = roadmap, itinerary
        self.booked, self.prices = booked, prices
        self.headway, self.books_ahead = rules

    def overlaps(self, vertex: int, start: int, end: int) -> frozenset[int]:
        return frozenset(
            index
            for index, b in enumerate(self.booked)
            if b.vertex == vertex and b.start < end and start < b.end
        )

    def price(self, bookings: frozenset[int]) -> int:
        return sum(self.prices[self.booked[index].robot] for index in bookings)

    def swaps(self, tail: int, head: int, tick: int) -> int:
        """Return the prices of robots that leave the head for the tail at this very tick."""
        leaving = {b.robot for b in self.booked if b.vertex == head and b.end == tick}
        coming = {b.robot for b in self.booked if b.vertex == tail and b.start == tick}
        return sum(self.prices[robot] for robot in leaving & coming)

    def completion(self, state: _State) -> int | None:
        """Return completion and prices if the robot stays for ever from now on."""
        rest = self.itinerary.stages[state.stage :]
        if any(stage.vertex != state.vertex for stage in rest):
            return None
        met = self.overlaps(state.vertex, state.tick, 10**9) - state.paid
        begin = max(state.tick, state.busy_until)
        return begin + sum(s.work for s in rest) + self.price(met)

    def moves(self, state: _State) -> Iterator[tuple[int, _State]]:
        met = self.overlaps(state.vertex, state.tick, state.tick + 1 + 1 + self.headway)
        yield (
            self.price(met - state.paid),
            state._replace(tick=state.tick + 1, paid=state.paid | met),
        )
        stages = self.itinerary.stages
        if state.stage < len(stages) - 1 and stages[state.stage].vertex == state.vertex:
            stage = stages[state.stage]
            until = max(state.tick, state.busy_until) + stage.work + stage.turn
            yield 0, state._replace(stage=state.stage + 1, busy_until=until)
        if state.tick >= state.busy_until:
            yield from self._drives(state)

    def _drives(self, state: _State) -> Iterator[tuple[int, _State]]:
        for edge in range(self.roadmap.indptr[state.vertex], self.roadmap.indptr[state.vertex + 1]):
            head = int(self.roadmap.heads[edge])
            ticks = self.itinerary.edge_ticks[self.roadmap.length_class[edge]]
            enter, approach = state.tick + ticks, ticks if self.books_ahead else 0
            here = self.overlaps(state.vertex, state.tick, enter + self.headway) - state.paid
            there = self.overlaps(head, enter - approach, enter + 1 + self.headway)
            price = self.price(here) + self.price(there)
            if not here and not self.headway and not self.books_ahead:
                price += self.swaps(state.vertex, head, enter)
            yield price, _State(enter, head, state.stage, 0, there)
