"""What each robot does in each tick, and for which robot it waits, read from a table of all ticks.

Slow and obvious: every vertex has one holder in each tick; a wait is for the robot that holds a
later vertex of the route in the tick before the waiting robot books it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

from rightofway.model import Plan, find_stays

__all__ = ["causes", "ticks_by_activity"]

Holders = dict[tuple[int, int], int]
"""The robot that books a vertex in a tick."""


def ticks_by_activity(plan: Plan) -> list[Counter[str]]:
    """Return for each robot how many ticks it works, drives, drives to make room, and waits."""
    found = []
    for track, stay in zip(plan.tracks, find_stays(plan.scenario, plan.tracks), strict=True):
        vertices, enter = track.vertices.tolist(), track.enter.tolist()
        room = _edges_of_loops(vertices, sorted({0, *stay.serves, len(vertices) - 1}))
        ticks: Counter[str] = Counter(works=int(stay.dwell[-1]))
        for visit, (begin, end) in enumerate(pairwise(enter)):
            for tick in range(begin, end):
                if tick < begin + stay.dwell[visit]:
                    ticks["works"] += 1
                elif tick >= end - stay.drive[visit]:
                    ticks["makes room" if visit in room else "drives"] += 1
                else:
                    ticks["waits"] += 1
        found.append(ticks)
    return found


def _edges_of_loops(vertices: Sequence[int], stops: Sequence[int]) -> set[int]:
    """Return the visits after which a robot drives on a loop: longest loops first come off."""
    loops: set[int] = set()
    for first, last in pairwise(stops):
        visits = list(range(first, last + 1))
        while True:
            pairs = [
                (i, -j)
                for i in range(len(visits))
                for j in range(i + 1, len(visits))
                if vertices[visits[i]] == vertices[visits[j]]
            ]
            if not pairs:
                break
            i, j = min(pairs)
            loops.update(range(visits[i], visits[-j]))
            visits = visits[:i] + visits[-j:]
    return loops


def causes(plan: Plan) -> Counter[tuple[int, int | None]]:
    """Return how long each robot waits for each other one, None where no robot is the cause."""
    stays = find_stays(plan.scenario, plan.tracks)
    holders = _holders(plan)
    ahead = plan.scenario.problem.booking_rules.books_ahead
    found: Counter[tuple[int, int | None]] = Counter()
    for robot, (track, stay) in enumerate(zip(plan.tracks, stays, strict=True)):
        for visit in range(len(track) - 1):
            awaited = None
            for later in range(visit + 1, len(track)):
                begin = int(track.enter[later]) - (int(stay.drive[later - 1]) if ahead else 0)
                holder = holders.get((int(track.vertices[later]), begin - 1), robot)
                if holder != robot:
                    awaited = holder
                    break
            found[robot, awaited] += int(stay.waits[visit])
    return +found


def _holders(plan: Plan) -> Holders:
    """Book every tick of every visit; what a robot books at its last vertex is no cause."""
    problem = plan.scenario.problem
    holders: Holders = {}
    for robot, track in enumerate(plan.tracks):
        for visit, (begin, end) in enumerate(pairwise(track.enter.tolist())):
            for tick in range(begin, end + problem.booking_rules.headway):
                holders.setdefault((int(track.vertices[visit]), tick), robot)
    return holders
