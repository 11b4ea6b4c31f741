"""What visits of known routes book where zones do not list all vertices that robots pass, exactly.

Planners need a row for each vertex, so that they take a vertex between two edges of a zone as in
the zone for every visit. Where the routes are known, each visit is known to pass a zone or not. A
visit that does gets a row of its own: it excludes what its vertex excludes without the zone, and
what the zone holds.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.model.resources import Resources, members_of, resources_of
from rightofway.model.scenario import Scenario
from rightofway.site import Roadmap
from rightofway.site.zones import listed_only

Route = Sequence[int] | NDArray[np.int32]


class VisitRows(NamedTuple):
    """The row that each visit of each robot books at its vertex, and the lists of all rows.

    Attributes
    ----------
    at_vertex
        For each robot the rows of its visits; int32.
    first, excluded
        As in `Resources`.
    """

    at_vertex: list[NDArray[np.int32]]
    first: NDArray[np.int32]
    excluded: NDArray[np.int32]


class _Passing(NamedTuple):
    """Visits of robots of one size class to a vertex, between two edges of some zones."""

    size: int
    vertex: int
    zones: frozenset[int]


def visit_rows(scenario: Scenario, routes: Sequence[Route]) -> VisitRows:
    """Return what the visits of some routes book at their vertices, and what that excludes.

    Parameters
    ----------
    scenario
        The problem; a robot has a size, or there is a zone.
    routes
        The vertices that each robot visits.
    """
    resources, roadmap = scenario.problem.resources, scenario.roadmap
    assert resources is not None, "the scenario has resources"
    visited = [np.asarray(route, np.int32) for route in routes]
    rows = [resources.vertex_row(robot, 0) + one for robot, one in enumerate(visited)]
    if resources.is_exact:
        return VisitRows(rows, resources.first, resources.excluded)
    radii = [robot.radius for robot in scenario.robots]
    loosely = replace(roadmap, zones=listed_only(roadmap.zones))
    without = resources_of(loosely, radii, scenario.rules.clearance)
    assert without is not None, "there are zones"
    number: dict[_Passing, int] = {}
    for robot, one in enumerate(visited):
        for k, passing in _passings(roadmap, int(resources.size_of[robot]), one.tolist()):
            rows[robot][k] = len(without.first) - 1 + number.setdefault(passing, len(number))
    return VisitRows(rows, *_with_passings(roadmap, without, number))


def _passings(roadmap: Roadmap, size: int, route: list[int]) -> Iterator[tuple[int, _Passing]]:
    """Yield the visits that pass zones which do not list their vertex."""
    zones_with: defaultdict[tuple[int, int], set[int]] = defaultdict(set)
    for number, zone in enumerate(roadmap.zones):
        for ends in zone.edges:
            zones_with[ends].add(number)
    for k in range(1, len(route) - 1):
        tail, vertex, head = route[k - 1 : k + 2]
        both = zones_with.get((tail, vertex), set()) & zones_with.get((vertex, head), set())
        passed = frozenset(z for z in both if vertex not in roadmap.zones[z].vertices)
        if passed:
            yield k, _Passing(size, vertex, passed)


def _with_passings(
    roadmap: Roadmap, without: Resources, number: dict[_Passing, int]
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the lists of rows with those of visits that pass zones added at the end."""
    n_rows, n_resources = len(without.first) - 1, without.n_vertices + without.n_edges
    members = [members_of(roadmap, zone) for zone in listed_only(roadmap.zones)]
    added: list[tuple[int, int]] = []
    for passing, index in number.items():
        row = n_rows + index
        near = without.excluded_by(passing.size * n_resources + passing.vertex).tolist()
        inside = (member for zone in passing.zones for member in members[zone])
        near += [size + member for member in inside for size in range(0, n_rows, n_resources)]
        for other, its_index in number.items():
            place = other.size * n_resources + other.vertex
            if place in near or passing.zones & other.zones:
                near.append(n_rows + its_index)
        added += [pair for one in near for pair in ((row, one), (one, row))]
    total = n_rows + len(number)
    rows = np.repeat(np.arange(n_rows, dtype=np.int64), np.diff(without.first))
    extra = np.array(added, np.int64).reshape(-1, 2)
    rows = np.concatenate((rows, extra[:, 0]))
    columns = np.concatenate((without.excluded.astype(np.int64), extra[:, 1]))
    all_rows, excluded = np.divmod(np.unique(rows * total + columns), total)
    first = np.searchsorted(all_rows, np.arange(total + 1))
    return first.astype(np.int32), excluded.astype(np.int32)
