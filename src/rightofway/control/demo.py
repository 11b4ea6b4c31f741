"""A plan driven by simulated robots in one process: control, robots and their messages.

All that control and robots say to each other is JSON of VDA 5050, written and read at both ends; it
arrives at once and nothing is lost. Simulated time goes from one step of a robot to the next.
"""

from __future__ import annotations

import heapq
import math
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from datetime import UTC, datetime, timedelta
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np

from rightofway.check import check
from rightofway.control.demo_record import DemoRecord, NothingKept, SimulatedClock
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.driven_ends import list_driven_jobs
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd, format_timestamp
from rightofway.control.fleet_control import FleetControl
from rightofway.control.identities import Identity, make_simulated_identities
from rightofway.control.laps import LapsToDrive
from rightofway.control.messages import LOOK_AHEAD
from rightofway.control.notices import Notices
from rightofway.control.order_map import make_order_maps
from rightofway.control.simulated_battery import make_simulated_battery
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.control.story import Story
from rightofway.control.supervisor import Supervisor
from rightofway.control.timed_robot import Durations, TimedRobot
from rightofway.errors import InputError
from rightofway.execution.drive_result import DriveResult
from rightofway.facts import Fact
from rightofway.model import ExecutionTrace, Plan, Tick, Track

__all__ = ["drive_demo", "make_pause"]

Report = Callable[[Tick, Fact], None]


def drive_demo(
    plan: Plan,
    delays: str | Iterable[str] = (),
    seed: int = 0,
    *,
    version: str = "2.1.0",
    identities: Sequence[Identity] = (),
    laps: int | None = None,
    switch: bool = False,
    report: Report = lambda *_: None,
    wait_until: Callable[[Fraction], None] = lambda _: None,
    watch: Callable[[Letter], None] = lambda _: None,
    journal: Path | None = None,
    pace: float | None = None,
    stays: bool = False,
    look_ahead: int = LOOK_AHEAD,
) -> DriveResult:
    """Have simulated robots drive a plan by right of way, until all jobs are done.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    delays
        Causes of delay, as for `rightofway.simulate`: each action of a robot takes as long as in
        run 0 of the seed. None may be for ever.
    seed
        Of the delays.
    version
        Of VDA 5050, for all robots.
    identities
        Of the robots; by default made for the version.
    laps
        How many laps of the plan each robot makes at least; 0 for laps without end, until an
        interrupt (Ctrl-C). None: they drive the plan once.
    switch
        Whether rights of way are switched where robots have come so far that another order is
        better.
    report
        Receives each fact of the story, with its time.
    wait_until
        Is called with each moment at which robots do something, and before that, where people may
        ask for more, with moments between [ticks].
    watch
        Receives each message as it is sent.
    journal
        A new file that keeps all events with the simulated time; pages read it, and people
        ask for more in the table of commands beside it.
    pace
        How many simulated seconds `wait_until` lets pass in one, for pages; None without pauses.
    stays
        With a journal, whether to go on when all robots have come to the end of their way.
    look_ahead
        The largest number of edges that are released ahead of a robot.

    Raises
    ------
    InputError
        If the plan has faults or rotations, the delays cannot be read, or a robot would break down
        for ever; with laps, also if robots do not return home; if the journal has a run already.
    """
    judged = check(plan)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be driven)")
    names = [robot.name for robot in plan.scenario.robots]
    repeated = None if laps is None else LapsToDrive(plan, laps)
    durations = Durations(plan, delays, seed, repeated)
    for name, completion in zip(names, durations.round(0).completion, strict=True):
        if completion is None:
            message = f"{name} would never complete, and a demo ends when all jobs are done"
            raise InputError.at("delays", f"{message} (give delays that end)")
    identities = identities or make_simulated_identities(names, version)
    clock = SimulatedClock(plan)
    record = None if journal is None else DemoRecord(journal, clock, pace, stays=stays)
    try:
        control = FleetControl(
            record.journal if record else NothingKept(),
            look_ahead=look_ahead,
            roadmap=plan.scenario.roadmap,
        )
        dispatcher = Dispatcher(control, plan, repeated)
        demo = _Demo(dispatcher, durations, identities, clock, record, watch=watch, report=report)
        demo.switches = switch
        return demo.run(wait_until, laps)
    finally:
        if record:
            record.close()


def make_pause(plan: Plan, time_scale: float) -> Callable[[Fraction], None]:
    """Return a function that waits until a moment of a plan [ticks], for `drive_demo`.

    Parameters
    ----------
    plan
        The plan.
    time_scale
        Seconds of the plan in each second, or its time units where it has no unit; inf for no
        pause.
    """
    tick = float(plan.scenario.problem.clock.tick * (plan.scenario.units.seconds or 1))
    began = time.monotonic()

    def wait_until(moment: Fraction) -> None:
        if time_scale < math.inf:
            planned = float(moment) * tick / time_scale
            time.sleep(max(began + planned - time.monotonic(), 0))

    return wait_until


class _Demo:
    """One run."""

    def __init__(
        self,
        dispatcher: Dispatcher,
        durations: Durations,
        identities: Sequence[Identity],
        clock: SimulatedClock,
        record: DemoRecord | None,
        *,
        watch: Callable[[Letter], None],
        report: Report,
    ) -> None:
        plan, control = dispatcher.plan, dispatcher.control
        dispatcher.begin("demo")
        self._plan, self._control, self._watch = plan, control, watch
        self._clock, self._record, self._report = clock, record, report
        maps = make_order_maps(plan.scenario, identities)
        names = [robot.name for robot in plan.scenario.robots]
        notices = Notices(names, self._write_fact, keep=record.write if record else lambda _: None)
        self._end = ControlEnd(control, maps, self._write_timestamp, notices)
        stoppages = durations.round(0).stoppages or ((),) * len(identities)
        self._robots = [
            TimedRobot(
                RobotEnd(
                    SimulatedRobot(own.route.places[0]),
                    number,
                    identity,
                    self._write_timestamp,
                    make_simulated_battery(plan.scenario, number),
                ),
                plan.scenario,
                partial(durations.stay, number, own),
                partial(durations.drive, number, own),
                stoppages=stoppages[number],
                times_kept=1 if dispatcher.is_endless else None,
            )
            for number, (own, identity) in enumerate(
                zip(control.ledger.robots, identities, strict=True)
            )
        ]
        self._listens = {
            topic: number for number, robot in enumerate(self._robots) for topic in robot.end.topics
        }
        self._story = Story(control.ledger, names)
        self._sent = Counter[str]()
        self._dispatcher, self.switches = dispatcher, False
        self._supervisor = Supervisor(
            dispatcher, notices, lambda: clock.now, record.commands if record else None
        )
        self._moment = Fraction(0)  # the time, perhaps between two ticks
        self._second, self._looks_at = clock.to_ticks(1), Fraction(0)  # after robots
        self._may_begin = set(range(len(self._robots)))  # robots that may have something to do
        self._stamp = (-1, "")  # the last time, and how messages have it

    @property
    def _now(self) -> int:
        return self._clock.now

    def _write_fact(self, fact: Fact) -> None:
        self._report(Tick(self._now), fact)

    def _write_timestamp(self) -> str:
        """Return the simulated time as messages have it: a time unit is a second after 1970."""
        if self._stamp[0] != self._now:
            seconds = float(self._plan.scenario.problem.clock.convert_to_time(self._now))
            moment = datetime.fromtimestamp(0, UTC) + timedelta(seconds=seconds)
            self._stamp = (self._now, format_timestamp(moment))
        return self._stamp[1]

    def run(self, wait_until: Callable[[Fraction], None], laps: int | None) -> DriveResult:
        """Go from step to step until no robot has anything to do."""
        try:
            self._take_steps(wait_until)
        except KeyboardInterrupt:
            if laps is None:
                raise
        return self._make_result(is_endless=laps is not None)

    def _take_steps(self, wait_until: Callable[[Fraction], None]) -> None:
        """Have robots do one thing after another, as long as there is something."""
        agenda: list[tuple[int, int]] = []  # when the next step of a robot ends
        self._deliver(self._end.make_letters(self._control.start()))
        while True:
            for number in sorted(self._may_begin):
                robot = self._robots[number]
                if not robot.is_busy and (end := robot.begin_step(self._now)) is not None:
                    heapq.heappush(agenda, (end, number))
            self._may_begin.clear()
            if not agenda or agenda[0][0] > self._now:
                self._end_instant()
            change = self._find_next_change()
            moments = [*(row[0] for row in agenda[:1]), *(() if change is None else (change,))]
            if not agenda and change is None and not self._waits_for_people:
                if not self._plan_waiting_jobs():
                    return
                continue
            moment = Fraction(min(moments)) if moments else self._moment + self._step
            if not self._wait_for(moment, wait_until):
                continue
            if moment == change:
                charging = [robot for robot in self._robots if robot.end.robot.is_charging]
                self._deliver([robot.report_state(self._now) for robot in charging])
                self._deliver(self._end.make_letters(self._supervisor.take_turn()))
            elif agenda:
                _, number = heapq.heappop(agenda)
                self._end_step(number)

    def _end_step(self, number: int) -> None:
        """End what a robot does, and tell the control."""
        self._robots[number].end_step(self._now)
        self._may_begin.add(number)
        self._deliver([self._robots[number].report_state(self._now)])
        if self._dispatcher.rounds is not None:  # routes may end soon
            self._deliver(self._end.make_letters(self._dispatcher.follow_time()))

    def _find_next_change(self) -> int | None:
        """Return when time may let robots go on [ticks]; None if it lets none."""
        return None if self._control.is_done else self._dispatcher.find_next_change()

    def _plan_waiting_jobs(self) -> bool:
        """Plan jobs that are in no tour; return whether robots get anything to do."""
        rounds = self._dispatcher.rounds
        if rounds is None:
            return False
        messages = self._supervisor.take_turn()
        self._deliver(self._end.make_letters(messages))
        return bool(messages)

    @property
    def _waits_for_people(self) -> bool:
        """Whether there may be more to do though no robot does anything."""
        if self._record is None or (self._control.is_done and not self._record.stays):
            return False
        self._record.wait()
        return True

    @property
    def _step(self) -> Fraction:
        return self._record.step if self._record else Fraction(0)

    def _end_instant(self) -> None:
        """Show new events and keep them."""
        for happening in self._story.go_on():
            self._write_fact(happening.fact)
        self._supervisor.tell_closures()
        if self._record:
            self._record.journal.flush()

    def _wait_for(self, moment: Fraction, wait_until: Callable[[Fraction], None]) -> bool:
        """Let time pass until a moment; return false where something comes before."""
        if moment == self._moment:
            return True
        if self.switches:
            self._deliver(self._end.make_letters(self._dispatcher.switch()))
        while self._moment < moment:
            self._moment = min(self._moment + self._step, moment) if self._record else moment
            wait_until(self._moment)
            self._clock.now = math.floor(self._moment)
            if self._run_supervisor():
                return False
        return True

    def _run_supervisor(self) -> bool:
        """Carry out commands, and look after robots; return whether anything has changed."""
        if self._record is None:
            return False
        messages = self._supervisor.obey()
        while self._looks_at <= self._moment:
            self._looks_at += self._second
            messages = [*messages, *self._supervisor.take_turn()]
            self._record.journal.flush()  # pages show what was reported, also where nobody drives
        is_asked = self._supervisor.has_answers
        if messages or is_asked:
            self._deliver(self._end.make_letters(messages))
            self._end_instant()
            self._supervisor.answer()
        return bool(messages) or is_asked

    def _deliver(self, letters: list[Letter]) -> None:
        """Deliver letters, and all that is answered, in their order."""
        queue = deque(letters)
        while queue:
            letter = queue.popleft()
            self._sent[letter.name] += 1
            self._watch(letter)
            number = self._listens.get(letter.topic)
            if number is None:
                queue.extend(self._end.receive(letter))
            else:
                self._may_begin.add(number)
                self._robots[number].end.receive(letter)
                queue.append(self._robots[number].report_state(self._now))

    def _make_result(self, *, is_endless: bool) -> DriveResult:
        robots = self._control.ledger.robots
        trace = None if is_endless or not self._is_as_planned else self._trace()
        return DriveResult(
            plan=self._plan,
            trace=trace,
            completion=self._list_completions() if trace is None else tuple(trace.completion),
            jobs=self._control.ledger.count_jobs(),
            ends=list_driven_jobs(self._control.ledger, self._plan.scenario, Tick(self._now)),
            laps=tuple(own.laps_done for own in robots),
            now=Tick(self._now),
            waits=tuple(own.waits for own in robots),
            messages=dict(sorted(self._sent.items())),
        )

    def _list_completions(self) -> tuple[Tick | None, ...] | None:
        """Return when robots came to the end of their work of jobs; None for laps."""
        if self._plan.scenario.jobs is None:
            return None
        rows = zip(self._robots, self._control.ledger.robots, strict=True)
        return tuple(Tick(robot.since) if own.is_done else None for robot, own in rows)

    @property
    def _is_as_planned(self) -> bool:
        """Whether robots have done all their work, and people have not changed it."""
        name = self._plan.scenario.roadmap.name
        if self._plan.scenario.jobs is not None:  # robots stay as long as jobs and batteries want
            return False
        return self._control.is_done and not any(
            own.is_off
            or own.route.end != len(track)
            or own.route.places != tuple(map(name, track.vertices.tolist()))[own.route.first :]
            for own, track in zip(self._control.ledger.robots, self._plan.tracks, strict=True)
        )

    def _trace(self) -> ExecutionTrace:
        for own in self._control.ledger.robots:
            assert own.arrived == own.route.end - 1, "a robot has not arrived"
            assert own.finished == own.route.all_jobs, "a job is not done"
        tracks = tuple(
            Track.of(track.vertices.tolist(), list(robot.enter))
            for track, robot in zip(self._plan.tracks, self._robots, strict=True)
        )
        return ExecutionTrace(
            tracks=tracks,
            dwell=tuple(np.array(robot.dwell, np.int64) for robot in self._robots),
            drive=tuple(np.array(robot.drive, np.int64) for robot in self._robots),
            completion=tuple(Tick(robot.since) for robot in self._robots),
            stoppages=tuple(robot.stoppages for robot in self._robots),
        )
