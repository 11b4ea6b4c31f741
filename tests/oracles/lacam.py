"""A plan for a fleet with clocks, instant by instant: PIBT and LaCAM, as plainly as they can be.

Robots choose one after another. Each looks at its neighbours and its own place, the one from where
it would be at its target soonest first, and takes the first that nobody else takes and whose robot,
if one is there and free, finds another place. Where that fails, or leads to a known state, a search
tells one robot more where to go.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass, field

from rightofway.model import Scenario
from tests.oracles.distances import Edge, distances_to

__all__ = ["Fleet", "tracks_by_lacam"]

UNREACHABLE = 1 << 24
Move = tuple[int, int, int]
"""Robot, vertex, arrival."""


class Ties:
    """The kernel's random numbers."""

    def __init__(self, seed: int) -> None:
        self.state = seed

    def draw(self) -> int:
        word = 2**64 - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & word
        mixed = (self.state ^ self.state >> 30) * 0xBF58476D1CE4E5B9 & word
        mixed ^= mixed >> 27
        return (mixed * 0x94D049BB133111EB & word) >> 32


@dataclass
class Robot:
    """Where a robot is, where it will be, until when it is busy, and what it has done."""

    at: int
    to: int
    busy_until: int | None = None
    stage: int = 0
    since: int = 0


@dataclass
class Fleet:
    """All robots of a scenario at one instant; edges are all of one length."""

    scenario: Scenario
    headway: int
    may_rotate: bool
    seed: int
    now: int = 0
    left: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        roadmap = self.scenario.roadmap
        self.trips = self.scenario.problem.itineraries
        self.heads = [
            roadmap.heads[roadmap.indptr[v] : roadmap.indptr[v + 1]].tolist()
            for v in range(roadmap.n_vertices)
        ]
        edges = [Edge(v, head, 1) for v, heads in enumerate(self.heads) for head in heads]
        self.steps: dict[int, list[int]] = {
            stage.vertex: distances_to(stage.vertex, roadmap.n_vertices, edges)
            for trip in self.trips
            for stage in trip.stages
        }
        self.ties = Ties(self.seed)
        self.robots = [Robot(trip.home, trip.home) for trip in self.trips]
        self.next: dict[int, int] = {}
        for robot in range(len(self.robots)):
            self._begin_stage(robot)
        self.first_way = [self.way(r, robot.at) for r, robot in enumerate(self.robots)]

    # What is the case

    def undecided(self) -> set[int]:
        """Return who is neither busy nor at the end of its trip."""
        return {r for r in range(len(self.robots)) if not self.busy(r) and not self.has_arrived(r)}

    def busy(self, robot: int) -> bool:
        return self.robots[robot].busy_until is not None

    def here(self, vertex: int) -> int | None:
        """Return who is at a vertex."""
        return next((r for r, robot in enumerate(self.robots) if robot.at == vertex), None)

    def target(self, robot: int) -> int:
        return self.trips[robot].stages[self.robots[robot].stage].vertex

    def way(self, robot: int, vertex: int) -> int:
        steps = self.steps[self.target(robot)][vertex]
        return UNREACHABLE if steps < 0 else steps

    def drive(self, robot: int) -> int:
        return self.trips[robot].edge_ticks[0]

    def gap(self, robot: int) -> int:
        return self.headway + (
            self.drive(robot) if self.scenario.problem.booking_rules.books_ahead else 0
        )

    def has_arrived(self, robot: int) -> bool:
        is_last = self.robots[robot].stage == len(self.trips[robot].stages) - 1
        return is_last and self.robots[robot].at == self.target(robot)

    # The clock

    def go_on(self, moves: Sequence[Move]) -> bool:
        """Take moves, and go on to when a robot finishes something; False if nobody is busy."""
        for r, vertex, arrival in moves:
            if self.has_arrived(r):
                self.robots[r].since = self.now
            self.robots[r].to, self.robots[r].busy_until = vertex, arrival
        busy = [robot.busy_until for robot in self.robots if robot.busy_until is not None]
        if not busy:
            return False
        self.now = min(busy)
        finished = [r for r, robot in enumerate(self.robots) if robot.busy_until == self.now]
        for r in finished:
            robot = self.robots[r]
            robot.busy_until = None
            if robot.at == robot.to:
                robot.stage += 1
                robot.since = self.now
            else:
                self.left[robot.at] = self.now
        for r in finished:
            self.robots[r].at = self.robots[r].to
            self._begin_stage(r)
        return True

    def _begin_stage(self, robot: int) -> None:
        trip, state = self.trips[robot], self.robots[robot]
        while state.stage < len(trip.stages) - 1 and state.at == self.target(robot):
            stage = trip.stages[state.stage]
            if stage.work + stage.turn > 0:
                state.busy_until = self.now + stage.work + stage.turn
                return
            state.stage += 1
            state.since = self.now

    # The choice

    def choose(self, order: Sequence[int], fixed: Sequence[tuple[int, int]]) -> list[Move] | None:
        """Return who moves where and when it arrives, or None if that does not work out."""
        self.next = {}
        for robot, vertex in fixed:
            if not self._is_open(robot, vertex):
                return None
            self.next[robot] = vertex
        pushed = (self.here(vertex) for _, vertex in fixed)
        for robot in [*order, *(r for r in pushed if r is not None and not self.busy(r))]:
            if robot not in self.next and not self._choose_one(robot):
                return None
        moving = [r for r, vertex in self.next.items() if vertex != self.robots[r].at]
        if not self.may_rotate and any(self._circle(r) for r in moving):
            return None
        return [(r, self.next[r], self._arrival(r)) for r in moving]

    def _is_open(self, robot: int, place: int) -> bool:
        """Tell whether nobody else comes there, works there, or comes from there to here."""
        resident = self.here(place)
        if self._is_driven_to(place) or place in self.next.values():
            return False
        if resident is None or resident == robot:
            return True
        works = self.busy(resident) and self.robots[resident].to == place
        return not works and self.next.get(resident) != self.robots[robot].at

    def _is_driven_to(self, place: int) -> bool:
        return any(
            robot.to == place and robot.at != place and robot.busy_until for robot in self.robots
        )

    def _choose_one(self, robot: int) -> bool:
        here = self.robots[robot].at
        places = self._places(robot)
        if self._waits_for_others(robot):
            self.next[robot] = here
            return True
        partner = self._swap_partner(robot, places[0])
        if partner is not None:
            places.reverse()
        for place in places:
            if not self._is_open(robot, place):
                continue
            if place != here and not self.may_rotate and self._closes_circle(robot, place):
                continue
            self.next[robot] = place
            other = self.here(place)
            pushes = other is not None and other != robot and self._is_idle(other)
            if other is not None and pushes and not self._choose_one(other):
                continue
            if partner is not None and place == places[0] != here:
                self._pull(partner, here)
            return True
        self.next[robot] = here
        return False

    def _waits_for_others(self, robot: int) -> bool:
        """Tell whether it may stay, and others drive to all places that may rank before that."""
        here = self.robots[robot].at
        better = [
            head for head in self.heads[here] if self.way(robot, head) <= self.way(robot, here)
        ]
        return self._is_open(robot, here) and all(map(self._is_driven_to, better))

    def _pull(self, partner: int, place: int) -> None:
        leads_there = place in self.heads[self.robots[partner].at]
        if self._is_idle(partner) and place not in self.next.values() and leads_there:
            self.next[partner] = place

    def _is_idle(self, robot: int) -> bool:
        return robot not in self.next and not self.busy(robot)

    def _places(self, robot: int) -> list[int]:
        here, pace = self.robots[robot].at, self.drive(robot)
        ranked = [
            (self._soonest(robot, head) + self.way(robot, head) * pace, self.ties.draw(), head)
            for head in self.heads[here]
        ]
        ranked.append((self.now + pace + self.way(robot, here) * pace, self.ties.draw(), here))
        return [place for _, _, place in sorted(ranked)]

    def _soonest(self, robot: int, place: int) -> int:
        """Return when the robot could be there, if whoever is free makes room at once."""
        other, driven = self.here(place), self.now + self.drive(robot)
        if other is None:
            return max(driven, self.left.get(place, -self.headway) + self.gap(robot))
        until = self.robots[other].busy_until
        return max(driven, (until or 0) + self.gap(robot))

    def _closes_circle(self, robot: int, place: int) -> bool:
        other, seen = self.here(place), set()
        while other is not None and other != robot and other not in seen:
            seen.add(other)
            if self.next.get(other, self.robots[other].at) == self.robots[other].at:
                return False
            other = self.here(self.next[other])
        return other == robot

    # Changing places in a corridor

    def _swap_partner(self, robot: int, wanted: int) -> int | None:
        here = self.robots[robot].at
        if wanted == here:
            return None
        ahead = self.here(wanted)
        can_swap = self._can_swap(wanted, here)
        if ahead is not None and self._is_idle(ahead):
            must_swap = self._must_swap(robot, ahead, here, wanted)
            if must_swap and can_swap:
                return ahead
        for place in self.heads[here]:
            behind = self.here(place)
            if behind is None or place == wanted or self.busy(behind):
                continue
            if self._must_swap(behind, robot, here, wanted) and can_swap:
                return behind
        return None

    def _ways_on(self, come_from: int, at: int) -> list[int]:
        """Return where the corridor goes on; not into a dead end whose robot is at its target."""
        ways = []
        for head in self.heads[at]:
            resident = self.here(head)
            ends_here = resident is not None and self.target(resident) == head
            if head != come_from and not (len(self.heads[head]) == 1 and ends_here):
                ways.append(head)
        return ways

    def _must_swap(self, pusher: int, puller: int, behind: int, ahead: int) -> bool:
        while self.way(pusher, ahead) < self.way(pusher, behind):
            ways = self._ways_on(behind, ahead)
            if len(ways) > 1:
                return False
            if not ways:
                break
            behind, ahead = ahead, ways[0]
        wants_back = self.way(puller, behind) < self.way(puller, ahead)
        wants_on = self.way(pusher, ahead) < self.way(pusher, behind)
        return wants_back and (wants_on or self.way(pusher, behind) == 0)

    def _can_swap(self, behind: int, ahead: int) -> bool:
        start = behind
        while ahead != start:
            ways = self._ways_on(behind, ahead)
            if len(ways) != 1:
                return len(ways) > 1
            behind, ahead = ahead, ways[0]
        return False

    # When they arrive

    def _circle(self, robot: int) -> list[int]:
        """Return the robots that move round a circle with this one, if there are any."""
        circle, other = [robot], self.here(self.next[robot])
        while other is not None and other not in circle:
            if self.next.get(other, self.robots[other].at) == self.robots[other].at:
                return []
            circle.append(other)
            other = self.here(self.next[other])
        return circle if other == robot else []

    def _arrival(self, robot: int) -> int:
        circle = self._circle(robot)
        if circle:
            return self.now + max(self.drive(one) for one in circle)
        place = self.next[robot]
        ahead = self.here(place)
        if ahead is None:
            left = self.left.get(place, -self.headway)
        else:
            until = self.robots[ahead].busy_until
            left = self._arrival(ahead) if until is None else until
        return max(self.now + self.drive(robot), left + self.gap(robot))

    # The search

    def by_urgency(self) -> list[int]:
        """Return the undecided, the longest on its way first, then the longer first way."""
        urgency = {r: self.drive(r) * (self.now - self.robots[r].since) for r in self.undecided()}
        return sorted(urgency, key=lambda r: (-urgency[r], -self.first_way[r], r))

    def is_goal(self) -> bool:
        return all(map(self.has_arrived, range(len(self.robots))))

    def state(self) -> tuple[object, ...]:
        """Return what tells states apart: all but the clock, and who was where before."""
        return tuple(
            (r.at, r.to, r.stage, None if r.busy_until is None else r.busy_until - self.now)
            for r in self.robots
        )


@dataclass
class _Constraint:
    """Where some robots have to go: one, and those of the parent."""

    fixed: tuple[tuple[int, int], ...] = ()


@dataclass
class _Node:
    fleet: Fleet
    moves: list[list[Move]]
    constraints: list[_Constraint] = field(default_factory=lambda: [_Constraint()])
    order: list[int] | None = None
    n_asked: int = 0

    def next_constraint(self) -> _Constraint | None:
        """Return where robots have to go next; the constraint before has its successors first."""
        if self.n_asked > 0:
            self._branch(self.constraints[self.n_asked - 1])
        if self.n_asked == len(self.constraints):
            return None
        self.n_asked += 1
        return self.constraints[self.n_asked - 1]

    def _branch(self, constraint: _Constraint) -> None:
        if self.order is None:
            fleet, urgent = self.fleet, self.fleet.by_urgency()
            free = [r for r in range(len(fleet.robots)) if not fleet.busy(r)]
            self.order = [*urgent, *(r for r in free if fleet.has_arrived(r))]
        if len(constraint.fixed) < len(self.order):
            robot = self.order[len(constraint.fixed)]
            here = self.fleet.robots[robot].at
            for place in [*self.fleet.heads[here], here]:
                self.constraints.append(_Constraint(((robot, place), *constraint.fixed)))


def tracks_by_lacam(fleet: Fleet, most_expanded: int) -> list[tuple[list[int], list[int]]] | None:
    """Return where each robot is, when; None if there is no plan after so many expansions."""
    known = {fleet.state(): _Node(fleet, [])}
    stack = [*known.values()]
    for _ in range(most_expanded):
        if not stack:
            return None
        node = stack[-1]
        if node.fleet.is_goal():
            return _tracks(fleet, node.moves)
        constraint = node.next_constraint()
        if constraint is None:
            stack.pop()
            continue
        moves = node.fleet.choose(node.fleet.by_urgency(), constraint.fixed)
        after = copy.copy(node.fleet)
        after.robots, after.left = copy.deepcopy(after.robots), dict(after.left)
        if moves is not None and after.go_on(moves):
            stack.append(known.setdefault(after.state(), _Node(after, [*node.moves, moves])))
    return None


def _tracks(fleet: Fleet, moves: list[list[Move]]) -> list[tuple[list[int], list[int]]]:
    tracks: list[tuple[list[int], list[int]]] = [([trip.home], [0]) for trip in fleet.trips]
    for robot, vertex, arrival in (move for some in moves for move in some):
        tracks[robot][0].append(vertex)
        tracks[robot][1].append(arrival)
    return tracks
