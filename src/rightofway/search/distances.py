"""Shortest distances to a target, computed when first asked for and shared by all who ask."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property
from math import gcd
from threading import Lock

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.errors import InputError
from rightofway.kinds.table import require_index
from rightofway.model import Tick
from rightofway.model.turning import Turning
from rightofway.search.turning_distances import TurningDistances
from rightofway.site import Roadmap, VertexId

Path = tuple[VertexId, ...]
"""The vertices of a path, both ends included."""


LEAST_SHARED = 100_000
"""Entries of tables that are computed in less time than threads need to start."""

MOST_ENTRIES = 2**27
"""Entries of all tables that are kept: half a gigabyte."""

MOST_ENERGIES = 2**24
"""Entries of all tables of energies that are kept: an eighth of a gigabyte."""

ENTRIES_OF_PATHS = 32
"""Entries for each vertex of a search for single paths, with its graph and its landmarks."""


class Distances:
    """Tables of the least ticks from every vertex to a target.

    Parameters
    ----------
    roadmap
        The graph that robots drive on.
    checkpoint
        Called before each table and each path; its exception ends the work.

    Notes
    -----
    Robots of one speed that go to one target share one table, as long as it is kept.
    """

    def __init__(self, roadmap: Roadmap, *, checkpoint: Callable[[], None] = lambda: None) -> None:
        self.roadmap = roadmap
        self.checkpoint = checkpoint
        self._tables: dict[tuple[object, ...], NDArray[np.int32]] = {}
        self._turns: dict[tuple[object, ...], TurningDistances] = {}
        self._lock = Lock()
        self._edges: dict[tuple[Tick, ...], NDArray[np.int32]] = {}
        self._symmetric: dict[tuple[Tick, ...], bool] = {}
        self._energies: dict[object, NDArray[np.int64]] = {}
        self._paths: dict[tuple[int, ...], _core.ShortestPaths] = {}

    @cached_property
    def _kernel(self) -> _core.DistanceTables:
        return _core.DistanceTables(self.roadmap.indptr, self.roadmap.heads)

    def to(self, target: VertexId, edge_ticks: tuple[Tick, ...]) -> NDArray[np.int32]:
        """Return the least ticks from every vertex to ``target``.

        Parameters
        ----------
        target
            The vertex to reach.
        edge_ticks
            Ticks for an edge of each class, -1 for one that is barred.

        Returns
        -------
        ndarray of int32, shape (V,)
            Ticks, -1 from where the target cannot be reached.
        """
        key = (target, edge_ticks)
        table = self._tables.get(key)
        if table is None:
            self.checkpoint()
            table = self._kernel.to(target, self.compute_edge_ticks(edge_ticks))
            self._keep(key, table)
        return table

    def to_with_turns(
        self, target: VertexId, edge_ticks: tuple[Tick, ...], turning: Turning
    ) -> NDArray[np.int32]:
        """Return the least ticks from every vertex to ``target``, with turns on the way.

        The turn before the first drive, which depends on the heading, is left out.

        Parameters
        ----------
        target
            The vertex to reach.
        edge_ticks
            Ticks for an edge of each class, -1 for one that is barred.
        turning
            How long the robot turns between two edges.

        Returns
        -------
        ndarray of int32, shape (V,)
            Ticks, -1 from where the target cannot be reached.
        """
        key = (target, edge_ticks, turning.rate)
        table = self._tables.get(key)
        if table is None:
            self.checkpoint()
            if key[1:] not in self._turns:
                ticks = self.compute_edge_ticks(edge_ticks)
                self._turns[key[1:]] = TurningDistances(self.roadmap, ticks, turning)
            table = self._turns[key[1:]].to(target)
            self._keep(key, table)
        return table

    def _keep(self, key: tuple[object, ...], table: NDArray[np.int32]) -> None:
        """Keep a table, and forget the oldest ones where all would take too much memory."""
        with self._lock:
            while self._tables and (len(self._tables) + 1) * len(table) > MOST_ENTRIES:
                del self._tables[next(iter(self._tables))]
            self._tables[key] = table

    def prepare(self, wanted: Iterable[tuple[VertexId, tuple[Tick, ...]]]) -> None:
        """Compute tables that will be asked for, many of them on all cores: keys as for `to`."""
        missing = dict.fromkeys(key for key in wanted if key not in self._tables)
        if len(missing) * self.roadmap.n_vertices < LEAST_SHARED:
            for key in missing:
                self.to(*key)
            return
        for _, edge_ticks in missing:
            self.compute_edge_ticks(edge_ticks)
        assert self._kernel, "made once, before threads ask for it"
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor() as pool:
            list(pool.map(lambda key: self.to(*key), missing))

    def compute_edge_ticks(self, edge_ticks: tuple[Tick, ...]) -> NDArray[np.int32]:
        """Return the ticks of every edge, given those of each edge class; shape (E,)."""
        if edge_ticks not in self._edges:
            if len(edge_ticks) != len(self.roadmap.edge_classes):
                many = f"{len(edge_ticks)} for {len(self.roadmap.edge_classes)} edge classes"
                raise InputError.at("edge_ticks", f"{many} (give one for each)")
            by_class = np.array(edge_ticks, np.int32)
            self._edges[edge_ticks] = by_class[self.roadmap.class_of_edge]
        return self._edges[edge_ticks]

    def measure_energies(
        self, target: VertexId, edge_ticks: tuple[Tick, ...], energies: tuple[int, ...], most: int
    ) -> NDArray[np.int64]:
        """Return what the quickest way from every vertex to ``target`` takes from a battery.

        Parameters
        ----------
        target
            The vertex to reach.
        edge_ticks
            Ticks for an edge of each class, -1 for one that is barred.
        energies
            Energy of an edge of each class.
        most
            What is returned where the way takes more, or none exists.

        Returns
        -------
        ndarray of int64, shape (V,)
            The least energy of all quickest ways.
        """
        key = target, edge_ticks, energies, most
        known = self._energies.get(key)
        if known is None:
            table, ticks = self.to(target, edge_ticks), self.compute_edge_ticks(edge_ticks)
            by_edge = np.array(energies, np.int64)[self.roadmap.class_of_edge]
            known = self._kernel.energies_of_quickest_ways(table, ticks, by_edge, most)
            self._keep_energies(key, known)
        return known

    def _keep_energies(self, key: object, table: NDArray[np.int64]) -> None:
        while self._energies and (len(self._energies) + 1) * len(table) > MOST_ENERGIES:
            del self._energies[next(iter(self._energies))]
        self._energies[key] = table

    def find_least_energies(
        self, targets: Iterable[VertexId], energies: tuple[int, ...], most: int
    ) -> NDArray[np.int64]:
        """Return the least energy from every vertex to one of the targets.

        Parameters
        ----------
        targets
            The vertices of which one is to be reached.
        energies
            Energy of an edge of each class, -1 for one that is barred.
        most
            What is returned where the way takes more, or none exists.

        Returns
        -------
        ndarray of int64, shape (V,)
            Energies.
        """
        key = tuple(targets), energies, most
        known = self._energies.get(key)
        if known is None:
            by_edge = np.array(energies, np.int64)[self.roadmap.class_of_edge]
            known = self._kernel.least_energies(np.array(key[0], np.int32), by_edge, most)
            self._keep_energies(key, known)
        return known

    def is_symmetric(self, edge_ticks: tuple[Tick, ...]) -> bool:
        """Return whether every edge may be driven in both directions in equal ticks."""
        if edge_ticks not in self._symmetric:
            roadmap, ticks = self.roadmap, self.compute_edge_ticks(edge_ticks)
            counts = np.diff(roadmap.indptr)
            tails = np.repeat(np.arange(roadmap.n_vertices, dtype=np.int32), counts)
            opposite = roadmap.find_edges(roadmap.heads, tails)
            has_all = bool((opposite >= 0).all() and (ticks[opposite] == ticks).all())
            self._symmetric[edge_ticks] = has_all
        return self._symmetric[edge_ticks]

    def compute_cost(self, path: Path, edge_ticks: tuple[Tick, ...]) -> int | None:
        """Return the duration of a path [ticks]; None where an edge is missing."""
        vertices = np.array(path, np.int32)
        if len(path) and not 0 <= vertices.min() <= vertices.max() < self.roadmap.n_vertices:
            k = int(np.argmax((vertices < 0) | (vertices >= self.roadmap.n_vertices)))
            require_index(("path", k), path[k], self.roadmap.n_vertices)
        edges = self.roadmap.find_edges(vertices[:-1], vertices[1:])
        ticks = self.compute_edge_ticks(edge_ticks)[edges]
        is_open = min(edges.min(initial=0), ticks.min(initial=0)) >= 0
        return int(ticks.sum()) if is_open else None

    def find_path(self, start: VertexId, target: VertexId, edge_ticks: tuple[Tick, ...]) -> Path:
        """Return a shortest path; a ValueError says that the target cannot be reached.

        At each vertex it goes on by the first edge that brings it nearer; on grids edges are in
        the order east, south, west, north, which gives the routes of the paper. No table is
        computed for it.
        """
        self.checkpoint()
        require_index("start", start, self.roadmap.n_vertices)
        with self._lock:
            path = self._find_paths(edge_ticks).find(start, target)
        if not len(path):
            raise InputError.at("target", f"{target} cannot be reached from vertex {start}")
        return tuple(path.tolist())

    def _find_paths(self, edge_ticks: tuple[Tick, ...]) -> _core.ShortestPaths:
        """Return the search for paths of a pace; paces in proportion have the same paths."""
        divisor = gcd(*(ticks for ticks in edge_ticks if ticks > 0)) or 1
        pace = tuple(ticks // divisor if ticks > 0 else ticks for ticks in edge_ticks)
        paths = self._paths.get(pace)
        if paths is None:
            entries = ENTRIES_OF_PATHS * max(self.roadmap.n_vertices, 1)
            while self._paths and (len(self._paths) + 1) * entries > MOST_ENTRIES:
                del self._paths[next(iter(self._paths))]
            ticks = self.compute_edge_ticks(edge_ticks) // np.int32(divisor)
            paths = _core.ShortestPaths(self.roadmap.indptr, self.roadmap.heads, ticks)
            self._paths[pace] = paths
        return paths
