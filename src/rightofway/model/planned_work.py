"""The part of a plan that is about jobs: what robots do in which visits, and what nobody does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import zip_longest
from typing import get_args

import numpy as np

from rightofway.errors import InputError, InputFault, Steps, quote
from rightofway.model.planned_tour import PlannedItem, PlannedTour
from rightofway.model.route import Track
from rightofway.model.scenario import Scenario, assign_tours
from rightofway.model.stays import Stays, find_stays
from rightofway.model.units import NEVER, Tick
from rightofway.model.work import Job, Tour, TourItem, UnservedReason, Work
from rightofway.site import VertexId


def refuse_wrong_tours(
    scenario: Scenario,
    tracks: Sequence[Track],
    tours: Sequence[PlannedTour] | None,
    unserved: Sequence[tuple[int, UnservedReason]],
) -> None:
    """Refuse tours that are not of this scenario and these tracks.

    Raises
    ------
    InputError
        If tours are missing with jobs, or given without; for unknown visits, jobs, stops and
        reasons.
    """
    if scenario.jobs is None:
        if tours is not None or unserved:
            raise InputError.at("tours", "are for a scenario with jobs (leave them out)")
        return
    if tours is None or len(tours) != len(tracks):
        count = "no" if tours is None else len(tours)
        message = f"{count} tours for {len(tracks)} robots (give one for each, that may be empty)"
        raise InputError.at("tours", message)
    faults = [
        *_find_unknown_items(scenario.jobs, tracks, tours),
        *_find_unknown_jobs(scenario.jobs, unserved),
    ]
    if faults:
        raise InputError(faults)


def _find_unknown_items(
    jobs: Sequence[Job], tracks: Sequence[Track], tours: Sequence[PlannedTour]
) -> Iterator[InputFault]:
    for robot, (track, tour) in enumerate(zip(tracks, tours, strict=True)):
        for place, item in enumerate(tour):
            where: Steps = ("tours", robot, place)
            yield from _find_beyond((*where, "visit"), item.visit, len(track), "visits")
            if (item.job is None) != (item.stop is None):
                remedy = "give both for work, none for a charge"
                yield InputFault(where, f"has not both a job and a stop ({remedy})")
            elif item.job is not None and item.stop is not None:
                unknown = [*_find_beyond((*where, "job"), item.job, len(jobs), "jobs")]
                yield from unknown
                if not unknown:
                    n_stops = len(jobs[item.job].stops)
                    yield from _find_beyond((*where, "stop"), item.stop, n_stops, "stops")


def _find_unknown_jobs(
    jobs: Sequence[Job], unserved: Sequence[tuple[int, UnservedReason]]
) -> Iterator[InputFault]:
    for place, (job, reason) in enumerate(unserved):
        yield from _find_beyond(("unserved", place, "job"), job, len(jobs), "jobs")
        if reason not in get_args(UnservedReason):
            *others, last = get_args(UnservedReason)
            remedy = f"give {', '.join(others)} or {last}"
            yield InputFault(
                ("unserved", place, "reason"), f"{quote(reason)} is unknown ({remedy})"
            )


def _find_beyond(where: Steps, index: int, count: int, things: str) -> Iterator[InputFault]:
    if not 0 <= index < count:
        remedy = f"give 0 to {count - 1}" if count else "there are none"
        yield InputFault(where, f"{quote(index)} is none of {count} {things} ({remedy})")


def assign_plan(
    scenario: Scenario, tracks: Sequence[Track], tours: Sequence[PlannedTour]
) -> Scenario:
    """Return the scenario in which itineraries follow the tours of a plan."""
    return assign_tours(
        scenario,
        [
            tuple(_list_items(scenario, robot, track, tour))
            for robot, (track, tour) in enumerate(zip(tracks, tours, strict=True))
        ],
    )


def _list_items(
    scenario: Scenario, robot: int, track: Track, tour: PlannedTour
) -> Iterator[TourItem]:
    """Yield the items of a tour, and where a robot rests that drives on after them."""
    work, jobs = scenario.problem.work, scenario.jobs
    assert work is not None, "the scenario has jobs"
    assert jobs is not None, "the scenario has jobs"
    at = work.robots[robot].start
    for item in tour:
        at = VertexId(int(track.vertices[item.visit]))
        if item.job is not None and item.stop is not None:
            at = jobs[item.job].stops[item.stop].at
        duration = Tick(item.end - item.begin)
        yield TourItem(job=item.job, stop=item.stop, vertex=at, duration=duration)
    last = VertexId(int(track.vertices[-1]))
    if work.robots[robot].home is None and last != at:
        yield TourItem(job=None, stop=None, vertex=last, duration=Tick(0))


def time_tours(scenario: Scenario, tracks: Sequence[Track]) -> tuple[PlannedTour, ...]:
    """Return when each item of the tours of a scenario is done on tracks, as early as it can be.

    A charge lasts as long as the robot would wait otherwise. The tour of a robot ends before the
    first item that no visit is long enough for.
    """
    work = scenario.problem.work
    assert work is not None, "the scenario has jobs"
    assert scenario.tours is not None, "the scenario has tours"
    stays = find_stays(scenario, tracks)
    return tuple(
        tuple(
            _lengthen_charges(list(_time_items(tour, stay)), _list_latest(work, robot, track, stay))
        )
        for robot, (tour, track, stay) in enumerate(zip(scenario.tours, tracks, stays, strict=True))
    )


def _time_items(tour: Tour, stay: Stays) -> Iterator[PlannedItem]:
    """Yield the items of a tour that visits serve, without the vertex where the robot rests."""
    items = [item for item in tour if item.job is not None or item.duration]
    for item, visit, begin, end in zip(items, stay.serves, stay.begins, stay.ends, strict=False):
        yield PlannedItem(visit=visit, begin=begin, end=end, job=item.job, stop=item.stop)


def _list_latest(work: Work, robot: int, track: Track, stay: Stays) -> list[int]:
    """Return when the last item of each visit ends at the latest; NEVER for the last visit."""
    latest = np.append(track.enter[1:], NEVER) - stay.drive - stay.turns - work.robots[robot].turn
    latest[-1] = NEVER
    return [int(tick) for tick in latest]


def _lengthen_charges(
    placed: Sequence[PlannedItem], latest: Sequence[int]
) -> Iterator[PlannedItem]:
    """Yield items where charges last until the next item or the end of their visit."""
    for item, following in zip_longest(placed, placed[1:]):
        end = latest[item.visit]
        if following is not None and following.visit == item.visit:
            end = following.begin
        grows = item.job is None and end < NEVER
        yield replace(item, end=Tick(end)) if grows else item


def compute_service_cost(work: Work, tours: Sequence[PlannedTour]) -> Tick:
    """Return the value of `Objective.SERVICE`: service times and lateness by weights."""
    ends: dict[int, int] = {}
    for item in (item for tour in tours for item in tour):
        if item.job is not None:
            ends[item.job] = max(ends.get(item.job, 0), item.end)
    cost, (late, parts) = 0, work.late.as_integer_ratio()
    for number, end in ends.items():
        job = work.jobs[number]
        delay = 0 if job.due is None else max(0, end - job.due)
        cost += job.weight * (parts * (end - job.earliest) + late * delay)
    return Tick(cost)
