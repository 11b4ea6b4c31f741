"""Pause of Python's cyclic garbage collector while a file is read."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


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
            if not gc.get_freeze_count():  # what a program has frozen stays so
                gc.freeze()
                gc.unfreeze()
            gc.enable()
