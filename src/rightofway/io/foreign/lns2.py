"""Paths of MAPF-LNS2, EECBS and CBSH2-RTC: for each agent its cells, step by step.

::

    Agent 0: (0,0)->(0,1)->(1,1)->
    Agent 1: (2,2)->(2,1)->

A cell is (row, column). An agent stays at its last cell. A third number is a heading, 0 to 3, which
is not read, or where any is larger the step at which the agent enters the cell.
"""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np

from rightofway.errors import InputError, Location, quote
from rightofway.io.faults import Faults
from rightofway.io.foreign.trajectories import (
    ForeignPlan,
    Trajectory,
    Visits,
    make_cells,
    make_visits,
)
from rightofway.model import Plan

_AGENT = re.compile(r"Agent([0-9]{1,9}):(.*)")
_CELL = re.compile(r"\(([0-9]{1,9}),([0-9]{1,9})(?:,([0-9]{1,9}))?\)(?:->)?")

LARGEST_HEADING = 3


def recognizes(text: str) -> bool:
    """Return whether a text has a line of cells for an agent."""
    return re.search(r"^[ \t]*Agent[ \t]+[0-9]+[ \t]*:", text, re.MULTILINE) is not None


def read(text: str) -> ForeignPlan:
    """Return the plan of a text.

    Raises
    ------
    InputError
        For lines without a path, and agents that are missing or given twice.
    """
    paths: dict[int, tuple[int, Visits | None]] = {}
    faults = Faults()
    for number, line in enumerate(text.split("\n"), start=1):
        bare = "".join(line.split())
        match = _AGENT.fullmatch(bare)
        if not match:
            if bare:
                message = f"{quote(line.strip())} is no path (write Agent 0: (row,column)->…)"
                faults.note(Location(line=number), message)
            continue
        agent = int(match[1])
        if agent in paths:
            message = f"agent {agent} has a path in {{other}} already (take one out)"
            faults.note(Location(line=number), message, Location(line=paths[agent][0]))
        paths[agent] = number, faults.attempt(Location(line=number), _read_visits, match[2])
    missing = next((number for number in range(len(paths)) if number not in paths), None)
    if missing is not None:
        faults.note("", f"agent {missing} has no path (give one for each agent, from 0 on)")
    faults.stop()
    agents = [
        Trajectory(name=f"A{agent}", cells=visits[0], steps=visits[1], location=Location(line=line))
        for agent, (line, visits) in sorted(paths.items())
        if visits
    ]
    return ForeignPlan(agents=agents)


def _read_visits(text: str) -> Visits:
    rest = _CELL.sub("", text)
    if rest:
        raise InputError.at("", f"{quote(rest)} is no cell (write (row,column)->(row,column)->…)")
    if not text:
        raise InputError.at("", "the path is empty (give at least the first cell)")
    groups = _CELL.findall(text)
    cells = [(int(row), int(column)) for row, column, _ in groups]
    steps = [int(third) for _, _, third in groups if third]
    if max(steps, default=0) <= LARGEST_HEADING:
        return make_visits(cells)
    if len(steps) < len(cells) or steps[0] or not all(a < b for a, b in pairwise(steps)):
        raise InputError.at("", "the steps of the cells do not grow from 0 on (give all or none)")
    own, visits = make_visits(cells)
    return own, np.array(steps, np.int64)[visits]


def write(plan: Plan) -> str:
    """Return the text of a plan; each path ends when the robot is at its last vertex.

    Raises
    ------
    InputError
        If the roadmap is no grid.
    """
    drawn = make_cells(plan)
    lines = []
    for robot, track in enumerate(plan.tracks):
        cells = list(drawn.list_cells(robot))[: int(track.enter[-1]) + 1]
        path = "".join(f"({row},{column})->" for row, column in cells)
        lines.append(f"Agent {robot}: {path}")
    return "\n".join(lines) + "\n"
