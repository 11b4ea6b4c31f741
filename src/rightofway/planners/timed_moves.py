"""An order of single moves with times: where closures leave a few robots no way, or hardly one.

The moves are those of `moves`, each at the earliest time that all moves before it allow. Each time
between two closures of a vertex is a place of its own. A robot works at a stop as soon as it is
there, or passes it because it is closed too soon. Where the search ends before it reaches the end
of all trips, no plan exists.

Notes
-----
The search ends undecided after `MOST_STATES` states, or where robots might rotate. The number of
states grows with the power of the number of robots, so that only few robots are tried together.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from heapq import heapify, heappop, heappush
from itertools import count, product
from typing import NamedTuple

from rightofway.deadline import Deadline
from rightofway.errors import GaveUp, NoPlanExists
from rightofway.model import NEVER, Scenario, Tick, Track, compute_least_dwell
from rightofway.native import list_excluded
from rightofway.phrases import Phrase
from rightofway.planners.impossible import explain_no_room, find_smallest_set, make_fleet_of
from rightofway.planners.moves import Move, SingleMoves, State
from rightofway.planners.task import Draft, Task, make_planning_problem
from rightofway.site import VertexId

MOST_STATES, FEW_ROBOTS = 10_000, 4
"""States that are expanded at most, and the largest fleet to look for it."""

SHARE = 0.3
"""The part of the time for it."""

BETWEEN_CHECKS = 500
"""States from one look at the clock to the next."""


def plan_by_timed_moves(task: Task) -> Draft | None:
    """Plan a few robots among closures by an order of single moves; None where it ends undecided.

    Raises
    ------
    NoPlanExists
        With a small set of robots that have no plan.
    """
    scenario, deadline = task.scenario, task.deadline.shorten(SHARE)
    everybody = range(len(scenario.robots))
    if len(everybody) > FEW_ROBOTS:
        return None

    def is_blocked(robots: Sequence[int]) -> bool:
        return _search(_TimedMoves(make_fleet_of(scenario, robots)), deadline) is None

    moves = _TimedMoves(scenario)
    try:
        last = _search(moves, deadline)
    except GaveUp:
        return None
    if last is None:
        raise NoPlanExists([explain_no_room(scenario, find_smallest_set(everybody, is_blocked))])
    if make_planning_problem(scenario) is not scenario.problem:
        return None  # its robots might rotate
    task.has_plan()
    return Draft(tracks=tuple(_at_times(moves, last)), status=Phrase("order of moves"))


def _search(moves: _TimedMoves, deadline: Deadline) -> _Timed | None:
    """Return the last state of the order of moves of least flowtime; None if no order exists."""
    order = count()
    begins = moves.make_starts()
    waiting = [(moves.compute_least_flowtime(start), -next(order), start) for start in begins]
    heapify(waiting)
    known: dict[State, list[_Timed]] = {}
    for start in begins:
        known.setdefault(start.state, []).append(start)
    for expanded in range(MOST_STATES):
        if not waiting and moves.is_proof:
            return None
        if not waiting or (expanded % BETWEEN_CHECKS == 0 and deadline.measure_seconds_left() == 0):
            break
        _, _, node = heappop(waiting)
        if not any(node is other for other in known[node.state]):
            continue  # another one is as early
        if moves.to_go(node.state) == 0 and min(node.leave_by) == NEVER:
            return node
        for after in moves.make_timed_successors(node):
            others = known.setdefault(after.state, [])
            if any(other.is_as_early_as(after) for other in others):
                continue
            others[:] = [other for other in others if not after.is_as_early_as(other)]
            others.append(after)
            heappush(waiting, (moves.compute_least_flowtime(after), -next(order), after))
    raise GaveUp("no order of moves among closures in the states and the time that it may take")


class _Timed(NamedTuple):
    """A state with the earliest times of the moves that led there.

    `ready` is when each robot has worked and turned where it is, but for the turn to the next edge;
    `ends` when each robot's latest booking that excludes others from a row has ended, by row and
    robot; `leave_by` when the place of each robot is closed next; `enters` when each move has ended
    [ticks]; `edges` the edge along which each robot has come, -1 if it turns in no time.
    """

    state: State
    ready: tuple[int, ...]
    ends: dict[tuple[int, int], int]
    leave_by: tuple[int, ...]
    moves: tuple[Move, ...]
    enters: tuple[int, ...]
    edges: tuple[int, ...]

    def is_as_early_as(self, other: _Timed) -> bool:
        """Return whether no robot and no booking is later than in another one of this state.

        Headings differ where robots that turn in some time have come along different edges.
        """
        if self.leave_by != other.leave_by or self.edges != other.edges:
            return False
        return all(a <= b for a, b in zip(self.ready, other.ready, strict=True)) and all(
            end <= other.ends.get(key, 0) for key, end in self.ends.items()
        )


class _TimedMoves(SingleMoves):
    """The moves of a fleet, at the times that closures leave them."""

    def __init__(self, scenario: Scenario) -> None:
        super().__init__(scenario)
        problem = scenario.problem
        self._rules = problem.booking_rules
        self._closures = problem.closures
        self._dwells = [
            [
                sum(stage.work + stage.turn for stage in trip.stages[k:-1]) + trip.stages[-1].work
                for k in range(len(trip.stages))
            ]
            for trip in self.itineraries
        ]

    def _closed_at(self, robot: int, vertex: int) -> list[tuple[Tick, Tick]]:
        return [] if self._closures is None else self._closures.list_at_vertex(robot, vertex)

    def _closed_along(self, robot: int, edge: int) -> list[tuple[Tick, Tick]]:
        return [] if self._closures is None else self._closures.list_along_edge(robot, edge)

    def make_starts(self) -> list[_Timed]:
        """Return the fleet at home; a robot may work there at once, or later."""
        home = State(tuple(trip.home for trip in self.itineraries), self.no_stage)
        all_served = self.serve(home)
        leave_by = tuple(
            min((start for start, _ in self._closed_at(robot, place)), default=NEVER)
            for robot, place in enumerate(home.places)
        )
        choices = product(
            *(
                range(served + 1) if soon < NEVER else [served]
                for served, soon in zip(all_served.stages, leave_by, strict=True)
            )
        )
        begins = []
        for stages in choices:
            ready = tuple(
                compute_least_dwell(trip.stages[:served], leaves=True)
                for trip, served in zip(self.itineraries, stages, strict=True)
            )
            state = State(home.places, stages)
            begins.append(_Timed(state, ready, {}, leave_by, (), (), (-1,) * len(ready)))
        return begins

    def compute_least_flowtime(self, timed: _Timed) -> int:
        """Return a lower bound of the flowtime of plans that begin with some moves [ticks]."""
        to_come = zip(self._dwells, timed.state.stages, strict=True)
        dwells = sum(dwells[stage] for dwells, stage in to_come)
        return sum(timed.ready) + dwells + self.to_go(timed.state)

    def make_timed_successors(self, timed: _Timed) -> Iterator[_Timed]:
        """Yield what comes of every move that takes place as early as it can.

        Between any two closures of the vertex that it leads to, and with any number of stages
        served there that closures may leave time for.
        """
        for move, state in self.make_successors(timed.state):
            for enter, leave_by in self._enters(timed, move):
                robot, all_served = move.robot, state.stages[move.robot]
                before = timed.state.stages  # others that have passed a stop have not served it
                least = before[robot] if leave_by < NEVER else all_served
                for served in range(least, all_served + 1):
                    stages = (*before[:robot], served, *before[robot + 1 :])
                    after = State(state.places, stages)
                    yield self._moved(timed, move, after, enter, leave_by)

    def _enters(self, timed: _Timed, move: Move) -> Iterator[tuple[int, int]]:
        """Yield when a move can end at the earliest, and when its vertex is closed next."""
        robot = move.robot
        drive = self.itineraries[robot].edge_ticks[self.roadmap.class_of_edge[move.edge]]
        needed = {
            self.resources.get_edge_row(robot, move.edge),
            self.resources.get_vertex_row(robot, move.vertex),
        }
        enter = timed.ready[robot] + drive
        turning = self.itineraries[robot].turning
        if turning is not None:
            enter += turning.compute_turn(timed.edges[robot], move.edge)
        for (row, other), end in timed.ends.items():
            if other != robot and row in needed:
                enter = max(enter, self._rules.follow(end, drive))
        closed = self._closed_at(robot, move.vertex)
        opens = [0, *(end for _, end in closed)]
        closes = [*(start for start, _ in closed), NEVER]
        along = self._closed_along(robot, move.edge)
        for begin, end in zip(opens, closes, strict=True):
            enter = max(enter, self._rules.follow(begin, drive))
            for start, until in along:
                if start < self._rules.end(enter) and enter - drive < until:
                    enter = until + drive
            if begin == NEVER or self._rules.end(enter) > timed.leave_by[robot]:
                return
            if self._rules.start(enter, drive) < end:
                yield enter, end

    def _moved(self, timed: _Timed, move: Move, state: State, enter: int, leave_by: int) -> _Timed:
        """Return what comes of a move that ends at a tick."""
        robot, itinerary = move.robot, self.itineraries[move.robot]
        served = itinerary.stages[timed.state.stages[robot] : state.stages[robot]]
        ready = enter + compute_least_dwell(served, leaves=True)
        ends = dict(timed.ends)
        along = self.resources.get_edge_row(robot, move.edge)
        for left in (along, self.resources.get_vertex_row(robot, timed.state.places[robot])):
            for row in list_excluded(self.resources, left):
                ends[row, robot] = self._rules.end(enter)
        edges = timed.edges
        if itinerary.turning is not None:
            edges = (*edges[:robot], move.edge, *edges[robot + 1 :])
        return _Timed(
            state,
            (*timed.ready[:robot], ready, *timed.ready[robot + 1 :]),
            ends,
            (*timed.leave_by[:robot], leave_by, *timed.leave_by[robot + 1 :]),
            (*timed.moves, move),
            (*timed.enters, enter),
            edges,
        )


def _at_times(moves: _TimedMoves, timed: _Timed) -> list[Track]:
    """Return the tracks of moves at the times that they have."""
    vertices = [[trip.home] for trip in moves.itineraries]
    enter = [[Tick(0)] for _ in moves.itineraries]
    for move, tick in zip(timed.moves, timed.enters, strict=True):
        vertices[move.robot].append(VertexId(move.vertex))
        enter[move.robot].append(Tick(tick))
    return [Track.of(*track) for track in zip(vertices, enter, strict=True)]
