"""Closures of the scenario, which begin and end by the clock of the run.

A part of a route is released only if its robot is expected to have left it when it is closed, and
not to enter it before it is open. Released parts cannot be taken back, so a part that is closed
soon is released only to a robot that is directly before it. A robot that stops there for longer
than expected is caught, as in a simulation. Planners, judge and simulations have the same closures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from rightofway.control.ledger import Edge
from rightofway.control.robot_ledger import RobotLedger
from rightofway.model import NEVER, Scenario, Tick
from rightofway.model.route import compute_drives_along, compute_turns_along

__all__ = ["ClockedClosures", "Closed"]


AHEAD = 600
"""Seconds that a robot may be late without being caught in a part that was released further ahead
than to the vertex directly before it."""


class Closed(NamedTuple):
    """When a part of a route is closed [ticks]; the end is `NEVER` without an end."""

    begin: Tick
    end: Tick


class ClockedClosures:
    """The closures of a scenario at the present moment of a run.

    Parameters
    ----------
    scenario
        The problem.
    read_ticks
        Returns the time since the run began [ticks].
    """

    def __init__(self, scenario: Scenario, read_ticks: Callable[[], int]) -> None:
        self._scenario, self._read_ticks = scenario, read_ticks
        self._closures = scenario.problem.closures
        second = scenario.problem.clock.tick * (scenario.units.seconds or 1)
        self._late = int(AHEAD / second)  # [ticks]

    def find_closed(self, robot: int, own: RobotLedger, part: int) -> Closed | None:
        """Return when a part is closed that its robot would drive into; None if it may.

        The robot is expected to arrive no earlier than the rest of its way allows, and to work and
        drive on as planned. A part is the edge to a vertex and this vertex until the next arrival.

        Parameters
        ----------
        robot
            Its number.
        own
            The robot's records, as if all before the part was released.
        part
            The part.
        """
        if self._closures is None:
            return None
        now, roadmap = self._read_ticks(), self._scenario.roadmap
        path, drives, stays = self._list_times(robot, own, part)
        before, into = part - 1 - own.arrived, part - own.arrived
        earliest = now + sum(drives[1:before])
        # A drive through passed vertices is released as a whole.
        is_ahead = any(not roadmap.is_passed(vertex) for vertex in path[1 : before + 1])
        late = self._late if is_ahead else 0
        arrival = now + late + sum(drives[:into]) + sum(stays[:into])
        left = arrival + stays[into] + sum(drives[into:])
        edge = roadmap.find_edge(path[before], path[into])
        assert edge is not None, "a control has its routes from a dispatcher, which knows the map"
        along = self._closures.list_along_edge(robot, edge)
        at = self._closures.list_at_vertex(robot, path[into])
        return next(
            (
                Closed(begin, end)
                for intervals, until in ((along, arrival), (at, left))
                for begin, end in intervals
                if begin < until and earliest < end
            ),
            None,
        )

    def _list_times(
        self, robot: int, own: RobotLedger, part: int
    ) -> tuple[list[int], list[int], list[int]]:
        """Return vertices from the last arrival to behind a part, drives and stays [ticks]."""
        roadmap, route = self._scenario.roadmap, own.route
        itinerary = self._scenario.problem.itineraries[robot]
        begin, end = max(own.arrived - 1, route.first), min(part + 2, route.end)
        if roadmap.passing is None:
            path = [int(roadmap.get_vertex(place)) for place in route.stretch(begin, end)]
        else:  # chains may begin before the stretch, and end behind it
            whole = roadmap.unfold_route(list(map(roadmap.get_vertex, route.places)))
            path = list(map(int, whole[begin - route.first : end - route.first]))
        turns = compute_turns_along(roadmap, itinerary, np.array(path, np.int32)).tolist()
        turn_after_work = max((stage.turn for stage in itinerary.stages), default=0)
        stays = []
        for visit, turn in zip(range(begin, end), turns, strict=True):
            rows = zip(route.get_jobs(visit), route.get_work(visit), strict=True)
            work = sum(ticks for job, ticks in rows if job not in own.finished)
            stays.append(turn + work + (turn_after_work if route.get_jobs(visit) else 0))
        first = own.arrived - begin
        drives = compute_drives_along(roadmap, itinerary, path)
        return path[first:], drives[first:], stays[first:]

    def list_closed_edges(self, *, forever: bool = False) -> set[Edge]:
        """Return the edges that are closed now for some robot, by the names of their vertices.

        Parameters
        ----------
        forever
            Whether to return those alone that are not opened again.
        """
        roadmap, now = self._scenario.roadmap, self._read_ticks()
        closed = {
            row % (roadmap.n_vertices + roadmap.n_edges)
            for row, begin, end in self._list_rows()
            if begin <= now < end and (not forever or end == NEVER)
        }
        if not closed:
            return set()
        tails = np.repeat(np.arange(roadmap.n_vertices), np.diff(roadmap.indptr)).tolist()
        return {
            (roadmap.name(tail), roadmap.name(head))
            for edge, (tail, head) in enumerate(zip(tails, roadmap.heads.tolist(), strict=True))
            if head in closed or roadmap.n_vertices + edge in closed
        }

    def find_next_change(self) -> int | None:
        """Return when the next closure ends, or begins for good [ticks]; None if none does."""
        now = self._read_ticks()
        changes = (begin if end == NEVER else end for _, begin, end in self._list_rows())
        return min((change for change in changes if change > now), default=None)

    def _list_rows(self) -> Iterator[tuple[int, int, int]]:
        """Yield row, begin and end of each closed interval."""
        if self._closures is not None:
            rows = (self._closures.row, self._closures.start, self._closures.end)
            yield from zip(*(row.tolist() for row in rows), strict=True)
