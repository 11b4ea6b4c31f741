"""Proofs that a fleet has no plan: which robots are blocked, where and why.

A robot may have no way to a place; two may have to stay at one vertex for ever; or robots block
each other whatever they do. The last is proven by the search of LaCAM in steps, and a
deletion filter then takes out every robot without which the proof still holds.

References
----------
Chinneck & Dravnieks, *Locating minimal infeasible constraint sets in linear programs*, ORSA Journal
on Computing 3, 1991 (the deletion filter).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import NoReturn

from rightofway.deadline import Deadline
from rightofway.errors import MAX_REASONS, Blockage, GaveUp, NoPlanExists
from rightofway.facts import Fact
from rightofway.model import Outcome, OutcomeKind, Plan, PlannerRun, Scenario, Status, Tick, Track
from rightofway.model.closures import Closure
from rightofway.model.resources import measure_distance
from rightofway.native import find_clashes
from rightofway.repair.plan_request import PlanRequest
from rightofway.search import (
    Bookings,
    Distances,
    compute_least_completions,
    find_earliest_track,
    plan_by_lacam,
)
from rightofway.search.missing_ways import (
    RoadmapParts,
    find_missing_ways,
    find_reached_vertices,
    reaches_its_places,
)
from rightofway.site import VertexId

FINDING_WAYS = Fact("finding ways around closures")

EFFORT = 4_000_000
"""Choices of robots in all trials of the deletion filter."""

MOST_TRIALS = 200
"""Trials that the effort is divided by, at most."""

LARGEST_SET, LARGEST_MAP = 6, 20_000
"""Narrow places are looked for only for so few robots, on maps of so few vertices."""


def refuse_the_impossible(scenario: Scenario, distances: Distances) -> None:
    """Raise if no plan exists for one of two simple reasons.

    Raises
    ------
    NoPlanExists
        If robots cannot get to a place, or would have to stay at one vertex for ever; with all.
    """
    stranded = [
        robot
        for robot, itinerary in enumerate(scenario.problem.itineraries)
        if not reaches_its_places(itinerary, distances)
    ]
    refuse_stranded(scenario, stranded)


def refuse_stranded(scenario: Scenario, stranded: Iterable[int]) -> None:
    """Raise `NoPlanExists` if some robots have no way to a place, or robots share an end."""
    blockages = [
        *find_missing_ways(scenario, stranded),
        *_find_shared_ends(scenario),
        *_find_clashes(scenario),
    ]
    if blockages:
        raise NoPlanExists(blockages, scenario)


def _find_shared_ends(scenario: Scenario) -> Iterator[Blockage]:
    """Yield where several robots would have to stay at one vertex for ever."""
    # Two robots that stay at one vertex for ever can never both be there: no search is needed.
    holders: defaultdict[VertexId, list[int]] = defaultdict(list)
    for robot, itinerary in enumerate(scenario.problem.itineraries):
        if not itinerary.ends_anywhere:
            holders[itinerary.last].append(robot)
    for vertex, robots in holders.items():
        if len(robots) > 1:
            reason = Fact("shared end", robots=tuple(robots), place=vertex)
            remedy = Fact("end elsewhere", number=len(robots))
            yield Blockage(reason, tuple(robots), (vertex,), remedy)


def _find_clashes(scenario: Scenario) -> Iterator[Blockage]:
    """Yield where two robots would start or end too near to each other."""
    itineraries, roadmap = scenario.problem.itineraries, scenario.roadmap
    if scenario.problem.resources.are_points:
        return
    homes, ends = (
        [itinerary.home for itinerary in itineraries],
        [itinerary.last for itinerary in itineraries],
    )
    for when, places in (("start", homes), ("end", ends)):
        for pair in find_clashes(scenario.problem.resources, places):
            place, other_place = (places[robot] for robot in pair)
            may_move = any(itineraries[robot].ends_anywhere for robot in pair)
            if place == other_place or (when == "end" and may_move):
                continue  # a shared end, or none
            robot, other = map(int, pair)
            values = {"one": robot, "here": place, "other": other, "there": other_place}
            zone = next((z for z in roadmap.zones if {place, other_place} <= {*z.vertices}), None)
            if zone is not None:
                reason = Fact(f"{when} in one zone", **values, zone=zone.name)
            else:
                needed = scenario.robots[robot].radius + scenario.robots[other].radius
                reason = Fact(
                    f"{when} too near",
                    **values,
                    distance=measure_distance(roadmap, place, other_place),
                    needed=needed + (scenario.rules.clearance if needed else 0),
                )
            remedy = Fact(f"{when} elsewhere", number=2)
            yield Blockage(reason, (robot, other), (place, other_place), remedy)


def refuse_closed_ways(
    scenario: Scenario, deadline: Deadline, robots: Iterable[int] | None = None
) -> None:
    """Raise if closures leave a robot no track, even if it is alone; distances are known.

    Raises
    ------
    NoPlanExists
        With each such robot, and closures that block it.
    GaveUp
        When time ran out before a robot was found to be free.
    """
    if scenario.problem.closures is None:
        return
    distances, blockages = Distances(scenario.roadmap), []
    for robot in range(len(scenario.robots)) if robots is None else robots:
        deadline.check(FINDING_WAYS)
        if not _has_track_alone(scenario, robot, distances, deadline):
            blockages.append(_find_closed_in(scenario, robot, distances, deadline))
            if len(blockages) == MAX_REASONS:
                break
    if blockages:
        raise NoPlanExists(blockages, scenario)


def _has_track_alone(
    scenario: Scenario, robot: int, distances: Distances, deadline: Deadline
) -> bool:
    left = deadline.measure_seconds_left()
    track = find_earliest_track(robot, Bookings(scenario.problem), distances, time_limit=left)
    return track is not None


def _find_closed_in(
    scenario: Scenario, robot: int, distances: Distances, deadline: Deadline
) -> Blockage:
    """Return why a robot has no track alone: a small set of closures that block it."""
    left = list(scenario.closures)
    clock = scenario.problem.clock
    for closure in scenario.closures if len(left) <= MOST_TRIALS else ():
        fewer = [other for other in left if other is not closure]
        trial = replace(scenario, closures=tuple(fewer), clock=clock)
        try:
            left = left if _has_track_alone(trial, robot, distances, deadline) else fewer
        except GaveUp:
            break
    itinerary = scenario.problem.itineraries[robot]
    places = dict.fromkeys([itinerary.home, *(stage.vertex for stage in itinerary.stages)])
    closures = tuple(_describe_closure(scenario, closure) for closure in left[:MAX_REASONS])
    reason = Fact("closed in", robot=robot, closures=closures)
    return Blockage(reason, (robot,), tuple(places), Fact("open closures", number=len(left)))


def _describe_closure(scenario: Scenario, closure: Closure) -> Fact:
    """Return the place and the time of a closure."""
    clock = scenario.problem.clock
    place = Fact("place", vertex=closure.at)
    if closure.edge is not None:
        place = Fact("way", first=closure.edge[0], last=closure.edge[-1])
    begin = int(closure.from_ // clock.tick)
    if closure.until is None:
        return Fact("closed from", way=place, begin=begin)
    return Fact("closed between", way=place, begin=begin, end=clock.count_ticks(closure.until))


def refuse_blocked_parts(request: PlanRequest) -> None:
    """Raise if robots in one of several parts of a map, which no edge joins, have no plan.

    A search over the whole fleet tries each move of the robots of one part with all moves of the
    others. Part by part, the proof takes far fewer steps; the search ends undecided after a number
    of them.

    Raises
    ------
    NoPlanExists
        With a small set of robots that block each other.
    """
    scenario = request.scenario
    parts, groups = RoadmapParts(scenario.roadmap), defaultdict[frozenset[int], list[int]](list)
    for robot, itinerary in enumerate(scenario.problem.itineraries):
        groups[parts.find_part(itinerary.home)].append(robot)
    for robots in sorted(groups.values(), key=len) if len(groups) > 1 else ():
        effort = EFFORT // len(groups)
        if _is_blocked(request, robots, effort):
            refuse_blocked(request, robots)


def refuse_blocked(request: PlanRequest, robots: Iterable[int] | None = None) -> NoReturn:
    """Raise for robots that are proven to have no plan, by default all: with a small set of them.

    Raises
    ------
    NoPlanExists
        With robots that block each other.

    Notes
    -----
    Deterministic, as long as there is time. That the set has no plan is proven. It is minimal where
    no trial without one of its robots ended undecided.
    """
    scenario = request.scenario
    everybody = list(range(len(scenario.robots)) if robots is None else robots)
    effort = EFFORT // min(len(everybody), MOST_TRIALS)

    def is_blocked(fewer: Sequence[int]) -> bool:
        return _is_blocked(request, fewer, effort)

    request.report(Fact("looking for blockages"))
    blocked = find_smallest_set(everybody, is_blocked)
    blockage = _describe_blocked(scenario, blocked)
    raise NoPlanExists([blockage], scenario)


def find_smallest_set(
    robots: Sequence[int], is_blocked: Callable[[Sequence[int]], bool]
) -> Sequence[int]:
    """Return a small set of robots that have no plan, given that some robots have none.

    Notes
    -----
    The deletion filter takes out halves, quarters and so on. The set is minimal where no trial
    without one of its robots ended undecided.
    """
    left = list(robots)
    size = len(left)
    while size > 1:
        size = -(-size // 2)
        for begin in range(0, len(left), size)[::-1]:
            fewer = left[:begin] + left[begin + size :]
            with suppress(GaveUp):
                if len(fewer) > 1 and is_blocked(fewer):
                    left = fewer
    return left


def make_fleet_of(scenario: Scenario, robots: Iterable[int]) -> Scenario:
    """Return some of the robots as a fleet of their own, in the same ticks.

    Its rules ask no more of them, so a part without a plan has none in the whole fleet.
    """
    fleet = tuple(scenario.robots[robot] for robot in robots)
    rules = scenario.rules
    if not any(robot.radius for robot in fleet):
        rules = replace(rules, clearance=Fraction(0))  # which is for robots with a size
    return replace(scenario, robots=fleet, rules=rules, clock=scenario.problem.clock)


def refuse_without_room(
    scenario: Scenario, is_blocked: Callable[[Sequence[int]], bool] | None = None
) -> NoReturn:
    """Raise for a fleet that is proven to have no plan.

    Raises
    ------
    NoPlanExists
        With a small set of robots of which ``is_blocked`` proves it; without that, with all.
    """
    robots: Sequence[int] = range(len(scenario.robots))
    if is_blocked is not None:
        robots = find_smallest_set(robots, is_blocked)
    has_others = len(robots) < len(scenario.robots)
    blocked = Fact("these robots", robots=tuple(robots))
    if len(robots) > LARGEST_SET:
        blocked = Fact("some robots" if has_others else "all robots", number=len(robots))
    is_open = scenario.problem.closures is None
    reason = Fact("no room" if is_open else "no room among closures", blocked=blocked)
    if has_others:
        reason = Fact("whatever others do", fact=reason)
    blockage = Blockage(reason, tuple(robots), remedy=Fact("give room or places"))
    raise NoPlanExists([blockage], scenario)


def put_fleet_at_home(scenario: Scenario) -> Plan:
    """Return a fleet that stays at home, to draw where robots block each other."""
    alone = compute_least_completions(scenario)
    assert alone is not None, "no time limit was given"
    return Plan(
        scenario=scenario,
        tracks=tuple(Track.of([robot.home], [0]) for robot in scenario.robots),
        run=PlannerRun(
            name="none",
            status=Status("no plan exists"),
            outcome=Outcome(kind=OutcomeKind.NO_PLAN_EXISTS),
            alone=tuple(Tick(max(ticks, 0)) for ticks in alone.tolist()),
        ),
    )


def _is_blocked(request: PlanRequest, robots: Sequence[int], effort: int) -> bool:
    """Return whether it is proven that some robots of a fleet have no plan."""
    if len(robots) < 2:  # noqa: PLR2004 (a robot alone is never blocked)
        return False
    left = request.deadline.measure_seconds_left()
    fleet = make_fleet_of(request.scenario, robots)
    try:
        plan_by_lacam(
            fleet.problem.as_steps(),
            seed=request.seed,
            most_effort=effort,
            time_limit=left,
            spreads=False,
        )
    except NoPlanExists:
        return True
    return False


def _describe_blocked(scenario: Scenario, robots: Sequence[int]) -> Blockage:
    """Return which robots block each other, and where they have to pass or to go to."""
    reason = Fact("block each other", robots=tuple(robots))
    if len(robots) < len(scenario.robots):
        reason = Fact("whatever others do", fact=reason)
    if narrow := tuple(_list_narrow_places(scenario, robots)):
        reason = Fact("narrow places", fact=reason, places=narrow, number=len(robots))
        return Blockage(reason, tuple(robots), narrow, Fact("give room there"))
    itineraries = [scenario.problem.itineraries[robot] for robot in robots]
    ends = dict.fromkeys(end for own in itineraries for end in (own.home, own.last))
    return Blockage(reason, tuple(robots), tuple(ends), Fact("give room or places"))


def _list_narrow_places(scenario: Scenario, robots: Sequence[int]) -> list[VertexId]:
    """Return the vertices that each of some robots has to pass or to go to, in their order."""
    if len(robots) > LARGEST_SET or scenario.roadmap.n_vertices > LARGEST_MAP:
        return []
    distances, ends = Distances(scenario.roadmap), RoadmapParts(scenario.roadmap).ends
    common: dict[VertexId, None] | None = None
    for robot in robots:
        itinerary = scenario.problem.itineraries[robot]
        places = [itinerary.home, *(stage.vertex for stage in itinerary.stages)]
        passed = dict.fromkeys(places)
        for tail, head in dict.fromkeys(pairwise(places)):
            for vertex in distances.find_path(tail, head, itinerary.edge_ticks):
                if vertex not in passed and head not in find_reached_vertices(tail, ends, {vertex}):
                    passed[vertex] = None
        common = passed if common is None else dict.fromkeys(v for v in common if v in passed)
    return sorted(common or ())
