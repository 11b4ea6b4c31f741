"""Problems of the League of Robot Runners, read as scenarios with jobs."""

import json
from contextlib import suppress
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import load, load_either, load_plan, load_with_notes, write_scenario
from rightofway.io.scenario.reader import Loaded

MAP = "type octile\nheight 3\nwidth 4\nmap\n...E\n.@T.\n.W.S\n"
AGENTS = "# version for LoRR 2024\n3\n0\n3\n# the last one is not used\n11\n"
TASKS = "# version for LoRR 2024\n3\n4,3,7\n8\n11,0\n"
OLD_TASKS = "5\n4\n3\n7\n8\n11\n"

PROBLEM = {
    "mapFile": "maps/hall.map",
    "agentFile": "agents/two.agents",
    "teamSize": 2,
    "taskFile": "tasks/few.tasks",
    "numTasksReveal": 1.5,
    "version": "2024 LoRR",
}
OLD = {
    **{key: value for key, value in PROBLEM.items() if key != "version"},
    "numTasksReveal": 1,
    "taskAssignmentStrategy": "roundrobin",
}


@pytest.fixture
def hall(tmp_path: Path) -> Path:
    """Return a directory with a map, two agents and three tasks, in folders as the League's."""
    for folder, name, text in (
        ("maps", "hall.map", MAP),
        ("agents", "two.agents", AGENTS),
        ("tasks", "few.tasks", TASKS),
    ):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / name).write_text(text, encoding="utf-8")
    return tmp_path


def write(hall: Path, problem: dict[str, object], **files: str) -> Path:
    for folder, text in files.items():
        (file,) = (hall / folder).iterdir()
        file.write_text(text, encoding="utf-8")
    path = hall / "problem.json"
    path.write_text(json.dumps(problem, indent=1), encoding="utf-8")
    return path


def read_faults(path: Path) -> list[str]:
    with pytest.raises(InputError) as error:
        load(path)
    return [str(fault).replace(f"{path.parent}/", "") for fault in error.value.faults]


def test_tasks_of_2024_are_jobs_with_several_stops_that_any_robot_may_do(hall: Path) -> None:
    loaded = load_with_notes(write(hall, PROBLEM))
    scenario = loaded.scenario
    assert loaded.reveal == 3  # 1.5 for each of two agents
    assert [(job.name, job.robot) for job in scenario.jobs or ()] == [
        ("T0", None),
        ("T1", None),
        ("T2", None),
    ]
    name = scenario.roadmap.name
    stops = [[(name(s.at), s.load) for s in job.stops] for job in scenario.jobs or ()]
    assert stops == [[("N4", 1), ("N3", 0), ("N7", -1)], [("N8", 0)], [("N11", 1), ("N0", -1)]]


def test_agents_are_robots_that_head_east_turn_by_a_right_angle_and_do_not_return(
    hall: Path,
) -> None:
    scenario = load(write(hall, PROBLEM))
    assert [robot.name for robot in scenario.robots] == ["A0", "A1"]
    for robot, home in zip(scenario.robots, ("N0", "N3"), strict=True):
        assert robot.start is not None
        assert (scenario.roadmap.name(robot.home), robot.start.at) == (home, robot.home)
        assert robot.start.heading == 0
        assert robot.speed == 1
    rules = scenario.rules
    assert rules.turn_rate == 90
    assert rules.turn == 0
    assert rules.ends == "none"
    assert rules.occupancy == "one"
    assert rules.headway == 0
    assert rules.rotations
    assert scenario.problem.clock.tick == 1


def test_tasks_of_2023_are_dealt_to_the_agents_in_turn(hall: Path) -> None:
    loaded = load_with_notes(write(hall, OLD, tasks=OLD_TASKS))
    assert loaded.reveal == 1  # for each agent
    assert [(job.name, job.robot, job.after) for job in loaded.scenario.jobs or ()] == [
        ("T0", "A0", ()),
        ("T1", "A1", ()),
        ("T2", "A0", ("T0",)),  # an agent does its tasks in the order of the file
        ("T3", "A1", ("T1",)),
        ("T4", "A0", ("T2",)),
    ]
    greedy = load_with_notes(write(hall, {**OLD, "taskAssignmentStrategy": "greedy"}))
    assert greedy.reveal == 2  # one for each of two agents
    assert {job.robot for job in greedy.scenario.jobs or ()} == {None}


def test_an_errand_where_the_one_before_it_is_takes_a_step_of_its_own(hall: Path) -> None:
    """The League counts one errand of an agent in a step, and none before step 1."""
    jobs = load(write(hall, OLD, tasks="4\n4\n3\n4\n8\n")).jobs or ()
    assert [(int(s.earliest), int(s.work)) for job in jobs for s in job.stops] == [
        (1, 0),
        (1, 0),
        (1, 1),  # like T0, the task of A0 before it
        (1, 0),
    ]
    jobs = load(write(hall, PROBLEM, tasks="2\n4,4,3\n3,0\n")).jobs or ()
    assert [[(int(s.earliest), int(s.work)) for s in job.stops] for job in jobs] == [
        [(1, 0), (0, 1), (0, 0)],
        [(1, 0), (0, 0)],
    ]


def test_all_cells_but_those_of_the_blocked_characters_are_free(hall: Path) -> None:
    grid = load(write(hall, PROBLEM)).roadmap.grid
    assert grid is not None
    assert list(grid.as_lines()) == ["....", ".@@.", "...."]


def test_files_are_found_next_to_the_problem_and_next_to_its_folder(hall: Path) -> None:
    path = write(hall, PROBLEM)
    (hall / "maps" / "hall.map").rename(hall / "hall.map")
    inner = hall / "problems"
    inner.mkdir()
    assert load(path) == load(path.rename(hall / "other.json"))
    (hall / "hall.map").rename(inner / "hall.map")
    moved = (hall / "other.json").rename(inner / "problem.json")
    assert len(load(moved).jobs or ()) == 3


def test_a_problem_is_a_scenario_for_all_readers_and_for_the_writer(hall: Path) -> None:
    path = write(hall, PROBLEM)
    scenario = load(path)
    opened = load_either(path)
    assert isinstance(opened, Loaded)
    assert opened.scenario == scenario
    assert opened.reveal == 3
    write_scenario(scenario, hall / "problem.yaml")
    again = load(hall / "problem.yaml")
    assert again.jobs == scenario.jobs
    assert again.robots == scenario.robots
    assert again.rules == scenario.rules
    with pytest.raises(InputError):
        load_plan(path)


def test_faults_of_all_files_are_reported_with_file_and_line(hall: Path) -> None:
    path = write(hall, PROBLEM, agents="2\n0\n5\n", tasks="2\n4,12\n3, x\n")
    agents = "problem.json:3: agentFile: agents/two.agents"
    tasks = "problem.json:5: taskFile: tasks/few.tasks"
    remedy = "(give locations, row * width + column, with commas between)"
    assert read_faults(path) == [f"{tasks}:3: '3, x' is no row of locations {remedy}"]
    path = write(hall, PROBLEM, tasks="2\n4,12\n3\n")
    assert read_faults(path) == [
        f"{agents}:3: [1, 1] is blocked by '@' (N1 is free)",
        f"{tasks}:2: [3, 0] is outside the map (rows are 0 to 2, columns 0 to 3)",
    ]


def test_agents_that_start_at_one_cell_are_refused_at_their_lines(hall: Path) -> None:
    path = write(hall, PROBLEM, agents="2\n3\n3\n")
    start = "problem.json:3: agentFile: agents/two.agents:3: "
    remedy = "(a vertex holds one robot; move one of them)"
    assert read_faults(path) == [
        f"{start}home: N3 is the home of A0 already {remedy}",
        f"{start}start.at: N3 is the start of A0 already {remedy}",
    ]


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"teamSize": 4}, "teamSize: 4 is more than the 3 agents of"),
        ({"teamSize": 0}, "teamSize: 0 does not fit (give a whole number from 1 to"),
        ({"numTasksReveal": 0.25}, "numTasksReveal: 0.25 reveals no task (give 1 or more)"),
        ({"taskFile": "other.tasks"}, "'other.tasks' is neither next to the problem nor in ../tas"),
        ({"mapFile": "../hall.map"}, "'../hall.map' is neither next to the problem nor in ../maps"),
        ({"version": None, "taskAssignmentStrategy": "best"}, "'best' does not fit (give roundrob"),
        ({"taskAssignmentStrategy": "greedy"}, "'greedy' does not fit (give roundrobin, roundrob"),
        ({"agentCounter": 3}, "is a problem of 2026 (only those of 2023 and 2024 are read)"),
    ],
)
def test_a_value_that_does_not_fit_is_refused(
    hall: Path, change: dict[str, object], fault: str
) -> None:
    path = write(hall, PROBLEM | change)
    (found,) = read_faults(path)
    assert fault in found


@pytest.mark.parametrize(
    ("tasks", "fault"),
    [
        ("4\n1\n2\n", "tasks/few.tasks:1: 4 rows are counted, and 2 follow (write how many rows"),
        ("0\n1\n", "tasks/few.tasks:1: 0 rows are counted, and 1 follow"),
        ("1,2\n1\n", "tasks/few.tasks: does not begin with a count (write how many rows follow)"),
        ("# nothing\n", "tasks/few.tasks: does not begin with a count"),
    ],
)
def test_rows_that_differ_from_their_count_are_refused(hall: Path, tasks: str, fault: str) -> None:
    (found,) = read_faults(write(hall, PROBLEM, tasks=tasks))
    assert fault in found


@pytest.mark.parametrize("value", [None, -1, 0, "x", [], {}, True, 1e300, "../tasks/few.tasks"])
@pytest.mark.parametrize("key", sorted({*PROBLEM, *OLD}))
def test_each_value_of_another_kind_is_read_or_a_fault(hall: Path, key: str, value: object) -> None:
    with suppress(InputError):
        load(write(hall, PROBLEM | {key: value}))
