"""Rounds while robots drive: begun when there is more to plan, spliced when they are planned.

Until a plan takes over, the old one stands, and no robot gets more than the part that it keeps. A
round that finds no plan changes nothing. Nothing is kept here that is not in the journal, but for
the reasons of the last round: a control that starts again begins a round.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from rightofway.control.batteries import FleetBatteries
from rightofway.control.fleet_control import FleetControl
from rightofway.control.journal import Entry
from rightofway.control.laps import build_graph_behind_released
from rightofway.control.ledger import Edge
from rightofway.control.messages import Message
from rightofway.control.round_floor import FloorReports, mirror_floor
from rightofway.control.round_view import (
    ViewOfRound,
    find_kept_parts,
    make_routes_of_round,
    map_later,
    view_fleet,
)
from rightofway.control.round_worker import RoundRequest, Rounds
from rightofway.control.routes import RouteToDrive
from rightofway.control.work_items import find_charge_step, find_stop
from rightofway.dispatch import STOPS_AHEAD, PoolEvent, Round, StopsLater
from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.model import Scenario, Tick, UnservedReason
from rightofway.precedence import ReleaseGraph

__all__ = ["RoundDriver"]

FOR_GOOD: frozenset[UnservedReason] = frozenset({"latest", "after"})
"""Reasons for which a job leaves the pool: no robot can ever do it."""

AHEAD = 4
"""Parts beyond the released ones that a robot may keep while a round is under way."""

TOLERANCE = 0.01
"""By how much a forecast may be below the reserve: robots report whole percents."""

PAUSE = 10
"""Calls of `look` until a round that has found no plan is tried again."""

Report = Callable[[Fact | None, bool], None]


class RoundDriver:
    """The rounds of a control.

    Parameters
    ----------
    scenario
        The scenario of the plan, with jobs.
    control
        The control, with the pool of jobs in its ledger.
    rounds
        Where rounds are planned.

    Attributes
    ----------
    scenario
        The fleet with bookings of ``both``, without its jobs, states and closures.
    reasons
        Why jobs are in no tour, by name, as the last round had it.
    report
        Receives a fact when a round finds no plan, or with True when one finds one again.
    tell
        Receives facts on jobs that no robot does.
    unable
        Robots that do not go on: others are planned round them.
    is_wanted
        Whether there is more to plan.
    """

    def __init__(self, scenario: Scenario, control: FleetControl, rounds: Rounds) -> None:
        rules = replace(scenario.rules, occupancy="both", rotations=False)
        clock = scenario.problem.clock
        robots = tuple(replace(robot, start=None) for robot in scenario.robots)
        self._fleet = replace(
            scenario, rules=rules, clock=clock, robots=robots, jobs=(), tours=None
        )
        self.scenario = replace(self._fleet, closures=(), clock=clock)
        self._control, self.rounds = control, rounds
        self.reasons: dict[str, UnservedReason | None] = {}
        self.report: Report = lambda *_: None
        self.tell: Callable[[Fact], None] = lambda _: None
        self.unable = frozenset[int]()
        self.list_closed: Callable[[], Collection[Edge]] = tuple
        self.read_ticks: Callable[[], int] = lambda: 0
        self.is_wanted = bool(control.ledger.run)  # a round may have been under way
        self._seen: ViewOfRound | None = None  # of the round that is under way
        self._graph: ReleaseGraph | None = None  # of the plan that it replaces
        self._ignores_closures = False  # of that round
        self._count = 0  # rounds since the start
        self._pause = 0  # calls of `go_on` until the next try after a failure
        self._batteries = FleetBatteries(self.scenario)
        self._reports = FloorReports(control.charges, control.headings)
        self._short_graph: ReleaseGraph | None = None  # of a plan that batteries do not last for
        self._tried: object = None  # what was known when a round was last wanted for idle robots
        self._later: tuple[object, Mapping[int, StopsLater]] = None, {}  # a graph, and its own

    @property
    def is_under_way(self) -> bool:
        """Whether a round is planned now."""
        return self._seen is not None

    @property
    def is_over(self) -> bool:
        """Whether nothing is planned, and no more is to plan."""
        return not self.is_wanted and not self.is_under_way and not any(self.later.values())

    @property
    def later(self) -> Mapping[int, StopsLater]:
        """What robots do behind the ends of their routes; nothing is known after other splices."""
        graph, later = self._later
        return later if graph is self._control.ledger.graph else {}

    def want(self) -> None:
        """Begin a round as soon as none is under way."""
        self.is_wanted, self._pause = True, 0

    def map_robots(self) -> dict[str, int]:
        """Return the robot that has each job in its tour, by name; without those that are off."""
        planned, later = dict[str, int](), self.later
        for robot, own in enumerate(self._control.ledger.robots):
            if not own.is_off:
                stops = filter(None, map(find_stop, own.route.all_jobs))
                names = (name for name, _ in (*stops, *later.get(robot, ())))
                planned |= dict.fromkeys(names, robot)
        return planned

    def list_waiting(self) -> list[str]:
        """Return the jobs of the pool that are in no tour and not begun."""
        planned, pool = self.map_robots(), self._control.ledger.pool
        return [name for name, own in pool.jobs.items() if not own.is_begun and name not in planned]

    def look(self) -> None:
        """Want a round where jobs wait for robots, or a battery or a route will not last long.

        Call it every second.
        """
        self._pause = max(0, self._pause - 1)
        self._reports.look(self._control.ledger, self.read_ticks())
        ledger, waiting = self._control.ledger, self.list_waiting()
        robots = ledger.robots
        idle = [
            robot
            for robot, own in enumerate(robots)
            if own.is_done and not own.is_off and robot not in self.unable
        ]
        known = waiting, idle, len(ledger.pool.left)
        if waiting and idle and known != self._tried:
            self._tried, self.is_wanted = known, True
        self.is_wanted |= any(map(self._is_near_end, self.later.items()))
        if ledger.graph is not self._short_graph and any(map(self._is_short, range(len(robots)))):
            self._short_graph, self.is_wanted = ledger.graph, True  # once for each plan

    def _is_near_end(self, later: tuple[int, StopsLater]) -> bool:
        """Return whether a robot has little left to do on its route, and more to do behind it."""
        own = self._control.ledger.robots[later[0]]
        left = (item for item in own.route.all_jobs - own.finished if not own.is_sent(item))
        is_near = sum(find_charge_step(item) != "end" for item in left) < STOPS_AHEAD
        return is_near and bool(later[1]) and not own.is_off

    def _is_short(self, robot: int) -> bool:
        """Return whether a robot is expected below its reserve before its next charge."""
        own, charge = self._control.ledger.robots[robot], self._control.charges.get(robot)
        battery = self._batteries.of_robot[robot]
        if battery is None or charge is None or own.is_off or robot in self.unable:
            return False
        visits = range(own.arrived, own.route.end)
        charges = (
            visit
            for visit in visits
            if any(
                find_charge_step(item) == "begin" and item not in own.finished
                for item in own.route.get_jobs(visit)
            )
        )
        places = own.route.stretch(own.arrived, next(charges, own.route.end - 1) + 1)
        drives = (self._batteries.measure_drive(robot, *ends) for ends in pairwise(places))
        is_driving = len(places) > 1
        return is_driving and charge - sum(drives) < battery.reserve - TOLERANCE

    def go_on(self) -> list[Message]:
        """Splice the plan of a round that has ended, and begin the next one; return messages."""
        messages = list[Message]()
        if self._seen is not None:
            planned = self.rounds.poll()
            if planned is None:
                return []
            messages = self._take_over(self._seen, planned)
        if self.is_wanted and not self._pause and self._seen is None:
            self._begin()
        while self._seen is not None and (planned := self.rounds.poll()) is not None:
            messages += self._take_over(self._seen, planned)
        return messages

    def _begin(self, *, ignores_closures: bool = False) -> None:
        """Begin a round; perhaps as if nothing was closed and all robots could drive.

        Then robots wait before what is closed, and behind those that do not go on.
        """
        control, ledger = self._control, self._control.ledger
        if all(own.is_off or k in self.unable for k, own in enumerate(ledger.robots)):
            self.report(Fact("no plan of the rest", reason=Fact("no robot that drives")), False)
            return
        self.is_wanted, self._ignores_closures = False, ignores_closures
        kept_parts = find_kept_parts(ledger, control.list_committed(), AHEAD)
        now, lead = self.read_ticks(), 0
        if self.rounds.time_limit is not None:
            seconds = float(self.scenario.problem.clock.tick * (self.scenario.units.seconds or 1))
            lead = int(self.rounds.time_limit / seconds)
        floor = mirror_floor(self._fleet, ledger, self._reports, now=now, unable=self.unable)
        self._seen = seen = view_fleet(
            floor,
            ledger,
            kept_parts,
            unable=() if ignores_closures else self.unable,
            closed=() if ignores_closures else self.list_closed(),
            later=self.later,
            now=now,
            takeover=now + lead,
        )
        control.kept_parts, self._graph = seen.kept_parts, ledger.graph
        self._count += 1
        present = tuple(self._fleet.robots[robot] for robot in seen.present)
        self.rounds.begin(
            RoundRequest(
                scenario=replace(self._fleet, robots=present, clock=self._fleet.problem.clock),
                view=seen.view,
                jobs=dict(seen.jobs),
                over=dict(ledger.pool.left),
                seed=self._count,
            )
        )

    def _take_over(self, seen: ViewOfRound, planned: Round) -> list[Message]:
        """Let the plan of a round take over, if it is one and still fits."""
        control, ledger = self._control, self._control.ledger
        self._seen = control.kept_parts = None
        if ledger.graph is not self._graph:  # another splice came first
            self.is_wanted = True
            return control.note()
        if planned.stands and not self._ignores_closures and self._has_closures(seen):
            self._begin(ignores_closures=True)
            return []
        if planned.stands:
            return self._keep_old(planned.facts[0].values["reason"])
        routes = make_routes_of_round(self.scenario, ledger, seen, planned)
        absent = [robot for robot, own in enumerate(ledger.robots) if own.is_off]
        graph = build_graph_behind_released(self.scenario, routes, seen.kept_parts, absent)
        if graph.find_rotation():
            return self._keep_old(Fact("robots would rotate"))
        notes, moved = self._list_unserved(planned), self._list_moved(routes)
        try:
            messages = control.splice(routes, graph, withdrawn=moved, notes=notes)
        except InputError as error:  # the guard: no round ends the control
            return self._keep_old(str(error))
        self._later = ledger.graph, map_later(ledger, seen, planned)
        self._tell_reasons(dict(planned.unserved), planned.postponed)
        self.report(None, True)
        return messages

    def _tell_reasons(self, unserved: dict[str, UnservedReason], postponed: Sequence[str]) -> None:
        """Tell why jobs are in no tour, each reason once; some follow a job that is in none."""
        pool = self._control.ledger.pool
        reasons: dict[str, UnservedReason | None] = {**unserved}
        for name in postponed:
            before = pool.jobs[name].job.after if name in pool.jobs else ()
            reasons[name] = "after" if any(map(reasons.get, before)) else None
        for name, reason in reasons.items():
            if reason is not None and self.reasons.get(name) != reason:
                self.tell(Fact("unserved", job=name, why=Fact(f"unserved {reason}")))
        self.reasons = reasons

    @staticmethod
    def _has_closures(seen: ViewOfRound) -> bool:
        view = seen.view
        return bool(view.closed) or not all(own.is_able for own in view.robots)

    def _keep_old(self, reason: Fact | str) -> list[Message]:
        """Let the old plan go on, and try again later."""
        self.is_wanted, self._pause = True, PAUSE
        is_general = isinstance(reason, Fact) and reason.about is None  # a journal has no scenario
        fact = Fact("no plan of the rest", reason=reason if is_general else str(reason))
        self.report(fact, False)
        return self._control.note()

    def _list_moved(self, routes: Sequence[RouteToDrive]) -> list[tuple[int, str]]:
        """Return the work that robots had to do and have no more: others do it, or later."""
        return [
            (robot, item)
            for robot, (own, route) in enumerate(
                zip(self._control.ledger.robots, routes, strict=True)
            )
            for item in sorted(own.route.all_jobs - own.finished - route.all_jobs)
        ]

    def _list_unserved(self, planned: Round) -> list[Entry]:
        """Return entries on jobs that no robot can ever do."""
        roadmap, now = self.scenario.roadmap, Tick(self.read_ticks())
        return [
            PoolEvent(kind="job unserved", at=now, name=name, reason=reason).to_document(roadmap)
            for name, reason in planned.unserved
            if reason in FOR_GOOD
        ]
