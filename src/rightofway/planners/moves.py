"""An order of single moves: where planning one after another finds no way.

For robots with a size, and for a few robots among closures.

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
more robots might rotate instead: then nothing is proven.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from heapq import heapify, heappop, heappush
from itertools import count, product
from typing import NamedTuple

from rightofway.errors import Blockage, GaveUp, NoPlanExists, listed
from rightofway.model import NEVER, Proof, Tick, Track, flowtime_of, least_dwell
from rightofway.phrases import Phrase
from rightofway.planners.task import Draft, Task, planning_headway, planning_problem
from rightofway.search import Distances, FleetSearch
from rightofway.site import VertexId

MOST_STATES = 100_000
"""States that are expanded at most."""

MOST_STATES_IN_TIME, FEW_ROBOTS = 10_000, 4
"""The same for the best order of moves, and the largest fleet to look for it."""

SHARE = 0.3
"""The part of the time for the best order of moves."""

BETWEEN_CHECKS = 500
"""States from one look at the clock to the next; for large fleets divided by their robots."""

MOST_NAMED = 6
"""A proof names the robots of fleets up to this size."""


class _State(NamedTuple):
    """Where each robot stands, and the stage that it serves next."""

    places: tuple[int, ...]
    stages: tuple[int, ...]


class _Move(NamedTuple):
    robot: int
    vertex: int
    edge: int


def plan_by_moves(task: Task, search: FleetSearch) -> Draft:
    """Plan robots with a size by an order of single moves.

    Parameters
    ----------
    task
        The problem; its robots have sizes.
    search
        The search for its fleet, to shift visits.

    Raises
    ------
    NoPlanExists
        If no order of moves exists.
    GaveUp
        After too many states, or when time ran out. With closures the moves are a proof only,
        because they have no times.
    """
    moves = _moves(task, _Floor(task), MOST_STATES)
    if task.scenario.problem.closures is not None:
        message = "robots one after another find no plan that keeps clear of closures"
        raise GaveUp(f"{message} (give a longer time limit, or fewer closures)")
    search.start(_in_sequence(task, moves))
    search.retime()
    task.has_plan()
    return Draft(tracks=search.tracks(), status="order of moves first")


def tracks_by_moves(task: Task, *, ends_anywhere: Collection[int], most_states: int) -> list[Track]:
    """Return tracks in which robots with a size make one move after another.

    Parameters
    ----------
    task
        The problem; its robots have sizes.
    ends_anywhere
        Robots that serve all stages but the last one, and may end at any vertex.
    most_states
        States that are expanded at most.

    Raises
    ------
    NoPlanExists
        If no order of moves exists.
    GaveUp
        After too many states, or when time ran out.
    """
    return _in_sequence(task, _moves(task, _Floor(task, ends_anywhere), most_states))


class _Timed(NamedTuple):
    """A state with the earliest times of the moves that led there.

    `ready` is when each robot has worked and turned where it is, but for the turn to the next edge;
    `ends` when each robot's latest booking that excludes others from a row has ended, by row and
    robot; `leave_by` when the place of each robot is closed next; `enters` when each move has ended
    [ticks]; `edges` the edge along which each robot has come, -1 if it turns in no time.
    """

    state: _State
    ready: tuple[int, ...]
    ends: dict[tuple[int, int], int]
    leave_by: tuple[int, ...]
    moves: tuple[_Move, ...]
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


def plan_few(task: Task, search: FleetSearch) -> Draft | None:
    """Plan a few robots by the order of moves of least flowtime.

    None for more than `FEW_ROBOTS`, after too many states, or when much of the time is over.

    A* over orders of moves: each move takes place as early as all moves before it allow, and each
    time between two closures of a vertex is a place of its own. A robot works at a stop as soon as
    it is there, or passes it because it is closed too soon.

    Parameters
    ----------
    task
        The problem; its robots have sizes, or something is closed.
    search
        The search for its fleet.

    Raises
    ------
    NoPlanExists
        If no order of moves exists.
    """
    deadline = task.deadline.sooner(SHARE)
    if len(task.scenario.robots) > FEW_ROBOTS:
        return None
    floor = _Floor(task)
    order = count()
    begins = floor.starts()
    waiting = [(floor.least_flowtime(start), -next(order), start) for start in begins]
    heapify(waiting)
    known: dict[_State, list[_Timed]] = {}
    for start in begins:
        known.setdefault(start.state, []).append(start)
    for expanded in count():
        if not waiting and floor.is_proof:
            raise NoPlanExists([_blockage(task)])
        is_over = expanded % BETWEEN_CHECKS == 0 and deadline.seconds_left() == 0
        if not waiting or expanded == MOST_STATES_IN_TIME or is_over:
            return None
        _, _, node = heappop(waiting)
        if not any(node is known_node for known_node in known[node.state]):
            continue  # another one is as early
        if floor.to_go(node.state) == 0 and min(node.leave_by) == NEVER:
            return _draft_of(task, search, floor, node)
        for after in floor.timed_successors(node):
            others = known.setdefault(after.state, [])
            if any(other.is_as_early_as(after) for other in others):
                continue
            others[:] = [other for other in others if not after.is_as_early_as(other)]
            others.append(after)
            heappush(waiting, (floor.least_flowtime(after), -next(order), after))
    raise AssertionError("the loop ends by itself")


def _draft_of(task: Task, search: FleetSearch, floor: _Floor, timed: _Timed) -> Draft:
    """Return the plan of timed moves."""
    if task.scenario.problem.closures is None:
        search.start(_in_sequence(task, list(timed.moves)))
        search.retime()
    else:
        search.start(_at_times(floor, timed))
    task.has_plan()
    tracks = search.tracks()
    # A spare tick of headway against rotations may cost a plan ticks that the rules do not ask.
    is_spared = planning_headway(task.scenario) > task.scenario.problem.headway
    if not floor.is_proof or is_spared:
        return Draft(tracks=tracks, status="order of moves")
    proof = Proof(bound=flowtime_of(task.scenario, tracks))
    return Draft(tracks=tracks, status="best order of moves", proof=proof)


def _moves(task: Task, floor: _Floor, most_states: int) -> list[_Move]:
    """Return moves that bring all robots through their trips, at no times."""
    start = floor.served(
        _State(tuple(itinerary.home for itinerary in floor.itineraries), floor.no_stage)
    )
    came_from: dict[_State, tuple[_State, _Move] | None] = {start: None}
    order = count()  # of equally near states, the latest first
    waiting = [(floor.to_go(start), 0, start)]
    for expanded in count():
        if not waiting:
            raise NoPlanExists([_blockage(task)])
        if expanded == most_states:
            raise GaveUp(f"no order of moves in {most_states} states (give robots more room)")
        if expanded % (1 + BETWEEN_CHECKS // len(floor.itineraries)) == 0:
            task.deadline.check("searching for an order of moves")
        to_go, _, state = heappop(waiting)
        if to_go == 0:
            return _path(came_from, state)
        for move, after in floor.successors(state):
            if after not in came_from:
                came_from[after] = state, move
                heappush(waiting, (floor.to_go(after), -next(order), after))
    raise AssertionError("the loop ends by itself")


def _path(came_from: dict[_State, tuple[_State, _Move] | None], state: _State) -> list[_Move]:
    moves = []
    while (step := came_from[state]) is not None:
        state, move = step
        moves.append(move)
    return moves[::-1]


def _blockage(task: Task) -> Blockage:
    names = tuple(robot.name for robot in task.scenario.robots)
    listed_names = listed(names)
    if len(names) > MOST_NAMED:
        listed_names = Phrase("all {number} robots", number=str(len(names)))
    reason = Phrase("{robots} have no room to pass each other", robots=listed_names)
    if task.scenario.problem.closures is not None:
        reason = Phrase(
            "{robots} have no room to pass each other at the times that closures leave them",
            robots=listed_names,
        )
    return Blockage(reason, names, (), Phrase("give more room, or other places"))


class _Floor:
    """The moves of a fleet, and how far a state is from the end."""

    def __init__(self, task: Task, ends_anywhere: Collection[int] = ()) -> None:
        problem = task.scenario.problem
        if problem.closures is not None:
            problem = planning_problem(task.scenario)
        may_rotate = not problem.books_ahead and len(problem.itineraries) > 2  # noqa: PLR2004
        is_headway = problem.headway == task.scenario.problem.headway
        self.is_proof = is_headway and not may_rotate
        self.itineraries = problem.itineraries
        self.no_stage = (0,) * len(self.itineraries)
        self._roadmap, self._resources = task.scenario.roadmap, problem.resources
        self._excluded: dict[int, int] = {}
        self._headway, self._ahead = problem.headway, problem.books_ahead
        self._closures = problem.closures
        self._dwells = [
            [
                sum(stage.work + stage.turn for stage in itinerary.stages[k:-1])
                + itinerary.stages[-1].work
                for k in range(len(itinerary.stages))
            ]
            for itinerary in self.itineraries
        ]
        distances = Distances(self._roadmap)
        self._ways = [
            [
                distances.to(stage.vertex, itinerary.edge_ticks).tolist()
                for stage in itinerary.stages
            ]
            for itinerary in self.itineraries
        ]
        for robot in ends_anywhere:
            self._ways[robot][-1] = [0] * self._roadmap.n_vertices
        self._later = [
            [
                sum(ways[k][itinerary.stages[k - 1].vertex] for k in range(stage + 1, len(ways)))
                for stage in range(len(ways))
            ]
            for itinerary, ways in zip(self.itineraries, self._ways, strict=True)
        ]

    def _closed_at(self, robot: int, vertex: int) -> list[tuple[Tick, Tick]]:
        return [] if self._closures is None else self._closures.at_vertex(robot, vertex)

    def _closed_along(self, robot: int, edge: int) -> list[tuple[Tick, Tick]]:
        return [] if self._closures is None else self._closures.along_edge(robot, edge)

    def starts(self) -> list[_Timed]:
        """Return the fleet at home; a robot may work there at once, or later."""
        home = _State(tuple(itinerary.home for itinerary in self.itineraries), self.no_stage)
        all_served = self.served(home)
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
        next_states = []
        for stages in choices:
            ready = tuple(
                least_dwell(itinerary.stages[:served], leaves=True)
                for itinerary, served in zip(self.itineraries, stages, strict=True)
            )
            state = _State(home.places, stages)
            next_states.append(_Timed(state, ready, {}, leave_by, (), (), (-1,) * len(ready)))
        return next_states

    def served(self, state: _State) -> _State:
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
        return _State(state.places, tuple(stages))

    def to_go(self, state: _State) -> int:
        """Return the ticks that all robots drive to their ends, each as if it were alone."""
        return sum(
            ways[stage][place] + later[stage]
            for ways, later, place, stage in zip(
                self._ways, self._later, state.places, state.stages, strict=True
            )
        )

    def least_flowtime(self, timed: _Timed) -> int:
        """Return a lower bound of the flowtime of plans that begin with some moves [ticks]."""
        to_come = zip(self._dwells, timed.state.stages, strict=True)
        dwells = sum(dwells[stage] for dwells, stage in to_come)
        return sum(timed.ready) + dwells + self.to_go(timed.state)

    def timed_successors(self, timed: _Timed) -> Iterator[_Timed]:
        """Yield what comes of every move that takes place as early as it can.

        Between any two closures of the vertex that it leads to, and with any number of stages
        served there that closures may leave time for.
        """
        for move, state in self.successors(timed.state):
            for enter, leave_by in self._enters(timed, move):
                robot, all_served = move.robot, state.stages[move.robot]
                before = timed.state.stages  # others that have passed a stop have not served it
                least = before[robot] if leave_by < NEVER else all_served
                for served in range(least, all_served + 1):
                    stages = (*before[:robot], served, *before[robot + 1 :])
                    after = _State(state.places, stages)
                    yield self._moved(timed, move, after, enter, leave_by)

    def _enters(self, timed: _Timed, move: _Move) -> Iterator[tuple[int, int]]:
        """Yield when a move can end at the earliest, and when its vertex is closed next."""
        robot = move.robot
        drive = self.itineraries[robot].edge_ticks[self._roadmap.class_of_edge[move.edge]]
        approach = drive if self._ahead else 0
        needed = {
            self._resources.edge_row(robot, move.edge),
            self._resources.vertex_row(robot, move.vertex),
        }
        enter = timed.ready[robot] + drive
        turning = self.itineraries[robot].turning
        if turning is not None:
            enter += turning.of(timed.edges[robot], move.edge)
        for (row, other), end in timed.ends.items():
            if other != robot and row in needed:
                enter = max(enter, end + approach)
        closed = self._closed_at(robot, move.vertex)
        opens = [0, *(end for _, end in closed)]
        closes = [*(start for start, _ in closed), NEVER]
        along = self._closed_along(robot, move.edge)
        for begin, end in zip(opens, closes, strict=True):
            enter = max(enter, begin + approach)
            for start, until in along:
                if start < enter + self._headway and enter - drive < until:
                    enter = until + drive
            if begin == NEVER or enter + self._headway > timed.leave_by[robot]:
                return
            if enter - approach < end:
                yield enter, end

    def _moved(
        self, timed: _Timed, move: _Move, state: _State, enter: int, leave_by: int
    ) -> _Timed:
        """Return what comes of a move that ends at a tick."""
        robot, itinerary = move.robot, self.itineraries[move.robot]
        served = itinerary.stages[timed.state.stages[robot] : state.stages[robot]]
        ready = enter + least_dwell(served, leaves=True)
        ends = dict(timed.ends)
        along = self._resources.edge_row(robot, move.edge)
        for left in (along, self._resources.vertex_row(robot, timed.state.places[robot])):
            for row in self._resources.excluded_by(left):
                ends[row, robot] = enter + self._headway
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

    def successors(self, state: _State) -> Iterator[tuple[_Move, _State]]:
        """Yield every move that the places of all other robots allow, and the state after it."""
        rows = map(self._resources.vertex_row, range(len(state.places)), state.places)
        excluded = [self._excluded_by(row) for row in rows]
        before, after = [0], [0]
        for mask in excluded:
            before.append(before[-1] | mask)
        for mask in reversed(excluded):
            after.append(after[-1] | mask)
        for robot, place in enumerate(state.places):
            by_others = before[robot] | after[len(excluded) - 1 - robot]
            first, end = int(self._roadmap.indptr[place]), int(self._roadmap.indptr[place + 1])
            for edge in range(first, end):
                head = int(self._roadmap.heads[edge])
                needed = 1 << self._resources.vertex_row(
                    robot, head
                ) | 1 << self._resources.edge_row(robot, edge)
                ticks = self.itineraries[robot].edge_ticks[self._roadmap.class_of_edge[edge]]
                is_useless = ticks < 0 or self._ways[robot][state.stages[robot]][head] < 0
                if needed & by_others or is_useless:
                    continue
                places = (*state.places[:robot], head, *state.places[robot + 1 :])
                after_move = self.served(_State(places, state.stages))
                yield _Move(robot, head, edge), after_move

    def _excluded_by(self, row: int) -> int:
        """Return the rows that a booking excludes, as bits."""
        if row not in self._excluded:
            self._excluded[row] = sum(1 << other for other in self._resources.excluded_by(row))
        return self._excluded[row]


def _at_times(floor: _Floor, timed: _Timed) -> list[Track]:
    """Return the tracks of moves at the times that they have."""
    vertices = [[itinerary.home] for itinerary in floor.itineraries]
    enter = [[Tick(0)] for _ in floor.itineraries]
    for move, tick in zip(timed.moves, timed.enters, strict=True):
        vertices[move.robot].append(VertexId(move.vertex))
        enter[move.robot].append(Tick(tick))
    return [Track.of(*track) for track in zip(vertices, enter, strict=True)]


def _in_sequence(task: Task, moves: list[_Move]) -> list[Track]:
    """Return tracks in which the robots make their moves one after another."""
    roadmap, itineraries = task.scenario.roadmap, task.scenario.problem.itineraries
    vertices = [[itinerary.home] for itinerary in itineraries]
    enter = [[Tick(0)] for _ in itineraries]
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
        ready = enter[robot][-1] + least_dwell(served, leaves=True)
        if itinerary.turning is not None:
            ready += itinerary.turning.of(edges[robot], edge)
        edges[robot] = edge
        now = max(now, ready) + itinerary.edge_ticks[roadmap.class_of_edge[edge]]
        now += planning_headway(task.scenario)
        vertices[robot].append(VertexId(head))
        enter[robot].append(Tick(now))
    return [Track.of(*track) for track in zip(vertices, enter, strict=True)]
