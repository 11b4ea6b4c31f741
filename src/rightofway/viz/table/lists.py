"""The parts of a plan, as lists: its events, its collisions and swaps, its decisions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from operator import attrgetter
from typing import overload

from rightofway.errors import InputError
from rightofway.metrics import (
    Event,
    NamedCollision,
    find_collisions,
    find_swaps,
    free_running,
    list_events,
    make_event_columns,
)
from rightofway.model import Decision, Plan, Tick
from rightofway.report.quantities import Quantities
from rightofway.viz.table.listing import ListColumn, Listing, Value
from rightofway.viz.table.timespace import choose_robots

MAX_ROWS = 1_000_000
"""The largest number of rows of a list that is written to a file or has one for each tick."""


def choose_events(
    plan: Plan,
    *,
    first_tick: int = 0,
    last_tick: int | None = None,
    robots: Sequence[str] | None = None,
) -> tuple[Event, ...]:
    """Return the visits of some robots that have a part in a window of time.

    Parameters
    ----------
    plan
        The plan.
    first_tick, last_tick
        The window, both included; without a last tick, to the end.
    robots
        Names of robots; all by default.

    Raises
    ------
    InputError
        For a robot that is not in the plan.
    """
    shown = set(choose_robots(plan.scenario, robots))
    return tuple(
        event
        for event in list_events(plan)
        if event.robot in shown
        and (last_tick is None or event.enter <= last_tick)
        and (event.leave is None or event.leave > first_tick)
    )


def tabulate_events(
    plan: Plan, chosen: Sequence[Event] | None = None, quantities: Quantities | None = None
) -> Listing:
    """Return visits as a list.

    Parameters
    ----------
    plan
        The plan.
    chosen
        Visits of it; all by default.
    quantities
        How times are written; by default as the scenario does.
    """
    columns, quantities = (
        make_event_columns(plan, chosen),
        quantities or Quantities.of(plan.scenario),
    )
    ticks = (
        ()
        if quantities.in_ticks
        else (
            ListColumn(heading="enter [ticks]", values=columns["enter_tick"], for_people=False),
            ListColumn(heading="leave [ticks]", values=columns["leave_tick"], for_people=False),
            ListColumn(heading="waits [ticks]", values=columns["wait_ticks"], for_people=False),
        )
    )
    waits = [ticks or None for ticks in columns["wait_ticks"]]
    return Listing(
        title="events",
        columns=(
            ListColumn(heading="robot", values=columns["robot"]),
            ListColumn(heading="visit", values=columns["visit"], kind="number", for_people=False),
            ListColumn(heading="place", values=columns["vertex"]),
            ListColumn(heading="purpose", values=columns["purpose"]),
            ListColumn(heading="enter", values=columns["enter_tick"], kind="time"),
            ListColumn(heading="leave", values=columns["leave_tick"], kind="time"),
            ListColumn(heading="waits", values=waits, kind="time"),
            ListColumn(heading="waits for", values=columns["waits_for"]),
            ListColumn(heading="to leave", values=columns["to_leave"]),
            *ticks,
        ),
        quantities=quantities,
    )


def tabulate_stops(plan: Plan) -> Listing:
    """Return the stops of jobs in order as a list, then the jobs that are not served."""
    jobs, name = plan.scenario.jobs or (), plan.scenario.roadmap.name
    rows = sorted(
        (item.job, item.stop + 1, robot, item.visit, item.begin, item.end)
        for robot, tour in enumerate(plan.tours or ())
        for item in tour
        if item.job is not None and item.stop is not None
    )
    none: list[Value] = [None] * len(plan.unserved)
    robots = [plan.scenario.robots[robot].name for _, _, robot, *_ in rows]
    places = [name(int(plan.tracks[robot].vertices[visit])) for _, _, robot, visit, *_ in rows]
    return Listing(
        title="jobs",
        columns=(
            ListColumn(
                heading="job",
                values=[
                    jobs[job].name for job in (*(row[0] for row in rows), *dict(plan.unserved))
                ],
            ),
            ListColumn(heading="stop", values=[*(row[1] for row in rows), *none], kind="number"),
            ListColumn(heading="robot", values=[*robots, *none]),
            ListColumn(heading="place", values=[*places, *none]),
            ListColumn(heading="begins", values=[*(row[4] for row in rows), *none], kind="time"),
            ListColumn(heading="ends", values=[*(row[5] for row in rows), *none], kind="time"),
            ListColumn(
                heading="not served",
                values=[*[None] * len(rows), *(reason for _, reason in plan.unserved)],
            ),
        ),
        quantities=Quantities.of(plan.scenario),
    )


class _Cells(Sequence[Value]):
    """The cells of a column, computed from the rows that are written."""

    def __init__(
        self, rows: Sequence[NamedCollision], compute: Callable[[NamedCollision], Value]
    ) -> None:
        self._rows, self._compute = rows, compute

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, at: int) -> Value: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[Value]: ...
    def __getitem__(self, at: int | slice) -> Value | Sequence[Value]:
        if isinstance(at, slice):
            return [self._compute(row) for row in self._rows[at]]
        return self._compute(self._rows[at])

    def __iter__(self) -> Iterator[Value]:
        return map(self._compute, self._rows)


def _get_end(row: NamedCollision) -> Value:
    return row.until if row.until is not None else "permanently"


def _join_places(row: NamedCollision) -> str:
    return " and ".join(row.places)


def tabulate_collisions(
    collisions: Sequence[NamedCollision], quantities: Quantities, title: str = "collisions"
) -> Listing:
    """Return collisions and swaps as a list of intervals.

    Parameters
    ----------
    collisions
        The rows of `name_collisions`.
    quantities
        How times are written.
    title
        A name for the list.
    """
    return Listing(
        title=title,
        columns=(
            ListColumn(heading="robot i", values=_Cells(collisions, attrgetter("i"))),
            ListColumn(heading="robot j", values=_Cells(collisions, attrgetter("j"))),
            ListColumn(heading="from", values=_Cells(collisions, attrgetter("start")), kind="time"),
            ListColumn(heading="until", values=_Cells(collisions, _get_end), kind="time"),
            ListColumn(heading="place", values=_Cells(collisions, _join_places)),
            ListColumn(heading="kind", values=_Cells(collisions, attrgetter("kind"))),
        ),
        quantities=quantities,
    )


def tabulate_collision_ticks(
    collisions: Sequence[NamedCollision], quantities: Quantities, end: Tick
) -> Listing:
    """Return the paper's list, Collision(i, j, t) = n: a row for each tick of each collision.

    Parameters
    ----------
    collisions
        The rows of `name_collisions`.
    quantities
        How times are written.
    end
        The last tick listed of a collision that never ends.

    Raises
    ------
    InputError
        If the list would have more than `MAX_ROWS` rows.
    """
    last = [end + 1 if row.until is None else row.until for row in collisions]
    ticks = sum(until - row.start for row, until in zip(collisions, last, strict=True))
    if ticks > MAX_ROWS:
        message = f"the collisions last {ticks} ticks, more than {MAX_ROWS} (leave it out)"
        raise InputError.at("--each-tick", message)
    rows = sorted(
        (
            (tick, row.i, row.j, " and ".join(row.places), row.kind)
            for row, until in zip(collisions, last, strict=True)
            for tick in ([row.start] if row.kind == "swap" else range(row.start, until))
        ),
        key=lambda row: row[0],
    )
    columns = list(zip(*rows, strict=True)) or [()] * 5
    return Listing(
        title="collisions",
        columns=(
            ListColumn(heading="i", values=columns[1]),
            ListColumn(heading="j", values=columns[2]),
            ListColumn(heading="t", values=columns[0], kind="time"),
            ListColumn(heading="n", values=columns[3]),
            ListColumn(heading="kind", values=columns[4]),
        ),
        quantities=quantities,
    )


def count_conflicts_before(plan: Plan) -> list[int | None]:
    """Return the conflicts in the whole system before each decision of a plan's planner.

    Parameters
    ----------
    plan
        The plan.

    Returns
    -------
    list
        Ticks of overlap, and swaps unless the planner leaves them: first those of the free-running
        robots, then the conflicts that the decision before has left. None where robots were
        rerouted or have sizes, a collision never ends, or the planner did not count.
    """
    if plan.run.reroutes or not plan.scenario.problem.resources.are_points:
        return [None] * len(plan.run.decisions)
    tracks = free_running(plan)
    overlaps = find_collisions(plan.scenario, tracks)
    overlap = [conflict.end - conflict.start for conflict in overlaps if conflict.end is not None]
    leaves_swaps = plan.run.name == "paper" or plan.run.options.get("swaps") == "leave"
    counted = sum(overlap) + (0 if leaves_swaps else len(find_swaps(tracks)))
    first = counted if len(overlap) == len(overlaps) else None
    return [first, *map(count_conflicts_left, plan.run.decisions)][: len(plan.run.decisions)]


def count_conflicts_left(decision: Decision) -> int | None:
    """Return the conflicts in the whole system after a decision; None if they were not counted."""
    return decision.conflicts_left[decision.robots.index(decision.waits)]


def tabulate_decisions(plan: Plan, quantities: Quantities | None = None) -> Listing:
    """Return the decisions of a plan as a list: which robot waits, conflicts before and after.

    Parameters
    ----------
    plan
        The plan.
    quantities
        How times are written; by default as the scenario does.
    """
    names, place = [robot.name for robot in plan.scenario.robots], plan.scenario.roadmap.name
    decisions = plan.run.decisions

    def places(decision: Decision) -> str:
        ends = dict.fromkeys((decision.vertices[0], decision.vertices[-1]))
        return " to ".join(map(place, ends))

    left_if = [decision.conflicts_left for decision in decisions]
    sums = [decision.completion_sums or (None, None) for decision in decisions]
    return Listing(
        title="decisions",
        columns=(
            ListColumn(heading="no.", values=range(1, len(decisions) + 1), kind="number"),
            ListColumn(
                heading="time", values=[decision.tick for decision in decisions], kind="time"
            ),
            ListColumn(heading="place", values=list(map(places, decisions))),
            ListColumn(heading="i", values=[names[decision.robots[0]] for decision in decisions]),
            ListColumn(heading="j", values=[names[decision.robots[1]] for decision in decisions]),
            ListColumn(heading="waits", values=[names[decision.waits] for decision in decisions]),
            ListColumn(heading="in", values=[place(decision.waits_at) for decision in decisions]),
            ListColumn(
                heading="delay", values=[decision.ticks for decision in decisions], kind="time"
            ),
            ListColumn(heading="level", values=[decision.level for decision in decisions]),
            ListColumn(heading="before", values=count_conflicts_before(plan), kind="number"),
            ListColumn(heading="if i", values=[counts[0] for counts in left_if], kind="number"),
            ListColumn(heading="if j", values=[counts[1] for counts in left_if], kind="number"),
            ListColumn(
                heading="left", values=list(map(count_conflicts_left, decisions)), kind="number"
            ),
            ListColumn(
                heading="sum if i", values=[pair[0] for pair in sums], kind="time", for_people=False
            ),
            ListColumn(
                heading="sum if j", values=[pair[1] for pair in sums], kind="time", for_people=False
            ),
        ),
        quantities=quantities or Quantities.of(plan.scenario),
    )
