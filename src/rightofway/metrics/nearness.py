"""What is nearer on a site than its robots are wide: vertices, lanes, walls; and crossings."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import dist

import numpy as np

from rightofway.metrics.site import Finding, Site
from rightofway.model.resources import ClosePairs, close_pairs
from rightofway.phrases import Phrase, join_items, say_count
from rightofway.site import Roadmap
from rightofway.site.geometry import measure_squared_distance
from rightofway.site.walls import reaches_walls

TOUCHING = Fraction(1, 10**6)
"""Vertices and lanes nearer than this touch, whatever the size of the robots [length unit]."""

ROUNDED = 10**6
"""Distances in sentences are rounded to this part of a length unit."""

TAKE_TURNS = Phrase("robots wait for each other there; a vertex lets them wait nearer")
"""What to do where lanes cross, or their pieces are too near: nothing is drawn in a wrong place."""

MOST_NAMED = 200
"""The most vertices that a finding names."""


def find_nearness(site: Site) -> Iterator[Finding]:
    """Yield vertices, lanes and walls nearer than robots are wide, and lanes that cross."""
    yield from _beside_walls(site)
    yield from _near(site)


def _beside_walls(site: Site) -> Iterator[Finding]:
    """Yield for each radius where a robot would reach into the walls of a grid."""
    roadmap, length = site.roadmap, site.units.format_length
    if roadmap.grid is None or site.rules.walls == "strict":
        return
    wide = {robot.radius for robot in site.robots if 2 * robot.radius > roadmap.grid.cell_size}
    for radius in sorted(wide):
        reaches = np.flatnonzero(reaches_walls(roadmap, radius)).tolist()
        if reaches:
            yield Finding(
                kind="too near",
                severity="warning",
                fact=Phrase(
                    "A robot of radius {radius} reaches into walls in {cells}, for example in"
                    " {place}",
                    radius=length(radius),
                    cells=say_count(len(reaches), "cell", "cells"),
                    place=site.name(reaches[0]),
                ),
                remedy=Phrase(
                    "set walls: strict, so that it keeps out of them, or take larger cells"
                ),
                vertices=site.list_names(reaches[:MOST_NAMED]),
                robots=tuple(robot.name for robot in site.robots if robot.radius == radius),
            )


def _near(site: Site) -> Iterator[Finding]:
    """Yield vertices and lanes that are nearer than the robots are wide, and lanes that cross."""
    roadmap, room = site.roadmap, site.room
    length = site.units.format_length
    need = None
    if room:
        sizes = join_items([length(radius) for radius in dict.fromkeys(site.radii)])
        need = Phrase("robots of radius {sizes} need {room}", sizes=sizes, room=length(room))
        if site.rules.clearance:
            need = Phrase(
                "robots of radius {sizes} and {clearance} apart need {room}",
                sizes=sizes,
                clearance=length(site.rules.clearance),
                room=length(room),
            )
    size = find_smallest_cell(roadmap)
    if size is not None:
        if need and size < room:
            is_even = roadmap.sides is None
            yield Finding(
                kind="too near",
                severity="warning",
                fact=Phrase(
                    "The middles of {cells} are {distance} apart; {need}",
                    cells=Phrase("cells") if is_even else Phrase("the smallest cells"),
                    distance=length(size),
                    need=need,
                ),
                remedy=Phrase("take larger cells, or smaller robots"),
            )
        return
    pairs = close_pairs(roadmap, room or TOUCHING)
    joints = {int(joint) for lane in roadmap.lanes for joint in lane.joints} - {*site.places}
    yield from _near_vertices(site, pairs, need, joints)
    for vertex, (tail, head) in pairs.beside:
        if roadmap.is_along_one_lane((vertex, tail, head)):
            continue
        place, ends = site.name(vertex), {"tail": roadmap.name(tail), "head": roadmap.name(head)}
        beside = (
            Phrase(
                "{place} is too near to the lane {tail} to {head}; {need}",
                place=place,
                need=need,
                **ends,
            )
            if need
            else Phrase(
                "{place} lies on the lane {tail} to {head} and is no end of it", place=place, **ends
            )
        )
        yield Finding(
            kind="too near",
            severity="note" if need and vertex in joints else "warning",
            fact=beside,
            remedy=Phrase("split the lane there")
            if not need
            else TAKE_TURNS
            if vertex in joints
            else Phrase("a robot on one blocks the other; move one"),
            vertices=site.list_names((vertex, tail, head)),
        )
    for lanes in pairs.crossings:
        first, other = (
            Phrase("{tail} to {head}", tail=tail, head=head)
            for tail, head in map(site.list_names, lanes)
        )
        yield Finding(
            kind="crossing",
            severity="note" if need else "warning",
            fact=Phrase(
                "The lanes {one} and {other} cross without a vertex", one=first, other=other
            ),
            remedy=TAKE_TURNS
            if need
            else Phrase(
                "draw a vertex there, or give robots a radius: without one they do not give way"
            ),
            vertices=site.list_names(vertex for lane in lanes for vertex in lane),
        )


def find_smallest_cell(roadmap: Roadmap) -> Fraction | None:
    """Return the side of the smallest cells, None where vertices are no cells."""
    if roadmap.grid is not None:
        return roadmap.grid.cell_size
    return None if roadmap.sides is None else Fraction(repr(float(roadmap.sides.min())))


def _near_vertices(
    site: Site, pairs: ClosePairs, need: Phrase | None, joints: set[int]
) -> Iterator[Finding]:
    roadmap = site.roadmap
    for first, other in pairs.vertices:
        if roadmap.is_along_one_lane((first, other)):
            continue
        apart = site.units.format_length(round_distance(roadmap, first, other))
        both_homes = _homes_clash(site, first, other)
        is_joined = (
            roadmap.find_edge(first, other) is not None
            or roadmap.find_edge(other, first) is not None
        )
        are_places = first in site.places and other in site.places
        are_drawn = joints.isdisjoint((first, other))
        names = {"one": site.name(first), "other": site.name(other)}
        if need:
            fact = Phrase(
                "{one} and {other} are {distance} apart; {need}",
                distance=apart,
                need=need,
                **names,
            )
        else:
            fact = Phrase("{one} and {other} are the same point", **names)
        yield Finding(
            kind="too near",
            severity="error"
            if both_homes
            else "note"
            if (is_joined and not are_places) or (need and not are_drawn)
            else "warning",
            fact=fact,
            remedy=Phrase("make them one vertex")
            if not need
            else Phrase("move one, or use smaller robots")
            if are_drawn
            else TAKE_TURNS,
            vertices=site.list_names((first, other)),
        )


def _homes_clash(site: Site, first: int, other: int) -> bool:
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
