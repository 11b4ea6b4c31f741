"""The shortest completion of each robot if it had the floor to itself: no plan beats their sum."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from functools import lru_cache
from itertools import chain, groupby, pairwise

import numpy as np

from rightofway.errors import NoPlanExists
from rightofway.metrics.dijkstra import shortest_ticks
from rightofway.metrics.hops import hops
from rightofway.model import Itinerary, Roadmap, Scenario, Tick, VertexId, least_dwell

__all__ = ["alone_completions"]

Leg = tuple[VertexId, VertexId]
Pace = tuple[Tick, ...]
"""Ticks of each length class of edges; robots of one speed have one pace."""


@lru_cache(maxsize=4)
def alone_completions(scenario: Scenario) -> tuple[Tick, ...]:
    """Return each robot's shortest completion time without the others.

    Parameters
    ----------
    scenario
        The problem.

    Returns
    -------
    tuple of int
        One for each robot [ticks].

    Raises
    ------
    NoPlanExists
        If no way leads from one place of a robot's trip to the next.

    Notes
    -----
    The latest answers are kept: a plan is measured once for the summary and once for its file.

    Where all edges are equally long, hops are counted for the whole fleet at once; on other
    roadmaps Dijkstra searches once for each pace and place.
    """
    itineraries = scenario.problem.itineraries
    wanted: defaultdict[Pace, set[Leg]] = defaultdict(set)
    for itinerary in itineraries:
        wanted[itinerary.edge_ticks].update(_legs(itinerary))
    uniform = len(scenario.roadmap.lengths) <= 1
    ways = (_by_hops if uniform else _by_ticks)(scenario.roadmap, wanted)
    driving = (_driving(scenario, robot, ways) for robot in range(len(itineraries)))
    return tuple(
        Tick(ticks + _dwell(itinerary))
        for ticks, itinerary in zip(driving, itineraries, strict=True)
    )


def _legs(itinerary: Itinerary) -> Iterable[Leg]:
    places = chain([itinerary.home], (stage.vertex for stage in itinerary.stages))
    return pairwise(place for place, _ in groupby(places))


def _dwell(itinerary: Itinerary) -> int:
    """Return how long all visits last; stages that follow each other at one vertex share one."""
    visits = [list(stages) for _, stages in groupby(itinerary.stages, lambda stage: stage.vertex)]
    moving = sum(least_dwell(stages, leaves=True) for stages in visits[:-1])
    return moving + least_dwell(visits[-1], leaves=False)


def _by_hops(roadmap: Roadmap, wanted: Mapping[Pace, set[Leg]]) -> dict[Pace, dict[Leg, int]]:
    legs = sorted(set().union(*wanted.values()))
    ends = np.array(legs, np.int64).reshape(-1, 2)
    hops_of = dict(zip(legs, hops(roadmap, ends[:, 0], ends[:, 1]).tolist(), strict=True))
    return {
        pace: {leg: hops_of[leg] * pace[0] for leg in own if hops_of[leg] >= 0}
        for pace, own in wanted.items()
    }


def _by_ticks(roadmap: Roadmap, wanted: Mapping[Pace, set[Leg]]) -> dict[Pace, dict[Leg, int]]:
    ways: dict[Pace, dict[Leg, int]] = {}
    for pace, legs in wanted.items():
        targets: defaultdict[VertexId, list[VertexId]] = defaultdict(list)
        for source, target in legs:
            targets[source].append(target)
        ways[pace] = {
            (source, target): ticks
            for source in targets
            for target, ticks in shortest_ticks(roadmap, pace, source, targets[source]).items()
        }
    return ways


def _driving(scenario: Scenario, robot: int, ways: Mapping[Pace, Mapping[Leg, int]]) -> int:
    itinerary = scenario.problem.itineraries[robot]
    own = ways[itinerary.edge_ticks]
    driving = 0
    for leg in _legs(itinerary):
        if leg not in own:
            tail, head = map(scenario.roadmap.name, leg)
            raise NoPlanExists(
                f"{scenario.robots[robot].name}: no way leads from {tail} to {head}"
                " (open one, or give the robot other places)"
            )
        driving += own[leg]
    return driving
