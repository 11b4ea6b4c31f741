"""A shift in simulation: jobs become known, rounds plan them, and simulated robots do them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

from rightofway.dispatch.delays import DelayDraws
from rightofway.dispatch.floor import FloorEvent, SimulatedFloor
from rightofway.dispatch.floor_watch import FloorWatch
from rightofway.dispatch.horizon import STOPS_AHEAD
from rightofway.dispatch.pool import Pool, PoolEvent
from rightofway.dispatch.record import JobRecord, RoundRecord, ShiftRecord
from rightofway.dispatch.reveal import Reveal
from rightofway.dispatch.round import RoundPlanner
from rightofway.dispatch.takeover import cap_floor, lift_caps, look_at_floor, splice_round
from rightofway.dispatch.triggers import RETRY, Situation, list_triggers
from rightofway.dispatch.view import Round, StopsLater
from rightofway.facts import Fact
from rightofway.model import NEVER, Closure, Scenario, Tick, UnservedReason
from rightofway.precedence import DelayModel

__all__ = ["ShiftRules", "run_shift"]

MOST_STILL = 3
"""Rounds in a row that find no tour for the jobs that are left, while nothing moves: then a shift
without a time for its end is over."""

MOST_DOUBLED = 3
"""The time of a round is doubled so often at most, each time after the old plan stood, or
after many robots kept their old tours."""

QUIET = 3
"""Looks in a row at which nothing moves are a standstill: the last one may have had a new plan."""

HASTE = 8
"""Every so many rounds half the time is tried again, where planning takes time on the floor: a slow
round costs the fleet less than one that keeps the old plan."""

FOR_GOOD: frozenset[UnservedReason] = frozenset({"latest", "after"})
"""Reasons for which a job leaves the pool: no robot can ever do it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ShiftRules:
    """The rules of a simulated shift.

    Attributes
    ----------
    until
        When it ends at the latest [ticks]; it ends when all jobs are done and nothing moves.
    step
        How far it is from one look at the floor to the next [ticks], positive.
    lead
        How long a round takes on the floor, from its begin to its takeover [ticks]. With 0, robots
        stand still while a round is planned.
    time_limit
        How long a round may take [s]; None for no limit but that of steps.
    seed
        For all that is drawn.
    planner
        The planner where planning around old tracks fails.
    """

    until: Tick | None = None
    step: Tick = field(default=Tick(1))
    lead: Tick = field(default=Tick(0))
    time_limit: float | None = 1.0
    seed: int = 0
    planner: str = "auto"


def run_shift(
    scenario: Scenario,
    reveal: Reveal,
    rules: ShiftRules,
    *,
    delays: DelayModel | None = None,
    report: Callable[[Fact], None] = lambda _: None,
) -> ShiftRecord:
    """Return the record of a shift.

    Parameters
    ----------
    scenario
        A scenario with jobs.
    reveal
        When its jobs become known.
    rules
        How the shift is simulated.
    delays
        How much longer actions take; None for no delays.
    report
        Takes a fact on the progress after each round.
    """
    shift = _Shift(scenario, reveal, rules, delays)
    while not shift.is_over:
        shift.go_on()
        report(shift.describe_progress())
    return shift.make_record()


class _Shift:
    """A shift that goes on from look to look."""

    def __init__(
        self,
        scenario: Scenario,
        reveal: Reveal,
        rules: ShiftRules,
        delays: DelayModel | None,
    ) -> None:
        self._scenario, self._reveal, self._rules = scenario, reveal, rules
        model = delays or DelayModel.none(len(scenario.robots))
        draws = DelayDraws(model, rules.seed, rules.until or NEVER)
        self._floor, self._pool = SimulatedFloor(scenario, draws), Pool()
        self._planner = RoundPlanner(scenario, rules.planner)
        self._now = Tick(0)
        self._jobs: dict[str, JobRecord] = {}
        self._rounds: list[RoundRecord] = []
        self._events: list[PoolEvent] = []
        self._facts: list[tuple[Tick, Fact]] = []
        self._assigned = frozenset[str]()  # jobs in tours of the last round
        self._retry_at = 0  # when a round looks again at jobs without a tour
        self._later: tuple[StopsLater, ...] = ()  # what robots do behind their routes
        self._n_doubled = 0  # how often the time of a round is doubled
        self._n_still = 0  # rounds in a row that began while nothing moved
        self._tried: Situation | None = None  # at the begin of the last round
        self._watch = FloorWatch(self._floor)
        self._closed = [_count_closed(closure, scenario) for closure in scenario.closures]
        self._has_told = False  # whether the standstill that there is has been told
        self._n_quiet = 0  # looks in a row at which nothing moved
        self._begun: tuple[tuple[int, int], ...] = ()  # how far each robot was at the last look

    @property
    def is_over(self) -> bool:
        """Whether the time is over, or nothing moves and no job can be done any more."""
        if self._rules.until is not None and self._now >= self._rules.until:
            return True
        if not self._reveal.is_over or self._floor.events:  # what has happened is not noted yet
            return False
        return self._is_still and (not self._pool.jobs or self._n_still >= MOST_STILL)

    @property
    def _is_still(self) -> bool:
        """Whether no robot has something to do, and none gets fuller."""
        return all(
            own.lost is not None or (own.is_idle and not self._floor.is_charging(robot))
            for robot, own in enumerate(self._floor.robots)
        )

    def go_on(self) -> None:
        """Look at the floor, plan a round if one is due, and let robots drive until the next."""
        self._note_events()
        situation = self._look()
        reasons = tuple(list_triggers(self._tried, situation))
        if not reasons and self._rounds and self._rounds[-1].stands:
            reasons = (Fact("old plan stood"),)
        if not reasons and situation.waiting and self._now >= self._retry_at:
            reasons = (Fact("jobs still wait"),)
        if reasons:
            self._plan_round(situation, reasons)
        self._find_standstill()
        if not reasons or not self._rules.lead:  # else the next round may begin at the takeover
            self._move_on(self._now + self._rules.step)

    def describe_progress(self) -> Fact:
        """Return how far the shift has come."""
        ended = sum(own.ended is not None for own in self._jobs.values())
        return Fact(
            "shift goes on", self._scenario, time=self._now, done=ended, known=len(self._pool.jobs)
        )

    def make_record(self) -> ShiftRecord:
        """Return what has happened, at the last tick, too."""
        self._note_works()
        self._floor.end_charges(self._now)
        return ShiftRecord(
            scenario=self._scenario,
            until=self._now,
            robots=tuple(self._floor.records),
            jobs=self._jobs,
            rounds=tuple(self._rounds),
            events=tuple(self._events),
            facts=tuple(self._facts),
        )

    # --- what happens ----------------------------------------------------------------------------

    def _move_on(self, until: int) -> None:
        if self._rules.until is not None:
            until = min(until, self._rules.until)
        self._floor.advance(until)
        self._now = Tick(until)

    def _note_events(self) -> None:
        """Note what has happened on the floor until now, and which jobs have become known."""
        if self._note_works() or not self._is_still:
            self._n_still = 0
        for job in list(self._reveal.take(self._now)):
            self._jobs[job.name] = JobRecord(job=job, known=self._now)
            self._apply(PoolEvent(kind="job known", at=self._now, name=job.name, job=job))

    def _note_works(self) -> bool:
        """Note the work that has begun and ended until now; return whether there was any."""
        past = [event for event in self._floor.events if event.tick <= self._now]
        self._floor.events = [event for event in self._floor.events if event.tick > self._now]
        for event in sorted(past):
            self._note_work(event)
        return bool(past)

    def _note_work(self, event: FloorEvent) -> None:
        own, tick = self._jobs[event.job], Tick(event.tick)
        if own.begun is None:
            own.robot, own.begun, own.reason = event.robot, tick, None
        self._apply(
            PoolEvent(
                kind="stop done" if event.is_end else "stop begun",
                at=tick,
                name=event.job,
                robot=event.robot,
                stop=event.stop,
            )
        )
        if event.is_end and self._pool.is_over(event.job):
            own.ended = tick
            self._reveal.finish(own.job)

    def _apply(self, event: PoolEvent) -> None:
        if self._pool.apply(event):
            self._events.append(event)

    # --- rounds ----------------------------------------------------------------------------------

    def _look(self) -> Situation:
        """Return what may begin a round."""
        now, jobs = self._now, self._pool.jobs
        self._watch.look(now, jobs)
        waiting = (name for name in jobs.keys() - self._assigned if not jobs[name].is_begun)
        driving = {k: own for k, own in enumerate(self._floor.robots) if own.lost is None}
        cut = {k for k, later in enumerate(self._later) if later}
        return Situation(
            counts=Counter(self._pool.counts),
            waiting=frozenset(waiting),
            free=frozenset(
                k
                for k, own in driving.items()
                if not own.n_steps_left and own.estimate(now) <= now + self._rules.lead
            ).difference(cut),
            ending=frozenset(
                k for k in cut & driving.keys() if driving[k].n_steps_left < STOPS_AHEAD
            ),
            unable=frozenset(
                k for k, own in enumerate(self._floor.robots) if (own.lost or NEVER) <= now
            ),
            closed=frozenset(
                k for k, (begin, end) in enumerate(self._closed) if begin <= now < end
            ),
            outlook=self._watch.outlook,
        )

    def _plan_round(self, situation: Situation, reasons: tuple[Fact, ...]) -> None:
        """Plan a round, and let its plan take over after the lead."""
        rules, begin = self._rules, self._now
        limit = None if rules.time_limit is None else rules.time_limit * 2**self._n_doubled
        takeover = Tick(begin + rules.lead * 2**self._n_doubled)
        self._retry_at = self._now + RETRY * rules.step
        self._n_still = self._n_still + 1 if self._is_still else 0
        jobs = dict(self._pool.jobs)
        view = look_at_floor(self._floor, begin, takeover, jobs, self._later)
        views = [view]
        if not view.is_open and any(own.is_able for own in view.robots):
            views.append(view.ignore_closures())
        for seen in views:
            planned = self._planner.plan(
                seen,
                jobs,
                over=self._pool.left,
                time_limit=limit,
                seed=rules.seed + len(self._rounds),
            )
            if not planned.stands:
                break
        if rules.lead:
            cap_floor(self._floor, view)
            self._move_on(takeover)
        if planned.stands or self._now < takeover:  # at the end of the shift
            lift_caps(self._floor)
            self._n_doubled = min(self._n_doubled + 1, MOST_DOUBLED)
        else:
            if planned.is_hurried:
                self._n_doubled = min(self._n_doubled + 1, MOST_DOUBLED)
            elif not rules.lead or len(self._rounds) % HASTE == 0:
                self._n_doubled = max(0, self._n_doubled - 1) if rules.lead else 0
            splice_round(self._floor, seen, planned, jobs)
            self._note_unserved(planned)
            self._watch.take_over(self._now, jobs)
        self._tried = replace(situation, outlook=self._watch.outlook)
        self._rounds.append(
            RoundRecord(
                begin=begin,
                takeover=takeover,
                seconds=planned.seconds,
                jobs=len(jobs),
                stands=planned.stands,
                facts=planned.facts,
                reasons=reasons,
            )
        )

    def _note_unserved(self, planned: Round) -> None:
        """Note which jobs are in tours now, and why others are not."""
        ahead = {step.job for steps in planned.steps for step in steps if step.job is not None}
        later = {name for stops in planned.later for name, _ in stops}
        self._assigned, self._later = frozenset(ahead | later), planned.later
        for name, reason in planned.unserved:
            self._jobs[name].reason = reason
            if reason in FOR_GOOD:
                event = PoolEvent(kind="job unserved", at=self._now, name=name, reason=reason)
                self._apply(event)
                self._reveal.finish(self._jobs[name].job)

    def _find_standstill(self) -> None:
        """Note once that jobs are known and nothing moves, with the reasons of the last round."""
        robots = self._floor.robots
        is_still = all(own.is_idle or own.lost is not None for own in robots)
        if not (is_still or self._count_quiet() >= QUIET) or not self._pool.jobs:
            self._has_told = False
            return
        if self._has_told:
            return
        self._has_told = True
        last = self._rounds[-1].facts if self._rounds else ()
        why = last or tuple(self._explain_standstill())
        fact = Fact("nothing moves", self._scenario, jobs=len(self._pool.jobs), reasons=why)
        self._facts.append((self._now, fact))

    def _count_quiet(self) -> int:
        """Return the looks in a row at which nothing had begun, and nobody was busy."""
        robots = self._floor.robots
        begun = tuple((own.first, own.n_begun) for own in robots)
        is_busy = any(
            own.lost is None
            and (own.free > self._now or own.waits_until > self._now or self._floor.is_charging(k))
            for k, own in enumerate(robots)
        )
        self._n_quiet = 0 if is_busy or begun != self._begun else self._n_quiet + 1
        self._begun = begun
        return self._n_quiet

    def _explain_standstill(self) -> Iterator[Fact]:
        """Yield why known jobs are not done: their robot is lost, or else the last reasons."""
        lost = {k for k, own in enumerate(self._floor.robots) if own.lost is not None}
        lost &= {own.robot for own in self._pool.jobs.values()}
        for robot in sorted(lost):
            yield Fact("robot does not go on", self._scenario, robot=robot)
        left = (name for name, own in self._pool.jobs.items() if own.robot not in lost)
        for reason in sorted({self._jobs[name].reason or "not found" for name in left}):
            yield Fact(f"unserved {reason}")


def _count_closed(closure: Closure, scenario: Scenario) -> tuple[int, int]:
    """Return when a closure begins and ends [ticks]."""
    count = scenario.problem.clock.count_ticks
    return count(closure.from_), NEVER if closure.until is None else count(closure.until)
