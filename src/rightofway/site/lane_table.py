"""The lanes of a layout as columns: an object is made of a lane where somebody asks for it.

A layout may have a million lanes. Names of vertices, limits and types are kept once, lengths as
whole numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import ceil
from typing import NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, quote
from rightofway.site.geometry import Point

BILLION = 10**9
"""Lengths are whole billionths of a metre."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutEdge:
    """A directed lane.

    Attributes
    ----------
    tail, head
        Names of the vertices it leaves and enters.
    length
        Its length [m], not below the straight distance.
    max_speed
        Speed limit [m/s]; None for none.
    types
        Vehicle types that may use it; None for all.
    shape
        Points between its ends where it is drawn [m]; empty for a straight lane.
    chord_error
        How far at most a curve that robots drive along is from the straight lines between these
        points [m]; None where robots drive straight, whatever is drawn.
    """

    tail: str
    head: str
    length: Fraction
    max_speed: Fraction | None = None
    types: frozenset[str] | None = None
    shape: tuple[Point, ...] = ()
    chord_error: Fraction | None = None


class LaneKind(NamedTuple):
    """Common properties of lanes except their length: see `LayoutEdge`."""

    max_speed: Fraction | None
    types: frozenset[str] | None


class LaneShape(NamedTuple):
    """How a lane is drawn: see `LayoutEdge`."""

    points: tuple[Point, ...]
    chord_error: Fraction | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LaneTable(Sequence[LayoutEdge]):
    """The lanes of a level.

    Attributes
    ----------
    names
        Names of the vertices, by number.
    tails, heads
        The vertices that each lane leaves and enters; int32, shape (L,).
    lengths
        The length of each lane [billionths of a metre]; int64, shape (L,).
    kind_of_lane
        Index into `kinds` of each lane; int32, shape (L,).
    kinds
        Common properties of lanes except their length.
    shapes
        How lanes are drawn that are not straight, by index.
    """

    names: tuple[str, ...]
    tails: NDArray[np.int32]
    heads: NDArray[np.int32]
    lengths: NDArray[np.int64]
    kind_of_lane: NDArray[np.int32]
    kinds: tuple[LaneKind, ...]
    shapes: Mapping[int, LaneShape] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.tails)

    @overload
    def __getitem__(self, index: int) -> LayoutEdge: ...
    @overload
    def __getitem__(self, index: slice) -> list[LayoutEdge]: ...
    def __getitem__(self, index: int | slice) -> LayoutEdge | list[LayoutEdge]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        kind = self.kinds[self.kind_of_lane[index]]
        shape = self.shapes.get(range(len(self))[index])
        return LayoutEdge(
            tail=self.names[self.tails[index]],
            head=self.names[self.heads[index]],
            length=Fraction(int(self.lengths[index]), BILLION),
            max_speed=kind.max_speed,
            types=kind.types,
            shape=() if shape is None else shape.points,
            chord_error=None if shape is None else shape.chord_error,
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    def __hash__(self) -> int:
        return hash((len(self), self.names))

    @property
    def ends(self) -> NDArray[np.int64]:
        """A number for tail and head of each lane; int64, shape (L,)."""
        ends: NDArray[np.int64] = self.tails.astype(np.int64) * len(self.names) + self.heads
        return ends

    @property
    def types(self) -> tuple[str, ...]:
        """Names of the vehicle types that lanes are reserved for, sorted."""
        return tuple(sorted({name for kind in self.used_kinds for name in kind.types or ()}))

    @property
    def used_kinds(self) -> list[LaneKind]:
        """The kinds that lanes are of."""
        return [self.kinds[kind] for kind in np.unique(self.kind_of_lane).tolist()]

    def get_ends(self, lane: int) -> tuple[str, str]:
        """Return the names of tail and head of a lane."""
        return self.names[self.tails[lane]], self.names[self.heads[lane]]

    def select(self, vehicle_type: str) -> LaneTable:
        """Return the lanes that a vehicle type may use."""
        is_open = np.array(
            [kind.types is None or vehicle_type in kind.types for kind in self.kinds], bool
        )
        lanes = np.flatnonzero(is_open[self.kind_of_lane])
        number = {lane: k for k, lane in enumerate(lanes.tolist()) if lane in self.shapes}
        return replace(
            self,
            tails=self.tails[lanes],
            heads=self.heads[lanes],
            lengths=self.lengths[lanes],
            kind_of_lane=self.kind_of_lane[lanes],
            shapes={number[lane]: self.shapes[lane] for lane in self.shapes if lane in number},
        )


def tabulate_lanes(names: tuple[str, ...], lanes: Sequence[LayoutEdge]) -> LaneTable:
    """Return lanes as columns; a table is returned as it is.

    Raises
    ------
    InputError
        For a lane from or to a vertex that there is not.
    """
    if isinstance(lanes, LaneTable):
        return lanes
    ids = {name: number for number, name in enumerate(names)}
    for index, lane in enumerate(lanes):
        for end in (lane.tail, lane.head):
            if end not in ids:
                message = f"no vertex is named {quote(end)} (name one of the {len(ids)} vertices)"
                raise InputError.at(("edges", index), message)
    kinds = [LaneKind(lane.max_speed, lane.types) for lane in lanes]
    known = {kind: number for number, kind in enumerate(dict.fromkeys(kinds))}
    return LaneTable(
        names=names,
        tails=np.array([ids[lane.tail] for lane in lanes], np.int32),
        heads=np.array([ids[lane.head] for lane in lanes], np.int32),
        lengths=np.array([ceil(lane.length * BILLION) for lane in lanes], np.int64),
        kind_of_lane=np.array([known[kind] for kind in kinds], np.int32),
        kinds=tuple(known),
        shapes={
            index: LaneShape(lane.shape, lane.chord_error)
            for index, lane in enumerate(lanes)
            if lane.shape or lane.chord_error is not None
        },
    )
