"""How the vertices of a roadmap hang together: strong parts, dominators, corridors, load of routes.

All functions take about V + E steps, or that for each source, and work on lists: the roadmaps of
sites are small, and a map in cells of 50 000 vertices takes a fraction of a second for each.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush
from itertools import pairwise
from math import lcm

import numpy as np

from rightofway.site import Roadmap

Neighbours = Sequence[Sequence[int]]
"""The vertices that edges of each vertex lead to, or come from."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ways:
    """The edges of a roadmap, as lists; a lane that was split into pieces is one edge.

    Attributes
    ----------
    along, against
        Heads of the edges that leave each vertex; tails of those that enter it.
    steps
        Length of each edge of `along`, as a whole multiple of `unit`.
    unit
        Length of a step [length unit].
    even
        The length of all edges in these multiples; 0 where they differ.
    joints
        Vertices between two pieces of lanes: no edge leads there.
    """

    along: list[list[int]]
    against: list[list[int]]
    steps: list[list[int]]
    unit: Fraction = Fraction(1)
    even: int = 0
    joints: frozenset[int] = frozenset()

    @property
    def vertices(self) -> list[int]:
        """All vertices but joints."""
        return [vertex for vertex in range(len(self.along)) if vertex not in self.joints]

    def find_neighbours(self, vertex: int) -> set[int]:
        """Return the vertices that an edge joins to a vertex, in either direction."""
        return {*self.along[vertex], *self.against[vertex]}


def list_ways(roadmap: Roadmap, places: Collection[int] = ()) -> Ways:
    """Return the edges of a roadmap as lists; pieces of a lane are one edge.

    A joint of pieces stays a vertex where it is one of some places, or where other edges meet it.
    """
    scale = lcm(*(length.denominator for length in roadmap.lengths))
    steps = [int(length * scale) for length in roadmap.lengths]
    lengths = [steps[edge_class] for edge_class in roadmap.class_of_edge.tolist()]
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    edges = list(zip(tails, roadmap.heads.tolist(), lengths, strict=True))
    joints = frozenset[int]()
    if roadmap.lanes:
        joints = _find_hidden_joints(roadmap, edges, places)
        edges = list(_join_pieces(roadmap, edges, joints))
    along, against, steps_along = (
        [list[int]() for _ in range(roadmap.n_vertices)] for _ in range(3)
    )
    for tail, head, length in edges:
        along[tail].append(head)
        steps_along[tail].append(length)
        against[head].append(tail)
    different = {length for _, _, length in edges}
    return Ways(
        along=along,
        against=against,
        steps=steps_along,
        unit=Fraction(1, scale),
        even=different.pop() if len(different) == 1 else 0,
        joints=joints,
    )


def _find_hidden_joints(
    roadmap: Roadmap, edges: Sequence[tuple[int, int, int]], places: Collection[int]
) -> frozenset[int]:
    """Return the joints that are no place, and that only pieces of their lanes meet."""
    pieces = {piece for lane in roadmap.lanes for piece in lane.pieces}
    met = {end for tail, head, _ in edges if (tail, head) not in pieces for end in (tail, head)}
    joints = {int(joint) for lane in roadmap.lanes for joint in lane.joints}
    return frozenset(joints.difference(met, places))


def _join_pieces(
    roadmap: Roadmap, edges: Sequence[tuple[int, int, int]], joints: Collection[int]
) -> Iterator[tuple[int, int, int]]:
    """Yield the edges between vertices that are no joints: tail, head and length."""
    pieces_behind: dict[tuple[int, int], tuple[int, int]] = {
        piece: following for lane in roadmap.lanes for piece, following in pairwise(lane.pieces)
    }
    length_of = {(tail, head): length for tail, head, length in edges if tail in joints}
    for tail, head, length in edges:
        if tail not in joints:
            piece, along = (tail, head), length
            while piece[1] in joints:
                piece = pieces_behind[piece]
                along += length_of[piece]
            yield tail, piece[1], along


def find_strong_parts(ways: Ways) -> list[list[int]]:
    """Return the largest sets of vertices that all reach each other, the largest set first.

    References
    ----------
    Sharir, *A strong-connectivity algorithm and its applications in data flow analysis*, 1981: a
    search along the edges gives the order of a second search against them.
    """
    count = len(ways.along)
    order, seen = list[int](), [False] * count
    for root in ways.vertices:
        stack = [] if seen[root] else [(root, iter(ways.along[root]))]
        seen[root] = True
        while stack:
            vertex, heads = stack[-1]
            following = next((head for head in heads if not seen[head]), None)
            if following is None:
                order.append(vertex)
                stack.pop()
            else:
                seen[following] = True
                stack.append((following, iter(ways.along[following])))
    parts, is_found = list[list[int]](), [False] * count
    for root in reversed(order):
        if not is_found[root]:
            part = reach_from([root], ways.against, lambda tail: not is_found[tail])
            for vertex in part:
                is_found[vertex] = True
            parts.append(sorted(part))
    return sorted(parts, key=lambda part: (-len(part), part[0]))


def reach_from(
    roots: Collection[int], neighbours: Neighbours, may_enter: Callable[[int], bool]
) -> list[int]:
    """Return the vertices that can be reached from roots, in order of a breadth-first search."""
    reached, seen = list(roots), set(roots)
    for vertex in reached:  # grows as it goes
        for other in neighbours[vertex]:
            if other not in seen and may_enter(other):
                seen.add(other)
                reached.append(other)
    return reached


def find_immediate_dominators(along: Neighbours, against: Neighbours, root: int) -> dict[int, int]:
    """Return, for each vertex that the root reaches, the last vertex that no way to it avoids.

    References
    ----------
    Georgiadis, *Linear-time algorithms for dominators and related problems*, 2005: Semi-NCA.
    """
    order, parent = _walk_depth_first(along, root)
    number = {vertex: index for index, vertex in enumerate(order)}
    count = len(order)
    semi, label, ancestor = list(range(count)), list(range(count)), parent[:]

    def least(vertex: int, linked: int) -> int:
        """Return the vertex of least semidominator above one, and shorten the path to it."""
        path = list[int]()
        while ancestor[vertex] >= linked:
            path.append(vertex)
            vertex = ancestor[vertex]
        above, best = vertex, label[vertex]
        for below in reversed(path):
            ancestor[below] = ancestor[above]
            if semi[best] < semi[label[below]]:
                label[below] = best
            best, above = label[below], below
        return label[above]

    for vertex in range(count - 1, 0, -1):
        semi[vertex] = parent[vertex]
        for tail in against[order[vertex]]:
            if tail in number:
                semi[vertex] = min(semi[vertex], semi[least(number[tail], vertex + 1)])
    dominator = parent[:]
    for vertex in range(1, count):
        while dominator[vertex] > semi[vertex]:
            dominator[vertex] = dominator[dominator[vertex]]
    return {order[vertex]: order[dominator[vertex]] for vertex in range(1, count)}


def _walk_depth_first(along: Neighbours, root: int) -> tuple[list[int], list[int]]:
    """Return the vertices in the order of a depth-first search, and the number before each."""
    order, parent, seen = [root], [0], {root}
    stack = [(0, iter(along[root]))]
    while stack:
        last, heads = stack[-1]
        head = next((neighbour for neighbour in heads if neighbour not in seen), None)
        if head is None:
            stack.pop()
            continue
        seen.add(head)
        stack.append((len(order), iter(along[head])))
        order.append(head)
        parent.append(last)
    return order, parent


def find_separations(ways: Ways, places: Sequence[int]) -> dict[int, set[int]]:
    """Return for each vertex the places that no robot reaches, or leaves, without passing it.

    Returns
    -------
    dict
        For each vertex that separates places, those on the other side of it than the first place;
        for the first place, those on the other side than the second. Exact: a vertex that is not
        in it can be closed, and all other places still reach each other.
    """
    cut_off: dict[int, set[int]] = defaultdict(set)
    for root, judged in zip(places[:2], (None, places[0] if places else None), strict=False):
        for along, against in ((ways.along, ways.against), (ways.against, ways.along)):
            above = find_immediate_dominators(along, against, root)
            for place in places:
                vertex = above.get(place, root)
                while vertex != root:
                    if judged is None or vertex == judged:
                        cut_off[vertex].add(place)
                    vertex = above[vertex]
    return dict(cut_off)


@dataclass(frozen=True, slots=True, kw_only=True)
class Corridor:
    """A chain of vertices that are driven through both ways, and have no third neighbour.

    Attributes
    ----------
    inside
        Its vertices, in order.
    ends
        The vertices before and behind it.
    steps
        Its length between its ends, in the steps of `Ways`.
    """

    inside: tuple[int, ...]
    ends: tuple[int, int]
    steps: int


def find_corridors(ways: Ways) -> list[Corridor]:
    """Return all corridors, the longest first.

    A ring is none, also where one vertex joins it to the rest: robots pass each other on it.
    """

    def is_inside(vertex: int) -> bool:
        heads = {*ways.along[vertex]}
        return len(heads) == 2 and heads == {*ways.against[vertex]}  # noqa: PLR2004 - a chain

    def walked(before: int, vertex: int) -> list[int]:
        path = [before, vertex]
        while is_inside(path[-1]) and path[-1] != start:
            path += {*ways.along[path[-1]]} - {path[-2]}
        return path

    corridors_found, seen = list[Corridor](), set[int]()
    for start in range(len(ways.along)):
        if start in seen or not is_inside(start):
            continue
        left, right = (walked(start, head) for head in sorted({*ways.along[start]}))
        seen.update((start, *left[1:-1], *right[1:-1]))
        if left[-1] in {start, right[-1]}:
            continue
        path = [*reversed(left), *right[1:]]
        steps = sum(ways.steps[tail][ways.along[tail].index(head)] for tail, head in pairwise(path))
        corridors_found.append(
            Corridor(inside=tuple(path[1:-1]), ends=(path[0], path[-1]), steps=steps)
        )
    return sorted(corridors_found, key=lambda corridor: (-corridor.steps, corridor.inside))


def measure_distances_from(ways: Ways, source: int) -> tuple[list[int], dict[int, int]]:
    """Return the vertices that a source reaches, by distance, and their distances [steps]."""
    if ways.even:
        return _measure_levels_from(ways, source)
    distance, order, settled = {source: 0}, list[int](), set[int]()
    queue = [(0, source)]
    while queue:
        gone, vertex = heappop(queue)
        if vertex in settled:
            continue
        settled.add(vertex)
        order.append(vertex)
        for head, step in zip(ways.along[vertex], ways.steps[vertex], strict=True):
            further = gone + step
            if further < distance.get(head, further + 1):
                distance[head] = further
                heappush(queue, (further, head))
    return order, distance


def _measure_levels_from(ways: Ways, source: int) -> tuple[list[int], dict[int, int]]:
    """Measure distances from a source where all edges have one length: level after level."""
    distance, order, level, gone = {source: 0}, list[int](), [source], 0
    while level:
        order += level
        gone += ways.even
        heads = {head for vertex in level for head in ways.along[vertex]}
        level = sorted(head for head in heads if head not in distance)
        distance.update(dict.fromkeys(level, gone))
    return order, distance


def _list_before(ways: Ways, vertex: int, distance: Mapping[int, int]) -> list[int]:
    """Return the vertices from which shortest ways enter a vertex."""
    at, tails = distance[vertex], ways.against[vertex]
    if ways.even:
        return [tail for tail in tails if distance.get(tail) == at - ways.even]
    return [
        tail
        for tail in tails
        if tail in distance
        and distance[tail] + ways.steps[tail][ways.along[tail].index(vertex)] == at
    ]


def measure_route_load(ways: Ways, trips: Mapping[int, Mapping[int, float]]) -> dict[int, float]:
    """Return how many shortest routes pass each vertex; their own ends do not count.

    Notes
    -----
    Where several routes are equally short, each vertex is entered in equal parts from all vertices
    before it.

    References
    ----------
    Goh, Kahng and Kim, *Universal behavior of load distribution in scale-free networks*, Physical
    Review Letters, 2001.
    """
    load: dict[int, float] = defaultdict(float)
    for source, targets in trips.items():
        order, distance = measure_distances_from(ways, source)
        own: dict[int, float] = defaultdict(float)
        for vertex in reversed(order[1:]):
            passing, ending = own[vertex], targets.get(vertex, 0)
            if not passing and not ending:
                continue
            load[vertex] += passing
            before = _list_before(ways, vertex, distance)
            for tail in before:
                own[tail] += (passing + ending) / len(before)
    return dict(load)
