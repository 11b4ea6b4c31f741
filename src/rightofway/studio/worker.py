"""A process that works for the studio: one job at a time, and no file outside of one folder."""

from __future__ import annotations

import _thread
import contextlib
import errno
import json
import mimetypes
import os
import queue
import struct
import sys
import tempfile
import threading
from pathlib import Path
from typing import IO, Any

from rightofway.report.examples import find_examples_folder
from rightofway.studio.messages import LENGTH, Blobs, as_error, pack

SHARE_OF_MEMORY = 0.5
"""The part of the machine's memory that a worker may take."""

LEAST_MEMORY = 2**30
"""Memory that a worker may always use [bytes]."""

LARGE = 2**29
"""A worker that had more memory at once is not used again [bytes]."""


def main() -> None:
    """Work until the server hangs up; the arguments are the folder and a scratch folder."""
    folder, scratch = (os.path.realpath(given) for given in sys.argv[1:3])
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # nothing that prints can break the messages
    os.chdir(folder)
    tempfile.tempdir = scratch
    mimetypes.init()  # openpyxl needs it, and it reads files of the system
    limit_memory()
    end_before_others()
    confine(folder, scratch)
    WorkerLoop(sys.stdin.buffer, answers).run()


class WorkerLoop:
    """Takes jobs one after the other; a thread listens meanwhile."""

    def __init__(self, orders: IO[bytes], answers: IO[bytes]) -> None:
        self._orders = orders
        self._answers = answers
        self._jobs: queue.SimpleQueue[tuple[dict[str, Any], list[bytes]]] = queue.SimpleQueue()
        self._current: int | None = None
        self._lock = threading.Lock()

    def run(self) -> None:
        """Carry out orders, for ever."""
        from rightofway.io.plan import shape  # noqa: F401 (before the first plan asks for it)
        from rightofway.studio.tasks import TASKS

        threading.Thread(target=self._run_jobs, daemon=True).start()
        while True:
            with contextlib.suppress(KeyboardInterrupt):  # a stop that came too late
                self._do(*self._jobs.get(), TASKS)

    def _do(self, order: dict[str, Any], blobs: list[bytes], tasks: dict[str, Any]) -> None:
        job = order["job"]

        def emit(event: dict[str, Any], *parts: bytes) -> None:
            self._send({"job": job, "event": event}, parts)

        self._current = job
        try:
            result, *parts = tasks[order["task"]](emit, blobs, **order["arguments"])
            answer: tuple[dict[str, Any], Blobs] = ({"job": job, "result": result}, parts)
        except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 (each is an answer)
            answer = ({"job": job, "error": as_error(error)}, ())
        finally:
            self._current = None
        message, parts = answer
        self._send({**message, "is_large": measure_most_memory() > LARGE}, parts)

    def _send(self, message: dict[str, Any], blobs: Blobs) -> None:
        data = pack(message, blobs)
        with self._lock:
            self._answers.write(data)
            self._answers.flush()

    def _run_jobs(self) -> None:
        try:
            while True:
                (length,) = LENGTH.unpack(self._orders.read(LENGTH.size))
                order = json.loads(self._orders.read(length))
                blobs = [self._orders.read(size) for size in order["sizes"]]
                if "task" in order:
                    self._jobs.put((order, blobs))
                elif order["stop"] == self._current:
                    _thread.interrupt_main()
        except (OSError, struct.error, ValueError):
            pass
        os._exit(0)  # the server is gone: whatever is planned, no program waits for it


def confine(*folders: str) -> None:
    """Refuse, from now on and for ever, to open a file outside of some folders.

    Documents name other files, and so do these; whichever reader opens them, Python asks here
    first. Python's own folders are open, because modules are imported when they are first used.
    """
    package = Path(__file__).parents[2]
    own = {sys.prefix, sys.base_prefix, str(package), "/dev/null", "/proc", "/sys", *sys.path}
    own.add(str(find_examples_folder()))
    known = {os.path.realpath(path) for path in own if path}
    roots = tuple(f"{root.rstrip(os.sep)}{os.sep}" for root in {*known, *folders})

    def watch(event: str, arguments: tuple[Any, ...]) -> None:
        if event != "open" or not isinstance(arguments[0], str | bytes | os.PathLike):
            return
        path = os.fsdecode(arguments[0])
        if not f"{os.path.realpath(path)}{os.sep}".startswith(roots):
            reason = "it is outside of the folder that the studio was given"
            raise PermissionError(errno.EACCES, reason, path)

    sys.addaudithook(watch)


def measure_most_memory() -> int:
    """Return the most memory that this process had at once [bytes]; 0 where nobody counts it.

    Linux adds to `getrusage` the memory of the process that has started this one: beside a large
    server each worker would seem large.
    """
    with contextlib.suppress(OSError, StopIteration):
        lines = Path("/proc/self/status").read_text(encoding="ascii", errors="replace").split("\n")
        return 1024 * int(next(line.split()[1] for line in lines if line.startswith("VmHWM:")))
    try:
        import resource
    except ImportError:
        return 0
    unit = 1 if sys.platform == "darwin" else 1024
    return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def limit_memory() -> None:
    """Let this process have a part of the machine's memory; where the system can limit it."""
    with contextlib.suppress(ImportError, OSError, ValueError, AttributeError):
        import resource

        whole = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
        most = max(int(SHARE_OF_MEMORY * whole), LEAST_MEMORY)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def end_before_others() -> None:
    """Ask the system to end this process first where memory is short; where it can be asked."""
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")


if __name__ == "__main__":
    main()
