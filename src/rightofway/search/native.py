"""The native core: its twin of a problem, and what compiled it."""

from __future__ import annotations

from itertools import pairwise
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import Problem, Track

__all__ = ["bound", "compiler", "tracks_of"]

_BOUND: WeakKeyDictionary[Problem, _core.Problem] = WeakKeyDictionary()


def bound(problem: Problem) -> _core.Problem:
    """Return the native twin of a problem, which is made once and kept with it."""
    native = _BOUND.get(problem)
    if native is None:
        roadmap = problem.roadmap
        native = _BOUND[problem] = _core.Problem(
            roadmap.indptr,
            roadmap.heads,
            roadmap.length_class,
            *problem.arrays,
            n_classes=len(roadmap.lengths),
            headway=problem.headway,
            books_ahead=problem.books_ahead,
            rotations=problem.rotations,
        )
    return native


def tracks_of(
    first_visit: NDArray[np.int32], vertices: NDArray[np.int32], enter: NDArray[np.int64]
) -> list[Track]:
    """Return a track for each robot, whose visits begin at ``first_visit`` (int32[R + 1])."""
    return [
        Track(vertices=vertices[first:last].copy(), enter=enter[first:last].copy())
        for first, last in pairwise(first_visit.tolist())
    ]


def compiler() -> str:
    """Return the name and version of what compiled the native core, like ``GCC 12.2.0``."""
    return _core.compiler()
