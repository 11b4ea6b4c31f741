"""A case in a process of its own, so that its time and memory are its own, and so is its end."""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
from typing import IO, Any

from rightofway.bench.cases import Case
from rightofway.bench.machine import machine
from rightofway.bench.rows import COLUMNS, Row

__all__ = ["GRACE", "Interrupted", "Processes", "lost", "run_on_worker"]

GRACE = 60.0
"""A case is ended that many seconds after thrice its time limit [s]."""

LONGEST = 500
"""Characters of a message that a row keeps."""


class Interrupted(Exception):
    """The processes were ended before this case was done."""


class Processes:
    """The processes that run cases now, by threads of this one."""

    def __init__(self) -> None:
        self._running: set[subprocess.Popen[bytes]] = set()
        self._lock = threading.Lock()
        self._is_over = False

    def run(self, case: Case) -> Row:
        """Return the row of a case, however its process ends.

        Raises
        ------
        Interrupted
            If `end` was called before it was done.
        """
        with tempfile.TemporaryFile() as words, self._started(words) as process:
            allowed = 3 * float(case.limit) + GRACE
            overran = _wait(process, case, allowed)
            assert process.stdout is not None, "it is a pipe"
            outcome = process.stdout.read()
            with self._lock:
                self._running.discard(process)
                if self._is_over:
                    raise Interrupted
            if process.returncode == 0 and outcome:
                return row_of(case, json.loads(outcome))
            if overran:
                return row_of(case, _ended("overran", f"it was ended after {allowed:g} s"))
            return row_of(case, _death(process.returncode, _last(words)))

    def _started(self, words: IO[bytes]) -> subprocess.Popen[bytes]:
        with self._lock:
            if self._is_over:
                raise Interrupted
            process = subprocess.Popen(
                [sys.executable, "-m", "rightofway.bench.run"],
                bufsize=0,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=words,
                start_new_session=True,  # an interrupt from the keyboard is for us
            )
            self._running.add(process)
        return process

    def end(self) -> None:
        """End all processes; none is started any more."""
        with self._lock:
            self._is_over = True
            for process in self._running:
                _kill(process)


def _wait(process: subprocess.Popen[bytes], case: Case, allowed: float) -> bool:
    """Give a process its case and wait for its end; return whether it had to be ended."""
    assert process.stdin is not None, "it is a pipe"
    with contextlib.suppress(BrokenPipeError):  # it died before it could read
        left = memoryview(pickle.dumps(case))
        while left:
            left = left[process.stdin.write(left) :]
    try:
        process.wait(allowed)
    except subprocess.TimeoutExpired:
        _kill(process)
        process.wait()
        return True
    return False


def _kill(process: subprocess.Popen[bytes]) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)


def _last(words: IO[bytes]) -> str:
    words.seek(0)
    lines = words.read().decode("utf-8", "replace").split("\n")
    return next((line for line in reversed(lines) if line.strip()), "")


def _death(code: int, words: str) -> dict[str, Any]:
    """Return the outcome of a case whose process died before it could tell one."""
    if code >= 0:
        return _ended("defect", f"its process ended with code {code}. {words}")
    name = next((each.name for each in signal.Signals if each == -code), f"signal {-code}")
    hint = ", perhaps for its memory" if -code == signal.SIGKILL else ""
    return _ended("killed", f"its process was ended by {name}{hint}. {words}")


def _ended(status: str, message: str) -> dict[str, Any]:
    return {"solved": False, "valid": None, "status": status, "message": message}


def run_on_worker(case: Case) -> Row:
    """Return the row of a case; for workers of a cluster."""
    return Processes().run(case)


def lost(case: Case, message: str) -> Row:
    """Return the row of a case whose worker died each time it was tried."""
    return row_of(case, _ended("killed", message))


def row_of(case: Case, outcome: dict[str, Any]) -> Row:
    """Return a row with a value, or None, for every column."""
    row = {column.name: None for column in COLUMNS} | case.labels | machine() | outcome
    row["message"] = " ".join(str(row["message"]).split())[:LONGEST]
    return row
