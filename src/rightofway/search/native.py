"""The native core: its twin of a problem, and what compiled it."""

from __future__ import annotations

from weakref import WeakKeyDictionary

from rightofway import _core
from rightofway.model import Problem

__all__ = ["bound", "compiler"]

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


def compiler() -> str:
    """Return the name and version of what compiled the native core, like ``GCC 12.2.0``."""
    return _core.compiler()
