"""The simulator of the League of Robot Runners, round 2024: one action of each agent in a step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from tests.oracles.planviz import AHEAD, Cell

Event = tuple[int, int, int, int]
"""Step, agent, task, and how many errands of the task are finished."""

HEADINGS = "ENWS"


def run_actions(document: Mapping[str, Any]) -> list[list[Cell]]:
    """Return the cell of each agent at each step, from the start on."""
    cells = []
    for (row, column, letter), path in zip(document["start"], document["actualPaths"], strict=True):
        heading, at = HEADINGS.index(letter), (row, column)
        own = [at]
        for action in path.split(",") if path else ():
            if action == "F":
                at = at[0] + AHEAD[heading][0], at[1] + AHEAD[heading][1]
            heading = (heading + {"C": 1, "R": -1}.get(action, 0)) % 4
            own.append(at)
        cells.append(own)
    return cells


def find_wrong_moves(cells: Sequence[Sequence[Cell]], free: set[Cell]) -> list[str]:
    """Return the errors of moves: into walls, into each other, exchanges of two cells."""
    errors = []
    for step in range(1, len(cells[0])):
        now = [own[step] for own in cells]
        before = [own[step - 1] for own in cells]
        errors += [f"{step}: wall" for at in now if at not in free]
        errors += [f"{step}: vertex conflict"] * (len(now) - len(set(now)))
        moves = {(a, b) for a, b in zip(before, now, strict=True) if a != b}
        errors += [f"{step}: edge conflict" for a, b in moves if a < b and (b, a) in moves]
    return errors


def finish_tasks(document: Mapping[str, Any], cells: Sequence[Sequence[Cell]]) -> list[Event]:
    """Return the events: at each step an agent finishes the next errand of its task if it is there.

    The task of an agent at a step is the last one of its schedule that is assigned by then.
    """
    places = {
        task: list(zip(numbers[::2], numbers[1::2], strict=True))
        for task, _, numbers in document["tasks"]
    }
    done, events = dict.fromkeys(places, 0), []
    schedules = [
        [tuple(map(int, part.split(":"))) for part in schedule.split(",") if part]
        for schedule in document["actualSchedule"]
    ]
    for step in range(1, len(cells[0])):
        for agent, schedule in enumerate(schedules):
            assigned = [task for begin, task in schedule if begin <= step]
            if not assigned or done[assigned[-1]] == len(places[assigned[-1]]):
                continue
            task = assigned[-1]
            if cells[agent][step] == places[task][done[task]]:
                done[task] += 1
                events.append((step, agent, task, done[task]))
    return events
