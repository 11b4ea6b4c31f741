"""The part of a plan that is about jobs: what robots do in which visits, and what nobody does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from typing import get_args

import numpy as np

from rightofway.errors import InputError, InputFault, Steps, quote
from rightofway.kinds.table import WHOLE, allow_none, coerce_fields
from rightofway.model.route import Track
from rightofway.model.scenario import Scenario, assign_tours
from rightofway.model.stays import Stays, find_stays
from rightofway.model.units import NEVER, Tick
from rightofway.model.work import Job, Tour, TourItem, UnservedReason, Work
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedItem:
    """Work at a stop of a job, or a charge, in a visit of a robot.

    Attributes
    ----------
    visit
        The visit of the robot, from 0.
    begin, end
        When it begins and ends [ticks].
    job, stop
        Index of the job, and of the stop among all its stops; None and None for a charge.

    Raises
    ------
    InputError
        With every value that is not a whole number.
    """

    visit: int
    begin: Tick
    end: Tick
    job: int | None = None
    stop: int | None = None

    def __post_init__(self) -> None:
        coerce_fields(
            self,
            "",
            visit=WHOLE,
            begin=WHOLE,
            end=WHOLE,
            job=allow_none(WHOLE),
            stop=allow_none(WHOLE),
        )


PlannedTour = tuple[PlannedItem, ...]
"""What a robot does, in order."""


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
    work, tours, after = scenario.problem.work, scenario.tours, scenario.problem.after
    assert work is not None, "the scenario has jobs"
    assert tours is not None, "the scenario has tours"
    stays = find_stays(scenario, tracks)
    timings = [_Timing.of(work, robot, tracks[robot], stays[robot]) for robot in range(len(tours))]
    floors: dict[tuple[int, int], int] = {}
    for _ in range(len(after) + 1):  # each pass settles what follows a settled item
        placed = [
            list(timing.place_items(tour, [floors.get((robot, k), 0) for k in range(len(tour))]))
            for robot, (timing, tour) in enumerate(zip(timings, tours, strict=True))
        ]
        ends: dict[tuple[int, int], int] = {}
        for arc in after:
            robot, stage = arc.before
            if stage < len(placed[robot]):
                ends[arc.after] = max(ends.get(arc.after, 0), placed[robot][stage].end)
        if ends == floors:
            break
        floors = ends
    return tuple(
        tuple(timing.lengthen_charges(items)) for timing, items in zip(timings, placed, strict=True)
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Timing:
    """The visits of one robot: where, and from when until when it may do something there."""

    work: Work
    vertices: Sequence[int]
    begins: Sequence[int]
    ends: Sequence[int]

    @classmethod
    def of(cls, work: Work, robot: int, track: Track, stays: Stays) -> _Timing:
        state = work.robots[robot]
        ends = np.append(track.enter[1:], NEVER) - stays.drive - stays.turns - state.turn
        ends[-1] = NEVER
        return cls(
            work=work,
            vertices=track.vertices.tolist(),
            begins=np.maximum(track.enter, state.ready).tolist(),
            ends=ends.tolist(),
        )

    def place_items(self, tour: Tour, floors: Sequence[int]) -> Iterator[PlannedItem]:
        """Yield the items of a tour, each in the first visit that it fits in.

        An item begins at its floor or later, one for each [ticks].
        """
        first = free = 0
        for item, floor in zip(tour, floors, strict=True):
            if item.job is None and not item.duration:
                continue  # where the robot rests
            free = max(free, floor, self._find_earliest(item))
            for visit in range(first, len(self.vertices)):
                begin = max(free, self.begins[visit])
                end = begin + item.duration
                if self.vertices[visit] == item.vertex and end <= self.ends[visit]:
                    break
            else:
                return
            yield PlannedItem(
                visit=visit, begin=Tick(begin), end=Tick(end), job=item.job, stop=item.stop
            )
            first, free = visit, end

    def _find_earliest(self, item: TourItem) -> Tick:
        if item.job is None or item.stop is None:
            return Tick(0)
        job = self.work.jobs[item.job]
        return job.stops[item.stop - job.first].earliest

    def lengthen_charges(self, placed: Sequence[PlannedItem]) -> Iterator[PlannedItem]:
        """Yield items where charges last until the next item or the end of their visit."""
        for item, following in zip_longest(placed, placed[1:]):
            end = self.ends[item.visit]
            if following is not None and following.visit == item.visit:
                end = following.begin
            grows = item.job is None and end < NEVER
            yield replace(item, end=Tick(end)) if grows else item
