"""When to stop, and a time limit for the work that goes into a scenario.

A scenario derives what it needs when it is made, for example the resources that it books. A reader
makes it far below the command that has the time limit, so that `limited_work` hands the limit down.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from rightofway.errors import GaveUp


@dataclass(frozen=True, slots=True)
class Deadline:
    """A moment on the monotonic clock [s]; None never comes."""

    at: float | None = None

    @classmethod
    def after(cls, seconds: float | None) -> Deadline:
        """Return the deadline that many seconds from now."""
        return cls(None if seconds is None else time.monotonic() + seconds)

    def sooner(self, share: float) -> Deadline:
        """Return the deadline of a part of the time that is left."""
        left = self.seconds_left()
        return self if left is None else Deadline.after(share * left)

    def earlier(self, seconds: float) -> Deadline:
        """Return the deadline that many seconds earlier; at most half of the time left is lost."""
        left = self.seconds_left()
        return self if left is None else Deadline.after(max(left - seconds, left / 2))

    def seconds_left(self) -> float | None:
        """Return how long it is until then [s], never negative; None for no limit."""
        return None if self.at is None else max(self.at - time.monotonic(), 0.0)

    def check(self, doing: str) -> None:
        """Raise `GaveUp` if the moment has come.

        Raises
        ------
        GaveUp
            Saying what was being done.
        """
        if self.at is not None and time.monotonic() >= self.at:
            raise GaveUp(f"time ran out while {doing} (give a longer time limit)")


NO_DEADLINE = Deadline()


@dataclass(slots=True)
class WorkLimit:
    """The time limit of work whose beginning is not known yet.

    Attributes
    ----------
    seconds
        How long the work may take [s]; None for no limit.
    deadline
        When it has to end; None before it begins.
    """

    seconds: float | None = None
    deadline: Deadline | None = None

    def begun(self) -> Deadline:
        """Return when the work has to end; if it has not begun, it begins now."""
        if self.deadline is None:
            self.deadline = Deadline.after(self.seconds)
        return self.deadline


_limit: ContextVar[WorkLimit] = ContextVar("work limit")


@contextmanager
def limited_work(limit: WorkLimit) -> Iterator[None]:
    """Limit the work on scenarios that are made inside."""
    token = _limit.set(limit)
    try:
        yield
    finally:
        _limit.reset(token)


def check_work(doing: str) -> None:
    """Raise `GaveUp` if the time for such work is over; to be called in long loops."""
    limit = _limit.get(None)
    if limit is not None:
        limit.begun().check(doing)
