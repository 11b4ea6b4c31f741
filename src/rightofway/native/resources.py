"""Which bookings exclude each other, found by the native core when it is asked.

References
----------
A uniform grid for neighbours: Bentley, Stanat & Williams, *The complexity of finding fixed-radius
near neighbors*, Information Processing Letters, 1977. Doubles first, integers where they leave a
sign open: Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric
predicates*, Discrete & Computational Geometry, 1997.
"""

from __future__ import annotations

import atexit
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, chain
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model.resources import Resources, list_members, scale_positions
from rightofway.site import Roadmap

_KNOWN: WeakKeyDictionary[Resources, _core.ExcludedRows] = WeakKeyDictionary()
atexit.register(_KNOWN.clear)  # resources that live to the end take no native object along

LIMB = 32
"""Bits of a limb of a whole number."""


def bind_lists(resources: Resources) -> _core.ExcludedRows | None:
    """Return the rows that each row excludes; None for points.

    Parameters
    ----------
    resources
        The resources of a fleet.
    """
    return None if resources.are_points else _find_known_lists(resources)


def _find_known_lists(resources: Resources) -> _core.ExcludedRows:
    lists = _KNOWN.get(resources)
    if lists is None:  # it takes long to compare roadmaps
        lists = _make_lists(resources.roadmap, resources.sizes, resources.clearance)
        _KNOWN[resources] = lists
    return lists


@lru_cache(maxsize=8)
def _make_lists(
    roadmap: Roadmap, sizes: tuple[Fraction, ...], clearance: Fraction
) -> _core.ExcludedRows:
    """Return the lists of a fleet; problems that differ in their robots alone share them."""
    distances = [
        radius + other_radius + clearance if max(radius, other_radius) > 0 else Fraction(0)
        for radius in sizes
        for other_radius in sizes
    ]
    whole, scale = scale_positions(roadmap, distances)
    x, y = map(_shift_to_zero, (whole[::2], whole[1::2]))
    needed = [int(distance * scale) for distance in distances]
    n_bits = max(*x, *y, *needed).bit_length()
    n_limbs = max(1, -(-n_bits // LIMB))
    members = [list_members(roadmap, zone) for zone in roadmap.zones]
    members += map(list[int], roadmap.list_shared_places())
    passing = roadmap.passing
    chains = () if passing is None else passing.chains
    if passing is not None:  # a passed vertex and all vertices that stand for it are one place
        members += ([drawn, *copies] for drawn, copies in passing.copies.items())
    return _core.ExcludedRows(
        _core.Roads(
            roadmap.indptr,
            roadmap.heads,
            roadmap.class_of_edge,
            n_classes=len(roadmap.edge_classes),
        ),
        _core.Drawing(
            np.array([coordinate / scale for coordinate in x], np.float64),
            np.array([coordinate / scale for coordinate in y], np.float64),
            _split_into_limbs(chain.from_iterable(zip(x, y, strict=True)), n_limbs),
            is_grid=roadmap.grid is not None,
        ),
        distance=np.array([float(distance) for distance in distances], np.float64),
        distance_limbs=_split_into_limbs(needed, n_limbs),
        zone_first=np.array([0, *accumulate(map(len, members))], np.int32),
        zone_member=np.array(list(chain.from_iterable(members)), np.int32),
        chain_first=np.array([0, *accumulate(map(len, chains))], np.int32),
        chain_vertex=np.array(list(chain.from_iterable(chains)), np.int32),
    )


def _shift_to_zero(axis: Sequence[int]) -> list[int]:
    least = min(axis)
    return [coordinate - least for coordinate in axis]


def _split_into_limbs(numbers: Iterable[int], n_limbs: int) -> NDArray[np.uint32]:
    """Return numbers that are not negative in limbs of 32 bits, the least first."""
    text = b"".join(number.to_bytes(4 * n_limbs, "little") for number in numbers)
    return np.frombuffer(text, np.dtype("<u4")).astype(np.uint32)


def list_excluded(resources: Resources, row: int) -> list[int]:
    """Return the rows that a booking of a row excludes; called for each visit.

    Parameters
    ----------
    resources
        The resources of a fleet.
    row
        A row of them.
    """
    if resources.are_points:
        return [row] if row < resources.n_vertices else []
    excluded: list[int] = _find_known_lists(resources).of(row).tolist()
    return excluded


def find_vertices_near(resources: Resources, robot: int, vertex: int) -> list[int]:
    """Return the vertices that robots of some size cannot book while a robot is at a vertex.

    Parameters
    ----------
    resources
        The resources of a fleet.
    robot
        The robot.
    vertex
        Where it is.
    """
    n_resources = resources.n_vertices + resources.n_edges
    excluded = list_excluded(resources, resources.get_vertex_row(robot, vertex))
    numbers = (row % n_resources for row in excluded)
    return [number for number in numbers if number < resources.n_vertices]


def find_clashes(resources: Resources, places: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Yield pairs of robots (i, j), i < j, that cannot stay at their places at one time.

    Parameters
    ----------
    resources
        The resources of a fleet.
    places
        A vertex for each robot.
    """
    rows = [resources.get_vertex_row(robot, vertex) for robot, vertex in enumerate(places)]
    holders: dict[int, list[int]] = {}
    for robot, row in enumerate(rows):
        holders.setdefault(row, []).append(robot)
    for robot, row in enumerate(rows):
        for other in list_excluded(resources, row):
            yield from ((robot, holder) for holder in holders.get(other, ()) if robot < holder)
