"""A timetable that repeats, chosen well: as many laps per tick as can be, and nobody starves."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rightofway.cyclic.from_plan import one_lap
from rightofway.cyclic.groups import independent_groups
from rightofway.cyclic.problem import CyclicProblem
from rightofway.cyclic.route import CyclicRoute, clear_and_direct, cyclic_routes
from rightofway.cyclic.schedule_search import LARGE, GroupTimetable, choose
from rightofway.errors import GaveUp, InputError, kernel_limits
from rightofway.model import Lap, Scenario, VertexId, checked_time_limit
from rightofway.planners import Deadline, planning_headway
from rightofway.search import Distances, RoundTrip

__all__ = ["best_timetable"]

MOST_WITH_WAYS = 200
"""Larger fleets have no time to look for any way: they take clear routes or direct ones."""


@kernel_limits()
def best_timetable(
    scenario: Scenario,
    *,
    weights: Sequence[Fraction] | None = None,
    least_fairness: Fraction = Fraction(0),
    time_limit: float | None = 10,
    rounds: int | None = None,
    seed: int = 0,
    report: Callable[[str], None] | None = None,
) -> list[GroupTimetable]:
    """Choose ways, laps per period and rights of way so that the laps are worth most per tick.

    Parameters
    ----------
    scenario
        The problem; its number of laps plays no part.
    weights
        What a lap of each robot is worth, above 0; one each if None.
    least_fairness
        Which part of its laps alone each robot must make at least, 0 to 1.
    time_limit
        When to stop [s]; None for no limit. Groups get shares of it by their size.
    rounds
        How many first timetables to build for each group, and in how many steps to improve each
        that is kept; None for as many as there is time for.
    seed
        For what is drawn at random.
    report
        Takes sentences on the progress.

    Returns
    -------
    list of GroupTimetable
        One for each independent group, by their first robots; or one for all, where a group has to
        take the places of others to get out of a deadlock.

    Raises
    ------
    InputError
        For weights that do not fit, or a robot that has no lap to repeat.
    NoPlanExists
        If a robot has no way to a place.
    GaveUp
        If a group has no timetable in which all robots have a place and nobody starves.

    Notes
    -----
    Never below the pattern of first come first served, where it has one in its share of the time
    and that is fair enough. Deterministic for a seed where rounds end before time does. Not
    optimal.
    """
    time_limit = checked_time_limit(time_limit)
    _refuse(scenario, weights, least_fairness, time_limit, rounds)
    wish = _Wish(
        scenario=scenario,
        weights=weights or [Fraction(1)] * len(scenario.robots),
        least_fairness=least_fairness,
        deadline=Deadline.after(time_limit),
        rounds=rounds,
        seed=seed,
        report=report or (lambda _: None),
    )
    usual, other = _routes(scenario)
    others = [one.lap for one in other]
    groups = independent_groups(usual)
    try:
        return _by_groups(wish, groups, others)
    except GaveUp:
        if len(groups) == 1:
            raise
    return _by_groups(wish, [usual], others)  # it takes the places of other groups as well


def _routes(scenario: Scenario) -> tuple[list[CyclicRoute], list[CyclicRoute]]:
    """Return the usual round trips of all robots, and others."""
    if len(scenario.robots) > LARGE:
        return clear_and_direct(scenario)
    return cyclic_routes(scenario), cyclic_routes(scenario, "shortest")


@dataclass(frozen=True, kw_only=True)
class _Wish:
    """What a timetable is asked for."""

    scenario: Scenario
    weights: Sequence[Fraction]
    least_fairness: Fraction
    deadline: Deadline
    rounds: int | None
    seed: int
    report: Callable[[str], None]

    def shift(
        self, index: int, group: Sequence[CyclicRoute], others: Sequence[Lap], taken: set[VertexId]
    ) -> CyclicProblem:
        """Return what there is to choose for a group, where others take some vertices."""
        return CyclicProblem(
            n_vertices=self.scenario.roadmap.n_vertices,
            headway=planning_headway(self.scenario),
            books_ahead=self.scenario.rules.books_ahead,
            robots=tuple(one.robot for one in group),
            ways=tuple(_ways(one.lap, others[one.robot], taken) for one in group),
            tours=self.tours([one.robot for one in group], taken),
            forbidden=frozenset(taken),
            weights=tuple(self.weights[one.robot] for one in group),
            least_fairness=self.least_fairness,
            deadline=self.deadline,
            draw=random.Random(f"{self.seed} {index}"),  # noqa: S311 (no secret depends on it)
        )

    def tours(self, robots: Sequence[int], taken: set[VertexId]) -> tuple[RoundTrip, ...]:
        """Return what robots have to do in a lap, on any way; none in large fleets."""
        if len(self.scenario.robots) > MOST_WITH_WAYS:
            return ()
        distances = Distances(self.scenario.roadmap)
        once = (one_lap(self.scenario, robot) for robot in robots)
        return tuple(RoundTrip.of(itinerary, distances, forbidden=taken) for itinerary in once)


def _by_groups(
    wish: _Wish, groups: Sequence[Sequence[CyclicRoute]], others: Sequence[Lap]
) -> list[GroupTimetable]:
    """Choose a timetable for each group, small ones first, none through places of another."""
    taken = {vertex for group in groups for one in group for vertex in one.lap.vertices}
    found: dict[int, GroupTimetable] = {}
    left = sum(map(len, groups))
    for index in sorted(range(len(groups)), key=lambda index: len(groups[index])):
        group = groups[index]
        wish.report(f"{len(found)} of {len(groups)} groups done, next {len(group)} robots")
        taken -= {vertex for one in group for vertex in one.lap.vertices}
        shift = wish.shift(index, group, others, taken)
        share = shift.until(wish.deadline.sooner(len(group) / left))
        left -= len(group)
        found[index] = choose(wish.scenario, group, share, rounds=wish.rounds)
        taken |= {v for lap in found[index].timetable.laps for v in lap.vertices}
    return [found[index] for index in range(len(groups))]


def _refuse(
    scenario: Scenario,
    weights: Sequence[Fraction] | None,
    least_fairness: Fraction,
    time_limit: float | None,
    rounds: int | None,
) -> None:
    robots = len(scenario.robots)
    if weights is not None and len(weights) != robots:
        raise InputError.at("weights", f"{len(weights)} for {robots} robots (give one for each)")
    for index, weight in enumerate(weights or ()):
        if weight <= 0:
            raise InputError.at(f"weights[{index}]", f"{weight} is not above 0")
    if not 0 <= least_fairness <= 1:
        raise InputError.at("least_fairness", f"{least_fairness} is not from 0 to 1")
    if time_limit is None and rounds is None:
        raise InputError.at("rounds", "neither they nor the time are limited (limit one of them)")


def _ways(usual: Lap, other: Lap, taken: set[VertexId]) -> tuple[Lap, ...]:
    """Return the laps a robot may take: not through places of other groups."""
    if other == usual or taken.intersection(other.vertices):
        return (usual,)
    return usual, other
