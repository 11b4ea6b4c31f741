"""Planning anew what is left when a robot has broken down.

What each robot has not done yet becomes a scenario of its own, in which the broken robots stand
where they are for ever and the edges around them are closed. A robot that cannot reach a place any
more is *cut off*: it does what it can, and then stands where it is in nobody's way.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import combinations, islice, product
from math import prod

from rightofway.errors import GaveUp, NoPlanExists
from rightofway.execution.stop import Rest
from rightofway.model import Plan, Roadmap, Robot, Scenario, Stage, Stop, VertexId
from rightofway.planners import Deadline
from rightofway.search import untimed_lacam
from rightofway.solve import solve

__all__ = ["ReplanResult", "plan_the_rest"]

PLANNER = "two-level"
"""Complete: it finds a plan or proves that there is none."""

MOST_TRIES = 2000
"""How many ways to put robots out of the way are tried."""

MOST_SORTED = 20_000
"""Up to so many ways all are tried, the nearest places first; of more, some at random."""

SECONDS = 30.0
"""How long all of this may take [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplanResult:
    """A plan for the rest.

    Attributes
    ----------
    plan
        Its scenario has the robots of the one before.
    cut_off
        Robots that cannot do everything.
    """

    plan: Plan
    cut_off: frozenset[int]


Stages = Sequence[Sequence[Stage]]
"""What each robot still has to do."""


def plan_the_rest(rest: Rest, seed: int) -> ReplanResult | None:
    """Plan what is left, so that as many robots as possible do everything.

    Parameters
    ----------
    rest
        What is left, and who cannot move.
    seed
        For the planner, and for where robots are put out of the way.

    Returns
    -------
    Anew or None
        None if no plan was found at all.

    Notes
    -----
    Who is cut off by the map alone does what it can. Of the others, one more is given up only when
    no way to put the former out of the way lets all the rest finish, proven by a complete planner,
    as long as `MOST_TRIES` and `SECONDS` are enough.
    """
    roadmap, deadline = rest.scenario.roadmap.without(rest.closed), Deadline.after(SECONDS)
    for tried in islice(_attempts(roadmap, rest, seed, deadline), MOST_TRIES):
        scenario = _scenario(rest, roadmap, tried.stages, tried.parking)
        # Most of many ways are impossible, and the search without clocks tells that soonest.
        if tried.parking and _is_impossible(scenario, seed, deadline):
            continue
        with suppress(NoPlanExists, GaveUp):
            plan = solve(scenario, PLANNER, deadline.seconds_left(), seed)
            return ReplanResult(plan=plan, cut_off=tried.cut_off)
        if not deadline.seconds_left():
            break
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class _Attempt:
    """Who is given up, what everybody is to do, and where those end who are given up."""

    cut_off: frozenset[int]
    stages: Stages
    parking: dict[int, int]


def _attempts(roadmap: Roadmap, rest: Rest, seed: int, deadline: Deadline) -> Iterator[_Attempt]:
    """Yield what to try, the best first."""
    pairs = zip(rest.at, rest.stages, strict=True)
    stages = [_within_reach(roadmap, at, left) for at, left in pairs]
    cut_off = {robot for robot, kept in enumerate(stages) if len(kept) < len(rest.stages[robot])}
    others = [robot for robot in range(len(stages)) if robot not in rest.broken | cut_off]
    for count in range(len(others) + 1):
        for more in combinations(others, count):
            parked = frozenset(cut_off.union(more))
            if 0 < len(parked) < len(stages):
                others_only = _scenario(rest, roadmap, stages, {}, gone=parked)
                if _is_impossible(others_only, seed, deadline):
                    continue  # so it is with the parked ones in the way
            idle = [[] if robot in parked else kept for robot, kept in enumerate(stages)]
            for todo in [stages, idle] if idle != stages else [stages]:
                for parking in _parkings(roadmap, rest, todo, parked, seed):
                    yield _Attempt(cut_off=parked, stages=todo, parking=parking)


def _is_impossible(scenario: Scenario, seed: int, deadline: Deadline) -> bool:
    """Tell whether it is proven that a fleet cannot get through its trips."""
    try:
        untimed_lacam(scenario, seed=seed, time_limit=deadline.seconds_left())
    except NoPlanExists:
        return True
    except GaveUp:
        pass
    return False


def _within_reach(roadmap: Roadmap, at: int, left: Sequence[Stage]) -> list[Stage]:
    """Return the stages that a robot can still get to, one after the other."""
    kept = []
    for stage in left:
        if stage.vertex in _reach(roadmap, at):
            kept.append(stage)
            at = stage.vertex
    return kept


def _reach(roadmap: Roadmap, start: int) -> list[int]:
    """Return the vertices that can be reached, the nearest first."""
    found = {start: None}
    for vertex in (queue := [start]):
        for head in roadmap.heads[roadmap.indptr[vertex] : roadmap.indptr[vertex + 1]].tolist():
            if head not in found:
                found[head] = None
                queue.append(head)
    return list(found)


def _parkings(
    roadmap: Roadmap, rest: Rest, stages: Stages, parked: frozenset[int], seed: int
) -> Iterator[dict[int, int]]:
    """Yield where these robots may end; near places that nobody else needs come first."""
    lasts = [kept[-1].vertex if kept else at for kept, at in zip(stages, rest.at, strict=True)]
    ends = {last for robot, last in enumerate(lasts) if robot not in parked}
    order = sorted(parked)
    choices = []
    for robot in order:
        needed = {one.vertex for r, kept in enumerate(stages) if r != robot for one in kept}
        places = [place for place in _reach(roadmap, lasts[robot]) if place not in ends]
        choices.append(sorted(places, key=needed.__contains__))
    for way in _ways(choices, random.Random(seed)):  # noqa: S311 (no secret depends on it)
        if len(set(way)) == len(way):
            yield dict(zip(order, way, strict=True))


def _ways(choices: Sequence[Sequence[int]], draw: random.Random) -> Iterator[tuple[int, ...]]:
    """Yield one of each; all ways, the first of each first, or random ones of too many."""
    if prod(map(len, choices)) <= MOST_SORTED:
        ranks = sorted(product(*(range(len(places)) for places in choices)), key=sum)
        yield from (tuple(p[k] for p, k in zip(choices, way, strict=True)) for way in ranks)
        return
    taken: list[int] = []
    for places in choices:
        taken.append(next((place for place in places if place not in taken), places[0]))
    yield tuple(taken)
    while True:
        yield tuple(draw.choice(places) for places in choices)


def _scenario(
    rest: Rest,
    roadmap: Roadmap,
    stages: Stages,
    parking: dict[int, int],
    gone: frozenset[int] = frozenset(),
) -> Scenario:
    """Return the problem of the rest: its robots go one way, from where they stand."""
    clock = rest.scenario.problem.clock
    robots = []
    for number, robot in enumerate(rest.scenario.robots):
        if number in gone:
            continue
        stops = [Stop(at=stage.vertex, work=clock.time(stage.work)) for stage in stages[number]]
        if number in parking or not stops:
            stops.append(Stop(at=VertexId(parking.get(number, rest.at[number]))))
        robots.append(_one_way(robot, rest.at[number], stops))
    return Scenario(roadmap=roadmap, robots=tuple(robots), rules=rest.scenario.rules, clock=clock)


def _one_way(robot: Robot, home: VertexId, stops: Sequence[Stop]) -> Robot:
    return replace(robot, home=home, stops=tuple(stops), ends="none", laps=1)
