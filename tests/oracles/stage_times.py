"""The cheapest track of one robot whose stages have times, among bookings, by trying every tick.

Slow and obvious: all (tick, vertex, stages done, until when it works, the turn that it owes for the
work of this visit, the vertex before) with the least cost that leads there, up to a horizon.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from rightofway.model import Itinerary, Stage
from rightofway.site import Roadmap
from tests.oracles.sipp import Booked

__all__ = ["MUCH", "least_cost_in_time"]

FOR_EVER = 10**9

MUCH = 1000
"""A tick of service costs more than any completion."""


class _State(NamedTuple):
    vertex: int
    stage: int
    busy_until: int
    turn: int = 0
    before: int = -1
    last_end: int = 0


def least_cost_in_time(
    roadmap: Roadmap,
    itinerary: Itinerary,
    booked: Sequence[Booked],
    *,
    headway: int,
    books_ahead: bool,
    horizon: int,
    turn: Callable[[int, int, int], int] = lambda *_: 0,
    late: Fraction | None = None,
) -> Fraction | None:
    """Return the least cost of a track, None if no trip ends before the horizon.

    The cost is the completion and the surcharges. With ``late``, a tick of an end of a stage costs
    `MUCH` times its weight more. ``turn`` gives the ticks to turn at a
    vertex between the vertex before, or -1, and the one after.
    """
    search = _Ticks(
        roadmap=roadmap,
        itinerary=itinerary,
        booked=booked,
        headway=headway,
        books_ahead=books_ahead,
        turn=turn,
        late=late,
    )
    layers: list[dict[_State, Fraction]] = [{} for _ in range(horizon + 1)]
    if search.is_free(itinerary.home, 0, 1):
        layers[0][_State(itinerary.home, 0, 0)] = Fraction(0)
    best: Fraction | None = None
    for tick in range(horizon + 1):
        to_do = list(layers[tick])
        while to_do:
            state = to_do.pop()
            paid = layers[tick][state]
            done = search.finish(state, tick)
            if done is not None and (best is None or done + paid < best):
                best = done + paid
            for enter, after, cost in search.list_moves(state, tick):
                if enter <= horizon and paid + cost < layers[enter].get(after, math.inf):
                    layers[enter][after] = paid + cost
                    to_do += [after] if enter == tick else []
    return best


@dataclass(frozen=True, kw_only=True)
class _Ticks:
    roadmap: Roadmap
    itinerary: Itinerary
    booked: Sequence[Booked]
    headway: int
    books_ahead: bool
    turn: Callable[[int, int, int], int]
    late: Fraction | None

    @property
    def stages(self) -> tuple[Stage, ...]:
        return self.itinerary.stages_to_serve

    def is_free(self, vertex: int, start: int, end: int) -> bool:
        return all(b.vertex != vertex or b.end <= start or end <= b.start for b in self.booked)

    def is_swap(self, tail: int, head: int, tick: int) -> bool:
        leaving = {b.robot for b in self.booked if b.vertex == head and b.end == tick}
        coming = {b.robot for b in self.booked if b.vertex == tail and b.start == tick}
        return bool(leaving & coming)

    def cost_of_end(self, stage: int, end: int) -> Fraction:
        if self.late is None:
            return Fraction(0)
        one = self.stages[stage]
        delay = 0 if one.due is None else max(0, end - one.due)
        return MUCH * one.weight * (end + self.late * delay)

    def finish(self, state: _State, tick: int) -> Fraction | None:
        """Return what is still to pay if the robot stays here for ever from this tick on."""
        stages, ends_anywhere = self.stages, self.itinerary.ends_anywhere
        if tick < state.busy_until or tick < self.itinerary.ready:
            return None  # at that tick it will not have moved either
        if state.stage < len(stages) - (0 if ends_anywhere else 1):
            return None
        if not self.is_free(state.vertex, tick, FOR_EVER):
            return None
        if ends_anywhere:
            done = state.last_end if stages else tick
            return Fraction(done)
        last = stages[-1]
        end = max(tick, last.earliest) + last.work
        if state.vertex != last.vertex or (last.latest is not None and end > last.latest):
            return None
        return end + self.cost_of_end(len(stages) - 1, end)

    def list_moves(self, state: _State, tick: int) -> Iterator[tuple[int, _State, Fraction]]:
        if self.is_free(state.vertex, tick, tick + 1 + self.headway):
            busy_until = state.busy_until if state.busy_until > tick + 1 else 0
            yield tick + 1, state._replace(busy_until=busy_until), Fraction(0)
        if tick >= max(state.busy_until, self.itinerary.ready):
            yield from self.list_services(state, tick)
            yield from self.list_drives(state, tick)

    def list_services(self, state: _State, tick: int) -> Iterator[tuple[int, _State, Fraction]]:
        if state.stage == len(self.stages) - (0 if self.itinerary.ends_anywhere else 1):
            return
        stage = self.stages[state.stage]
        end = tick + stage.work
        if (
            state.vertex == stage.vertex
            and tick >= stage.earliest
            and (stage.latest is None or end <= stage.latest)
        ):
            after = state._replace(
                stage=state.stage + 1,
                busy_until=end,
                turn=stage.turn,
                last_end=end if self.itinerary.ends_anywhere else 0,
            )
            yield tick, after, self.cost_of_end(state.stage, end)

    def list_drives(self, state: _State, tick: int) -> Iterator[tuple[int, _State, Fraction]]:
        for edge in range(self.roadmap.indptr[state.vertex], self.roadmap.indptr[state.vertex + 1]):
            head = int(self.roadmap.heads[edge])
            length_class = self.roadmap.class_of_edge[edge]
            ticks = self.itinerary.edge_ticks[length_class]
            turned = self.turn(state.before, state.vertex, head) + state.turn
            enter, approach = tick + turned + ticks, ticks if self.books_ahead else 0
            if (
                self.is_free(state.vertex, tick, enter + self.headway)
                and self.is_free(head, enter - approach, enter + 1 + self.headway)
                and not self.is_swap(state.vertex, head, enter)
            ):
                surcharges = self.itinerary.surcharges
                paid = surcharges[length_class] if surcharges else 0
                before = -1 if self.itinerary.turning is None else state.vertex
                after = _State(head, state.stage, 0, before=before, last_end=state.last_end)
                yield enter, after, Fraction(paid)
