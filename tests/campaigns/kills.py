"""Kill the studio in the middle of work, start it again, and look for all that it had answered.

Each life of a server takes drafts, files and runs, and ends by SIGKILL at a random moment, often
between a request and its answer. The next life on the same folder has to know every draft, file
and run that was answered for; what was not answered may be there or not, but never in parts. Some
lives are long enough for plans: a run that is done has a plan without faults.

``python -m tests.campaigns.kills COUNT`` runs on all processors (``just kills COUNT``).
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import random
import re
import signal
import sqlite3
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from http.client import HTTPConnection, HTTPException
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NoReturn

from rightofway.studio.serve import serve
from rightofway.studio.session import Studio
from tests.builders.studios import DOOR

LIVES_ON_A_FOLDER = 25
"""Kills on one folder; then a new one begins, so that lists stay short."""

LONG_LIFE = 8
"""One in so many lives is long enough for workers and plans."""

PATIENCE = 60.0
"""How long a server may take to answer [s]."""

KEPT = {"queued", "running", "done", "interrupted", "cancelled"}
"""States that a run may be in after a kill; none is stopped here, and none may fail."""


class Fault(AssertionError):
    """The studio lost something, or kept a part of something."""


class Folder:
    """One folder of a studio, and what a person who used it has to find there.

    Attributes
    ----------
    path
        The folder.
    drafts, files
        By name, the contents that it may have: one if the last change was answered for; None is
        for nothing.
    runs
        The numbers of runs that were answered for.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.drafts: dict[str, set[str | None]] = {}
        self.files: dict[str, set[str | None]] = {}
        self.runs: set[int] = set()


class Life:
    """One life of a server: a forked process, because its imports take longer than its life."""

    def __init__(self, folder: Path) -> None:
        reader, writer = os.pipe()
        self.process = os.fork()
        if self.process == 0:
            os.close(reader)
            _live(folder, writer)
        os.close(writer)
        with os.fdopen(reader, encoding="utf-8") as lines:
            line = lines.readline()
        address = re.search(r"http://([\d.]+):(\d+)/", line)
        if not address:
            raise Fault(f"the studio does not start again: {line!r}")
        self.connection = HTTPConnection(address[1], int(address[2]), timeout=PATIENCE)

    def ask(self, method: str, target: str, body: Any = None) -> Any:
        """Return the answer to a request."""
        self.send(method, target, body)
        return self.answer()

    def send(self, method: str, target: str, body: Any = None) -> None:
        """Send a request."""
        data = body if isinstance(body, bytes) else json.dumps(body).encode() if body else None
        kind = "application/octet-stream" if isinstance(body, bytes) else "application/json"
        self.connection.request(method, f"/api/v1/{target}", data, {"content-type": kind})

    def answer(self) -> Any:
        """Wait for the answer to the request that was sent."""
        answer = self.connection.getresponse()
        text = answer.read()
        if answer.status >= 400:
            raise Fault(f"{answer.status}: {text.decode(errors='replace')}")
        return json.loads(text)

    def kill(self) -> None:
        """End the server and its workers, as a machine that goes down does."""
        workers = _children(self.process)
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        self.connection.close()
        for worker in workers:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(worker, signal.SIGKILL)


def _live(folder: Path, writer: int) -> NoReturn:
    """Serve a folder in this process, which was just forked."""

    def say(line: str) -> None:
        os.write(writer, f"{line}\n".encode())

    try:
        serve(Studio(folder), host="127.0.0.1", port=_free(), has_page=False, opens_browser=False,
              say=say)  # fmt: skip
    except BaseException as error:  # noqa: BLE001 (the parent is told)
        say(f"{type(error).__name__}: {error}")
    os._exit(1)


def _free() -> int:
    """Return a port that is free now."""
    import socket

    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port: int = found.getsockname()[1]
    return port


def _children(process: int) -> list[int]:
    path = Path(f"/proc/{process}/task/{process}/children")
    with contextlib.suppress(OSError):
        return [int(child) for child in path.read_text().split()]
    return []


def live_and_die(folder: Folder, draw: random.Random, tally: Counter[str]) -> None:
    """Start a server, look for all that was answered, go on with work, and kill it."""
    life = Life(folder.path)
    try:
        find_everything(folder, life, tally)
        is_long = draw.random() < 1 / LONG_LIFE
        ends = time.monotonic() + (draw.uniform(0.5, 2.0) if is_long else draw.uniform(0.0, 0.06))
        while time.monotonic() < ends:
            request(folder, life, draw, tally)
        request(folder, life, draw, tally, waits=draw.random() * draw.random() * 0.02)
    finally:
        life.kill()
    tally["kills"] += 1
    tally["kills after half a second and more"] += is_long


def request(
    folder: Folder,
    life: Life,
    draw: random.Random,
    tally: Counter[str],
    waits: float | None = None,
) -> None:
    """Ask for a change; with ``waits``, the server is killed so many seconds after."""
    kind = draw.choice(["draft", "draft", "file", "run", "delete"])
    content = json.dumps({"stroke": draw.randrange(10**9), "rows": ["."] * draw.randrange(4000)})
    name = f"{kind}{draw.randrange(3)}"
    number = 0
    match kind:
        case "draft":
            may = folder.drafts.setdefault(name, {None})
            life.send("PUT", f"drafts/{name}", {"document": json.loads(content)})
        case "file":
            name += ".json"
            may = folder.files.setdefault(name, {None})
            life.send("PUT", f"files/{name}?replace=true", content.encode())
        case "run":
            may = set()
            limit = draw.choice([0.2, 5])
            life.send("POST", "runs", {"document": DOOR, "time_limit": limit})
        case _:
            may = set()
            if not folder.runs:
                return
            number = draw.choice(sorted(folder.runs))
            folder.runs.discard(number)
            life.send("DELETE", f"runs/{number}")
    if waits is not None:
        may.add(content)
        time.sleep(waits)
        tally["killed between request and answer"] += 1
        return
    answer = life.answer()
    may.clear()
    may.add(content)
    if kind == "run":
        folder.runs.add(answer["number"])
    tally["answers"] += 1


def find_everything(folder: Folder, life: Life, tally: Counter[str]) -> None:
    """Refuse a studio that has lost something, or has a part of something."""
    listed = {draft["name"] for draft in life.ask("GET", "drafts")["drafts"]}
    for name, may in folder.drafts.items():
        document = life.ask("GET", f"drafts/{name}")["document"] if name in listed else None
        _settle(f"draft {name}", json.dumps(document) if document else None, may)
    for name, may in folder.files.items():
        path = folder.path / name
        _settle(f"file {name}", path.read_text(encoding="utf-8") if path.exists() else None, may)
    runs = {run["number"]: run for run in life.ask("GET", "runs")["runs"]}
    if lost := folder.runs - set(runs):
        raise Fault(f"runs {sorted(lost)} were answered for, and are gone")
    folder.runs = set(runs)
    for number, run in runs.items():
        if run["state"] not in KEPT:
            raise Fault(f"run {number} is {run['state']}: {run['error']}")
        if run["state"] == "done":
            tally["plans found"] += 1
            if json.loads(_plan(life, number))["format"] != "rightofway-plan/1":
                raise Fault(f"run {number} is done, and its plan is none")
    tally["looked at"] += len(folder.drafts) + len(folder.files) + len(runs)


def _settle(what: str, found: str | None, may: set[str | None]) -> None:
    """Refuse what is none of the contents that it may have; from now on it has to stay."""
    if found not in may:
        raise Fault(f"{what} is none of the {len(may)} that it may be")
    may.clear()
    may.add(found)


def _plan(life: Life, number: int) -> bytes:
    life.send("GET", f"runs/{number}/plan")
    answer = life.connection.getresponse()
    content = answer.read()
    if answer.status != 200:
        raise Fault(f"run {number} is done and has no plan: {content.decode(errors='replace')}")
    return content


def campaign(seed: int, count: int) -> Counter[str]:
    """Kill servers ``count`` times, and return what was done."""
    draw, tally = random.Random(seed), Counter[str]()  # noqa: S311 (no secret depends on it)
    while tally["kills"] < count:
        with tempfile.TemporaryDirectory() as place:
            folder = Folder(Path(place))
            for _ in range(min(LIVES_ON_A_FOLDER, count - tally["kills"])):
                try:
                    live_and_die(folder, draw, tally)
                except (Fault, HTTPException, OSError) as fault:
                    fault.add_note(f"seed {seed}, kill {tally['kills']}")
                    raise
            database = sqlite3.connect(Path(place) / ".rightofway-studio.sqlite")
            with contextlib.closing(database):
                if database.execute("PRAGMA integrity_check").fetchone() != ("ok",):
                    raise Fault(f"the database is broken (seed {seed})")
            tally["databases that are whole"] += 1
    return tally


def portions(count: int, workers: int, seed: int) -> Iterator[tuple[int, int]]:
    """Yield a seed and a part of the count for each worker."""
    for worker in range(workers):
        yield seed + worker, count // workers + (worker < count % workers)


def main() -> None:
    """Run the campaign on all processors, and print what was done."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int, help="how often to kill")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**9))
    chosen = parser.parse_args()
    start, workers = time.monotonic(), min(os.cpu_count() or 1, chosen.count)
    sys.stderr.write(f"seed {chosen.seed}\n")
    with get_context("spawn").Pool(workers) as pool:
        parts = pool.starmap(campaign, portions(chosen.count, workers, chosen.seed))
    total = sum(parts, Counter[str]())
    said = ", ".join(f"{count} {what}" for what, count in total.items())
    seconds = time.monotonic() - start
    sys.stdout.write(f"{said}; nothing lost, nothing in parts; {seconds:.0f} s\n")


if __name__ == "__main__":
    main()
