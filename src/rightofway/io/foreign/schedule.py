"""YAML schedules of multi_agent_path_planning (atb033) and libMultiRobotPlanning.

::

    schedule:
      agent0:
        - {x: 0, y: 0, t: 0}
        - {x: 1, y: 0, t: 1}

x is the column and y the row. An agent stays where it is until its next time.
"""

from __future__ import annotations

import re

import numpy as np

from rightofway.errors import is_printable, quote
from rightofway.io.faults import Faults
from rightofway.io.foreign.trajectories import (
    MAX_STEP,
    Cell,
    ForeignPlan,
    Trajectory,
    Visits,
    make_cells,
    make_visits,
)
from rightofway.io.json_text import format_json_line
from rightofway.io.source import Source
from rightofway.io.yaml_text import parse_yaml
from rightofway.model import Plan


def recognizes(text: str) -> bool:
    """Return whether a text has a schedule."""
    return re.search(r"^schedule:", text, re.MULTILINE) is not None


def read(text: str) -> ForeignPlan:
    """Return the plan of a text.

    Raises
    ------
    InputError
        For agents without a list of {x, y, t}, and times out of order.
    """
    schedule = Source(parse_yaml(text)).need("schedule")
    if not schedule.read_mapping():
        raise schedule.make_fault("has no agent (give each agent a list of {x, y, t})")
    faults, agents = Faults(), list[Trajectory]()
    for key, states in schedule.read_entries():
        name = str(key)
        visits = faults.attempt("", _read_visits, name, states)
        if visits:
            cells, steps = visits
            agents.append(Trajectory(name=name, cells=cells, steps=steps, location=states.location))
    faults.stop()
    return ForeignPlan(agents=agents)


def _read_visits(name: str, states: Source) -> Visits:
    if not is_printable(name):
        raise states.make_fault(f"{quote(name)} is no name (give characters that can be printed)")
    faults, cells, steps = Faults(), list[Cell](), list[int]()
    latest = -1
    for state in states.read_items():
        numbers = faults.attempt("", _read_numbers, state)
        if numbers is None:
            continue
        x, y, t = numbers
        if t <= latest or (latest < 0 < t):
            remedy = "begin with t 0, and let t grow"
            faults.note(state.location, f"t {t} stands after {max(latest, 0)} ({remedy})")
        latest = t
        cells.append((y, x))
        steps.append(t)
    faults.stop()
    if not cells:
        raise states.make_fault("is empty (give a list of {x, y, t})")
    own, visits = make_visits(cells)
    return own, np.array(steps, np.int64)[visits]


def _read_numbers(state: Source) -> list[int]:
    """Return x, y and t of a state."""
    return [state.need(key).read_whole(0, MAX_STEP) for key in "xyt"]


def write(plan: Plan) -> str:
    """Return the text of a plan: a state for each tick, until the robot is at its last vertex.

    Raises
    ------
    InputError
        If the roadmap is no grid.
    """
    cells_at = make_cells(plan)
    lines = ["schedule:"]
    for robot, (name, track) in enumerate(zip(cells_at.names, plan.tracks, strict=True)):
        lines.append(f"  {format_json_line(name)}:")
        for t, (row, column) in enumerate(
            list(cells_at.list_cells(robot))[: int(track.enter[-1]) + 1]
        ):
            lines.append(f"    - {{x: {column}, y: {row}, t: {t}}}")
    return "\n".join(lines) + "\n"
