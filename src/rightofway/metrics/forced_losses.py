"""Losses of groups of robots to each other in every plan: why no plan is better."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import chain, product

from rightofway.deadline import Deadline
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.metrics.collisions import find_collisions, find_swaps
from rightofway.metrics.near_misses import find_near_misses
from rightofway.model import (
    Objective,
    Scenario,
    Tick,
    Track,
    compute_completions,
    require_time_limit,
)
from rightofway.model.outcome import ForcedLoss, choose_objective
from rightofway.model.stays import compute_costs
from rightofway.search import (
    Bookings,
    ConflictBasedSearch,
    Distances,
    JointPlan,
    find_earliest_track,
)
from rightofway.site import VertexId

DRIVING = Fact("driving each robot alone")

MOST_PAIRS = 200
"""Pairs that are solved, those first that meet first."""

STATES = 10_000
"""Joint states of each pair or group."""

GROUPS = range(3, 5)
"""The numbers of robots of a group that is solved together."""

Robots = tuple[int, ...]

Places = dict[Robots, VertexId]
"""Groups of robots, each with the vertex where the first two of them meet."""


def find_forced_losses(
    scenario: Scenario,
    *,
    time_limit: float | None = None,
    pairs: int = MOST_PAIRS,
    states: int = STATES,
) -> tuple[ForcedLoss, ...]:
    """Return robots that lose time to each other in every plan, the largest loss first.

    Parameters
    ----------
    scenario
        The problem; every robot can reach its places.
    time_limit
        When to stop [s]; None for no limit.
    pairs
        How many pairs are looked at, those first that meet first.
    states
        Joint states at most of each pair or group.

    Returns
    -------
    tuple of ForcedLoss
        Pairs, and groups of up to four robots that lose more than their pairs explain; by weight
        where robots have weights, and with the surcharges of edges. None of robots that lose
        nothing.

    Notes
    -----
    Each pair or group is solved for itself. A robot may be in several, so that the losses do not
    add up. Deterministic without a time limit.
    """
    deadline = Deadline.after(require_time_limit(time_limit))
    tracks = _plan_alone(scenario, deadline)
    if tracks is None:
        return ()
    search, objective = ConflictBasedSearch(scenario.problem), choose_objective(scenario)
    both = zip(scenario.problem.itineraries, compute_costs(scenario, tracks), strict=True)
    alone = [itinerary.weight * cost for itinerary, cost in both]

    def measure_loss(robots: Robots) -> Tick:
        """Return the least losses of robots, alone on the roads [ticks]; 0 where time is up."""
        least = _search_together(search, robots, states, deadline).bound
        # A search that did not end gives a lower bound, and tracks are never below the least.
        return Tick(0 if least is None else max(least - sum(alone[robot] for robot in robots), 0))

    forced = dict[Robots, ForcedLoss]()
    for robots, vertex in list(_find_meetings(scenario, tracks).items())[:pairs]:
        if ticks := measure_loss(robots):
            forced[robots] = ForcedLoss(
                robots=robots, ticks=ticks, vertex=vertex, objective=objective
            )
    for group in _list_groups(forced):
        ticks = measure_loss(group)
        inside = {pair: loss for pair, loss in forced.items() if {*pair} <= {*group}}
        if ticks > _sum_of_disjoint(inside):
            first = next(iter(inside.values()))
            forced[group] = replace(first, robots=group, ticks=ticks)
    return tuple(sorted(forced.values(), key=lambda loss: (-loss.ticks, loss.robots)))


def find_forced_makespan(
    scenario: Scenario,
    makespan: int,
    *,
    time_limit: float | None = None,
    pairs: int = MOST_PAIRS,
    states: int = STATES,
) -> tuple[ForcedLoss, ...]:
    """Return robots that cannot all have completed before a tick, in any plan.

    Parameters
    ----------
    scenario
        The problem; every robot can reach its places.
    makespan
        The tick, that of the best plan [ticks].
    time_limit
        When to stop [s]; None for no limit.
    pairs
        How many pairs, and how many larger groups of each size, are looked at; those first that
        meet first.
    states
        Joint states at most of each pair or group.

    Returns
    -------
    tuple of ForcedLoss
        The robots that need as long alone; else the pairs that do, else groups of three, else of
        four. None where that is not proven, nor where edges have surcharges: the makespan leaves
        those out, and best tracks do not.

    Notes
    -----
    Deterministic without a time limit.
    """
    deadline = Deadline.after(require_time_limit(time_limit))
    tracks = None if scenario.roadmap.has_surcharges else _plan_alone(scenario, deadline)
    if tracks is None or makespan < 1:
        return ()
    search = ConflictBasedSearch(scenario.problem, latest=makespan - 1)

    def is_forced(robots: Robots) -> bool:
        """Return whether it is proven that some robots, alone on the roads, need as long."""
        plan = _search_together(search, robots, states, deadline)
        return plan.has_ended and plan.bound is None

    completions = compute_completions(scenario, tracks)
    late = [robot for robot, completion in enumerate(completions) if completion >= makespan]
    lone: Places = {(robot,): scenario.robots[robot].stops[-1].at for robot in late}
    meetings = dict(list(_find_meetings(scenario, tracks).items())[:pairs])
    for groups in chain([lone], _list_larger_groups(meetings, pairs)):
        forced = [robots for robots in groups if is_forced(robots)]
        if forced:
            return tuple(
                ForcedLoss(
                    robots=robots,
                    ticks=Tick(makespan),
                    vertex=groups[robots],
                    objective=Objective.MAKESPAN,
                )
                for robots in sorted(forced)
            )
    return ()


def _search_together(
    search: ConflictBasedSearch, robots: Robots, states: int, deadline: Deadline
) -> JointPlan:
    """Search the joint states of robots; where time is up, all that is known is a bound of 0."""
    left = deadline.measure_seconds_left()
    if left == 0:
        return JointPlan(has_ended=False, bound=Tick(0))
    return search.search_together(robots, states=states, time_limit=left)


def _list_larger_groups(meetings: Places, most: int) -> Iterator[Places]:
    """Yield the pairs that meet, and then groups with one more robot, which meets one of them."""
    groups = meetings
    yield groups
    for _ in GROUPS:
        larger: Places = {}
        for (group, vertex), pair in product(groups.items(), meetings):
            if len({*group} & {*pair}) == 1 and len(larger) < most:
                larger.setdefault(tuple(sorted({*group, *pair})), vertex)
        groups = larger
        yield groups


def _list_groups(pairs: Iterable[Robots]) -> list[Robots]:
    """Return the robots that pairs connect to each other, where they are three or four."""
    groups: list[set[int]] = []
    for pair in pairs:
        touched = [group for group in groups if group & {*pair}]
        groups = [group for group in groups if group not in touched]
        groups.append(set(pair).union(*touched))
    return [tuple(sorted(group)) for group in groups if len(group) in GROUPS]


def _sum_of_disjoint(pairs: Mapping[Robots, ForcedLoss]) -> int:
    """Return the most that pairs without a common robot lose in sum [ticks]."""
    most = 0
    for pair, loss in pairs.items():
        others = {other: part for other, part in pairs.items() if not {*pair} & {*other}}
        most = max(most, loss.ticks + _sum_of_disjoint(others))
    return most


def _plan_alone(scenario: Scenario, deadline: Deadline) -> list[Track] | None:
    """Return the track of least cost of each robot alone; None if one has none, or time is up."""
    bookings, tracks = Bookings(scenario.problem), list[Track]()
    distances = Distances(scenario.roadmap)
    try:
        for robot in range(len(scenario.robots)):
            deadline.check(DRIVING)
            left = deadline.measure_seconds_left()
            track = find_earliest_track(robot, bookings, distances, time_limit=left)
            if track is None:
                return None
            tracks.append(track)
    except GaveUp:
        return None
    return tracks


def _find_meetings(scenario: Scenario, tracks: list[Track]) -> Places:
    """Return the pairs that meet on their tracks, and where they do first, in order of time."""
    of_points = [(hit.start, hit.robots, hit.vertex) for hit in find_collisions(scenario, tracks)]
    head_on = [(swap.tick, swap.robots, swap.vertices[0]) for swap in find_swaps(tracks)]
    of_sizes = [
        (miss.start, miss.robots, miss.places[0][0]) for miss in find_near_misses(scenario, tracks)
    ]
    first: Places = {}
    for _, robots, vertex in sorted([*of_points, *head_on, *of_sizes]):
        first.setdefault(robots, vertex)
    return first
