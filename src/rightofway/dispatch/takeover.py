"""How the plan of a round takes over on a floor: the view that it is made from, and its splice.

Kept parts go first in the new order, so what robots have begun waits for nobody; the rest has the
order of a plan. Times only say who goes first.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice

import numpy as np

from rightofway.dispatch.floor import Pair, SimulatedFloor, StepToDo, VisitToCome, count_soc
from rightofway.dispatch.pool import PooledJob
from rightofway.dispatch.view import (
    FleetView,
    PlannedStep,
    RobotView,
    Round,
    StopsLater,
    make_whole_tracks,
)
from rightofway.model import NEVER, Scenario, Tick, Track
from rightofway.model.turning import compute_first_turns, find_heading_on_site, turn_towards
from rightofway.precedence import list_waits
from rightofway.site import VertexId

__all__ = [
    "cap_floor",
    "forecast_free",
    "lift_caps",
    "list_coming_visits",
    "look_at_floor",
    "make_step_to_do",
    "splice_round",
]


def look_at_floor(
    floor: SimulatedFloor,
    now: int,
    takeover: int,
    jobs: Mapping[str, PooledJob],
    later: Sequence[StopsLater] = (),
) -> FleetView:
    """Return the fleet as it is expected to be at the takeover.

    Parameters
    ----------
    floor
        The floor at ``now``.
    now, takeover
        When the round begins, and when its plan takes over [ticks].
    jobs
        The jobs of the pool.
    later
        What each robot does behind its route, as the last round had it.
    """
    ahead = floor.fork(now)
    ahead.advance(takeover)
    begun = [
        {own.job.name: own.begun for own in jobs.values() if own.robot == robot}
        for robot in range(len(floor.robots))
    ]
    for event in ahead.events:
        if not event.is_end:
            begun[event.robot][event.job] = event.stop + 1
    for own in begun:
        for name in [name for name, count in own.items() if count == len(jobs[name].job.stops)]:
            del own[name]
    robots = [
        _look_at_robot(floor, ahead, robot, (now, takeover), begun[robot])
        for robot in range(len(floor.robots))
    ]
    if any(_is_late(floor, robot, seen) for robot, seen in enumerate(robots)):
        robots = list(_expect_times(floor, robots, now, takeover))
    if later:
        rows = zip(robots, later, strict=True)
        robots = [replace(own, later=stops) for own, stops in rows]
    ends = ((name, max(0, end - takeover)) for name, end in ahead.ends.items() if name in jobs)
    return FleetView(
        now=Tick(now),
        takeover=Tick(takeover),
        robots=tuple(robots),
        ends=tuple((name, Tick(end)) for name, end in ends),
    )


def _look_at_robot(
    floor: SimulatedFloor,
    ahead: SimulatedFloor,
    robot: int,
    times: tuple[int, int],
    begun: Mapping[str, int],
) -> RobotView:
    own, (now, takeover) = ahead.robots[robot], times
    own.forget_before(now, floor.rules)
    free, soc = forecast_free(ahead, robot, takeover)
    rest = list(islice(floor.robots[robot].visits, own.first - floor.robots[robot].first, None))
    return RobotView(
        kept_track=Track.of(
            [at for at, _ in own.recent],
            [min(tick - takeover, NEVER) for _, tick in own.recent],
        ),
        last=own.first,
        n_steps=own.n_begun,
        free=Tick(free - takeover),
        heading=find_heading_on_site(_find_heading(ahead, robot, takeover), ahead.roadmap),
        soc=soc,
        begun=tuple(begun.items()),
        is_able=own.lost is None,
        track=Track.of(
            [visit.vertex for visit in rest],
            [0, *(visit.planned - takeover for visit in rest[1:])],
        ),
        steps=tuple(_list_rest(rest, own.n_begun)),
    )


def forecast_free(ahead: SimulatedFloor, robot: int, takeover: int) -> tuple[Tick, Fraction]:
    """Return when a robot is free, at the takeover or later, and its state of charge then.

    Parameters
    ----------
    ahead
        A forecast in which the robot has begun all that it keeps.
    robot
        Its number.
    takeover
        When a plan takes over [ticks].
    """
    own, state = ahead.robots[robot], ahead.states[robot]
    turn, battery = state.turn if own.has_worked else 0, state.battery
    free = own.free + turn
    if own.lost is not None:
        free = takeover
    elif own.charging is not None:  # a charge can be ended at any time
        free = own.recent[-1][1] + turn
    free = max(free, takeover)
    if battery is None:
        return Tick(free), Fraction(1)
    is_charging, until = own.charging is not None, free - turn
    ticks = max(0, until - own.counted)
    left = count_soc(battery, own.soc, ticks, is_charging=is_charging)
    left -= battery.on * (free - max(until, own.counted))
    return Tick(free), Fraction(max(left, 0), battery.full)


def _is_late(floor: SimulatedFloor, robot: int, seen: RobotView) -> bool:
    """Return whether a robot cannot begin its old track as early as planned, or has not yet."""
    own, track = floor.robots[robot], seen.track
    if track is None or len(track) == 1:
        return False
    coming = own.visits[seen.last - own.first + 1]
    return int(track.enter[1]) < seen.free + coming.turn + coming.drive


def _expect_times(
    floor: SimulatedFloor, robots: Sequence[RobotView], now: int, takeover: int
) -> Iterator[RobotView]:
    """Yield views whose old tracks have the times that are expected now."""
    expected = floor.fork(now)
    for own, seen in zip(expected.robots, robots, strict=True):
        own.cap = seen.last, seen.n_steps
    expected.advance(takeover)
    for own in expected.robots:
        own.cap, own.since = None, max(own.since, takeover)
    expected.advance(NEVER - 1)
    for own, seen in zip(expected.robots, robots, strict=True):
        assert seen.track is not None, "robots on a floor have a route"
        numbers = range(seen.last + 1, seen.last + len(seen.track))
        times = [own.enters.get(number, NEVER) - takeover for number in numbers]
        is_known = all(tick < NEVER - takeover for tick in times)
        track = Track.of(seen.track.vertices.tolist(), [0, *times]) if is_known else None
        yield replace(seen, track=track)


def _find_heading(floor: SimulatedFloor, robot: int, takeover: int) -> Fraction | None:
    """Return the heading of a robot that may be about to turn to its next edge."""
    own = floor.robots[robot]
    turning = floor.scenario.problem.itineraries[robot].turning
    is_bound = own.n_begun == len(own.visits[0].steps) and len(own.visits) > 1
    if turning is None or own.heading is None or not is_bound or own.visits[1].turn == 0:
        return own.heading
    began = max(own.free, own.since) + (floor.states[robot].turn if own.has_worked else 0)
    elapsed = min(takeover - began, own.visits[1].turn)
    towards = floor.find_heading(own.visits[1].edge)
    if elapsed <= 0 or towards is None:
        return own.heading
    return turn_towards(own.heading, towards, elapsed * turning.rate)


def _list_rest(rest: Sequence[VisitToCome], n_begun: int) -> Iterator[PlannedStep]:
    """Yield the steps of a route that have not begun; of their times only the order counts."""
    for number, visit in enumerate(rest):
        for step in visit.steps[n_begun if number == 0 else 0 :]:
            yield PlannedStep(
                visit=number,
                vertex=VertexId(visit.vertex),
                begin=Tick(0),
                end=Tick(0),
                job=step.job or None,
                stop=step.stop if step.job else None,
                least=Tick(0 if step.job else step.ticks),
            )


def cap_floor(floor: SimulatedFloor, view: FleetView) -> None:
    """Keep robots from beginning more than their kept parts until a plan takes over.

    Parameters
    ----------
    floor
        The floor.
    view
        The fleet as the round sees it.
    """
    for own, seen in zip(floor.robots, view.robots, strict=True):
        own.cap = seen.last, seen.n_steps


def lift_caps(floor: SimulatedFloor) -> None:
    """Let the old plan go on.

    Parameters
    ----------
    floor
        The floor.
    """
    for own in floor.robots:
        own.cap = None


def splice_round(
    floor: SimulatedFloor, view: FleetView, planned: Round, jobs: Mapping[str, PooledJob]
) -> None:
    """Let the plan of a round take over.

    Parameters
    ----------
    floor
        The floor at the takeover.
    view
        What the round was planned from.
    planned
        The round.
    jobs
        The jobs of the pool.
    """
    firsts = [own.last - len(own.kept_track) + 1 for own in view.robots]
    waits = defaultdict[Pair, list[Pair]](list)
    for robot, number, other, visit in list_waits(
        floor.scenario, make_whole_tracks(view, planned.tracks), firsts
    ):
        waits[robot, number].append((other, visit))
    for robot, (own, seen) in enumerate(zip(floor.robots, view.robots, strict=True)):
        route = list(islice(own.visits, seen.last - own.first + 1))
        if len(route) == 1:
            own.heading = floor.convert_heading(seen.heading)
        own.since, own.cap = view.takeover, None
        if own.charging is not None:
            own.free = min(own.free, view.takeover)
        steps = _place_steps(floor.scenario, planned.steps[robot], jobs)
        expected = (view.takeover + seen.kept_track.enter).tolist()[-len(route) :]
        coming = list_coming_visits(
            floor, robot, planned.tracks[robot], seen.heading, view.takeover
        )
        steps_at_end = (*route[-1].steps[: seen.n_steps], *steps[0])
        route = [visit._replace(planned=at) for visit, at in zip(route, expected, strict=True)]
        route[-1] = route[-1]._replace(steps=steps_at_end)
        route += (
            VisitToCome(*row, steps=tuple(steps.get(k, ()))) for k, row in enumerate(coming, 1)
        )
        own.visits = deque(
            visit._replace(waits=tuple(waits.get((robot, number), ())))
            for number, visit in enumerate(route, own.first)
        )
        own.forget_before(view.takeover, floor.rules)


def list_coming_visits(
    floor: SimulatedFloor, robot: int, track: Track, heading: Fraction | None, begin: int
) -> Iterator[tuple[int, int, int, int, int]]:
    """Yield the visits of a track behind its first one: the first values of each `VisitToCome`.

    Parameters
    ----------
    floor, robot
        The floor, and the number of the robot.
    track
        Its track.
    heading
        Where it begins, as `RobotState.heading` [degrees].
    begin
        When the times of the track begin [ticks].
    """
    roadmap, itinerary = floor.roadmap, floor.scenario.problem.itineraries[robot]
    edges = roadmap.find_edges(track.vertices[:-1], track.vertices[1:])
    drives = np.array(itinerary.edge_ticks, np.int64)[roadmap.class_of_edge[edges]].tolist()
    turns = [0] * len(edges)
    if itinerary.turning is not None and len(edges):
        turns[1:] = itinerary.turning.compute_turns(edges).tolist()
        start, at_start = int(track.vertices[0]), floor.convert_heading(heading)
        first = compute_first_turns(roadmap, itinerary.turning, start, at_start)
        turns[0] = first[int(edges[0]) - int(roadmap.indptr[start])] if first else 0
    planned = (begin + track.enter).tolist()
    rows = (track.vertices.tolist()[1:], planned[1:], edges.tolist(), turns, drives)
    yield from zip(*rows, strict=True)


def _place_steps(
    scenario: Scenario, steps: Sequence[PlannedStep], jobs: Mapping[str, PooledJob]
) -> Mapping[int, Sequence[StepToDo]]:
    """Return what is to do in each visit of a new track."""
    by_visit = defaultdict[int, list[StepToDo]](list)
    for step in steps:
        by_visit[step.visit].append(make_step_to_do(scenario, step, jobs))
    return by_visit


def make_step_to_do(
    scenario: Scenario, step: PlannedStep, jobs: Mapping[str, PooledJob]
) -> StepToDo:
    """Return work at a stop, or a charge, as a floor has it.

    Parameters
    ----------
    scenario
        The fleet.
    step
        What is planned.
    jobs
        The jobs of the pool.
    """
    if step.job is None or step.stop is None:
        return StepToDo(job="", stop=0, ticks=step.least)
    job, count = jobs[step.job].job, scenario.problem.clock.count_ticks
    stop = job.stops[step.stop]
    return StepToDo(
        job=job.name,
        stop=step.stop,
        ticks=count(stop.work),
        earliest=count(stop.earliest),
        after=job.after if step.stop == 0 else (),
        ends_job=step.stop == len(job.stops) - 1,
    )
