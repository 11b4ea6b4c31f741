"""An agent of PlanViz that takes its actions one step at a time."""

from __future__ import annotations

from collections.abc import Iterable

Cell = tuple[int, int]

AHEAD = [(0, 1), (-1, 0), (0, -1), (1, 0)]
"""Change of row and column for the headings east, north, west and south."""


def visits_step_by_step(
    actions: Iterable[str], start: Cell, heading: int, steps_per_move: int
) -> list[tuple[Cell, int]]:
    """Return the cells that an agent enters, each with the step; one action for each step."""
    row, column = start
    visits = [(start, 0)]
    done = 0
    for step, action in enumerate(actions, start=1):
        if action == "W":
            continue
        done += 1
        if done < steps_per_move:
            continue
        done = 0
        if action == "F":
            row, column = row + AHEAD[heading][0], column + AHEAD[heading][1]
            visits.append(((row, column), step))
        else:
            heading = (heading + (1 if action == "C" else -1)) % 4
    return visits
