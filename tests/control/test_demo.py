"""Simulated robots drive a plan in one process, with messages of VDA 5050."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.control.commands import Commands
from rightofway.control.demo import drive_demo, make_pause
from rightofway.control.endpoints import Letter
from rightofway.control.identities import VERSIONS
from rightofway.control.journal import SqliteJournal
from rightofway.control.story import Happening, Story
from rightofway.control.vda5050 import InstantActions, OrderMessage, StateMessage, read
from rightofway.cyclic import find_best_timetable
from rightofway.errors import InputError
from rightofway.execution.drive_result import DriveResult
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.model import Tick
from rightofway.report.driving import report_drive
from rightofway.report.quantities import Quantities
from tests.builders.chaos import chaotic_plan, laps_plan
from tests.builders.plans import door, door_shifted
from tests.builders.schemas import validator
from tests.builders.warehouses import warehouse

TIMELY = """\
0 R1 waits at N0 until R2 is at N4
0 R2 sets out from N2 to N8
2 R1 sets out from N0 to N1
5 R2 has done its work at N8 (1 of 1)
5 R2 waits at N8 until R1 is at N6
6 R2 goes on from N8 to N2
7 R1 has done its work at N6 (1 of 1)
7 R1 waits at N6 until R2 is at N4
8 R1 goes on from N6 to N7
10 R2 is at the end of its way, N2
12 R1 is at the end of its way, N0"""


def story_of(delays: str | tuple[()] = (), seed: int = 0) -> tuple[DriveResult, str]:
    """Return how the door was driven, and the story."""
    lines = list[str]()

    def note(tick: Tick, fact: Fact) -> None:
        lines.append(f"{tick} {fact}")

    return drive_demo(door(), delays, seed, report=note), "\n".join(lines)


def test_the_log_reads_as_a_story() -> None:
    result, story = story_of()
    assert story == TIMELY
    assert result.as_dict() == {
        "robots": [
            {"name": "R1", "jobs": 1, "waits": 2, "planned": 10, "completion": 12},
            {"name": "R2", "jobs": 1, "waits": 1, "planned": 9, "completion": 10},
        ],
        "jobs": 2,
        "messages": {"instantActions": 2, "order": 12, "state": 50},
    }


def test_a_seed_gives_one_run_and_delays_make_others_wait() -> None:
    late, story = story_of("exponential:0.5", 3)
    assert story == story_of("exponential:0.5", 3)[1]
    assert story != story_of("exponential:0.5", 4)[1]
    assert _completions(late) == [(18, 15)]
    assert late.jobs == (1, 1)


def test_a_stop_of_one_robot_holds_the_other_one_and_no_longer() -> None:
    """R2 stands in N4 for ten ticks; R1, which follows it, is later by as much."""
    timely, _ = story_of()
    stopped, _ = story_of("stop:R2@2+10")
    late = [int(b or 0) - int(a or 0) for a, b in zip(*_completions(timely, stopped), strict=True)]
    assert late == [10, 10]


def _completions(*results: DriveResult) -> list[tuple[Tick | None, ...]]:
    return [result.trace.completion for result in results if result.trace]


@pytest.mark.parametrize("version", VERSIONS)
def test_all_that_control_and_robots_send_is_valid_by_the_official_schemas(version: str) -> None:
    schemas = {name: validator(version, name) for name in ("order", "instantActions", "state")}
    letters = list[Letter]()
    drive_demo(door(), version=version, watch=letters.append)
    for letter in letters:
        schemas[letter.topic.rpartition("/")[2]].validate(json.loads(letter.payload))
    interface = "vda5050/v3" if version == "3.0.0" else "uagv/v2"
    assert {letter.topic for letter in letters} == {
        f"{interface}/rightofway/{robot}/{name}"
        for robot in ("robot0", "robot1")
        for name in schemas
    }
    numbers = [
        json.loads(letter.payload)["headerId"]
        for letter in letters
        if letter.topic == f"{interface}/rightofway/robot0/state"
    ]
    assert numbers == list(range(len(numbers)))  # one count for each topic


@pytest.mark.parametrize("version", VERSIONS)
def test_what_ends_hand_over_in_one_process_is_what_they_would_read(version: str) -> None:
    """Robots and control of a demo take bodies; over a network they would read payloads."""
    letters = list[Letter]()
    drive_demo(door(), version=version, watch=letters.append)
    bodies = set[str]()
    for letter in letters:
        assert letter.body is not None
        document = json.loads(letter.payload)
        as_read = read(type(letter.body), document, letter.name)
        bodies.add(type(as_read).__name__)
        if isinstance(as_read, StateMessage) and isinstance(letter.body, StateMessage):
            assert as_read.to_robot_state() == letter.body.to_robot_state()
        if isinstance(as_read, OrderMessage) and isinstance(letter.body, OrderMessage):
            assert as_read.to_order(0) == letter.body.to_order(0)
            assert [edge.length for edge in as_read.edges] == [
                edge.length for edge in letter.body.edges
            ]
        if isinstance(as_read, InstantActions) and isinstance(letter.body, InstantActions):
            assert as_read.to_instant_actions(0) == letter.body.to_instant_actions(0)
    assert bodies == {"InstantActions", "OrderMessage", "StateMessage"}


@pytest.mark.parametrize("planner", ["prioritized", "lns"])
def test_laps_with_work_at_several_stops_are_driven_to_their_end(planner: str) -> None:
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": ["....", ".@@.", "...."]},
            "rules": {"laps": 3},
            "robots": [
                {"name": "R1", "home": "N0", "stops": [{"at": "N3", "work": 2}, {"at": "N8"}]},
                {"name": "R2", "home": "N11", "stops": [{"at": "N4", "work": 1}]},
            ],
        }
    )
    plan = rightofway.solve(scenario, planner)
    result = drive_demo(plan, "exponential:0.4", 1)
    assert result.jobs == (6, 3)
    assert result.laps == (3, 3)
    assert result.trace
    assert [track.vertices.tolist() for track in result.trace.tracks] == [
        track.vertices.tolist() for track in plan.tracks
    ]


def test_the_report_names_jobs_and_messages() -> None:
    result, _ = story_of()
    assert report_drive(result, Quantities.of(result.plan.scenario)).splitlines() == [
        "jobs      2 done",
        "makespan  12 time units; planned 10 time units",
        "messages  12 orders, 2 instant actions, 50 states",
        "",
        "completion of each robot",
        "robot  jobs  waits  planned  actual",
        "R1        1      2       10      12",
        "R2        1      1        9      10",
    ]


def test_laps_are_driven_until_each_robot_has_made_as_many_as_wanted() -> None:
    """The period is 10 ticks by the plan. Robots set out only when others have arrived, at the two
    doors of the lap 2 ticks later each: 14 ticks, and more or less for the first lap."""
    plan = laps_plan(door().scenario, find_best_timetable)
    result = drive_demo(plan, laps=20)
    assert min(result.laps) == 20
    assert result.as_dict()["ticks"] == result.now
    assert [robot["laps"] for robot in result.as_dict()["robots"]] == list(result.laps)
    assert 19 * 14 < result.now <= 21 * 14
    lines = report_drive(result, Quantities.of(plan.scenario)).splitlines()
    assert lines[1] == f"laps      {sum(result.laps)} in {result.now} time units"
    assert lines[5].split() == ["robot", "jobs", "waits", "laps", "mean", "lap"]


def test_rights_of_way_are_switched_where_robots_are_late() -> None:
    """Three random fleets with delays that come home sooner so, all with the same jobs done."""
    for seed, (kept, switched) in {8: (512, 435), 22: (204, 162), 26: (201, 137)}.items():
        runs = [
            drive_demo(chaotic_plan(seed), "exponential:1", seed, switch=switch)
            for switch in (False, True)
        ]
        assert [sum(map(int, times)) for times in _completions(*runs)] == [kept, switched]  # type: ignore[arg-type]
        assert runs[0].jobs == runs[1].jobs


def test_an_interrupt_ends_laps_that_go_on_for_ever_and_reports_them() -> None:
    def interrupt(tick: Fraction) -> None:
        if tick > 1000:
            raise KeyboardInterrupt

    result = drive_demo(door(), "exponential:0.5", wait_until=interrupt, laps=0)
    assert min(result.laps) > 30
    with pytest.raises(KeyboardInterrupt):
        drive_demo(door(), "stop:R1@1+2000", wait_until=interrupt)


def test_delays_make_laps_longer_each_time_in_another_way() -> None:
    timely, late = drive_demo(door(), laps=20), drive_demo(door(), "exponential:0.5", 1, laps=20)
    assert late.now > timely.now
    assert late.now != drive_demo(door(), "exponential:0.5", 2, laps=20).now


STILL: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {
        "roadmap": {
            "vertices": {
                "HC": [-60, 20], "C1": [-20, 20], "Y": [0, 20], "KC": [10, 20],
                "HE": [0, 80], "E1": [0, 40], "KE": [0, 10],
            },
            "edges": [
                ["HC", "C1"], ["C1", "Y"], ["Y", "KC"], ["HE", "E1"], ["E1", "Y"], ["Y", "KE"],
            ],
        },
        "spacing": "whole",
    },
    "units": {"length": "m", "time": "s"},
    "rules": {"rotations": False},
    "robots": [
        {"name": "C", "home": "HC", "target": "KC", "work": 10, "speed": 2},
        {"name": "E", "home": "HE", "target": "KE", "work": 10, "speed": 1},
    ],
}  # fmt: skip
"""C comes to Y before E; all times are multiples of five seconds."""


@pytest.mark.parametrize("moment", ["", "C sets out from HC to KC"])
def test_others_go_round_a_robot_on_hold_as_at_a_broker(moment: str, tmp_path: Path) -> None:
    """E waits for C, and is at its home before C is let go.

    C is held at its home, or when it has all the way beyond Y: then E goes once C is there.
    """
    path, lines = tmp_path / "demo.journal", list[str]()
    people = Commands(path)
    if not moment:
        people.ask({"kind": "hold", "name": "C"})

    def note(_: Tick, fact: Fact) -> None:
        lines.append(sentence := str(fact))
        if sentence == moment:
            people.ask({"kind": "hold", "name": "C"})
        if sentence.startswith("E is at the end"):
            people.ask({"kind": "go", "name": "C"})

    def wait_until(moment: Fraction) -> None:
        assert moment < 1000, lines  # else E waits for C without end

    plan = rightofway.solve(parse_scenario(STILL), "prioritized")
    result = drive_demo(plan, journal=path, report=note, wait_until=wait_until)
    assert result.jobs == (1, 1)
    assert lines.index("E is at the end of its way, HE") < lines.index("C: released")
    people.close()


def test_a_command_is_answered_at_once_however_long_a_tick_is(tmp_path: Path) -> None:
    """A tick is five seconds, and so are the pauses between two things that robots do."""
    path, ends = tmp_path / "demo.journal", threading.Event()
    plan = rightofway.solve(parse_scenario(STILL), "prioritized")
    assert plan.scenario.problem.clock.tick == 5
    pause = make_pause(plan, 1)

    def wait_until(moment: Fraction) -> None:
        if not ends.is_set():
            pause(moment)

    SqliteJournal(path).close()
    options = {"journal": path, "pace": 1, "wait_until": wait_until}
    demo = threading.Thread(target=drive_demo, args=(plan,), kwargs=options, daemon=True)
    demo.start()
    people = Commands(path)
    began = time.monotonic()
    for kind in ("hold", "go"):
        assert people.wait_for(people.ask({"kind": kind, "name": "C"}), 4) is not None
    assert time.monotonic() - began < 4
    ends.set()
    demo.join(20)
    people.close()


def test_a_plan_with_faults_is_refused() -> None:
    with pytest.raises(InputError, match="only one without can be driven"):
        drive_demo(door_shifted(-1))


def test_a_robot_that_breaks_down_for_ever_is_refused() -> None:
    with pytest.raises(InputError, match=r"delays: R. would never complete.*delays that end"):
        drive_demo(door(), "stop:R2@2")


def test_the_story_of_robots_that_have_changed_is_the_story_of_all(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Each sentence comes at the same moment where all robots are looked at in each instant."""
    go_on = Story.go_on

    def look_at_all(story: Story) -> Iterator[Happening]:
        ledger = story._ledger
        ledger.changed.update(range(len(ledger.robots)))
        return go_on(story)

    def tell() -> list[tuple[int, Fact]]:
        facts: list[tuple[int, Fact]] = []
        drive_demo(warehouse(6), "chance:0.2x5", report=lambda *told: facts.append(told))
        return facts

    by_changes = tell()
    monkeypatch.setattr(Story, "go_on", look_at_all)
    assert by_changes == tell()
    assert any(fact.kind == "waits" for _, fact in by_changes)
