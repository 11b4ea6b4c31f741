"""Rounds while robots drive: begun when there is more to plan, spliced when they are planned.

Until a plan takes over, the old one stands, and no robot gets more than the part that it keeps. A
round that finds no plan changes nothing. Nothing is kept here that is not in the journal, but for
the reasons of the last round: a control that starts again begins a round.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from rightofway.control.fleet_control import FleetControl
from rightofway.control.held_work import list_ready
from rightofway.control.job_events import list_job_ends, list_planned_ends
from rightofway.control.journal import Entry
from rightofway.control.laps import build_graph_behind_released
from rightofway.control.messages import Message
from rightofway.control.round_place import list_lost, make_routes_to_stand, refuse_place
from rightofway.control.round_view import (
    ViewOfRound,
    find_kept_parts,
    make_routes_of_round,
    map_later,
    view_fleet,
)
from rightofway.control.round_watch import RoundWatch
from rightofway.control.round_worker import RoundRequest, Rounds
from rightofway.control.work_items import find_stop
from rightofway.dispatch import PoolEvent, Round
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
    watch
        Looks out for what begins a round.
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
        self.watch = RoundWatch(self._fleet, control, list_ready(scenario))
        self.is_wanted = bool(control.ledger.run)  # a round may have been under way
        self._seen: ViewOfRound | None = None  # of the round that is under way
        self._graph: ReleaseGraph | None = None  # of the plan that it replaces
        self._ignores_closures = False  # of that round
        self._count = 0  # rounds since the start
        self._pause = 0  # calls of `go_on` until the next try after a failure

    @property
    def is_under_way(self) -> bool:
        """Whether a round is planned now."""
        return self._seen is not None

    @property
    def is_over(self) -> bool:
        """Whether nothing is planned, and no more is to plan."""
        return not self.is_wanted and not self.is_under_way and not any(self.watch.later.values())

    def want(self) -> None:
        """Begin a round as soon as none is under way."""
        self.is_wanted, self._pause = True, 0

    def look(self) -> None:
        """Want a round where something asks for one; call it every second."""
        self._pause = max(0, self._pause - 1)
        self.is_wanted |= self.watch.look(forecasts=not self.is_under_way)

    def go_on(self) -> list[Message]:
        """Splice the plan of a round that has ended, and begin the next one; return messages.

        The times of jobs that have ended are noted; call it after each message.
        """
        ledger, now = self._control.ledger, self.watch.read_ticks()
        if ended := [*list_job_ends(ledger, now, self.scenario)]:
            self._control.commit(*ended)
        messages = list[Message]()
        if self._seen is not None:
            planned = self.rounds.poll()
            if planned is None:
                return []
            messages = self._take_over(self._seen, planned)
        if self.is_wanted and not self._pause and self._seen is None and self.rounds.prepare():
            self._begin()
        while self._seen is not None and (planned := self.rounds.poll()) is not None:
            messages += self._take_over(self._seen, planned)
        return messages

    def place(self, robot: int, place: str, notes: Sequence[Entry]) -> list[Message]:
        """Put a robot that was off the floor at a place; a round plans what it does from there.

        Parameters
        ----------
        robot, place
            The number of the robot, and the name of a vertex.
        notes
            Entries that are committed together with the new routes.

        Raises
        ------
        GaveUp
            If another robot is in the way, or no way leads home from there.
        """
        control, ledger = self._control, self._control.ledger
        committed = control.list_committed()
        refuse_place(self.scenario, ledger, committed, robot, place)
        routes, graph = make_routes_to_stand(self.scenario, ledger, committed, robot, place)
        self.want()
        lost = list_lost(ledger, routes)
        messages = control.splice(routes, graph, withdrawn=lost, notes=notes, placed=[robot])
        return [*messages, *self.go_on()]

    def _begin(self, *, ignores_closures: bool = False) -> None:
        """Begin a round; perhaps as if nothing was closed and all robots could drive.

        Then robots wait before what is closed, and behind those that do not go on.
        """
        control, ledger = self._control, self._control.ledger
        if all(own.is_off or k in self.watch.unable for k, own in enumerate(ledger.robots)):
            self.report(Fact("no plan of the rest", reason=Fact("no robot that drives")), False)
            return
        self.watch.begin_round()
        self.is_wanted, self._ignores_closures = False, ignores_closures
        closed = self.watch.list_closed()
        kept_parts = find_kept_parts(
            ledger, control.list_committed(), AHEAD, control.may_stop, closed=closed
        )
        now, lead = self.watch.read_ticks(), 0
        if self.rounds.time_limit is not None:
            seconds = float(self.scenario.problem.clock.tick * (self.scenario.units.seconds or 1))
            lead = int(self.rounds.time_limit / seconds)
        self._seen = seen = view_fleet(
            self.watch.mirror_floor(),
            ledger,
            kept_parts,
            unable=() if ignores_closures else self.watch.unable,
            closed=() if ignores_closures else closed,
            later=self.watch.later,
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
        if planned.stands and not self._ignores_closures and not seen.view.is_open:
            self._begin(ignores_closures=True)
            return []
        if (reason := self._find_reason_to_keep(seen, planned)) is not None:
            return self._keep_old(reason)
        routes = make_routes_of_round(self.scenario, ledger, seen, planned)
        absent = [robot for robot, own in enumerate(ledger.robots) if own.is_off]
        graph = build_graph_behind_released(self.scenario, routes, seen.kept_parts, absent)
        if graph.find_rotation():
            return self._keep_old(Fact("robots would rotate"))
        takeover, moved = seen.view.takeover, list_lost(ledger, routes)
        notes = [*self._list_unserved(planned), *list_planned_ends(ledger, planned, takeover)]
        try:
            messages = control.splice(routes, graph, withdrawn=moved, notes=notes)
        except InputError as error:  # the guard: no round ends the control
            return self._keep_old(error.explain())
        ends = sum(int(track.enter[-1]) for track in planned.tracks)
        self.watch.take_over(map_later(ledger, seen, planned), takeover, ends)
        self._tell_reasons(dict(planned.unserved), planned.postponed)
        self.report(None, True)
        return messages

    def _find_reason_to_keep(self, seen: ViewOfRound, planned: Round) -> Fact | None:
        """Return why the old plan stays valid: there is no other, or it changes nothing.

        Without the second case, rounds that find no route would follow each other without a word.
        """
        if planned.stands:
            reason: Fact = planned.facts[0].values["reason"]
            return reason
        reasons = [fact for fact in planned.facts if fact.kind == "old tours kept"]
        if not reasons or not self._changes_nothing(seen, planned):
            return None
        self._tell_reasons(dict(planned.unserved), planned.postponed)
        return reasons[0]

    def _changes_nothing(self, seen: ViewOfRound, planned: Round) -> bool:
        """Return whether no robot drives by a plan, and each has the work that it had."""
        rows = zip(seen.present, planned.tracks, planned.steps, strict=True)
        for robot, track, steps in rows:
            own = self._control.ledger.robots[robot]
            stops = {(step.job, step.stop) for step in steps if step.job is not None}
            had = set(filter(None, map(find_stop, own.route.all_jobs - own.finished)))
            if len(track) > 1 or own.released < own.route.end - 1 or stops != had:
                return False
        return True

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

    def _keep_old(self, reason: Fact) -> list[Message]:
        """Let the old plan go on, and try again later."""
        self.is_wanted, self._pause = True, PAUSE
        self.watch.keep_old()
        self.report(Fact("no plan of the rest", reason=reason), False)
        return self._control.note()

    def _list_unserved(self, planned: Round) -> list[Entry]:
        """Return entries on jobs that no robot can ever do."""
        roadmap, now = self.scenario.roadmap, Tick(self.watch.read_ticks())
        return [
            PoolEvent(kind="job unserved", at=now, name=name, reason=reason).to_document(roadmap)
            for name, reason in planned.unserved
            if reason in FOR_GOOD
        ]
