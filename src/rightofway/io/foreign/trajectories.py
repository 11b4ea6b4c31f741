"""Common parts of plans of other programs: agents on the cells of a grid, step by step.

Read as a `Plan`, an agent is a robot of unit speed under the classic rules: a move takes one time
unit, turns take none, there is no way back. Its home is its first cell. Its stops are the goals and
tasks that the file names; without any, its last cell. With a ``.scen`` file, name, home and target
are those of the agent's row, so that the plan is one of the very scenario that the file is.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import FEW, InputError, InputFault, Location, Steps, Where, quote
from rightofway.io.faults import Faults
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.movingai import ScenRow, find_beside, load_map, load_scen
from rightofway.io.scenario.reader import read_scenario
from rightofway.model import Plan, PlannerRun, Scenario, Track
from rightofway.site import Grid
from rightofway.site.grid import FREE

Cell = tuple[int, int]
"""Row and column, from 0."""

Visits = tuple[NDArray[np.int64], NDArray[np.int64]]
"""Cells, shape (n, 2), and for each the step at which an agent enters it, shape (n,)."""

MAX_STEP = 100_000_000
"""The last step of a plan at most."""

MAX_CELLS = 50_000_000
"""Robots times ticks of a plan that is written cell by cell, at most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trajectory:
    """The cells of one agent over time.

    Attributes
    ----------
    name
        Its name.
    cells
        Where it is, visit by visit: row and column; int64, shape (n, 2). It stays at the last cell.
    steps
        When each visit begins; int64, shape (n,).
    location
        Where the agent stands in the file.
    lines
        Where each of its steps stands in the file, if each has a line of its own.
    stops
        Goals and tasks in the order in which they are done, the last one at the end.
    """

    name: str
    cells: NDArray[np.int64]
    steps: NDArray[np.int64]
    location: Location = Location()  # noqa: RUF009 (it cannot change)
    lines: Sequence[int] = ()
    stops: Sequence[Cell] = ()

    def find_location(self, step: int) -> Location:
        """Return where a step stands in the file."""
        return Location(line=self.lines[step]) if self.lines else self.location


@dataclass(frozen=True, slots=True, kw_only=True)
class ForeignPlan:
    """A plan of another program, as it stands in its file.

    Attributes
    ----------
    agents
        One trajectory for each agent.
    map_name
        The name of the map's file, where the plan says it.
    steps_per_move
        Steps that a move to the next cell takes.
    """

    agents: Sequence[Trajectory]
    map_name: str | None = None
    steps_per_move: int = 1


def make_visits(cells: Sequence[Cell] | NDArray[np.int64]) -> Visits:
    """Return the visits of an agent that is at these cells, step by step."""
    given = np.array(cells, np.int64).reshape(-1, 2)
    moves = np.flatnonzero((np.diff(given, axis=0) != 0).any(axis=1)) + 1
    steps = np.concatenate(([0], moves))
    return given[steps], steps


def plan_of_trajectories(
    foreign: ForeignPlan, path: Path, map_file: Path | None = None, scen: Path | None = None
) -> Plan:
    """Return a plan of another program as one of ours.

    Raises
    ------
    InputError
        If the map is not found, or an agent leaves it.
    """
    rows = load_scen(scen) if scen else ()
    if rows and len(rows) < len(foreign.agents):
        message = f"{len(rows)} rows for {len(foreign.agents)} agents (give the plan's own .scen)"
        raise InputError.at("", message, str(scen))
    named = rows[0].map_name if rows else foreign.map_name
    # The League of Robot Runners has free cells E, and S as we do.
    lines = load_map(map_file or _map_beside(scen or path, named))
    lines = tuple(line.replace("E", ".") for line in lines)
    _refuse_walls(foreign, lines)
    scenario = _make_scenario(foreign, lines, rows)
    ticks = 1 / (scenario.problem.clock.tick * foreign.steps_per_move)  # that a step lasts
    grid = scenario.roadmap.grid
    assert grid is not None, "the map has rows"
    tracks = tuple(_track(agent, grid, ticks) for agent in foreign.agents)
    return Plan(scenario=scenario, tracks=tracks, run=PlannerRun())


def _map_beside(path: Path, named: str | None) -> Path:
    if not named:
        raise InputError.at("", "the plan does not name its map (give it with --map FILE)")
    file = find_beside(path, named, "maps")
    if file is None:
        message = f"its map {quote(named)} is not beside it (give it with --map FILE)"
        raise InputError.at("", message)
    return file


def _make_scenario(foreign: ForeignPlan, lines: Sequence[str], rows: Sequence[ScenRow]) -> Scenario:
    """Return the problem: the agents' own homes and stops, or those of a .scen file."""
    robots = []
    for number, agent in enumerate(foreign.agents):
        home, *_, last = agent.cells[[0, -1]].tolist()
        stops: Sequence[Sequence[int]] = agent.stops or [last]
        name = agent.name
        if rows:
            name = f"R{number + 1}"  # as in the scenario of the .scen file
            home, stops = list(rows[number].start), [rows[number].goal]
        robots.append({"name": name, "home": home, "stops": [{"at": list(at)} for at in stops]})
    moves = foreign.steps_per_move
    if any((agent.steps % moves).any() for agent in foreign.agents):
        # Agents move at steps between those of whole moves. The clock of a scenario follows from
        # its durations; work of one step makes it fine enough.
        robots[0]["stops"][-1]["work"] = f"1/{moves}"
    document = {
        "format": SCENARIO_FORMAT,
        "map": {"grid": list(lines)},
        "robots": robots,
        "rules": "classic",
    }
    try:
        return read_scenario(document, None).scenario
    except InputError as error:
        raise InputError(_name_agent(fault, foreign) for fault in error.faults) from None


def _name_agent(fault: InputFault, foreign: ForeignPlan) -> InputFault:
    """Return a fault of a robot at the line of its agent."""
    starts: dict[Steps, Where] = {
        ("robots", index): replace(where, path=(*where.path, agent.name))
        for index, agent in enumerate(foreign.agents)
        for where in [agent.find_location(0)]
    }
    return fault.relocate(starts)


def _refuse_walls(foreign: ForeignPlan, lines: Sequence[str]) -> None:
    """Report the first step of an agent at which it is in a wall or outside the map.

    On the map of another plan nearly all agents leave it: a few of them are enough.
    """
    free = np.array([[character in FREE for character in line] for line in lines])
    faults, wrong = Faults(), 0
    for agent in foreign.agents:
        inside: NDArray[np.bool_] = np.all((agent.cells >= 0) & (agent.cells < free.shape), axis=1)
        good = inside.copy()
        good[inside] = free[tuple(agent.cells[inside].T)]
        if good.all():
            continue
        wrong += 1
        if wrong <= FEW:
            first = int(np.argmin(good))
            (row, column), step = agent.cells[first].tolist(), int(agent.steps[first])
            where = "is blocked"
            if not inside[first]:
                where = f"is outside {free.shape[0]} rows and {free.shape[1]} columns"
            entered = f"{agent.name} enters [{row}, {column}] at step {step}"
            faults.note(agent.find_location(step), f"{entered}, which {where} (give its own map)")
    if wrong > FEW:
        faults.note("", f"{wrong - FEW} more agents leave the map (give the map of this plan)")
    faults.stop()


def _track(agent: Trajectory, grid: Grid, ticks: Fraction) -> Track:
    """Return the track of an agent; a step lasts for some ticks, or all steps are whole moves."""
    rows, columns = agent.cells.T
    vertices = grid.vertex_at[rows * grid.columns + columns]
    enter = agent.steps * ticks.numerator // ticks.denominator
    return Track(vertices=vertices.astype(np.int32), enter=enter)


@dataclass(frozen=True, slots=True, kw_only=True)
class CellsOfPlan:
    """A plan as other programs see it: a cell for each robot at each tick.

    Attributes
    ----------
    names
        The robots.
    rows, columns
        Where each robot is; int32, shape (R, T + 1).
    goals
        The last stop of each robot.
    """

    names: Sequence[str]
    rows: NDArray[np.int32]
    columns: NDArray[np.int32]
    goals: Sequence[Cell]

    def list_cells(self, robot: int) -> Iterator[Cell]:
        """Return the cells of a robot, tick by tick."""
        rows, columns = self.rows[robot].tolist(), self.columns[robot].tolist()
        return zip(rows, columns, strict=True)


def require_grid(plan: Plan) -> Grid:
    """Return the grid of a plan that is written cell by cell.

    Raises
    ------
    InputError
        If the roadmap is no grid, or the plan has too many ticks for a list of cells.
    """
    grid = plan.scenario.roadmap.grid
    if grid is None:
        message = "the roadmap is no grid, this format holds nothing else (choose another format)"
        raise InputError.at("map", message)
    last = max(int(track.enter[-1]) for track in plan.tracks)
    if last * len(plan.tracks) > MAX_CELLS:
        message = f"{last} ticks for {len(plan.tracks)} robots are too many for a list of cells"
        raise InputError.at("robots", f"{message} (write .json)")
    return grid


def make_cells(plan: Plan) -> CellsOfPlan:
    """Return the cells of a plan on a grid, for the writers of other programs' files.

    Raises
    ------
    InputError
        If the roadmap is no grid, or the plan has too many ticks for a list of cells.
    """
    grid = require_grid(plan)
    ticks = np.arange(max(int(track.enter[-1]) for track in plan.tracks) + 1)
    cells = np.stack(
        [
            grid.cells[track.vertices[np.searchsorted(track.enter, ticks, side="right") - 1]]
            for track in plan.tracks
        ]
    )
    return CellsOfPlan(
        names=[robot.name for robot in plan.scenario.robots],
        rows=cells // grid.columns,
        columns=cells % grid.columns,
        goals=[
            grid.get_cell(itinerary.stages[-1].vertex)
            for itinerary in plan.scenario.problem.itineraries
        ],
    )
