"""What is left when a worker, the server, or both go down."""

from __future__ import annotations

import os
import signal
import sqlite3
import threading
import time
from contextlib import suppress
from itertools import cycle
from pathlib import Path
from typing import Any

import httpx

from rightofway import load
from tests.builders.crowds import CROWD
from tests.builders.studios import DOOR, PATIENCE, command, over, planned, until
from tests.builders.suites import soon

LONG = {"document": CROWD, "planner": "lns", "time_limit": 60}


def is_gone(process: int) -> bool:
    """Wait until a process has ended; false if it does not."""

    def has_ended() -> bool:
        try:
            return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
        except OSError:
            return True

    return soon(has_ended)


def test_whatever_was_answered_is_there_after_a_kill(tmp_path: Path) -> None:
    """The server is killed while one plan is made, another waits, and a draft is drawn."""
    with command(tmp_path) as studio:
        client = studio.client
        running = client.post("/runs", json=LONG).json()["number"]
        until(client, running, lambda run: run["has_plan"])
        waiting = client.post("/runs", json={"document": DOOR, "name": "next"}).json()["number"]
        for stroke in range(10):
            draft: dict[str, Any] = {"stroke": stroke, "map": {"grid": ["." * 100] * 100}}
            assert client.put("/drafts/hall", json={"document": draft}).status_code == 200
        best = client.get(f"/runs/{running}").json()["figures"]["flowtime"]
        workers = studio.workers()
        studio.end(signal.SIGKILL)
    assert len(workers) >= 2
    assert all(map(is_gone, workers))
    with command(tmp_path) as studio:
        client = studio.client
        assert client.get("/drafts/hall").json()["document"]["stroke"] == 9
        assert over(client, waiting)["state"] == "done"
        kept = client.get(f"/runs/{running}").json()
        assert kept["state"] == "interrupted"
        assert kept["figures"]["flowtime"] <= best
        played = client.get(f"/runs/{running}/payload").json()
        assert played["faults"]["count"] == 0
        improve = {"kind": "improve", "based_on": running, "time_limit": 0.5}
        better = over(client, client.post("/runs", json=improve).json()["number"])
        assert better["figures"]["flowtime"] <= kept["figures"]["flowtime"]
        again = client.post(f"/runs/{running}/again").json()
        assert again["request"] == kept["request"]
        until(client, again["number"], lambda run: run["has_plan"])


def test_a_file_is_whole_whenever_the_server_is_killed(tmp_path: Path) -> None:
    """Two documents of different length replace each other until the server is gone."""
    documents = [{**DOOR, "robots": DOOR["robots"][:count]} for count in (1, 2)]
    with command(tmp_path) as studio:
        saved = threading.Semaphore(0)

        def save(document: Any) -> None:
            studio.client.put("/documents/door.yaml", json={"document": document, "revision": None})
            saved.release()

        def save_for_ever() -> None:
            with suppress(httpx.TransportError, RuntimeError):
                for document in cycle(documents):
                    save(document)

        save(documents[0])
        saving = threading.Thread(target=save_for_ever)
        saving.start()
        for _ in range(20):
            assert saved.acquire(timeout=PATIENCE)
        studio.process.kill()  # within a file, or between two
        saving.join()
        studio.end(signal.SIGKILL)
    assert [robot.name for robot in load(tmp_path / "door.yaml").robots] in (["R1"], ["R1", "R2"])


def test_a_worker_that_dies_ends_one_plan_and_leaves_the_best(tmp_path: Path) -> None:
    with command(tmp_path, "--no-history", "--planners", "2") as studio:
        client = studio.client
        first, second = (client.post("/runs", json=LONG).json()["number"] for _ in range(2))
        until(client, second, lambda run: run["has_plan"])
        until(client, first, lambda run: run["has_plan"])
        busiest = max(studio.workers(), key=seconds_of)
        os.kill(busiest, signal.SIGKILL)
        ended = next(over(client, n) for n in (first, second) if is_over_soon(client, n))
        assert ended["state"] == "failed"
        assert ended["error"]["kind"] == "died"
        assert "SIGKILL, perhaps for its memory" in ended["error"]["message"]
        assert client.get(f"/runs/{ended['number']}/payload").status_code == 200
        other = second if ended["number"] == first else first
        client.post(f"/runs/{other}/stop")
        assert over(client, other)["state"] in {"stopped", "done"}
        assert planned(client)["state"] == "done"


def seconds_of(process: int) -> int:
    """Return the time that a process has taken so far [clock ticks]."""
    return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11])


def is_over_soon(client: Any, number: int) -> bool:
    """Return whether a run is over within a second."""
    return soon(lambda: client.get(f"/runs/{number}").json()["ended"], seconds=1)


def test_every_worker_killed_again_and_again_is_replaced(tmp_path: Path) -> None:
    with command(tmp_path, "--no-history") as studio:
        for _ in range(3):
            for process in studio.workers():
                os.kill(process, signal.SIGKILL)
            answers = [
                studio.client.post("/validate", json={"document": DOOR}).status_code
                for _ in range(3)
            ]
            assert set(answers) <= {200, 500}
            assert answers[-1] == 200


def test_ctrl_c_ends_it_without_a_word_and_leaves_no_process(tmp_path: Path) -> None:
    with command(tmp_path) as studio:
        number = studio.client.post("/runs", json=LONG).json()["number"]
        until(studio.client, number, lambda run: run["has_plan"])
        workers = studio.workers()
        began = time.monotonic()
        said = studio.end()
        assert studio.process.returncode == 0
        assert time.monotonic() - began < 10
        assert said == ""
    assert all(map(is_gone, workers))
    database = sqlite3.connect(tmp_path / ".rightofway-studio.sqlite")
    assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    database.close()


def test_a_second_studio_on_a_folder_keeps_nothing_and_harms_nothing(tmp_path: Path) -> None:
    with command(tmp_path) as one, command(tmp_path) as other:
        one.client.put("/drafts/hall", json={"document": {}})
        assert one.client.get("/").json()["keeps"] is True
        assert other.client.get("/").json()["keeps"] is False
        assert other.client.get("/drafts").json()["drafts"] == []
