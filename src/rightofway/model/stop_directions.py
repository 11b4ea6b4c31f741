"""The direction in which a robot comes to a stop where robots may not turn.

Such a place is several vertices, one for each direction (`site.directions`). Unless it has a
heading, a robot may stop in any of them, and each changes the ways before and after. A robot stops
in the directions of a shortest trip of it alone, so that no plan has a smaller lower bound.

The trip is a shortest path through layers of the graph, one for each stage: the search of a stage
begins where all directions of the stage before have ended, with their times.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from heapq import heappop, heappush
from itertools import pairwise

from rightofway.model.itinerary import Itinerary
from rightofway.site import Roadmap, VertexId

State = tuple[int, int]
"""A vertex and the edge along which a robot has come; -1 where turning takes no time."""


def list_directions(roadmap: Roadmap, vertex: VertexId) -> tuple[VertexId, ...]:
    """Return the vertices in which a robot may stop at a place, the drawn one first."""
    drawn = roadmap.get_original(vertex)
    has_heading = any(at == drawn for at, _ in roadmap.drawing.headings)
    return (vertex,) if has_heading else (drawn, *roadmap.list_copies(drawn)[1:])


def choose_directions(roadmap: Roadmap, itinerary: Itinerary, home: VertexId) -> Itinerary:
    """Return a trip whose stops are in the directions of a shortest trip.

    Stages at the home keep its direction, so that each lap begins where the one before ends. A trip
    that is impossible remains as it is.
    """
    if not roadmap.originals:
        return itinerary
    choices = [
        (stage.vertex,) if stage.vertex == home else list_directions(roadmap, stage.vertex)
        for stage in itinerary.stages
    ]
    if all(len(own) == 1 for own in choices):
        return itinerary
    layers = _search_layers(roadmap, itinerary, choices)
    if layers is None:
        return itinerary
    chosen: list[VertexId] = []
    state = min(layers[-1], key=lambda own: layers[-1][own][0])
    for layer in reversed(layers):
        chosen.append(VertexId(state[0]))
        state = layer[state][1]
    stages = tuple(
        replace(stage, vertex=at)
        for stage, at in zip(itinerary.stages, reversed(chosen), strict=True)
    )
    return replace(itinerary, stages=stages)


Layer = dict[State, tuple[int, State]]
"""The least ticks to the states in which a stage may end, and the state where the last one did."""


def _search_layers(
    roadmap: Roadmap, itinerary: Itinerary, choices: list[tuple[VertexId, ...]]
) -> list[Layer] | None:
    """Return the layer of each stage; None where a stage cannot be reached."""
    start = int(itinerary.home), -1
    layer: Layer = {start: (0, start)}
    layers = []
    for choice in choices:
        layer = _search_leg(roadmap, itinerary, layer, {*map(int, choice)})
        if not layer:
            return None
        layers.append(layer)
    return layers


def _search_leg(roadmap: Roadmap, itinerary: Itinerary, before: Layer, goals: set[int]) -> Layer:
    """Return the states at the goals that are reached from those of the stage before (Dijkstra)."""
    ends, ticks_of = _list_edges(roadmap), itinerary.edge_ticks
    turning, first_turns = itinerary.turning, itinerary.first_turns
    queue = [(ticks, state, state) for state, (ticks, _) in before.items()]
    queue.sort()
    reached: Layer = {}
    known = set[State]()
    while queue:
        ticks, state, origin = heappop(queue)
        if state in known:
            continue
        known.add(state)
        at, edge_before = state
        if at in goals:
            reached[state] = ticks, origin
            if turning is None and len(reached) == len(goals):
                break
        for number, (edge, head, kind) in enumerate(ends[at]):
            if ticks_of[kind] < 0:
                continue
            further = ticks + ticks_of[kind]
            if turning is not None:
                further += turning.compute_turn(edge_before, edge)
                if edge_before < 0 and first_turns and at == itinerary.home:
                    further += first_turns[number]
            heappush(queue, (further, (head, -1 if turning is None else edge), origin))
    return reached


@lru_cache(maxsize=4)
def _list_edges(roadmap: Roadmap) -> list[list[tuple[int, int, int]]]:
    """Return the edges out of each vertex, with head and class."""
    first, heads, kinds = (
        values.tolist() for values in (roadmap.indptr, roadmap.heads, roadmap.class_of_edge)
    )
    return [
        [(edge, heads[edge], kinds[edge]) for edge in range(begin, end)]
        for begin, end in pairwise(first)
    ]
