"""The dispatcher: plans the next routes of robots, after their released parts.

A control asks its dispatcher after whatever comes in, and gets more to release where laps end. The
rest is replanned where work changes, or where robots do not go on. A dispatcher keeps nothing that
is not in the journal.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import cache

from rightofway.control.clocked_closures import ClockedClosures, Closed
from rightofway.control.commitments import find_last_open, list_stops_to_make
from rightofway.control.fleet_control import FleetControl
from rightofway.control.held_work import HeldWork
from rightofway.control.job_events import list_known_jobs
from rightofway.control.journal import Entry
from rightofway.control.laps import LapsToDrive, build_graph_behind_released
from rightofway.control.ledger import Edge, Ledger
from rightofway.control.messages import Message
from rightofway.control.rest import RestPlanner
from rightofway.control.robot_ledger import RobotLedger
from rightofway.control.round_driver import RoundDriver
from rightofway.control.round_worker import Rounds, RoundsAtOnce
from rightofway.control.routes import RouteToDrive, make_routes_to_drive
from rightofway.control.stop_actions import StopActions
from rightofway.control.stuck import StuckRobots
from rightofway.errors import GaveUp, InputError
from rightofway.facts import Fact
from rightofway.model import Plan
from rightofway.precedence import ReleaseGraph
from rightofway.resume.rest_of_fleet import StopToMake

__all__ = ["Dispatcher"]

PATIENCE = 10
"""Seconds for which a robot does not go on before others are replanned round it, and after which a
replanning that has failed is tried again."""

Report = Callable[[Fact | None, bool], None]
"""Receives a fact on replanning that fails, or with True on its end; perhaps None then."""


class Dispatcher:
    """The work of robots that a control releases.

    Parameters
    ----------
    control
        The control, with an empty journal or that of an earlier start.
    plan
        The plan with which the journal begins.
    laps
        The work that robots repeat for ever; None where they drive the plan once.
    planner, time_limit
        The planner of the rest where jobs change, and its time for one plan [s].
    patience
        Calls of `pass_stuck` for which a robot does not go on before others are replanned round it,
        and after which a replanning that has failed is tried again.
    rounds
        Where rounds of a plan with jobs are planned; by default here, while robots wait.

    Attributes
    ----------
    control, plan
        As given.
    closures
        The closures of the scenario, if it has any; `keep_time` sets them.
    rounds
        The rounds of a plan with jobs; None for other plans.
    report
        Receives a fact when no plan of the rest is found, and when one is found again; a
        supervisor sets it. A command that is refused for this reason has the answer instead.
    """

    def __init__(
        self,
        control: FleetControl,
        plan: Plan,
        laps: LapsToDrive | None = None,
        *,
        planner: str = "auto",
        time_limit: float | None = 2,
        patience: int = PATIENCE,
        rounds: Rounds | None = None,
    ) -> None:
        self._patience = patience
        self.report: Report = lambda *_: None
        self.control, self.plan, self._laps = control, plan, laps
        self._rest = RestPlanner(plan.scenario, planner, time_limit)
        self._stuck = StuckRobots(control, patience)
        self._has_failed = False  # no plan of the rest was found, and that was reported
        self._tries_in = self._patience  # calls of `pass_stuck` until the next try
        self._is_new = True  # `pass_stuck` was not called since the start
        self.closures: ClockedClosures | None = None
        self._waiting_work: HeldWork | None = None
        self._planned_round = set[Edge]()  # what closures closed when the rest was planned
        self.rounds: RoundDriver | None = None
        if plan.scenario.jobs is not None:
            own_rounds = rounds or RoundsAtOnce(time_limit, planner)
            self.rounds = RoundDriver(plan.scenario, control, own_rounds)
            self.rounds.report = self._report_round
            self.rounds.watch.list_closed = self._list_closed_edges
        control.dispatch, control.may_drive = self._add_laps, cache(self._may_drive)
        control.may_stop = self._rest.may_stop
        control.list_actions = StopActions(plan.scenario, lambda: self.ledger.pool).find

    @property
    def ledger(self) -> Ledger:
        """The state that the journal describes."""
        return self.control.ledger

    @property
    def is_endless(self) -> bool:
        """Whether robots repeat laps for ever."""
        return self._laps is not None

    def begin(self, run: str, began: float | None = None) -> None:
        """Give an empty journal the plan.

        Parameters
        ----------
        run
            A name that no other journal has.
        began
            When the run began, if not now [s since 1970].

        Raises
        ------
        InputError
            If robots of the plan move round a circle at one instant.
        """
        scenario = self.plan.scenario
        graph = ReleaseGraph.of(scenario, self.plan.tracks)
        names = [robot.name for robot in scenario.robots]
        jobs = list(list_known_jobs(self.plan))
        routes = make_routes_to_drive(self.plan)
        self.control.begin(run, routes, graph, names, jobs, began=began)

    def _may_drive(self, robot: int, tail: str, head: str) -> bool:
        """Return whether a lane leads from one vertex to another, and the robot is not barred."""
        scenario = self.plan.scenario
        roadmap, ticks = scenario.roadmap, scenario.problem.itineraries[robot].edge_ticks
        try:
            edges = roadmap.list_edges(roadmap.get_vertex(tail), roadmap.get_vertex(head))
        except InputError:
            return False
        return any(ticks[roadmap.class_of_edge[edge]] >= 0 for edge in edges)

    def _add_laps(self) -> list[Message]:
        """Add laps where robots come to the end of theirs; go on with rounds."""
        if self.rounds is not None:
            return self.rounds.go_on()
        robots = list(map(self._rest.begin_at_stop, self.ledger.robots))
        more = self._laps.extend(robots) if self._laps else None
        if more is None:
            return []
        routes, missed = more
        if missed:
            planned_laps = self._try(lambda: self._plan_laps(routes, missed))
            if planned_laps is not None:
                return planned_laps
            # They set out without the work with which their lap begins.
        planned = [own.route.end - 1 for own in robots]
        messages = self.control.splice(routes, self._build_graph(routes))
        closed = self._list_closed_edges()
        if any(route.leads_over(closed, route.first, route.end) for route in routes):
            try:
                messages += self._plan_behind(planned)
            except GaveUp:  # else robots stop before what is closed
                messages += self._try(lambda: self._plan_rest(self.list_stops())) or []
        return messages

    def _plan_laps(
        self, routes: Sequence[RouteToDrive], missed: Mapping[int, Sequence[StopToMake]]
    ) -> list[Message]:
        """Plan laps that were added, with work where robots wait: they come there once more."""
        rows = zip(self.ledger.robots, routes, strict=True)
        robots = [replace(own, route=route) for own, route in rows]
        committed = self.control.list_committed()
        stops = [
            [*missed.get(robot, ()), *list_stops_to_make(own, end)]
            for robot, (own, end) in enumerate(zip(robots, committed, strict=True))
        ]
        closed = self._list_closed_edges()
        return self.control.splice(
            *self._rest.plan(robots, committed, stops, closed, [*self._stuck.passed])
        )

    def _build_graph(self, routes: Sequence[RouteToDrive]) -> ReleaseGraph:
        """Return who waits for whom in the order of planned times, after the released parts."""
        absent = [robot for robot, own in enumerate(self.ledger.robots) if own.is_off]
        committed = self.control.list_committed()
        return build_graph_behind_released(self.plan.scenario, routes, committed, absent)

    def _plan_behind(self, planned: Sequence[int]) -> list[Message]:
        """Plan laps that were added around closures; earlier plans go first.

        If all was planned again with each lap, a robot could be planned behind the others' laps
        each time, and never get there. Earlier plans end with the visits ``planned``.
        """
        robots, closed = self.ledger.robots, self._list_closed_edges()
        rows = zip(robots, self.control.list_committed(), strict=True)
        robots = [replace(self._rest.begin_at_stop(own), released=last) for own, last in rows]
        ends = [
            own.released
            if robot in self._stuck.passed
            else find_last_open(own, last, closed, self._rest.may_stop)
            for robot, (own, last) in enumerate(zip(robots, planned, strict=True))
        ]
        at_ends = [
            replace(own, route=own.route.cut_before(last), arrived=last, released=last)
            for own, last in zip(robots, ends, strict=True)
        ]
        stops = [list_stops_to_make(own, own.released) for own in at_ends]
        more, _ = self._rest.plan(at_ends, ends, stops, closed, [*self._stuck.passed])
        routes = [own.route.cut_before(own.arrived) for own in robots]
        later = 1 + max(
            route.enter[last - route.first] for route, last in zip(routes, ends, strict=True)
        )
        for robot, (route, after) in enumerate(zip(routes, more, strict=True)):
            if not robots[robot].is_off:
                routes[robot] = route.join(after, later)
        graph = self._build_graph(routes)
        if graph.find_rotation():
            raise GaveUp(Fact("robots would rotate"))
        return self.control.splice(routes, graph)

    # --- the rest (splices, rule 10) -------------------------------------------------------------

    def list_stops(self) -> list[list[StopToMake]]:
        """Return the stops that each robot still has to make after its released parts."""
        rows = zip(self.ledger.robots, self.control.list_committed(), strict=True)
        return [list_stops_to_make(own, released) for own, released in rows]

    def replan(
        self,
        stops: Sequence[Sequence[StopToMake]] | None = None,
        *,
        withdrawn: Collection[tuple[int, str]] = (),
        notes: Sequence[Entry] = (),
        placed: Mapping[int, RobotLedger] | None = None,
    ) -> list[Message]:
        """Plan the rest as things are now.

        Parameters
        ----------
        stops
            The stops that each robot still has to make; None for those of the journal.
        withdrawn
            Robot and name of withdrawn jobs.
        notes
            Entries that are committed together with the plan.
        placed
            Robots off the floor, as they begin where they are put.

        Raises
        ------
        GaveUp
            If no plan was found: the old one stands.
        """
        if self.rounds is not None:
            self.control.commit(*notes)
            self.rounds.want()
            return self.rounds.go_on()
        stops = self.list_stops() if stops is None else stops
        messages = self._plan_rest(stops, withdrawn=withdrawn, notes=notes, placed=placed)
        return [*messages, *self._add_laps()]

    def _plan_rest(
        self,
        stops: Sequence[Sequence[StopToMake]],
        *,
        withdrawn: Collection[tuple[int, str]] = (),
        notes: Sequence[Entry] = (),
        placed: Mapping[int, RobotLedger] | None = None,
    ) -> list[Message]:
        ledger, placed = self.ledger, placed or {}
        robots = [placed.get(robot, own) for robot, own in enumerate(ledger.robots)]
        released = self.control.list_committed()
        for robot, own in placed.items():
            released[robot] = own.released
        stuck = [robot for robot in self._stuck.passed if robot not in placed]
        closed = self._list_closed_edges()
        routes, graph = self._rest.plan(robots, released, stops, closed, stuck)
        return self.control.splice(
            routes, graph, withdrawn=withdrawn, notes=notes, placed=[*placed]
        )

    def _list_closed_edges(self) -> set[Edge]:
        """Return the edges that are closed now, by people and by the scenario."""
        self._planned_round = self.closures.list_closed_edges() if self.closures else set()
        return self.ledger.closed_edges | self._planned_round

    def switch(self) -> list[Message]:
        """Exchange rights of way when another order shortens the remaining drive of the fleet.

        A robot that is lost, faulty, on hold or not fit lets others go first, where they can.
        """
        control, ledger = self.control, self.ledger
        if self.rounds is not None:  # each round decides anew
            return []
        better = self._rest.find_better_order(
            ledger.robots, control.list_committed(), control.list_stuck()
        )
        return control.splice(*better) if better else []

    # --- closures of the scenario ----------------------------------------------------------------

    def keep_time(self, read_ticks: Callable[[], int]) -> None:
        """Keep the times of closures and jobs from now on; then call `follow_time` every second.

        Parameters
        ----------
        read_ticks
            Returns the time since the run began [ticks].
        """
        if self.plan.scenario.jobs is not None:
            self._waiting_work = HeldWork(self.plan.scenario, self.control, read_ticks)
            self.control.may_begin = self._waiting_work.may_begin
        if self.rounds is not None:
            self.rounds.watch.read_ticks = read_ticks
        if self.plan.scenario.closures:
            self.closures = ClockedClosures(self.plan.scenario, read_ticks)
        self.control.may_enter = self._may_enter

    def _may_enter(self, robot: int, part: int) -> bool:
        """Return whether a robot is ready, and no closure keeps it from a part."""
        is_ready = self._waiting_work is None or self._waiting_work.may_set_out(robot)
        return is_ready and self.find_closed(robot, part) is None

    def find_closed(self, robot: int, part: int) -> Closed | None:
        """Return when a closure of the scenario keeps a robot from a part; None if none does."""
        if self.closures is None:
            return None
        return self.closures.find_closed(robot, self.ledger.robots[robot], part)

    def find_next_change(self) -> int | None:
        """Return when time alone may let a robot go on [ticks]; None if it lets none."""
        clocks = [clock for clock in (self.closures, self._waiting_work) if clock is not None]
        changes = [clock.find_next_change() for clock in clocks]
        return min((change for change in changes if change is not None), default=None)

    def follow_time(self) -> list[Message]:
        """Release parts that closures of the scenario have kept back, and work that has waited.

        The plan has its times and ways from closures. The rest is replanned where one without an
        end begins, and where one ends that it was planned round.
        """
        if self.rounds is not None:  # closures that begin or end are triggers of rounds
            self.rounds.look()
            return [*self.control.note(), *self._add_laps()]
        if self.closures is None:
            return []
        closed, planned_round = self.closures.list_closed_edges(), self._planned_round
        for_good = self.closures.list_closed_edges(forever=True) - planned_round
        if self._is_led_over(for_good) or not planned_round <= closed:
            return self.replan_if_possible() or []
        return self.control.note()

    # --- robots that do not go on ----------------------------------------------------------------

    def pass_stuck(self) -> list[Message]:
        """Replan round robots that do not go on, if others wait for them; call it every second.

        A robot is passed when it has not been fit, or on hold, for a while. Once it is fit again,
        the rest is replanned with it. Where no plan is found the old one stands, this is reported,
        and it is tried again later.
        """
        if self._is_new:
            self._is_new = False
            self.report(None, True)  # what had failed before a start is not known
            if self._is_led_over(self.ledger.closed_edges):
                return self.replan_if_possible() or []
        stuck = self._stuck.look()
        if self._has_failed and self.rounds is None:
            self._tries_in -= 1
            is_due = self._tries_in <= 0
        else:
            is_due = self._stuck.is_changed(stuck, at_once=self.rounds is not None)
        if not is_due:
            return []
        before = self._stuck.passed
        self._stuck.pass_round(stuck)
        if self.rounds is not None:
            self.rounds.watch.unable = stuck
        messages = self.replan_if_possible()
        if messages is None:
            self._stuck.passed = before & stuck
        return messages or []

    def replan_if_possible(self) -> list[Message] | None:
        """Plan the rest as things are now; where that is not possible, report it, return None."""
        if self.rounds is not None:  # they report themselves
            return self.replan()
        return self._try(self.replan)

    def _is_led_over(self, closed: Collection[Edge]) -> bool:
        """Return whether the way of a robot leads over edges, after its released parts."""
        return any(
            own.route.leads_over(closed, own.released, own.route.end) for own in self.ledger.robots
        )

    def _report_round(self, fact: Fact | None, is_over: bool) -> None:
        """Report once that a round has found no plan, and that one has found one again."""
        if is_over and self._has_failed:
            self.report(Fact("rest replanned"), True)
        elif not is_over and not self._has_failed:
            self.report(fact, False)
        self._has_failed = not is_over

    def _try(self, make_plan: Callable[[], list[Message]]) -> list[Message] | None:
        """Return the messages of a new plan; None where none is found: that is reported once."""
        try:
            messages = make_plan()
        except GaveUp as error:
            self._tries_in = self._patience
            if not self._has_failed:
                self._has_failed = True
                self.report(Fact("no plan of the rest", reason=error.explain().detach()), False)
            return None
        if self._has_failed:
            self._has_failed = False
            self.report(Fact("rest replanned"), True)
        return messages
