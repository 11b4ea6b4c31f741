"""Rounds in a process of their own: planned, killed, planned again."""

from __future__ import annotations

import time

import pytest

from rightofway.control import FleetControl
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.round_worker import ProcessRounds
from tests.builders.brokers import wait_for
from tests.builders.chaos import MemoryJournal
from tests.builders.floor_jobs import floor_plan
from tests.builders.floors import Floor

pytestmark = pytest.mark.slow


def test_a_round_whose_process_is_killed_is_reported_and_the_next_one_plans() -> None:
    """The control does not wait for a round: to begin one takes no time."""
    plan, said = floor_plan(), list[str]()
    rounds = ProcessRounds(1.0)
    control = FleetControl(MemoryJournal(), roadmap=plan.scenario.roadmap)
    dispatcher = Dispatcher(control, plan, rounds=rounds)
    dispatcher.keep_time(lambda: 0)
    dispatcher.report = lambda fact, _: said.append(str(fact))
    dispatcher.begin("run")
    floor, driver = Floor(dispatcher), dispatcher.rounds
    assert driver is not None
    began = time.monotonic()
    floor.send(floor.operator._run_command({"kind": "add", "name": "A1", "at": "N12"})[0])
    assert driver.is_under_way
    assert time.monotonic() - began < 0.5
    assert rounds._process is not None
    rounds._process.kill()

    def is_over() -> bool:
        floor.send(driver.go_on())
        return not driver.is_under_way

    wait_for(is_over, 30, "the end of the round")
    assert said == ["the old plan stands: its process has ended, or took too long"]
    driver.want()
    floor.send(driver.go_on())
    wait_for(is_over, 30, "the end of the next round")
    assert "A1" not in driver.watch.list_waiting()
    assert said[1:] == ["the rest is replanned"]
    rounds.close()
