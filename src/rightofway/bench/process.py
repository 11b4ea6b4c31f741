"""Cases on the cores of this machine, each in a process of its own.

So the time and the memory of a case are its own, and so is its end.
"""

from __future__ import annotations

import contextlib
import json
import pickle
import platform
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import cache
from pathlib import Path
from typing import IO, Any

import rightofway
from rightofway.bench.results import COLUMNS, Row
from rightofway.bench.shifts import SHIFT
from rightofway.bench.suite import Case
from rightofway.native import name_compiler
from rightofway.processes import count_cores, describe_end, kill_group, read_last_line

GRACE = 60.0
"""A case is ended that many seconds after thrice its time limit [s]."""

LONGEST = 500
"""Characters of a message that a row holds."""


def run_here(cases: Iterable[Case], *, jobs: int | None = None) -> Iterator[Row]:
    """Yield the row of each case, in the order in which they end.

    Parameters
    ----------
    cases
        The case to run.
    jobs
        How many at a time; as many as there are cores by default.

    Notes
    -----
    When the iteration is left early, running cases are ended and have no row.
    """
    describe_machine()  # before any thread asks for it
    processes = Processes()
    pool = ThreadPoolExecutor(jobs or count_cores())
    try:
        for future in as_completed([pool.submit(processes.run, case) for case in cases]):
            yield future.result()
    finally:
        processes.end()
        pool.shutdown(cancel_futures=True)


class Interrupted(Exception):
    """The processes were ended before this case was done."""


class Processes:
    """The processes that run cases, each for a thread of this process."""

    def __init__(self) -> None:
        self._running: set[subprocess.Popen[bytes]] = set()
        self._lock = threading.Lock()
        self._is_over = False

    def run(self, case: Case) -> Row:
        """Return the row of a case, however its process ends; `Interrupted` after `end`."""
        with tempfile.TemporaryFile() as stderr, self._start(stderr) as process:
            # The limit of a shift is that of each of its rounds.
            allowed = None if case.planner == SHIFT else 3 * float(case.limit) + GRACE
            overran = False
            assert process.stdin is not None, "it is a pipe"
            assert process.stdout is not None, "it is a pipe"
            with contextlib.suppress(BrokenPipeError):  # it died before it could read
                left = memoryview(pickle.dumps(case))
                while left:
                    left = left[process.stdin.write(left) :]
            try:
                process.wait(allowed)
            except subprocess.TimeoutExpired:
                overran = True
                kill_group(process.pid)
                process.wait()
            outcome = process.stdout.read()
            with self._lock:
                self._running.discard(process)
                if self._is_over:
                    raise Interrupted
            if process.returncode == 0 and outcome:
                return _make_row(case, json.loads(outcome))
            if overran:
                return _make_failed_row(case, "overran", f"it was ended after {allowed:g} s")
            status = "defect" if process.returncode >= 0 else "killed"
            message = f"{describe_end(process.returncode)}. {read_last_line(stderr)}"
            return _make_failed_row(case, status, message)

    def _start(self, stderr: IO[bytes]) -> subprocess.Popen[bytes]:
        with self._lock:
            if self._is_over:
                raise Interrupted
            process = subprocess.Popen(
                [sys.executable, "-m", "rightofway.bench.run"],
                bufsize=0,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=stderr,
                start_new_session=True,  # an interrupt from the keyboard is for this process
            )
            self._running.add(process)
        return process

    def end(self) -> None:
        """End all processes; none is started any more."""
        with self._lock:
            self._is_over = True
            for process in self._running:
                kill_group(process.pid)


def run_on_worker(case: Case) -> Row:
    """Return the row of a case; for workers of a cluster."""
    return Processes().run(case)


def make_lost_row(case: Case, message: str) -> Row:
    """Return the row of a case whose worker died each time it was tried."""
    return _make_failed_row(case, "killed", message)


def _make_failed_row(case: Case, status: str, message: str) -> Row:
    return _make_row(case, {"solved": False, "status": status, "message": message})


def _make_row(case: Case, outcome: dict[str, Any]) -> Row:
    """Return a row with a value, or None, for every column."""
    row = {column.name: None for column in COLUMNS} | case.labels | describe_machine() | outcome
    row["message"] = " ".join(str(row["message"]).split())[:LONGEST]
    return row


@cache
def describe_machine() -> dict[str, Any]:
    """Return commit, versions and hardware, as rows have them."""
    return {
        "commit": _find_commit(),
        "version": rightofway.__version__,
        "cpu": _describe_cpu(),
        "cores": count_cores(),
        "compiler": name_compiler(),
        "python": platform.python_version(),
    }


def _find_commit() -> str:
    """Return the commit of the package's sources, ``-dirty`` if changed; empty if unknown.

    An installed package may lie in a repository that has nothing to do with it, so git must know
    its files.
    """
    package = Path(rightofway.__file__)
    if not _ask_git(package, "ls-files", "--error-unmatch", package.name):
        return ""
    return _ask_git(package, "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*")


def _ask_git(package: Path, *args: str) -> str:
    command = ["git", "-C", str(package.parent), *args]
    try:
        ended = subprocess.run(command, capture_output=True, check=True, text=True)  # noqa: S603
    except (OSError, subprocess.CalledProcessError):
        return ""
    return ended.stdout.strip()


def _describe_cpu() -> str:
    """Return the model of the processor; the architecture where the system does not name it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(models, "") or platform.processor() or platform.machine()
