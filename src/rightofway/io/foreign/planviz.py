"""JSON of PlanViz and the League of Robot Runners, rounds 2023, 2024 and 2026.

``actualPaths``, else ``plannerPaths``, has the actions of each agent, one for each step:
``"F,R,W"``. Since 2026 a move or turn takes ``agentMaxCounter`` steps, and runs of actions are
counted: ``[(0,14,55,0,0):(F 20,R 10)][(30,…):(W 5)]``. Of the five numbers before a part, only its
first step is read.

In the action model ``MAPF_T`` agents have headings: F drives forward, R turns clockwise, C the
other way, W waits. In ``MAPF``, L and R change the column, U and D the row: U adds 1 in PlanViz
today, and took 1 away in earlier files. Both are tried, and the one is taken with which more agents
are at their errands when they finish them.

Our robots turn in no time, so a turn becomes a wait. An agent is at its cell until a move is
complete. Its stops are the errands that it finishes, in order, and its last cell.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError, quote
from rightofway.io.faults import Faults
from rightofway.io.foreign.trajectories import (
    Cell,
    ForeignPlan,
    Trajectory,
    Visits,
)
from rightofway.io.json_text import parse_json
from rightofway.io.source import Source

HEADINGS = {"E": (0, 1), "N": (-1, 0), "W": (0, -1), "S": (1, 0)}
"""Change of row and column, in the order of turns back (counterclockwise)."""

MOVES = {"U": (1, 0), "D": (-1, 0), "L": (0, -1), "R": (0, 1)}
"""Change of row and column of the action model MAPF, as PlanViz draws them today."""

PATHS = ("actualPaths", "plannerPaths")

EARLIER_MOVES = {**MOVES, "U": MOVES["D"], "D": MOVES["U"]}

TURNS = {"R": -1, "C": 1}

WAITS = ("W", "T")
"""Actions of an agent that stays where it is; T where its planner was late."""

MAX_COORDINATE = 100_000
"""Rows and columns of a start are below this."""

MAX_STEPS = 10_000_000
"""Steps of a path at most."""

MAX_MOVES = 100_000_000
"""Moves and turns of all agents at most."""

_PART = re.compile(r"\[\(([0-9]{1,9})(?:,-?[0-9]{1,9}){4}\):\(([^()\[\]]*)\)\]")
_RUN = re.compile(r"([A-Z])([0-9]{1,9})")

Errands = dict[int, list[tuple[int, Cell]]]
"""The errands that each agent finishes, in order, with their steps."""


def recognizes(text: str) -> bool:
    """Return whether a text is JSON with the actions of agents."""
    is_ours = '"rightofway-' in text[:200]
    has_paths = any(f'"{key}"' in text for key in PATHS)
    return text.lstrip().startswith("{") and has_paths and not is_ours


def read(text: str) -> ForeignPlan:
    """Return the plan of a text.

    Raises
    ------
    InputError
        For agents without a start, unknown actions, and tasks that do not exist.
    """
    log, faults = Source(parse_json(text)), Faults()
    turns = faults.attempt("", _has_headings, log.get("actionModel"))
    counter = faults.attempt("", _count, log.get("agentMaxCounter")) or 1
    faults.stop()
    paths = log.need(*PATHS)
    if not paths.read_items():
        raise paths.make_fault("has no path (give one for each agent)")
    starts = log.need("start")
    if len(starts.read_items()) < len(paths.read_items()):
        raise starts.make_fault(
            f"does not have a start for each of {len(paths.read_items())} agents"
        )
    counts = any(isinstance(path, str) and path.lstrip().startswith("[") for path in paths.value)
    steps_per_move = counter if counts else 1
    errands = faults.attempt("", _list_errands, log) or {}
    ways = [HEADINGS] if turns else [MOVES, EARLIER_MOVES]
    read = [_trace_all_visits(paths, starts, changes, steps_per_move, faults) for changes in ways]
    faults.stop()
    visits = max(read, key=lambda visits: _count_hits(visits, errands))
    agents = []
    for index, (cells, steps) in enumerate(visits):
        row, column = cells[-1].tolist()
        stops = [cell for _, cell in errands.get(index, [])]
        if stops[-1:] != [(row, column)]:
            stops.append((row, column))
        where = paths.make_child(index, None).location
        agents.append(
            Trajectory(name=f"A{index}", cells=cells, steps=steps, location=where, stops=stops)
        )
    return ForeignPlan(agents=agents, steps_per_move=steps_per_move)


def _trace_all_visits(
    paths: Source,
    starts: Source,
    changes: Mapping[str, Cell],
    steps_per_move: int,
    faults: Faults,
) -> list[Visits]:
    """Return the visits of each agent, or fewer after noting faults."""
    all_visits, n_moves = list[Visits](), 0
    for path, start in zip(paths.read_items(), starts.read_items(), strict=False):
        begin = faults.attempt("", _start, start, changes)
        where = path.path
        runs = faults.attempt(where, _split_runs, path.value, changes)
        if begin is None or runs is None:
            continue
        n_moves += int(runs[1].sum()) // steps_per_move
        if n_moves > MAX_MOVES:
            raise InputError.at(where, f"more than {MAX_MOVES} moves (read a part of the plan)")
        visits = faults.attempt(where, _trace_visits, begin, *runs, changes, steps_per_move)
        all_visits += [] if visits is None else [visits]
    return all_visits


def _trace_visits(
    start: tuple[Cell, int],
    actions: NDArray[np.uint8],
    lengths: NDArray[np.int64],
    changes: Mapping[str, Cell],
    steps_per_move: int,
) -> Visits:
    """Return the visits of an agent, from a cell and heading on, with an action in each run."""
    cell, heading = start
    ends = np.cumsum(lengths)
    busy = ~np.isin(actions, _list_codes(WAITS))
    progress = np.cumsum(np.where(busy, lengths, 0))  # steps of moves and turns so far
    at = np.flatnonzero(busy)
    broken = (np.diff(actions[at]) != 0) & (progress[at[:-1]] % steps_per_move != 0)
    if broken.any():
        run = at[int(np.argmax(broken))]
        message = f"{chr(actions[run])} ends after {progress[run] % steps_per_move} of"
        message += f" {steps_per_move} steps (finish it before the next action)"
        raise InputError.at(("step", int(ends[run])), message)
    marks = steps_per_move * np.arange(1, progress[-1:].sum() // steps_per_move + 1)
    runs = np.searchsorted(progress, marks)  # that complete the moves and turns
    steps = ends[runs] - (progress[runs] - marks)
    done = actions[runs]
    moves = np.ones(len(done), bool)
    table = np.zeros((256, 2), np.int64)
    if changes is HEADINGS:
        turns = np.zeros(256, np.int64)
        turns[_list_codes(TURNS)] = list(TURNS.values())
        table[:4] = list(HEADINGS.values())
        moves = done == ord("F")
        done = ((heading + np.cumsum(turns[done])) % 4).astype(np.uint8)
    else:
        table[_list_codes(changes)] = list(changes.values())
    cells = np.cumsum(np.vstack([[cell], table[done[moves]]]), axis=0)
    return cells, np.concatenate(([0], steps[moves]))


def _list_codes(letters: Iterable[str]) -> list[int]:
    return [ord(letter) for letter in letters]


def _count_hits(visits: Sequence[Visits], errands: Errands) -> int:
    """Return at how many of their errands the agents are when they finish them."""
    hits = 0
    for index, (cells, steps) in enumerate(visits):
        for step, cell in errands.get(index, ()):
            visit = np.searchsorted(steps, min(max(step, 0), MAX_STEPS), side="right") - 1
            hits += tuple(cells[visit].tolist()) == cell
    return hits


def _has_headings(model: Source | None) -> bool:
    if model is not None and model.value not in ("MAPF", "MAPF_T"):
        raise model.make_fault(f"{quote(model.value)} is not known (give MAPF or MAPF_T)")
    return model is None or bool(model.value == "MAPF_T")


def _count(count: Source | None) -> int:
    return 1 if count is None else count.read_whole(1, 1000)  # our finest clock


def _start(start: Source, changes: Mapping[str, Cell]) -> tuple[Cell, int]:
    """Return the first cell of an agent, and the number of its heading."""
    parts = start.read_items()
    if len(parts) not in {2, 3}:
        raise start.make_fault(f"{quote(start.value)} is no start (give [row, column, heading])")
    heading = parts[2] if changes is HEADINGS and len(parts) > 2 else start.make_child(2, "E")  # noqa: PLR2004
    if not isinstance(heading.value, str) or heading.value not in HEADINGS:
        raise heading.make_fault(f"{quote(heading.value)} is no heading (give E, N, W or S)")
    return _make_cell(*parts[:2]), list(HEADINGS).index(heading.value)


def _make_cell(row: Source, column: Source) -> Cell:
    return row.read_whole(0, MAX_COORDINATE - 1), column.read_whole(0, MAX_COORDINATE - 1)


def _split_runs(
    path: Any, changes: Mapping[str, Cell]
) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    """Return the actions of a path, and for how many steps each is taken."""
    if not isinstance(path, str):
        raise InputError.at("", f'{quote(path)} is no path (give actions like "F,R,W")')
    bare = "".join(path.split())
    if bare.startswith("["):
        actions, lengths = _count_runs(bare)
    else:
        actions = [action for action in bare.split(",") if action]
        lengths = [1] * len(actions)
    known = ["F", *TURNS, *WAITS] if changes is HEADINGS else [*MOVES, *WAITS]
    unknown = set(actions).difference(known)
    if unknown:
        index = next(index for index, action in enumerate(actions) if action in unknown)
        message = f"{quote(actions[index])} is no action (give one of {', '.join(known)})"
        raise InputError.at(("step", int(sum(lengths[:index]))), message)
    if sum(lengths) > MAX_STEPS:
        raise InputError.at("", f"{sum(lengths)} steps are too many (give at most {MAX_STEPS})")
    return np.frombuffer("".join(actions).encode(), np.uint8), np.array(lengths, np.int64)


def _count_runs(bare: str) -> tuple[list[str], list[int]]:
    """Return the runs of all parts of a path of the round of 2026."""
    rest = _PART.sub("", bare)
    if rest:
        message = f"{quote(rest)} is no part (write [(step,row,column,heading,counter):(F 10,W 5)])"
        raise InputError.at("", message)
    actions, lengths, step = list[str](), list[int](), 0
    for first, runs in _PART.findall(bare):
        if int(first) != step:
            message = f"a part begins with step {first}, the part before it ends with step {step}"
            raise InputError.at("", f"{message} (let the parts follow each other)")
        for run in filter(None, runs.split(",")):
            match = _RUN.fullmatch(run)
            if not match:
                message = f"{quote(run)} is no run of actions (write F 10)"
                raise InputError.at(("step", step), message)
            actions.append(match[1])
            lengths.append(int(match[2]))
            step += lengths[-1]
    return actions, lengths


def _list_errands(log: Source) -> Errands:
    """Return the errands that each agent finishes, in order, with their steps."""
    faults, places = Faults(), dict[tuple[int, int], Cell]()
    for task in log.read_items_under("tasks"):
        for number, cell in enumerate(faults.attempt("", _list_cells, task) or ()):
            places[task.value[0], number] = cell
    finished: list[tuple[int, int, tuple[int, int]]] = []  # step, agent, (task, number of errand)
    for index, event in enumerate(log.read_items_under("events")):
        for row in faults.attempt("", _list_finished, event, index) or ():
            if row[2] in places:
                finished.append(row)
            else:
                message = f"task {row[2][0]} has no errand {row[2][1] + 1} (give it in tasks)"
                faults.note(event.location, message)
    faults.stop()
    errands: Errands = {}
    for step, agent, errand in sorted(finished):
        errands.setdefault(agent, []).append((step, places[errand]))
    return errands


def _list_cells(task: Source) -> list[Cell]:
    """Return the places of a task: [id, row, column], or [id, released, [row, column, …]]."""
    parts = task.read_items()
    if len(parts) == 3 and type(parts[0].value) is int:  # noqa: PLR2004
        numbers = parts[2].read_items() if isinstance(parts[2].value, list) else parts[1:]
        if len(numbers) % 2 == 0:
            return [_make_cell(*pair) for pair in zip(numbers[::2], numbers[1::2], strict=True)]
    raise task.make_fault(f"{quote(task.value)} is no task (give [id, step, [row, column, …]])")


def _list_finished(source: Source, agent: int) -> Iterator[tuple[int, int, tuple[int, int]]]:
    """Yield the errands that an event reports as finished.

    In 2023 there is a list of [task, step, "finished"] for each agent; later, events are
    [step, agent, task, errands finished], none of which are finished when the task is assigned.
    """
    event = source.value
    if isinstance(event, list) and event and type(event[0]) is int:
        if len(event) != 4 or not all(type(number) is int for number in event):  # noqa: PLR2004
            message = f"{quote(event)} is no event (give [step, agent, task, errands finished])"
            raise source.make_fault(message)
        step, agent, task, count = event
        if count > 0:
            yield step, agent, (task, count - 1)
        return
    for row in event if isinstance(event, list) else [event]:
        is_event = isinstance(row, list) and len(row) == 3  # noqa: PLR2004
        if not (is_event and type(row[0]) is type(row[1]) is int):
            raise source.make_fault(f'{quote(row)} is no event (give [task, step, "finished"])')
        if row[2] == "finished":
            yield row[1], agent, (row[0], 0)
