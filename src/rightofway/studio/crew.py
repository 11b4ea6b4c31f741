"""Workers from the side of the server: started, given one job each, killed where they must be."""

from __future__ import annotations

import asyncio
import contextlib
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

from rightofway.processes import describe_end, kill_group
from rightofway.studio.errors import Busy, TaskFailed
from rightofway.studio.messages import LENGTH, Blobs, pack

MAX_MESSAGE = 2**29
"""The longest message of a worker [bytes]."""

OnEvent = Callable[[dict[str, Any], list[bytes]], None]
"""Takes an event of a job and its blobs."""

_numbers = count(1)


@dataclass(slots=True)
class WorkerCall:
    """A job that is to be done, or is being done.

    Attributes
    ----------
    task
        Its name in `rightofway.studio.tasks.TASKS`.
    arguments, blobs
        The input of the task.
    limit
        The time after which its worker is killed [s].
    on_event
        Takes progress.
    on_start
        Called when a worker takes it.
    """

    task: str
    arguments: dict[str, Any] = field(default_factory=dict)
    blobs: Blobs = ()
    limit: float = 60.0
    on_event: OnEvent = lambda _event, _blobs: None
    on_start: Callable[[], None] = lambda: None
    number: int = field(default_factory=lambda: next(_numbers))
    worker: Worker | None = field(default=None, repr=False)

    def stop(self) -> None:
        """Ask the worker to return with the best that it has."""
        if self.worker is not None:
            self.worker.send({"stop": self.number})

    def kill(self) -> None:
        """End the worker; the job fails."""
        if self.worker is not None:
            self.worker.kill()


class Worker:
    """One process."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process

    @classmethod
    async def started(cls, folder: Path, scratch: str) -> Worker:
        """Return a new process; it imports the library meanwhile."""
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-P",  # a module in the user's folder must not stand for one of ours
            "-m",
            "rightofway.studio.worker",
            str(folder),
            scratch,
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.DEVNULL,
            start_new_session=True,  # an interrupt from the keyboard is for the server
        )
        return cls(process)

    @property
    def is_alive(self) -> bool:
        """Whether it can be given a job."""
        return self._process.returncode is None

    def send(self, message: dict[str, Any], blobs: Blobs = ()) -> None:
        """Send a message; one that is dead does not hear it."""
        assert self._process.stdin is not None, "it is a pipe"
        with contextlib.suppress(OSError, RuntimeError):
            self._process.stdin.write(pack(message, blobs))

    async def receive(self) -> tuple[dict[str, Any], list[bytes]]:
        """Return the next message; `asyncio.IncompleteReadError` of one that is dead."""
        reader = self._process.stdout
        assert reader is not None, "it is a pipe"
        (length,) = LENGTH.unpack(await reader.readexactly(LENGTH.size))
        if length > MAX_MESSAGE:
            raise asyncio.IncompleteReadError(b"", length)
        message = json.loads(await reader.readexactly(length))
        return message, [await reader.readexactly(size) for size in message["sizes"]]

    def kill(self) -> None:
        """End the process, and the processes that it has started."""
        kill_group(self._process.pid)

    async def end(self) -> None:
        """End the process."""
        self.kill()
        await self._process.wait()
        if self._process.stdin is not None:
            self._process.stdin.close()

    async def describe_end(self) -> str:
        """Return how the process ended, in words."""
        return describe_end(await self._process.wait())


class Crew:
    """Workers that are used again.

    Parameters
    ----------
    folder
        The folder that they may read.
    scratch
        A folder for files that live for one job.
    size
        How many jobs are done at once.
    queue
        How many jobs may wait.
    """

    def __init__(self, folder: Path, scratch: str, *, size: int, queue: int) -> None:
        self.size = size
        self._folder = folder
        self._scratch = scratch
        self._queue = queue
        self._free: list[Worker] = []
        self._all: set[Worker] = set()
        self._slots = asyncio.Semaphore(size)
        self._waiting = 0
        self._is_over = False

    async def start(self) -> None:
        """Start one worker in advance."""
        self._free.append(await self._start_worker())

    async def do(self, job: WorkerCall) -> tuple[Any, list[bytes]]:
        """Return the result of a job, with its blobs.

        Raises
        ------
        TaskFailed
            With the fault that the task has found; or because the worker died, or took too long.
        Busy
            If too many jobs wait.
        """
        if self._waiting >= self._queue:
            message = f"{self._waiting} requests wait already (try again in a moment)"
            raise Busy(message)
        self._waiting += 1
        try:
            await self._slots.acquire()
        finally:
            self._waiting -= 1
        try:
            return await self._run_job(job)
        finally:
            self._slots.release()

    async def _run_job(self, job: WorkerCall) -> tuple[Any, list[bytes]]:
        worker = await self._take_worker()
        job.worker, is_usable = worker, False
        try:
            job.on_start()
            order = {"job": job.number, "task": job.task, "arguments": job.arguments}
            worker.send(order, job.blobs)
            async with asyncio.timeout(job.limit):
                answer, blobs = await self._read_answer(worker, job)
            is_usable = not answer["is_large"]
        except TimeoutError:
            message = f"this took longer than {job.limit:g} s (give a smaller problem)"
            raise TaskFailed({"kind": "too_long", "message": message}) from None
        except asyncio.IncompleteReadError:
            error = {"kind": "died", "message": f"no result: {await worker.describe_end()}"}
            raise TaskFailed(error) from None
        finally:
            job.worker = None
            await self._return_worker(worker, is_whole=is_usable)
        if "error" in answer:
            raise TaskFailed(answer["error"])
        return answer["result"], blobs

    async def _read_answer(
        self, worker: Worker, job: WorkerCall
    ) -> tuple[dict[str, Any], list[bytes]]:
        while True:
            message, blobs = await worker.receive()
            if message["job"] != job.number:
                continue
            if "event" not in message:
                return message, blobs
            job.on_event(message["event"], blobs)

    async def _take_worker(self) -> Worker:
        while self._free:
            worker = self._free.pop()  # the latest one: it has kept what it read
            if worker.is_alive:
                return worker
            await self._drop_worker(worker)
        return await self._start_worker()

    async def _start_worker(self) -> Worker:
        worker = await Worker.started(self._folder, self._scratch)
        self._all.add(worker)
        return worker

    async def _return_worker(self, worker: Worker, *, is_whole: bool) -> None:
        """Take a worker back; one that died or was killed is replaced at once."""
        if is_whole:
            self._free.append(worker)
            return
        await asyncio.shield(self._drop_worker(worker))
        if not self._is_over:
            self._free.append(await asyncio.shield(self._start_worker()))

    async def _drop_worker(self, worker: Worker) -> None:
        self._all.discard(worker)
        await worker.end()

    async def close(self) -> None:
        """End all workers."""
        self._is_over = True
        await asyncio.gather(*(worker.end() for worker in self._all))
        self._all.clear()
        self._free.clear()
