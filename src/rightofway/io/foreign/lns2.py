"""Paths of MAPF-LNS2, EECBS and CBSH2-RTC: for each agent its cells, step by step.

::

    Agent 0: (0,0)->(0,1)->(1,1)->
    Agent 1: (2,2)->(2,1)->

A cell is (row, column). An agent stays at its last cell.
"""

from __future__ import annotations

import re

from rightofway.errors import InputError, shown
from rightofway.io.faults import Faults
from rightofway.io.foreign.trajectories import (
    Cell,
    ForeignPlan,
    Trajectory,
    cells_of_plan,
    visits_of,
)
from rightofway.model import Plan

_AGENT = re.compile(r"Agent([0-9]{1,9}):(.*)")
_CELL = re.compile(r"\(([0-9]{1,9}),([0-9]{1,9})\)(?:->)?")


def recognizes(text: str) -> bool:
    """Return whether a text has a line of cells for an agent."""
    return re.search(r"^[ \t]*Agent[ \t]+[0-9]+[ \t]*:", text, re.MULTILINE) is not None


def read(text: str) -> ForeignPlan:
    """Return the plan of a text.

    Raises
    ------
    InputError
        For lines that are no path, and agents that are missing or given twice.
    """
    paths: dict[int, tuple[int, list[Cell]]] = {}
    faults = Faults()
    for number, line in enumerate(text.split("\n"), start=1):
        bare = "".join(line.split())
        match = _AGENT.fullmatch(bare)
        if not match:
            if bare:
                message = f"{shown(line.strip())} is no path (write Agent 0: (row,column)->…)"
                faults.note(f"line {number}", message)
            continue
        agent = int(match[1])
        if agent in paths:
            message = f"agent {agent} has a path in line {paths[agent][0]} already (take one out)"
            faults.note(f"line {number}", message)
        paths[agent] = number, faults.attempt(f"line {number}", _cells, match[2]) or []
    missing = next((number for number in range(len(paths)) if number not in paths), None)
    if missing is not None:
        faults.note("", f"agent {missing} has no path (give one for each agent, from 0 on)")
    faults.stop()
    agents = [
        Trajectory(name=f"A{agent}", visits=visits_of(iter(cells)), place=f"line {line}")
        for agent, (line, cells) in sorted(paths.items())
    ]
    return ForeignPlan(agents=agents)


def _cells(text: str) -> list[Cell]:
    rest = _CELL.sub("", text)
    if rest:
        raise InputError.at("", f"{shown(rest)} is no cell (write (row,column)->(row,column)->…)")
    if not text:
        raise InputError.at("", "the path is empty (give at least the first cell)")
    return [(int(row), int(column)) for row, column in _CELL.findall(text)]


def write(plan: Plan) -> str:
    """Return the text of a plan; each path ends when the robot is at its last vertex.

    Raises
    ------
    InputError
        If the roadmap is no grid.
    """
    found = cells_of_plan(plan)
    lines = []
    for robot, track in enumerate(plan.tracks):
        cells = list(found.path(robot))[: int(track.enter[-1]) + 1]
        path = "".join(f"({row},{column})->" for row, column in cells)
        lines.append(f"Agent {robot}: {path}")
    return "\n".join(lines) + "\n"
