"""One row of the table: the places of a track, cut where a mark begins or ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Tick, Track
from rightofway.viz.table.timespace import Cell, Mark, Place, Run

__all__ = ["Span", "runs_of"]

Span = tuple[int, int]
"""From a tick to before another [ticks]."""


def runs_of(
    track: Track,
    window: Span,
    marks: Sequence[tuple[Mark, Sequence[Span]]],
    place: Callable[[int], Place],
) -> Iterator[Run]:
    """Yield runs of equal cells.

    Parameters
    ----------
    track
        The track of a robot.
    window
        The ticks that are wanted; no run without any.
    marks
        When each mark holds; where several do, the first is taken.
    place
        What to show for a vertex.
    """
    if window[0] >= window[1]:
        return
    spans = [(mark, _clipped(span, window)) for mark, span in marks]
    enter = np.clip(track.enter, *window)
    cuts = np.unique(np.concatenate([window, enter, *(span.ravel() for _, span in spans)]))
    visits = np.searchsorted(track.enter, cuts[:-1], side="right") - 1
    marked = _first_marks(cuts, spans)
    vertices = track.vertices[visits].tolist()
    for (start, end), vertex, mark in zip(pairwise(cuts.tolist()), vertices, marked, strict=True):
        yield Run(Tick(start), Tick(end), Cell(place(vertex), mark))


def _clipped(spans: Sequence[Span], window: Span) -> NDArray[np.int64]:
    return np.clip(np.array(spans, np.int64).reshape(-1, 2), *window)


def _first_marks(
    cuts: NDArray[np.int64], spans: Sequence[tuple[Mark, NDArray[np.int64]]]
) -> list[Mark | None]:
    """Return the first mark that holds from each cut to the next."""
    marked: list[Mark | None] = [None] * (len(cuts) - 1)
    for mark, span in reversed(spans):
        change = np.zeros(len(cuts), np.int64)
        np.add.at(change, np.searchsorted(cuts, span[:, 0]), 1)
        np.subtract.at(change, np.searchsorted(cuts, span[:, 1]), 1)
        for cut in np.flatnonzero(np.cumsum(change)):
            marked[cut] = mark
    return marked
