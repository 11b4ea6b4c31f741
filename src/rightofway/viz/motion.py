"""The activity of each robot at any instant of a plan, and the vertices between which it is drawn.

A robot stays at *u* for the edge's ticks and then, at one instant, is at *w*. It is drawn on the
edge during those ticks: a visit is work, turning, waiting, and at last the drive.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

from rightofway.model import NEVER, Plan, PlannedItem, PlannedTour, Stage, Tick, Track
from rightofway.site import VertexId


class Phase(Enum):
    """The activity of a robot."""

    DRIVE = "drive"
    WAIT = "wait"
    WORK = "work"
    TURN = "turn"
    DONE = "done"


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """One robot at one instant, between two vertices; tail is head while it does not drive."""

    tail: int
    head: int
    activity: Phase
    share: float  # of the activity that is over, 0 to 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Trip:
    """A track with the activities of the robot during each visit."""

    vertices: tuple[int, ...]  # as they are drawn
    enter: tuple[int, ...]  # when each visit begins [ticks]
    drive: tuple[int, ...]  # of the edge into each visit, 0 for the first [ticks]
    stages: tuple[Stage, ...]
    served: tuple[int, ...]  # the visit that serves each stage, -1 for one that is left out
    turns: tuple[Tick, ...] = ()  # on the spot in each visit [ticks]; empty if that takes no time

    def locate(self, tick: float) -> Moment:
        """Return where the robot is at an instant."""
        visit = max(bisect_right(self.enter, tick) - 1, 0)
        vertex = self.vertices[visit]
        for begin, end, activity in self.trace_phases(visit):
            if tick < end:
                head = self.vertices[visit + 1] if activity is Phase.DRIVE else vertex
                share = (tick - begin) / (end - begin)
                return Moment(tail=vertex, head=head, activity=activity, share=share)
        return Moment(tail=vertex, head=vertex, activity=Phase.DONE, share=1.0)

    def trace_phases(self, visit: int) -> Iterator[tuple[int, int, Phase]]:
        """Yield (begin, end, activity) of a visit, in order, without empty ones."""
        now, last = self.enter[visit], visit == len(self.vertices) - 1
        leave = NEVER if last else self.enter[visit + 1]
        departure = NEVER if last else max(leave - self.drive[visit + 1], now)
        served = (stage for stage, at in zip(self.stages, self.served, strict=True) if at == visit)
        duties = [
            (ticks, activity, stage.earliest)
            for stage in served
            for ticks, activity in ((stage.work, Phase.WORK), (stage.turn, Phase.TURN))
            if not (last and activity is Phase.TURN)
        ]
        if self.turns:
            duties.append((self.turns[visit], Phase.TURN, Tick(0)))
        for ticks, activity, earliest in duties:
            if now < earliest < departure:
                yield now, earliest, Phase.WAIT
                now = earliest
            end = min(now + ticks, departure)
            if end > now:
                yield now, end, activity
            now = end
        if not last and departure > now:
            yield now, departure, Phase.WAIT
        if not last and leave > departure:
            yield departure, leave, Phase.DRIVE

    def trace_all_phases(self) -> Iterator[tuple[int, int, int, Phase]]:
        """Yield (visit, begin, end, activity) of the whole trip, in order."""
        for visit in range(len(self.vertices)):
            for begin, end, activity in self.trace_phases(visit):
                yield visit, begin, end, activity


def make_trips(plan: Plan) -> tuple[Trip, ...]:
    """Return the trip of each robot."""
    trips = []
    stays_of_all = plan.stays
    itineraries = plan.scenario.problem.itineraries
    for robot, (track, stays, itinerary) in enumerate(
        zip(plan.tracks, stays_of_all, itineraries, strict=True)
    ):
        missed = len(itinerary.stages) - len(stays.serves)
        stages, served = itinerary.stages, (*stays.serves, *[-1] * missed)
        if plan.tours is not None:
            stages, served = _follow_tour(plan, robot, track, plan.tours[robot])
        trip = Trip(
            vertices=tuple(map(plan.scenario.roadmap.get_drawn, track.vertices.tolist())),
            enter=tuple(track.enter.tolist()),
            drive=(0, *stays.drive[:-1].tolist()),
            stages=stages,
            served=served,
            turns=() if itinerary.turning is None else tuple(map(Tick, stays.turns.tolist())),
        )
        trips.append(trip)
    return tuple(trips)


def _follow_tour(
    plan: Plan, robot: int, track: Track, tour: PlannedTour
) -> tuple[tuple[Stage, ...], tuple[int, ...]]:
    """Return the items of a tour as stages that begin when they do, and a last one: the rest.

    A visit turns once, after its last item.
    """
    work = plan.scenario.problem.work
    assert work is not None, "tours are of jobs"
    last = len(track) - 1
    rest = PlannedItem(visit=last, begin=Tick(0), end=Tick(0))
    stages = tuple(
        Stage(
            vertex=VertexId(int(track.vertices[min(item.visit, last)])),
            work=Tick(item.end - item.begin),
            turn=Tick(0) if after.visit == item.visit else work.robots[robot].turn,
            earliest=item.begin,
        )
        for item, after in pairwise((*tour, rest, rest))
    )
    return stages, tuple(item.visit if item.visit <= last else -1 for item in (*tour, rest))


def end_of(trips: Sequence[Trip]) -> int:
    """Return the tick from which on nothing happens any more."""
    ends = (end for trip in trips for _, end, _ in trip.trace_phases(len(trip.vertices) - 1))
    return max([*(trip.enter[-1] for trip in trips), *ends])
