"""Tasks of other programs, planned as jobs: MAPD runs of pibt2, and MAPF with target assignment.

``python -m benchmarks.tasks_of_others mapd MAP LOG ... [--seconds S] [--output FOLDER]`` reads logs
of ``mapd`` of https://github.com/Kei18/pibt2, which draws tasks while it plans. A log names the
starts of the agents, and for each task both places and the step at which it appears. All tasks are
known here from the start on; with ``--online``, each from the step on at which it appears, and
``--seconds`` is the time of each round of a shift. The table compares makespan and mean service
time with the log's.

``python -m benchmarks.tasks_of_others targets FILE ...`` reads inputs of CBS-TA of
https://github.com/whoenig/libMultiRobotPlanning: agents with `potentialGoals`, one of which each
gets. Each assignment of goals to agents is planned and proven, and the table has the least flowtime
of all.

``--output`` writes the scenarios as files that `rightofway plan` reads.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from benchmarks.common import table
from rightofway import solve
from rightofway.dispatch.settings import ShiftSettings
from rightofway.io import load_map, write_scenario
from rightofway.metrics import derive_outcome
from rightofway.model import Job, JobStop, OutcomeKind, Robot, Rules, Scenario, Stop
from rightofway.site import Grid, Roadmap, VertexId, make_grid_roadmap

RULES = Rules(turn=Fraction(0), ends="none")

TASK = re.compile(r"(\d+):(\d+)->(\d+),appear=(\d+),finished=\d+")


class Log(NamedTuple):
    """A run of pibt2: its tasks as jobs, and its figures [steps]."""

    solver: str
    scenario: Scenario
    makespan: int
    service_time: float


def read_log(text: str, rows: Sequence[str]) -> Log:
    """Return a run of ``mapd`` on the rows of its map."""
    roadmap = make_grid_roadmap(rows)
    values = dict(line.split("=", 1) for line in text.splitlines() if re.match(r"[a-z_]+=", line))
    starts = re.findall(r"\((\d+),(\d+)\)", values["starts"])
    robots = [
        Robot(name=f"A{number}", home=find_vertex(roadmap, int(row), int(column)))
        for number, (column, row) in enumerate(starts)
    ]
    columns = len(rows[0])
    jobs = []
    for number, *places, appears in sorted(tuple(map(int, task)) for task in TASK.findall(text)):
        pickup, dropoff = (find_vertex(roadmap, *divmod(place, columns)) for place in places)
        stops = (
            JobStop(at=pickup, load=1, earliest=Fraction(appears)),
            JobStop(at=dropoff, load=-1),
        )
        jobs.append(Job(name=f"T{number}", stops=stops))
    return Log(
        solver=values["solver"],
        scenario=Scenario(roadmap=roadmap, robots=tuple(robots), rules=RULES, jobs=tuple(jobs)),
        makespan=int(values["makespan"]),
        service_time=float(values["service_time"]),
    )


def find_vertex(roadmap: Roadmap, row: int, column: int) -> VertexId:
    """Return the vertex of a free cell."""
    grid = roadmap.grid
    assert isinstance(grid, Grid), "the map has rows"
    vertex = int(grid.vertex_at[row * grid.columns + column])
    assert vertex >= 0, f"the cell [{row}, {column}] is blocked"
    return VertexId(vertex)


def list_assignments(document: Mapping[str, Any]) -> Iterator[Scenario]:
    """Yield a scenario without jobs for each assignment of goals to agents; places are [x, y]."""
    width, height = document["map"]["dimensions"]
    blocked = {tuple(cell) for cell in document["map"]["obstacles"]}
    roadmap = make_grid_roadmap(
        ["".join(".@"[(x, y) in blocked] for x in range(width)) for y in range(height)]
    )
    agents = document["agents"]
    homes = [find_vertex(roadmap, *agent["start"][::-1]) for agent in agents]
    choices = [  # an agent without goals may end anywhere
        [find_vertex(roadmap, *goal[::-1]) for goal in agent["potentialGoals"]]
        or [VertexId(vertex) for vertex in range(roadmap.n_vertices)]
        for agent in agents
    ]
    for goals in product(*choices):
        if len(set(goals)) < len(goals):
            continue
        robots = tuple(
            Robot(name=agent["name"], home=home, stops=(Stop(at=goal),))
            for agent, home, goal in zip(agents, homes, goals, strict=True)
        )
        yield Scenario(roadmap=roadmap, robots=robots, rules=RULES)


def plan_log(log: Log, seconds: float) -> tuple[int, float]:
    """Return makespan and mean service time of a plan that serves all tasks [steps]."""
    plan = solve(log.scenario, time_limit=seconds)
    assert plan.tours is not None, "the scenario has jobs"
    assert not plan.unserved, "a task is not served"
    ends = {item.job: item.end for tour in plan.tours for item in tour}  # of the last stop
    jobs = log.scenario.jobs or ()
    times = [ends[number] - int(job.earliest) for number, job in enumerate(jobs)]
    return max(ends.values()), sum(times) / len(times)


def hold_shift(log: Log, seconds: float) -> tuple[int, float]:
    """Return makespan and mean service time of a shift with tasks that appear [steps]."""
    record = ShiftSettings(round_time=seconds, lead=Fraction(0)).simulate(log.scenario)
    ends = {name: own.ended for name, own in record.jobs.items()}
    times = [(ends[job.name] or 0) - int(job.earliest) for job in log.scenario.jobs or ()]
    assert None not in ends.values(), "a task is not served"
    return max(end or 0 for end in ends.values()), sum(times) / len(times)


def find_least_flowtime(document: Mapping[str, Any], seconds: float) -> int:
    """Return the least flowtime over all assignments of goals, each of them proven [steps]."""
    plans = [solve(scenario, time_limit=seconds) for scenario in list_assignments(document)]
    kinds = {derive_outcome(plan).kind for plan in plans}
    assert kinds == {OutcomeKind.OPTIMAL}, "an optimum was not proven"
    return min(int(plan.flowtime) for plan in plans)


def main() -> None:
    """Read files, plan their tasks, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=["mapd", "targets"])
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--online", action="store_true")
    parser.add_argument("--output", type=Path)
    given = parser.parse_args()
    scenarios, lines = dict[str, Scenario](), list[Sequence[str]]()
    if given.kind == "mapd":
        heads = ["log", "makespan", "here", "service time", "here"]
        map_file, *logs = given.files
        for file in logs:
            log = read_log(file.read_text(encoding="utf-8"), load_map(map_file))
            makespan, service = (hold_shift if given.online else plan_log)(log, given.seconds)
            figures = f"{log.makespan}", f"{makespan}", f"{log.service_time:.1f}", f"{service:.1f}"
            lines.append((log.solver, *figures))
            scenarios[file.stem] = log.scenario
    else:
        heads = ["file", "least flowtime"]
        for file in given.files:
            document = yaml.safe_load(file.read_text(encoding="utf-8"))
            lines.append((file.stem, str(find_least_flowtime(document, given.seconds))))
            named = enumerate(list_assignments(document))
            scenarios |= {f"{file.stem}-{number}": scenario for number, scenario in named}
    if given.output is not None:
        for name, scenario in scenarios.items():
            write_scenario(scenario, given.output / f"{name}.yaml")
    sys.stdout.write(table(heads, lines))


if __name__ == "__main__":
    main()
