"""Chaos by seed: a control, simulated robots, and a network that loses, doubles and delays.

An observer looks at robots and journal after each event, with the definition of incompatible
resources, and ends a run at the first fault. The control is killed at any instant, before or after
a commit, and starts again on its journal, perhaps with another plan of the rest.
"""

from __future__ import annotations

import json
import random
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, lru_cache, partial
from itertools import pairwise
from typing import Any

import rightofway
from rightofway.control import (
    Condition,
    Entry,
    FleetControl,
    InstantAction,
    Message,
    Order,
    RobotError,
    RobotLedger,
    RouteToDrive,
    SimulatedRobot,
    StateReport,
)
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.fleet_control import LONG_ORDER
from rightofway.control.laps import LapsToDrive
from rightofway.control.operator import Operator
from rightofway.control.stop_actions import ActionToDo, split_action
from rightofway.control.work_items import find_charge_step
from rightofway.cyclic import make_excerpt, plan_of_laps, run_laps
from rightofway.cyclic.result import CyclicResult
from rightofway.errors import GaveUp, InputError, NoPlanExists
from rightofway.model import Plan, Rules, Scenario, Stop, StopAction
from rightofway.model.steady_state import keep_within
from rightofway.precedence import Arrival, Part, ReleaseGraph
from tests.builders.fleets import random_fleet
from tests.oracles.space import Shape, incompatible, zones_of

__all__ = [
    "KINDS",
    "Chaos",
    "Fault",
    "Killed",
    "MemoryJournal",
    "Observer",
    "World",
    "another_plan",
    "chaotic_plan",
    "knows",
    "laps_plan",
    "run_chaos",
]


class Fault(AssertionError):
    """What the observer has found."""


class Killed(Exception):
    """The process of the control ends here."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Chaos:
    """How much goes wrong.

    Attributes
    ----------
    events
        Events with faults; afterwards nothing is lost and nobody is killed.
    lost, doubled
        Shares of messages.
    kills
        Share of events at which the control is killed, and as many of commits.
    resets
        Share of events at which a robot forgets its order.
    wrong
        Share of states with one wrong field.
    cancels
        Share of events at which a robot's order is withdrawn.
    splices
        Share of starts with another plan of the rest.
    look_ahead
        Of the control.
    jobs
        Share of events at which a job is added, changed or withdrawn, or a place is closed or
        opened, and the rest replanned.
    laps
        How many laps each robot makes after the faults; 0 where the plan is driven once.
    people
        Share of events at which a robot gets unfit or fit again, or a person holds it, decides on
        failed work, or puts it elsewhere; eight times as often work fails. Others pass it.
    shuffles
        Whether orders lose their order, too. No rule keeps robots safe where they are also reset.
    works_at_home
        Whether every second robot works at its home before it sets out.
    floor
        Whether plans with jobs have vertices that are driven through only, robots that turn slowly,
        and closures that begin and end by the clock.
    joins
        Share of events at which a robot joins that no plan has. It says truly where it is.
    """

    events: int = 500
    lost: float = 0.3
    doubled: float = 0.2
    kills: float = 0.01
    resets: float = 0.0
    wrong: float = 0.0
    cancels: float = 0.0
    splices: float = 0.5
    look_ahead: int = 4
    jobs: float = 0.0
    laps: int = 0
    people: float = 0.0
    shuffles: bool = False
    works_at_home: bool = False
    floor: bool = False
    joins: float = 0.0


KINDS = {
    "plain": Chaos(kills=0.0),
    "killed": Chaos(),
    "killed often": Chaos(kills=0.08, splices=1.0),
    "lost": Chaos(lost=0.5),
    "ahead": Chaos(look_ahead=10**6),
    "one ahead": Chaos(look_ahead=1),
    "resets": Chaos(resets=0.02),
    "cancels": Chaos(cancels=0.03),
    "cancels and resets": Chaos(cancels=0.02, resets=0.02),
    "resets, replanned": Chaos(resets=0.03, kills=0.03, splices=1.0, lost=0.5),
    "orders out of order": Chaos(shuffles=True, kills=0.02),
    "wrong fields": Chaos(wrong=0.2),
    "wrong fields and resets": Chaos(wrong=0.3, resets=0.04),
    "wrong fields and many resets": Chaos(wrong=0.5, resets=0.1, lost=0.1, doubled=0.5),
    "wrong fields, replanned": Chaos(wrong=0.3, kills=0.03, splices=1.0, lost=0.5),
    "all": Chaos(kills=0.03, resets=0.01, wrong=0.1, cancels=0.02, splices=1.0),
    "jobs": Chaos(jobs=0.03),
    "jobs, all": Chaos(kills=0.03, resets=0.01, wrong=0.1, cancels=0.02, jobs=0.03),
    "jobs in laps": Chaos(jobs=0.02, laps=2),
    "laps": Chaos(laps=2, splices=0.0),
    "laps, replanned": Chaos(laps=2, kills=0.02, splices=0.5),
    "laps, all": Chaos(laps=2, kills=0.03, resets=0.01, wrong=0.1, cancels=0.02),
    "people": Chaos(people=0.04),
    "people, all": Chaos(people=0.04, kills=0.03, resets=0.01, wrong=0.1, cancels=0.01, jobs=0.02),
    "people in laps": Chaos(people=0.04, laps=2, jobs=0.01, works_at_home=True),
}
"""Kinds of chaos by name."""

CALM = 20_000
"""Events without faults after which a run counts as stuck."""


def chaotic_plan(seed: int, kind: str = "plain") -> Plan:
    """Return a plan of two to five robots on a random grid, of the first seed that has one.

    For laps it is repeated as a whole, or one of a rule of laps with a steady state.
    """
    draw = random.Random(seed)  # noqa: S311
    while True:
        rules = Rules(rotations=False)
        number, size, robots = draw.getrandbits(32), draw.choice([4, 5]), draw.randint(2, 5)
        fleet = random_fleet(number, size=size, robots=robots, rules=rules, apart=True)
        if KINDS[kind].works_at_home:
            fleet = with_work_at_home(fleet)
        try:
            if KINDS[kind].laps and draw.random() < 0.7:
                return laps_plan(fleet)
            return rightofway.solve(fleet, "prioritized")
        except (NoPlanExists, GaveUp, InputError):
            continue


def with_work_at_home(fleet: Scenario) -> Scenario:
    """Return a fleet of which every second robot works at its home before it sets out."""
    robots = [
        replace(robot, stops=(Stop(at=robot.home, work=Fraction(2)), *robot.stops))
        if number % 2 == 0
        else robot
        for number, robot in enumerate(fleet.robots)
    ]
    return replace(fleet, robots=tuple(robots))


def first_come(fleet: Scenario) -> CyclicResult:
    """Return the laps of the rule first-come."""
    return run_laps(fleet, "first-come", time_limit=None)


def knows(kind: str, plan: Plan) -> bool:
    """Tell whether a plan can be driven in a kind of chaos: laps need robots that return home."""
    if not KINDS[kind].laps:
        return True
    try:
        LapsToDrive(plan)
    except InputError:
        return False
    return True


def laps_plan(fleet: Scenario, maker: Callable[[Scenario], CyclicResult] = first_come) -> Plan:
    """Return whole laps, with their steady state.

    Raises
    ------
    GaveUp, InputError
        If robots end in a deadlock, or one at home is in the way of others.
    """
    result = maker(fleet)
    if any(group.ends != "repeats" for group in result.groups):
        raise GaveUp("robots wait for each other")
    plan, steady = plan_of_laps(result), make_excerpt(result)[1]
    plan = replace(plan, steady=keep_within(steady, list(map(len, plan.tracks))))
    LapsToDrive(plan)
    return plan


class MemoryJournal:
    """A journal for simulated kills: what was committed is what is there."""

    def __init__(self) -> None:
        self.written: list[Entry] = []
        self.kill: Callable[[], bool] = lambda: False

    def read_entries(self) -> Iterable[Entry]:
        """Return all entries."""
        return list(self.written)

    def commit(self, entries: Iterable[Entry]) -> None:
        """Append entries; the process may end before or after."""
        if self.kill():
            raise Killed
        self.written += entries
        if self.kill():
            raise Killed

    def begin_again(self, snapshot: Entry) -> None:
        """Keep a snapshot only; the process may end before or after."""
        if self.kill():
            raise Killed
        self.written = [json.loads(json.dumps(snapshot))]
        if self.kill():
            raise Killed


def run_chaos(
    plan: Plan,
    seed: int,
    chaos: Chaos,
    control: type[FleetControl] = FleetControl,
) -> Counter[str]:
    """Drive a plan through chaos; return what happened.

    Raises
    ------
    Fault
        At the first booking held twice, contradiction, job done twice or lost, or stuck run.
    """
    world = World(plan, seed, chaos, control)
    world.run()
    return world.counts


def list_several(_robot: int, _place: str, item: str) -> tuple[ActionToDo, ...]:
    """Return three actions for each stop, and one for each step of a charge."""
    if find_charge_step(item) is not None:
        return (ActionToDo(),)
    return tuple(ActionToDo(action=StopAction(action=name)) for name in ("lower", "scan", "lift"))


class World:
    """A control, its robots and their network.

    Attributes
    ----------
    counts
        How often everything has happened.
    """

    def __init__(self, plan: Plan, seed: int, chaos: Chaos, control: type[FleetControl]) -> None:
        self.plan, self.chaos, self.kind = plan, chaos, control
        self.draw = random.Random(seed)  # noqa: S311
        self.counts = Counter[str]()
        self.several = seed % 3 == 0  # whether stops have several actions
        self.scenario = plan.scenario
        self.robots = [
            SimulatedRobot(plan.scenario.roadmap.name(int(track.vertices[0])))
            for track in plan.tracks
        ]
        self.orders: list[list[Order]] = [[] for _ in self.robots]  # in order per robot
        self.states: list[tuple[int, StateReport]] = []  # in any order
        self.actions: list[InstantAction] = []  # in any order
        self.journal = MemoryJournal()
        self.journal.kill = lambda: self._happens(self.chaos.kills / 4)
        self.laps = LapsToDrive(plan) if chaos.laps else None
        self.is_calm = False
        self.refused: dict[int, set[str]] = {}  # vertices at which a robot could not be put
        self.conditions = [Condition() for _ in self.robots]
        self.observer = Observer(plan.scenario, self.robots)
        self._begin()

    # --- the process of the control ---------------------------------------------------------------

    def _begin(self) -> None:
        while True:
            try:
                control = self._new_control()
                dispatcher = Dispatcher(
                    control,
                    self.plan,
                    self.laps,
                    planner="prioritized",
                    time_limit=None,
                    patience=2,
                )
                if self.several:
                    control.list_actions = list_several
                if not self.journal.written:
                    dispatcher.begin("run")
                self.control, self.dispatcher = control, dispatcher
                self.operator = Operator(dispatcher)
                if len(self.journal.written) > 1 and self._chance(self.chaos.splices):
                    self._splice(control)
                self.send(control.start())
            except Killed:
                self.counts["kills"] += 1
            else:
                return

    def _new_control(self) -> FleetControl:
        chaos = self.chaos
        return self.kind(
            self.journal,
            look_ahead=chaos.look_ahead,
            snapshot_every=200,
            long_order=LONG_ORDER if chaos.shuffles else 2,
        )

    def call(self, step: Callable[[], list[Message]]) -> None:
        """Have the control do something; where it is killed, it starts again."""
        try:
            self.send(step())
        except Killed:
            self.counts["kills"] += 1
            self._begin()

    def send(self, messages: Sequence[Message]) -> None:
        """Give messages to the network; the process may end between two of them."""
        for message in messages:
            if self._happens(self.chaos.kills / 4):
                raise Killed
            self.counts["messages"] += 1
            self.observer.see_message(message)
            for _ in range(self._copies()):
                if isinstance(message, Order):
                    self.orders[message.robot].append(message)
                else:
                    self.actions.append(message)

    def _splice(self, control: FleetControl) -> None:
        """Give the control another plan of all that it has not released, if one is found."""
        found = another_plan(self.scenario, control, self.draw)
        if found is None:
            return
        self.counts["splices"] += 1
        self.send(control.splice(*found))

    # --- events -----------------------------------------------------------------------------------

    def run(self) -> None:
        for _ in range(self.chaos.events):
            self._event()
            self.observer.look(self.control)
        self.is_calm = True
        self.goals = [own.laps_done + self.chaos.laps for own in self.control.ledger.robots]
        for k in range(CALM):
            if self._is_done():
                self.observer.look_at_the_end(self.control, is_endless=self.chaos.laps > 0)
                return
            if k % 200 == 0:
                self._ask_a_person()
            self._event()
            self.observer.look(self.control)
        raise Fault(f"stuck: {self._stand()}")

    def _stand(self) -> list[str]:
        """Return where each robot stands, and why it does not go on."""
        ledger = self.control.ledger
        return [
            f"{own.arrived}/{own.released}/{own.route.end - 1} ack={own.is_acknowledged} "
            f"token={own.token} cancel={own.cancel} fault={own.fault} failed={own.failed} "
            f"job={own.route.get_jobs(own.released)} finished={own.finished} "
            f"missing={ledger.graph.list_missing(Part(robot, own.released + 1), ledger.arrived)}"
            for robot, own in enumerate(ledger.robots)
        ]

    def _is_done(self) -> bool:
        robots = self.control.ledger.robots
        if self.chaos.laps:
            return all(
                own.laps_done >= goal or own.route.end - own.route.first == 1
                for own, goal in zip(robots, self.goals, strict=True)
            )
        return all(
            (own.arrived == own.route.end - 1 and own.finished >= own.route.all_jobs)
            or (own.is_off and self._has_no_place(robot))
            for robot, own in enumerate(robots)
        )

    def _has_no_place(self, robot: int) -> bool:
        """Whether no plan of the rest was found from any vertex, with nothing else going on."""
        return len(self.refused.get(robot, ())) == self.scenario.roadmap.n_vertices

    def _event(self) -> None:
        chaos, robot = self.chaos, self.draw.randrange(len(self.robots))
        if self._happens(chaos.kills):
            self.counts["kills"] += 1
            self._begin()
        elif self._happens(chaos.resets):
            self.counts["resets"] += self.robots[robot].forget()
        elif self._happens(chaos.cancels):
            self.counts["cancels"] += 1
            self.call(partial(self._operate, "cancel", robot))
        elif self._happens(chaos.jobs):
            self.call(self._change_work)
        elif self._happens(chaos.people):
            self._intervene(robot)
        kinds: list[Callable[[int], None]] = [
            self._step,
            self._take_order,
            self._take_action,
            self._take_state,
            self._tell,
        ]
        if self._chance(1 / 30):
            self.call(self.control.remind)
            if chaos.people:
                self.call(self.dispatcher.pass_stuck)
        else:
            self.draw.choices(kinds, (6, 6, 4, 10, 3))[0](robot)

    def _step(self, robot: int) -> None:
        if self.robots[robot].next_step == "end work" and self._happens(self.chaos.people * 8):
            self.counts["failed"] += self.robots[robot].fail_work()
            self._tell(robot)
        elif self.robots[robot].step():
            self._tell(robot)

    def _take_order(self, robot: int) -> None:
        if self.orders[robot]:
            last = len(self.orders[robot]) - 1 if self.chaos.shuffles else 0
            self.robots[robot].take_order(self.orders[robot].pop(self.draw.randint(0, last)))
            self._tell(robot)

    def _take_action(self, _: int) -> None:
        if self.actions:
            action = self.actions.pop(self.draw.randrange(len(self.actions)))
            if self.robots[action.robot].take_action(action):
                self._tell(action.robot)

    def _take_state(self, _: int) -> None:
        """Give a state to the control: mostly one of the latest, sometimes one of long ago."""
        if self.states:
            back = min(int(self.draw.expovariate(0.3)), len(self.states) - 1)
            other, state = self.states.pop(back)
            self.call(partial(self.control.receive, other, state))

    def _tell(self, robot: int) -> None:
        """Send the state of a robot."""
        state = self._report(robot)
        for _ in range(self._copies()):
            sent = state
            if self._happens(self.chaos.wrong):
                self.counts["wrong fields"] += 1
                sent = self._with_wrong_field(robot, state)
            place = (
                len(self.states) if self._chance(0.6) else self.draw.randint(0, len(self.states))
            )
            self.states.insert(place, (robot, sent))

    def _report(self, robot: int) -> StateReport:
        return self.robots[robot].report_state(self.conditions[robot])

    def _with_wrong_field(self, robot: int, state: StateReport) -> StateReport:
        own, draw = self.control.ledger.robots[robot], self.draw
        orders, number = [*own.orders, "", "another"], state.last_sequence_id
        change: dict[str, Any] = draw.choice(
            [
                {"order_id": draw.choice(orders)},
                {"update_id": max(0, state.update_id + draw.choice([-2, -1, 1]))},
                {"last_place": draw.choice([*own.route.places, ""])},
                {"last_sequence_id": max(0, number + draw.choice([-2, 1, 2, 4]))},
                {"nodes": (), "edges": ()},
                {"nodes": state.nodes[1:]},
                {"edges": state.edges[1:]},
                {"is_driving": not state.is_driving},
            ]
        )
        return replace(state, **change)

    def _change_work(self) -> list[Message]:
        """Add, change or withdraw a job; close or open a place; where no plan is found, go on."""
        draw, operator, roadmap = self.draw, self.operator, self.scenario.roadmap
        ledger, names = self.control.ledger, self.control.ledger.names
        at = roadmap.name(draw.randrange(roadmap.n_vertices))
        jobs = [
            (number, job)
            for number, own in enumerate(ledger.robots)
            for job in sorted(own.route.all_jobs - own.finished)
        ]
        kind = draw.choice(
            ["added", "added", "changed", "withdrawn", "closed", "opened", "switched"]
        )
        try:
            if kind == "switched":
                before = self.control.ledger.graph
                messages = self.dispatcher.switch()
                kind = kind if self.control.ledger.graph is not before else "not switched"
            elif kind == "added":
                robot = draw.choice([*names, None])
                messages = operator.add_job(at, draw.randint(0, 5), robot)[1]
            elif kind == "closed":
                messages = operator.close(*self._any_place(at))
            elif kind == "opened" or not jobs:
                messages = operator.open(*draw.choice([*sorted(ledger.closed), (at,)]))
            else:
                number, job = draw.choice(jobs)
                name = f"{names[number]}/{job}"
                if kind == "changed":
                    messages = operator.change_job(name, at)
                else:
                    self.observer.withdrawn.add((number, job))
                    messages = operator.withdraw_job(name)
        except (GaveUp, InputError):
            self.counts[f"not {kind}"] += 1
            return []
        self.counts[kind] += 1
        return messages

    def _operate(self, kind: str, robot: int) -> list[Message]:
        return self.operator.operate(kind, self.control.ledger.names[robot])

    def _intervene(self, robot: int) -> None:
        """Have trouble with a robot, or a person look after it."""
        real, draw = self.robots[robot], self.draw
        kind = draw.choice(["unfit", "held", "fit", "let go", "decided", "placed"])
        if kind in {"unfit", "fit"}:
            broken = RobotError(kind="laser", level="FATAL")
            self.conditions[robot] = Condition(errors=(broken,) if kind == "unfit" else ())
            self._tell(robot)
        elif kind in {"held", "let go"}:
            self.call(partial(self._operate, "hold" if kind == "held" else "go", robot))
        elif kind == "decided":
            self._decide(robot)
        elif real.next_step in {None, "begin to drive", "begin work"}:
            self.call(partial(self._operate, "remove", robot))
            if self.control.ledger.robots[robot].is_off:
                self._put(robot)
        else:
            kind = "not placed"
        self.counts[kind] += 1

    def _decide(self, robot: int) -> None:
        """Have failed work of a robot done again, or skip it."""
        for job in sorted(self.control.ledger.robots[robot].failed):
            name = f"{self.control.ledger.names[robot]}/{job}"
            if self._chance(0.6):
                self.call(partial(self.operator.retry_job, name))
            else:
                self.observer.withdrawn.add((robot, job))
                self.call(partial(self.operator.skip_job, name))

    def _put(self, robot: int) -> None:
        """Put a robot that is off the floor at a vertex, where a plan from there is found.

        It was switched off: it has no order, and none is under way to it.
        """
        real, roadmap = self.robots[robot], self.scenario.roadmap
        self.orders[robot].clear()
        real.forget()
        self.refused.setdefault(robot, set())
        for _ in range(5):
            place = roadmap.name(self.draw.randrange(roadmap.n_vertices))
            before, real.place = real.place, place
            name = self.control.ledger.names[robot]
            try:
                self.call(partial(self.operator.place_robot, name, place))
            except (GaveUp, InputError):
                self.counts["not placed"] += 1
                if self.is_calm:
                    self.refused[robot].add(place)
            if not self.control.ledger.robots[robot].is_off:
                return
            real.place = before

    def _any_place(self, at: str) -> tuple[str, ...]:
        """Return a vertex, or both ends of a lane that leaves it."""
        roadmap = self.scenario.roadmap
        vertex = roadmap.get_vertex(at)
        heads = roadmap.heads[roadmap.indptr[vertex] : roadmap.indptr[vertex + 1]].tolist()
        return (at, roadmap.name(self.draw.choice(heads))) if self._chance(0.5) and heads else (at,)

    def _ask_a_person(self) -> None:
        """Have a person look after faulty robots, and open what is closed."""
        for place in sorted(self.control.ledger.closed):
            self.call(partial(self.operator.open, *place))
        for robot in range(len(self.robots)):
            if self.control.ledger.robots[robot].fault is not None:
                self.counts["cleared"] += 1
                self.call(partial(self._operate, "clear", robot))
            self._decide(robot)  # a state with a wrong field may say FAILED, too
            if self.chaos.people:
                self.conditions[robot] = Condition()
                self.call(partial(self._operate, "go", robot))
                if self.control.ledger.robots[robot].is_off:
                    self._put(robot)

    def _copies(self) -> int:
        if self._happens(self.chaos.lost):
            return 0
        return 2 if self._happens(self.chaos.doubled) else 1

    def _happens(self, share: float) -> bool:
        return not self.is_calm and self._chance(share)

    def _chance(self, share: float) -> bool:
        return self.draw.random() < share


class Observer:
    """Looks at robots and journal from outside."""

    def __init__(self, scenario: Scenario, robots: Sequence[SimulatedRobot]) -> None:
        self.scenario, self.robots = scenario, robots
        self._excludes = _floor(scenario).excludes
        self._contents: dict[tuple[str, int], Order] = {}
        self._arrived = [0 for _ in robots]
        self._job_of: list[dict[str, str]] = [{} for _ in robots]  # by the id of its action
        self.withdrawn = set[tuple[int, str]]()
        self._looked_at: list[object] = [None for _ in robots]
        self._laps = [0 for _ in robots]  # that are done or planned
        self._open: list[set[str]] = [set() for _ in robots]  # jobs that are not known to be done
        self._shapes = cache(self._shapes_along)
        self._seen: list[tuple[object, ...]] = []
        self._ways: list[tuple[tuple[str, ...], ...]] = [() for _ in robots]  # driven, booked

    def add_robot(self, scenario: Scenario) -> None:
        """Look at one robot more, the last one of the scenario."""
        self.scenario, self._excludes = scenario, _floor(scenario).excludes
        self._arrived.append(0)
        self._job_of.append({})
        self._looked_at.append(None)
        self._laps.append(0)
        self._open.append(set())
        self._ways.append(())

    def see_message(self, message: Message) -> None:
        """Hold an order against what was sent with its ids before (I4)."""
        if isinstance(message, Order):
            key = (message.order_id, message.update_id)
            if self._contents.setdefault(key, message) != message:
                raise Fault(f"{key} has two contents: {self._contents[key]} and {message}")

    def look(self, control: FleetControl) -> None:
        """Compare what robots hold, truly and by the journal (I1, I2, I5), and their jobs."""
        is_same = True
        for robot, (own, real) in enumerate(zip(control.ledger.robots, self.robots, strict=True)):
            if not self._arrived[robot] <= own.arrived <= own.released:
                raise Fault(f"robot {robot} has arrived at {own.arrived} of {own.released}")
            self._arrived[robot] = own.arrived
            base: tuple[str, ...] = ()
            held: tuple[str, ...] = ()
            if not own.is_off:
                base, held = (real.place, *[node.place for node in real.ahead]), own.held
            if self._ways[robot] != (base, held):
                if not _is_within(base, held):
                    raise Fault(f"robot {robot} has base {base}, but the journal says {held}")
                self._ways[robot], is_same = (base, held), False
            self._look_at_jobs(robot, own)
        if not is_same:
            bases, booked = zip(*self._ways, strict=True)
            self._compare(bases, "drive")
            self._compare(booked, "are booked")

    def _compare(self, ways: Sequence[tuple[str, ...]], verb: str) -> None:
        key = tuple(ways)
        if key in self._seen:
            return
        self._seen = [*self._seen[-8:], key]
        shapes = [self._shapes(way) for way in ways]
        for j in range(len(ways)):
            for i in range(j):
                for one in shapes[i]:
                    for other in shapes[j]:
                        if self._excludes(i, one, j, other):
                            raise Fault(f"robots {i} and {j} {verb} at once: {one} and {other}")

    def _shapes_along(self, places: tuple[str, ...]) -> frozenset[Shape]:
        """Return vertices, edges and zones of a way."""
        vertices = _floor(self.scenario).list_vertices(places)
        edges = list(pairwise(vertices))
        roadmap = self.scenario.roadmap
        shapes: list[Shape] = [*((vertex,) for vertex in vertices), *edges]
        zones = {zone for shape in shapes for zone in zones_of(roadmap, shape)}
        return frozenset([*shapes, *((-1 - zone,) for zone in zones)])

    def _look_at_jobs(self, robot: int, own: RobotLedger) -> None:
        """Tell whether a job or a lap is lost: neither done nor in the route (I6)."""
        laps = own.count_laps()
        if laps < self._laps[robot]:
            raise Fault(f"robot {robot} has lost {self._laps[robot] - laps} laps")
        self._laps[robot] = laps
        key = (id(own.route), len(own.jobs_of), own.jobs_done)
        if key == self._looked_at[robot]:
            return
        self._looked_at[robot] = key
        jobs = own.route.all_jobs
        self._job_of[robot] |= own.jobs_of
        gone = self._open[robot] - jobs
        unwanted = {job for other, job in self.withdrawn if other == robot}
        if gone - unwanted - self._done(robot).keys():
            raise Fault(f"robot {robot} has lost {sorted(gone)}")
        self._open[robot] = jobs - own.finished

    def _done(self, robot: int) -> Counter[str]:
        """Return how often each job was done: the action that was done least often."""
        done = self.robots[robot].done
        steps = dict[str, Counter[int]]()
        for action, job in self._job_of[robot].items():
            own = steps.setdefault(job, Counter())
            own[split_action(action)[1]] += done.get(action, 0)
        for job, own in steps.items():
            if max(own.values()) > 1:
                raise Fault(f"robot {robot} has done {job} twice: {dict(own)}")
        return +Counter({job: min(own.values()) for job, own in steps.items()})

    def look_at_jobs(self, control: FleetControl) -> None:
        """Count how often each job was done."""
        for robot, own in enumerate(control.ledger.robots):
            self._look_at_jobs(robot, own)
            for job, count in self._done(robot).items():
                if count > 1:
                    raise Fault(f"robot {robot} has done {job} {count} times")

    def look_at_the_end(self, control: FleetControl, *, is_endless: bool) -> None:
        """Tell whether each job was done exactly once, and each robot is at its end."""
        self.look_at_jobs(control)
        for robot, (own, real) in enumerate(zip(control.ledger.robots, self.robots, strict=True)):
            done = self._done(robot)
            if own.jobs_done > done.total():
                raise Fault(f"robot {robot} has done {done.total()} jobs, not {own.jobs_done}")
            if is_endless or own.is_off:
                continue
            skipped = {job for other, job in self.withdrawn if other == robot}
            wanted = own.route.all_jobs - skipped
            if not wanted <= done.keys():
                raise Fault(f"robot {robot} has not done {sorted(wanted - done.keys())}")
            if real.place != own.route.places[-1]:
                raise Fault(f"robot {robot} ends at {real.place}")


class _Floor:
    """What is asked of a scenario time and again, answered once."""

    def __init__(self, scenario: Scenario) -> None:
        self._roadmap, self._itineraries = scenario.roadmap, scenario.problem.itineraries
        self.excludes = cache(partial(incompatible, scenario))
        self.list_heads, self._part = cache(self._heads), cache(self._booked)
        self.names = list(map(scenario.roadmap.name, range(scenario.roadmap.n_vertices)))

    def list_vertices(self, places: Sequence[str]) -> list[int]:
        """Return the vertices of a way; passed ones are drawn where it has no whole chain."""
        roadmap = self._roadmap
        return list(roadmap.unfold_route(list(map(roadmap.get_vertex, places))))

    def list_parts(self, route: RouteToDrive) -> list[tuple[Shape, ...]]:
        """Return what each visit of a route books, with the drive to it."""
        way = self.list_vertices(route.places)
        return [self._part(tail, vertex) for tail, vertex in zip([None, *way], way, strict=False)]

    def _booked(self, tail: int | None, vertex: int) -> tuple[Shape, ...]:
        shapes: list[Shape] = [(vertex,)]
        if tail is not None:
            shapes.append((tail, vertex))
        zones = {zone for shape in shapes for zone in zones_of(self._roadmap, shape)}
        return (*shapes, *((-1 - zone,) for zone in zones))

    def _heads(self, robot: int, vertex: int) -> list[int]:
        """Return where a robot can drive from a vertex: it may be barred from lanes."""
        roadmap, ticks = self._roadmap, self._itineraries[robot].edge_ticks
        edges = slice(int(roadmap.indptr[vertex]), int(roadmap.indptr[vertex + 1]))
        ends, classes = roadmap.heads[edges].tolist(), roadmap.class_of_edge[edges].tolist()
        return [head for head, kind in zip(ends, classes, strict=True) if ticks[kind] >= 0]


_floor = lru_cache(maxsize=4)(_Floor)


def _is_within(base: tuple[str, ...], held: tuple[str, ...]) -> bool:
    return any(held[k : k + len(base)] == base for k in range(len(held) - len(base) + 1))


# --- another plan of the rest ---------------------------------------------------------------------


def another_plan(
    scenario: Scenario, control: FleetControl, draw: random.Random
) -> tuple[list[RouteToDrive], ReleaseGraph] | None:
    """Return other routes and rights of way behind what is committed; None if none was found.

    Robots get random ways to their next places. Then one after another moves on a part at random,
    wherever nobody is in its way, until all are at their ends: that is the order of the new plan.
    """
    robots = control.ledger.robots
    firsts = [own.arrived for own in robots]
    kept = [own.route.cut_before(own.arrived) for own in robots]
    ends = [end - first for end, first in zip(control.list_committed(), firsts, strict=True)]
    roadmap, floor = scenario.roadmap, _floor(scenario)
    if any(roadmap.is_passed(roadmap.get_vertex(route.places[0])) for route in kept):
        return None  # the order of a chain is kept to its end
    detour = partial(_detour, floor, draw)
    for attempt in range(6):
        routes = [
            route if attempt % 2 or draw.random() < 0.5 else detour(robot, route, end)
            for robot, (route, end) in enumerate(zip(kept, ends, strict=True))
        ]
        order = _played(floor, routes, ends, draw)
        if order is not None:
            graph = _graph_of_order(floor, routes, ends, order)
            if graph.find_rotation():
                continue
            return [
                _timed(route, robot, end, order)
                for robot, (route, end) in enumerate(zip(routes, ends, strict=True))
            ], graph
    return None


def _timed(route: RouteToDrive, robot: int, end: int, order: Sequence[Part]) -> RouteToDrive:
    """Return a route whose visits begin in the order of parts."""
    ticks = {part.number: 2 * tick for tick, part in enumerate(order, 1) if part.robot == robot}
    n_visits = len(route.places)
    enter = tuple(ticks.get(k, k - end) for k in range(n_visits))
    return replace(route, enter=enter, in_step=False)


def _detour(
    floor: _Floor, draw: random.Random, robot: int, route: RouteToDrive, end: int
) -> RouteToDrive:
    """Return the route with random ways between the places of its later jobs, and its end."""
    vertices, heads_of = floor.list_vertices(route.places), partial(floor.list_heads, robot)
    last = len(vertices) - 1
    laps = Counter(lap_end - route.first for lap_end in route.lap_ends)
    goals = [k for k in range(end + 1, last + 1) if route.jobs[k] or k in {*laps, last}]
    path, jobs = vertices[: end + 1], list(route.jobs[: end + 1])
    lap_ends = [lap_end for lap_end in laps.elements() if lap_end <= end]
    for goal in goals:
        way = _random_way(heads_of, path[-1], vertices[goal], draw)
        if way is None or (len(way) == 1 and (route.jobs[goal] or goal in laps)):
            return route
        if len(way) > 1 and draw.random() < 0.3:
            way += _out_and_back(heads_of, way[-1], draw)
        path += way[1:]
        jobs += [()] * (len(way) - 1)
        if way[1:]:
            jobs[-1] = route.jobs[goal]
        lap_ends += [len(path) - 1] * laps[goal]
    return replace(
        route,
        places=tuple(map(floor.names.__getitem__, path)),
        jobs=tuple(jobs),
        work=tuple((0,) * len(names) for names in jobs),
        lap_ends=tuple(lap_end + route.first for lap_end in sorted(lap_ends)),
    )


def _out_and_back(
    heads_of: Callable[[int], list[int]], vertex: int, draw: random.Random
) -> list[int]:
    """Return a way to a neighbour and back; nothing if none leads back."""
    heads = heads_of(vertex)
    if not heads:
        return []
    neighbour = draw.choice(heads)
    return [neighbour, vertex] if vertex in heads_of(neighbour) else []


def _random_way(
    heads_of: Callable[[int], list[int]], start: int, goal: int, draw: random.Random
) -> list[int] | None:
    """Return a way through a random spanning tree from its start."""
    came: dict[int, int] = {start: start}
    front = [start]
    while front:
        vertex = front.pop(draw.randrange(len(front)))
        for head in heads_of(vertex):
            if head not in came:
                came[head] = vertex
                front.append(head)
    if goal not in came:
        return None
    way = [goal]
    while way[-1] != start:
        way.append(came[way[-1]])
    return way[::-1]


def _played(
    floor: _Floor,
    routes: Sequence[RouteToDrive],
    ends: Sequence[int],
    draw: random.Random,
) -> list[Part] | None:
    """Return an order in which all parts behind what is committed can be driven; None if stuck.

    Numbers count from where robots have arrived.
    """
    ways = [floor.list_parts(route) for route in routes]
    at, order = [0] * len(routes), list[Part]()
    held = [
        {shape for part in way[: end + 1] for shape in part}
        for way, end in zip(ways, ends, strict=True)
    ]
    movable = [r for r in range(len(routes)) if at[r] < len(ways[r]) - 1]
    while movable:
        draw.shuffle(movable)
        for robot in movable:
            k = at[robot] + 1
            part = ways[robot][k]
            is_free = k <= ends[robot] or not any(
                floor.excludes(robot, mine, other, theirs)
                for other in range(len(routes))
                if other != robot
                for mine in part
                for theirs in held[other]
            )
            if is_free:
                break
        else:
            return None
        at[robot] = k
        if k > ends[robot]:
            order.append(Part(robot, k))
        held[robot] = {
            shape
            for p in range(k, max(ends[robot], k) + 1)
            for shape in ways[robot][p]
            if p > k or len(shape) == 1
        }
        if k == len(ways[robot]) - 1:
            movable.remove(robot)
    return order


def _graph_of_order(
    floor: _Floor, routes: Sequence[RouteToDrive], ends: Sequence[int], order: Sequence[Part]
) -> ReleaseGraph:
    """Return who waits for whom where the parts behind the committed ones go in an order.

    Numbers count from where robots have arrived; those of the graph are the routes' own.
    """
    firsts = [route.first for route in routes]
    ways = [floor.list_parts(route) for route in routes]
    before = [Part(r, k) for r, end in enumerate(ends) for k in range(end + 1)]
    waits: dict[Part, list[Arrival]] = {}
    for part in order:
        latest: dict[int, int] = {}
        for mine in ways[part.robot][part.number]:
            for other in before:
                if other.robot == part.robot:
                    continue
                for theirs in ways[other.robot][other.number]:
                    if floor.excludes(part.robot, mine, other.robot, theirs):
                        is_edge = len(theirs) == 2
                        left = other.number + (not is_edge)
                        latest[other.robot] = max(latest.get(other.robot, 0), left)
        waits[Part(part.robot, firsts[part.robot] + part.number)] = [
            Arrival(other, firsts[other] + visit) for other, visit in sorted(latest.items())
        ]
        before.append(part)
    return ReleaseGraph([route.end for route in routes], waits, firsts)
