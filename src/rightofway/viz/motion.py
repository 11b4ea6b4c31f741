"""Who is where and what do they do, at any instant of a plan, for the eye.

A robot stays at *u* for the edge's ticks and then, at one instant, is at *w*. For the eye it drives
along the edge during those ticks: a visit is work, turning, waiting, and at last the drive.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

from rightofway.model import Itinerary, Plan, Stage, Stays, Track, stays_of

__all__ = ["Activity", "Moment", "Trip", "end_of", "trips_of"]


class Activity(Enum):
    """What a robot does."""

    DRIVE = "drive"
    WAIT = "wait"
    WORK = "work"
    TURN = "turn"
    DONE = "done"


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """One robot at one instant.

    Attributes
    ----------
    tail, head
        The vertices it is between; the same while it does not drive.
    activity
        What it does.
    share
        How much of that is over, 0 to 1.
    """

    tail: int
    head: int
    activity: Activity
    share: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Trip:
    """A track with what the robot does during each visit.

    Attributes
    ----------
    vertices
        The route.
    enter
        When each visit begins [ticks].
    drive
        Ticks of the edge driven into each visit; 0 for the first.
    stages
        What the robot has to do.
    served
        The visit that serves each stage, -1 for a stage that the track leaves out.
    """

    vertices: tuple[int, ...]
    enter: tuple[int, ...]
    drive: tuple[int, ...]
    stages: tuple[Stage, ...]
    served: tuple[int, ...]

    def at(self, tick: float) -> Moment:
        """Return where the robot is at an instant."""
        visit = max(bisect_right(self.enter, tick) - 1, 0)
        here = self.vertices[visit]
        for begin, end, activity in self.phases(visit):
            if tick < end:
                head = self.vertices[visit + 1] if activity is Activity.DRIVE else here
                share = (tick - begin) / (end - begin)
                return Moment(tail=here, head=head, activity=activity, share=share)
        return Moment(tail=here, head=here, activity=Activity.DONE, share=1.0)

    def phases(self, visit: int) -> Iterator[tuple[int, int, Activity]]:
        """Yield (begin, end, activity) of a visit, in order, without empty ones."""
        last = visit == len(self.vertices) - 1
        now = self.enter[visit]
        leave = None if last else self.enter[visit + 1]
        go = None if leave is None else max(leave - self.drive[visit + 1], now)
        for length, activity in self._duties(visit, last=last):
            end = now + length if go is None else min(now + length, go)
            if end > now:
                yield now, end, activity
            now = end
        if go is not None and leave is not None:
            yield from (
                phase
                for phase in ((now, go, Activity.WAIT), (go, leave, Activity.DRIVE))
                if phase[1] > phase[0]
            )

    def _duties(self, visit: int, *, last: bool) -> Iterator[tuple[int, Activity]]:
        for stage, served in zip(self.stages, self.served, strict=True):
            if served == visit:
                yield stage.work, Activity.WORK
                yield (0 if last else stage.turn), Activity.TURN


def trips_of(plan: Plan) -> tuple[Trip, ...]:
    """Return the trip of each robot."""
    stays = stays_of(plan.scenario, plan.tracks)
    itineraries = plan.scenario.problem.itineraries
    return tuple(map(_trip, plan.tracks, stays, itineraries))


def end_of(trips: Sequence[Trip]) -> int:
    """Return the tick from which on nothing happens any more."""
    ends = (end for trip in trips for _, end, _ in trip.phases(len(trip.vertices) - 1))
    return max([*(trip.enter[-1] for trip in trips), *ends])


def _trip(track: Track, stays: Stays, itinerary: Itinerary) -> Trip:
    unserved = len(itinerary.stages) - len(stays.serves)
    return Trip(
        vertices=tuple(track.vertices.tolist()),
        enter=tuple(track.enter.tolist()),
        drive=(0, *stays.drive[:-1].tolist()),
        stages=itinerary.stages,
        served=(*stays.serves, *[-1] * unserved),
    )
