"""The horizon of a round: routes are planned for the next stops of each tour only.

Tours look far ahead, routes need not: later rounds plan what comes behind the horizon, and a route
takes longer to improve the longer it is. A tour is cut behind its first stops; the robot then goes
home, or stays where its last stop is, and the next round goes on from there. The end of the last
stop before the cut counts as much as all ends of jobs behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace

from rightofway.model import Assignment, Itinerary, Scenario, Tick, Tour, Work, assign_tours

__all__ = ["STOPS_AHEAD", "CutTours", "cut_tours", "make_cut"]

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
            beyond = (k for k, end in enumerate(own, 1) if k >= n_stops and end >= least)
            cut = next(beyond, cut)
        firsts.append(tour[:cut])
        later.append(tour[cut:])
    return make_cut(scenario, firsts, later)


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
