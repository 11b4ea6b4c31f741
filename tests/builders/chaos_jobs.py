"""Chaos with jobs: they arrive, change and are withdrawn; batteries run down; places close.

Besides bookings, an observer counts stops: each is done once, in the order of its job and by one
robot, and none of a withdrawn job. A job that nobody does has a sentence that gives the reason.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache, partial
from typing import Any
from unittest.mock import patch

import rightofway
from rightofway.control import Condition, FleetControl, Message, RobotLedger, SimulatedRobot
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.identities import make_simulated_identities
from rightofway.control.joins import Joins, grow_plan
from rightofway.control.notices import Notices
from rightofway.control.operator import Operator
from rightofway.control.round_worker import RoundRequest, RoundsAtOnce
from rightofway.control.stop_actions import split_action
from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.dispatch import Round
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.model import NEVER, Plan, Scenario
from rightofway.precedence import Part
from tests.builders.chaos import Chaos, Fault, Killed, Observer, World, list_several

__all__ = ["JOB_KINDS", "plan_with_jobs", "run_job_chaos"]

JOB_KINDS = {
    "arrive": Chaos(kills=0.0, jobs=0.03),
    "arrive, killed": Chaos(kills=0.03, jobs=0.03),
    "arrive, resets": Chaos(kills=0.01, resets=0.02, jobs=0.03),
    "arrive, cancels": Chaos(kills=0.01, cancels=0.02, jobs=0.02),
    "arrive, wrong fields": Chaos(wrong=0.1, jobs=0.02),
    "arrive, people": Chaos(people=0.03, jobs=0.02),
    "arrive, all": Chaos(people=0.02, kills=0.03, resets=0.01, wrong=0.05, cancels=0.01, jobs=0.03),
    "arrive, joins": Chaos(people=0.01, kills=0.02, resets=0.01, jobs=0.02, joins=0.01),
    "floor": Chaos(kills=0.0, jobs=0.02, floor=True),
    "floor, all": Chaos(
        people=0.02, kills=0.03, resets=0.01, wrong=0.05, cancels=0.01, jobs=0.03, floor=True
    ),
    "floor, joins": Chaos(
        people=0.01, kills=0.02, resets=0.01, cancels=0.01, jobs=0.02, joins=0.01, floor=True
    ),
}
"""Kinds of chaos with jobs by name."""

EVENTS_PER_TICK = 10

MOST_STILL = 2_000
"""Events without faults after which rounds that find no plan will find none."""

MOST_JOINED = 3
"""Robots that join in a run, at most."""

CHARGED_PER_EVENT = 0.01
"""How much a robot at a charging place charges in an event; 1 is full."""


@lru_cache(maxsize=4)
def plan_with_jobs(seed: int, *, floor: bool = False) -> Plan:
    """Return a plan of robots with batteries and jobs, of the first draw that has one.

    With ``floor`` it has the features of `Chaos.floor`.
    """
    draw = random.Random(f"jobs {seed}")  # noqa: S311
    while True:
        rows, columns = draw.choice([(3, 4), (4, 4), (3, 5)])
        cells = ["".join(draw.choice("....@") for _ in range(columns)) for _ in range(rows)]
        free = [f"N{k}" for k, cell in enumerate("".join(cells)) if cell == "."]
        count = draw.randint(2, 4)
        if len(free) < 2 * count + 3:
            continue
        homes = draw.sample(free, count)
        document = {
            "format": "rightofway-scenario/1",
            "map": {"grid": cells},
            "rules": {"rotations": False, "turn": draw.choice([0, 1])},
            "batteries": {"cell": {"drive": "1/100", "charge": "1/10", "reserve": "1/10"}},
            "charging": homes,
            "robots": [
                {
                    "name": f"R{number}",
                    "home": home,
                    "capacity": draw.choice([1, 1, 2]),
                    "battery": "cell",
                    "start": {"at": home, "soc": draw.choice([1, 1, 0.4])},
                }
                for number, home in enumerate(homes)
            ],
            "jobs": [draw_job(draw, free, f"J{number}") for number in range(draw.randint(1, 4))],
        }
        if floor:
            _add_floor(draw, document, cells)
        try:
            return rightofway.solve(parse_scenario(document), "prioritized")
        except (NoPlanExists, GaveUp, InputError):
            continue


def _add_floor(draw: random.Random, document: dict[str, Any], cells: list[str]) -> None:
    """Replace the grid of a document by a roadmap, with turn rates and closures.

    Robots do not stop at vertices without homes and jobs, every third of them.
    """
    columns, free = len(cells[0]), [k for k, cell in enumerate("".join(cells)) if cell == "."]
    needed = {robot["home"] for robot in document["robots"]}
    needed |= {job[key] for job in document["jobs"] for key in job if key in JOB_PLACES}
    vertices: dict[str, Any] = {}
    for k in free:
        at = [k % columns, k // columns]
        is_passed = f"N{k}" not in needed and draw.random() < 1 / 3
        vertices[f"N{k}"] = {"at": at, "pass": True} if is_passed else at
    edges = [
        [f"N{k}", f"N{other}"]
        for k in free
        for other in (k + 1, k + columns)
        if other in free and (other > k + 1 or other % columns or columns == 1)
    ]
    document["map"] = {"roadmap": {"vertices": vertices, "edges": edges}}
    for robot in document["robots"]:
        if draw.random() < 2 / 3:
            robot["turn_rate"] = draw.choice([30, 45, 90])
            robot["start"]["heading"] = draw.choice([0, 90, 180, 270])
    document["closures"] = []
    for _ in range(draw.randint(0, 2)):
        begin = draw.randint(0, 60)
        where = (
            {"edge": draw.choice(edges)}
            if edges and draw.random() < 0.5
            else {"at": f"N{draw.choice(free)}"}
        )
        until = {"until": begin + draw.randint(1, 60)} if draw.random() < 0.8 else {}
        document["closures"].append({"from": begin, **until, **where})


JOB_PLACES = ("at", "pickup", "dropoff")
"""Keys of a job that name a place."""


def draw_job(draw: random.Random, places: list[str], name: str) -> dict[str, Any]:
    """Draw a job: one stop, or a load from one place to another, perhaps with times."""
    job: dict[str, Any] = {"name": name}
    if draw.random() < 0.4:
        job |= {"at": draw.choice(places), "work": draw.randint(0, 3)}
    else:
        job |= {"pickup": draw.choice(places), "dropoff": draw.choice(places)}
    if draw.random() < 0.3:
        job["earliest"] = draw.randint(0, 20)
    if draw.random() < 0.3:
        job["due"] = draw.randint(0, 40)
    return job


def run_job_chaos(
    seed: int, chaos: Chaos, control: type[FleetControl] = FleetControl
) -> Counter[str]:
    """Drive a plan with jobs through chaos; return what happened.

    Raises
    ------
    Fault
        At the first booking held twice, contradiction, stop done twice, too early or never, or run
        that stands without a reason.
    """
    world = JobWorld(plan_with_jobs(seed, floor=chaos.floor), seed, chaos, control)
    world.run()
    world.counts["jobs done"] = sum(
        left == "done" for left in world.control.ledger.pool.left.values()
    )
    world.counts["jobs left"] = len(world.control.ledger.pool.jobs)
    return world.counts


class LateRounds(RoundsAtOnce):
    """Rounds whose plans come late: meanwhile robots drive, and people ask for more."""

    def __init__(self, draw: random.Random) -> None:
        super().__init__(None, "prioritized")
        self._draw, self._polls = draw, 0

    def begin(self, request: RoundRequest) -> None:
        """Plan a round; its plan comes after some more messages."""
        with patch("rightofway.dispatch.routes.PATIENCE", 1):  # how good a plan is, is no matter
            super().begin(request)
        self._polls = self._draw.choice([0, 3, 30, 100])

    def poll(self) -> Round | None:
        """Return the plan of the round that was begun, once, when its time has come."""
        self._polls -= 1
        return super().poll() if self._polls < 0 else None


class JobWorld(World):
    """A control of a plan with jobs, its robots and their network."""

    observer: JobObserver

    def __init__(self, plan: Plan, seed: int, chaos: Chaos, control: type[FleetControl]) -> None:
        self.events, self.said, self.number = 0, set[str](), 0
        self.stood: tuple[object, int] = None, 0
        self.socs = [
            1.0 if robot.start is None else float(robot.start.soc) for robot in plan.scenario.robots
        ]
        self.given = plan  # without the robots that join
        super().__init__(plan, seed, chaos, control)
        self.observer = JobObserver(plan.scenario, self.robots)
        self.observer.is_shut_out = self._is_shut_out

    def _begin(self) -> None:
        while True:
            try:
                control = self.kind(
                    self.journal,
                    look_ahead=self.chaos.look_ahead,
                    snapshot_every=200,
                    long_order=2,
                    roadmap=self.scenario.roadmap,
                )
                if self.chaos.floor:  # robots report any heading
                    turned = (Fraction(self.draw.randrange(0, 360, 45)) for _ in self.robots)
                    control.headings.update(enumerate(turned))
                if control.ledger.grows:
                    control.commit({"kind": "fleet grown"})
                self._grow(control)
                rounds = LateRounds(self.draw)
                dispatcher = Dispatcher(control, self.plan, rounds=rounds, patience=2)
                if self.several:
                    control.list_actions = list_several
                dispatcher.keep_time(lambda: self.events // EVENTS_PER_TICK)
                dispatcher.report = self._note
                assert dispatcher.rounds is not None
                dispatcher.rounds.tell = lambda fact: self._note(fact, False)
                if not self.journal.written:
                    dispatcher.begin("run")
                self.control, self.dispatcher = control, dispatcher
                self.rounds = dispatcher.rounds
                names = [robot.name for robot in self.given.scenario.robots]
                self.joins = Joins(self.given, make_simulated_identities(names), dispatcher)
                self.notices = Notices([*control.ledger.names], lambda _: None)
                self.operator = Operator(dispatcher, self.joins)
                self.send(control.start())
            except Killed:
                self.counts["kills"] += 1
            else:
                return

    def _grow(self, control: FleetControl) -> None:
        """Have the robots that have joined; some are not at their places yet."""
        ledger = control.ledger
        self.plan = grow_plan(self.given, ledger.joined.values())
        self.scenario = self.plan.scenario
        for own in ledger.robots[len(self.robots) :]:
            anywhere = self.scenario.roadmap.name(self.draw.randrange(self._n_vertices))
            place = own.route.places[0] if self._chance(0.7) else anywhere
            self.robots.append(SimulatedRobot(place))
            self.orders.append([])
            self.conditions.append(Condition())
            self.socs.append(1.0)
            self.observer.add_robot(self.scenario)

    @property
    def _n_vertices(self) -> int:
        return self.scenario.roadmap.n_vertices

    def _join(self) -> list[Message]:
        """Ask for a robot to join, or for another place of one that has not been placed."""
        draw, ledger, roadmap = self.draw, self.control.ledger, self.scenario.roadmap
        number = len(ledger.joined) - (draw.random() < 0.2)
        if not 0 <= number < MOST_JOINED:
            return []
        places = [roadmap.name(draw.randrange(self._n_vertices)) for _ in range(2)]
        keys: dict[str, Any] = {"speed": draw.choice([1, 2, "1/2"])}
        if draw.random() < 0.2:
            keys["home"] = places[1]
        command = {
            "kind": "join", "name": f"X{number}", "serial": f"serial{number}", "at": places[0],
            "like": draw.choice(ledger.names), "set": keys,
        }  # fmt: skip
        try:
            messages, _ = self.operator._run_command(command)
        except (GaveUp, InputError) as error:
            self.counts["not joined"] += 1
            self.said.add(str(error))
            return []
        self.counts["joins"] += 1
        return messages

    def _move_to_join(self) -> None:
        """Have robots that join come to their places."""
        ledger = self.control.ledger
        for name in sorted(ledger.joining):
            robot = self.robots[ledger.names.index(name)]
            if self.is_calm or self._chance(0.1):
                robot.place = ledger.joined[name]["at"]

    def _note(self, fact: Fact | None, is_over: bool) -> None:
        if fact is not None and not is_over:
            name = fact.values.get("job", fact.kind)
            self.said.add(str(name))
            reason = fact.values.get("reason")
            if "released (" in str(reason):
                raise Fault(str(reason))
            self.counts[f"{fact.kind}: {reason}" if reason else fact.kind] += 1

    def _event(self) -> None:
        self.events += 1
        for robot in range(len(self.robots)):
            if self.observer.is_charging(robot):
                self.socs[robot] = min(1.0, self.socs[robot] + CHARGED_PER_EVENT)
        super()._event()
        if self.chaos.joins and self._happens(self.chaos.joins):
            self.call(self._join)
        if self.control.ledger.grows:
            self._begin()
        if self.events % EVENTS_PER_TICK == 0:
            self._tell(self.draw.randrange(len(self.robots)))
            self._move_to_join()
            self.call(self._take_turn)

    def _take_turn(self) -> list[Message]:
        before = self.rounds._count
        messages = [*self.dispatcher.follow_time(), *self.dispatcher.pass_stuck()]
        self.counts["rounds"] += self.rounds._count - before
        joining = len(self.control.ledger.joining)
        messages += self.joins.look(self.notices)
        self.counts["placed after a join"] += joining - len(self.control.ledger.joining)
        return messages

    def _step(self, robot: int) -> None:
        real = self.robots[robot]
        if real.next_step == "arrive":
            self.socs[robot] = max(0.0, self.socs[robot] - 0.01)
        super()._step(robot)

    def _report(self, robot: int) -> Any:
        state = super()._report(robot)
        return replace(state, charge=self.socs[robot])

    def _change_work(self) -> list[Message]:
        """Add, change or withdraw a job; close or open a place."""
        draw, operator, roadmap = self.draw, self.operator, self.scenario.roadmap
        places = list(map(roadmap.name, range(roadmap.n_vertices)))
        ledger = self.control.ledger
        kind = draw.choice(["add", "add", "change", "withdraw", "close", "open"])
        command: dict[str, Any] = {"kind": kind}
        if kind == "add":
            self.number += draw.random() < 0.9  # else a job is asked for again
            command |= draw_job(draw, places, f"A{self.number}")
            if ledger.pool.jobs and draw.random() < 0.2:
                command["after"] = [draw.choice([*ledger.pool.jobs])]
            command["urgent"] = draw.random() < 0.2
        elif kind in {"close", "open"}:
            names = self._any_place(draw.choice(places))
            if kind == "open" and ledger.closed:
                names = draw.choice(sorted(ledger.closed))
            command |= {"name": names[0]} | ({"to": names[-1]} if len(names) > 1 else {})
        else:
            command["name"] = draw.choice([*ledger.pool.jobs] or ["none"])
            command |= {"at": draw.choice(places)} if kind == "change" else {}
        try:
            messages, _ = operator._run_command(command)
        except (GaveUp, InputError):
            self.counts[f"not {kind}"] += 1
            return []
        self.counts[kind] += 1
        return messages

    def _decide(self, robot: int) -> None:
        """Have failed work of a robot done again, or skip its job."""
        name = self.control.ledger.names[robot]
        for item in sorted(self.control.ledger.robots[robot].failed):
            stop = find_stop(item)
            kind = "again" if stop is None or self._chance(0.6) else "skip"
            named = stop[0] if stop else f"{name}/{item}"
            self.call(partial(self._ask_for, kind, named))

    def _ask_for(self, kind: str, name: str) -> list[Message]:
        try:
            return self.operator._run_command({"kind": kind, "name": name})[0]
        except InputError:  # another command came first
            return []

    def _stand(self) -> list[str]:
        """Return where each robot stands, and which jobs are left."""
        pool = self.control.ledger.pool
        jobs = [
            f"{name}: {own.robot} {own.begun}/{own.done} after {own.job.after}"
            for name, own in pool.jobs.items()
        ]
        rounds = self.rounds
        more = f"{rounds.reasons} {rounds.is_wanted} {rounds.is_under_way} {rounds.watch.unable}"
        flags = f"{self.control.stranded} {self.control.list_stuck()} {self.socs}"
        return [*super()._stand(), *jobs, str(sorted(self.said)), more, flags]

    def _is_done(self) -> bool:
        """Whether all has been done, or said why not."""
        ledger = self.control.ledger
        return (
            (
                all(own.is_done or own.is_off for own in ledger.robots)
                and not any(own.is_begun for own in ledger.pool.jobs.values())
                and not self.rounds.is_under_way
                and len(waiting := self.rounds.watch.list_waiting()) == len(ledger.pool.jobs)
                and self.said.issuperset(waiting)
            )
            or self._stands_told()
            or all(own.is_off and self._has_no_place(k) for k, own in enumerate(ledger.robots))
        )

    def _is_shut_out(self, robot: int) -> bool:
        """Whether a closure for good stops a robot, or one that goes first, as was reported."""
        ledger, part = self.control.ledger, self.control.ledger.robots[robot].released + 1
        closed = self.dispatcher.find_closed(robot, part)
        missing = ledger.graph.list_missing(Part(robot, part), ledger.arrived)
        is_shut = (closed is not None and closed.end == NEVER) or any(
            self._is_shut_out(arrival.robot) for arrival in missing
        )
        return self.dispatcher._has_failed and is_shut

    def _stands_told(self) -> bool:
        """Whether rounds find no plan, and this was said, in many tries."""
        robots = self.control.ledger.robots
        where = [(own.arrived, own.released, len(own.finished)) for own in robots]
        if not self.dispatcher._has_failed or where != self.stood[0]:
            self.stood = where, self.events
        is_long = self.events - self.stood[1] > MOST_STILL
        self.counts["stands, and says why"] += is_long
        return is_long


class JobObserver(Observer):
    """Looks at robots, jobs and journal from outside."""

    def __init__(self, scenario: Scenario, robots: Any) -> None:
        super().__init__(scenario, robots)
        self.counted: list[Counter[str]] = [Counter() for _ in robots]
        self.charges = [False] * len(robots)  # whether the last charge of each has not ended
        self.stops: dict[str, list[tuple[int, int]]] = {}  # of each job, robot and stop as done
        self.known = set[str]()
        self.before: dict[str, tuple[str, ...]] = {}  # jobs that end before each job
        self.lengths: dict[str, int] = {}  # stops of each job
        self.over = set[str]()  # jobs that had left without being begun
        self.steps: list[dict[str, set[int]]] = [{} for _ in robots]  # of each item, as done
        self.is_shut_out: Callable[[int], bool] = lambda _: False

    def add_robot(self, scenario: Scenario) -> None:
        """Look at one robot more, which has joined."""
        super().add_robot(scenario)
        self.counted.append(Counter())
        self.charges.append(False)
        self.steps.append({})

    def is_charging(self, robot: int) -> bool:
        """Return whether the last charge of a robot has begun, and it has not driven on."""
        return self.charges[robot] and not self.robots[robot].is_driving

    def look(self, control: FleetControl) -> None:
        """Compare what robots hold, and what they have done."""
        super().look(control)
        pool = control.ledger.pool
        names = {*pool.jobs, *pool.left}
        if not self.known <= names:
            raise Fault(f"jobs are lost: {sorted(self.known - names)}")
        self.known = names
        self.before |= {name: own.job.after for name, own in pool.jobs.items()}
        self.lengths |= {name: len(own.job.stops) for name, own in pool.jobs.items()}
        self.over |= {
            name for name, left in pool.left.items() if left != "done" and name not in self.stops
        }

    def _look_at_jobs(self, robot: int, own: RobotLedger) -> None:
        self._job_of[robot] |= own.jobs_of
        real, counted = self.robots[robot], self.counted[robot]
        for action, count in real.done.items():
            if counted[action] == count:
                continue
            counted[action] = count
            item = self._job_of[robot].get(action, "")
            if count > 1:
                raise Fault(f"robot {robot} has done {item} {count} times")
            if stop := find_stop(item):
                if self._is_stop_done(robot, action, item):
                    self._count_stop(robot, *stop)
            elif charge_step := find_charge_step(item):
                self.charges[robot] = charge_step == "begin"

    def _is_stop_done(self, robot: int, action: str, item: str) -> bool:
        """Return whether an action that was done is the last one of its stop."""
        step, done = split_action(action)[1], self.steps[robot].setdefault(item, set())
        if step in done:
            raise Fault(f"robot {robot} has done action {step} of {item} twice")
        done.add(step)
        ids = [own for own, job in self._job_of[robot].items() if job == item]
        return len(done) == len({split_action(own)[1] for own in ids})

    def _count_stop(self, robot: int, name: str, stop: int) -> None:
        done = self.stops.setdefault(name, [])
        if name in self.over:
            raise Fault(f"robot {robot} has done stop {stop} of {name}, which was given up")
        if stop != len(done) or any(other != robot for other, _ in done):
            raise Fault(f"robot {robot} has done stop {stop} of {name} after {done}")
        for before in self.before.get(name, ()):
            if before not in self.over and len(self.stops.get(before, ())) < self.lengths[before]:
                raise Fault(f"robot {robot} has begun {name} before the end of {before}")
        done.append((robot, stop))

    def look_at_the_end(self, control: FleetControl, *, is_endless: bool) -> None:
        """Tell whether each job was done exactly once, and each robot is at its end."""
        assert not is_endless
        for robot, own in enumerate(control.ledger.robots):
            self._look_at_jobs(robot, own)
            is_there = self.robots[robot].place == own.route.places[-1]
            if not (own.is_off or is_there or self.is_shut_out(robot)):
                raise Fault(f"robot {robot} ends at {self.robots[robot].place}")
        for name, left in control.ledger.pool.left.items():
            if left == "done" and not self.stops.get(name):
                raise Fault(f"{name} counts as done, and nobody has done it")
