"""An order of single moves: where planning one after another finds no way.

For robots with a size.

A state is where all robots stand, and which stage each of them has to serve next. In a move, one
robot drives along one edge while all others stand. A greedy search, nearest to the end first, looks
for moves that bring all robots through their trips. The order of the moves then gives each robot a
route and every two bookings that exclude each other an order, and all visits are shifted to the
earliest times that keep it.

References
----------
Doran and Michie, *Experiments with the graph traverser program*, Proceedings of the Royal Society
A 294, 1966 (greedy search).

Notes
-----
Complete: the drives of any plan, in the order of their starts, are such moves, because a robot that
drives has booked the vertex that it drives to. So if no order of moves exists, no plan does. The
number of states grows with the power of the number of robots; the search ends undecided after
`MOST_STATES`. Where points book one vertex only, moves are in the order of their ends, and three or
more robots might rotate instead, unless rules forbid it: then nothing is proven.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from heapq import heappop, heappush
from itertools import count
from typing import NamedTuple, NoReturn

from rightofway.deadline import Deadline
from rightofway.errors import GaveUp
from rightofway.facts import Fact
from rightofway.model import Scenario, Status, Tick, Track, compute_least_dwell
from rightofway.native import list_excluded
from rightofway.repair.impossible import make_fleet_of, refuse_without_room
from rightofway.repair.plan_request import Draft, PlanRequest
from rightofway.search import Distances, FleetSearch
from rightofway.site import VertexId

ORDERING = Fact("ordering moves")

MOST_STATES = 100_000
"""States that are expanded at most."""

MOST_STATES_OF_FEWER = 20_000
"""The same for each trial to prove it for fewer robots."""

BETWEEN_CHECKS = 500
"""States from one look at the clock to the next; for large fleets divided by their robots."""


class State(NamedTuple):
    """The place of each robot, and the stage that it serves next."""

    places: tuple[int, ...]
    stages: tuple[int, ...]


class Move(NamedTuple):
    """A robot drives along an edge to a vertex."""

    robot: int
    vertex: int
    edge: int


def plan_by_moves(request: PlanRequest, search: FleetSearch) -> Draft:
    """Plan robots with a size by an order of single moves.

    Raises
    ------
    NoPlanExists
        If no order of moves exists.
    GaveUp
        After too many states, or when time ran out. With closures the moves are a proof only,
        because they have no times.
    """
    moves = _find_moves(request, SingleMoves(request.scenario), MOST_STATES)
    if request.scenario.problem.closures is not None:
        raise GaveUp(Fact("no plan in turn among closures"))
    search.start(_place_in_sequence(request, moves))
    search.retime()
    request.has_plan()
    return Draft(tracks=search.list_tracks(), status=Status("moves"))


def find_tracks_by_moves(
    request: PlanRequest, *, ends_anywhere: Collection[int], most_states: int
) -> list[Track]:
    """Return tracks in which robots with a size make one move after another.

    Raises
    ------
    NoPlanExists
        If no order of moves exists.
    GaveUp
        After too many states, or when time ran out.
    """
    return _place_in_sequence(
        request, _find_moves(request, SingleMoves(request.scenario, ends_anywhere), most_states)
    )


def _find_moves(request: PlanRequest, floor: SingleMoves, most_states: int) -> list[Move]:
    """Return moves that bring all robots through their trips, at no times."""
    moves = _search(floor, most_states, request.deadline)
    if moves is None:
        _refuse_without_order(request, floor)
    return moves


def _refuse_without_order(request: PlanRequest, floor: SingleMoves) -> NoReturn:
    """Raise for a fleet that has no order of moves: with a small set of robots, where proven."""
    if not floor.is_proof:
        raise GaveUp(Fact("no order of single moves"))

    def is_blocked(robots: Sequence[int]) -> bool:
        fleet = make_fleet_of(request.scenario, robots)
        return _search(SingleMoves(fleet), MOST_STATES_OF_FEWER, request.deadline) is None

    refuse_without_room(request.scenario, None if floor.ends_anywhere else is_blocked)


def _search(floor: SingleMoves, most_states: int, deadline: Deadline) -> list[Move] | None:
    """Return moves that bring all robots through their trips; None if no order of moves exists."""
    start = floor.serve(State(tuple(trip.home for trip in floor.itineraries), floor.no_stage))
    came_from: dict[State, tuple[State, Move] | None] = {start: None}
    order = count()  # of equally near states, the latest first
    waiting = [(floor.to_go(start), 0, start)]
    for expanded in count():
        if not waiting:
            return None
        if expanded == most_states:
            raise GaveUp(Fact("too many states of moves", states=most_states))
        if expanded % (1 + BETWEEN_CHECKS // len(floor.itineraries)) == 0:
            deadline.check(ORDERING)
        to_go, _, state = heappop(waiting)
        if to_go == 0:
            return _trace_path(came_from, state)
        for move, after in floor.make_successors(state):
            if after not in came_from:
                came_from[after] = state, move
                heappush(waiting, (floor.to_go(after), -next(order), after))
    raise AssertionError("the loop ends by itself")


def _trace_path(came_from: dict[State, tuple[State, Move] | None], state: State) -> list[Move]:
    moves = []
    while (step := came_from[state]) is not None:
        state, move = step
        moves.append(move)
    return moves[::-1]


class SingleMoves:
    """The moves of a fleet, and how far a state is from the end."""

    def __init__(self, scenario: Scenario, ends_anywhere: Collection[int] = ()) -> None:
        problem = scenario.problem
        may_rotate = problem.booking_rules.may_rotate
        self.is_proof = not may_rotate or len(problem.itineraries) <= 2  # noqa: PLR2004
        self.ends_anywhere = ends_anywhere
        self.itineraries = problem.itineraries
        self.no_stage = (0,) * len(self.itineraries)
        self.roadmap, self.resources = scenario.roadmap, problem.resources
        self._excluded: dict[int, int] = {}
        distances = Distances(self.roadmap)
        self._ways = [
            [
                distances.to(stage.vertex, itinerary.edge_ticks).tolist()
                for stage in itinerary.stages
            ]
            for itinerary in self.itineraries
        ]
        for robot in ends_anywhere:
            self._ways[robot][-1] = [0] * self.roadmap.n_vertices
        self._later = [
            [
                sum(ways[k][itinerary.stages[k - 1].vertex] for k in range(stage + 1, len(ways)))
                for stage in range(len(ways))
            ]
            for itinerary, ways in zip(self.itineraries, self._ways, strict=True)
        ]

    def serve(self, state: State) -> State:
        """Return the state after each robot has served its stages where it stands."""
        stages = list(state.stages)
        for robot, (itinerary, place) in enumerate(
            zip(self.itineraries, state.places, strict=True)
        ):
            while (
                stages[robot] < len(itinerary.stages) - 1
                and itinerary.stages[stages[robot]].vertex == place
            ):
                stages[robot] += 1
        return State(state.places, tuple(stages))

    def to_go(self, state: State) -> int:
        """Return the ticks that all robots drive to their ends, each as if it were alone."""
        return sum(
            ways[stage][place] + later[stage]
            for ways, later, place, stage in zip(
                self._ways, self._later, state.places, state.stages, strict=True
            )
        )

    def make_successors(self, state: State) -> Iterator[tuple[Move, State]]:
        """Yield every move that the places of all other robots allow, and the state after it."""
        rows = map(self.resources.get_vertex_row, range(len(state.places)), state.places)
        excluded = [self._make_mask(row) for row in rows]
        before, after = [0], [0]
        for mask in excluded:
            before.append(before[-1] | mask)
        for mask in reversed(excluded):
            after.append(after[-1] | mask)
        for robot, place in enumerate(state.places):
            by_others = before[robot] | after[len(excluded) - 1 - robot]
            first, end = int(self.roadmap.indptr[place]), int(self.roadmap.indptr[place + 1])
            for edge in range(first, end):
                head = int(self.roadmap.heads[edge])
                needed = 1 << self.resources.get_vertex_row(
                    robot, head
                ) | 1 << self.resources.get_edge_row(robot, edge)
                ticks = self.itineraries[robot].edge_ticks[self.roadmap.class_of_edge[edge]]
                is_useless = ticks < 0 or self._ways[robot][state.stages[robot]][head] < 0
                if needed & by_others or is_useless:
                    continue
                places = (*state.places[:robot], head, *state.places[robot + 1 :])
                after_move = self.serve(State(places, state.stages))
                yield Move(robot, head, edge), after_move

    def _make_mask(self, row: int) -> int:
        """Return the rows that a booking excludes, as bits."""
        if row not in self._excluded:
            self._excluded[row] = sum(1 << other for other in list_excluded(self.resources, row))
        return self._excluded[row]


def _place_in_sequence(request: PlanRequest, moves: list[Move]) -> list[Track]:
    """Return tracks in which the robots make their moves one after another."""
    roadmap, itineraries = request.scenario.roadmap, request.scenario.problem.itineraries
    vertices = [[itinerary.home] for itinerary in itineraries]
    enter, rules = (
        [[Tick(0)] for _ in itineraries],
        request.scenario.problem.booking_rules,
    )
    stages, now, edges = [0] * len(itineraries), 0, [-1] * len(itineraries)
    for robot, head, edge in moves:
        itinerary, place = itineraries[robot], vertices[robot][-1]
        served = []
        while (
            stages[robot] < len(itinerary.stages) - 1
            and itinerary.stages[stages[robot]].vertex == place
        ):
            served.append(itinerary.stages[stages[robot]])
            stages[robot] += 1
        ready = enter[robot][-1] + compute_least_dwell(served, leaves=True)
        if itinerary.turning is not None:
            ready += itinerary.turning.compute_turn(edges[robot], edge)
        edges[robot] = edge
        now = max(now, ready) + itinerary.edge_ticks[roadmap.class_of_edge[edge]]
        now = rules.end(now)
        vertices[robot].append(VertexId(head))
        enter[robot].append(Tick(now))
    return [Track.of(*track) for track in zip(vertices, enter, strict=True)]
