"""Plans of other programs: read by content, judged, written, and refused with the place of a fault.

All plans are for this hall of three rows, where a robot can step aside only in the middle::

    . . .
    @ . @
    . . .
"""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from rightofway import check
from rightofway.errors import InputError
from rightofway.io import (
    FOREIGN_FORMATS,
    format_foreign,
    load,
    load_either,
    load_plan,
    write_plan,
)
from rightofway.model import Plan, Track
from rightofway.solve import solve
from tests.builders.fleets import PAPER, paper_scenario

HALL = "type octile\nheight 3\nwidth 3\nmap\n...\n@.@\n...\n"
"""Cells (row, column): (0, 0) to (0, 2), (1, 1), (2, 0) to (2, 2)."""

STEPS = """agents=2
map_file=hall.map
solver=planner
starts=(0,0),(2,0),
goals=(0,2),(2,2),
solution=
0:(0,0),(2,0),
1:(0,0),(1,0),
2:(1,0),(1,1),
3:(1,1),(1,2),
4:(1,2),(2,2),
5:(0,2),(2,2),
"""
"""Agent 0 goes (0, 0) to (2, 0), one step behind agent 1, which goes from (0, 2) to (2, 2)."""

PATHS = """Agent 0: (0,0)->(0,0)->(0,1)->(1,1)->(2,1)->(2,0)->
Agent 1: (0,2)->(0,1)->(1,1)->(2,1)->(2,2)->
"""

SCHEDULE = """cost: 9
schedule:
  agent0:
    - {x: 0, y: 0, t: 0}
    - {x: 0, y: 0, t: 1}
    - {x: 1, y: 0, t: 2}
    - {x: 1, y: 1, t: 3}
    - {x: 1, y: 2, t: 4}
    - {x: 0, y: 2, t: 5}
  agent1: [{x: 2, y: 0, t: 0}, {x: 1, y: 0, t: 1}, {x: 1, y: 1, t: 2}, {x: 1, y: 2, t: 3},
    {x: 2, y: 2, t: 4}]
"""


def log(paths: list[str], **more: object) -> str:
    """Return a log of PlanViz with the two starts."""
    start = [[0, 0, "E"], [0, 2, "W"]][: len(paths)]
    document = {"actionModel": "MAPF_T", "teamSize": len(paths), "start": start}
    return json.dumps(document | {"actualPaths": paths} | more)


MOVES = log(
    ["W,R,U,U,L", "L,U,U,R,W"],
    actionModel="MAPF",
    events=[[[0, 0, "assigned"], [0, 5, "finished"]], [[1, 0, "assigned"], [1, 4, "finished"]]],
    tasks=[[0, 2, 0], [1, 2, 2]],
)
"""PlanViz: U adds 1 to the row."""

EARLIER_MOVES = MOVES.replace("U", "D")

TURNS = log(
    ["W,W,F,R,F,F,R,F", "F,C,F,F,C,F"],
    version="2024 LoRR",
    events=[[0, 0, 0, 0], [6, 0, 0, 1], [8, 0, 0, 2], [6, 1, 1, 1]],
    tasks=[[0, 0, [2, 1, 2, 0]], [1, 0, [2, 2]]],
)
"""Agents turn for one step where they change direction."""

RUNS = log(
    ["[(0,0,0,0,0):(W 25,F 10,R 3)][(38,0,1,0,3):(W 1,R 7,F 20,R 10,F 10)]",
     "[(0,0,2,2,0):(F 10,C 10,F 20,C 10,F 4,W 2,F 6)]"],
    version="2026 LoRR", agentMaxCounter=10,
)  # fmt: skip
"""A move takes ten steps; agents stop for a while in the middle of a move and of a turn."""


@pytest.fixture
def hall(tmp_path: Path) -> Path:
    """Return a folder with the map."""
    (tmp_path / "hall.map").write_text(HALL, encoding="utf-8")
    return tmp_path


def read(hall: Path, text: str, **more: Path) -> Plan:
    """Read a text as a file on the map of the hall."""
    (hall / "plan").write_text(text, encoding="utf-8")
    return load_plan(hall / "plan", **({"map_file": hall / "hall.map"} | more))


def names(plan: Plan) -> list[list[tuple[str, int]]]:
    """Return the visits of each robot: places and ticks."""
    place = plan.scenario.roadmap.name
    return [
        [
            (place(vertex), tick)
            for vertex, tick in zip(track.vertices.tolist(), track.enter.tolist(), strict=True)
        ]
        for track in plan.tracks
    ]


AWAY = [
    [("N0", 0), ("N1", 2), ("N4", 3), ("N7", 4), ("N6", 5)],
    [("N2", 0), ("N1", 1), ("N4", 2), ("N7", 3), ("N8", 4)],
]


@pytest.mark.parametrize(
    "text",
    [
        STEPS,
        STEPS.partition("solution=\n")[2],
        PATHS,
        SCHEDULE,
        MOVES,
        EARLIER_MOVES,
        MOVES.replace("actualPaths", "plannerPaths"),
    ],
)
def test_one_plan_is_read_from_every_format(hall: Path, text: str) -> None:
    plan = read(hall, text)
    assert names(plan) == AWAY
    assert check(plan).ok
    assert (plan.flowtime, plan.run.name, plan.run.status) == (9, "unknown", None)
    assert plan.scenario.rules.ends == "none"
    assert plan.scenario.problem.clock.tick == 1


def test_a_third_number_of_a_path_is_a_heading_or_a_step(hall: Path) -> None:
    headings = PATHS.replace(")", ",2)")
    assert names(read(hall, headings)) == AWAY
    steps = """Agent 0: (0,0,0)->(0,1,2)->(1,1,3)->(2,1,4)->(2,0,5)
    Agent 1: (0,2,0)->(0,1,1)->(1,1,2)->(2,1,3)->(2,2,4)"""
    assert names(read(hall, steps)) == AWAY
    with pytest.raises(InputError, match="plan:1: the steps of the cells do not grow from 0 on"):
        read(hall, "Agent 0: (0,0,0)->(0,1,7)->(0,2,7)->")


def test_turns_are_waits_and_errands_are_stops_in_order(hall: Path) -> None:
    plan = read(hall, TURNS)
    assert check(plan).ok
    assert names(plan) == [
        [("N0", 0), ("N1", 3), ("N4", 5), ("N7", 6), ("N6", 8)],
        [("N2", 0), ("N1", 1), ("N4", 3), ("N7", 4), ("N8", 6)],
    ]
    place = plan.scenario.roadmap.name
    assert [[place(stop.at) for stop in robot.stops] for robot in plan.scenario.robots] == [
        ["N7", "N6"],
        ["N8"],
    ]


def test_a_move_of_ten_steps_ends_when_its_tenth_step_is_done(hall: Path) -> None:
    plan = read(hall, RUNS)
    assert plan.scenario.problem.clock.tick == Fraction(1, 10)
    assert names(plan) == [
        [("N0", 0), ("N1", 35), ("N4", 56), ("N7", 66), ("N6", 86)],
        [("N2", 0), ("N1", 10), ("N4", 30), ("N7", 40), ("N8", 62)],
    ]
    assert check(plan).ok


def test_whole_moves_of_ten_steps_are_one_tick_each(hall: Path) -> None:
    plan = read(hall, log(["[(0,0,0,0,0):(F 20,W 10)]"], agentMaxCounter=10))
    assert plan.scenario.problem.clock.tick == 1
    assert names(plan) == [[("N0", 0), ("N1", 1), ("N2", 2)]]
    assert plan.flowtime == 2


def test_the_map_is_found_beside_the_plan_or_the_scen_file(hall: Path) -> None:
    (hall / "steps.txt").write_text(STEPS, encoding="utf-8")
    assert names(load_plan(hall / "steps.txt")) == AWAY
    (hall / "paths.txt").write_text(PATHS, encoding="utf-8")
    (hall / "long.txt").write_text(STEPS.replace("hall.map", "h" * 300), encoding="utf-8")
    with pytest.raises(InputError, match="is not beside it"):
        load_plan(hall / "long.txt")
    with pytest.raises(InputError, match=r"paths.txt: the plan does not name its map \(give it"):
        load_plan(hall / "paths.txt")
    rows = "version 1\n0\thall.map\t3\t3\t0\t0\t0\t2\t5\n0\thall.map\t3\t3\t2\t0\t1\t1\t2\n"
    (hall / "hall.scen").write_text(rows, encoding="utf-8")
    plan = load_plan(hall / "paths.txt", scen=hall / "hall.scen")
    assert plan.scenario == load(hall / "hall.scen")
    # The second agent of the rows wants to go to (1, 1), and the plan leads it to (2, 2).
    assert [fault.kind for fault in check(plan).faults] == ["wrong end"]


def test_faults_of_a_plan_are_left_to_the_judge(hall: Path) -> None:
    swap = "Agent 0: (0,0)->(0,1)->\nAgent 1: (0,1)->(0,0)->\nAgent 2: (2,2)->(2,0)->\n"
    report = check(read(hall, swap))
    assert set(report.counts) == {"swap conflict", "jump"}


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("0:(0,0),(2,0),\n2:(0,0),(1,0),\n", "plan:2: step 2 stands where step 1 is expected"),
        ("0:(0,0),(2,0),\n1:(0,0),\n", "plan:2: 1 agents, the first step has 2"),
        ("0:(0,0),(2,x),\n", r"plan:1: '\(2,x\),' is no cell"),
        ("0:(0,0),\n1:(0,1),\n", r"plan:2: A0 enters \[1, 0\] at step 1, which is blocked"),
        ("0:(0,0),\n1:(9,0),\n", r"plan:2: A0 enters \[0, 9\] at step 1, which is outside 3 rows"),
        ("goals=(0,0),(1,0),\n0:(0,0),\n", "goals: 2 for 1 agents"),
        ("hello\n0:(0,0),\n", "plan:1: 'hello' is no step"),
        ("Agent 0: (0,0)->\nAgent 2: (0,1)->\n", "agent 1 has no path"),
        ("Agent 0: (0,0)->\nAgent 0: (0,1)->\n", "plan:2: agent 0 has a path in line 1 already"),
        ("Agent 0: (0,0)->(0,1\n", r"plan:1: '\(0,1' is no cell"),
        ("Agent 0:\n", "plan:1: the path is empty"),
        ("Agent 0: (0,0)->\nAgent 1: (0,0)->\n", "plan:2: A1.home: N0 is the home of"),
        ("Agent 0: (0,0)->(1,0)->\n", r"plan:1: A0 enters \[1, 0\] at step 1, which is blocked"),
        ("schedule:\n  a:\n  - {x: 0, y: 0, t: 1}\n", r"plan:3: schedule.a\[0\]: t 1 stands after"),
        ("schedule:\n  a:\n  - {x: 0, y: 0}\n", r"plan:3: schedule.a\[0\].t: is missing"),
        ("schedule: 3\n", "plan:1: schedule: 3 is not a mapping"),
        (log(["F,X"]), r"plan:1: actualPaths\[0\].step\[1\]: 'X' is no action \(give one of F, R,"),
        (log(["F"], actionModel="CAR"), "actionModel: 'CAR' is not known"),
        (log(["F"], actionModel=[1]), r"actionModel: \[1\] is not known"),
        (
            '{"note": "no \\"actualPaths\\" here, but \\"actualPaths\\": 1", "actualPaths" : 3}',
            "3 is",
        ),
        (log(["F"], start=[[0, 0, "Z"]]), r"start\[0\]\[2\]: 'Z' is no heading"),
        (log(["F"], start=[]), "start: does not have a start for each of 1 agents"),
        (
            log(["[(0,0,0,0,0):(F 3,R 2)]"], agentMaxCounter=10),
            "F ends after 3 of 10 steps",
        ),
        (log(["[(0,0,0,0,0):(F 3)][(9,0,0,0,0):(W 1)]"]), "a part begins with step 9, the part"),
        (log(["[(0,0,0,0,0):(F 999999)]"]), r"A0 enters \[0, 3\] at step 3, which"),
        (log(["[(0,0,0,0,0):(W 99999999)]"]), "99999999 steps are too many"),
        (log(["[(0,0,0,0):(F 1)]"]), "is no part"),
        (log(["F"], events=[[1, 0, 7, 1]]), r"events\[0\]: task 7 has no errand 1"),
        (log(["F"], tasks=[[1]]), r"tasks\[0\]: \[1\] is no task"),
        (log(["F"], agentMaxCounter=0), "agentMaxCounter: 0 does not fit"),
    ],
)
def test_what_is_wrong_is_named_with_its_place(hall: Path, text: str, fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        read(hall, text)


def test_of_many_agents_on_a_wrong_map_a_few_are_named(hall: Path) -> None:
    lines = [f"Agent {agent}: (8,{agent})->\n" for agent in range(30)]
    with pytest.raises(InputError) as caught:
        read(hall, "".join(lines))
    *few, rest = caught.value.faults
    assert [fault.line for fault in few] == [1, 2, 3, 4]
    assert rest.message.startswith("26 more agents leave the map")


def test_files_for_a_plan_of_ours_are_refused(hall: Path) -> None:
    write_plan(solve(paper_scenario(PAPER[0])), hall / "ours.json")
    with pytest.raises(InputError, match="has its own map and robots in it"):
        load_plan(hall / "ours.json", map_file=hall / "hall.map")


@pytest.mark.parametrize("name", FOREIGN_FORMATS)
def test_what_is_written_is_read_back_with_the_same_visits(hall: Path, name: str) -> None:
    """The paper's fifth case has two speeds, work and ways home: visits keep places and ticks."""
    plan = solve(paper_scenario(PAPER[4]))
    again = read(hall, format_foreign(plan, name))
    assert names(again) == names(plan)
    assert [kind for kind in check(again).counts if kind != "wrong home"] == []
    (hall / "plan").write_text(format_foreign(plan, name), encoding="utf-8")
    assert load_either(hall / "plan", map_file=hall / "hall.map") == again


def read_league(tmp_path: Path, tasks: str) -> Plan:
    """Return a plan of a problem of the League: two agents on two rows of four cells."""
    files = {
        "hall.map": "type octile\nheight 2\nwidth 4\nmap\n....\n....\n",
        "two.agents": "2\n0\n7\n",
        "few.tasks": tasks,
        "problem.json": json.dumps(
            {"mapFile": "hall.map", "agentFile": "two.agents", "taskFile": "few.tasks",
             "teamSize": 2, "numTasksReveal": 1.5, "version": "2024 LoRR"}
        ),
    }  # fmt: skip
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return solve(load(tmp_path / "problem.json"))


def test_jobs_of_robots_that_turn_are_tasks_and_actions_of_the_league(tmp_path: Path) -> None:
    """A0 goes from [0, 0] to [0, 1] and back; A1 from [1, 3], where it faces a wall, to [1, 2]."""
    plan = read_league(tmp_path, "2\n1,0\n6\n")
    document = json.loads(format_foreign(plan, "planviz"))
    assert document["actualPaths"] == ["F,R,R,F", "R,R,F,W"]
    assert document["start"] == [[0, 0, "E"], [1, 3, "E"]]
    assert document["tasks"] == [[0, 1, [0, 1, 0, 0]], [1, 1, [1, 2]]]
    assert document["events"] == [[1, 0, 0, 1], [3, 1, 1, 1], [4, 0, 0, 2]]
    assert document["actualSchedule"] == ["1:0", "1:1"]
    assert (document["makespan"], document["numTaskFinished"]) == (4, 2)
    assert (document["actionModel"], document["version"]) == ("MAPF_T", "2024 LoRR")
    path = tmp_path / "result.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    assert names(load_plan(path, tmp_path / "hall.map")) == names(plan)


def test_an_errand_that_the_league_does_not_count_is_not_finished(tmp_path: Path) -> None:
    """One robot does both tasks at one cell and instant: the second one is not counted there."""
    plan = read_league(tmp_path, "2\n1,0\n6\n")
    assert plan.tours is not None
    twice = replace(plan, tours=((*plan.tours[0], plan.tours[0][-1]), ()))
    document = json.loads(format_foreign(twice, "planviz"))
    assert document["events"] == [[1, 0, 0, 1], [4, 0, 0, 2], [5, 0, 0, 2]]


def test_a_move_without_the_time_for_its_turn_is_refused(tmp_path: Path) -> None:
    plan = read_league(tmp_path, "2\n1,0\n6\n")
    early = Track.of([7, 6], [0, 2])
    with pytest.raises(InputError, match=r"robots\[1\]: drives 2 ticks after it came, and turns"):
        format_foreign(replace(plan, tracks=(plan.tracks[0], early)), "planviz")


@pytest.mark.parametrize("text", [STEPS, PATHS, SCHEDULE, MOVES, TURNS, RUNS])
def test_a_text_with_random_changes_is_a_plan_or_a_fault(hall: Path, text: str) -> None:
    draw = np.random.default_rng(7)
    for _ in range(150):
        spoiled = list(text)
        for _ in range(draw.integers(1, 5)):
            place = int(draw.integers(len(spoiled)))
            match draw.integers(3):
                case 0:
                    spoiled[place] = str(draw.choice(list("(){}[]:,->\n 019FAgentRWx\"'é")))
                case 1:
                    del spoiled[place]
                case _:
                    spoiled.insert(place, str(draw.choice(list(text))))
        with suppress(InputError):
            check(read(hall, "".join(spoiled)))
