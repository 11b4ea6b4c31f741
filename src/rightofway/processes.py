"""Processes that work for this one: killed with all that they started, and how they ended."""

from __future__ import annotations

import contextlib
import os
import signal
from typing import IO

__all__ = ["count_cores", "describe_end", "kill_group", "read_last_line"]


def count_cores() -> int:
    """Return how many cores this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def kill_group(number: int) -> None:
    """Kill a process that began a session, and the processes that it has started."""
    with contextlib.suppress(ProcessLookupError):
        if hasattr(os, "killpg"):
            os.killpg(number, signal.SIGKILL)
        else:
            os.kill(number, signal.SIGTERM)  # Windows ends it at once


def describe_end(code: int) -> str:
    """Return how a process without a result ended, by its exit code."""
    if code >= 0:
        return f"its process ended with code {code}"
    name = next((known.name for known in signal.Signals if known == -code), f"signal {-code}")
    is_killed = name == "SIGKILL"
    return f"its process was ended by {name}{', perhaps for its memory' if is_killed else ''}"


def read_last_line(complaints: IO[bytes]) -> str:
    """Return the last line that a process has written to a file, without spaces around it."""
    complaints.seek(0)
    lines = complaints.read().decode("utf-8", "replace").split("\n")
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
