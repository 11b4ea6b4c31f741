"""Plans of the rest on other ways, where closures or broken robots block the old ones.

The smallest number of robots is *cut off*: such a robot serves the stages that it can reach and
ends at a vertex where it blocks no robot.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, islice

from rightofway.deadline import Deadline
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import Itinerary, Scenario, Stage, Tick, Track
from rightofway.native import find_clashes
from rightofway.precedence import build_timetable
from rightofway.repair.fleet_search import make_fleet_search
from rightofway.repair.moves import find_tracks_by_moves
from rightofway.repair.plan_request import PlanRequest
from rightofway.resume.commitment import Commitment, Stages, make_rest
from rightofway.search import Distances, plan_by_lacam
from rightofway.site import VertexId

MOST_STEPS = 20_000
"""Maximum steps of LaCAM, each a choice for every robot, for one choice of cut-off robots."""

SEARCHES, SHARE = 10, 0.5
"""Searches per robot for robots with a size, one after another, and the part of the time left."""

MOST_STATES = 3_000
"""Maximum number of states in the search for an order of their moves."""

MOST_CHOICES = 200
"""Maximum number of choices of cut-off robots, smallest choices first."""


def find_other_ways(
    rest: Scenario,
    broken: frozenset[int],
    commitments: Sequence[Commitment],
    seed: int,
    deadline: Deadline,
) -> tuple[list[Commitment], frozenset[int], list[Track]] | None:
    """Return commitments and stages, the smallest set of cut-off robots, and LaCAM's tracks."""
    is_simple = rest.problem.resources.are_points and not rest.closures
    find = _together if is_simple else _by_turns
    for cut_off, tried in islice(_choices(rest, broken, commitments), MOST_CHOICES):
        if deadline.measure_seconds_left() == 0:
            return None
        try:
            other_routes = find(make_rest(rest, rest.roadmap, tried), cut_off, seed, deadline)
        except (NoPlanExists, GaveUp):
            continue
        if other_routes is None:
            continue
        ended = [
            _with_end(commitment, commitment.left[:-1], int(own.vertices[-1]))
            if robot in cut_off
            else commitment
            for robot, (commitment, own) in enumerate(zip(tried, other_routes, strict=True))
        ]
        tracks = build_timetable(make_rest(rest, rest.roadmap, ended).problem, other_routes)
        if tracks is not None:
            return ended, cut_off, tracks
    return None


def _together(
    rest: Scenario, cut_off: frozenset[int], seed: int, deadline: Deadline
) -> Sequence[Track] | None:
    """Return the plan that LaCAM finds in steps."""
    return plan_by_lacam(
        rest.problem.as_steps(),
        seed=seed,
        most_effort=MOST_STEPS * len(rest.robots),
        time_limit=deadline.measure_seconds_left(),
        spreads=False,
        ends_anywhere=cut_off,
    )


def _by_turns(
    rest: Scenario, cut_off: frozenset[int], seed: int, deadline: Deadline
) -> Sequence[Track] | None:
    """Return the plan for robots one after another, or else of single moves, or by LaCAM."""
    problem = rest.problem
    request = PlanRequest(scenario=rest, seed=seed, deadline=deadline)
    tracks: Sequence[Track] = ()
    ends = [itinerary.last for itinerary in problem.itineraries]
    if not any(find_clashes(problem.resources, ends)):
        search = make_fleet_search(request)
        turns = sorted(range(len(rest.robots)), key=search.compute_alone().tolist().__getitem__)
        searches, limit = SEARCHES * len(turns), deadline.shorten(SHARE).measure_seconds_left()
        if search.prioritize(turns, searches=searches, time_limit=limit):
            tracks = search.list_tracks()
    if tracks:
        return tracks
    if problem.resources.are_points:  # its order of visits may keep the closures
        return _together(rest, cut_off, seed, deadline)
    return find_tracks_by_moves(request, ends_anywhere=cut_off, most_states=MOST_STATES)


def _choices(
    rest: Scenario, broken: frozenset[int], commitments: Sequence[Commitment]
) -> Iterator[tuple[frozenset[int], list[Commitment]]]:
    """Yield sets of cut-off robots, and stages of all robots: small sets, then most stages first.

    The last stage of a cut-off robot is its preferred end.
    """
    distances = Distances(rest.roadmap)
    reachable = [
        replace(commitment, left=_within_reach(distances, itinerary, commitment))
        for itinerary, commitment in zip(rest.problem.itineraries, commitments, strict=True)
    ]
    by_map = {
        robot
        for robot, commitment in enumerate(commitments)
        if len(reachable[robot].left) < len(commitment.left)
    }
    others = [robot for robot in range(len(commitments)) if robot not in broken | by_map]
    for count in range(len(others) + 1):
        for more in combinations(others, count):
            cut_off = frozenset(by_map.union(more))
            for most in (None, 0) if cut_off else (None,):
                tried = list(reachable)
                for robot in cut_off:
                    commitment, left = reachable[robot], reachable[robot].left[:most]
                    tried[robot] = _with_end(
                        commitment, left, left[-1].vertex if left else commitment.free_from
                    )
                yield cut_off, tried


def _within_reach(distances: Distances, itinerary: Itinerary, commitment: Commitment) -> Stages:
    """Return the stages that a robot can still reach, in order."""
    at, reached = commitment.free_from, []
    for stage in commitment.left:
        if distances.to(stage.vertex, itinerary.edge_ticks)[at] >= 0:
            reached.append(stage)
            at = stage.vertex
    return tuple(reached)


def _with_end(commitment: Commitment, left: Stages, vertex: int) -> Commitment:
    return replace(
        commitment, left=(*left, Stage(vertex=VertexId(vertex), work=Tick(0), turn=Tick(0)))
    )
