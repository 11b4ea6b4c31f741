"""The visits of a plan as a list for people and programs: robot, place, time, purpose.

A visit is one row: a robot enters a place, works or turns there, perhaps waits for another
robot, and leaves. `make_event_columns` is the one table of which `Plan.to_dataframe`, files and
reports are made.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from rightofway.errors import NoPlanExists
from rightofway.facts import Fact
from rightofway.metrics.lost_time import compute_lost_time, join_waits
from rightofway.model import Loss, Plan, PlannedItem, Scenario, Stays, Tick
from rightofway.site import VertexId


class Event(NamedTuple):
    """One visit of one robot.

    Attributes
    ----------
    robot
        Its index.
    visit
        The number of the visit, from 0.
    vertex
        Where it is.
    purposes
        The activities of the robot there, in order.
    enter
        When the visit begins [ticks].
    leave
        When the robot is in its next vertex [ticks]; None for its last visit.
    waits
        The time of its waits [ticks].
    waits_for
        The robot that it waits for, by index; None if no robot is the cause.
    to_leave
        The vertex that this robot has to leave first: the next one, or one further on the route;
        for waits that follow one another behind one robot, that of the last wait.
    """

    robot: int
    visit: int
    vertex: VertexId
    purposes: tuple[Fact, ...]
    enter: Tick
    leave: Tick | None
    waits: Tick
    waits_for: int | None
    to_leave: VertexId | None

    @property
    def purpose(self) -> str:
        """The activities in English.

        ``home``, ``work at stop 1, turn``, ``stop 2 of lap 3``, ``turn``, ``drive through``,
        ``make room``, or ``wait`` where the robot only waits. With jobs, ``work at stop 1 of J2``,
        ``charge``, and ``start`` where it begins elsewhere than at home.
        """
        return ", ".join(map(_tell_purpose, self.purposes))


@lru_cache(maxsize=4096)
def _tell_purpose(purpose: Fact) -> str:
    """Return an activity in English; the same few are at most visits."""
    return str(purpose)


HOME, START, CHARGE, TURN, WAIT, MAKE_ROOM, DRIVE_THROUGH = (
    Fact(f"purpose {word}")
    for word in ("home", "start", "charge", "turn", "wait", "make room", "drive through")
)
"""Activities without values."""


def list_events(plan: Plan) -> tuple[Event, ...]:
    """Return the visits of all robots, by robot and in order.

    Parameters
    ----------
    plan
        A plan that keeps the rules; of others, the claims of the tracks.
    """
    stays = plan.stays
    try:
        losses = [loss for lost in compute_lost_time(plan) for loss in lost.losses]
    except NoPlanExists:  # a robot has no way, so nothing is known but its waits
        losses = list(join_waits(plan.scenario, plan.tracks, stays))
    of_robot: list[list[Loss]] = [[] for _ in stays]
    for loss in losses:
        of_robot[loss.robot].append(loss)
    return tuple(
        event
        for robot, stay in enumerate(stays)
        for event in _list_events_of(plan, robot, stay, of_robot[robot])
    )


def _list_events_of(plan: Plan, robot: int, stay: Stays, losses: Sequence[Loss]) -> Iterator[Event]:
    track = plan.tracks[robot]
    if plan.tours is None:
        purposes = _list_purposes(plan.scenario, robot, stay, len(track))
    else:
        purposes = _list_purposes_of_tour(plan, robot, plan.tours[robot])
    enters = track.enter.tolist()
    waited = [loss for loss in losses if loss.kind != "makes room"]
    room = [loss for loss in losses if loss.kind == "makes room"]
    waits_for = {hold.visit: hold.for_robot for hold in stay.holds}
    columns = (track.vertices, stay.dwell, stay.waits, stay.turns)
    rows = zip(*(column.tolist() for column in columns), strict=True)
    for visit, (vertex, dwell, waiting, turns) in enumerate(rows):
        reason = _find_holding(waited, enters[visit] + dwell) if waiting else None
        idle = MAKE_ROOM if _find_holding(room, enters[visit]) else DRIVE_THROUGH
        doing = purposes.get(visit) or (WAIT if waiting else idle,)
        if turns and doing[-1] != TURN:
            doing = (TURN,) if doing == (DRIVE_THROUGH,) else (*doing, TURN)
        yield Event(
            robot=robot,
            visit=visit,
            vertex=VertexId(vertex),
            purposes=doing,
            enter=Tick(enters[visit]),
            leave=Tick(enters[visit + 1]) if visit + 1 < len(enters) else None,
            waits=Tick(waiting),
            waits_for=waits_for.get(visit) if reason is None else reason.for_robot,
            to_leave=None if reason is None else reason.freed,
        )


def _find_holding(losses: Sequence[Loss], tick: int) -> Loss | None:
    """Return the loss that a tick is in; they are in order of time and do not overlap."""
    index = bisect_right(losses, tick, key=lambda loss: loss.tick) - 1
    return losses[index] if index >= 0 and tick < losses[index].end else None


def _list_purposes(
    scenario: Scenario, robot: int, stay: Stays, n_visits: int
) -> dict[int, tuple[Fact, ...]]:
    """Return the activities of a robot in its visits, except drives through."""
    stages, n_stops = scenario.problem.itineraries[robot].stages, len(scenario.robots[robot].stops)
    ends_at_home = (scenario.robots[robot].ends or scenario.rules.ends) == "home"
    per_lap = n_stops + ends_at_home
    laps = len(stages) // per_lap
    parts: dict[int, list[Fact]] = {0: [HOME]}
    turning = set()
    for number, (stage, visit) in enumerate(zip(stages, stay.serves, strict=False)):
        lap, place = divmod(number, per_lap)
        if place == n_stops:
            stop = HOME
        elif laps > 1:
            stop = Fact("purpose stop of lap", number=place + 1, lap=lap + 1)
        else:
            stop = Fact("purpose stop", number=place + 1)
        doing = Fact("purpose work", place=stop) if stage.work else stop
        if doing not in parts.setdefault(visit, []):
            parts[visit].append(doing)
        if stage.turn and visit < n_visits - 1:
            turning.add(visit)
    return _add_turns(parts, turning)


def _list_purposes_of_tour(
    plan: Plan, robot: int, tour: Sequence[PlannedItem]
) -> dict[int, tuple[Fact, ...]]:
    """Return the activities of a robot with a tour in its visits, except drives through."""
    work, jobs = plan.scenario.problem.work, plan.scenario.jobs
    assert work is not None, "tours are of jobs"
    assert jobs is not None, "tours are of jobs"
    vertices, bound = plan.tracks[robot].vertices.tolist(), work.robots[robot]
    last, home = len(vertices) - 1, plan.scenario.robots[robot].home
    parts: dict[int, list[Fact]] = {0: [HOME if vertices[0] == home else START]}
    for item in tour:
        doing = CHARGE
        if item.job is not None and item.stop is not None:
            doing = Fact("purpose stop of job", number=item.stop + 1, job=jobs[item.job].name)
            if item.end > item.begin:
                doing = Fact("purpose work", place=doing)
        parts.setdefault(item.visit, []).append(doing)
    if bound.home is not None and last not in parts:
        parts[last] = [HOME]
    return _add_turns(parts, {item.visit for item in tour if bound.turn and item.visit < last})


def _add_turns(
    parts: Mapping[int, Sequence[Fact]], turning: Container[int]
) -> dict[int, tuple[Fact, ...]]:
    return {
        visit: (*doing, TURN) if visit in turning else tuple(doing)
        for visit, doing in parts.items()
    }


def make_event_columns(plan: Plan, chosen: Iterable[Event] | None = None) -> dict[str, list[Any]]:
    """Return visits as named columns, for a data frame or a file.

    Parameters
    ----------
    plan
        The plan.
    chosen
        Visits of it; all by default.

    Returns
    -------
    dict
        ``robot``, ``vertex``, ``purpose``, ``waits_for`` (a robot) and ``to_leave`` (a vertex) are
        names; ``visit`` is a number from 0; ``enter``, ``leave`` and ``waits`` are floats [time
        unit]; ``enter_tick``, ``leave_tick`` and ``wait_ticks`` are the exact values [ticks]. A
        last visit has no ``leave``, a visit without a reason to wait no ``waits_for``.
    """
    rows: Sequence[Event] = tuple(list_events(plan) if chosen is None else chosen)
    scenario, tick = plan.scenario, plan.scenario.problem.clock.tick
    names = [robot.name for robot in scenario.robots]
    place = scenario.roadmap.name

    def times(ticks: Iterable[Tick | None]) -> list[float | None]:
        return [None if instant is None else float(instant * tick) for instant in ticks]

    return {
        "robot": [names[row.robot] for row in rows],
        "visit": [row.visit for row in rows],
        "vertex": [place(row.vertex) for row in rows],
        "purpose": [row.purpose for row in rows],
        "enter": times(row.enter for row in rows),
        "leave": times(row.leave for row in rows),
        "waits": times(row.waits for row in rows),
        "waits_for": [None if row.waits_for is None else names[row.waits_for] for row in rows],
        "to_leave": [None if row.to_leave is None else place(row.to_leave) for row in rows],
        "enter_tick": [row.enter for row in rows],
        "leave_tick": [row.leave for row in rows],
        "wait_ticks": [row.waits for row in rows],
    }
