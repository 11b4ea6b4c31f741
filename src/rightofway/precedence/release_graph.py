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

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from rightofway.model import Scenario, Track
from rightofway.native import list_excluded


class Part(NamedTuple):
    """An edge of a robot's route and the vertex that it leads to; part 0 is the start."""

    robot: int
    number: int


class Arrival(NamedTuple):
    """A robot has arrived at the vertex of a visit of its route."""

    robot: int
    visit: int


class ReleaseGraph:
    """Which arrivals each part of each route waits for.

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
        self._after = defaultdict[Arrival, list[Part]](list)
        for part, arrivals in self._waits.items():
            for arrival in arrivals:
                self._after[arrival].append(part)

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
        uses = [_list_uses(scenario, robot, track) for robot, track in enumerate(tracks)]
        order = defaultdict[int, list[_Use]](list)  # the uses of each row, by begin
        for use in (use for own in uses for use in own):
            order[use.row].append(use)
        for by_row in order.values():
            by_row.sort()
        firsts = firsts or [0] * len(tracks)
        waits = {
            Part(robot, firsts[robot] + number): [
                Arrival(other, firsts[other] + visit) for other, visit in arrivals
            ]
            for robot, own in enumerate(uses)
            for number, arrivals in _list_waits(scenario, robot, own, order).items()
        }
        ends = [first + len(track) for first, track in zip(firsts, tracks, strict=True)]
        return cls(ends, waits, firsts)

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
        return tuple(self._after.get(arrival, ()))

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


class _Use(NamedTuple):
    """A robot books a row; sorted by begin, the uses of a vertex are in their order in the plan."""

    begin: int  # a tick in which it surely books it
    row: int
    robot: int
    part: int
    left: int  # the visit whose arrival ends it
    is_vertex: bool


def _list_uses(scenario: Scenario, robot: int, track: Track) -> list[_Use]:
    """Return the bookings of a robot: each vertex and each edge."""
    resources, roadmap = scenario.problem.resources, scenario.roadmap
    vertices, enter = track.vertices.tolist(), track.enter.tolist()
    own = resources.get_vertex_row(robot, 0)
    uses = [
        _Use(enter[k], own + vertex, robot, k, k + 1, is_vertex=True)
        for k, vertex in enumerate(vertices)
    ]
    edges = roadmap.find_edges(track.vertices[:-1], track.vertices[1:]).tolist()
    if -1 in edges:
        raise KeyError(tuple(vertices[edges.index(-1) :][:2]))
    # The last tick of a drive, not its first one: so the order of arrivals is all that counts, and
    # times that are no timetable, as those of routes in a journal, give the order that they say.
    uses += (
        _Use(enter[k] - 1, resources.get_edge_row(robot, edge), robot, k, k, is_vertex=False)
        for k, edge in enumerate(edges, 1)
    )
    return uses


def _list_waits(
    scenario: Scenario, robot: int, own: Sequence[_Use], order: Mapping[int, Sequence[_Use]]
) -> dict[int, list[Arrival]]:
    """Return the arrivals that each part of a robot waits for."""
    resources = scenario.problem.resources
    latest = defaultdict[int, dict[int, int]](dict)  # part: other robot: visit
    for use in own:
        for row in list_excluded(resources, use.row):
            users = order.get(row, ())
            for k in range(bisect_left(users, (use.begin,)) - 1, -1, -1):
                other = users[k]
                if other.robot != robot:
                    visits = latest[use.part]
                    visits[other.robot] = max(visits.get(other.robot, 0), other.left)
                if other.is_vertex:
                    # The uses of a vertex exclude each other, so the last one was released only
                    # after all others were left.
                    break
    return {
        part: [Arrival(other, left) for other, left in sorted(visits.items())]
        for part, visits in latest.items()
    }
