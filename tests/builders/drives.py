"""Demos whose time goes on only as far as a test lets it, and the pages that show them."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path

from rightofway.control.demo import drive_demo
from rightofway.control.journal import SqliteJournal
from rightofway.model import Plan
from rightofway.studio.serve import serve_watch
from rightofway.studio.watching import Watched

__all__ = ["Drive", "driven", "watched"]

PATIENCE = 30.0
"""How long to wait for a demo to end [s]."""


class Drive:
    """A demo in a thread.

    Parameters
    ----------
    plan
        What it drives.
    journal
        Where it keeps what happens.
    options
        As for `drive_demo`.
    """

    def __init__(self, plan: Plan, journal: Path, **options: object) -> None:
        self._let, self._gate = 0, threading.Condition()
        SqliteJournal(journal).close()
        self._thread = threading.Thread(
            target=drive_demo,
            args=(plan,),
            kwargs={"journal": journal, "wait_until": self._wait, **options},
            daemon=True,
        )
        self._thread.start()

    def _wait(self, moment: Fraction) -> None:
        with self._gate:
            self._gate.wait_for(lambda: moment <= self._let)

    def let(self, tick: int) -> None:
        """Let time go on, up to a tick."""
        with self._gate:
            self._let = max(self._let, tick)
            self._gate.notify_all()

    def end(self) -> None:
        """Let it come to its end."""
        self.let(10**9)
        self._thread.join(PATIENCE)
        assert not self._thread.is_alive()


@contextmanager
def driven(plan: Plan, journal: Path, **options: object) -> Iterator[Drive]:
    """Yield a demo; let it end."""
    drive = Drive(plan, journal, **options)
    try:
        yield drive
    finally:
        drive.end()


@contextmanager
def watched(
    plan: Plan, journal: Path, *, takes_orders: bool = True, port: int | None = None
) -> Iterator[str]:
    """Yield the address of the page of a journal."""
    said: list[str] = []
    watch = Watched(plan, journal, title="door", address="/drives/0/", takes_orders=takes_orders)
    with serve_watch(watch, host="127.0.0.1", port=port, say=said.append):
        yield said[0].removeprefix("watch it: ")
