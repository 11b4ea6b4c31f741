"""Studios that run in this process or as the command, with real workers and a real address."""

from __future__ import annotations

import asyncio
import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Coroutine, Iterator
from contextlib import closing, contextmanager
from http.client import HTTPConnection
from pathlib import Path
from typing import Any

import httpx
import uvicorn
from fastapi import FastAPI

from rightofway.studio.app import create_app
from rightofway.studio.connections import Connection
from rightofway.studio.guard import Access
from rightofway.studio.runs import Runs
from rightofway.studio.serve import bind_socket
from rightofway.studio.session import Studio
from tests.builders.suites import soon

DOOR: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {"grid": ["...", "@.@", "..."]},
    "robots": [
        {"name": "R1", "home": "N0", "target": "N6"},
        {"name": "R2", "home": "N2", "target": "N8", "work": 1},
    ],
}
"""Two robots that meet at a door."""

BAY = """\
format: rightofway-scenario/1
map: {grid: [".@.@.", ".....", "@@.@@", "@@.@@"]}
robots:
  - {name: R1, home: N0, target: N17, work: 3}
  - {name: R2, home: N2, target: N17, work: 3}
  - {name: R3, home: N4, target: N17, work: 3}
"""
"""Three robots that work at the end of one way."""

PATIENCE = 30.0
"""How long a run may take in a test [s]."""


class Client(httpx.Client):
    """A client that knows the studio behind the server, in the same process.

    Attributes
    ----------
    app, server
        What serves.
    studio
        What is served.
    """

    app: FastAPI
    server: uvicorn.Server

    @property
    def studio(self) -> Studio:
        studio: Studio = self.app.state.studio
        return studio

    @property
    def folder(self) -> Path:
        """The folder of the studio."""
        return self.studio.workspace.folder

    @property
    def address(self) -> str:
        """Where the page is."""
        return str(self.base_url).removesuffix("api/v1/")

    def renew(self, *, file: str | None = None, keeps: bool = False) -> None:
        """Serve another studio on the same folder, emptied, with the same workers.

        Parameters
        ----------
        file, keeps
            As for `Studio`.
        """
        self.do(self.studio.runs.close())
        self.studio.store.close()
        for path in self.folder.iterdir():
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink()
        studio = Studio(self.folder, file=file, keeps=keeps)
        studio._scratch.cleanup()  # the workers have one
        studio.desk, studio.planners = self.studio.desk, self.studio.planners
        studio.runs = Runs(studio.store, studio.planners, studio.desk)
        studio.drives = self.studio.drives
        self.app.state.studio = studio
        self.do(studio.runs.start())

    def do(self, work: Coroutine[Any, Any, None]) -> None:
        """Do something where the server does its work."""
        loop = self.server.servers[0].get_loop()
        asyncio.run_coroutine_threadsafe(work, loop).result()


@contextmanager
def running(folder: Path, access: Access | None = None, **settings: Any) -> Iterator[Client]:
    """Serve a folder, and yield a client of version 1 of the API."""
    with closing(bind_socket("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
        studio = Studio(folder, **settings)
        app = create_app(studio, access or Access.on("127.0.0.1", port))
        config = uvicorn.Config(app, http=Connection, log_level="critical", access_log=False)
        server = uvicorn.Server(config)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        assert soon(lambda: server.started or not thread.is_alive())
        try:
            base = f"http://127.0.0.1:{port}/api/v1"
            with Client(base_url=base, timeout=PATIENCE) as client:
                client.app, client.server = app, server
                yield client
                client.do(client.studio.runs.close())  # it may be another studio by now
        finally:
            server.should_exit = True
            thread.join()


class Command:
    """The command ``rightofway studio``, as a process.

    Attributes
    ----------
    process
        The process.
    client
        A client of version 1 of its API.
    """

    def __init__(self, folder: Path, *options: str) -> None:
        words = ["-m", "rightofway", "studio", str(folder), "--no-browser", *options]
        self.process = subprocess.Popen(
            [sys.executable, *words], stderr=subprocess.PIPE, text=True, start_new_session=True
        )
        assert self.process.stderr is not None, "it is a pipe"
        self.first_line = self.process.stderr.readline()
        address = re.search(r"https?://\S+?/", self.first_line)
        assert address, self.first_line + self.process.stderr.read()
        root = address[0]
        self.client = httpx.Client(base_url=f"{root}api/v1", timeout=PATIENCE, verify=False)  # noqa: S501 (a test's own certificate)

    def end(self, by: signal.Signals = signal.SIGINT) -> str:
        """End it by a signal, and return what it has written since its first line."""
        self.client.close()
        self.process.send_signal(by)
        return self.process.communicate(timeout=PATIENCE)[1]

    def workers(self) -> list[int]:
        """Return the processes of its workers."""
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                parent = int((process / "stat").read_text().rpartition(")")[2].split()[1])
                words = (process / "cmdline").read_text()
            except (OSError, ValueError):
                continue  # it has just ended
            if parent == self.process.pid and "rightofway.studio.worker" in words:
                found.append(int(process.name))
        return found

    def memory(self, process: int | None = None) -> int:
        """Return the memory of the server itself, or of a worker [bytes]."""
        status = Path(f"/proc/{process or self.process.pid}/status").read_text()
        line = re.search(r"^VmRSS:\s+(\d+) kB", status, re.MULTILINE)
        assert line, status
        return int(line[1]) * 1024


@contextmanager
def command(folder: Path, *options: str) -> Iterator[Command]:
    """Run the command, and end it by Ctrl-C where the test has not."""
    started = Command(folder, *options)
    try:
        yield started
    finally:
        if started.process.poll() is None:
            started.end()


def sent(
    client: httpx.Client, method: str, target: str, body: bytes = b"", kind: str = ""
) -> tuple[int, str]:
    """Send a request whose target no client library has tidied up; return status and text."""
    connection = HTTPConnection(client.base_url.host, client.base_url.port, timeout=PATIENCE)
    with closing(connection):
        connection.putrequest(method, target)
        if body:
            connection.putheader("Content-Type", kind)
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body or None)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()


def over(client: httpx.Client, number: int) -> dict[str, Any]:
    """Wait until a run is over, and return it."""
    return until(client, number, lambda run: run["state"] not in {"queued", "running"})


def until(client: httpx.Client, number: int, holds: Any) -> dict[str, Any]:
    """Wait until something holds for a run, and return the run."""
    run: dict[str, Any] = {}

    def looked() -> bool:
        run.update(client.get(f"/runs/{number}").json())
        return bool(holds(run))

    assert soon(looked, PATIENCE), f"run {number} is still {run['state']}"
    return run


def planned(client: httpx.Client, document: Any = DOOR, **request: Any) -> dict[str, Any]:
    """Plan a document, and return the run that is over."""
    started = client.post("/runs", json={"document": document, **request})
    assert started.status_code == 202, started.text
    return over(client, started.json()["number"])
