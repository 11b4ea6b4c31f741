"""The table as data: for each robot the row it would drive alone, and the row of the plan."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from rightofway.errors import InputError, InputFault
from rightofway.metrics import collisions, free_running, waits
from rightofway.model import NEVER, Plan, Roadmap, Scenario, Tick, Track, completions_of

MAX_CELLS = 2_000_000
"""Larger tables than this are not written out."""

Mark = Literal["collision", "wait"]
"""``collision``: another robot books the place too. ``wait``: nothing but waiting to do."""

Place = int | str
"""On a grid the number of the cell, else the name of the vertex."""

RowKind = Literal["planned", "final"]
"""``planned``: no robot waits for another. ``final``: the plan."""

Spans = list[tuple[int, int]]
"""Each from a tick to before another [ticks]."""


class Cell(NamedTuple):
    """What a robot holds at one tick."""

    place: Place
    mark: Mark | None


class Run(NamedTuple):
    """Equal cells in a row, from `start` to before `end` [ticks]."""

    start: Tick
    end: Tick
    cell: Cell


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """Where one robot is from the table's first tick on, until it is done.

    Attributes
    ----------
    robot
        Its name.
    kind
        Whether it drives alone or by the plan.
    runs
        Its cells; no gap between them, none where it is done before the first tick.
    """

    robot: str
    kind: RowKind
    runs: tuple[Run, ...]

    def cells(self, first: int, last: int) -> list[Cell]:
        """Return the cells of these ticks, both included; fewer where the row ends before."""
        return [
            run.cell
            for run in self.runs
            for _ in range(max(run.start, first), min(run.end, last + 1))
        ]

    @property
    def places(self) -> list[Place]:
        """What the robot holds, tick by tick."""
        return [run.cell.place for run in self.runs for _ in range(run.start, run.end)]


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSpaceTable:
    """Planned and final rows side by side.

    Attributes
    ----------
    first_tick, last_tick
        Its columns, both included [ticks].
    tick
        How long a tick is [time unit].
    rows
        Planned and final row of each robot in turn.
    """

    first_tick: Tick
    last_tick: Tick
    tick: Fraction
    rows: tuple[Row, ...]

    @property
    def ticks(self) -> range:
        """The ticks of its columns."""
        return range(self.first_tick, self.last_tick + 1)

    def refuse_more_than(self, columns: int) -> None:
        """Raise an InputError for more ticks than ``columns``, or more than `MAX_CELLS` cells."""
        ticks, rows = len(self.ticks), len(self.rows)
        if ticks > columns:
            message = (
                f"{ticks} columns, room is for {columns} (choose fewer: first_tick, last_tick)"
            )
            raise InputError.at("table", message)
        if ticks * rows > MAX_CELLS:
            message = (
                f"{rows} rows of {ticks} ticks are more than {MAX_CELLS} cells"
                " (choose fewer robots, or fewer ticks: robots, first_tick, last_tick)"
            )
            raise InputError.at("table", message)


def table_of(
    plan: Plan,
    *,
    first_tick: int = 0,
    last_tick: int | None = None,
    robots: Sequence[str] | None = None,
) -> TimeSpaceTable:
    """Make the time/space table of a plan.

    Parameters
    ----------
    plan
        The plan; conflicts it still has are marked in its final rows.
    first_tick, last_tick
        The ticks to show, both included; without a last one, until all these robots are done.
    robots
        Names of the robots to show, in the order of the scenario; all by default. Their collisions
        with robots that are not shown are marked all the same.

    Raises
    ------
    InputError
        For ticks in the wrong order, or a robot that is not in the plan.
    """
    scenario = plan.scenario
    shown = _indices(scenario, robots)
    alone, nowhere = free_running(plan), [Spans() for _ in plan.tracks]
    waiting = [Spans() for _ in plan.tracks]
    for wait in waits(plan):
        waiting[wait.robot].append((wait.tick, wait.tick + wait.ticks))
    kinds: tuple[tuple[RowKind, Sequence[Track], list[Spans]], ...] = (
        ("planned", alone, nowhere),
        ("final", plan.tracks, waiting),
    )
    ends = {kind: completions_of(scenario, tracks) for kind, tracks, _ in kinds}
    colliding = {kind: _colliding(scenario, tracks) for kind, tracks, _ in kinds}
    latest = max(ends[kind][robot] for kind in ends for robot in shown)
    first, last = _window(first_tick, last_tick, latest)
    rows: list[Row] = []
    for robot in shown:
        for kind, tracks, waits_of in kinds:
            window = first, min(last, ends[kind][robot]) + 1
            marked = colliding[kind][robot], waits_of[robot]
            runs = tuple(_runs(scenario.roadmap, tracks[robot], window, *marked))
            rows.append(Row(robot=scenario.robots[robot].name, kind=kind, runs=runs))
    tick = scenario.problem.clock.tick
    return TimeSpaceTable(first_tick=first, last_tick=last, tick=tick, rows=tuple(rows))


def _indices(scenario: Scenario, names: Sequence[str] | None) -> list[int]:
    all_names = [robot.name for robot in scenario.robots]
    faults = []
    for name in names or ():
        if name not in all_names:
            near = (get_close_matches(name, all_names, 1) or all_names)[0]
            message = f"no robot is named {name!r} (did you mean {near!r}?)"
            faults.append(InputFault("robots", message))
    if faults:
        raise InputError(faults)
    return [index for index, name in enumerate(all_names) if not names or name in names]


def _window(first: int, last: int | None, latest: int) -> tuple[Tick, Tick]:
    if first < 0:
        raise InputError.at("first_tick", f"{first} is negative (give 0 or more)")
    if last is not None and last < first:
        message = f"{last} is before the first tick, {first} (give {first} or more)"
        raise InputError.at("last_tick", message)
    return Tick(first), Tick(max(first, latest) if last is None else last)


def _colliding(scenario: Scenario, tracks: Sequence[Track]) -> list[Spans]:
    spans: list[Spans] = [[] for _ in tracks]
    for collision in collisions(scenario, tracks):
        end = NEVER if collision.end is None else collision.end
        for robot in collision.robots:
            spans[robot].append((collision.start, end))
    return spans


def _runs(
    roadmap: Roadmap, track: Track, window: tuple[int, int], colliding: Spans, waiting: Spans
) -> Iterator[Run]:
    """Yield the runs of a track in a window; a collision is marked rather than a wait."""
    if window[0] >= window[1]:
        return
    spans = [
        np.clip(np.array(each, np.int64).reshape(-1, 2), *window) for each in (colliding, waiting)
    ]
    cuts = np.unique(np.concatenate([window, np.clip(track.enter, *window), *map(np.ravel, spans)]))
    visits = np.searchsorted(track.enter, cuts[:-1], side="right") - 1
    begun, ended = (
        [np.searchsorted(np.sort(span[:, side]), cuts[:-1], side="right") for span in spans]
        for side in (0, 1)
    )
    collides, waits_here = np.array(begun) > np.array(ended)
    vertices = track.vertices[visits].tolist()
    cells = roadmap.grid.cells if roadmap.grid is not None and roadmap.labels is None else None
    for index, (start, end) in enumerate(pairwise(cuts.tolist())):
        mark: Mark | None = (
            "collision" if collides[index] else "wait" if waits_here[index] else None
        )
        vertex = vertices[index]
        place: Place = roadmap.name(vertex) if cells is None else int(cells[vertex])
        yield Run(Tick(start), Tick(end), Cell(place, mark))
