"""The record of a demo: its simulated time, its journal, and the commands of people."""

from __future__ import annotations

import time
from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path

from rightofway.control.commands import Commands
from rightofway.control.journal import BatchedJournal, Entry, SqliteJournal
from rightofway.errors import InputError
from rightofway.model import Plan

__all__ = ["DemoRecord", "NothingKept", "SimulatedClock"]

PAUSE = 0.1
"""Seconds between two looks at what people ask for."""


class SimulatedClock:
    """The time of a demo [ticks]."""

    def __init__(self, plan: Plan) -> None:
        clock, seconds = plan.scenario.problem.clock, plan.scenario.units.seconds
        self._tick = Fraction(clock.tick * (seconds or 1))  # [s]
        self.now = 0

    def read_seconds(self) -> float:
        """Return the time [s]."""
        return float(self.now * self._tick)

    def to_ticks(self, seconds: float) -> Fraction:
        """Return a time [ticks]."""
        return Fraction(seconds) / self._tick


class DemoRecord:
    """The journal of a demo, and the commands of people."""

    def __init__(
        self, path: Path, clock: SimulatedClock, pace: float | None, *, stays: bool
    ) -> None:
        self._file = SqliteJournal(path, clock.read_seconds)
        if next(iter(self._file.read_history()), None) is not None:
            self._file.close()
            message = "has a run already, and a demo begins anew (name another file)"
            raise InputError.at(str(path), message)
        self.journal, self.commands = BatchedJournal(self._file), Commands(path)
        self.step = clock.to_ticks(PAUSE * pace if pace else 1)  # between two looks at commands
        self._pace, self.stays = pace, stays
        self.journal.commit([{"kind": "pace", "seconds": pace}])

    def write(self, entry: Entry) -> None:
        """Write an entry."""
        self.journal.commit([entry])

    def wait(self) -> None:
        """Wait for people where no pause does."""
        if self._pace is None:
            time.sleep(PAUSE)

    def close(self) -> None:
        """Give the files free."""
        self.journal.flush()
        self._file.close()
        self.commands.close()


class NothingKept:
    """The journal of robots that end with the process: no start would read it."""

    def read_entries(self) -> Iterable[Entry]:
        """Return nothing."""
        return ()

    def commit(self, entries: Iterable[Entry]) -> None:
        """Keep nothing."""

    def begin_again(self, snapshot: Entry) -> None:
        """Keep nothing."""
