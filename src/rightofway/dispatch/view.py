"""The input and the result of a round: the fleet forecast for the takeover, and a plan behind it.

A round begins at `FleetView.now`; its plan takes over at `FleetView.takeover`. Until then the old
plan stands. Each robot keeps the part of its route that it has begun by then, its *kept part*, and
the round plans what comes behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

import numpy as np

from rightofway.facts import Fact
from rightofway.model import Tick, Track, UnservedReason
from rightofway.site import VertexId

__all__ = ["FleetView", "PlannedStep", "RobotView", "Round", "StopsLater", "make_whole_tracks"]

StopsLater = tuple[tuple[str, int], ...]
"""Names of jobs, each with the index of a stop: the tour behind the end of a track, in order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedStep:
    """Work at a stop of a job, or a charge, in a visit of a robot.

    Attributes
    ----------
    visit
        Index in the track that the step belongs to.
    vertex
        Where.
    begin, end
        From the takeover [ticks].
    job, stop
        Name of the job, and index of the stop among all its stops; None and None for a charge.
    least
        The least duration of a charge [ticks]; it continues while the robot would wait.
    """

    visit: int
    vertex: VertexId
    begin: Tick
    end: Tick
    job: str | None = None
    stop: int | None = None
    least: Tick = field(default=Tick(0))


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotView:
    """The state of one robot at the begin of a round.

    Attributes
    ----------
    kept_track
        The kept part, from the vertex on at which the robot has arrived when the round begins; at
        least that vertex. Times count from the takeover; those to come are forecast [ticks].
    last, n_steps
        The number of the last visit of the kept part in the route of the robot, and how many works
        and charges in it are kept.
    free
        When the robot is expected to have arrived at the end of the kept part, and to have done
        its work there, from the takeover [ticks], not negative.
    heading
        As `RobotState.heading`, at the end of the kept part [degrees].
    soc
        The state of charge then, forecast, from 0 to 1.
    begun
        Names of jobs that the robot has begun and not ended when it is free, each with the number
        of its first stops that are done then.
    is_able
        Whether it can drive; if not, what it holds is a closure.
    track, steps
        The rest of the old plan: the route from the end of the kept part on, which is its first
        vertex, and the work along it. None and nothing without an old plan.
    later
        The stops of the old tour behind that.
    """

    kept_track: Track
    last: int = 0
    n_steps: int = 0
    free: Tick = field(default=Tick(0))
    heading: Fraction | None = None
    soc: Fraction = Fraction(1)
    begun: tuple[tuple[str, int], ...] = ()
    is_able: bool = True
    track: Track | None = None
    steps: tuple[PlannedStep, ...] = ()
    later: StopsLater = ()

    @property
    def at(self) -> VertexId:
        """The vertex at the end of the kept part."""
        return VertexId(int(self.kept_track.vertices[-1]))


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetView:
    """The state of the fleet at the begin of a round.

    Attributes
    ----------
    now, takeover
        When the round begins, and when its plan takes over, from the start of the shift [ticks].
    robots
        One for each robot of the scenario.
    ends
        Forecast ends of jobs that end in kept parts, by name, from the takeover [ticks]: jobs
        after them begin then or later.
    closed
        Edges that robots shall not enter, tail and head.
    """

    now: Tick
    takeover: Tick
    robots: tuple[RobotView, ...]
    ends: tuple[tuple[str, Tick], ...] = ()
    closed: frozenset[tuple[int, int]] = frozenset()

    @property
    def is_open(self) -> bool:
        """Whether nothing is closed, and all robots can drive."""
        return not self.closed and all(robot.is_able for robot in self.robots)

    def ignore_closures(self) -> FleetView:
        """Return the fleet as if nothing was closed, and all robots could drive.

        A plan of it always lets robots drive that have nothing to do with what is closed; the
        others wait before it, and behind robots that do not go on.
        """
        able = tuple(replace(robot, is_able=True) for robot in self.robots)
        return replace(self, robots=able, closed=frozenset())


@dataclass(frozen=True, slots=True, kw_only=True)
class Round:
    """The plan of a round.

    Attributes
    ----------
    tracks
        For each robot its route behind the kept part, from the end of that on. Times count from
        the takeover [ticks]; they order, and robots may be later.
    steps
        For each robot its work and charges along that route.
    unserved
        Names of the jobs that the round has tried and that no robot does in it, with reasons.
    postponed
        Names of the jobs that are left to later rounds.
    later
        For each robot the stops behind the end of its track: a later round plans the routes, before
        the robot comes there. Empty: no robot does.
    stands
        Whether the old plan stays valid, because no better one was found.
    is_hurried
        Whether many robots keep their old tours for lack of time: the next round needs more.
    facts
        The facts to report.
    seconds
        How long it took [s].
    """

    tracks: tuple[Track, ...]
    steps: tuple[tuple[PlannedStep, ...], ...]
    unserved: tuple[tuple[str, UnservedReason], ...] = ()
    postponed: tuple[str, ...] = ()
    later: tuple[StopsLater, ...] = ()
    stands: bool = False
    is_hurried: bool = False
    facts: tuple[Fact, ...] = ()
    seconds: float = 0.0


def make_whole_tracks(view: FleetView, tracks: Sequence[Track]) -> list[Track]:
    """Return kept parts with new tracks behind them, at times in the order of the whole.

    Parameters
    ----------
    view
        The fleet.
    tracks
        For each robot its track from the end of its kept part on.
    """
    latest = max(int(own.kept_track.enter[-1]) for own in view.robots if own.is_able)
    return [
        Track(
            vertices=np.concatenate((own.kept_track.vertices, track.vertices[1:])),
            enter=np.concatenate(
                (np.minimum(own.kept_track.enter, latest) - latest - 1, track.enter[1:])
            ),
        )
        for own, track in zip(view.robots, tracks, strict=True)
    ]
