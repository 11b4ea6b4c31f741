"""Lanes of a drawn roadmap that cross where no vertex is.

Robots with a radius book such a crossing, and robots without one if a zone holds both lanes. A
reader warns of the other crossings.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Scenario
from rightofway.phrases import Phrase, say_count
from rightofway.site import Roadmap
from rightofway.site.zones import ZoneGuard

SLACK = 1e-9
"""Part of a lane's length by which lanes have to pass beyond each other to count as crossing."""

MAX_LANES = 5_000
"""Larger roadmaps are not searched."""


def note_crossings(scenario: Scenario) -> Iterator[Phrase]:
    """Yield a note on lanes that cross without a vertex or a zone, if no robot has a size."""
    roadmap = scenario.roadmap
    if roadmap.grid is not None or any(robot.radius for robot in scenario.robots):
        return
    lanes = _lanes(roadmap)
    if len(lanes) > MAX_LANES:
        return
    guard, ends = ZoneGuard(roadmap), list(map(tuple, lanes.tolist()))
    crossings = [
        (ends[lane], ends[other])
        for lane, other in _crossings(roadmap.positions[lanes], lanes)
        if not guard.are_apart([ends[lane]], [ends[other]])
    ]
    if crossings:
        lane, other = (
            Phrase("{tail} to {head}", tail=roadmap.name(tail), head=roadmap.name(head))
            for tail, head in crossings[0]
        )
        pairs = len(crossings) - 1
        fact = Phrase(
            "the lanes {lane} and {other} cross where no vertex is", lane=lane, other=other
        )
        if pairs:
            more = say_count(pairs, "more pair", "more pairs")
            fact = Phrase("{fact} ({more})", fact=fact, more=more)
        yield Phrase(
            "{fact}: robots without a radius may meet there (give robots a radius, or put a vertex"
            " there)",
            fact=fact,
        )


def _lanes(roadmap: Roadmap) -> NDArray[np.int64]:
    """Return both ends of each lane, whichever ways it is driven, from left to right."""
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
    ends = np.sort(np.column_stack((tails, roadmap.heads)), axis=1)
    lanes: NDArray[np.int64] = np.unique(ends, axis=0).astype(np.int64)
    return lanes[np.argsort(roadmap.positions[lanes][:, :, 0].min(axis=1), kind="stable")]


def _crossings(drawn: NDArray[np.float64], lanes: NDArray[np.int64]) -> Iterator[tuple[int, int]]:
    """Yield pairs of lanes whose inner points meet; lanes that share an end do not."""
    left, right = drawn[:, :, 0].min(axis=1), drawn[:, :, 0].max(axis=1)
    for lane in range(len(lanes)):
        others = np.arange(lane + 1, np.searchsorted(left, right[lane], side="right"))
        others = others[~np.isin(lanes[others], lanes[lane]).any(axis=1)]
        apart = _on_both_sides(drawn[lane][None], drawn[others]) & _on_both_sides(
            drawn[others], drawn[lane][None]
        )
        for other in others[apart].tolist():
            yield lane, other


def _on_both_sides(line: NDArray[np.float64], of: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return whether the ends of each lane lie on different sides of a line, and not on it."""
    along = line[:, 1] - line[:, 0]
    first, other = (
        along[:, 0] * (of[:, end, 1] - line[:, 0, 1])
        - along[:, 1] * (of[:, end, 0] - line[:, 0, 0])
        for end in (0, 1)
    )
    slack = SLACK * (along**2).sum(axis=1)
    apart: NDArray[np.bool_] = (np.minimum(first, other) < -slack) & (
        np.maximum(first, other) > slack
    )
    return apart
