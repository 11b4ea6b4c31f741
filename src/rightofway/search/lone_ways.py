"""Ways of one robot while all others stay at their homes, and their energy."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Scenario
from rightofway.model.units import NEVER
from rightofway.model.work import BoundBattery
from rightofway.native import list_excluded
from rightofway.search.distances import Distances
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
        self._distances = Distances(scenario.roadmap)
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
        self._measure = lru_cache(maxsize=MOST_TABLES)(self._measure_ways)

    def get_battery(self, robot: int) -> BoundBattery | None:
        """Return the battery of a robot, or None for no limit."""
        work = self.scenario.problem.work
        assert work is not None, "the scenario has jobs"
        return work.robots[robot].battery

    def has_way(
        self, robot: int, tail: VertexId, head: VertexId, *, avoids_homes: bool = True
    ) -> bool:
        """Return whether a robot has a way, which may avoid the homes of others."""
        table = self._measure(robot, head, avoids_homes=avoids_homes, has_battery=False)
        return bool(table[tail] == 0)

    def compute_energy(self, robot: int, tail: VertexId, head: VertexId) -> int:
        """Return the least energy of a drive, with `on`; more than a full battery is full + 1.

        The robot has a battery, and turns between edges take nothing.
        """
        return int(self._measure(robot, head, avoids_homes=True, has_battery=True)[tail])

    def _measure_ways(
        self, robot: int, target: VertexId, *, avoids_homes: bool, has_battery: bool
    ) -> NDArray[np.int64]:
        """Return the least energy from each vertex to a target; int64, shape (V,).

        Without a battery a way takes 0, and it is 1 where there is none.
        """
        roadmap, battery = self.scenario.roadmap, self.get_battery(robot) if has_battery else None
        ticks = self.scenario.problem.itineraries[robot].edge_ticks
        most, drive, on = 1, [0] * len(ticks), 0
        if battery is not None:
            most, drive, on = battery.full + 1, [*battery.drive], battery.on
        free = self._find_free(robot, avoids_homes=avoids_homes)
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr))
        return self._distances.find_least_energies(
            [target],
            tuple(
                -1 if own < 0 else min(energy + on * own, most)
                for own, energy in zip(ticks, drive, strict=True)
            ),
            most,
            open_edges=free[roadmap.n_vertices :] & free[tails] & free[roadmap.heads],
        )

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
