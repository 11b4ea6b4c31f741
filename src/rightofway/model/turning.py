"""Turning on the spot: how long a change of heading takes between two edges.

Two edges that follow each other have a *kind* of angle, as an edge has a class of length; a robot
with a turn rate has ticks for each kind. The heading of an edge is that of the straight line
between its ends. An edge between equal positions, such as a lift, has none: turns into it and out
of it take no time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, quote
from rightofway.model.units import Clock, Tick
from rightofway.site import Roadmap, VertexId

ANGLE_STEP = Fraction(1, 10**6)
"""Angles are rounded to this [degrees]."""

LONGEST_TURN = 2**31 - 1
"""The most ticks of a turn: the native core keeps them in int32."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Angles:
    """The angles between edges that follow each other.

    Attributes
    ----------
    offset
        The angle from edge ``e`` to edge ``f`` is of kind ``kind[offset[e] + f]``; int64, shape
        (E,).
    kind
        Index into `angles`; int32.
    angles
        The distinct angles, the shorter way round, increasing [1e-6 degrees].
    """

    offset: NDArray[np.int64]
    kind: NDArray[np.int32]
    angles: tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Turning:
    """The times in which a robot turns between consecutive edges.

    Attributes
    ----------
    angles
        The angles of the roadmap.
    ticks
        Ticks for each kind of angle; int64.
    rate
        How fast the robot turns [degrees per tick].
    """

    angles: Angles
    ticks: NDArray[np.int64]
    rate: Fraction

    def compute_turn(self, before: int, after: int) -> Tick:
        """Return how long the robot turns between two edges [ticks]; 0 before the first, -1."""
        if before < 0:
            return Tick(0)
        return Tick(int(self.ticks[self.angles.kind[self.angles.offset[before] + after]]))

    def compute_turns(self, edges: NDArray[np.int32]) -> NDArray[np.int64]:
        """Return how long the robot turns between each edge and the next [ticks]; int64."""
        return self.compute_turns_between(edges[:-1], edges[1:])

    def compute_turns_between(
        self, before: NDArray[np.integer], after: NDArray[np.integer]
    ) -> NDArray[np.int64]:
        """Return how long the robot turns between the edges of each pair [ticks]; int64.

        An edge of -1 is none: before and after it nothing turns.
        """
        turns = np.zeros(len(before), np.int64)
        known = np.flatnonzero((before >= 0) & (after >= 0))
        place = self.angles.offset[before[known]] + after[known]
        turns[known] = self.ticks[self.angles.kind[place]]
        return turns


def compute_turnings(
    roadmap: Roadmap, rates: Sequence[Fraction | None], clock: Clock
) -> list[Turning | None]:
    """Return how long each robot turns; None for a robot without a rate.

    Raises
    ------
    InputError
        For a rate at which a turn takes more than `LONGEST_TURN` ticks.
    """
    turnings: dict[Fraction | None, Turning | None] = {None: None}
    for robot, rate in enumerate(rates):
        if rate is not None and rate not in turnings:
            angles = measure_angles(roadmap)
            ticks = [clock.count_ticks(angle * ANGLE_STEP / rate) for angle in angles.angles]
            if ticks and ticks[-1] > LONGEST_TURN:
                longest = f"a turn takes {quote(ticks[-1])} ticks of {quote(clock.tick)}"
                message = f"{quote(rate)} is too slow: {longest} (give a faster one)"
                raise InputError.at(("robots", robot, "turn_rate"), message)
            turnings[rate] = Turning(
                angles=angles, ticks=np.array(ticks, np.int64), rate=rate * clock.tick
            )
    return [turnings[rate] for rate in rates]


def compute_first_turns(
    roadmap: Roadmap, turning: Turning | None, start: int, heading: Fraction | None
) -> tuple[Tick, ...]:
    """Return how long a robot turns from a heading before each edge out of a vertex [ticks].

    Empty where turning takes no time, or the heading is unknown.
    """
    if turning is None or heading is None:
        return ()
    first, end = roadmap.indptr[start : start + 2].tolist()
    return tuple(
        Tick(math.ceil(_count_steps(heading, own) * ANGLE_STEP / turning.rate))
        for own in _list_exact_headings(roadmap)[first:end]
    )


def compute_stop_turn(
    roadmap: Roadmap, turning: Turning | None, vertex: int, heading: Fraction | None
) -> Tick:
    """Return how much longer a robot turns at a vertex where it works in a heading [ticks].

    It turns into the heading and then to the next edge. The result is the longest of these turns
    without the turn from edge to edge, for any two edges at the vertex.
    """
    if turning is None or heading is None or VertexId(vertex) in roadmap.fixed:
        return Tick(0)
    headings, first = _list_exact_headings(roadmap), int(roadmap.indptr[vertex])
    out = headings[first : int(roadmap.indptr[vertex + 1])]
    into = [headings[edge] for edge in np.flatnonzero(roadmap.heads == vertex).tolist()]
    detours = [
        _count_steps(before, heading) + _count_steps(heading, after) - _count_steps(before, after)
        for before, after in product(into, out)
    ]
    return Tick(math.ceil(max(detours, default=0) * ANGLE_STEP / turning.rate))


def _count_steps(heading: Fraction | None, other: Fraction | None) -> int:
    """Return the angle between two headings, the shorter way [1e-6 degrees]; 0 without one."""
    if heading is None or other is None:
        return 0
    angle = abs(heading - other) % 360
    return round(min(angle, 360 - angle) / ANGLE_STEP)


@lru_cache(maxsize=4)
def _list_exact_headings(roadmap: Roadmap) -> list[Fraction | None]:
    """Return the heading of each edge as the fraction that its float is; None where it has none."""
    headings, has_heading = (values.tolist() for values in _measure_headings(roadmap))
    known = {heading: Fraction(heading) for heading in set(headings)}
    pairs = zip(headings, has_heading, strict=True)
    return [known[heading] if is_known else None for heading, is_known in pairs]


def find_heading_on_map(heading: Fraction | None, roadmap: Roadmap) -> Fraction | None:
    """Return a heading on the site in the plane of the map, whose y axis points down [degrees]."""
    if heading is None:
        return None
    turned = heading - _find_yaw(roadmap)
    return (-turned if roadmap.frame.y_up else turned) % 360


def find_heading_on_site(heading: Fraction | None, roadmap: Roadmap) -> Fraction | None:
    """Return a heading in the plane of the map on the site, as states of robots have it [degrees].

    It is the inverse of the binding of `RobotState.heading`.
    """
    if heading is None:
        return None
    return (_find_yaw(roadmap) + (-heading if roadmap.frame.y_up else heading)) % 360


def _find_yaw(roadmap: Roadmap) -> Fraction:
    return round(math.degrees(roadmap.frame.yaw) * ANGLE_STEP.denominator) * ANGLE_STEP


@lru_cache(maxsize=4)
def measure_angles(roadmap: Roadmap) -> Angles:
    """Return the angles between the edges of a roadmap."""
    heading, has_heading = _measure_headings(roadmap)
    first, degree = roadmap.indptr[roadmap.heads].astype(np.int64), np.diff(roadmap.indptr)
    counts = degree[roadmap.heads].astype(np.int64)
    begin = np.cumsum(counts) - counts
    offset = begin - first
    before = np.repeat(np.arange(roadmap.n_edges), counts)
    after = np.arange(len(before)) - np.repeat(offset, counts)
    angle = np.abs(heading[before] - heading[after])
    angle = np.rint(np.minimum(angle, 360 - angle) / float(ANGLE_STEP)).astype(np.int64)
    angle[~(has_heading[before] & has_heading[after])] = 0
    angles, kind = np.unique(angle, return_inverse=True)
    kinds: NDArray[np.int32] = kind.reshape(-1).astype(np.int32)  # NumPy 2.0 keeps an axis
    offset.flags.writeable = kinds.flags.writeable = False
    return Angles(offset=offset, kind=kinds, angles=tuple(angles.tolist()))


def turn_towards(heading: Fraction, towards: Fraction, angle: Fraction) -> Fraction:
    """Return a heading after a turn by an angle towards another one, the shorter way [degrees]."""
    turn = (towards - heading + 180) % 360 - 180
    return towards if angle >= abs(turn) else heading + (angle if turn > 0 else -angle)


def list_headings(roadmap: Roadmap) -> list[Fraction | None]:
    """Return the heading of each edge in the plane of the map [degrees]; None where it has none."""
    headings, has_heading = _measure_headings(roadmap)
    steps = np.rint(headings / float(ANGLE_STEP)).astype(np.int64).tolist()
    known = {step: step * ANGLE_STEP for step in set(steps)}
    return [
        known[step] if is_known else None
        for step, is_known in zip(steps, has_heading.tolist(), strict=True)
    ]


def _measure_headings(roadmap: Roadmap) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the heading of each edge [degrees], and whether it has one."""
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    if roadmap.grid is not None:
        y, x = np.divmod(roadmap.grid.cells.astype(np.int64), roadmap.grid.columns)
        dx, dy = (at[roadmap.heads] - at[tails] for at in (x, y))
    else:
        positions = roadmap.list_positions()
        ends = list(zip(tails.tolist(), roadmap.heads.tolist(), strict=True))
        dx, dy = (
            np.array([float(positions[b][k] - positions[a][k]) for a, b in ends], np.float64)
            for k in (0, 1)
        )
    return np.degrees(np.arctan2(dy, dx)), (dx != 0) | (dy != 0)
