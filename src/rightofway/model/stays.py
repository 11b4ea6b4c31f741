"""The purpose of each visit of a fleet: work, turns, drives and waits; and costs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.model.itinerary import Itinerary
from rightofway.model.planned_tour import PlannedTour
from rightofway.model.problem import Problem
from rightofway.model.route import (
    Track,
    add_least_dwells,
    compute_first_turn,
    find_serving_visits,
)
from rightofway.model.scenario import Scenario
from rightofway.model.stage_times import StageTimes, find_stage_times
from rightofway.model.units import NEVER, Tick
from rightofway.site import Roadmap


class Hold(NamedTuple):
    """A robot stands at a stop until a job of another robot has ended.

    Attributes
    ----------
    visit
        Its visit.
    tick, ticks
        When it could begin its own work, and how long it waits then [ticks].
    for_robot
        The other robot.
    """

    visit: int
    tick: Tick
    ticks: Tick
    for_robot: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stays:
    """The visits of one robot.

    Attributes
    ----------
    dwell
        The least ticks of each visit before the robot drives on: the work and turning of the stages
        that it serves, and `turns`; int64, shape (n,). For the last visit: the work that is left to
        do there.
    drive
        Ticks of the edge that ends each visit, 0 for the last one; int64, shape (n,).
    waits
        Ticks of each visit beyond both, for the last one those of `holds`; int64, shape (n,).
    turns
        How long the robot turns on the spot between two edges, a part of `dwell`, 0 for the first
        visit and the last one; int64, shape (n,).
    serves
        The visit that serves each stage. It ends before the first stage that no visit serves.
    completion
        When the robot has entered its last vertex and done the work there; with its last work, if
        it may end anywhere [ticks].
    begins, ends
        In a scenario with jobs, when the work of each of these stages begins and ends [ticks]. Then
        `dwell` also holds the ticks until the robot is ready, and before works may begin.
    holds
        In a plan with jobs, the waits for jobs of other robots, in order; a part of `waits`.
    """

    dwell: NDArray[np.int64]
    drive: NDArray[np.int64]
    waits: NDArray[np.int64]
    turns: NDArray[np.int64]
    serves: tuple[int, ...]
    completion: Tick
    begins: tuple[Tick, ...] = ()
    ends: tuple[Tick, ...] = ()
    holds: tuple[Hold, ...] = ()


def find_stays(
    scenario: Scenario, tracks: Sequence[Track], tours: Sequence[PlannedTour] | None = None
) -> tuple[Stays, ...]:
    """Return the purpose of each visit of a fleet.

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot; they may break the rules.
    tours
        Of a plan with jobs: the items of each robot, with their visits. None: stages are served as
        early as visits last long enough.

    Notes
    -----
    Of tracks that break the rules, a move without an edge takes no time, and what comes after a
    missed stop is waiting. All tracks lie side by side in the arrays that the answer looks into.
    """
    visits = _measure_visits(scenario, tracks)
    if scenario.problem.has_times and tours is None:
        return _find_stays_in_time(
            scenario.problem, tracks, visits.owns, (visits.drive, visits.turns, visits.spare)
        )
    all_holds: list[tuple[Hold, ...]] = [()] * len(tracks)
    if tours is None:
        all_serves, dwell = _find_services(scenario, tracks, visits)
        completion = _complete(visits, dwell)
    else:
        all_serves = [[item.visit for item in tour] for tour in tours]
        dwell = np.zeros(len(visits.enter), np.int64)
        for robot, (own, track) in enumerate(zip(visits.owns, tracks, strict=True)):
            dwell[own], holds = _dwells_of_tour(scenario, robot, track, tours)
            all_holds[robot] = tuple(holds)
        completion = [
            _complete_tour(scenario, robot, track, tour)
            for robot, (track, tour) in enumerate(zip(tracks, tours, strict=True))
        ]
    waits = visits.spare - dwell
    waits[visits.lasts] = [
        sum(hold.ticks for hold in holds if hold.visit == len(track) - 1) if holds else 0
        for track, holds in zip(tracks, all_holds, strict=True)
    ]
    dwell += visits.turns
    return tuple(
        Stays(
            dwell=dwell[own],
            drive=visits.drive[own],
            waits=waits[own],
            turns=visits.turns[own],
            serves=tuple(serves),
            completion=Tick(done),
            holds=holds,
        )
        for own, serves, done, holds in zip(
            visits.owns, all_serves, completion, all_holds, strict=True
        )
    )


class _Visits(NamedTuple):
    """The visits of all tracks, robot after robot [ticks].

    ``owns`` and ``lasts`` are the visits and the last visit of each robot; ``spare`` is how long a
    visit lasts beyond its drive and its turn.
    """

    owns: list[slice]
    lasts: NDArray[np.int64]
    enter: NDArray[np.int64]
    drive: NDArray[np.int64]
    turns: NDArray[np.int64]
    spare: NDArray[np.int64]


def _measure_visits(scenario: Scenario, tracks: Sequence[Track]) -> _Visits:
    ends = np.cumsum([len(track) for track in tracks])
    enter = np.concatenate([track.enter for track in tracks])
    edges = _find_edges_of_fleet(scenario.roadmap, tracks, ends)
    stops = ends.tolist()
    owns = [slice(begin, end) for begin, end in pairwise([0, *stops])]
    drive = _measure_drives_of_fleet(scenario, np.diff(ends, prepend=0), edges)
    turns = np.zeros(len(enter), np.int64)
    for own, itinerary in zip(owns, scenario.problem.itineraries, strict=True):
        if itinerary.turning is not None:
            turns[own][1:] = itinerary.turning.compute_turns(edges[own])
            turns[own][0] = compute_first_turn(scenario.roadmap, itinerary, edges[own])
    spare = np.append(np.diff(enter), 0) - drive - turns
    spare[ends - 1] = NEVER
    return _Visits(owns, ends - 1, enter, drive, turns, spare)


def _find_services(
    scenario: Scenario, tracks: Sequence[Track], visits: _Visits
) -> tuple[list[list[int]], NDArray[np.int64]]:
    """Return the visits that serve the stages of each robot, and the work of each visit."""
    all_serves, dwell = [], np.zeros(len(visits.enter), np.int64)
    for own, track, itinerary in zip(
        visits.owns, tracks, scenario.problem.itineraries, strict=True
    ):
        serves = find_serving_visits(itinerary.stages, track.vertices, visits.spare[own])
        add_least_dwells(dwell[own], itinerary.stages, serves)
        all_serves.append(serves)
    return all_serves, dwell


def _complete(visits: _Visits, dwell: NDArray[np.int64]) -> list[int]:
    """Return when each robot has done its work in its last visit [ticks]."""
    done = (visits.enter + dwell + visits.turns)[visits.lasts]
    return [int(tick) for tick in done.tolist()]


def _dwells_of_tour(
    scenario: Scenario, robot: int, track: Track, tours: Sequence[PlannedTour]
) -> tuple[NDArray[np.int64], list[Hold]]:
    """Return the ticks of each visit in which nobody is in the way of the robot, and its holds.

    Work, charges, the turn at a stop, and the time until the robot is ready or its job may begin.
    """
    assert scenario.problem.work is not None, "tours are of jobs"
    state, jobs = scenario.problem.work.robots[robot], scenario.problem.work.jobs
    dwell, free, holds = np.zeros(len(track), np.int64), state.ready, list[Hold]()
    dwell[0] = state.ready
    for item in tours[robot]:
        arrived = max(free, int(track.enter[item.visit]))
        opens = arrived
        if item.job is not None and item.stop is not None:
            job = jobs[item.job]
            if item.stop >= job.first:
                earliest = job.stops[item.stop - job.first].earliest
                opens = max(arrived, min(item.begin, earliest))
            if item.stop == job.first:
                end, other = max((_find_end(tours, before) for before in job.after), default=(0, 0))
                if min(item.begin, end) > opens:
                    ticks = Tick(min(item.begin, end) - opens)
                    holds.append(Hold(item.visit, Tick(opens), ticks, other))
        dwell[item.visit] += opens - arrived + item.end - item.begin
        free = item.end
    left = sorted({item.visit for item in tours[robot] if item.visit < len(track) - 1})
    dwell[left] += state.turn
    return dwell, holds


def _find_end(tours: Sequence[PlannedTour], job: int) -> tuple[int, int]:
    """Return when a job ends [ticks], and the robot that does it; 0 and 0 for one without."""
    ends = (
        (item.end, robot) for robot, tour in enumerate(tours) for item in tour if item.job == job
    )
    return max(ends, default=(0, 0))


def _complete_tour(scenario: Scenario, robot: int, track: Track, tour: PlannedTour) -> Tick:
    """Return when a robot with a tour completes [ticks].

    It then rests; one that does not return home may still drive to make room.
    """
    assert scenario.problem.work is not None, "tours are of jobs"
    state = scenario.problem.work.robots[robot]
    end = max([state.ready, *(item.end for item in tour[-1:])])
    if tour and state.home is None:
        return end
    return max(end, Tick(int(track.enter[-1])))


def _find_stays_in_time(
    problem: Problem,
    tracks: Sequence[Track],
    owns: Sequence[slice],
    arrays: tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]],
) -> tuple[Stays, ...]:
    """Return the stays of a scenario with jobs, from drives, turns and spare ticks of visits."""
    drive, turns, spare = arrays
    leaves = [track.enter + spare[own] for track, own in zip(tracks, owns, strict=True)]
    for until in leaves:
        until[-1] = NEVER
    all_times = find_stage_times(problem, tracks, [until.tolist() for until in leaves])
    all_stays = []
    for itinerary, track, own, times in zip(
        problem.itineraries, tracks, owns, all_times, strict=True
    ):
        dwell = _compute_dwells(itinerary, track, times)
        waits = spare[own] - dwell
        waits[-1] = 0
        done = max(int(track.enter[-1]), itinerary.ready) if not times.ends else times.ends[-1]
        if not itinerary.ends_anywhere:
            done = int(track.enter[-1] + dwell[-1])
        stays = Stays(
            dwell=dwell + turns[own],
            drive=drive[own],
            waits=waits,
            turns=turns[own],
            serves=times.serves,
            completion=Tick(done),
            begins=times.begins,
            ends=times.ends,
        )
        all_stays.append(stays)
    return tuple(all_stays)


def _compute_dwells(itinerary: Itinerary, track: Track, times: StageTimes) -> NDArray[np.int64]:
    """Return the ticks until each visit has served its stages and the robot has turned for that."""
    done = np.maximum(track.enter, itinerary.ready)
    for visit, end, stage in zip(times.serves, times.ends, itinerary.stages, strict=False):
        done[visit] = end + (stage.turn if visit < len(track) - 1 else 0)
    dwell: NDArray[np.int64] = done - track.enter
    return dwell


def compute_drives(scenario: Scenario, tracks: Sequence[Track]) -> NDArray[np.int64]:
    """Return the ticks of the edge that ends each visit of a fleet, robot after robot."""
    ends = np.cumsum([len(track) for track in tracks])
    edges = _find_edges_of_fleet(scenario.roadmap, tracks, ends)
    return _measure_drives_of_fleet(scenario, np.diff(ends, prepend=0), edges)


def compute_completions(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Tick, ...]:
    """Return the completion time of each robot [ticks].

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    if scenario.problem.has_times:
        return tuple(stay.completion for stay in find_stays(scenario, tracks))
    visits = _measure_visits(scenario, tracks)
    _, dwell = _find_services(scenario, tracks, visits)
    return tuple(map(Tick, _complete(visits, dwell)))


def compute_flowtime(scenario: Scenario, tracks: Sequence[Track]) -> Tick:
    """Return the sum of the robots' completion times [ticks].

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    return Tick(sum(compute_completions(scenario, tracks)))


def compute_cost(scenario: Scenario, tracks: Sequence[Track]) -> Tick:
    """Return the objective of planners: the costs of all robots, by their weights [ticks].

    Parameters
    ----------
    scenario
        The problem.
    tracks
        One track for each robot.
    """
    costs = zip(scenario.problem.itineraries, compute_costs(scenario, tracks), strict=True)
    return Tick(sum(itinerary.weight * cost for itinerary, cost in costs))


def compute_service(scenario: Scenario, tracks: Sequence[Track]) -> Tick:
    """Return the costs of the ends of stages, by their weights [ticks over ``late.denominator``].

    These are service times and lateness of the jobs in the tours of a scenario, apart from what no
    plan changes. Each track serves all stages of its robot.
    """
    work, cost = scenario.problem.work, 0
    assert work is not None, "the scenario has jobs"
    late, parts = work.late.as_integer_ratio()
    for itinerary, stay in zip(
        scenario.problem.itineraries, find_stays(scenario, tracks), strict=True
    ):
        for stage, end in zip(itinerary.stages, stay.ends, strict=False):
            delay = 0 if stage.due is None else max(0, end - stage.due)
            cost += stage.weight * (parts * end + late * delay)
    return Tick(cost)


def compute_costs(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Tick, ...]:
    """Return the completion time of each robot and the surcharges of its edges [ticks]."""
    costs, roadmap = compute_completions(scenario, tracks), scenario.roadmap
    if not roadmap.has_surcharges:
        return costs
    more = []
    for itinerary, track in zip(scenario.problem.itineraries, tracks, strict=True):
        edges = roadmap.find_edges(track.vertices[:-1], track.vertices[1:])
        by_class = np.array(itinerary.surcharges, np.int64)
        more.append(by_class[roadmap.class_of_edge[edges]].sum())
    return tuple(Tick(cost + int(extra)) for cost, extra in zip(costs, more, strict=True))


def _find_edges_of_fleet(
    roadmap: Roadmap, tracks: Sequence[Track], ends: NDArray[np.int64]
) -> NDArray[np.int32]:
    """Return the edge after each visit of all tracks, -1 where there is none; int32."""
    vertices = np.concatenate([track.vertices for track in tracks])
    vertices[(vertices < 0) | (vertices >= roadmap.n_vertices)] = -1
    edges = np.append(roadmap.find_edges(vertices[:-1], vertices[1:]), np.int32(-1))
    edges[vertices < 0] = -1
    edges[ends - 1] = -1
    return edges


def _measure_drives_of_fleet(
    scenario: Scenario, lengths: NDArray[np.int64], edges: NDArray[np.int32]
) -> NDArray[np.int64]:
    """Return the ticks of the edge after each visit of all tracks, 0 where there is none."""
    roadmap, itineraries = scenario.roadmap, scenario.problem.itineraries
    row = {
        pace: k for k, pace in enumerate({itinerary.edge_ticks: None for itinerary in itineraries})
    }
    by_class = np.array([[*pace, 0] for pace in row], np.int64)  # the last column: no edge
    class_of_edge = np.append(roadmap.class_of_edge, -1)
    rows = np.repeat([row[itinerary.edge_ticks] for itinerary in itineraries], lengths)
    drives: NDArray[np.int64] = by_class[rows, class_of_edge[edges]]
    return np.maximum(drives, 0)  # -1: a track that drives along an edge where it is barred
