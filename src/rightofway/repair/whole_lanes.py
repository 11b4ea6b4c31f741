"""A fleet on whole lanes, for a search that looks an instant ahead.

Robots do not turn back between pieces of a lane, so two robots that meet in a lane stay there for
good, and PIBT drives many robots into such lanes. On whole lanes robots wait at the ends only. The
order of visits on whole lanes is an order of visits on their pieces, where robots may follow each
other sooner: its earliest timetable is a plan.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, pairwise

import numpy as np

from rightofway.model import Problem, Tick, Track
from rightofway.model.resources import bind_resources
from rightofway.site import EdgeClass, Roadmap, VertexId
from rightofway.site.zones import Zone

Ends = tuple[VertexId, VertexId]


@dataclass(frozen=True, kw_only=True, eq=False)
class WholeLanes:
    """A problem on whole lanes, and how its tracks become tracks on the pieces.

    Attributes
    ----------
    problem
        The problem. The vertices keep their numbers; those between pieces have no edges. Turning
        takes no time.
    pieces
        The vertices along each lane that was split, by its ends, and the edges between them.
    given
        The problem on the pieces.
    """

    problem: Problem
    pieces: dict[Ends, tuple[tuple[VertexId, ...], list[int]]]
    given: Problem

    def split_track(self, robot: int, track: Track) -> Track:
        """Return a track with the vertices between pieces; it enters them as it drives past."""
        ticks = self.given.itineraries[robot].edge_ticks
        kinds = self.given.roadmap.class_of_edge
        vertices, enter = [int(track.vertices[0])], [int(track.enter[0])]
        for head, arrival in zip(
            track.vertices[1:].tolist(), track.enter[1:].tolist(), strict=True
        ):
            ends = VertexId(vertices[-1]), VertexId(head)
            along, edges = self.pieces.get(ends, (ends, []))
            drives = [int(ticks[kinds[edge]]) for edge in edges]
            vertices += map(int, along[1:])
            enter += [arrival - sum(drives) + part for part in accumulate(drives[:-1])]
            enter.append(arrival)
        return Track.of(vertices, enter)


@lru_cache(maxsize=1)  # for several attempts to plan one problem
def join_pieces(problem: Problem) -> WholeLanes | None:
    """Return a problem with an edge in the place of the pieces of each lane.

    None if no lane has vertices of its own for each direction, if a robot begins or works at one
    of these, or if the fleet has jobs or closures, or drives through vertices with ``pass``.
    """
    roadmap = problem.roadmap
    inside = {*roadmap.opposite}
    places = {stage.vertex for robot in problem.itineraries for stage in robot.stages}
    places.update(robot.home for robot in problem.itineraries)
    is_simple = not problem.has_times and problem.closures is None and roadmap.passing is None
    if not inside or inside & places or not is_simple:
        return None
    tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
    heads, kinds = roadmap.heads.tolist(), roadmap.class_of_edge.tolist()
    edge_of = {ends: edge for edge, ends in enumerate(zip(tails, heads, strict=True))}
    pieces = {
        lane.ends: (lane.vertices, [edge_of[piece] for piece in lane.pieces])
        for lane in roadmap.lanes
        if not inside.isdisjoint(lane.joints)
    }
    by_first = {edges[0]: (ends, edges) for ends, (_, edges) in pieces.items()}
    classes = dict[tuple[int, ...], int]()
    whole = list[tuple[int, int, int]]()
    for edge, (tail, head) in enumerate(zip(tails, heads, strict=True)):
        if tail not in inside:
            ends, along = by_first.get(edge, ((tail, head), [edge]))
            parts = tuple(kinds[piece] for piece in along)
            whole.append((tail, ends[1], classes.setdefault(parts, len(classes))))
    roads = _make_roadmap(roadmap, whole, list(classes), pieces)
    sizes = problem.resources.sizes
    given = {ticks for own in problem.itineraries for ticks in (own.edge_ticks, own.surcharges)}
    # Robots of one kind share one tuple, which is as long as all lanes where lengths differ.
    sums = {ticks: tuple(_add_up(ticks, parts) for parts in classes) for ticks in given if ticks}
    itineraries = (
        replace(
            own,
            edge_ticks=sums.get(own.edge_ticks, ()),
            surcharges=sums.get(own.surcharges, ()),
            turning=None,
        )
        for own in problem.itineraries
    )
    return WholeLanes(
        problem=replace(
            problem,
            roadmap=roads,
            itineraries=tuple(itineraries),
            resources=bind_resources(
                roads,
                [sizes[size] for size in problem.resources.size_of.tolist()],
                problem.resources.clearance,
            ),
        ),
        pieces=pieces,
        given=problem,
    )


def _add_up(ticks: Sequence[Tick], parts: Sequence[int]) -> Tick:
    """Return the ticks of all parts of a lane; -1 if one of them is barred."""
    own = [ticks[part] for part in parts]
    return Tick(-1) if min(own) < 0 else Tick(sum(own))


def _make_roadmap(
    roadmap: Roadmap,
    edges: Sequence[tuple[int, int, int]],
    classes: Sequence[Sequence[int]],
    pieces: dict[Ends, tuple[tuple[VertexId, ...], list[int]]],
) -> Roadmap:
    """Return the roadmap with other edges: tail, head and class of each, by tail."""
    tails, heads, kinds = np.array(edges, np.int32).reshape(-1, 3).T
    degrees = np.bincount(tails, minlength=roadmap.n_vertices)
    ends_of = {
        (tail, head): ends for ends, (along, _) in pieces.items() for tail, head in pairwise(along)
    }
    lengths = roadmap.lengths
    return replace(
        roadmap,
        indptr=np.concatenate(([0], np.cumsum(degrees))).astype(np.int32),
        heads=heads.copy(),
        class_of_edge=kinds.copy(),
        edge_classes=tuple(
            EdgeClass(length=sum((lengths[part] for part in parts), Fraction(0)))
            for parts in classes
        ),
        zones=tuple(
            Zone(
                name=zone.name,
                vertices=zone.vertices,
                edges=tuple(dict.fromkeys(ends_of.get(ends, ends) for ends in zone.edges)),
            )
            for zone in roadmap.zones
        ),
        lanes=(),
    )
