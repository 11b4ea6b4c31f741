"""Routes of a round, which start from the old ones.

Robots whose tours stay the same keep their old tracks at first. The others are planned around them;
tracks in their way are planned again. Where that takes too long, each of the others is planned
around the old tracks of all robots. A robot for which this finds nothing keeps its old tour: then
the plan of a round is never worse than the old one.

With a horizon, each robot is planned around the old tracks of all others at once. That never fails:
a robot can follow its old track to the horizon and drive on freely behind it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from itertools import chain

from rightofway.deadline import Deadline
from rightofway.dispatch.horizon import CutTours, make_cut
from rightofway.dispatch.view import RobotView
from rightofway.model import Scenario, Tick, Tour, TourItem, Track
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.plan_request import PlanRequest

__all__ = [
    "HURRIED",
    "FoundRoutes",
    "find_routes",
    "keep_old_tours",
    "list_old_items",
    "list_same_tracks",
]

SEARCHES = 20
"""Searches for each robot without a track, and for each ten robots, before all are kept."""

SHARE_OF_REPAIR, PATIENT_SHARE = 0.3, 0.8
"""The part of the time in which robots may lose their tracks to others; the second one if there is
little to fall back to, because many robots that need a track would stand still without it."""

HURRIED = 0.25
"""Many robots: more than this part of the fleet."""

SHARE_TO_REPLACE = 0.6
"""The part of the time after that in which robots get tracks around all others."""

SHARE_TO_JUDGE = 0.1
"""The part of the time that is left to judge a plan."""

PATIENCE = 200
"""Neighbourhoods without a gain for each robot, before the search ends."""

UNLIMITED = 2**31 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundRoutes:
    """Tracks of a fleet.

    Attributes
    ----------
    tracks
        One for each robot.
    left
        The robots for whose tours no tracks were found: they have their old ones.
    improve
        Improves the tracks until the time is over, and returns them; None if robots are left.
    """

    tracks: tuple[Track | None, ...]
    left: tuple[int, ...] = ()
    improve: Callable[[], tuple[Track, ...]] | None = None


def find_routes(
    toured: Scenario,
    start: Sequence[Track | None],
    old: Sequence[Track | None],
    *,
    horizon: Tick | None,
    deadline: Deadline,
    seed: int,
) -> FoundRoutes:
    """Return the first tracks without conflicts, and how to improve them.

    Parameters
    ----------
    toured
        The scenario of the round, with tours.
    start
        Tracks to begin with, and None for robots that need others.
    old
        The rest of the old plan.
    horizon
        Tracks may conflict after this tick; None: they never do.
    deadline
        When the round has to end.
    seed
        For all that is drawn.
    """
    judging = deadline.shorten(1 - SHARE_TO_JUDGE)
    search = make_fleet_search(PlanRequest(scenario=toured, seed=seed, deadline=judging), horizon)
    left = search.take_over(start, (), time_limit=None)
    alone = search.compute_alone()
    order = sorted(left, key=lambda robot: (int(alone[robot]), robot))
    searches = SEARCHES * (len(left) + len(old) // 10)
    n_still = sum((track := old[robot]) is None or len(track) == 1 for robot in left)
    is_still = n_still > HURRIED * len(old)
    share = PATIENT_SHARE if is_still else SHARE_OF_REPAIR
    repairing = judging.shorten(share).measure_seconds_left()
    goes_on = horizon is not None and not is_still
    if left and (goes_on or not search.repair(order, searches=searches, time_limit=repairing)):
        replacing = judging.shorten(SHARE_TO_REPLACE).measure_seconds_left()
        given = [first or then for first, then in zip(start, old, strict=True)] if goes_on else old
        left = search.take_over(given, order, time_limit=replacing)
        if left:
            known = search.list_known_tracks()
            return FoundRoutes(
                tracks=tuple(old[k] if k in left else track for k, track in enumerate(known)),
                left=left,
            )

    def improve() -> tuple[Track, ...]:
        patience = PATIENCE * len(old)
        search.improve(UNLIMITED, patience=patience, time_limit=judging.measure_seconds_left())
        if toured.problem.closures is None:
            search.retime()
        return search.list_tracks()

    return FoundRoutes(tracks=search.list_tracks(), improve=improve)


def list_same_tracks(toured: Scenario, old: Sequence[RobotView]) -> list[Track | None]:
    """Return the old tracks of the robots that do what they would have done, and None for others.

    Parameters
    ----------
    toured
        The scenario of the round, with tours.
    old
        Its robots, with the rest of the old plan.
    """
    names = [job.name for job in toured.jobs or ()]
    tracks = list[Track | None]()
    for tour, own, itinerary in zip(
        toured.tours or (), old, toured.problem.itineraries, strict=True
    ):
        new = [
            (None if item.job is None else names[item.job], item.stop, item.vertex)
            for item in tour
            if item.job is not None or item.duration
        ]
        before = [(step.job, step.stop, step.vertex) for step in own.steps]
        is_same = own.track is not None and new == before
        if is_same and own.track is not None and not itinerary.ends_anywhere:
            is_same = int(own.track.vertices[-1]) == itinerary.last
        tracks.append(own.track if is_same else None)
    return tracks


def list_old_items(scenario: Scenario, own: RobotView) -> tuple[Tour, Tour]:
    """Return the items of an old tour, before and behind its cut, whose jobs are in a round.

    Parameters
    ----------
    scenario
        The scenario of the round.
    own
        A robot, with the rest of the old plan.
    """
    work = scenario.problem.work
    assert work is not None, "the scenario has jobs"
    index = {job.name: number for number, job in enumerate(scenario.jobs or ())}

    def make_item(name: str, stop: int) -> TourItem:
        own = work.jobs[index[name]]
        bound = own.stops[stop - own.first]
        return TourItem(job=index[name], stop=stop, vertex=bound.vertex, duration=bound.work)

    ahead = (
        TourItem(job=None, stop=None, vertex=step.vertex, duration=step.least)
        if step.job is None or step.stop is None
        else make_item(step.job, step.stop)
        for step in own.steps
        if step.job is None or step.job in index
    )
    behind = (make_item(name, stop) for name, stop in own.later if name in index)
    return tuple(ahead), tuple(behind)


def keep_old_tours(
    cut: CutTours, old: Sequence[tuple[Tour, Tour]], keeping: Collection[int]
) -> CutTours:
    """Return tours in which some robots go on with their old ones, without jobs of other robots.

    Parameters
    ----------
    cut
        The new tours, before and behind their cut.
    old
        The same of the old tours.
    keeping
        The robots that keep their old tours. Their new jobs follow behind the cut.
    """
    firsts, later = list(cut.toured.tours or ()), list(cut.later)
    taken = {
        item.job
        for robot, tours in enumerate(zip(firsts, later, strict=True))
        if robot not in keeping
        for item in chain(*tours)
    } - {None}
    kept_jobs = {item.job for robot in keeping for item in chain(*old[robot])} - taken
    for robot in keeping:
        first, rest = (tuple(item for item in tour if item.job not in taken) for tour in old[robot])
        own = {(item.job, item.stop) for item in (*first, *rest)}
        others = kept_jobs - {job for job, _ in own}
        more = (
            item
            for item in (*firsts[robot], *later[robot])
            if item.job is not None and item.job not in others and (item.job, item.stop) not in own
        )
        firsts[robot], later[robot] = first, (*rest, *more)
    return make_cut(cut.toured, firsts, later)
