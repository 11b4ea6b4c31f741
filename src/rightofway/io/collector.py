"""Pause of Python's cyclic garbage collector while a file is read."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

FEW = 100_000
"""Objects at which the collector looks in some milliseconds."""


@contextmanager
def pause_garbage_collection() -> Iterator[None]:
    """Look for no cycles of objects inside: a file becomes millions of objects, all of which stay.

    Threads may overlap: the first one that paused the collection resumes it. What was made inside
    counts as old then, or the next look would be at all of it: 1.7 s of a file of 52 MB.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            # What a program has frozen stays so; to count that takes 20 ms for a million objects.
            if gc.get_count()[0] > FEW and not gc.get_freeze_count():
                gc.freeze()
                gc.unfreeze()
            gc.enable()
