"""Turning on the spot: by which angle a robot turns in each visit, and how long that takes.

Headings are those of straight lines between vertices. Between edges of which one has no length in
the plane there is no turn.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan2, ceil, degrees
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Plan, Roadmap

MICRO = 10**6
"""Angles are whole numbers of 1e-6 degrees."""

Corner = tuple[int, int, int]
"""Three vertices that a robot visits one after another."""


def turns_of(
    plan: Plan, robot: NDArray[np.int64], vertex: NDArray[np.int64], edge: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[Any]]:
    """Return the angle that a robot turns in each visit before its drive, and the ticks for it.

    Parameters
    ----------
    plan
        The plan.
    robot, vertex, edge
        Of each visit, whose it is, where, and the edge that ends it, -1 for none; shape (n,).

    Returns
    -------
    tuple of ndarray
        Angles [1e-6 degrees], int64, and durations [ticks], Python integers; 0 for robots that turn
        in no time, and where no edge is driven in or out.
    """
    rules, clock = plan.scenario.rules, plan.scenario.problem.clock
    rates = [rules.turn_rate if r.turn_rate is None else r.turn_rate for r in plan.scenario.robots]
    angle, ticks = np.zeros(len(vertex), np.int64), np.zeros(len(vertex), object)
    turns = np.array([rate is not None for rate in rates])[robot]
    is_corner = turns[1:] & (edge[:-1] >= 0) & (edge[1:] >= 0) & (robot[:-1] == robot[1:])
    known: dict[Corner, int] = {}
    durations: dict[tuple[int, Fraction], int] = {}
    for visit in (np.flatnonzero(is_corner) + 1).tolist():
        corner = (int(vertex[visit - 1]), int(vertex[visit]), int(vertex[visit + 1]))
        if corner not in known:
            known[corner] = _angle(plan.scenario.roadmap, corner)
        rate = rates[robot[visit]]
        assert rate is not None, "or it is no corner"
        turn = (known[corner], rate)
        if turn not in durations:
            durations[turn] = ceil(Fraction(known[corner], MICRO) / rate / clock.tick)
        angle[visit], ticks[visit] = known[corner], durations[turn]
    return angle, ticks


def _angle(roadmap: Roadmap, corner: Corner) -> int:
    """Return the angle between two straight drives, the shorter way round [1e-6 degrees]."""
    (x, y), (at_x, at_y), (to_x, to_y) = (_place(roadmap, vertex) for vertex in corner)
    in_x, in_y, out_x, out_y = at_x - x, at_y - y, to_x - at_x, to_y - at_y
    if in_x == in_y == 0 or out_x == out_y == 0:
        return 0
    along, across = in_x * out_x + in_y * out_y, in_x * out_y - in_y * out_x
    largest = max(abs(along), abs(across))
    return round(degrees(atan2(abs(across) / largest, along / largest)) * MICRO)


def _place(roadmap: Roadmap, vertex: int) -> tuple[Fraction, Fraction]:
    if roadmap.grid is not None:
        row, column = roadmap.grid.cell(vertex)
        return Fraction(column), Fraction(row)
    x, y = roadmap.positions[vertex].tolist()
    return Fraction(str(x)), Fraction(str(y))
