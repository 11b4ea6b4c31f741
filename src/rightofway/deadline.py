"""When to stop, and a deadline for the work that goes into a scenario and its routes.

A large file takes seconds to read, and its scenario derives arrays and tables when it is made. Both
are done far below the command that has the time limit, so that `limit_work` hands the deadline
down; so are the routes of laps.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

from rightofway.errors import GaveUp
from rightofway.facts import Fact


@dataclass(frozen=True, slots=True)
class Deadline:
    """A moment on the monotonic clock [s]; None never comes."""

    at: float | None = None

    @classmethod
    def after(cls, seconds: float | None) -> Deadline:
        """Return the deadline that many seconds from now."""
        return cls(None if seconds is None else time.monotonic() + seconds)

    def shorten(self, share: float) -> Deadline:
        """Return the deadline of a part of the time that is left."""
        left = self.measure_seconds_left()
        return self if left is None else Deadline.after(share * left)

    def bring_forward(self, seconds: float) -> Deadline:
        """Return the deadline that many seconds earlier; at most half of the time left is lost."""
        left = self.measure_seconds_left()
        return self if left is None else Deadline.after(max(left - seconds, left / 2))

    def measure_seconds_left(self) -> float | None:
        """Return the time until then [s], never negative; None for no limit."""
        return None if self.at is None else max(self.at - time.monotonic(), 0.0)

    def check(self, doing: Fact | str) -> None:
        """Raise `GaveUp` if the moment has come.

        Parameters
        ----------
        doing
            The work, for the error; English text in planners of other packages.

        Raises
        ------
        GaveUp
            With the work that took the time.
        """
        if self.at is not None and time.monotonic() >= self.at:
            raise GaveUp(Fact("time over", doing=doing))


NO_DEADLINE = Deadline()


_deadline: ContextVar[Deadline] = ContextVar("deadline of the work", default=NO_DEADLINE)

READING, DERIVING = Fact("reading the map"), Fact("deriving times of drives")
"""Work on files and scenarios, for errors."""

STEPS_BETWEEN_LOOKS = 256
"""Items of a long loop between two looks at the clock."""

T = TypeVar("T")


@contextmanager
def limit_work(deadline: Deadline) -> Iterator[None]:
    """Limit the work inside that asks `check_work`: reading files, making scenarios of them."""
    token = _deadline.set(deadline)
    try:
        yield
    finally:
        _deadline.reset(token)


def check_work(doing: Fact) -> None:
    """Raise `GaveUp` if the time for such work is over; to be called in long loops."""
    _deadline.get().check(doing)


def measure_work_left() -> float | None:
    """Return how long such work may take [s]; None for no limit."""
    return _deadline.get().measure_seconds_left()


def make_check(doing: Fact) -> Callable[[], None]:
    """Return a function that raises `GaveUp` if the time is over, for threads of a pool, too.

    A thread has no context: its `check_work` knows no deadline.
    """
    return partial(_deadline.get().check, doing)


def limit_loop(items: Iterable[T], doing: Fact, steps: int = STEPS_BETWEEN_LOOKS) -> Iterator[T]:
    """Yield items of a long loop; raise `GaveUp` between two of them if the time is over.

    The clock is looked at each ``steps`` items: fewer where an item takes long.
    """
    for step, item in enumerate(items):
        if step % steps == 0:
            check_work(doing)
        yield item
