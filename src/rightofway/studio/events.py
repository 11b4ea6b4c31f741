"""Events of runs, sent to all listeners: of one run, or of all runs.

A browser has six connections to a server, so a page listens to all runs by one.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncGenerator
from itertools import chain
from typing import Any

from rightofway.studio.errors import Busy

MAX_LISTENERS = 64
"""Streams that may be open at once."""

MAX_BEHIND = 1000
"""Events that a slow listener may be behind before it is hung up on."""

HEARTBEAT = 15.0
"""So often a listener hears something [s]."""

Event = tuple[str, dict[str, Any]]
_Queue = asyncio.Queue[Event | None]


class Listeners:
    """Streams of events, each of one run or of all."""

    def __init__(self) -> None:
        self._of: dict[int | None, set[_Queue]] = {}

    def tell(self, number: int, event: str, data: dict[str, Any]) -> None:
        """Send an event of a run to its listeners; the data get its number."""
        for listener in chain(self._of.get(number, ()), self._of.get(None, ())):
            is_behind = listener.qsize() >= MAX_BEHIND
            listener.put_nowait(None if is_behind else (event, {"number": number, **data}))

    def end(self, number: int) -> None:
        """End the streams of one run, which is over."""
        for listener in self._of.get(number, ()):
            listener.put_nowait(None)

    def hang_up(self) -> None:
        """End all streams."""
        for listener in chain.from_iterable(self._of.values()):
            listener.put_nowait(None)

    async def listen(
        self, number: int | None, first: Event, *, is_over: bool = False
    ) -> AsyncGenerator[Event | None]:
        """Yield the events of a run, or of all; None from time to time.

        Raises
        ------
        Busy
            If too many listen already.
        """
        if sum(map(len, self._of.values())) >= MAX_LISTENERS:
            raise Busy(f"{MAX_LISTENERS} streams are open already (close some)")
        listener: _Queue = asyncio.Queue()
        self._of.setdefault(number, set()).add(listener)
        try:
            yield first
            while not is_over:
                event: Event | None = None
                with contextlib.suppress(TimeoutError):
                    event = await asyncio.wait_for(listener.get(), HEARTBEAT)
                    if event is None:
                        return
                yield event
        finally:
            self._of[number].discard(listener)
            if not self._of[number]:
                del self._of[number]
