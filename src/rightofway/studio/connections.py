"""Connections of clients: how many there may be, and how long the head of a request may take.

Without these bounds, clients that connect and send nothing take every descriptor that the system
gives to a process, and the server accepts nobody any more.
"""

from __future__ import annotations

import asyncio
import contextlib
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

MOST = 500
"""Connections at once, where the system allows for as many."""

AT_ONCE = 64
"""Connections that are accepted before those that are too many are closed."""

DESCRIPTORS = 4096
"""Descriptors that are asked for, where the system gives fewer at first."""

SHARE = 0.25
"""The part of the system's descriptors that connections may take; the rest is for files, workers,
and twice `AT_ONCE` connections that are closed as soon as the server comes to it."""

PATIENCE = 10.0
"""The time limit of the head of a request, from the connection or from its first byte [s]."""


class Connection(H11Protocol):
    """A connection that is closed where it is one too many, or where its client is too slow."""

    _late: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Begin to wait for the first request."""
        super().connection_made(transport)
        if len(self.connections) > count_connections_allowed():
            transport.abort()
        else:
            self._wait()

    def data_received(self, data: bytes) -> None:
        """Wait on while the head of a request is not whole."""
        super().data_received(data)
        if self.conn.their_state is h11.IDLE:
            self._wait()
        else:
            self._wait_no_more()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        self._wait_no_more()
        super().connection_lost(exc)

    def _wait(self) -> None:
        if self._late is None:
            self._late = self.loop.call_later(PATIENCE, self.transport.abort)

    def _wait_no_more(self) -> None:
        if self._late is not None:
            self._late.cancel()
            self._late = None


def count_connections_allowed() -> int:
    """Return how many connections there may be: `MOST`, or fewer where descriptors are few."""
    with contextlib.suppress(ImportError):
        import resource

        allowed, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
        return min(MOST, int(SHARE * allowed)) if allowed > 0 else MOST
    return MOST


def allow_descriptors() -> None:
    """Ask the system for `DESCRIPTORS`; some give 256 to a process that does not ask."""
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        allowed, most = resource.getrlimit(resource.RLIMIT_NOFILE)
        wanted = DESCRIPTORS if most < 0 else min(DESCRIPTORS, most)
        if 0 <= allowed < wanted:
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, most))
