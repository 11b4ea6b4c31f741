"""Problems of the League of Robot Runners, rounds 2023 and 2024, read as scenarios with jobs.

A problem is JSON that names a map, a file of agents and a file of tasks, and how many tasks are
known at a time. Both files have a line with a count, then one line for each agent or task; lines
that begin with # are comments. A location is row * width + column. A task of 2023 is one location;
one of 2024 is several, which one agent visits in order.

Agents start heading east, move one cell and turn 90 degrees in a time unit, and do not return.
A robot does one task of several locations at a time: it loads at the first and unloads at the last.

At each step from 1 on, an agent finishes the next location of its task if it is there. So jobs have
an `earliest` of 1, and a stop where the agent's stop before it is has a work time of 1. Where any
robot may do a task, the first stop has none: the stop before it is not known.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, Location, Steps, Where, locate_faults, name_file, quote
from rightofway.io.content import read_text
from rightofway.io.faults import Faults
from rightofway.io.movingai import find_beside, load_map
from rightofway.io.scenario.fleet import PlacedRobot
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.reader import CLASSIC, Loaded, build_scenario, list_notes
from rightofway.io.scenario.work import ReadWork
from rightofway.io.source import Source
from rightofway.model import Job, JobStop, Robot, RobotState
from rightofway.site import VertexId, make_grid_roadmap

RULES = replace(CLASSIC, turn_rate=Fraction(90))
"""The rules of the League: those of the classic benchmark, and turns take time."""

BLOCKED = "@T"
"""Characters of cells that are blocked; all others are free."""

STRATEGIES = {"roundrobin": True, "roundrobin_fixed": True, "greedy": False}
"""How tasks of 2023 are assigned, and whether that decides the agent of each task."""

MOST_AGENTS = 1_000_000

_ROW = re.compile(r"[0-9]{1,9}([ \t]*,[ \t]*[0-9]{1,9})*")


def recognizes(text: str) -> bool:
    """Return whether a text is JSON that names files of agents and tasks."""
    return text.lstrip().startswith("{") and '"agentFile"' in text and '"taskFile"' in text


def read_problem(document: Any, path: Path) -> Loaded:
    """Return the scenario of a problem, and how many unfinished jobs are known at a time.

    Raises
    ------
    InputError
        With every independent fault of the problem and its files.
    """
    problem, faults = Source(document), Faults()
    map_file = faults.attempt("", _find_file, problem, "mapFile", path)
    agents = faults.attempt("", _read_rows, problem, "agentFile", path)
    tasks = faults.attempt("", _read_rows, problem, "taskFile", path)
    loaded = None if map_file is None else faults.attempt("mapFile", _load_map, map_file)
    team = faults.attempt("", _read_team, problem, agents)
    has_agents = faults.attempt("", _read_strategy, problem)
    reveal = faults.attempt("", _read_reveal, problem, team or 1, has_agents)
    faults.stop()
    assert loaded is not None, "or there was a fault"
    assert agents is not None, "or there was a fault"
    assert tasks is not None, "or there was a fault"
    robots = list(_place_agents(agents, loaded, team or 0, faults))
    jobs = list(_make_jobs(tasks, loaded, robots if has_agents else (), faults))
    faults.stop()
    starts: dict[Steps, Where] = {("jobs", k): tasks.locate(k) for k in range(len(jobs))}
    others = {"rules": RULES, "units": loaded.units}
    work = ReadWork(jobs=tuple(jobs), starts=starts)
    scenario = build_scenario(loaded.roadmap, robots, others, faults, work)
    faults.stop()
    assert scenario is not None, "or there was a fault"
    return Loaded(scenario=scenario, notes=tuple(list_notes(loaded, scenario)), reveal=reveal)


@dataclass(frozen=True, slots=True, kw_only=True)
class LeagueRows:
    """The rows of a file of agents or tasks.

    Attributes
    ----------
    file
        The file.
    key
        The key that names the file in the problem.
    rows
        The locations of each row.
    lines
        The line of each row, from 1.
    """

    file: Path
    key: str
    rows: Sequence[Sequence[int]]
    lines: Sequence[int]

    def locate(self, index: int) -> Location:
        """Return the place of a row."""
        return Location(file=str(self.file), line=self.lines[index]).nest(self.key)


def _find_file(problem: Source, key: str, path: Path) -> Path:
    """Return a file that the problem names, next to it or in a folder next to its folder."""
    source = problem.need(key)
    named, folder = source.read_text(), key.removesuffix("File") + "s"
    file = find_beside(path, named, folder)
    if file is None:
        message = f"{quote(named)} is neither next to the problem nor in ../{folder} (put it there)"
        raise source.make_fault(message)
    return file


def _load_map(file: Path) -> LoadedMap:
    lines = ["".join("@" if cell in BLOCKED else "." for cell in row) for row in load_map(file)]
    with name_file(str(file)):
        return LoadedMap(roadmap=make_grid_roadmap(lines), lines=tuple(lines), file=file)


def _read_rows(problem: Source, key: str, path: Path) -> LeagueRows:
    """Return the rows of a file, as many as its first number counts."""
    file = _find_file(problem, key, path)
    with locate_faults(key), name_file(str(file)):
        lines = list(enumerate(read_text(file).split("\n"), start=1))
        filled = [(line, row) for line, text in lines if (row := text.strip()) and row[0] != "#"]
        faults = Faults()
        rows = [faults.attempt(Location(line=line), _read_row, row) for line, row in filled]
        faults.stop()
        numbers = [row for row in rows if row is not None]
        if not numbers or len(numbers[0]) != 1:
            raise InputError.at("", "does not begin with a count (write how many rows follow)")
        count, at = numbers[0][0], Location(line=filled[0][0])
        if not 1 <= count <= len(numbers) - 1:
            remedy = "write how many rows follow, at least 1"
            message = f"{count} rows are counted, and {len(numbers) - 1} follow ({remedy})"
            raise InputError.at(at, message)
    numbers, used = numbers[1 : count + 1], filled[1 : count + 1]
    return LeagueRows(file=file, key=key, rows=numbers, lines=[line for line, _ in used])


def _read_row(text: str) -> list[int]:
    if not _ROW.fullmatch(text):
        remedy = "give locations, row * width + column, with commas between"
        raise InputError.at("", f"{quote(text)} is no row of locations ({remedy})")
    return list(map(int, text.split(",")))


def _read_team(problem: Source, agents: LeagueRows | None) -> int:
    source = problem.need("teamSize")
    team = source.read_whole(1, MOST_AGENTS)
    if agents is not None and team > len(agents.rows):
        message = f"{team} is more than the {len(agents.rows)} agents of {agents.file}"
        raise source.make_fault(f"{message} (give fewer)")
    return team


def _read_strategy(problem: Source) -> bool:
    """Return whether task k belongs to agent k modulo the team size."""
    version, strategy = problem.get("version"), problem.get("taskAssignmentStrategy")
    if problem.get("delayConfig", "agentCounter"):
        raise problem.make_fault("is a problem of 2026 (only those of 2023 and 2024 are read)")
    if strategy is None:
        return False
    known = STRATEGIES.get(strategy.value) if isinstance(strategy.value, str) else None
    if known is None or version is not None:
        remedy = f"give {', '.join(STRATEGIES)}, or a version and no strategy"
        raise strategy.make_fault(f"{quote(strategy.value)} does not fit ({remedy})")
    return known


def _read_reveal(problem: Source, team: int, has_agents: bool | None) -> int:
    """Return how many unfinished jobs are known: of each robot, or of all."""
    source = problem.get("numTasksReveal") or problem.make_child("numTasksReveal", 1)
    reveal = source.number() * (1 if has_agents else team)
    if reveal < 1:
        raise source.make_fault(f"{quote(source.value)} reveals no task (give 1 or more)")
    return int(reveal)


def _place_agents(
    agents: LeagueRows, loaded: LoadedMap, team: int, faults: Faults
) -> Iterator[PlacedRobot]:
    """Yield the robots at their first cells, or note why there are none."""
    for index, row in enumerate(agents.rows[:team]):
        place = agents.locate(index)
        home = faults.attempt(place, _find_vertex, row[0], loaded)
        if home is not None:
            state = RobotState(at=home, heading=Fraction(0))
            robot = Robot(name=f"A{index}", home=home, start=state)
            yield PlacedRobot(robot=robot, place=place)


def _make_jobs(
    tasks: LeagueRows, loaded: LoadedMap, robots: Sequence[PlacedRobot], faults: Faults
) -> Iterator[Job]:
    """Yield the tasks as jobs in the order of the file; with robots, dealt out in turn.

    Each robot does its tasks in this order.
    """
    lasts: dict[str | None, tuple[str, VertexId | None]] = {}  # of each agent
    for index, row in enumerate(tasks.rows):
        vertices = [
            faults.attempt(tasks.locate(index), _find_vertex, location, loaded) for location in row
        ]
        places = [vertex for vertex in vertices if vertex is not None]
        robot = robots[index % len(robots)].robot.name if robots else None
        before, at = lasts.get(robot, ("", None))
        if places:
            stops, after = tuple(_make_stops(places, at)), (before,) if before else ()
            yield Job(name=f"T{index}", stops=stops, robot=robot, after=after)
        if places and robot:
            lasts[robot] = f"T{index}", places[-1]


def _make_stops(vertices: Sequence[VertexId], before: VertexId | None) -> Iterator[JobStop]:
    """Yield the stops of a task, by the rule that an agent finishes one location in a step."""
    last = len(vertices) - 1
    for number, vertex in enumerate(vertices):
        load = (number == 0) - (number == last)
        earliest, work = Fraction(number == 0), Fraction(vertex == before)
        yield JobStop(at=vertex, load=load, earliest=earliest, work=work)
        before = vertex


def _find_vertex(location: int, loaded: LoadedMap) -> VertexId:
    """Return the vertex of a location, or raise why it is none."""
    grid = loaded.roadmap.grid
    assert grid is not None, "the map has rows"
    if location < len(grid.vertex_at) and grid.vertex_at[location] >= 0:
        return VertexId(int(grid.vertex_at[location]))
    row, column = divmod(location, grid.columns)
    return loaded.find([row, column])
