"""Jobs, closures and commands while robots drive: what is released stays, the rest is replanned."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway.control import FleetControl, SqliteJournal
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.laps import LapsToDrive
from rightofway.control.names import list_jobs
from rightofway.control.operator import Operator
from rightofway.errors import InputError
from rightofway.io import parse_scenario
from tests.builders.chaos import MemoryJournal
from tests.builders.floors import Floor
from tests.builders.plans import door
from tests.builders.sentences import tell_answer


def driven(steps: int, journal: MemoryJournal | SqliteJournal | None = None) -> Floor:
    """Return the door's robots after some steps."""
    dispatcher = Dispatcher(FleetControl(journal or MemoryJournal()), door())
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    floor.drive(steps)
    return floor


def obey(floor: Floor, commands: Commands) -> None:
    """Carry commands out, and answer them."""
    messages, answers = floor.operator.obey(commands)
    floor.send(messages)
    for number, answer in answers:
        commands.answer(number, answer)


def jobs_of(floor: Floor) -> dict[str, str]:
    """Return where the jobs are that are not done, by name."""
    return {job["name"]: job["at"] for job in list_jobs(floor.dispatcher.ledger)}


def test_a_job_that_is_added_goes_where_it_is_least_out_of_the_way_and_is_done() -> None:
    floor = driven(2)
    assert jobs_of(floor) == {"R1/job0": "N6", "R2/job0": "N8"}
    name, messages = floor.operator.add_job("N7", 2)  # on the way of R1, which has not set out
    floor.send(messages)
    assert name == "R1/job1"
    assert list(jobs_of(floor)) == ["R1/job1", "R1/job0", "R2/job0"]
    floor.drive(60)
    assert jobs_of(floor) == {}
    assert [own.jobs_done for own in floor.dispatcher.ledger.robots] == [2, 1]
    assert [robot.place for robot in floor.robots] == ["N0", "N2"]


def test_a_robot_can_be_named_and_may_be_at_its_end_already() -> None:
    floor = driven(80)
    assert jobs_of(floor) == {}
    name, messages = floor.operator.add_job("N2", 1, "R2")  # where it stands: it comes back
    floor.send(messages)
    floor.drive(60)
    assert name == "R2/job1"
    assert floor.dispatcher.ledger.robots[1].jobs_done == 2
    assert floor.robots[1].place == "N2"


LOOP = ("H", "S", "Dock", "M", "Rack")
"""Places of a loop in one direction, at which one robot has its stops."""


def loop(*stops: str) -> Floor:
    """Return a robot that has stops on the loop, before any of them is released."""
    vertices = dict(zip(LOOP, [[0, 0], [1, 0], [2, 0], [2, 1], [0, 1]], strict=True))
    edges = [
        {"from": tail, "to": head, "both_ways": False}
        for tail, head in zip(LOOP, (*LOOP[1:], LOOP[0]), strict=True)
    ]
    robot = {"name": "R1", "home": "H", "stops": [{"at": place, "work": 1} for place in stops]}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": vertices, "edges": edges}},
        "rules": {"rotations": False},
        "robots": [robot],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    dispatcher = Dispatcher(FleetControl(MemoryJournal(), look_ahead=1), plan)
    dispatcher.begin("run")
    return Floor(dispatcher)


def order_of_work(floor: Floor) -> list[str]:
    """Return the jobs in the order in which they were done, as the journal has it."""
    journal = floor.dispatcher.control._journal
    return [entry["job"] for entry in journal.read_entries() if entry["kind"] == "finished"]


@pytest.mark.parametrize("steps", [0, 3, 6])
@pytest.mark.parametrize("drop", LOOP[1:])
@pytest.mark.parametrize("pick", LOOP[1:])
def test_a_job_after_another_one_is_done_directly_after_it(
    pick: str, drop: str, steps: int
) -> None:
    """Of all pairs of places, also where the drop is on the way to the pick, with other stops."""
    floor = loop("S", "M")
    floor.drive(steps)
    picked, messages = floor.operator.add_job(pick, 1)
    floor.send(messages)
    dropped, messages = floor.operator.add_job(drop, 1, after=picked)
    floor.send(messages)
    floor.send(floor.operator.add_job("Dock", 1, after=dropped)[1])
    floor.drive(120)
    done = order_of_work(floor)
    at = done.index("job2")
    assert done[at : at + 3] == ["job2", "job3", "job4"]
    assert sorted(done) == ["job0", "job1", "job2", "job3", "job4"]


def test_a_job_may_come_after_one_that_is_released_or_done() -> None:
    """It is the next that the robot does; the answer names the jobs before and after it."""
    floor = loop("S", "M")
    floor.drive(1)
    floor.send(floor.operator.add_job("Rack", 1, after="R1/job0")[1])
    assert list(jobs_of(floor)) == ["R1/job0", "R1/job2", "R1/job1"]
    floor.drive(4)
    assert list(jobs_of(floor)) == ["R1/job2", "R1/job1"]
    floor.send(floor.operator.add_job("S", 1, after="R1/job0")[1])
    assert list(jobs_of(floor)) == ["R1/job3", "R1/job2", "R1/job1"]


@pytest.mark.parametrize(
    ("steps", "options", "text"),
    [
        (1, {"at": "Rack"}, "R1/job1 at Rack is added after R1/job0 at S"),
        (1, {"at": "Rack", "after": "R1/job0"}, "R1/job1 at Rack is added after R1/job0 at S"),
        (20, {"at": "Rack"}, "R1/job1 at Rack is added, its only job"),
    ],
)
def test_the_answer_says_where_a_job_was_put(
    tmp_path: Path, steps: int, options: dict[str, str], text: str
) -> None:
    floor, commands = loop("S"), Commands(tmp_path / "run.journal")
    floor.drive(steps)
    number = commands.ask({"kind": "add", **options})
    obey(floor, commands)
    assert tell_answer(commands.wait_for(number, 0)) == (True, text)


@pytest.mark.parametrize(
    ("after", "robot", "message"),
    [
        ("R1/job9", None, "'R1/job9' is no job"),
        ("R9/job0", None, "'R9' is no robot"),
        ("R1/job0", "R2", "'R1/job0' is no job of R2"),
    ],
)
def test_a_job_after_none_or_of_another_robot_is_refused(
    after: str, robot: str | None, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        driven(2).operator.add_job("N7", 0, robot, after)


def test_a_job_is_changed_and_withdrawn_until_it_is_released() -> None:
    floor = driven(2)
    floor.send(floor.operator.change_job("R1/job0", at="N7", work=1))
    assert jobs_of(floor)["R1/job0"] == "N7"
    with pytest.raises(InputError, match="'R2/job0' is released already"):
        floor.operator.change_job("R2/job0", at="N7")
    floor.send(floor.operator.withdraw_job("R1/job0"))
    floor.drive(60)
    assert [own.jobs_done for own in floor.dispatcher.ledger.robots] == [0, 1]
    with pytest.raises(InputError, match="'R1/job0' is no job"):
        floor.operator.withdraw_job("R1/job0")


@pytest.mark.parametrize(
    ("at", "robot", "message"),
    [
        ("N99", None, "no vertex is named 'N99'"),
        ("N7", "R7", r"robot: 'R7' is no robot \(for example R"),
    ],
)
def test_a_job_nowhere_or_of_nobody_is_refused(at: str, robot: str | None, message: str) -> None:
    with pytest.raises(InputError, match=message):
        driven(2).operator.add_job(at, 0, robot)


def test_a_closed_place_is_entered_by_nobody_until_it_is_open() -> None:
    """N1 and N4 are the door; R1 has not set out when N4 is closed, and there is no other way."""
    floor = driven(2)
    floor.send(floor.operator.close("N4"))
    floor.drive(60)
    assert floor.robots[0].place in {"N0", "N1"}
    assert jobs_of(floor) == {"R1/job0": "N6"}
    floor.send(floor.operator.open("N4"))
    floor.drive(80)
    assert jobs_of(floor) == {}
    with pytest.raises(InputError, match="N4 is not closed"):
        floor.operator.open("N4")


def test_a_command_is_carried_out_once_though_its_answer_was_lost(tmp_path: Path) -> None:
    """The control ends after the commit and before the answer is written."""
    file = tmp_path / "run.journal"
    journal = SqliteJournal(file)
    floor = driven(2, journal)
    people, commands = Commands(file), Commands(file)
    number = people.ask({"kind": "add", "at": "N7", "work": "2"})
    obey(floor, commands)
    text = "R1/job1 at N7 is added before R1/job0 at N6"
    assert tell_answer(people.wait_for(number, 0)) == (True, text)
    people._database.execute("UPDATE commands SET answer = NULL")
    again = Dispatcher(FleetControl(journal), door())
    [(_, answer)] = Operator(again).obey(commands)[1]
    commands.answer(number, answer)
    assert tell_answer(people.wait_for(number, 0)) == (True, text)
    assert [job["name"] for job in list_jobs(again.ledger)].count("R1/job1") == 1
    assert "R1/job2" not in [job["name"] for job in list_jobs(again.ledger)]


@pytest.mark.parametrize(
    ("command", "answer"),
    [
        ({"kind": "hold"}, (True, "all robots: on hold")),
        ({"kind": "stop", "person": " Anna "}, (True, "all robots: stopped, by Anna")),
        ({"kind": "go", "name": "R1"}, (True, "R1: released")),
        ({"kind": "close", "name": "N4"}, (True, "N4 is closed")),
        (
            {"kind": "close", "name": "N4", "to": "N7"},
            (True, "the lane between N4 and N7 is closed"),
        ),
        ({"kind": "withdraw", "name": "R1/job0"}, (True, "R1/job0 is withdrawn")),
        ({"kind": "change", "name": "R1/job0", "work": "3"}, (True, "R1/job0 is changed")),
        ({"kind": "replan"}, (True, "replanned")),
        ({"kind": "fly"}, (False, "refused: command: 'fly' is no command")),
        ({"kind": "remove"}, (False, "refused: robot: remove needs the name of a robot")),
        ({"kind": "withdraw", "name": "R1/x"}, (False, "refused: job: 'R1/x' is no job")),
    ],
)
def test_each_command_has_an_answer(
    tmp_path: Path, command: dict[str, str], answer: tuple[bool, str]
) -> None:
    floor, commands = driven(2), Commands(tmp_path / "run.journal")
    number = commands.ask(command)
    obey(floor, commands)
    done, sentence = tell_answer(commands.wait_for(number, 0))
    assert done == answer[0]
    assert sentence.startswith(answer[1])
    assert commands.list_unanswered() == []


def test_all_robots_are_held_and_let_go(tmp_path: Path) -> None:
    floor, commands = driven(0), Commands(tmp_path / "run.journal")
    commands.ask({"kind": "hold"})
    obey(floor, commands)
    before = [own.released for own in floor.dispatcher.ledger.robots]
    floor.drive(40)
    assert [own.released for own in floor.dispatcher.ledger.robots] == before
    commands.ask({"kind": "go"})
    obey(floor, commands)
    floor.drive(60)
    assert jobs_of(floor) == {}


def test_commands_need_a_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be used for commands"):
        Commands(tmp_path / "no folder" / "run.journal")


RING: dict[str, Any] = {
    "format": "rightofway-scenario/1",
    "map": {"grid": ["...", ".@.", "..."]},
    "rules": {"rotations": False},
    "robots": [{"name": "R1", "home": "N0", "target": "N2", "work": 1}],
}
"""Two ways lead from N0 to N2: one through N1, and one twice as long."""


def ring(*more: dict[str, object]) -> Floor:
    """Return the robots of the ring, before anything is released to them."""
    document = {**RING, "robots": [*RING["robots"], *more]}
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    dispatcher = Dispatcher(FleetControl(MemoryJournal(), look_ahead=1), plan)
    dispatcher.begin("run")
    return Floor(dispatcher)


def places_of(floor: Floor, robot: int = 0) -> tuple[str, ...]:
    """Return the places that are still before a robot."""
    own = floor.dispatcher.ledger.robots[robot]
    return own.route.stretch(own.arrived, own.route.end)


@pytest.mark.parametrize("closed", [("N1",), ("N0", "N1"), ("N2", "N1")])
def test_robots_drive_round_what_is_closed(closed: tuple[str, ...]) -> None:
    """Of a lane both directions are closed, whichever end is named first."""
    floor = ring()
    floor.operator.operate("hold", "R1")
    floor.send(floor.operator.close(*closed))
    floor.send(floor.operator.operate("go", "R1"))
    floor.drive(60)
    assert jobs_of(floor) == {}
    assert floor.robots[0].place == "N0"


def test_what_is_closed_can_be_left() -> None:
    """R1 stands in N1 when it is closed, and goes round on its way home."""
    floor = ring()
    while floor.robots[0].place != "N1":
        floor.drive(1)
    floor.send(floor.operator.close("N1"))
    assert "N1" not in places_of(floor)[1:]
    floor.drive(60)
    assert floor.robots[0].place == "N0"
    assert jobs_of(floor) == {}


def test_a_robot_whose_work_is_closed_waits_and_the_others_go_on() -> None:
    floor = ring({"name": "R2", "home": "N8", "target": "N6", "work": 1})
    floor.send(floor.operator.close("N2"))
    floor.drive(60)
    assert jobs_of(floor) == {"R1/job0": "N2"}
    assert floor.robots[1].place == "N8"
    floor.send(floor.operator.open("N2"))
    floor.drive(60)
    assert jobs_of(floor) == {}


def test_a_closed_lane_is_closed_with_its_pieces() -> None:
    """No robot begins to drive along; one that is between its ends drives out."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {"A": [0, 0], "B": [3, 0], "C": [4, 0]},
                "edges": [["A", "B"], ["B", "C"]],
            },
            "spacing": 1,
        },
        "rules": {"rotations": False},
        "robots": [{"name": "R1", "home": "A", "target": "C"}],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    dispatcher = Dispatcher(FleetControl(MemoryJournal(), look_ahead=1), plan)
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    while floor.robots[0].place != "A-B/1":
        floor.drive(1)
    floor.send(floor.operator.close("B", "A"))
    floor.drive(60)
    assert floor.robots[0].place in {"B", "C"}  # its way home is closed
    assert dispatcher.ledger.robots[0].jobs_done == 1
    with pytest.raises(InputError, match="no lane joins A and C"):
        floor.operator.close("A", "C")
    floor.send(floor.operator.open("A", "B"))
    floor.drive(60)
    assert floor.robots[0].place == "A"


def test_laps_are_driven_round_what_is_closed() -> None:
    """The laps lead through N1; each of those that follow is replanned."""
    document = {**RING, "rules": {"rotations": False, "laps": 2}}
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), plan, LapsToDrive(plan))
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    floor.drive(4)
    floor.send(floor.operator.close("N1"))
    own = dispatcher.ledger.robots[0]
    before = own.laps_done
    floor.drive(400)
    assert own.laps_done > before + 4
    assert "N1" not in places_of(floor)[1 : own.released + 2 - own.arrived]


def test_replanned_laps_leave_no_robot_behind() -> None:
    """R1 drives by the home of R2, which goes aside once for as many laps as are planned.

    R2 has few visits before it then, whatever it has to do. If laps were added for that reason, or
    if all was planned again with each lap, R2 would wait for ever longer laps of R1.

              D   E2 ─── E3
              │   │      │
          A ─ B ─ C ─ E1 ─ F
    """
    places = {"A": [0, 0], "B": [1, 0], "C": [2, 0], "D": [1, 1], "E1": [3, 0], "F": [4, 0]}
    lanes = [["A", "B"], ["B", "C"], ["B", "D"], ["C", "E1"], ["E1", "F"]]
    places |= {"E2": [2, 1], "E3": [3, 2]}
    lanes += [["C", "E2"], ["E2", "E3"], ["E3", "F"]]
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": {"vertices": places, "edges": lanes}},
        "rules": {"rotations": False},
        "robots": [
            {"name": "R1", "home": "A", "target": "F"},
            {"name": "R2", "home": "B", "target": "B"},
        ],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    assert [len(track) for track in plan.tracks] == [9, 3]
    laps, control = LapsToDrive(plan), FleetControl(MemoryJournal())
    dispatcher = Dispatcher(control, plan, laps, planner="prioritized", time_limit=None)
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    floor.send(Operator(dispatcher).close("E1"))
    for steps in (30, 30):
        floor.drive(steps)
        assert all(len(own.route.places) <= 30 for own in control.ledger.robots)
    r1, r2 = control.ledger.robots
    assert r1.laps_done >= 2
    assert r2.arrived >= 2 * r1.laps_done
    assert "E1" not in places_of(floor)


def test_places_of_commands_may_be_named_by_their_stations() -> None:
    """Station D has the name of a vertex: the vertex counts."""
    places = {"A": [0, 0], "B": [1, 0], "C": [2, 0], "D": [3, 0], "E": [2, 1]}
    lanes = [["A", "B"], ["B", "C"], ["C", "D"], ["C", "E"]]
    shape = {"vertices": places, "edges": lanes, "stations": {"Press 1": "E", "D": "B"}}
    document = {
        "format": "rightofway-scenario/1",
        "map": {"roadmap": shape},
        "robots": [{"name": "R1", "home": "A", "target": "C"}],
    }
    plan = rightofway.solve(parse_scenario(document))
    dispatcher = Dispatcher(FleetControl(MemoryJournal()), plan)
    dispatcher.begin("run")
    floor = Floor(dispatcher)
    operator = floor.operator
    for at, vertex in (("Press 1", "E"), ("D", "D")):
        name, messages = operator.add_job(at, 0)
        floor.send(messages)
        assert jobs_of(floor)[name] == vertex
        floor.send(operator.change_job(name, "Press 1"))
        assert jobs_of(floor)[name] == "E"
    with pytest.raises(InputError, match=r"'Pres 1' \(did you mean 'Press 1'\?\)"):
        operator.add_job("Pres 1", 0)
    operator.close("Press 1", "C")
    assert list(dispatcher.ledger.closed) == [("E", "C")]
    operator.open("Press 1", "C")
    assert list(dispatcher.ledger.closed) == []
