"""The horizon of a round: routes are planned for the next stops of each tour only.

Tours look far ahead, routes need not: later rounds plan what comes behind the horizon, and a route
takes longer to improve the longer it is. A tour is cut behind its first stops; the robot then goes
home, or stays where its last stop is, and the next round goes on from there. The end of the last
stop before the cut counts as much as all ends of jobs behind it.

In a crowded fleet there may be no such tracks, or none that are found in time: each must end where
its robot can stay permanently, and pass all others that stay. Then tracks end at a time instead.
They may conflict later, and are cut there; the rest of the tours is left to later rounds.

References
----------
Li, Tinka, Kiesel, Durham, Kumar & Koenig, *Lifelong multi-agent path finding in large-scale
warehouses*, AAAI 2021: conflicts are resolved up to a time, and plans replaced before it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from rightofway.model import (
    Assignment,
    Itinerary,
    Plan,
    PlannerRun,
    Scenario,
    Tick,
    Tour,
    Track,
    Work,
    assign_tours,
)

__all__ = [
    "STOPS_AHEAD",
    "Crowding",
    "CutTours",
    "cut_tours",
    "cut_tracks",
    "find_horizon",
    "make_cut",
    "may_stay_anywhere",
]

FIRST_PAUSE, LONGEST_PAUSE = 8, 128
"""Rounds of a crowded fleet that end at a time before whole tracks are tried again; twice as many
after each trial that fails."""

MOST_HORIZONS = 8
"""A horizon by which no robot does a stop doubles; at so many times the first one, other attempts
follow. Else robots that block each other might wait there in every round."""

STOPS_AHEAD = 2
"""Stops of each tour that get routes in a round; a robot that has fewer of them left, and more
behind them, needs a round."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CutTours:
    """A scenario whose tours end at the horizon.

    Attributes
    ----------
    toured
        The scenario with cut tours.
    later
        What is left of the tour of each robot.
    """

    toured: Scenario
    later: tuple[Tour, ...]

    @property
    def is_whole(self) -> bool:
        """Whether no tour is cut."""
        return not any(self.later)


def cut_tours(
    scenario: Scenario,
    assignment: Assignment,
    ends: Sequence[Sequence[Tick]],
    n_stops: int | None,
    least: Tick,
) -> CutTours:
    """Return a scenario in which tours are cut, and what is left of them.

    Parameters
    ----------
    scenario
        The scenario of the round.
    assignment
        Its tours.
    ends
        When each item of each tour ends without other robots in the way [ticks].
    n_stops
        How many items of a tour are before the cut at least; None for all.
    least
        The last of them ends then or later [ticks].
    """
    work = scenario.problem.work
    assert work is not None, "the scenario has jobs"
    firsts, later = list[Tour](), list[Tour]()
    for tour, own in zip(assignment.tours, ends, strict=True):
        cut = len(tour)
        if n_stops is not None and not any(job.after for job in work.jobs):
            beyond = (
                k
                for k, end in enumerate(own, 1)
                if k >= n_stops and end >= least and not _charges_next(tour[k:])
            )
            cut = next(beyond, cut)
        firsts.append(tour[:cut])
        later.append(tour[cut:])
    return make_cut(scenario, firsts, later)


def _charges_next(tour: Tour) -> bool:
    """Whether a tour begins with a charge: a cut before it could leave the robot too low."""
    return bool(tour) and tour[0].job is None and tour[0].duration > 0


def cut_tracks(
    cut: CutTours, tracks: Sequence[Track], horizon: Tick
) -> tuple[CutTours, list[Track]]:
    """Return tours and tracks that end at a horizon: each robot stays where it is then.

    Parameters
    ----------
    cut
        Tours of robots that end anywhere.
    tracks
        Their tracks, without conflicts until the horizon. The cut ones have no conflicts: where a
        robot is at the horizon no other one arrives until then, and none moves afterwards.
    horizon
        When tracks end at the latest [ticks].
    """
    tours = Plan(scenario=cut.toured, tracks=tuple(tracks), run=PlannerRun()).tours or ()
    firsts, later, ended = list[Tour](), list[Tour](), list[Track]()
    for tour, rest, items, track in zip(
        cut.toured.tours or (), cut.later, tours, tracks, strict=True
    ):
        n_visits = int(np.searchsorted(track.enter, horizon, side="right"))
        n_items = sum(item.visit < n_visits for item in items)
        firsts.append(tour[:n_items])
        later.append((*tour[n_items:], *rest))
        ended.append(Track(vertices=track.vertices[:n_visits], enter=track.enter[:n_visits]))
    return make_cut(cut.toured, firsts, later), ended


def make_cut(scenario: Scenario, firsts: Sequence[Tour], later: Sequence[Tour]) -> CutTours:
    """Return a scenario whose tours are cut.

    Parameters
    ----------
    scenario
        The scenario of the round.
    firsts, later
        Of each robot, the tour before the cut and what is left of it.
    """
    work = scenario.problem.work
    assert work is not None, "the scenario has jobs"
    toured = assign_tours(scenario, firsts)
    cut_toured = CutTours(toured=toured, later=tuple(later))
    if not cut_toured.is_whole:
        weighted = (
            _weigh_last(itinerary, len(tour), _sum_weights(work, rest))
            for itinerary, tour, rest in zip(toured.problem.itineraries, firsts, later, strict=True)
        )
        problem = replace(toured.problem, itineraries=tuple(weighted))
        cut_toured = replace(cut_toured, toured=copy(toured))
        object.__setattr__(cut_toured.toured, "problem", problem)
    return cut_toured


def _sum_weights(work: Work, rest: Tour) -> int:
    """Return the weights of the jobs that end behind the cut."""
    return sum(work.jobs[job].weight for job in {item.job for item in rest} if job is not None)


def _weigh_last(itinerary: Itinerary, n_stops: int, weight: int) -> Itinerary:
    """Return an itinerary in which the end of the last stop before a cut counts more."""
    if not weight or not n_stops:
        return itinerary
    stages = list(itinerary.stages)
    stages[n_stops - 1] = replace(stages[n_stops - 1], weight=stages[n_stops - 1].weight + weight)
    return replace(itinerary, stages=tuple(stages))


# --- crowded fleets ------------------------------------------------------------------------------


class Crowding:
    """Whether a fleet was too crowded for whole tracks in its last rounds."""

    def __init__(self) -> None:
        self._pause = 0  # rounds between two trials of whole tracks
        self._left = 0  # until the next one
        self._factor = 1  # of the horizon

    @property
    def is_stuck(self) -> bool:
        """Whether no robot did a stop by the last horizons, each twice as far as the one before."""
        return self._factor == MOST_HORIZONS

    def list_attempts(
        self, n_stops: int | None, horizon: Tick | None
    ) -> Iterator[tuple[int | None, Tick | None]]:
        """Yield the attempts of a round: stops of each tour, and when tracks are cut.

        Parameters
        ----------
        n_stops
            How many stops of a tour get routes; None for all.
        horizon
            When tracks of a crowded fleet are cut [ticks]; None if they cannot be.
        """
        if horizon is None or not self._left:
            yield n_stops, None
        if horizon is not None:
            yield n_stops, Tick(self._factor * horizon)
        if n_stops is not None:
            yield None, None

    def note(self, *, is_crowded: bool, is_cut: bool, is_still: bool) -> None:
        """Note an attempt.

        Parameters
        ----------
        is_crowded
            Whether many robots would keep their old tours.
        is_cut
            Whether tracks are cut.
        is_still
            Whether robots have tours and none of them does a stop.
        """
        if is_cut:
            self._factor = min(2 * self._factor, MOST_HORIZONS) if is_still else 1
            self._left = 0 if self.is_stuck else max(self._left - 1, 0)
        elif is_crowded:
            self._pause = min(max(2 * self._pause, FIRST_PAUSE), LONGEST_PAUSE)
            self._left = self._pause
        else:
            self._pause = 0


def may_stay_anywhere(scenario: Scenario) -> bool:
    """Return whether a robot may end its track at any vertex, at any time.

    Parameters
    ----------
    scenario
        The scenario of a round.
    """
    problem = scenario.problem
    work = problem.work
    assert work is not None, "the scenario has jobs"
    return (
        all(robot.home is None and robot.battery is None for robot in work.robots)
        and not any(job.after for job in work.jobs)
        and problem.closures is None
        and scenario.roadmap.passing is None
    )


def find_horizon(ends: Sequence[Sequence[Tick]], least: Tick) -> Tick:
    """Return when tracks of crowded fleets are cut [ticks]: half of the cut tours can end by then.

    Parameters
    ----------
    ends
        When each item of each tour ends without other robots in the way [ticks].
    least
        It is then or later [ticks].
    """
    lasts = sorted(own[:STOPS_AHEAD][-1] for own in ends if own)
    return max(lasts[len(lasts) // 2] if lasts else least, least)
