"""The least cost of a few robots: a search over where all of them are.

In each tick a robot stands, serves a stop, drives or is done for ever; what it books in that tick,
and what it has left less than the headway ago, must not exclude what any other robot books, and
must not be closed. Points may book one vertex only; two points do not exchange vertices, and three
or more do not rotate where the rules forbid it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache, partial
from heapq import heappop, heappush
from itertools import pairwise, product
from typing import Any, NamedTuple, Protocol, TypeVar

from rightofway.model import Objective, Scenario
from tests.oracles.closures import begins, ends, is_shut
from tests.oracles.space import Shape, drive, incompatible, zones_of


class State(NamedTuple):
    """A robot at the start of a tick: where it stands or drives from, and what is left."""

    vertex: int
    way: tuple[int, ...] = ()  # the vertices that it drives to without a stop
    left: int = 0  # ticks of the drive to the last of them
    is_done: bool = False
    stage: int = 0  # the first stage that is not served
    dwell: int = 0  # ticks left of serving the stage before
    trail: tuple[tuple[tuple[Shape, ...], int], ...] = ()  # what was left, and for how long booked
    waits: bool = False  # it has stood at this vertex for longer than it needs; where that counts


class _OneRobot(Protocol):
    """What is known of the state of one robot."""

    @property
    def is_done(self) -> bool: ...


S = TypeVar("S", bound=_OneRobot)

Booked = tuple[Shape, ...]
Action = tuple[State, Booked, int]
"""The next state, what is booked in the tick, and what the tick costs."""


class _Fleet:
    """What each robot can do in a tick, and whether two robots can do it together."""

    def __init__(self, scenario: Scenario, parts: int = 1) -> None:
        self.scenario = scenario
        self.parts = parts
        self.books_ahead = scenario.rules.occupancy == "both"
        self.headway = int(scenario.problem.booking_rules.headway)
        self.stages = [itinerary.stages for itinerary in scenario.problem.itineraries]
        self.excludes = cache(partial(incompatible, scenario))
        self.clash = cache(self._clash)
        self.is_closed = cache(self._is_closed)
        self.ways = cache(self._ways)
        self.actions = cache(lambda robot, state: list(self._actions(robot, state)))

    def _is_closed(self, robot: int, booked: Booked, tick: int) -> bool:
        """Return whether something that a robot books in a tick is closed."""
        if not self.scenario.closures:
            return False
        places = [shape for shape in booked if shape[0] >= 0]  # the others are zones
        now = Fraction(tick)
        return any(is_shut(self.scenario, robot, shape, now, now + 1) for shape in places)

    def _clash(self, i: int, one: Booked, j: int, other: Booked) -> bool:
        """Return whether robots i and j book shapes that exclude each other."""
        if not self.books_ahead:  # points: only vertices exclude each other
            one = tuple(shape for shape in one if len(shape) == 1)
            other = tuple(shape for shape in other if len(shape) == 1)
        return any(self.excludes(i, x, j, y) for x, y in product(one, other))

    def surcharge(self, robot: int, edge: int) -> int:
        """Return what an edge costs beside the time [ticks]."""
        by_class = self.scenario.problem.itineraries[robot].surcharges
        return int(by_class[self.scenario.roadmap.class_of_edge[edge]]) if by_class else 0

    def _ways(self, vertex: int) -> list[tuple[int, ...]]:
        """Return what robots can drive along from a vertex to the next one where they may stop."""
        drawn, ended = self.scenario.roadmap.fold(), list[tuple[int, ...]]()
        ways: list[tuple[int, ...]] = [(vertex,)]
        while ways:
            way = ways.pop()
            for head in drawn.heads[drawn.indptr[way[-1]] : drawn.indptr[way[-1] + 1]].tolist():
                if drawn.is_passed(head):
                    ways += [(*way, head)] * (head not in way)
                elif head != vertex:
                    ended.append((*way[1:], head))
        return sorted(ended)

    def costs_alone(self, robot: int) -> dict[State, int]:
        """Return what a robot alone still costs in each state it can come to, without closures."""
        start = State(self.scenario.problem.itineraries[robot].home)
        return costs_to_go(start, partial(self.actions, robot))

    def together(
        self,
        states: tuple[State, ...],
        tick: int,
        is_late: Callable[[int, State, Action], bool],
    ) -> list[tuple[Action, ...]]:
        """Return what all robots can do in a tick, none too late, without exclusive bookings."""
        found: list[tuple[Action, ...]] = [()]
        for j, state in enumerate(states):
            chosen = found
            found = []
            for action in self.actions(j, state):
                if is_late(j, state, action) or self.is_closed(j, action[1], tick):
                    continue
                for before in chosen:  # a loop without a generator: all of the search is here
                    for i, one in enumerate(before):
                        if self.clash(i, one[1], j, action[1]) or _exchanges(
                            states[i], one[0], state, action[0]
                        ):
                            break
                    else:
                        found.append((*before, action))
        if self.scenario.rules.rotations:
            return found
        return [chosen for chosen in found if not _rotates(states, [one[0] for one in chosen])]

    def _actions(self, robot: int, state: State) -> Iterator[Action]:
        """Yield the next state, what is booked in the tick, and what the tick costs."""
        trail = tuple((shapes, left - 1) for shapes, left in state.trail if left > 1)
        behind = tuple(shape for shapes, _ in state.trail for shape in shapes)
        for after, booked, ticks in self._moves(robot, state._replace(trail=trail)):
            yield after, booked + behind, ticks

    def _moves(self, robot: int, state: State) -> Iterator[Action]:
        roadmap, stages = self.scenario.roadmap, self.stages[robot]
        inside = zones_of(roadmap, (state.vertex,))
        here: Booked = ((state.vertex,), *((-1 - zone,) for zone in inside))
        if state.is_done:
            yield state, here, 0
        elif state.dwell:
            yield state._replace(dwell=state.dwell - 1), here, self.parts
        elif state.left:
            left, edges = state.left - 1, list(pairwise((state.vertex, *state.way)))
            *passed, head = state.way
            zones = set().union(*(zones_of(roadmap, edge) for edge in edges))
            zones = zones.union(*(zones_of(roadmap, (vertex,)) for vertex in passed))
            behind: Booked = (*here, *edges, *((-1 - zone,) for zone in zones))
            behind += tuple((vertex,) for vertex in passed)
            booked: Booked = (*behind, *((-1 - zone,) for zone in zones_of(roadmap, (head,))))
            booked += ((head,),) if self.books_ahead else ()
            if left:
                yield state._replace(left=left), booked, self.parts
                return
            trail = (*state.trail, (behind, self.headway)) if self.headway else state.trail
            yield State(head, stage=state.stage, trail=trail), booked, self.parts
        else:
            rest = stages[state.stage :]
            if all(stage.vertex == state.vertex for stage in rest):
                work = sum(int(stage.work) for stage in rest)
                yield state._replace(is_done=True), here, work * self.parts
            if len(rest) > 1 and rest[0].vertex == state.vertex:
                dwell = int(rest[0].work + rest[0].turn)
                served = state._replace(stage=state.stage + 1, dwell=dwell)
                yield from self._moves(robot, served)
            counts = self.parts > 1
            yield state._replace(waits=counts), here, self.parts + (counts and not state.waits)
            for way in self.ways(state.vertex):
                lanes = list(pairwise((state.vertex, *way)))
                ticks = sum(int(drive(self.scenario, robot, *lane)) for lane in lanes)
                extra = sum(self.surcharge(robot, roadmap.list_edges(*lane)[0]) for lane in lanes)
                paid = counts * len(way) + extra * self.parts
                for after, booked, cost in self._moves(robot, state._replace(way=way, left=ticks)):
                    yield after, booked, cost + paid


def costs_to_go(start: S, actions: Callable[[S], Iterable[tuple[S, Any, int]]]) -> dict[S, int]:
    """Return what a robot alone still costs in each state it can come to from its start.

    An action is the next state, what is booked, and the cost; ``is_done`` states cost nothing more.
    """
    before: dict[S, list[tuple[S, int]]] = {start: []}
    todo = [start]
    while todo:
        state = todo.pop()
        for after, _, ticks in actions(state):
            if after not in before:
                before[after] = []
                todo.append(after)
            before[after].append((state, ticks))
    costs = {state: 0 for state in before if state.is_done}
    heap = [(0, state) for state in costs]
    while heap:
        cost, state = heappop(heap)
        if cost > costs[state]:
            continue
        for earlier, ticks in before[state]:
            if cost + ticks < costs.get(earlier, cost + ticks + 1):
                costs[earlier] = cost + ticks
                heappush(heap, (cost + ticks, earlier))
    return costs


def least_flowtime(
    scenario: Scenario,
    latest: int | None = None,
    *,
    below: float = math.inf,
    parts: int = 1,
) -> int | None:
    """Return the least sum of completions and surcharges by weight [ticks], None for no plan.

    With ``latest``, of the plans that are complete at that tick, only without surcharges; None if
    it is not ``below``.
    With ``parts``, each tick counts so many, and each drive and wait one: a wait is a visit that
    lasts longer than what the robot does there. Joint states in the order of what they cost and
    what each robot alone would cost from there.
    """
    fleet = _Fleet(scenario, parts)
    itineraries = scenario.problem.itineraries
    weights = [itinerary.weight for itinerary in itineraries]
    alone = [fleet.costs_alone(robot) for robot in range(len(itineraries))]
    moments = [begins(scenario, closure) for closure in scenario.closures]
    moments += [ends(scenario, closure) or 0 for closure in scenario.closures]
    opens = max(moments, default=0)  # nothing is opened or closed later
    horizon = max(opens, 0 if latest is None else latest + 1)  # nobody may complete later
    earliest = dict[tuple[State, ...], int]()  # of what was looked at; where nothing is ever closed

    def least_left(states: tuple[State, ...]) -> int | None:
        least = 0
        for weight, costs, state in zip(weights, alone, states, strict=True):
            if state not in costs:
                return None
            least += weight * costs[state]
        return least

    start = (0, tuple(State(itinerary.home) for itinerary in itineraries))
    best = {start: 0}
    least = least_left(start[1])
    heap = [] if least is None else [(least, 0, *start)]
    while heap:
        whole, negative, tick, states = heappop(heap)
        cost = -negative
        if whole >= below:
            return None
        if tick >= opens and all(
            state.is_done and not fleet.is_closed(robot, ((state.vertex,),), tick)
            for robot, state in enumerate(states)
        ):
            return cost
        if best[tick, states] < cost or (not opens and tick >= earliest.get(states, tick + 1)):
            continue
        earliest[states] = tick
        for chosen in fleet.together(states, tick, _lateness(alone, tick, latest)):
            after = (min(tick + 1, horizon), tuple(each[0] for each in chosen))
            total = cost + sum(w * each[2] for w, each in zip(weights, chosen, strict=True))
            if total < best.get(after, total + 1) and (left := least_left(after[1])) is not None:
                best[after] = total
                heappush(heap, (total + left, -total, *after))
    return None


def _lateness(
    alone: Sequence[dict[State, int]], tick: int, latest: int | None
) -> Callable[[int, State, Action], bool]:
    """Return whether a robot completes too late, or would do so alone from its next state on."""
    if latest is None:
        return lambda *_: False

    def is_late(robot: int, before: State, action: Action) -> bool:
        after, _, ticks = action
        left = alone[robot].get(after, latest)
        return not before.is_done and tick + ticks + left > latest

    return is_late


def least_value(objective: Objective, scenario: Scenario) -> int | None:
    """Return the least value of a plan [ticks], None where there is no plan.

    By the flowtime, weighted; by the makespan; or by both, for each tick that may be the makespan.
    """
    if objective is Objective.MAKESPAN:
        return least_makespan(scenario)
    flowtime = least_flowtime(scenario)
    if objective is not Objective.BOTH or flowtime is None:
        return flowtime
    weight = sum(itinerary.weight for itinerary in scenario.problem.itineraries)
    makespan, best = least_makespan(scenario), None
    assert makespan is not None
    while best is None or weight * makespan + flowtime < best:
        below = math.inf if best is None else best - weight * makespan
        cost = least_flowtime(scenario, makespan, below=below)
        best = best if cost is None else weight * makespan + cost
        makespan += 1
    return best


def least_makespan(scenario: Scenario) -> int | None:
    """Return the least time [ticks] at which all robots have completed, None for no plan.

    Only without closures. First of the plans that are complete hardly later than any robot alone
    could be, and then of more and more.
    """
    if least_flowtime(scenario) is None:
        return None
    fleet = _Fleet(scenario)
    start = tuple(State(itinerary.home) for itinerary in scenario.problem.itineraries)
    alone = [fleet.costs_alone(robot) for robot in range(len(start))]
    least = max(costs[state] for costs, state in zip(alone, start, strict=True))
    later, makespan = 0, None
    while makespan is None:
        makespan = _least_until(fleet, alone, start, least + later)
        later = 2 * later + 1
    return makespan


def _least_until(
    fleet: _Fleet, alone: Sequence[dict[State, int]], start: tuple[State, ...], limit: int
) -> int | None:
    """Return the least makespan that is not above a limit, None where there is none.

    All joint states tick by tick, each with the least latest completion of robots that are done.
    """
    reached, known = {start}, {start: 0}
    best: int | None = None
    for tick in range(limit + 2):
        if not reached or (best is not None and tick >= best):
            break
        after: dict[tuple[State, ...], int] = {}
        is_late = _lateness(alone, tick, limit)
        for robots in reached:
            for chosen in fleet.together(robots, tick, is_late):
                latest = known[robots]
                for before, action in zip(robots, chosen, strict=True):
                    if action[0].is_done and not before.is_done:
                        latest = max(latest, tick + action[2])
                then = tuple(action[0] for action in chosen)
                after[then] = min(latest, after.get(then, latest))
        reached = {then for then, latest in after.items() if latest < known.get(then, latest + 1)}
        known.update((then, after[then]) for then in reached)
        ends = [known[then] for then in reached if all(robot.is_done for robot in then)]
        best = min([*ends, *([] if best is None else [best])], default=None)
    return best


def _exchanges(one: State, one_after: State, other: State, other_after: State) -> bool:
    """Tell whether two robots exchange their vertices at the end of a tick."""
    moves = one.vertex != one_after.vertex
    return moves and one_after.vertex == other.vertex and other_after.vertex == one.vertex


def _rotates(states: tuple[State, ...], after: list[State]) -> bool:
    """Tell whether robots rotate at the end of a tick: each enters what the next one leaves."""
    enters = {
        one.vertex: then.vertex
        for one, then in zip(states, after, strict=True)
        if one.vertex != then.vertex
    }
    for first, vertex in enters.items():
        reached = vertex
        for _ in enters:
            if reached == first:
                return True
            reached = enters.get(reached, -1)
    return False
