"""Prioritized planning: one robot after another; a robot in the way of another is planned again.

References
----------
Erdmann & Lozano-Perez, *On multiple moving objects*, Algorithmica 1987.

Silver, *Cooperative pathfinding*, AIIDE 2005.

Andreychuk & Yakovlev, *Two techniques that enhance the performance of multi-robot prioritized path
planning*, AAMAS 2018.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from rightofway.deadline import Deadline
from rightofway.facts import Fact
from rightofway.model import Scenario, Status, Stop, compute_cost
from rightofway.planners.lacam import plan_fleet
from rightofway.precedence import build_graph_of_plan, build_timetable
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.repair.waves import plan_in_waves
from rightofway.search import FleetSearch

SHARE, SHARE_AT_ONE_PACE, SHARE_OF_MORE = 0.3, 0.9, 0.8
"""The parts of the time left for planning at own speeds, then at one pace, then at own speeds."""

SHARE_WITH_FALLBACK = 0.5
"""The part of the time left for planning at own speeds where the greedy attempt has a plan."""

SEARCHES, SEARCHES_AT_ONE_PACE = 3, 20
"""The largest number of planned robots, per robot of the fleet: at own speeds, and at one pace.

Fleets that find a plan at their own speeds need fewer than two searches per robot, as a rule; one
pace is quicker where more are needed, and finds a plan for more fleets.
"""

SEARCHES_WITH_SIZES, SHARE_WITH_SIZES, SHARE_WITH_PLAN = 30, 0.7, 0.3
"""The same for robots with a size or among closures, and the parts of the time left for that:
without a plan, and with one."""

MOST_ROBOTS = 8000
"""Larger fleets are not planned in turn: ten thousand robots found no plan in 80 s."""

HEADWAYS_PER_EDGE = 8
"""The headway of robots at one pace, as a part of the shortest edge."""


def prioritized(request: PlanRequest) -> Draft:
    """Plan one robot after another; options: `PrioritizedOptions`."""
    draft = plan_in_turn(request, make_fleet_search(request), request.options["order"])
    if draft is not None:
        return draft
    request.deadline.check(Fact("planning in turn"))
    together = plan_whole_fleet(request)
    status = Status("together after in turn")
    return together if request.scenario.problem.has_times else replace(together, status=status)


def plan_whole_fleet(request: PlanRequest) -> Draft:
    """Plan the whole fleet at once, in waves where stages have times."""
    if request.scenario.problem.has_times:
        return plan_in_waves(request, plan_fleet)
    return plan_fleet(request)


def plan_in_turn(
    request: PlanRequest, search: FleetSearch, order: str, *, has_plan: bool = False
) -> Draft | None:
    """Plan robots one after another, at their own speeds or else at one pace.

    None if no plan was found, or no time is left; that proves nothing.
    """
    if len(request.scenario.robots) > MOST_ROBOTS or request.deadline.measure_seconds_left() == 0:
        return None
    turns = choose_order(request.scenario, search, order, request.seed)
    problem = request.scenario.problem
    if problem.has_times:
        return _in_time(request, search, turns, SHARE_WITH_PLAN if has_plan else SHARE_WITH_SIZES)
    if not problem.resources.are_points or problem.closures is not None:
        return _plan_patiently(
            request, search, turns, SHARE_WITH_PLAN if has_plan else SHARE_WITH_SIZES
        )
    searches, deadline = SEARCHES * len(turns), request.deadline
    if search.prioritize(
        turns,
        searches=searches,
        time_limit=_measure_part(deadline, SHARE),
        with_fallback=_measure_part(deadline, SHARE_WITH_FALLBACK),
    ):
        return _plan_at_own_speeds(request, search)
    drafts = [_plan_at_one_pace(request, turns)]
    if search.resume(searches=searches, time_limit=_measure_part(deadline, SHARE_OF_MORE)):
        drafts.append(_plan_at_own_speeds(request, search))
    finished = [draft for draft in drafts if draft is not None]
    return min(
        finished, key=lambda draft: compute_cost(request.scenario, draft.tracks), default=None
    )


def _plan_patiently(
    request: PlanRequest, search: FleetSearch, turns: Sequence[int], share: float
) -> Draft | None:
    """Plan robots one after another at their own speeds only.

    One pace gains nothing for robots with a size, which book ahead; and closures are at times.
    """
    searches = SEARCHES_WITH_SIZES * len(turns)
    limit = _measure_part(request.deadline, share)
    is_complete = search.prioritize(turns, searches=searches, time_limit=limit)
    return _plan_at_own_speeds(request, search) if is_complete else None


def _in_time(
    request: PlanRequest, search: FleetSearch, turns: Sequence[int], share: float
) -> Draft | None:
    """Plan robots whose stages have times one after another, or else let one move at a time."""
    searches = SEARCHES_WITH_SIZES * len(turns)
    limit = _measure_part(request.deadline, share)
    status = Status("in turn")
    if not search.prioritize(turns, searches=searches, time_limit=limit):
        limit = request.deadline.measure_seconds_left()
        if not search.move_one_at_a_time(time_limit=limit):
            return None
        status = Status("one at a time")
    request.has_plan()
    return Draft(tracks=search.list_tracks(), status=status)


def _measure_part(deadline: Deadline, share: float) -> float | None:
    return deadline.shorten(share).measure_seconds_left()


def _plan_at_own_speeds(request: PlanRequest, search: FleetSearch) -> Draft:
    tracks = search.list_tracks()
    problem = request.scenario.problem
    if problem.closures is not None:  # a robot may have waited for a kept home
        tracks = tuple(build_graph_of_plan(request.scenario.problem, tracks).build_tracks())
    request.has_plan()
    return Draft(tracks=tracks, status=Status("in turn"))


def _plan_at_one_pace(request: PlanRequest, turns: Sequence[int]) -> Draft | None:
    if request.deadline.measure_seconds_left() == 0:
        return None
    paced = make_paced(request.scenario)
    # One thread: the greedy attempt is not needed here, and would slow this one on a busy machine.
    search = FleetSearch(paced.problem, seed=request.seed, threads=1)
    searches = SEARCHES_AT_ONE_PACE * len(turns)
    limit = _measure_part(request.deadline, SHARE_AT_ONE_PACE)
    if not search.prioritize(turns, searches=searches, time_limit=limit):
        return None
    tracks = build_timetable(request.scenario.problem, search.list_tracks())
    assert tracks is not None, "what robots of one pace do in some order, others can do in it"
    request.has_plan()
    status = Status("in turn at one pace")
    return Draft(tracks=tuple(tracks), status=status)


def make_paced(scenario: Scenario) -> Scenario:
    """Return the same trips for robots of one speed that do not work and book one vertex.

    The order of visits in a plan of these is possible for the real robots, too: the headway keeps
    the robot that leaves a vertex apart from the next one, so that no cycle moves at one instant.
    """
    robots = tuple(
        replace(
            robot,
            speed=Fraction(1),
            turn=Fraction(0),
            stops=tuple(Stop(at=stop.at) for stop in robot.stops),
        )
        for robot in scenario.robots
    )
    headway = min(scenario.roadmap.lengths, default=Fraction(1)) / HEADWAYS_PER_EDGE
    rules = replace(scenario.rules, occupancy="one", headway=headway, turn=Fraction(0))
    return replace(scenario, robots=robots, rules=rules)


def choose_order(scenario: Scenario, search: FleetSearch, order: str, seed: int) -> list[int]:
    """Return all robots in the order of the option ``order``."""
    robots = list(range(len(scenario.robots)))
    if order == "random":
        random.Random(seed).shuffle(robots)  # noqa: S311 (no secret depends on it)
    elif order == "slowest":
        robots.sort(key=lambda robot: scenario.robots[robot].speed)
    elif order != "file":
        alone = search.compute_alone()
        robots.sort(key=lambda robot: alone[robot], reverse=order == "longest")
    return robots
