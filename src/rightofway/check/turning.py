"""Turning on the spot: by which angle a robot turns in each visit, and how long that takes.

Headings are those of straight lines between vertices. Between edges of which one has no length in
the plane there is no turn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from math import atan2, ceil, degrees
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Plan
from rightofway.site import Roadmap

MICRO = 10**6
"""Angles are whole numbers of 1e-6 degrees."""


def compute_turns(
    plan: Plan, robot: NDArray[np.int64], vertex: NDArray[np.int64], edge: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[Any]]:
    """Return the angle that a robot turns in each visit before its drive, and the ticks for it.

    Returns
    -------
    tuple of ndarray
        Angles [1e-6 degrees], int64, and durations [ticks], Python integers; 0 for robots that turn
        in no time, and where no edge is driven in or out.
    """
    rules = plan.scenario.rules
    rates = [rules.turn_rate if r.turn_rate is None else r.turn_rate for r in plan.scenario.robots]
    angle = np.zeros(len(vertex), np.int64)
    if not any(rates):
        return angle, angle
    turns = np.array([rate is not None for rate in rates])[robot]
    is_corner = turns[1:] & (edge[:-1] >= 0) & (edge[1:] >= 0) & (robot[:-1] == robot[1:])
    visit = np.flatnonzero(is_corner) + 1
    corners = edge[visit - 1] * max(plan.scenario.roadmap.n_edges, 1) + edge[visit]
    _, first, which = np.unique(corners, return_index=True, return_inverse=True)
    angles = list(
        _measure_angles(plan.scenario.roadmap, [vertex[at - 1 : at + 2] for at in visit[first]])
    )
    angle[visit] = np.array(angles, np.int64)[which.reshape(-1)]
    first_angles = _turn_from_headings(plan, turns, vertex, edge)
    begins = np.array([*first_angles], np.int64)
    angle[begins] = [*first_angles.values()]
    return angle, _count_ticks(plan, rates, robot, angle, np.concatenate((begins, visit)))


def _turn_from_headings(
    plan: Plan, turns: NDArray[np.bool_], vertex: NDArray[np.int64], edge: NDArray[np.int64]
) -> dict[int, int]:
    """Return the angle from the heading of a robot to its first drive, by its first visit."""
    angles, begin, work = dict[int, int](), 0, plan.scenario.problem.work
    for robot, track in enumerate(plan.tracks):
        heading = None if work is None else work.robots[robot].heading
        if heading is not None and turns[begin] and edge[begin] >= 0:
            ends = (_place(plan.scenario.roadmap, at) for at in vertex[begin : begin + 2].tolist())
            (x, y), (to_x, to_y) = ends
            if (to_x, to_y) != (x, y):
                turned = abs(Fraction(degrees(atan2(to_y - y, to_x - x))) - heading) % 360
                angles[begin] = round(min(turned, 360 - turned) * MICRO)
        begin += len(track)
    return angles


def _count_ticks(
    plan: Plan,
    rates: Sequence[Fraction | None],
    robot: NDArray[np.int64],
    angle: NDArray[np.int64],
    visit: NDArray[np.int64],
) -> NDArray[Any]:
    """Return how long the turns in some visits take [ticks]; Python integers, 0 elsewhere."""
    ticks, tick = np.zeros(len(angle), object), plan.scenario.problem.clock.tick
    of_rate = {rate: number for number, rate in enumerate(dict.fromkeys(rates))}
    number = np.array([of_rate[rate] for rate in rates])[robot[visit]]
    _, first, which = np.unique(
        angle[visit] * len(of_rate) + number, return_index=True, return_inverse=True
    )
    durations = [
        ceil(Fraction(int(angle[at]), MICRO) / rate / tick)
        for at in visit[first].tolist()
        if (rate := rates[robot[at]]) is not None
    ]
    ticks[visit] = np.array(durations, object)[which.reshape(-1)]
    return ticks


def _measure_angles(roadmap: Roadmap, corners: Iterable[NDArray[np.int64]]) -> Iterator[int]:
    """Yield the angle between the drives along three vertices, the shorter way [1e-6 degrees]."""
    known: dict[tuple[Fraction | int, ...], int] = {}
    for corner in corners:
        (x, y), (at_x, at_y), (to_x, to_y) = (_place(roadmap, vertex) for vertex in corner.tolist())
        drives = (at_x - x, at_y - y, to_x - at_x, to_y - at_y)
        if drives not in known:
            known[drives] = _measure_angle(*(Fraction(drive) for drive in drives))
        yield known[drives]


def _measure_angle(in_x: Fraction, in_y: Fraction, out_x: Fraction, out_y: Fraction) -> int:
    if in_x == in_y == 0 or out_x == out_y == 0:
        return 0
    along, across = in_x * out_x + in_y * out_y, in_x * out_y - in_y * out_x
    largest = max(abs(along), abs(across))
    sine, cosine = Fraction(abs(across), largest), Fraction(along, largest)
    return round(degrees(atan2(sine, cosine)) * MICRO)


def _place(roadmap: Roadmap, vertex: int) -> tuple[Fraction | int, Fraction | int]:
    if roadmap.grid is not None:
        row, column = roadmap.grid.get_cell(vertex)
        return column, row  # whole cells: fractions are slow to compare
    return roadmap.get_position(vertex)
