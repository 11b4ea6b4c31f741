"""Much at once, much that is malformed, much that is large: refused or queued, and memory flat."""

from __future__ import annotations

import json
import os
import random
import resource
import socket
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
import pytest

from rightofway.studio.connections import PATIENCE
from tests.builders.browsers import needs_browser
from tests.builders.studios import DOOR, Command, command, planned, sent
from tests.builders.suites import soon

if TYPE_CHECKING:
    from playwright.sync_api import Browser

MALFORMED = 10_000 if "ALL_SEEDS" in os.environ else 2_000
FLAT = 60e6
"""What the server may grow by [bytes]: a body of 20 MB is in memory a few times."""


def test_thousands_of_malformed_requests_are_refused_without_a_word(tmp_path: Path) -> None:
    """Each is a request of a client that means harm, or that is broken, drawn at random."""
    (tmp_path / "door.yaml").write_text("format: rightofway-scenario/1\n")
    with command(tmp_path, "--no-history") as studio:
        planned(studio.client)
        before = studio.memory()
        with ThreadPoolExecutor(4) as pool:
            parts = pool.map(lambda seed: attack(studio, seed, MALFORMED // 4), range(4))
            statuses = set().union(*parts)
        assert statuses
        assert not {status for status in statuses if status < 400 or status >= 500}
        assert studio.memory() - before < FLAT
        assert planned(studio.client)["state"] == "done"
        assert studio.end() == ""


def attack(studio: Command, seed: int, count: int) -> set[int]:
    """Send malformed requests, and return the statuses of the answers."""
    draw, statuses = random.Random(seed), set[int]()  # noqa: S311 (no secret depends on it)
    base = studio.client.base_url
    with httpx.Client(base_url=base, timeout=60) as client:
        for _ in range(count):
            match draw.randrange(6):
                case 0:
                    path = "/".join(draw.choices(["..", "%2e%2e", "a", "%00", "%5c", "etc"], k=4))
                    status, text = sent(client, "GET", f"/api/v1/files/../{path}")
                    assert list(json.loads(text)) == ["error"]
                    statuses.add(status)
                    continue
                case 1:
                    request = client.build_request("POST", "/runs", content=draw.randbytes(50))
                case 2:
                    kind = {"content-type": "application/json"}
                    body = bytes(draw.choices(b'{}[]":,01eNa\\', k=40))
                    request = client.build_request("POST", "/runs", content=body, headers=kind)
                case 3:
                    headers = {"host": f"{draw.randrange(10**6)}.example"}
                    request = client.build_request("GET", "/files", headers=headers)
                case 4:
                    headers = {"origin": f"http://{draw.randrange(10**6)}.example"}
                    request = client.build_request("POST", "/runs", json={}, headers=headers)
                case _:
                    method = draw.choice(["TRACE", "BREW", "OPTIONS", "DELETE"])
                    request = client.build_request(method, f"/{draw.randrange(10**6)}")
            answer = client.send(request)
            assert "Traceback" not in answer.text
            assert set(answer.json()) == {"error"}
            statuses.add(answer.status_code)
    return statuses


def test_two_hundred_plans_at_once_are_queued_or_refused(tmp_path: Path) -> None:
    with command(tmp_path) as studio:
        body = {"document": DOOR, "planner": "lns", "time_limit": 30}
        with ThreadPoolExecutor(20) as pool:
            answers = list(pool.map(lambda _: studio.client.post("/runs", json=body), range(200)))
        statuses = [answer.status_code for answer in answers]
        assert set(statuses) == {202, 429}
        refused = next(answer for answer in answers if answer.status_code == 429)
        assert refused.json()["error"]["message"].endswith("(cancel some, or wait)")
        assert len(studio.workers()) <= 4


def test_large_bodies_are_cut_off_and_memory_stays_flat(tmp_path: Path) -> None:
    with command(tmp_path, "--no-history") as studio:
        studio.client.post("/validate", json={"document": DOOR})
        before = studio.memory()
        for _ in range(5):
            parts = (b" " * 10**6 for _ in range(100))
            kind = {"content-type": "application/json"}
            try:
                answer = studio.client.post("/validate", content=parts, headers=kind)
            except httpx.WriteError:
                continue  # it hung up on us
            assert answer.status_code == 413
        assert studio.memory() - before < FLAT


def test_many_slow_listeners_are_refused_at_some_number(tmp_path: Path) -> None:
    from tests.builders.crowds import CROWD

    with command(tmp_path, "--no-history") as studio:
        body = {"document": CROWD, "planner": "lns", "time_limit": 60}
        number = studio.client.post("/runs", json=body).json()["number"]
        listeners, base = [], studio.client.base_url
        for _ in range(64):
            listener = socket.create_connection((base.host, base.port or 80))
            words = f"GET /api/v1/runs/{number}/events HTTP/1.1", f"Host: {base.host}:{base.port}"
            listener.sendall("\r\n".join((*words, "", "")).encode())
            assert listener.recv(12) == b"HTTP/1.1 200"
            listeners.append(listener)
        assert studio.client.get(f"/runs/{number}/events").status_code == 429
        for listener in listeners:
            listener.close()

        def is_heard() -> bool:
            with studio.client.stream("GET", f"/runs/{number}/events") as again:
                return again.status_code == 200

        assert soon(is_heard)


@pytest.mark.parametrize("garbage", [b"\0" * 1000, b"GET\r\n\r\n", b"A" * 100_000, b"\x16\x03\x01"])
def test_what_is_no_request_ends_its_connection_only(tmp_path: Path, garbage: bytes) -> None:
    with command(tmp_path, "--no-history") as studio:
        base = studio.client.base_url
        with socket.create_connection((base.host, base.port or 80), timeout=10) as connection:
            connection.sendall(garbage + b"\r\n\r\n")
            assert b"200" not in connection.recv(100)[:12]
        assert studio.client.get("/files").status_code == 200
        assert studio.end() == ""


def test_connections_that_send_nothing_keep_nobody_out(tmp_path: Path) -> None:
    """The system gives 256 descriptors, and a client opens 600 connections."""
    with command(tmp_path, "--no-history") as studio:
        resource.prlimit(studio.process.pid, resource.RLIMIT_NOFILE, (256, 256))
        base, flood = studio.client.base_url, []
        for _ in range(600):
            connection = socket.create_connection((base.host, base.port or 80), timeout=10)
            with suppress(OSError):  # it is closed already
                connection.sendall(b"GET /api/v1/files HTTP/1.1\r\nHost: ")
            flood.append(connection)
        ends = time.monotonic() + 1.5 * PATIENCE
        answer = None
        while answer is None and time.monotonic() < ends:
            with suppress(httpx.TransportError):
                answer = studio.client.post("/validate", json={"document": DOOR}, timeout=1)
        assert answer is not None
        assert answer.status_code == 200
        for connection in flood:
            connection.close()
        assert studio.end() == ""


@pytest.mark.nightly
@needs_browser
def test_twenty_pages_hear_of_ten_plans_and_memory_stays_flat(
    browser: Browser, tmp_path: Path
) -> None:
    """All plans are made at once, twice; each page shows the ends of all of them."""
    from tests.builders.crowds import CROWD

    (tmp_path / "crowd.yaml").write_text(json.dumps(CROWD))
    context = browser.new_context(locale="en-GB", reduced_motion="reduce")
    with command(tmp_path, "--no-history", "--planners", "10") as studio:
        root = str(studio.client.base_url).removesuffix("api/v1/")
        pages = [context.new_page() for _ in range(20)]
        for page in pages:
            page.goto(f"{root}#file=crowd.yaml")
            page.get_by_role("tab", name="Plan").click()
        used: list[list[int]] = []
        for _ in range(2):
            body = {"document": CROWD, "planner": "lns", "time_limit": 3}
            begun = {studio.client.post("/runs", json=body).json()["number"] for _ in range(10)}
            for page, number in product(pages, begun):
                row = page.locator(f"[data-run='{number}'][data-state=done]")
                row.wait_for(state="attached", timeout=60_000)
            used.append([studio.memory(), *map(studio.memory, sorted(studio.workers()))])
        assert len(used[0]) == len(used[1]) >= 11
        assert max(after - before for before, after in zip(*used, strict=True)) < FLAT
        assert studio.end() == ""
    context.close()


@pytest.mark.nightly
def test_twenty_browsers_watch_ten_plans_that_are_made_at_once(tmp_path: Path) -> None:
    from tests.builders.crowds import CROWD

    with command(tmp_path, "--no-history", "--planners", "10") as studio:
        body = {"document": CROWD, "planner": "lns", "time_limit": 4}
        numbers = [studio.client.post("/runs", json=body).json()["number"] for _ in range(10)]

        def watch(browser: int) -> tuple[str, int]:
            with httpx.Client(base_url=studio.client.base_url, timeout=60) as client:
                number, plans, state = numbers[browser % 10], 0, ""
                with client.stream("GET", f"/runs/{number}/events") as events:
                    for line in events.iter_lines():
                        if line.startswith("event: plan"):
                            played = client.get(f"/runs/{number}/payload").json()
                            plans += played["faults"]["count"] == 0
                        elif line.startswith("data: ") and '"state"' in line:
                            state = json.loads(line[6:])["state"]
                return state, plans

        with ThreadPoolExecutor(20) as pool:
            watched = list(pool.map(watch, range(20)))
        assert {state for state, _ in watched} == {"done"}
        assert min(plans for _, plans in watched) >= 1
        assert studio.end() == ""
