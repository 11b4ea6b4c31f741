"""The cheapest track of one robot among bookings, found by trying every tick.

Slow and obvious: all (tick, vertex, stages done, since when at the vertex it has been free to go,
the vertex before) with the least surcharge that leads there, one tick after the other, up to a
horizon.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from rightofway.model import Itinerary
from rightofway.site import Roadmap

__all__ = ["Booked", "least_cost"]


class Booked(NamedTuple):
    """A robot books a vertex for ``[start, end)``."""

    vertex: int
    start: int
    end: int
    robot: int


class _State(NamedTuple):
    vertex: int
    stage: int
    busy_until: int
    before: int = -1  # the vertex before, where the robot turns in some time


def least_cost(
    roadmap: Roadmap,
    itinerary: Itinerary,
    booked: Sequence[Booked],
    *,
    headway: int,
    books_ahead: bool,
    horizon: int,
    turn: Callable[[int, int, int], int] | None = None,
) -> int | None:
    """Return the least completion and surcharges, None if no trip ends before the horizon.

    ``turn`` gives the ticks to turn at a vertex between the vertex before and the one after.
    """
    search = _Ticks(roadmap, itinerary, booked, headway, books_ahead)
    search.turn = turn
    if not search.free(itinerary.home, 0, 1):
        return None
    layers: list[dict[_State, int]] = [{} for _ in range(horizon + 1)]
    layers[0][_State(itinerary.home, 0, 0)] = 0
    best = None
    for tick in range(horizon + 1):
        to_do = list(layers[tick])
        while to_do:
            state = to_do.pop()
            paid = layers[tick][state]
            done = search.completion(state, tick)
            if done is not None and (best is None or done + paid < best):
                best = done + paid
            for enter, after, surcharge in search.moves(state, tick):
                if enter <= horizon and paid + surcharge < layers[enter].get(after, math.inf):
                    layers[enter][after] = paid + surcharge
                    to_do += [after] if enter == tick else []
    return best


class _Ticks:
    def __init__(
        self,
        roadmap: Roadmap,
        itinerary: Itinerary,
        booked: Sequence[Booked],
        headway: int,
        books_ahead: bool,
    ) -> None:
        self.roadmap, self.itinerary, self.booked = roadmap, itinerary, booked
        self.turn: Callable[[int, int, int], int] | None = None
        self.headway, self.books_ahead = headway, books_ahead

    def free(self, vertex: int, start: int, end: int) -> bool:
        return all(b.vertex != vertex or b.end <= start or end <= b.start for b in self.booked)

    def is_swap(self, tail: int, head: int, tick: int) -> bool:
        """Tell whether a robot leaves the head for the tail at this very tick."""
        leaving = {b.robot for b in self.booked if b.vertex == head and b.end == tick}
        coming = {b.robot for b in self.booked if b.vertex == tail and b.start == tick}
        return bool(leaving & coming)

    def completion(self, state: _State, tick: int) -> int | None:
        """Return when the trip is over if the robot stays here for ever from this tick on."""
        rest = self.itinerary.stages[state.stage :]
        if any(stage.vertex != state.vertex for stage in rest):
            return None
        if not self.free(state.vertex, tick, 10**9):
            return None
        return max(tick, state.busy_until) + sum(stage.work for stage in rest)

    def moves(self, state: _State, tick: int) -> Iterator[tuple[int, _State, int]]:
        yield from self._wait(state, tick)
        yield from self._serve(state, tick)
        if tick >= state.busy_until:
            yield from self._drive(state, tick)

    def _wait(self, state: _State, tick: int) -> Iterator[tuple[int, _State, int]]:
        if self.free(state.vertex, tick, tick + 1 + self.headway):
            busy_until = state.busy_until if state.busy_until > tick + 1 else 0
            yield tick + 1, state._replace(busy_until=busy_until), 0

    def _serve(self, state: _State, tick: int) -> Iterator[tuple[int, _State, int]]:
        stages = self.itinerary.stages
        if state.stage == len(stages) - 1 or stages[state.stage].vertex != state.vertex:
            return  # whoever has served the last stage stays; that is `completion`
        stage = stages[state.stage]
        until = max(tick, state.busy_until) + stage.work + stage.turn
        yield tick, state._replace(stage=state.stage + 1, busy_until=until), 0

    def _drive(self, state: _State, tick: int) -> Iterator[tuple[int, _State, int]]:
        for edge in range(self.roadmap.indptr[state.vertex], self.roadmap.indptr[state.vertex + 1]):
            head = int(self.roadmap.heads[edge])
            length_class = self.roadmap.class_of_edge[edge]
            ticks = self.itinerary.edge_ticks[length_class]
            turned = self.turn(state.before, state.vertex, head) if self.turn else 0
            enter, approach = tick + turned + ticks, ticks if self.books_ahead else 0
            if (
                self.free(state.vertex, tick, enter + self.headway)
                and self.free(head, enter - approach, enter + 1 + self.headway)
                and not self.is_swap(state.vertex, head, enter)
            ):
                before = state.vertex if self.turn else -1
                surcharges = self.itinerary.surcharges
                paid = surcharges[length_class] if surcharges else 0
                yield enter, _State(head, state.stage, 0, before), paid
