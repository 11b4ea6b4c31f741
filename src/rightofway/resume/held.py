"""Vertices and edges that robots keep for ever, or for as long as they do not go on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rightofway.model import Scenario
from rightofway.native import list_excluded
from rightofway.site import VertexId


@dataclass(frozen=True, slots=True, kw_only=True)
class Held:
    """The places that robots keep booked, and which others cannot pass.

    Attributes
    ----------
    vertices
        The booked vertices.
    edges
        Tail and head of edges that robots with a size cannot drive beside them. Where robots have
        different sizes, what is closed to one of them counts as closed to all.
    """

    vertices: frozenset[VertexId]
    edges: frozenset[tuple[int, int]] = frozenset()


def list_held(scenario: Scenario, paths: Mapping[int, Sequence[int]]) -> Held:
    """Return what robots exclude that stay on the vertices and edges of paths."""
    resources, roadmap = scenario.problem.resources, scenario.roadmap
    vertices = frozenset(VertexId(vertex) for path in paths.values() for vertex in path)
    if resources.are_points:
        return Held(vertices=vertices)
    rows = set[int]()
    for robot, path in paths.items():
        own = [resources.get_vertex_row(robot, vertex) for vertex in path]
        own += (
            resources.get_edge_row(robot, edge)
            for ends in pairwise(path)
            if (edge := roadmap.find_edge(*ends)) is not None
        )
        rows.update(other for row in own for other in list_excluded(resources, row))
    n_vertices, count = resources.n_vertices, resources.n_vertices + resources.n_edges
    sizes = {int(resources.size_of[k]) for k in range(len(scenario.robots)) if k not in paths}
    shut = {row % count for row in rows if row // count in sizes}
    tails = np.repeat(np.arange(n_vertices), np.diff(roadmap.indptr)).tolist()
    ends_of_edges = enumerate(zip(tails, roadmap.heads.tolist(), strict=True), n_vertices)
    edges = (ends for edge, ends in ends_of_edges if edge in shut or ends[1] in shut)
    return Held(vertices=vertices, edges=frozenset(edges))
