"""Robots that stand still: a line says why, and work that can be reached is done."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import pytest

import rightofway
from rightofway.control import Entry, FleetControl
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.notices import Notices
from rightofway.control.rest import RestPlanner
from rightofway.control.supervisor import Supervisor
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.model import Plan
from tests.builders.chaos import MemoryJournal, chaotic_plan
from tests.builders.standstill import PATIENCE, StandingFleet, crowded_plan

SEEDS = 20
"""Of each kind of fleet."""

VERTICES = {
    "HA": [-100, 10], "HB": [-100, -10], "P": [-20, 0], "Y": [0, 0], "D": [20, 0], "X": [30, 0],
    "R": [40, 0], "HC": [0, 60], "C1": [0, 40], "KC": [0, -40], "HF": [8, -6], "KF": [-8, 6],
}  # fmt: skip
LANES = [
    ("HA", "P"), ("HB", "P"), ("P", "Y"), ("Y", "D"), ("D", "X"), ("X", "R"), ("HC", "C1"),
    ("C1", "Y"), ("Y", "KC"), ("HF", "Y"), ("Y", "KF"),
]  # fmt: skip
"""A and B both work at D and then at R, at the end of one branch; C and F cross their way at Y."""


@cache
def crossing() -> Plan:
    """Return the plan of four robots."""
    two_stops = [{"at": "D", "work": 10}, {"at": "R", "work": 10}]
    robots: list[dict[str, Any]] = [
        {"name": "A", "home": "HA", "stops": two_stops, "speed": 1},
        {"name": "B", "home": "HB", "stops": two_stops, "speed": 1},
        {"name": "C", "home": "HC", "target": "KC", "work": 10, "speed": 1},
        {"name": "F", "home": "HF", "target": "KF", "work": 400, "speed": "2/5"},
    ]
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": VERTICES, "edges": LANES}, "spacing": "whole"},
        "rules": {"rotations": False},
        "robots": robots,
    }
    return rightofway.solve(parse_scenario(document), "prioritized")


def jobs_done(fleet: StandingFleet) -> dict[str, int]:
    """Return how many jobs each robot has done."""
    return {
        name: own.jobs_done
        for name, own in zip(fleet.ledger.names, fleet.ledger.robots, strict=True)
    }


def test_robots_with_work_behind_one_closed_lane_do_their_other_work_and_wait_aside() -> None:
    """Both would end at D; one of them waits at X, before the lane, and both have a line."""
    fleet = StandingFleet(crossing(), 0)
    fleet.send(fleet.floor.operator.operate("hold", "C"))
    fleet.send(fleet.floor.operator.close("X", "R"))
    fleet.drive(0)
    assert jobs_done(fleet) == {"A": 1, "B": 1, "C": 0, "F": 1}
    assert fleet.trouble == ""
    assert "until the lane between X and R is open" in " ".join(
        str(told.fact) for told in fleet.last.values()
    )
    assert (fleet.list_silent(), fleet.list_free()) == ([], [])
    fleet.send(fleet.floor.operator.operate("go", "C"))
    fleet.send(fleet.floor.operator.open("X", "R"))
    fleet.drive(0)
    assert jobs_done(fleet) == {"A": 2, "B": 2, "C": 1, "F": 1}


@pytest.mark.parametrize("held", ["A", "B", "C", "F"])
@pytest.mark.parametrize("lane", LANES, ids="-".join)
def test_any_held_robot_and_any_closed_lane_stop_only_whom_they_concern(
    lane: tuple[str, str], held: str
) -> None:
    fleet = StandingFleet(crossing(), 0)
    fleet.send(fleet.floor.operator.operate("hold", held))
    fleet.send(fleet.floor.operator.close(*lane))
    fleet.drive(0)
    assert fleet.list_silent() == []
    assert fleet.trouble or fleet.list_free() == []
    assert not fleet.trouble, fleet.trouble


@pytest.mark.parametrize("make_plan", [chaotic_plan, crowded_plan])
def test_no_robot_that_could_drive_stands_without_a_line(
    make_plan: Callable[[int], Plan],
) -> None:
    counts = dict.fromkeys(("hold", "close"), 0)
    for seed in range(SEEDS):
        fleet = StandingFleet(make_plan(seed), seed)
        fleet.drive(50)
        assert fleet.list_silent() == [], seed
        assert fleet.trouble or fleet.list_free() == [], seed
        for what in counts:
            counts[what] += fleet.counts[what]
    assert min(counts.values()) > SEEDS


@pytest.mark.parametrize("seed", [32, 35, 233, 262])
def test_robots_that_block_each_other_stop_no_others(seed: int) -> None:
    """With all robots no plan exists; it does where two of them stand for now."""
    fleet = StandingFleet(crowded_plan(seed), seed)
    fleet.drive(50)
    assert fleet.trouble == ""
    assert (fleet.list_silent(), fleet.list_free()) == ([], [])


def hold_one(fleet: StandingFleet) -> None:
    """Hold C, for which others wait."""
    fleet.send(fleet.floor.operator.operate("hold", "C"))


def close_a_lane(fleet: StandingFleet) -> None:
    """Close the lane to the work of A and B."""
    fleet.send(fleet.floor.operator.close("X", "R"))


def open_a_lane(fleet: StandingFleet) -> None:
    """Open a lane that was closed."""
    fleet.send(fleet.floor.operator.open("D", "X"))


@pytest.mark.parametrize("begin", [hold_one, close_a_lane, open_a_lane])
def test_replanning_that_fails_is_reported_once_until_it_succeeds(
    begin: Callable[[StandingFleet], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Wherever it is tried on its own; meanwhile it is tried again, and the old plan stands."""
    fleet, tries = StandingFleet(crossing(), 0), list[object]()
    fleet.send(fleet.floor.operator.close("D", "X"))
    plan = RestPlanner.plan

    def fail(*_: object) -> None:
        tries.append(None)
        raise GaveUp("no plan of the rest was found: A and B block each other")

    monkeypatch.setattr(RestPlanner, "plan", fail)
    begin(fleet)
    for _ in range(10 * PATIENCE):
        fleet.floor.drive(1)
        fleet.send(fleet.floor.dispatcher.pass_stuck())
    text = "the old plan stands: no plan of the rest was found: A and B block each other"
    assert fleet.reports == [text]
    assert len(tries) > 2
    monkeypatch.setattr(RestPlanner, "plan", plan)
    fleet.drive(0)
    assert fleet.reports == [text, "the rest is replanned"]


def test_replanning_that_fails_is_an_alarm_as_long_as_it_does() -> None:
    """The log has the sentences, and the journal the begin and the end of the alarm."""
    said, entries = list[str](), list[Entry]()
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), crossing())
    dispatcher.begin("run")
    notices = Notices(
        dispatcher.ledger.names, lambda fact: said.append(str(fact)), keep=entries.append
    )
    Supervisor(dispatcher, notices, lambda: 0)
    for fact, is_over in (
        (None, True),
        (Fact("no plan of the rest", reason="R1 is in the way"), False),
        (Fact("rest replanned"), True),
    ):
        dispatcher.report(fact, is_over)
    assert said == ["the old plan stands: R1 is in the way", "the rest is replanned"]
    assert [(entry["robot"], entry["about"], entry["over"]) for entry in entries] == [
        (-1, "plan", True),
        (-1, "plan", False),
        (-1, "plan", True),
    ]


def test_a_control_that_starts_again_replans_round_what_is_closed() -> None:
    """It does not know whether that has failed before it was killed."""
    plan, journal = crossing(), MemoryJournal()
    begun = Dispatcher(FleetControl(journal), plan)
    begun.begin("run")
    entry = {"kind": "closed", "names": ["X", "R"], "edges": [["X", "R"], ["R", "X"]]}
    journal.commit([entry])
    dispatcher, reports = Dispatcher(FleetControl(journal), plan), list[tuple[Fact | None, bool]]()
    dispatcher.report = lambda *report: reports.append(report)
    before = dispatcher.ledger.graph
    dispatcher.pass_stuck()
    assert dispatcher.ledger.graph is not before
    assert reports == [(None, True)]
