"""The table as data: for each robot the row it would drive alone, and the row of the plan."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from fractions import Fraction
from itertools import count, pairwise
from math import floor, log10
from typing import Literal, NamedTuple, get_args, overload

import numpy as np

from rightofway.errors import InputError, InputFault
from rightofway.metrics import find_collisions, find_near_misses, find_swaps, free_running
from rightofway.metrics.waits import waits_in
from rightofway.model import (
    NEVER,
    Plan,
    Scenario,
    Stays,
    Tick,
    Track,
    compute_completions,
    find_stays,
)
from rightofway.report.quantities import Quantities, format_decimal
from rightofway.site import Roadmap
from rightofway.units import DIGITS

MAX_CELLS = 2_000_000
"""Larger tables than this are not written out."""

Mark = Literal["collision", "swap", "near", "wait"]
"""``collision``: another robot books the place too. ``swap``: last tick before, or first tick
after, two robots exchange their places. ``near``: another robot is too near for their sizes.
``wait``: nothing but waiting to do."""

MARKS: tuple[Mark, ...] = get_args(Mark)
"""Where a tick has several, the first of these is shown."""

Place = int | str
"""On a grid the number of the cell, else the name of the vertex."""

RowKind = Literal["planned", "final", "list 1", "list 2"]
"""``planned``: no robot waits for another. ``final``: the plan. ``list 1``, ``list 2``: the two
movement groups of a decision, in which the first, or the second, of two robots waits."""

Spans = list[tuple[int, int]]
"""Each from a tick to before another [ticks]."""

Fleets = tuple[tuple[RowKind, Sequence[Track]], ...]
"""Tracks of all robots, for each kind of row."""


class Cell(NamedTuple):
    """The place of a robot at one tick."""

    place: Place
    mark: Mark | None


class CellRun(NamedTuple):
    """Equal cells in a row, from `start` to before `end` [ticks]."""

    start: Tick
    end: Tick
    cell: Cell


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """The places of one robot from the first tick of the table until its completion.

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
    runs: tuple[CellRun, ...]

    def list_cells(self, first: int, last: int) -> list[Cell]:
        """Return the cells of these ticks, both included; fewer where the row ends before."""
        return [
            run.cell
            for run in self.runs
            for _ in range(max(run.start, first), min(run.end, last + 1))
        ]

    def list_cells_at(self, ticks: Sequence[int], step: int) -> list[Cell]:
        """Return the cells of ticks some steps apart; fewer where the row ends before.

        A cell has the place at its tick, and the first of all marks within a step. A robot that is
        done between two ticks is in its last place at the second one.
        """
        if not self.runs or (step == 1 and ticks[-1] - ticks[0] == len(ticks) - 1):
            return self.list_cells(ticks[0], ticks[-1])
        cells, begins = list[Cell](), [run.start for run in self.runs]
        done = self.runs[-1].end - 1
        for tick in ticks:
            if tick - step >= done:
                break
            at, after = bisect_right(begins, tick) - 1, bisect_left(begins, tick + step)
            marks = {run.cell.mark for run in self.runs[at:after]}
            mark = next((mark for mark in MARKS if mark in marks), None)
            cells.append(Cell(self.runs[at].cell.place, mark))
        return cells

    @property
    def places(self) -> list[Place]:
        """The places that the robot holds, tick by tick."""
        return [run.cell.place for run in self.runs for _ in range(run.start, run.end)]


@dataclass(frozen=True, slots=True)
class StepsTo(Sequence[int]):
    """Numbers a step apart, and a last one; they are not listed, as a plan may have 10**9 ticks."""

    steps: range
    last: int

    def __len__(self) -> int:
        return len(self.steps) + (self.steps[-1] != self.last)

    @overload
    def __getitem__(self, index: int) -> int: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[int]: ...
    def __getitem__(self, index: int | slice) -> int | Sequence[int]:
        """Return the number at an index, or those of a slice."""
        at = range(len(self))[index]
        if isinstance(at, range):
            return [self[k] for k in at]
        return self.steps[at] if at < len(self.steps) else self.last


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSpaceTable:
    """The time/space table: planned and final rows of robots.

    Attributes
    ----------
    first_tick, last_tick
        Its columns, both included [ticks].
    quantities
        How times are written.
    rows
        Planned and final row of each robot in turn; or one kind of rows after another.
    step
        How much later the next column is [ticks].
    changes
        The ticks of its columns [ticks], where columns without a change are left out; else empty.
    """

    first_tick: Tick
    last_tick: Tick
    quantities: Quantities
    rows: tuple[Row, ...]
    step: int = 1
    changes: tuple[int, ...] = ()

    @property
    def ticks(self) -> Sequence[int]:
        """The ticks of its columns; the last one is among them, whatever the step."""
        if self.changes:
            return self.changes
        return StepsTo(range(self.first_tick, self.last_tick + 1, self.step), self.last_tick)

    def limit_columns(self, columns: int, longest: Fraction | None = None) -> TimeSpaceTable:
        """Return the table with at most that number of columns, each a round step long.

        Parameters
        ----------
        columns
            Columns that are wanted.
        longest
            The longest step [time unit]; the table may have more columns then. None for any.
        """
        tick, table = self.quantities.tick, self
        lengths = (
            digit * Fraction(10) ** power
            for power in count(floor(log10(tick)))
            for digit in (1, 2, 5)
        )
        while len(table.ticks) > columns:
            length = next(lengths)
            if longest is not None and length > longest:
                break
            table = replace(self, step=max(int(length / tick), 1))
        return table

    def keep_changes(self) -> TimeSpaceTable:
        """Return the table without the columns in which each robot has the cell of the one before.

        Between two columns of the result no robot moves, and no mark begins or ends.
        """
        begins = {run.start for row in self.rows for run in row.runs}
        return replace(self, changes=tuple(sorted({self.first_tick, self.last_tick} | begins)))

    @property
    def heading(self) -> str:
        """The label of the times of the columns: ``time [s]``."""
        return "tick" if self.quantities.in_ticks else self.quantities.format_heading("time")

    def describe_time(self, tick: int) -> str:
        """Return the time of a column, with as many decimals as tell two columns apart."""
        step = min((after - at for at, after in pairwise(self.changes)), default=self.step)
        length, digits = step * self.quantities.tick, DIGITS
        if self.quantities.in_ticks:
            return str(tick)
        while (length * 10**digits).denominator > 1 and length * 10**digits < 10:  # noqa: PLR2004
            digits += 1
        return format_decimal(tick * self.quantities.tick, digits)

    def refuse_more_than(self, columns: int) -> None:
        """Raise an InputError for more ticks than ``columns``, or more than `MAX_CELLS` cells."""
        ticks, rows = len(self.ticks), len(self.rows)
        if ticks > columns:
            message = (
                f"{ticks} columns, room is for {columns} (choose fewer with --from and --to,"
                " or longer ones with --step; --events has no such limit)"
            )
            raise InputError.at("table", message)
        if ticks * rows > MAX_CELLS:
            message = (
                f"{rows} rows of {ticks} columns are more than {MAX_CELLS} cells"
                " (choose fewer with --robots, or with --from and --to)"
            )
            raise InputError.at("table", message)


def make_table(
    plan: Plan,
    *,
    first_tick: int = 0,
    last_tick: int | None = None,
    robots: Sequence[str] | None = None,
    quantities: Quantities | None = None,
    step: int = 1,
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
    quantities
        How times are written; by default as the scenario does.
    step
        How much later the next column is [ticks], 1 or more.

    Raises
    ------
    InputError
        For ticks in the wrong order or after the end, or a robot that is not in the plan.
    """
    shown = choose_robots(plan.scenario, robots)
    fleets: Fleets = (("planned", free_running(plan)), ("final", plan.tracks))
    order = [(robot, fleet) for robot in shown for fleet in fleets]
    table = _make_table(plan.scenario, order, (first_tick, last_tick), quantities)
    return replace(table, step=step)


def make_table_of_groups(
    plan: Plan,
    robots: Sequence[int],
    groups: Sequence[Sequence[Track] | None],
    *,
    first_tick: int = 0,
    last_tick: int | None = None,
    quantities: Quantities | None = None,
    step: int = 1,
) -> TimeSpaceTable:
    """Make one table of the two movement groups of a decision: planned rows, list one, list two.

    Parameters
    ----------
    plan
        The plan that the decision led to.
    robots
        The robots to show, by index.
    groups
        The tracks of the fleet in both groups; None for a group that found no way.
    first_tick, last_tick, quantities, step
        As for `make_table`.

    Raises
    ------
    InputError
        For ticks in the wrong order or after the end.
    """
    kinds: tuple[RowKind, RowKind] = ("list 1", "list 2")
    fleets: list[tuple[RowKind, Sequence[Track]]] = [("planned", free_running(plan))]
    fleets += [
        (kind, group) for kind, group in zip(kinds, groups, strict=True) if group is not None
    ]
    order = [(robot, fleet) for fleet in fleets for robot in robots]
    table = _make_table(plan.scenario, order, (first_tick, last_tick), quantities)
    return replace(table, step=step)


def end_of(plan: Plan, robots: Sequence[str] | None = None) -> Tick:
    """Return the last tick of a whole table.

    Parameters
    ----------
    plan, robots
        As for `make_table`.
    """
    shown = choose_robots(plan.scenario, robots)
    fleets = (free_running(plan), plan.tracks)
    ends = [compute_completions(plan.scenario, tracks) for tracks in fleets]
    return max(end[robot] for end in ends for robot in shown)


def _make_table(
    scenario: Scenario,
    order: Sequence[tuple[int, tuple[RowKind, Sequence[Track]]]],
    window: tuple[int, int | None],
    quantities: Quantities | None,
) -> TimeSpaceTable:
    """Make a table of rows in an order: a robot in a fleet of tracks."""
    fleets = dict(fleet for _, fleet in order)
    stays = {kind: find_stays(scenario, tracks) for kind, tracks in fleets.items()}
    marked = {kind: _find_marks(scenario, tracks, stays[kind]) for kind, tracks in fleets.items()}
    ends = [stays[kind][robot].completion for robot, (kind, _) in order]
    first, last = _choose_window(*window, max(ends))
    rows = []
    for (robot, (kind, tracks)), end in zip(order, ends, strict=True):
        spans = [marked[kind][mark].get(robot, []) for mark in MARKS]
        shown = first, min(last, end) + 1
        runs = tuple(_split_runs(scenario.roadmap, tracks[robot], shown, spans))
        rows.append(Row(robot=scenario.robots[robot].name, kind=kind, runs=runs))
    return TimeSpaceTable(
        first_tick=first,
        last_tick=last,
        quantities=quantities or Quantities.of(scenario),
        rows=tuple(rows),
    )


def choose_robots(scenario: Scenario, names: Sequence[str] | None) -> list[int]:
    """Return the robots of these names, by index and in the order of the scenario.

    Parameters
    ----------
    scenario
        The problem.
    names
        Names of robots; None for all.

    Raises
    ------
    InputError
        For each name that no robot has.
    """
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


def _choose_window(first: int, last: int | None, end: Tick) -> tuple[Tick, Tick]:
    if first < 0:
        raise InputError.at("first_tick", f"{first} is negative (give 0 or more)")
    if last is not None and last < first:
        message = f"{last} is before the first tick, {first} (give {first} or more)"
        raise InputError.at("last_tick", message)
    if first > end:
        message = f"{first} is after the end: all robots are done at tick {end} (give less)"
        raise InputError.at("first_tick", message)
    return Tick(first), end if last is None else Tick(last)


def _find_marks(
    scenario: Scenario, tracks: Sequence[Track], stays: Sequence[Stays]
) -> dict[Mark, dict[int, Spans]]:
    """Return when robots collide, swap or wait, by mark and robot."""
    spans: dict[Mark, dict[int, Spans]] = {mark: {} for mark in MARKS}
    for collision in find_collisions(scenario, tracks):
        end = NEVER if collision.end is None else collision.end
        for robot in collision.robots:
            spans["collision"].setdefault(robot, []).append((collision.start, end))
    for swap in find_swaps(tracks):
        for robot in swap.robots:
            spans["swap"].setdefault(robot, []).append((swap.tick - 1, swap.tick + 1))
    for miss in find_near_misses(scenario, tracks):
        end = NEVER if miss.end is None else miss.end
        for robot in miss.robots:
            spans["near"].setdefault(robot, []).append((miss.start, end))
    for wait in waits_in(scenario, tracks, stays):
        span = wait.tick, wait.tick + wait.ticks
        spans["wait"].setdefault(wait.robot, []).append(span)
    return spans


def _split_runs(
    roadmap: Roadmap, track: Track, window: tuple[int, int], spans_by_mark: Sequence[Spans]
) -> Iterator[CellRun]:
    """Yield the runs of a track in a window; of several marks, the first of `MARKS` is shown."""
    if window[0] >= window[1]:
        return
    spans = [
        np.clip(np.array(spans_of_mark, np.int64).reshape(-1, 2), *window)
        for spans_of_mark in spans_by_mark
    ]
    cuts = np.unique(np.concatenate([window, np.clip(track.enter, *window), *map(np.ravel, spans)]))
    visits = np.searchsorted(track.enter, cuts[:-1], side="right") - 1
    begun, ended = (
        [np.searchsorted(np.sort(span[:, side]), cuts[:-1], side="right") for span in spans]
        for side in (0, 1)
    )
    is_marked = [*(np.array(begun) > np.array(ended)), np.ones(len(visits), bool)]
    marks = np.argmax(is_marked, axis=0).tolist()  # the first that holds; none is the last
    vertices = track.vertices[visits].tolist()
    cells = roadmap.grid.cells if roadmap.grid is not None and roadmap.labels is None else None
    for vertex, mark, (start, end) in zip(vertices, marks, pairwise(cuts.tolist()), strict=True):
        place: Place = roadmap.name(vertex) if cells is None else int(cells[vertex])
        yield CellRun(Tick(start), Tick(end), Cell(place, (*MARKS, None)[mark]))
