"""Ways of one robot while all others stay at their homes, and their energy."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rightofway import _core
from rightofway.model import Scenario
from rightofway.model.units import NEVER
from rightofway.model.work import BoundBattery
from rightofway.native import list_excluded
from rightofway.site import VertexId

MOST_TABLES = 4096
"""Tables of energies that are kept."""


class LoneWays:
    """The ways of each robot that avoid the homes of all others, and closures without an end.

    Parameters
    ----------
    scenario
        A scenario with jobs.

    Notes
    -----
    A robot at home excludes what its booking excludes: with sizes and zones, more than a vertex.
    """

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self._resources = scenario.problem.resources
        self._rows = [
            list_excluded(self._resources, self._resources.get_vertex_row(index, robot.home))
            for index, robot in enumerate(scenario.robots)
        ]
        n_rows = self._resources.n_rows
        self._homes = np.bincount([row for own in self._rows for row in own], minlength=n_rows)
        self._closed = np.zeros(n_rows, bool)
        closures = scenario.problem.closures
        if closures is not None:
            self._closed[closures.row[closures.end >= NEVER]] = True
        roadmap = scenario.roadmap
        self._tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        # The edges by their heads: a search along them leads against the edges of the roadmap.
        self._by_head = np.argsort(roadmap.heads, kind="stable")
        counts = np.bincount(roadmap.heads, minlength=roadmap.n_vertices)
        starts = np.concatenate(([0], np.cumsum(counts))).astype(np.int32)
        tails = self._tails[self._by_head].astype(np.int32)
        self._along = _core.DistanceTables(roadmap.indptr, roadmap.heads)
        self._against = _core.DistanceTables(starts, tails)
        self.find_reach = lru_cache(maxsize=MOST_TABLES)(self._find_reach)
        self._measure = lru_cache(maxsize=MOST_TABLES)(self._measure_energies)

    def get_battery(self, robot: int) -> BoundBattery | None:
        """Return the battery of a robot, or None for no limit."""
        work = self.scenario.problem.work
        assert work is not None, "the scenario has jobs"
        return work.robots[robot].battery

    def _find_reach(self, robot: int, *, avoids_homes: bool = True) -> NDArray[np.bool_]:
        """Return where a robot can drive to from home, and back; bool, shape (V,).

        The ways may avoid the homes of others.
        """
        home = np.array([self.scenario.robots[robot].home], np.int32)
        energy = np.where(self._find_open_edges(robot, avoids_homes=avoids_homes), 0, -1)
        energy = energy.astype(np.int64)
        back = self._along.least_energies(home, energy, 1)
        out = self._against.least_energies(home, energy[self._by_head], 1)
        reach: NDArray[np.bool_] = (back == 0) & (out == 0)
        return reach

    def compute_energy(self, robot: int, tail: VertexId, head: VertexId) -> int:
        """Return the least energy of a drive, with `on`; more than a full battery is full + 1.

        The robot has a battery, avoids the homes of others, and turns between edges take nothing.
        """
        return int(self._measure(robot, head)[tail])

    def _measure_energies(self, robot: int, target: VertexId) -> NDArray[np.int64]:
        """Return the least energy of a robot from each vertex to a target; int64, shape (V,)."""
        battery = self.get_battery(robot)
        assert battery is not None, "the robot has a battery"
        most = battery.full + 1
        ticks = self.scenario.problem.itineraries[robot].edge_ticks
        by_class = [
            min(energy + battery.on * own, most)
            for own, energy in zip(ticks, battery.drive, strict=True)
        ]
        energy = np.array(by_class, np.int64)[self.scenario.roadmap.class_of_edge]
        energy[~self._find_open_edges(robot, avoids_homes=True)] = -1
        return self._along.least_energies(np.array([target], np.int32), energy, most)

    def _find_open_edges(self, robot: int, *, avoids_homes: bool) -> NDArray[np.bool_]:
        """Return which edges a robot may drive along; bool, shape (E,)."""
        roadmap, free = self.scenario.roadmap, self._find_free(robot, avoids_homes=avoids_homes)
        ticks = np.array(self.scenario.problem.itineraries[robot].edge_ticks)
        is_open: NDArray[np.bool_] = ticks[roadmap.class_of_edge] >= 0
        return is_open & free[roadmap.n_vertices :] & free[self._tails] & free[roadmap.heads]

    def _find_free(self, robot: int, *, avoids_homes: bool) -> NDArray[np.bool_]:
        """Return where a robot may be: vertices, then edges."""
        n_places = self._resources.n_vertices + self._resources.n_edges
        first = self._resources.get_vertex_row(robot, 0)
        places = slice(first, first + n_places)
        free = ~self._closed[places]
        if avoids_homes:
            others = self._homes[places].copy()
            own = [row - first for row in self._rows[robot] if first <= row < first + n_places]
            np.subtract.at(others, own, 1)
            free &= others == 0
        return free
