"""Places of a site that are nearer than its robots are wide: vertices, lanes, walls, crossings."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import product
from math import dist

import numpy as np

from rightofway.facts import Fact
from rightofway.metrics.site import Finding, Site
from rightofway.model.resources import ClosePairs, close_pairs
from rightofway.site import Roadmap
from rightofway.site.geometry import measure_squared_distance
from rightofway.site.walls import reaches_walls
from rightofway.site.zone_guard import ZoneGuard

TOUCHING = Fraction(1, 10**6)
"""Vertices and lanes nearer than this touch, whatever the size of the robots [length unit]."""

ROUNDED = 10**6
"""Distances in sentences are rounded to this part of a length unit."""

TAKE_TURNS = Fact("wait at lanes")
"""The remedy for lanes that cross or are near; the drawing is not wrong."""

MOST_NAMED = 200
"""The most vertices that a finding names."""


def find_nearness(site: Site, joints: frozenset[int]) -> Iterator[Finding]:
    """Yield vertices, lanes and walls nearer than robots are wide, and lanes that cross.

    Joints between pieces of a lane are no vertices: things near to one are near to the lane.
    """
    yield from _find_beside_walls(site)
    yield from _find_near(site, joints)


def _find_beside_walls(site: Site) -> Iterator[Finding]:
    """Yield for each radius where a robot would reach into the walls of a grid."""
    roadmap = site.roadmap
    if roadmap.grid is None or site.rules.walls == "strict":
        return
    wide = {robot.radius for robot in site.robots if 2 * robot.radius > roadmap.grid.cell_size}
    for radius in sorted(wide):
        reaches = np.flatnonzero(reaches_walls(roadmap, radius)).tolist()
        if reaches:
            yield Finding(
                kind="too near",
                severity="warning",
                fact=Fact(
                    "walls reached", site, radius=radius, cells=len(reaches), place=reaches[0]
                ),
                remedy=Fact("keep out of walls"),
                vertices=site.list_names(reaches[:MOST_NAMED]),
                robots=tuple(robot.name for robot in site.robots if robot.radius == radius),
            )


def _find_near(site: Site, joints: frozenset[int]) -> Iterator[Finding]:
    """Yield vertices and lanes that are nearer than the robots are wide, and lanes that cross."""
    roadmap, room = site.roadmap, site.room
    need = _find_need(site) if room else None
    size = find_smallest_cell(roadmap)
    if size is not None:
        if need and size < room:
            is_even = roadmap.sides is None
            yield Finding(
                kind="too near",
                severity="warning",
                fact=Fact(
                    "cells near each other",
                    site,
                    cells=Fact("all cells" if is_even else "smallest cells"),
                    distance=size,
                    need=need,
                ),
                remedy=Fact("take larger cells"),
            )
        return
    pairs, near_lanes = _find_drawn_pairs(roadmap, room or TOUCHING, joints)
    yield from _find_near_vertices(site, pairs, need)
    for vertex, (tail, head) in pairs.beside:
        if roadmap.is_along_one_lane((vertex, tail, head)):
            continue
        ends = {"place": vertex, "tail": tail, "head": head}
        yield Finding(
            kind="too near",
            severity="warning",
            fact=Fact("vertex near lane", site, **ends, need=need)
            if need
            else Fact("vertex on lane", site, **ends),
            remedy=Fact("move one" if need else "split the lane"),
            vertices=site.list_names((vertex, tail, head)),
        )
    for lanes in near_lanes:
        if not need:  # all that touches crosses
            break
        first, other = lanes
        yield Finding(
            kind="too near",
            severity="note",
            fact=Fact("lanes near each other", site, one=first, other=other, need=need),
            remedy=TAKE_TURNS,
            vertices=site.list_names(vertex for lane in lanes for vertex in lane),
        )
    for lanes in pairs.crossings:
        first, other = lanes
        yield Finding(
            kind="crossing",
            severity="note" if need else "warning",
            fact=Fact("lanes cross", site, one=first, other=other),
            remedy=TAKE_TURNS if need else Fact("draw a vertex"),
            vertices=site.list_names(vertex for lane in lanes for vertex in lane),
        )


Lanes = tuple[tuple[int, int], tuple[int, int]]
"""Tail and head of two lanes."""


def _find_need(site: Site) -> Fact:
    """Return the distance that the two largest robots need, and why."""
    values = {"sizes": tuple(dict.fromkeys(site.radii)), "room": site.room}
    if not site.rules.clearance:
        return Fact("room for robots", **values)
    return Fact("room for robots apart", clearance=site.rules.clearance, **values)


def _find_drawn_pairs(
    roadmap: Roadmap, distance: Fraction, joints: frozenset[int]
) -> tuple[ClosePairs, list[Lanes]]:
    """Return the vertices and lanes that are near, as they are drawn, and lanes near to others.

    Lanes are whole, joints no vertices. Lanes near to others are those that do not cross and have
    no common end.
    """
    pairs = close_pairs(roadmap, distance)
    if not joints:
        return pairs, []
    lane_at, lane_of = dict[int, tuple[int, int]](), dict[frozenset[int], tuple[int, int]]()
    pieces_at = defaultdict[int, list[tuple[int, int]]](list)
    for lane in roadmap.lanes:
        ends = min(lane.ends, lane.ends[::-1])
        lane_at.update((joint, ends) for joint in lane.joints if joint in joints)
        lane_of.update((frozenset(piece), ends) for piece in lane.pieces)
        for piece, end in product(lane.pieces, (0, 1)):
            if piece[end] in joints:
                pieces_at[piece[end]].append(piece)

    def whole(edge: tuple[int, int]) -> tuple[int, int]:
        return lane_of.get(frozenset(edge), edge)

    vertices = [pair for pair in pairs.vertices if joints.isdisjoint(pair)]
    near_ends = {frozenset(pair) for pair in vertices}
    near_pieces = [
        *((vertex, lane_at[joint])
          for pair in pairs.vertices for vertex, joint in (pair, pair[::-1])
          if joint in lane_at and vertex not in lane_at),
        *((vertex, whole(edge)) for vertex, edge in pairs.beside if vertex not in joints),
    ]  # fmt: skip
    beside = [
        (vertex, lane)
        for vertex, lane in dict.fromkeys(near_pieces)
        if vertex not in lane and not any(frozenset((vertex, end)) in near_ends for end in lane)
    ]

    guard = ZoneGuard(roadmap)

    def meeting(pairs: ClosePairs) -> Iterator[Lanes]:
        at_joints = ((pieces_at[first], pieces_at[other]) for first, other in pairs.vertices)
        at_lanes = ((pieces_at[joint], [edge]) for joint, edge in pairs.beside)
        for pieces, others in (*at_joints, *at_lanes):
            if pieces and others and not guard.are_apart(pieces, others):
                yield whole(pieces[0]), whole(others[0])

    # Lanes that cross at a joint touch there: no piece is on both sides of the other lane.
    touching = _list_apart(meeting(close_pairs(roadmap, TOUCHING)))
    crossings = _sort_lanes((whole(first), whole(other)) for first, other in pairs.crossings)
    crossings = list(dict.fromkeys([*crossings, *touching]))
    crossed = set(crossings)
    near = [lanes for lanes in _list_apart(meeting(pairs)) if lanes not in crossed]
    return ClosePairs(vertices=vertices, beside=beside, crossings=crossings), near


def _list_apart(pairs: Iterable[Lanes]) -> list[Lanes]:
    """Return pairs of lanes without a common end, each once."""
    return _sort_lanes(lanes for lanes in pairs if {*lanes[0]}.isdisjoint(lanes[1]))


def _sort_lanes(pairs: Iterable[Lanes]) -> list[Lanes]:
    """Return pairs of two lanes, each once."""
    return list(dict.fromkeys(min(lanes, lanes[::-1]) for lanes in pairs if lanes[0] != lanes[1]))


def find_smallest_cell(roadmap: Roadmap) -> Fraction | None:
    """Return the side of the smallest cells, None where vertices are no cells."""
    if roadmap.grid is not None:
        return roadmap.grid.cell_size
    return None if roadmap.sides is None else min(roadmap.sides)


def _find_near_vertices(site: Site, pairs: ClosePairs, need: Fact | None) -> Iterator[Finding]:
    roadmap = site.roadmap
    for first, other in pairs.vertices:
        if roadmap.is_along_one_lane((first, other)):
            continue
        both_homes = _has_home_clash(site, first, other)
        is_joined = (
            roadmap.find_edge(first, other) is not None
            or roadmap.find_edge(other, first) is not None
        )
        are_places = first in site.places and other in site.places
        both = {"one": first, "other": other}
        distance = round_distance(roadmap, first, other)
        yield Finding(
            kind="too near",
            severity="error"
            if both_homes
            else "note"
            if is_joined and not are_places
            else "warning",
            fact=Fact("vertices near each other", site, **both, distance=distance, need=need)
            if need
            else Fact("vertices at one point", site, **both),
            remedy=Fact("move one vertex" if need else "make one vertex"),
            vertices=site.list_names((first, other)),
        )


def _has_home_clash(site: Site, first: int, other: int) -> bool:
    """Whether robots live at two vertices that are nearer than just these robots need."""
    radius = {int(robot.home): robot.radius for robot in site.robots}
    if not {first, other} <= radius.keys() or not radius[first] + radius[other]:
        return False
    at = site.roadmap.get_point(first), site.roadmap.get_point(other)
    return (
        measure_squared_distance(*at) < (radius[first] + radius[other] + site.rules.clearance) ** 2
    )


def round_distance(roadmap: Roadmap, first: int, other: int) -> Fraction:
    """Return the distance of two vertices, rounded for people [length unit]."""
    away = dist(roadmap.positions[first].tolist(), roadmap.positions[other].tolist())
    return Fraction(round(away * ROUNDED), ROUNDED)
