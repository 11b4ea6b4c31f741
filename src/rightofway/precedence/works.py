"""The works of the visits of a plan with jobs, and routes that last at least as long as they do.

A work begins when its robot is there, its time has come, and the works before it have ended: those
of its robot, and by `after` those of other robots. The wait until a robot is ready is a work of no
duration in its first visit.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import accumulate, chain
from typing import NamedTuple

import numpy as np

from rightofway import _core
from rightofway.model import (
    PlannedTour,
    Route,
    Scenario,
    Tick,
    Track,
    compute_drives_along,
    compute_turns_along,
)
from rightofway.model.planned_work import assign_plan
from rightofway.site import VertexId


class _Work(NamedTuple):
    """A work in a visit, with its duration and times [ticks], and the works before it."""

    visit: int
    ticks: int
    earliest: int
    planned: int
    before: list[tuple[int, int]]  # each a robot and a stage of it


def make_routes_of_tours(
    scenario: Scenario, tracks: Sequence[Track], tours: Sequence[PlannedTour]
) -> tuple[tuple[Route, ...], _core.VisitWorks]:
    """Return the routes of a plan with tours, and the works of their visits.

    The plan keeps the rules. A charge lasts as long as in the plan.
    """
    scenario = assign_plan(scenario, tracks, tours)
    routes = tuple(
        _make_route(scenario, robot, track, tour)
        for robot, (track, tour) in enumerate(zip(tracks, tours, strict=True))
    )
    return routes, _bind_works(scenario, tracks, tours)


def _make_route(scenario: Scenario, robot: int, track: Track, tour: PlannedTour) -> Route:
    work, itinerary = scenario.problem.work, scenario.problem.itineraries[robot]
    assert work is not None, "the scenario has jobs"
    vertices = [VertexId(vertex) for vertex in track.vertices.tolist()]
    dwell = compute_turns_along(scenario.roadmap, itinerary, track.vertices)
    for item in tour:
        dwell[item.visit] += item.end - item.begin
    dwell[sorted({item.visit for item in tour} - {len(track) - 1})] += work.robots[robot].turn
    drive = map(Tick, compute_drives_along(scenario.roadmap, itinerary, vertices))
    return Route(
        vertices=tuple(vertices),
        dwell=tuple(map(Tick, dwell.tolist())),
        drive=(Tick(0), *drive),
        serves=tuple(item.visit for item in tour),
    )


def _bind_works(
    scenario: Scenario, tracks: Sequence[Track], tours: Sequence[PlannedTour]
) -> _core.VisitWorks:
    by_robot = [list(_list_works(scenario, robot, tour)) for robot, tour in enumerate(tours)]
    works = list(chain.from_iterable(by_robot))
    # Stage k of a robot is the work after that of its readiness.
    firsts = [0, *accumulate(map(len, by_robot))]
    counts = [
        np.bincount([work.visit for work in own], minlength=len(track))
        for own, track in zip(by_robot, tracks, strict=True)
    ]
    before = [[firsts[robot] + 1 + stage for robot, stage in work.before] for work in works]
    ends = zip(scenario.problem.itineraries, tours, strict=True)
    return _core.VisitWorks(
        np.append(0, np.cumsum(np.concatenate(counts))).astype(np.int32),
        np.array([work.ticks for work in works], np.int64),
        np.array([work.earliest for work in works], np.int64),
        np.array([work.planned for work in works], np.int64),
        np.array([0, *accumulate(map(len, before))], np.int32),
        np.array(list(chain.from_iterable(before)), np.int32),
        np.array([robot.ends_anywhere and bool(tour) for robot, tour in ends], np.int32),
    )


def _list_works(scenario: Scenario, robot: int, tour: PlannedTour) -> Iterator[_Work]:
    problem = scenario.problem
    itinerary = problem.itineraries[robot]
    yield _Work(0, 0, itinerary.ready, itinerary.ready, [])
    for number, (item, stage) in enumerate(zip(tour, itinerary.stages, strict=False)):
        before = [arc.before for arc in problem.after if arc.after == (robot, number)]
        yield _Work(item.visit, item.end - item.begin, stage.earliest, item.begin, before)
