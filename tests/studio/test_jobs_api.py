"""The interface of a warehouse management: jobs over HTTP, idempotent by the caller's name."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest

from rightofway.control import FleetControl, SqliteJournal
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.round_worker import RoundsAtOnce
from rightofway.model import Plan
from tests.builders.drives import watched
from tests.builders.floor_jobs import floor_plan
from tests.builders.floors import Floor
from tests.builders.plans import door


class Server:
    """The address of a fleet, and what it answers."""

    def __init__(self, address: str) -> None:
        self._address = address.rstrip("/")

    def send(self, method: str, path: str, body: Any = None) -> tuple[int, Any]:
        """Send a request; return the status and the body."""
        data = None if body is None else json.dumps(body).encode()
        request = Request(  # noqa: S310 (this machine)
            f"{self._address}{path}",
            data,
            {"content-type": "application/json"},
            method=method,
        )
        try:
            with urlopen(request, timeout=30) as answer:  # noqa: S310 (this machine)
                return answer.status, json.load(answer)
        except HTTPError as error:
            return error.code, json.load(error)


def serve(plan: Plan, folder: Path) -> Iterator[Server]:
    """Serve a fleet whose control answers commands, and does not drive."""
    path, ends, begun = folder / "run.journal", threading.Event(), threading.Event()

    def answer() -> None:
        opened = SqliteJournal(path)
        control = FleetControl(opened, roadmap=plan.scenario.roadmap)
        dispatcher = Dispatcher(control, plan, rounds=RoundsAtOnce(1.0))
        dispatcher.keep_time(lambda: 0)
        dispatcher.begin("run")
        floor, commands = Floor(dispatcher), Commands(path)
        begun.set()
        while not ends.wait(0.02):
            messages, answers = floor.operator.obey(commands)
            floor.send(messages)
            for number, reply in answers:
                commands.answer(number, reply)
        commands.close()
        opened.close()

    control = threading.Thread(target=answer)
    control.start()
    begun.wait()
    with watched(plan, path) as address:
        yield Server(address)
    ends.set()
    control.join()


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Server]:
    """Return the server of a fleet with jobs."""
    yield from serve(floor_plan(), tmp_path)


def names_of(server: Server) -> list[str]:
    return [job["name"] for job in server.send("GET", "/jobs")[1]["jobs"]]


def test_a_job_is_added_once_listed_and_withdrawn(server: Server) -> None:
    job = {"name": "order 7/a", "pickup": "N12", "dropoff": "N0", "earliest": 600, "due": 900}
    assert server.send("POST", "/jobs", job) == (201, {"name": "order 7/a"})
    assert server.send("POST", "/jobs", job) == (200, {"name": "order 7/a"})
    assert names_of(server) == ["J1", "J2", "J3", "order 7/a"]
    _, listed = server.send("GET", "/jobs")
    assert listed["jobs"][-1].keys() == {"name", "at", "state", "robot", "reason"}
    for _ in range(2):
        assert server.send("DELETE", "/jobs/order%207/a") == (200, {"name": "order 7/a"})
    assert names_of(server) == ["J1", "J2", "J3"]


def test_a_job_is_changed_and_a_change_sent_twice_changes_no_more(server: Server) -> None:
    server.send("POST", "/jobs", {"name": "a/1", "at": "N12", "latest": 900, "earliest": 600})
    change = {"at": "N0", "latest": None, "kind": "add", "name": "other"}
    for _ in range(2):
        assert server.send("PATCH", "/jobs/a%2F1", change) == (200, {"name": "a/1"})
    _, listed = server.send("GET", "/jobs")
    places = {job["name"]: job["at"] for job in listed["jobs"]}
    assert places["a/1"] == "N0"
    assert "other" not in places


@pytest.mark.parametrize(
    ("method", "path", "body", "text"),
    [
        ("POST", "/jobs", {"name": "A", "at": "N99"}, "'N99' is outside the map"),
        ("POST", "/jobs", {"name": "A", "at": "N2", "work": -1}, "time: -1 is no duration"),
        ("POST", "/jobs", {"name": "A"}, "has no place to work at"),
        ("DELETE", "/jobs/Z", None, "'Z' is no job"),
        ("PATCH", "/jobs/Z", {"at": "N2"}, "'Z' is no job"),
        ("PATCH", "/jobs/J2", {"at": "N99"}, "'N99' is outside the map"),
        ("PATCH", "/jobs/J2", {"robot": "R9"}, "'R9' is no robot"),
    ],
)
def test_what_cannot_be_done_is_refused_with_its_reason(
    server: Server, method: str, path: str, body: Any, text: str
) -> None:
    status, answer = server.send(method, path, body)
    assert status == 409
    assert text in answer["error"]["message"]
    assert names_of(server) == ["J1", "J2", "J3"]


def test_a_plan_without_jobs_takes_none(tmp_path: Path) -> None:
    for server in serve(door(), tmp_path):
        status, answer = server.send("POST", "/jobs", {"name": "A", "at": "N2"})
        assert (status, answer["error"]["message"][:20]) == (409, "the plan has no jobs")


def test_a_control_that_does_not_run_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The command stays: the control carries it out at its next start."""
    monkeypatch.setattr("rightofway.studio.watching.PATIENCE", 0.1)
    plan, path = floor_plan(), tmp_path / "run.journal"
    opened = SqliteJournal(path)
    control = FleetControl(opened, roadmap=plan.scenario.roadmap)
    Dispatcher(control, plan, rounds=RoundsAtOnce(1.0)).begin("run")
    opened.close()
    with watched(plan, path) as address:
        status, answer = Server(address).send("POST", "/jobs", {"name": "A", "at": "N2"})
    assert status == 503
    assert "it is carried out when the control runs" in answer["error"]["message"]
    commands = Commands(path)
    assert [json.loads(text)["name"] for _, text in commands.list_unanswered()] == ["A"]
    commands.close()
