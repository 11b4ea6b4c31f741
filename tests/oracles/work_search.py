"""The best plan of a tiny fleet with jobs, by exhaustive search over joint states, tick by tick.

`find_best` returns a plan of least unserved weight, and among those of least service cost. It knows
points without headway and closures; a joint state has the place and the activity of each robot, its
state of charge, and how far each job is. Nothing is pruned but states that have come before, when
no time of a job is left.

In each tick a robot waits, drives, turns, works, charges or rests. It decides to rest at the
instant of its last event, because its battery then loses nothing more.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import chain, combinations, product
from math import ceil, floor, inf
from typing import NamedTuple

from rightofway.model import (
    Battery,
    Plan,
    PlannedItem,
    PlannerRun,
    Robot,
    Scenario,
    Tick,
    Track,
)
from tests.oracles.work import Fleet, Own, price, way_to_charger

__all__ = ["Best", "TooLarge", "find_best"]

MOST_STATES = 1_200
"""Joint states of one tick at most."""


class TooLarge(Exception):
    """A search that would take too long."""


class Best(NamedTuple):
    """The least unserved weight, the least service cost with it [time units], and a plan."""

    weight: Fraction
    cost: Fraction
    plan: Plan


class Body(NamedTuple):
    """A robot at an instant: where it is, and what it is doing until then or longer."""

    vertex: int
    before: int  # where it came from, -1 at its start
    target: int = -1  # where it drives to; -1 while it does not
    left: int = 0  # ticks until its turn and drive, or its work, ends
    drive: int = 0  # ticks of the drive itself, at the end of those
    work: tuple[int, int] | None = None  # the job and the stop that it works at
    has_worked: bool = False  # in this visit, so that it turns before it drives
    has_tour: bool = False
    is_low: bool = False  # it has begun below its reserve, and has not charged yet
    is_charging: bool = False
    soc: Fraction = Fraction(1)
    is_fresh: bool = False  # its last event is now
    rests: bool = False


class Joint(NamedTuple):
    """All robots, and for each job its next stop and its robot, -1 for none."""

    bodies: tuple[Body, ...]
    jobs: tuple[tuple[int, int], ...]


Event = tuple[str, int, int, int, int, int]
"""Kind (enter, item), robot; vertex and tick; or begin, end, job and stop."""

Story = tuple["Story | None", tuple[Event, ...]]
"""What has happened, the last events first."""

Layer = dict[Joint, tuple[Fraction, Story]]
"""Joint states of a tick, each with its cost so far and its story."""


def find_best(scenario: Scenario, horizon: int = 80) -> Best | None:
    """Return the best plan, or None if there is none.

    Raises
    ------
    TooLarge
        If there are too many joint states, or too many ticks.
    """
    fleet = Fleet(scenario)
    assert not scenario.closures, "the search knows no closures"
    assert scenario.problem.booking_rules.headway == 0, "the search knows no headway"
    levels: dict[Fraction, list[frozenset[int]]] = {}
    for unserved in _list_unserved(fleet):
        weight = sum((fleet.jobs[job].weight for job in unserved), Fraction(0))
        levels.setdefault(weight, []).append(unserved)
    for weight, choices in sorted(levels.items()):
        best = [
            (cost, plan)
            for unserved in choices
            for cost, plan in _Search(fleet, unserved, horizon).find()
        ]
        if best:
            cost, plan = min(best, key=lambda pair: pair[0])
            return Best(weight, cost, plan)
    return None


def _list_unserved(fleet: Fleet) -> Iterator[frozenset[int]]:
    """Yield which jobs may be unserved together."""
    index = {job.name: number for number, job in enumerate(fleet.jobs)}
    free = [number for number, job in enumerate(fleet.jobs) if job.name not in fleet.begun]
    for unserved in chain.from_iterable(combinations(free, k) for k in range(len(free) + 1)):
        follows = (
            number
            for number in free
            if number not in unserved
            and any(index[name] in unserved for name in fleet.jobs[number].after)
        )
        if next(follows, None) is None:
            yield frozenset(unserved)


class _Search:
    """The search for the jobs that are served."""

    def __init__(self, fleet: Fleet, unserved: frozenset[int], horizon: int) -> None:
        self.fleet, self.unserved, self.horizon = fleet, unserved, horizon
        scenario = fleet.scenario
        self.robots, self.jobs, self.tick = scenario.robots, fleet.jobs, fleet.tick
        self.late = Fraction(10) if scenario.rules.late is None else scenario.rules.late
        self.is_both = scenario.rules.occupancy == "both"
        self.rotations = scenario.rules.rotations
        self.batteries = dict(scenario.batteries)
        self.names = {job.name: number for number, job in enumerate(self.jobs)}
        self.ready = [fleet.ready(robot) for robot in self.robots]
        self.turns = [robot.turn_rate or scenario.rules.turn_rate for robot in self.robots]
        self.chargers = [fleet.chargers(robot) for robot in self.robots]
        self.departures = cache(self._list_departures)
        self.way = cache(self._measure_way)
        self.ends = [len(job.stops) for job in self.jobs]
        self.times = [
            [
                (
                    ceil(stop.work / self.tick),
                    ceil(stop.earliest / self.tick),
                    inf if stop.latest is None else floor(stop.latest / self.tick),
                )
                for stop in job.stops
            ]
            for job in self.jobs
        ]
        dues = [floor(job.due / self.tick) for job in self.jobs if job.due is not None]
        of_stops = (time for times in self.times for stop in times for time in stop if time < inf)
        self.last_time = max([*self.ready, *dues, *of_stops]) + 1

    def find(self) -> Iterator[tuple[Fraction, Plan]]:
        """Yield the least service cost and a plan that has it, or nothing."""
        layer: Layer = {self._begin(): (Fraction(0), (None, ()))}
        seen: dict[Joint, Fraction] = {}
        best: tuple[Fraction, Story] | None = None
        for tick in range(self.horizon):
            layer = self._act_at_once(layer, tick)
            ends = [known for joint, known in layer.items() if self._is_end(joint)]
            best = min([*([best] if best else []), *ends], key=lambda known: known[0], default=None)
            layer = {
                joint: known
                for joint, known in layer.items()
                if (best is None or known[0] < best[0]) and self._is_new(joint, known, seen, tick)
            }
            layer = self._pass_ticks(layer, tick)
            if len(layer) > MOST_STATES:
                raise TooLarge(f"{len(layer)} joint states")
            if not layer:
                break
        else:
            raise TooLarge(f"{self.horizon} ticks")
        if best is not None:
            plan = self._tell(best[1])
            yield self._price(plan), plan

    def _is_new(
        self, joint: Joint, known: tuple[Fraction, Story], seen: dict[Joint, Fraction], tick: int
    ) -> bool:
        """Tell whether a state is cheaper than before, once no time of a job is left."""
        if tick < self.last_time:
            return True
        if joint in seen and seen[joint] <= known[0]:
            return False
        seen[joint] = known[0]
        return True

    def _pass_ticks(self, layer: Layer, tick: int) -> Layer:
        """Return the joint states a tick later, each at its least cost."""
        following: Layer = {}
        for joint, (cost, story) in layer.items():
            later = cost + self._accrue(joint, tick)
            for after, events in self._pass_tick(joint, tick):
                if after not in following or later < following[after][0]:
                    following[after] = later, (story, events)
        return following

    def _begin(self) -> Joint:
        bodies = []
        for robot in self.robots:
            state = self.fleet.state(robot)
            low = robot.battery is not None and state.soc < self._battery(robot.battery).reserve
            bodies.append(Body(int(state.at), -1, soc=state.soc, is_low=low))
        begun = [self.fleet.begun.get(job.name, (-1, 0)) for job in self.jobs]
        return Joint(tuple(bodies), tuple((count, robot) for robot, count in begun))

    def _battery(self, name: str | None) -> Battery:
        return self.batteries[name] if name is not None else Battery()

    def _accrue(self, joint: Joint, tick: int) -> Fraction:
        """Return what the jobs that are not ended cost in a tick."""
        cost = Fraction(0)
        for number, job in enumerate(self.jobs):
            if number not in self.unserved and not self._is_ended(joint, number):
                is_late = job.due is not None and tick >= floor(job.due / self.tick)
                cost += job.weight * (1 + (self.late if is_late else 0))
        return cost

    def _is_ended(self, joint: Joint, number: int) -> bool:
        return joint.jobs[number][0] == self.ends[number]

    def _is_end(self, joint: Joint) -> bool:
        return all(body.rests for body in joint.bodies) and all(
            self._is_ended(joint, number)
            for number in range(len(self.jobs))
            if number not in self.unserved
        )

    def _act_at_once(self, layer: Layer, tick: int) -> Layer:
        """Add the states after work that takes no time, and after decisions to rest."""
        found = dict(layer)
        queue = list(layer)
        for joint in queue:
            cost, story = found[joint]
            for index in range(len(self.robots)):
                for after, events in self._act(joint, index, tick):
                    if after not in found or cost < found[after][0]:
                        found[after] = cost, (story, events)
                        queue.append(after)
        return found

    def _act(
        self, joint: Joint, index: int, tick: int
    ) -> Iterator[tuple[Joint, tuple[Event, ...]]]:
        body = joint.bodies[index]
        if body.rests or body.left or tick < self.ready[index]:
            return
        if (tick == self.ready[index] or body.is_fresh) and self._may_rest(index, body):
            yield self._with(joint, index, body._replace(rests=True, is_fresh=False)), ()
        for number, stop, ticks in self._list_work(joint, index, tick):
            if not ticks:
                event = ("item", index, tick, tick, number, stop)
                after = body._replace(
                    has_worked=True, has_tour=True, is_fresh=True, is_charging=False, is_low=False
                )
                yield self._done(self._with(joint, index, after), index, number, stop), (event,)

    def _list_work(self, joint: Joint, index: int, tick: int) -> Iterator[tuple[int, int, int]]:
        """Yield the stops that a robot may begin now: job, stop, ticks."""
        body, robot = joint.bodies[index], self.robots[index]
        if not self._is_charged(robot, body):
            return
        taken = {body.work[0] for body in joint.bodies if body.work is not None} | self.unserved
        capacity = 1 if robot.capacity is None else robot.capacity
        for number, job in enumerate(self.jobs):
            stop, owner = joint.jobs[number]
            if number in taken or stop == self.ends[number] or owner not in {-1, index}:
                continue
            place, is_begun = job.stops[stop], job.name in self.fleet.begun
            ticks, earliest, latest = self.times[number][stop]
            if (
                body.vertex == place.at
                and self._may_do(index, number)
                and tick >= earliest
                and (is_begun or tick + ticks <= latest)
                and (is_begun or all(self._is_ended(joint, self.names[k]) for k in job.after))
                and 0 <= self._load(joint, index) + place.load <= capacity
            ):
                yield number, stop, ticks

    def _may_do(self, index: int, number: int) -> bool:
        job, robot = self.jobs[number], self.robots[index]
        return job.robot in {None, robot.name} and (not job.types or robot.type in job.types)

    def _load(self, joint: Joint, index: int) -> int:
        return sum(
            stop.load
            for job, (done, owner) in zip(self.jobs, joint.jobs, strict=True)
            if owner == index
            for stop in job.stops[:done]
        )

    def _is_charged(self, robot: Robot, body: Body) -> bool:
        """Tell whether a robot may end a charge, or begin work: it is not below its reserve."""
        return robot.battery is None or body.soc >= self._battery(robot.battery).reserve

    def _may_rest(self, index: int, body: Body) -> bool:
        robot = self.robots[index]
        if self.fleet.returns(robot) and body.vertex != robot.home:
            return False
        if robot.battery is None or not body.has_tour:
            return True
        left = body.soc - self.way(index, body.vertex)
        return left >= self._battery(robot.battery).reserve

    def _done(self, joint: Joint, index: int, number: int, stop: int) -> Joint:
        jobs = list(joint.jobs)
        jobs[number] = stop + 1, index
        return joint._replace(jobs=tuple(jobs))

    def _with(self, joint: Joint, index: int, body: Body) -> Joint:
        """Return the joint state with another state of a robot, without what does not matter."""
        if self.robots[index].battery is None:
            body = body._replace(is_fresh=True, has_tour=False)
        if not self.turns[index]:
            body = body._replace(before=-1)
        bodies = list(joint.bodies)
        bodies[index] = body
        return joint._replace(bodies=tuple(bodies))

    def _pass_tick(self, joint: Joint, tick: int) -> Iterator[tuple[Joint, tuple[Event, ...]]]:
        """Yield the joint states a tick later."""
        choices = [list(self._choose(joint, index, tick)) for index in range(len(self.robots))]
        for bodies in product(*choices):
            if self._collide(bodies) or self._share_a_stop(bodies):
                continue
            after, events = joint._replace(bodies=bodies), list[Event]()
            for index, body in enumerate(bodies):
                after, own = self._arrive(after, index, body, tick + 1)
                events += own
            vertices = {body.vertex for body in after.bodies}
            lives = all(self._lives(index, body) for index, body in enumerate(after.bodies))
            if lives and len(vertices) == len(bodies):
                yield after, tuple(events)

    def _share_a_stop(self, bodies: Sequence[Body]) -> bool:
        works = [body.work[0] for body in bodies if body.work is not None]
        return len(works) != len(set(works))

    def _choose(self, joint: Joint, index: int, tick: int) -> Iterator[Body]:
        """Yield what a robot may do in a tick, before the tick has passed."""
        body, robot = joint.bodies[index], self.robots[index]
        if body.rests or tick < self.ready[index]:
            yield body
            return
        if body.left:
            yield body
            return
        stays = body._replace(is_fresh=False, is_charging=False)
        ends_charge = not (body.is_charging and body.is_low) or self._is_charged(robot, body)
        is_low = body.is_low and not body.is_charging
        if ends_charge:
            yield stays._replace(is_low=is_low)
            drives = self.departures(index, body.before, body.vertex, body.has_worked)
            for head, left, drive in drives:
                yield stays._replace(target=head, left=left, drive=drive, is_low=is_low)
            for number, stop, ticks in self._list_work(joint, index, tick):
                if ticks:
                    yield stays._replace(
                        work=(number, stop),
                        left=ticks,
                        has_worked=True,
                        has_tour=True,
                        is_low=False,
                    )
        if robot.battery is not None and body.vertex in self.chargers[index]:
            yield body._replace(is_charging=True, has_worked=True, has_tour=True, left=0)

    def _list_departures(
        self, index: int, before: int, vertex: int, has_worked: bool
    ) -> list[tuple[int, int, int]]:
        """Return where a robot may drive: the vertex, the ticks with all turns, and without."""
        robot, departures = self.robots[index], list[tuple[int, int, int]]()
        turn = self.fleet.stop_turn(robot) if has_worked else 0
        for tail, head in self.fleet.site.edges:
            drive = self.fleet.site.drive(robot, (tail, head)) if tail == vertex else None
            if drive is not None:
                corner = self.fleet.corner(robot, Own([tail, head], [0, 0], ()), 0)
                if before >= 0:
                    corner = self.fleet.site.turn(robot, before, tail, head)
                departures.append((head, turn + corner + drive, drive))
        return departures

    def _measure_way(self, index: int, vertex: int) -> Fraction | float:
        """Return the least share for a drive to a charging place."""
        robot = self.robots[index]
        own = Own([vertex], [0], ())
        return way_to_charger(self.fleet, robot, self._battery(robot.battery), own)

    def _arrive(self, joint: Joint, index: int, body: Body, now: int) -> tuple[Joint, list[Event]]:
        """Return the joint state after a tick of one robot, and what has happened."""
        robot = self.robots[index]
        if body.rests or now <= self.ready[index]:
            return joint, []
        battery, events = self._battery(robot.battery), list[Event]()
        if body.is_charging:
            soc = min(Fraction(1), body.soc + battery.charge * self.tick)
            events.append(("item", index, now - 1, now, -1, -1))
            return self._with(joint, index, body._replace(soc=soc, is_fresh=True)), events
        use = battery.on + (battery.work if body.work is not None else 0)
        soc = body.soc - use * self.tick if robot.battery is not None else body.soc
        body = body._replace(soc=soc, left=max(0, body.left - 1), is_fresh=False)
        if body.left or (body.target < 0 and body.work is None):
            return self._with(joint, index, body), events
        if body.work is not None:
            number, stop = body.work
            ticks = self.times[number][stop][0]
            events.append(("item", index, now - ticks, now, number, stop))
            after = self._with(joint, index, body._replace(work=None, is_fresh=True))
            return self._done(after, index, number, stop), events
        if robot.battery is not None:
            edge = self.fleet.site.edges[body.vertex, body.target]
            soc -= battery.drive * edge.length
        events.append(("enter", index, body.target, now, 0, 0))
        moved = body._replace(
            vertex=body.target,
            before=body.vertex,
            target=-1,
            drive=0,
            has_worked=False,
            soc=soc,
            is_fresh=True,
        )
        return self._with(joint, index, moved), events

    def _lives(self, index: int, body: Body) -> bool:
        """Tell whether the battery of a robot is not too low."""
        robot = self.robots[index]
        if robot.battery is None or body.rests:
            return True
        return body.soc >= (0 if body.is_low else self._battery(robot.battery).reserve)

    def _collide(self, bodies: Sequence[Body]) -> bool:
        """Tell whether bookings of a tick overlap, or robots exchange their vertices after it."""
        booked = [self._book(body) for body in bodies]
        if any(one & other for one, other in combinations(booked, 2)):
            return True
        moves = {body.vertex: body.target for body in bodies if body.target >= 0 and body.left == 1}
        circles = any(moves.get(head) == tail for tail, head in moves.items())
        return circles or (not self.rotations and _has_circle(moves))

    def _book(self, body: Body) -> set[int]:
        if self.is_both and body.target >= 0 and body.left <= body.drive:
            return {body.vertex, body.target}
        return {body.vertex}

    def _tell(self, story: Story) -> Plan:
        """Return the plan of what has happened."""
        parts = list[tuple[Event, ...]]()
        step: Story | None = story
        while step is not None:
            step, events = step
            parts.append(events)
        vertices = [[int(self.fleet.state(robot).at)] for robot in self.robots]
        enter = [[0] for _ in self.robots]
        tours: list[list[PlannedItem]] = [[] for _ in self.robots]
        for kind, robot, *values in chain.from_iterable(reversed(parts)):
            if kind == "enter":
                vertices[robot].append(values[0])
                enter[robot].append(values[1])
                continue
            begin, end, job, stop = values
            visit, tour = len(enter[robot]) - 1, tours[robot]
            if job < 0 and tour and tour[-1].job is None and tour[-1].end == begin:
                begin = tour.pop().begin  # the same charge
            tour.append(
                PlannedItem(
                    visit=visit,
                    begin=Tick(begin),
                    end=Tick(end),
                    job=None if job < 0 else job,
                    stop=None if job < 0 else stop,
                )
            )
        return Plan(
            scenario=self.fleet.scenario,
            tracks=tuple(map(Track.of, vertices, enter)),
            run=PlannerRun(name="exhaustive"),
            tours=tuple(map(tuple, tours)),
            unserved=tuple((job, "not found") for job in sorted(self.unserved)),
        )

    def _price(self, plan: Plan) -> Fraction:
        assert plan.tours is not None, "it has tours"
        cost = Fraction(0)
        for number, job in enumerate(self.jobs):
            if number not in self.unserved:
                items = (item for tour in plan.tours for item in tour if item.job == number)
                end = max(item.end for item in items)
                cost += job.weight * price(self.fleet, job, end, self.late)
        return cost


def _has_circle(moves: dict[int, int]) -> bool:
    for first, head in moves.items():
        at, steps = head, 0
        while at in moves and at != first and steps < len(moves):
            at, steps = moves[at], steps + 1
        if at == first:
            return True
    return False
