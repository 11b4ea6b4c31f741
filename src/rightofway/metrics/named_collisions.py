"""Collisions, swaps and near misses in one list by time, with the names of robots and places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, overload

import numpy as np

from rightofway.deadline import limit_loop
from rightofway.kinds.table import require_one_for_each
from rightofway.metrics.collisions import (
    FINDING,
    Meetings,
    list_collisions,
    list_swaps,
    sort_meetings,
)
from rightofway.metrics.near_misses import NearMiss, NearMisses, list_near_misses
from rightofway.model import NEVER, Scenario, Tick, Track

ROWS_AT_ONCE = 4096
"""Rows of a list of collisions that are made objects at once."""


class NamedCollision(NamedTuple):
    """A collision, a swap or a near miss of robots i and j, with the names of robots and places."""

    i: str
    j: str
    start: Tick
    until: Tick | None
    places: tuple[str, ...]
    kind: str


class NamedCollisions(Sequence[NamedCollision]):
    """Collisions, swaps and near misses by start; rows become objects when they are read.

    Parameters
    ----------
    scenario
        The names of robots and places.
    meetings
        Collisions and swaps.
    near
        Near misses.
    """

    def __init__(self, scenario: Scenario, meetings: Meetings, near: NearMisses) -> None:
        self._scenario, self._meetings, self._near = scenario, meetings, near
        starts = np.append(meetings.start, near.start)
        self._order = np.argsort(starts, kind="stable") if len(near.start) else None

    def __len__(self) -> int:
        return len(self._meetings.start) + len(self._near.start)

    @overload
    def __getitem__(self, at: int) -> NamedCollision: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[NamedCollision]: ...
    def __getitem__(self, at: int | slice) -> NamedCollision | Sequence[NamedCollision]:
        rows = range(len(self))[at]
        if isinstance(rows, int):
            return self._list_rows(slice(rows, rows + 1))[0]
        return self._list_rows(at if isinstance(at, slice) else slice(None))

    def __iter__(self) -> Iterator[NamedCollision]:
        for first in limit_loop(range(0, len(self), ROWS_AT_ONCE), FINDING, 1):
            yield from self._list_rows(slice(first, first + ROWS_AT_ONCE))

    def count_kinds(self) -> dict[str, int]:
        """Return the number of rows of each kind: collision, swap, too near."""
        n_swaps = int(np.count_nonzero(self._meetings.other >= 0))
        n_collisions = len(self._meetings.start) - n_swaps
        return {"collision": n_collisions, "swap": n_swaps, "too near": len(self._near.start)}

    def _list_rows(self, chosen: slice) -> list[NamedCollision]:
        if self._order is None:
            return list(map(self._name, self._meetings.list_rows(chosen)))
        rows, n_meetings = self._order[chosen], len(self._meetings.start)
        is_near = rows >= n_meetings
        met = map(self._name, self._meetings.list_rows(rows[~is_near]))
        near = map(self._name_near, self._near.make_rows(rows[is_near] - n_meetings))
        return [next(near if is_of_near else met) for is_of_near in is_near.tolist()]

    def _name(self, row: tuple[int, ...]) -> NamedCollision:
        i, j, start, end, vertex, other = row
        robots, place = self._scenario.robots, self._scenario.roadmap.name
        vertices = (vertex,) if other < 0 else (vertex, other)
        return NamedCollision(
            robots[i].name,
            robots[j].name,
            Tick(start),
            None if end == NEVER else Tick(end),
            tuple(map(place, vertices)),
            "collision" if other < 0 else "swap",
        )

    def _name_near(self, miss: NearMiss) -> NamedCollision:
        robots, place = self._scenario.robots, self._scenario.roadmap.name
        return NamedCollision(
            robots[miss.robots[0]].name,
            robots[miss.robots[1]].name,
            miss.start,
            miss.end,
            tuple("-".join(map(place, vertices)) for vertices in miss.places),
            "too near",
        )


def name_collisions(scenario: Scenario, tracks: Sequence[Track]) -> NamedCollisions:
    """Return the collisions, swaps and near misses of any tracks, by time, with names of places.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.

    Raises
    ------
    InputError
        If there are more than `MOST_MEETINGS` collisions, swaps or overlaps of near places.
    """
    require_one_for_each(scenario.robots, tracks=tracks)
    parts = [list_collisions(scenario, tracks), list_swaps(tracks)]
    meetings = sort_meetings(
        *((part.i, part.j, part.start, part.end, part.vertex, part.other) for part in parts)
    )
    return NamedCollisions(scenario, meetings, list_near_misses(scenario, tracks))
