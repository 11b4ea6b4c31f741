"""Rounds in a process of their own: planned, killed, planned again."""

from __future__ import annotations

import time
from collections.abc import Callable
from multiprocessing.connection import Connection

import pytest

from rightofway.control import FleetControl, round_worker
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.round_worker import ProcessRounds
from tests.builders.brokers import wait_for
from tests.builders.chaos import MemoryJournal
from tests.builders.floor_jobs import floor_plan
from tests.builders.floors import Floor

pytestmark = pytest.mark.slow


def start_shift(rounds: ProcessRounds) -> tuple[Floor, list[str]]:
    """Return a floor whose rounds are planned in a process, and what it will say."""
    said = list[str]()
    control = FleetControl(MemoryJournal(), roadmap=floor_plan().scenario.roadmap)
    dispatcher = Dispatcher(control, floor_plan(), rounds=rounds)
    dispatcher.keep_time(lambda: 0)
    dispatcher.report = lambda fact, _: said.append(str(fact))
    dispatcher.begin("run")
    return Floor(dispatcher), said


def add_job(floor: Floor, name: str) -> None:
    floor.send(floor.operator._run_command({"kind": "add", "name": name, "at": "N12"})[0])


def begin_round(floor: Floor, meanwhile: Callable[[], None] = lambda: None) -> None:
    """Wait until a round is under way."""
    driver = floor.dispatcher.rounds
    assert driver is not None

    def has_begun() -> bool:
        meanwhile()
        floor.send(driver.go_on())
        return driver.is_under_way

    wait_for(has_begun, 60, "the begin of the round")


def end_round(floor: Floor) -> None:
    """Wait until no round is under way."""
    driver = floor.dispatcher.rounds
    assert driver is not None

    def is_over() -> bool:
        floor.send(driver.go_on())
        return not driver.is_under_way

    wait_for(is_over, 60, "the end of the round")


def serve_late(pipe: Connection, time_limit: float, planner: str) -> None:  # noqa: ARG001
    """Start, and never plan a round."""
    pipe.send(None)
    while True:
        pipe.recv()


class Clock:
    """Seconds that pass when a test lets them."""

    def __init__(self) -> None:
        self.now = 0.0

    def monotonic(self) -> float:
        return self.now


def test_robots_drive_on_while_the_process_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine a start may take minutes; no robot keeps its parts meanwhile."""
    monkeypatch.setattr(round_worker, "time", clock := Clock())
    rounds = ProcessRounds(1.0)
    floor, said = start_shift(rounds)
    add_job(floor, "A1")
    assert floor.dispatcher.control.kept_parts is None
    minutes = iter(range(0, 300, 60))
    begin_round(floor, lambda: setattr(clock, "now", next(minutes, 300)))
    assert floor.dispatcher.control.kept_parts is not None
    end_round(floor)
    rounds.close()
    assert not said


def test_a_process_that_does_not_start_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(round_worker, "_serve_rounds", print)  # and end
    rounds = ProcessRounds(1.0)
    floor, said = start_shift(rounds)
    add_job(floor, "A1")
    driver = floor.dispatcher.rounds
    assert driver is not None

    def is_reported() -> bool:
        floor.send(driver.go_on())
        return bool(said)

    wait_for(is_reported, 60, "a report")
    rounds.close()
    assert said == ["the old plan stands: its process has ended, or took too long"]


def test_a_round_after_one_that_took_too_long_may_take_twice_as_long(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(round_worker, "time", clock := Clock())
    monkeypatch.setattr(round_worker, "_serve_rounds", serve_late)
    rounds = ProcessRounds(1.0)
    floor, said = start_shift(rounds)
    driver = floor.dispatcher.rounds
    assert driver is not None
    given_up_after = []
    for name in ("A1", "A2", "A3"):
        add_job(floor, name)
        driver.want()
        begin_round(floor)
        began = clock.now
        while driver.is_under_way:
            clock.now += 1
            floor.send(driver.go_on())
        given_up_after.append(clock.now - began)
    rounds.close()
    assert given_up_after == [22, 42, 82]
    assert said == ["the old plan stands: its process has ended, or took too long"]


def test_a_round_whose_process_is_killed_is_reported_and_the_next_one_plans() -> None:
    """The control does not wait for a round: to begin one takes no time."""
    rounds = ProcessRounds(1.0)
    floor, said = start_shift(rounds)
    driver = floor.dispatcher.rounds
    assert driver is not None
    began = time.monotonic()
    add_job(floor, "A1")
    assert time.monotonic() - began < 0.5
    begin_round(floor)
    assert rounds._process is not None
    rounds._process.kill()

    end_round(floor)
    assert said == ["the old plan stands: its process has ended, or took too long"]
    driver.want()
    begin_round(floor)
    end_round(floor)
    assert "A1" not in driver.watch.list_waiting()
    assert said[1:] == ["the rest is replanned"]
    rounds.close()
