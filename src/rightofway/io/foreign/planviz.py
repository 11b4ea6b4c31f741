"""JSON of PlanViz and the League of Robot Runners, rounds 2023, 2024 and 2026.

``actualPaths`` has the actions of each agent, one for each step: ``"F,R,W"``. Since 2026 a move or
turn takes ``agentMaxCounter`` steps, and runs of actions are counted:
``[(0,14,55,0,0):(F 20,R 10)][(30,…):(W 5)]``; of the words in front, the first step of the part is
read. In the action model ``MAPF_T`` agents have headings: F drives forward, R and C turn clockwise
and back, W waits. In ``MAPF``, L and R change the column and U and D the row: U adds 1 for PlanViz
today and took 1 away in earlier files. That way is read in which more agents are at their errands.

Our robots turn in no time, so a turn becomes a wait. An agent is at its cell until a move is
complete. Its stops are the errands that it finishes, in order, and its last cell.
"""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rightofway.errors import InputError, shown
from rightofway.io.faults import Faults
from rightofway.io.foreign.trajectories import (
    MAX_STEP,
    Cell,
    ForeignPlan,
    Trajectory,
    Visit,
    cells_of_plan,
)
from rightofway.io.text import parse_json
from rightofway.model import Plan
from rightofway.model.route import drives_along, serving_visits

HEADINGS = {"E": (0, 1), "N": (-1, 0), "W": (0, -1), "S": (1, 0)}
"""Change of row and column, in the order of turns back (counterclockwise)."""

MOVES = {"U": (1, 0), "D": (-1, 0), "L": (0, -1), "R": (0, 1)}
"""Change of row and column of the action model MAPF, as PlanViz draws them today."""

WAITS = ("W", "T")
"""Actions of an agent that stays where it is; T where its planner was late."""

MAX_COORDINATE = 100_000
"""Rows and columns of an agent are below this."""

MAX_VISITS = 5_000_000
"""Visits of all agents at most."""

_PART = re.compile(r"\[\(([0-9]{1,9})(?:,-?[0-9]{1,9}){4}\):\(([^()\[\]]*)\)\]")
_RUN = re.compile(r"([A-Z])([0-9]{1,9})")

Run = tuple[str, int]
"""An action, and for how many steps."""


def recognizes(text: str) -> bool:
    """Return whether a text is JSON with the actions of agents."""
    is_ours = '"rightofway-' in text[:200]
    return text.lstrip().startswith("{") and '"actualPaths"' in text and not is_ours


def read(text: str) -> ForeignPlan:
    """Return the plan of a text.

    Raises
    ------
    InputError
        For agents without a start, unknown actions, and tasks that do not exist.
    """
    log = parse_json(text)
    faults = Faults()
    turns = faults.attempt("actionModel", _has_headings, log.get("actionModel", "MAPF_T"))
    counter = faults.attempt("agentMaxCounter", _count, log.get("agentMaxCounter", 1)) or 1
    paths, starts = log["actualPaths"], log.get("start")
    if not isinstance(paths, list) or not paths:
        raise InputError.at("actualPaths", f"{shown(paths)} is no list of paths (one an agent)")
    if not isinstance(starts, list) or len(starts) < len(paths):
        raise InputError.at("start", f"does not have a start for each of {len(paths)} agents")
    counts = any(isinstance(path, str) and path.lstrip().startswith("[") for path in paths)
    steps_per_move = counter if counts else 1
    errands = faults.attempt("", _errands, log) or {}
    ways = [HEADINGS] if turns else [MOVES, {**MOVES, "U": MOVES["D"], "D": MOVES["U"]}]
    read = [_drives(paths, starts, way, steps_per_move, faults) for way in ways]
    faults.stop()
    drives = max(read, key=lambda drives: _hits(drives, errands))
    agents = []
    for index, drive in enumerate(drives):
        last = drive.visits[-1][0]
        stops = [cell for _, cell in errands.get(index, [])]
        if stops[-1:] != [last]:
            stops.append(last)
        place = f"actualPaths[{index}]"
        agents.append(Trajectory(name=f"A{index}", visits=drive.visits, place=place, stops=stops))
    return ForeignPlan(agents=agents, steps_per_move=steps_per_move)


def _drives(
    paths: list[Any],
    starts: list[Any],
    changes: Mapping[str, Cell],
    steps_per_move: int,
    faults: Faults,
) -> list[_Drive]:
    """Return each agent at the end of its path, or fewer after noting faults."""
    drives, n_visits = list[_Drive](), 0
    for index, (path, start) in enumerate(zip(paths, starts, strict=False)):
        place = f"actualPaths[{index}]"
        drive = faults.attempt(f"start[{index}]", _started, start, changes, steps_per_move)
        if drive is None:
            continue
        faults.attempt(place, drive.follow, path)
        drives.append(drive)
        n_visits += len(drive.visits)
        if n_visits > MAX_VISITS:
            raise InputError.at(place, f"more than {MAX_VISITS} moves (read a part of the plan)")
    return drives


def _hits(drives: Sequence[_Drive], errands: Mapping[int, Sequence[tuple[int, Cell]]]) -> int:
    """Return at how many of their errands the agents are when they finish them."""
    hits = 0
    for index, drive in enumerate(drives):
        steps = [step for _, step in drive.visits]
        for step, cell in errands.get(index, ()):
            hits += drive.visits[bisect_right(steps, max(step, 0)) - 1][0] == cell
    return hits


def _has_headings(model: Any) -> bool:
    if model not in {"MAPF", "MAPF_T"}:
        raise InputError.at("", f"{shown(model)} is not known (give MAPF or MAPF_T)")
    return bool(model == "MAPF_T")


def _count(value: Any) -> int:
    if type(value) is not int or not 1 <= value <= 1000:  # noqa: PLR2004 (our finest clock)
        raise InputError.at("", f"{shown(value)} is no count of steps (give 1 to 1000)")
    return value


@dataclass(slots=True, kw_only=True)
class _Drive:
    """An agent that follows its actions."""

    visits: list[Visit]
    changes: Mapping[str, Cell]  # of row and column, by action or heading
    heading: str | None  # None where agents have none
    steps_per_move: int
    step: int = 0
    done: int = 0  # steps of the move or turn that is under way
    under_way: str = field(default="")

    def follow(self, path: Any) -> None:
        """Take the actions of a path one by one."""
        for action, steps in _runs(path):
            self.act(action, steps)

    def act(self, action: str, steps: int) -> None:
        known = [*("FRC" if self.heading else "UDLR"), *WAITS]
        if action not in known:
            message = f"{shown(action)} is no action (give one of {', '.join(known)})"
            raise InputError.at(f"step {self.step}", message)
        begin, self.step = self.step, self.step + steps
        if self.step > MAX_STEP:
            message = f"{action} lasts for {steps} steps (give at most {MAX_STEP} in all)"
            raise InputError.at(f"step {begin}", message)
        if action in WAITS:
            return
        if self.done and action != self.under_way:
            message = f"{action} begins after {self.done} of {self.steps_per_move} steps of"
            raise InputError.at(f"step {begin}", f"{message} {self.under_way} (finish that first)")
        self.under_way = action
        times, rest = divmod(self.done + steps, self.steps_per_move)
        if times > MAX_COORDINATE:
            raise InputError.at(f"step {begin}", f"{action} for {times} cells leaves any map")
        first = begin - self.done + self.steps_per_move
        for time in range(first, first + times * self.steps_per_move, self.steps_per_move):
            self._complete(action, time)
        self.done = rest

    def _complete(self, action: str, step: int) -> None:
        if self.heading and action != "F":
            turned = list(HEADINGS).index(self.heading) + (1 if action == "C" else -1)
            self.heading = list(HEADINGS)[turned % 4]
            return
        (row, column), _ = self.visits[-1]
        down, right = self.changes[self.heading or action]
        self.visits.append(((row + down, column + right), step))


def _started(start: Any, changes: Mapping[str, Cell], steps_per_move: int) -> _Drive:
    if not isinstance(start, list) or len(start) not in {2, 3}:
        raise InputError.at("", f"{shown(start)} is no start (give [row, column, heading])")
    heading = start[2] if len(start) > 2 else "E"  # noqa: PLR2004
    turns = changes is HEADINGS
    if turns and heading not in HEADINGS:
        raise InputError.at("", f"{shown(heading)} is no heading (give E, N, W or S)")
    cell = _cell(start[0], start[1])
    return _Drive(
        visits=[(cell, 0)],
        changes=changes,
        heading=heading if turns else None,
        steps_per_move=steps_per_move,
    )


def _cell(row: Any, column: Any) -> Cell:
    for number in (row, column):
        if type(number) is not int or not 0 <= number < MAX_COORDINATE:
            message = f"{shown(number)} is no row or column (give whole numbers from 0 on)"
            raise InputError.at("", message)
    return row, column


def _runs(path: Any) -> Iterator[Run]:
    if not isinstance(path, str):
        raise InputError.at("", f'{shown(path)} is no path (give actions like "F,R,W")')
    bare = "".join(path.split())
    if not bare.startswith("["):
        yield from ((action, 1) for action in bare.split(",") if action)
        return
    rest = _PART.sub("", bare)
    if rest:
        message = f"{shown(rest)} is no part (write [(step,row,column,heading,counter):(F 10,W 5)])"
        raise InputError.at("", message)
    step = 0
    for first, actions in _PART.findall(bare):
        if int(first) != step:
            message = f"a part begins with step {first}, the part before it ends with step {step}"
            raise InputError.at("", f"{message} (let the parts follow each other)")
        for run in filter(None, actions.split(",")):
            match = _RUN.fullmatch(run)
            if not match:
                message = f"{shown(run)} is no run of actions (write F 10)"
                raise InputError.at(f"step {step}", message)
            yield match[1], int(match[2])
            step += int(match[2])


def _errands(log: dict[str, Any]) -> dict[int, list[tuple[int, Cell]]]:
    """Return the errands that each agent finishes, in order, with their steps."""
    events, tasks = log.get("events", []), log.get("tasks", [])
    for key, value in (("events", events), ("tasks", tasks)):
        if not isinstance(value, list):
            raise InputError.at(key, f"{shown(value)} is no list (leave it out, or give a list)")
    faults, places = Faults(), dict[tuple[int, int], Cell]()
    for index, task in enumerate(tasks):
        for number, cell in enumerate(faults.attempt(f"tasks[{index}]", _cells_of, task) or ()):
            places[task[0], number] = cell
    finished: list[tuple[int, int, tuple[int, int]]] = []  # step, agent, (task, number of errand)
    for index, event in enumerate(events):
        for row in faults.attempt(f"events[{index}]", _finished, event, index) or ():
            if row[2] in places:
                finished.append(row)
            else:
                message = f"task {row[2][0]} has no errand {row[2][1] + 1} (give it in tasks)"
                faults.note(f"events[{index}]", message)
    faults.stop()
    errands: dict[int, list[tuple[int, Cell]]] = {}
    for step, agent, errand in sorted(finished):
        errands.setdefault(agent, []).append((step, places[errand]))
    return errands


def _cells_of(task: Any) -> list[Cell]:
    """Return the places of a task: [id, row, column], or [id, released, [row, column, …]]."""
    if isinstance(task, list) and len(task) == 3 and type(task[0]) is int:  # noqa: PLR2004
        numbers = task[2] if isinstance(task[2], list) else task[1:]
        if len(numbers) % 2 == 0:
            return [_cell(*pair) for pair in zip(numbers[::2], numbers[1::2], strict=True)]
    raise InputError.at("", f"{shown(task)} is no task (give [id, step, [row, column, …]])")


def _finished(event: Any, agent: int) -> Iterator[tuple[int, int, tuple[int, int]]]:
    """Yield the errands that an event reports as finished.

    In 2023 there is a list of [task, step, "finished"] for each agent; later, events are
    [step, agent, task, errands finished], none of which are finished when the task is assigned.
    """
    if isinstance(event, list) and event and type(event[0]) is int:
        if len(event) != 4 or not all(type(number) is int for number in event):  # noqa: PLR2004
            message = f"{shown(event)} is no event (give [step, agent, task, errands finished])"
            raise InputError.at("", message)
        step, agent, task, count = event
        if count > 0:
            yield step, agent, (task, count - 1)
        return
    for each in event if isinstance(event, list) else [event]:
        is_event = isinstance(each, list) and len(each) == 3  # noqa: PLR2004
        if not (is_event and type(each[0]) is type(each[1]) is int):
            message = f'{shown(each)} is no event (give [task, step, "finished"])'
            raise InputError.at("", message)
        if each[2] == "finished":
            yield each[1], agent, (each[0], 0)


def write(plan: Plan) -> str:
    """Return the text of a plan: actions without headings, as of the round of 2023.

    Each stop is a task, finished when the robot has worked there.

    Raises
    ------
    InputError
        If the roadmap is no grid.
    """
    found = cells_of_plan(plan)
    names = {move: action for action, move in MOVES.items()} | {(0, 0): "W"}
    steps = zip(np.diff(found.rows).tolist(), np.diff(found.columns).tolist(), strict=True)
    paths = [",".join(names.get(move, "W") for move in zip(*each, strict=True)) for each in steps]
    tasks, events = list[list[int]](), list[list[list[int | str]]]()
    grid = plan.scenario.roadmap.grid
    assert grid is not None, "cells were found"
    for robot, itinerary in enumerate(plan.scenario.problem.itineraries):
        own: list[list[int | str]] = []
        assigned = 0
        for stage, finished in zip(itinerary.stages, _served(plan, robot), strict=False):
            own += [[len(tasks), assigned, "assigned"], [len(tasks), finished, "finished"]]
            tasks.append([len(tasks), *grid.cell(stage.vertex)])
            assigned = finished
        events.append(own)
    document = {
        "actionModel": "MAPF",
        "AllValid": "Yes",
        "teamSize": len(paths),
        "start": [[*next(found.path(robot)), "N/A"] for robot in range(len(paths))],
        "numTaskFinished": len(tasks),
        "sumOfCost": sum(int(track.enter[-1]) for track in plan.tracks),
        "makespan": max(int(track.enter[-1]) for track in plan.tracks),
        "actualPaths": paths,
        "plannerPaths": paths,
        "plannerTimes": [],
        "errors": [],
        "events": events,
        "tasks": tasks,
    }
    return json.dumps(document) + "\n"


def _served(plan: Plan, robot: int) -> Sequence[int]:
    """Return when each stop of a robot is done [ticks]."""
    itinerary, track = plan.scenario.problem.itineraries[robot], plan.tracks[robot]
    drive = drives_along(plan.scenario.roadmap, itinerary, track.vertices.tolist())
    spare = np.append(np.diff(track.enter) - drive, MAX_STEP)
    serves = serving_visits(itinerary.stages, track.vertices, spare)
    return [
        int(track.enter[visit]) + stage.work
        for visit, stage in zip(serves, itinerary.stages, strict=False)
    ]
