"""From a plan to its table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import partial

from rightofway.errors import InputError, InputFault
from rightofway.metrics import collisions, free_running, waits
from rightofway.model import NEVER, Plan, Roadmap, Scenario, Tick, Track, completions_of
from rightofway.viz.table.runs import Span, runs_of
from rightofway.viz.table.timespace import Mark, Place, Row, RowKind, TimeSpaceTable

__all__ = ["table_of"]


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
        Names of the robots to show, in the order of the scenario; all by default. What they meet
        with robots that are not shown is marked all the same.

    Raises
    ------
    InputError
        For ticks in the wrong order, or a robot that is not in the plan.
    """
    shown = _indices(plan.scenario, robots)
    nobody_waits: list[list[Span]] = [[] for _ in plan.tracks]
    fleets = (
        _fleet(plan.scenario, "planned", free_running(plan), nobody_waits),
        _fleet(plan.scenario, "final", plan.tracks, _waiting(plan)),
    )
    latest = max(fleet.ends[robot] for fleet in fleets for robot in shown)
    first, last = _window(first_tick, last_tick, latest)
    return TimeSpaceTable(
        first_tick=first,
        last_tick=last,
        tick=plan.scenario.problem.clock.tick,
        rows=tuple(fleet.row(robot, first, last) for robot in shown for fleet in fleets),
    )


def _indices(scenario: Scenario, names: Sequence[str] | None) -> list[int]:
    all_names = [robot.name for robot in scenario.robots]
    problems = []
    for name in names or ():
        if name not in all_names:
            near = (get_close_matches(name, all_names, 1) or all_names)[0]
            message = f"no robot is named {name!r} (did you mean {near!r}?)"
            problems.append(InputFault("robots", message))
    if problems:
        raise InputError(problems)
    return [index for index, name in enumerate(all_names) if not names or name in names]


def _window(first: int, last: int | None, latest: int) -> tuple[Tick, Tick]:
    if first < 0:
        raise InputError.at("first_tick", f"{first} is negative (give 0 or more)")
    if last is not None and last < first:
        message = f"{last} is before the first tick, {first} (give {first} or more)"
        raise InputError.at("last_tick", message)
    return Tick(first), Tick(max(first, latest) if last is None else last)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Fleet:
    """All tracks of one kind of row, and what is to be marked in them."""

    scenario: Scenario
    kind: RowKind
    tracks: Sequence[Track]
    ends: Sequence[Tick]
    colliding: Sequence[Sequence[Span]]
    waiting: Sequence[Sequence[Span]]

    def row(self, robot: int, first: Tick, last: Tick) -> Row:
        """Return the row of a robot between two ticks, both included."""
        marks: tuple[tuple[Mark, Sequence[Span]], ...] = (
            ("collision", self.colliding[robot]),
            ("wait", self.waiting[robot]),
        )
        window = (first, min(last, self.ends[robot]) + 1)
        place = partial(_place, self.scenario.roadmap)
        runs = tuple(runs_of(self.tracks[robot], window, marks, place))
        return Row(robot=self.scenario.robots[robot].name, kind=self.kind, runs=runs)


def _fleet(
    scenario: Scenario, kind: RowKind, tracks: Sequence[Track], waiting: Sequence[Sequence[Span]]
) -> _Fleet:
    return _Fleet(
        scenario=scenario,
        kind=kind,
        tracks=tracks,
        ends=completions_of(scenario, tracks),
        colliding=_colliding(scenario, tracks),
        waiting=waiting,
    )


def _place(roadmap: Roadmap, vertex: int) -> Place:
    if roadmap.labels is None and roadmap.grid is not None:
        return int(roadmap.grid.cells[vertex])
    return roadmap.name(vertex)


def _waiting(plan: Plan) -> list[list[Span]]:
    spans: list[list[Span]] = [[] for _ in plan.tracks]
    for wait in waits(plan):
        spans[wait.robot].append((wait.tick, wait.tick + wait.ticks))
    return spans


def _colliding(scenario: Scenario, tracks: Sequence[Track]) -> list[list[Span]]:
    spans: list[list[Span]] = [[] for _ in tracks]
    for collision in collisions(scenario, tracks):
        end = NEVER if collision.end is None else collision.end
        for robot in collision.robots:
            spans[robot].append((collision.start, end))
    return spans
