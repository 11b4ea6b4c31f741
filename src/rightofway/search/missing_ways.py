"""Robots that have no way to a place of their trip, where and why: proofs that no plan exists."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from rightofway.errors import MAX_REASONS, Blockage
from rightofway.facts import Fact
from rightofway.model import Itinerary, Scenario, Tick
from rightofway.search.distances import Distances
from rightofway.site import Roadmap, VertexId
from rightofway.site.walls import find_narrowest


def reaches_its_places(itinerary: Itinerary, distances: Distances) -> bool:
    """Return whether a robot has a way from each place of its trip to the next."""
    legs = _list_legs(itinerary)
    return all(distances.to(head, itinerary.edge_ticks)[tail] >= 0 for tail, head in legs)


def _list_legs(itinerary: Itinerary) -> list[tuple[VertexId, VertexId]]:
    """Return each place of a trip with the next one, each pair once."""
    places = [itinerary.home, *(stage.vertex for stage in itinerary.stages)]
    return list(dict.fromkeys(pairwise(places)))


def find_missing_ways(scenario: Scenario, stranded: Iterable[int]) -> Iterator[Blockage]:
    """Yield where robots have no way, and whether parts of the map or one-way edges are why."""
    parts, distances = RoadmapParts(scenario.roadmap), None
    for robot in stranded:
        itinerary = scenario.problem.itineraries[robot]
        home_part = parts.find_part(itinerary.home)
        stages = dict.fromkeys(stage.vertex for stage in itinerary.stages)
        elsewhere = [vertex for vertex in stages if vertex not in home_part]
        if elsewhere:
            home, apart = itinerary.home, tuple(elsewhere)
            reason = Fact("map in parts", robot=robot, tail=home, head=apart)
            yield Blockage(reason, (robot,), (home, *apart), Fact("join the parts"))
            continue
        legs, opened = _list_legs(itinerary), _open_all_edges(itinerary)
        distances = distances or Distances(scenario.roadmap)
        for tail, head in legs:
            if distances.to(head, itinerary.edge_ticks)[tail] >= 0:
                continue
            values: dict[str, Any] = {}
            kind, remedy = "one-way edges", "drive more both ways"
            if distances.to(head, opened)[tail] >= 0:
                kind, values, remedy = _describe_barred(scenario, robot, tail, head)
            elif _has_way_with_turns(scenario.roadmap, tail, head):
                kind, remedy = "forbidden turns", "allow turns"
            elif opening := parts.find_opening(tail, head):
                values = {"first": opening[0], "last": opening[1]}
                kind, remedy = "one-way edge", "drive both ways"
            why = Fact(kind, **values)
            reason = Fact("no way of robot", robot=robot, tail=tail, head=head, why=why)
            yield Blockage(reason, (robot,), (tail, head), Fact(remedy))


def _has_way_with_turns(roadmap: Roadmap, tail: VertexId, head: VertexId) -> bool:
    """Return whether turns at vertices where robots may not turn would make a way."""
    if not roadmap.fixed:
        return False
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    ways: dict[VertexId, list[VertexId]] = {}
    for begin, end in zip(map(VertexId, tails), map(VertexId, roadmap.heads.tolist()), strict=True):
        ways.setdefault(begin, []).append(end)
        if end in roadmap.fixed:  # a robot that turns there drives back
            ways.setdefault(end, []).append(begin)
    reached, ahead = {tail}, [tail]
    while ahead:
        for vertex in roadmap.list_copies(ahead.pop()):
            new = {*ways.get(vertex, ()), *roadmap.list_copies(vertex)} - reached
            reached |= new
            ahead += new
    return head in reached


def _describe_barred(
    scenario: Scenario, robot: int, tail: VertexId, head: VertexId
) -> tuple[str, dict[str, Any], str]:
    """Return why a robot has no way where others have one, as a kind with values, and a remedy.

    On a grid edges are barred by the width of robots only, elsewhere by their types.
    """
    barred = scenario.robots[robot]
    has_walls = scenario.roadmap.grid is not None
    narrowest = find_narrowest(scenario.roadmap, tail, head) if has_walls else None
    if narrowest is None:
        return "edges barred for type", {"type": barred.type}, "open an edge"
    room, place = narrowest
    values = {"radius": barred.radius, "room": room, "place": place}
    return "walls too near", values, "widen the way of robot"


def _open_all_edges(itinerary: Itinerary) -> tuple[Tick, ...]:
    """Return ticks of edges, each at least 1 also where the robot is barred."""
    return tuple(max(ticks, Tick(1)) for ticks in itinerary.edge_ticks)


class RoadmapParts:
    """The parts of a map that no edge joins, and its edges in both directions."""

    def __init__(self, roadmap: Roadmap) -> None:
        self.roadmap = roadmap
        self.searches = 0
        self._of: dict[int, frozenset[int]] = {}

    def find_part(self, vertex: int) -> frozenset[int]:
        """Return the part that holds a vertex."""
        if vertex not in self._of:
            ends = [*self.ends, *((head, tail) for tail, head in self.ends)]
            part = frozenset(find_reached_vertices(vertex, ends))
            self._of.update(dict.fromkeys(part, part))
        return self._of[vertex]

    @cached_property
    def ends(self) -> list[tuple[int, int]]:
        """Tail and head of each edge."""
        roadmap = self.roadmap
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        return list(zip(tails.tolist(), roadmap.heads.tolist(), strict=True))

    def find_opening(self, tail: int, head: int) -> tuple[int, int] | None:
        """Return a one-way edge that, driven both ways, would lead from ``tail`` to ``head``.

        None if there is none, or after as many searches as a message has lines.
        """
        self.searches += 1
        if self.searches > MAX_REASONS:
            return None
        ends = self.ends
        before = find_reached_vertices(tail, ends)
        after = find_reached_vertices(head, [(end, begin) for begin, end in ends])
        return next((edge for edge in ends if edge[0] in after and edge[1] in before), None)


def find_reached_vertices(
    start: int, ends: Iterable[tuple[int, int]], closed: Collection[int] = ()
) -> set[int]:
    """Return the vertices that can be reached along edges, none of them closed."""
    heads: defaultdict[int, list[int]] = defaultdict(list)
    for tail, head in ends:
        heads[tail].append(head)
    reached, waiting = {start}, [start]
    while waiting:
        for head in heads[waiting.pop()]:
            if head not in reached and head not in closed:
                reached.add(head)
                waiting.append(head)
    return reached
