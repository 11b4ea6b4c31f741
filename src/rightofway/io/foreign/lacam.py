"""Text of lacam, lacam3, pypibt and mapf-visualizer: for each step the cells of all agents.

::

    map_file=random-32-32-10.map
    goals=(3,1),(0,2),
    solution=
    0:(0,0),(2,2),
    1:(1,0),(2,2),

A cell is (x, y): column and row. A third word, as in ``(0,0,X_PLUS)``, is a heading: a turn is a
wait. The lines above ``solution=`` may be left out; of these, ``map_file`` and ``goals`` are used.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np

from rightofway.errors import InputError, Location, quote
from rightofway.io.faults import Faults
from rightofway.io.foreign.trajectories import (
    Cell,
    ForeignPlan,
    Trajectory,
    make_cells,
    make_visits,
)
from rightofway.model import Plan

_STEP = re.compile(r"([0-9]{1,9}):(\(.*)")
_CELL = re.compile(r"\(([0-9]{1,9}),([0-9]{1,9})(?:,\w{1,20})?\),?")


def recognizes(text: str) -> bool:
    """Return whether a text has a line of cells for a step."""
    return re.search(r"^[ \t]*[0-9]+[ \t]*:[ \t]*\(", text, re.MULTILINE) is not None


def read(text: str) -> ForeignPlan:
    """Return the plan of a text.

    Raises
    ------
    InputError
        For lines without cells, agents that come and go, and steps out of order.
    """
    header: dict[str, str] = {}
    steps: list[list[Cell] | None] = []
    lines: list[int] = []
    faults = Faults()
    for number, line in enumerate(text.split("\n"), start=1):
        bare = "".join(line.split())
        key, sign, value = bare.partition("=")
        match = _STEP.fullmatch(bare)
        if match:
            if int(match[1]) != len(steps):
                message = f"step {match[1]} stands where step {len(steps)} is expected"
                faults.note(Location(line=number), f"{message} (give every step once, in order)")
            steps.append(faults.attempt(Location(line=number), _read_cells, match[2]))
            lines.append(number)
        elif sign and not steps:
            header[key] = value
        elif bare:
            message = f"{quote(line.strip())} is no step (write 0:(x,y),(x,y), …)"
            faults.note(Location(line=number), message)
    _check_counts(steps, lines, faults)
    faults.stop()
    goals = _read_cells(header["goals"]) if header.get("goals") else []
    if goals and len(goals) != len(steps[0] or ()):
        message = f"{len(goals)} for {len(steps[0] or ())} agents (give one for each)"
        raise InputError.at("goals", message)
    agents = []
    for index, cells in enumerate(np.array(steps, np.int64).swapaxes(0, 1)):
        own, entered = make_visits(cells)
        goal = goals[index : index + 1]
        agents.append(
            Trajectory(name=f"A{index}", cells=own, steps=entered, lines=lines, stops=goal)
        )
    return ForeignPlan(agents=agents, map_name=header.get("map_file"))


def _read_cells(text: str) -> list[Cell]:
    rest = _CELL.sub("", text)
    if rest:
        raise InputError.at("", f"{quote(rest)} is no cell (write cells as (x,y), with commas)")
    return [(int(y), int(x)) for x, y in _CELL.findall(text)]


def _check_counts(steps: list[list[Cell] | None], lines: list[int], faults: Faults) -> None:
    expected = next((len(cells) for cells in steps if cells), 0)
    for cells, line in zip(steps, lines, strict=True):
        if cells is not None and len(cells) != expected:
            message = f"{len(cells)} agents, the first step has {expected} (give all at each step)"
            faults.note(Location(line=line), message)


def write(plan: Plan) -> str:
    """Return the text of a plan: one step for each tick.

    Raises
    ------
    InputError
        If the roadmap is no grid.
    """
    cells = make_cells(plan)
    starts = list(zip(cells.rows[:, 0].tolist(), cells.columns[:, 0].tolist(), strict=True))
    lines = [
        f"agents={len(cells.names)}",
        f"starts={_write_cells(starts)}",
        f"goals={_write_cells(cells.goals)}",
    ]
    lines.append("solution=")
    for step, (rows, columns) in enumerate(
        zip(cells.rows.T.tolist(), cells.columns.T.tolist(), strict=True)
    ):
        lines.append(f"{step}:{_write_cells(zip(rows, columns, strict=True))}")
    return "\n".join(lines) + "\n"


def _write_cells(cells: Iterable[Cell]) -> str:
    return "".join(f"({column},{row})," for row, column in cells)
