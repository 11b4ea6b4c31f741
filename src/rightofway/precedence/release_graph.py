"""The release graph: which arrivals of other robots a robot waits for before it may go on.

Part j of a robot is edge j and vertex j of its route; part 0 is the vertex where it starts. A robot
holds the vertex that it has last arrived at and every released part after it. Part j may be
released when each robot that uses something incompatible first has *arrived* beyond it: at its
vertex i + 1, if that is its vertex i, and at its vertex i, if that is its edge i. An arrival is a
fact that stays true, so no clock is read, and no two robots ever hold incompatible parts, however
late each of them is.

Bookings are those of ``occupancy: both``, whatever the plan's own: a robot drives into a vertex
only after it has been left. Two things of a plan are times and have no place here: headways and
closures.

Of a plan with jobs, robots drive by this graph, too, and *works* wait in their visits: until
`earliest` has come, and until the last works of the jobs in `after` have ended (`Problem.after`). A
robot that waited before the vertex of its work instead could be in the way of a robot that it waits
for. Works add no cycle: each depends on an arrival, and arrivals depend on works that ended before
the drive began.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rightofway.model import Scenario, Track
from rightofway.native import list_excluded

Indices = NDArray[np.int64]


class Part(NamedTuple):
    """An edge of a robot's route and the vertex that it leads to; part 0 is the start."""

    robot: int
    number: int


class Arrival(NamedTuple):
    """A robot has arrived at the vertex of a visit of its route."""

    robot: int
    visit: int


class ReleaseGraph:
    """The arrivals that each part of each route waits for.

    Parameters
    ----------
    ends
        The number after that of the last part of each robot's route.
    waits
        The arrivals that a part waits for; parts that wait for none may be left out.
    firsts
        The number of the first part of each route that is looked at, 0 if left out: robots have
        arrived there.

    Notes
    -----
    A part does not list arrivals that follow from others that it lists, at the same vertex.
    """

    def __init__(
        self,
        ends: Sequence[int],
        waits: Mapping[Part, Sequence[Arrival]],
        firsts: Sequence[int] = (),
    ) -> None:
        self.ends, self.firsts = tuple(ends), tuple(firsts or [0] * len(ends))
        self._waits = {part: tuple(arrivals) for part, arrivals in waits.items() if arrivals}

    @classmethod
    def of(
        cls, scenario: Scenario, tracks: Sequence[Track], firsts: Sequence[int] = ()
    ) -> ReleaseGraph:
        """Return the release graph of a plan.

        Parameters
        ----------
        scenario
            The problem.
        tracks
            A plan that keeps the rules. Its times say which robot goes first, and nothing else: any
            times in which robots arrive in the same order, two ticks apart, give the same graph.
        firsts
            The number of the first visit of each track, 0 if left out.
        """
        firsts = firsts or [0] * len(tracks)
        waits = defaultdict[Part, list[Arrival]](list)
        for robot, part, other, visit in list_waits(scenario, tracks, firsts):
            waits[Part(robot, part)].append(Arrival(other, visit))
        ends = [first + len(track) for first, track in zip(firsts, tracks, strict=True)]
        return cls(ends, waits, firsts)

    @cached_property
    def _after(self) -> dict[Arrival, tuple[Part, ...]]:
        """The parts that wait for each arrival; not every driver asks for them."""
        after = defaultdict[Arrival, list[Part]](list)
        for part, arrivals in self._waits.items():
            for arrival in arrivals:
                after[arrival].append(part)
        return {arrival: tuple(parts) for arrival, parts in after.items()}

    def list_waiting_parts(self) -> Iterator[Part]:
        """Yield the parts that wait for arrivals."""
        yield from self._waits

    def waits(self, part: Part) -> tuple[Arrival, ...]:
        """Return the arrivals that a part waits for, by robot.

        Parameters
        ----------
        part
            A part of a route.
        """
        return self._waits.get(part, ())

    def list_waiting_for(self, arrival: Arrival) -> tuple[Part, ...]:
        """Return the parts that wait for an arrival.

        Parameters
        ----------
        arrival
            An arrival of a robot at a vertex of its route.
        """
        return self._after.get(arrival, ())

    def list_missing(self, part: Part, arrived: Sequence[int]) -> tuple[Arrival, ...]:
        """Return the arrivals that a part still waits for: why it may not go.

        Parameters
        ----------
        part
            A part of a route.
        arrived
            The visit at whose vertex each robot has last arrived.
        """
        return tuple(
            awaited for awaited in self.waits(part) if arrived[awaited.robot] < awaited.visit
        )

    def may_go(self, part: Part, arrived: Sequence[int]) -> bool:
        """Return whether no robot is in the way of a part any more.

        Parameters
        ----------
        part
            A part of a route; the parts before it are released.
        arrived
            The visit at whose vertex each robot has last arrived.
        """
        return not self.list_missing(part, arrived)

    def find_rotation(self) -> tuple[Part, ...]:
        """Return parts of which each waits for the next, the last for the first; empty if none do.

        The robots of a cycle move round at one instant in the plan. No robot can go first, so such
        a plan cannot be released part by part. Every other plan can, to its end.
        """
        before = {
            Part(robot, number): self._list_released_before(Part(robot, number))
            for robot, (first, end) in enumerate(zip(self.firsts, self.ends, strict=True))
            for number in range(first, end)
        }
        following = defaultdict[Part, list[Part]](list)
        for part, earlier in before.items():
            for awaited in earlier:
                following[awaited].append(part)
        open_arcs = {part: len(earlier) for part, earlier in before.items()}
        ready = [part for part, count in open_arcs.items() if count == 0]
        while ready:
            part = ready.pop()
            del open_arcs[part]
            for waiting in following[part]:
                open_arcs[waiting] -= 1
                if open_arcs[waiting] == 0:
                    ready.append(waiting)
        if not open_arcs:
            return ()
        # Each part that is left waits for another one that is left: walk until one comes again.
        walked, part = list[Part](), min(open_arcs)
        while part not in walked:
            walked.append(part)
            part = min(awaited for awaited in before[part] if awaited in open_arcs)
        return tuple(walked[walked.index(part) :])

    def _list_released_before(self, part: Part) -> set[Part]:
        """Return the parts that are released before a part: its own last one, and arrivals' own."""
        first = self.firsts[part.robot]
        own = [Part(part.robot, part.number - 1)] if part.number > first else []
        arrivals = (
            awaited for awaited in self.waits(part) if awaited.visit > self.firsts[awaited.robot]
        )
        return {*own, *(Part(*arrival) for arrival in arrivals)}


class _Uses(NamedTuple):
    """The bookings of rows by robots, sorted by row and begin; int64[U] each.

    Those of a vertex are in the order in which robots use it in the plan.
    """

    row: Indices
    begin: Indices  # a tick in which the robot surely books the row
    robot: Indices
    part: Indices
    left: Indices  # the visit whose arrival ends the booking

    @classmethod
    def of(cls, scenario: Scenario, tracks: Sequence[Track]) -> _Uses:
        """Return the bookings of all robots: each vertex and each edge."""
        parts = [
            rows
            for robot, track in enumerate(tracks)
            for rows in _list_uses(scenario, robot, track)
        ]
        row, begin, robot, part, left = np.concatenate(parts, axis=1)
        order = np.lexsort((part, robot, begin, row))
        return cls(row[order], begin[order], robot[order], part[order], left[order])


def _list_uses(scenario: Scenario, robot: int, track: Track) -> tuple[Indices, Indices]:
    """Return the bookings of the vertices and of the edges of a robot, as columns of `_Uses`."""
    resources = scenario.problem.resources
    edges = scenario.roadmap.find_edges(track.vertices[:-1], track.vertices[1:])
    if (edges < 0).any():
        k = int((edges < 0).argmax())
        raise KeyError(tuple(track.vertices[k : k + 2].tolist()))
    visit = np.arange(len(track))
    own = np.full(len(track), robot)
    vertices = track.vertices.astype(np.int64) + resources.get_vertex_row(robot, 0)
    # The last tick of a drive, not its first one: so the order of arrivals is all that counts, and
    # times that are no timetable, as those of routes in a journal, give the order that they say.
    lanes = edges.astype(np.int64) + resources.get_edge_row(robot, 0)
    return (
        np.stack((vertices, track.enter, own, visit, visit + 1)),
        np.stack((lanes, track.enter[1:] - 1, own[1:], visit[1:], visit[1:])),
    )


def list_waits(
    scenario: Scenario, tracks: Sequence[Track], firsts: Sequence[int]
) -> Iterator[tuple[int, int, int, int]]:
    """Yield robot and part, and the robot and visit of each arrival that the part waits for.

    They are sorted. A release graph has them in an object for each part.

    Parameters
    ----------
    scenario, tracks, firsts
        As for `ReleaseGraph.of`.
    """
    uses = _Uses.of(scenario, tracks)
    resources = scenario.problem.resources
    # Each use with each row that it excludes, as far as somebody uses that.
    rows, first_of_row, index = np.unique(uses.row, return_index=True, return_inverse=True)
    position = {row: k for k, row in enumerate(rows.tolist())}
    excluded = [
        [position[other] for other in list_excluded(resources, row) if other in position]
        for row in position
    ]
    counts = np.array([len(own) for own in excluded], np.int64)[index]
    use = np.repeat(np.arange(len(index)), counts)
    row = _chain([excluded[k] for k in index.tolist()])
    # The uses of that row that begin before: ranks of begins make one sorted key.
    ranks = np.unique(uses.begin, return_inverse=True)[1].reshape(-1)
    keys, n_ranks = index * (len(index) + 1) + ranks, len(index) + 1
    end = np.searchsorted(keys, row * n_ranks + ranks[use])
    begin = first_of_row[row]
    # The uses of a vertex exclude each other, so the last one was released only after all others
    # were left.
    is_vertex = rows[row] % (resources.n_vertices + resources.n_edges) < resources.n_vertices
    begin = np.where(is_vertex, np.maximum(begin, end - 1), begin)
    use, earlier = np.repeat(use, end - begin), _list_ranges(begin, end)
    is_other = uses.robot[use] != uses.robot[earlier]
    use, earlier = use[is_other], earlier[is_other]
    first = np.array(firsts, np.int64)
    robot, other = uses.robot[use], uses.robot[earlier]
    part, left = uses.part[use] + first[robot], uses.left[earlier] + first[other]
    order = np.lexsort((left, other, part, robot))
    columns = [column[order] for column in (robot, part, other, left)]
    # Of each other robot the last arrival.
    is_last = np.ones(len(order), bool)
    is_last[:-1] = np.logical_or.reduce([own[1:] != own[:-1] for own in columns[:3]])
    yield from zip(*(column[is_last].tolist() for column in columns), strict=True)


def _chain(lists: Sequence[Sequence[int]]) -> Indices:
    return np.fromiter(chain.from_iterable(lists), np.int64)


def _list_ranges(begin: Indices, end: Indices) -> Indices:
    """Return the numbers from each begin to before its end, one range after another."""
    counts = end - begin
    firsts = np.repeat(begin - np.cumsum(counts) + counts, counts)
    return firsts + np.arange(int(counts.sum()))
