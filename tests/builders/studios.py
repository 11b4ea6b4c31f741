"""Studios that run in this process, with real workers and a real address."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import httpx
import uvicorn

from rightofway.studio.app import create_app
from rightofway.studio.guard import Access
from rightofway.studio.serve import bound
from rightofway.studio.session import Studio

DOOR = {
    "format": "rightofway-scenario/1",
    "map": {"grid": ["...", "@.@", "..."]},
    "robots": [
        {"name": "R1", "home": "N0", "target": "N6"},
        {"name": "R2", "home": "N2", "target": "N8", "work": 1},
    ],
}
"""Two robots that meet at a door."""

PATIENCE = 30.0
"""How long a run may take in a test [s]."""


@contextmanager
def running(folder: Path, access: Access | None = None, **settings: Any) -> Iterator[httpx.Client]:
    """Serve a folder, and yield a client of version 1 of the API."""
    with closing(bound("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
        app = create_app(Studio(folder, **settings), access or Access.on("127.0.0.1", port))
        server = uvicorn.Server(uvicorn.Config(app, log_level="critical", access_log=False))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        try:
            base = f"http://127.0.0.1:{port}/api/v1"
            with httpx.Client(base_url=base, timeout=PATIENCE) as client:
                yield client
        finally:
            server.should_exit = True
            thread.join()


def over(client: httpx.Client, number: int) -> dict[str, Any]:
    """Wait until a run is over, and return it."""
    return until(client, number, lambda run: run["state"] not in {"queued", "running"})


def until(client: httpx.Client, number: int, holds: Any) -> dict[str, Any]:
    """Wait until something holds for a run, and return the run."""
    ends = time.monotonic() + PATIENCE
    while time.monotonic() < ends:
        run: dict[str, Any] = client.get(f"/runs/{number}").json()
        if holds(run):
            return run
        time.sleep(0.02)
    raise AssertionError(f"run {number} is still {run['state']}")


def planned(client: httpx.Client, document: Any = DOOR, **request: Any) -> dict[str, Any]:
    """Plan a document, and return the run that is over."""
    started = client.post("/runs", json={"document": document, **request})
    assert started.status_code == 202, started.text
    return over(client, started.json()["number"])
