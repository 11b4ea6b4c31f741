"""A plan driven by simulated robots in one process: control, robots and their messages.

All that control and robots say to each other is JSON of VDA 5050, written and read at both ends; it
arrives at once and nothing is lost. Simulated time goes from one step of a robot to the next.
"""

from __future__ import annotations

import heapq
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from rightofway.check import check
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.fleet_control import FleetControl
from rightofway.control.identities import Identity, make_simulated_identities
from rightofway.control.journal import BatchedJournal, Entry, SqliteJournal
from rightofway.control.laps import LapsToDrive
from rightofway.control.ledger import RobotLedger, RouteToDrive
from rightofway.control.notices import Notices, make_notice
from rightofway.control.operator import Operator
from rightofway.control.order_map import OrderMap
from rightofway.control.routes import make_routes_to_drive
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.control.story import Story
from rightofway.errors import InputError
from rightofway.execution import replay
from rightofway.model import ExecutionTrace, Plan, Tick, Track
from rightofway.model.route import drives_along
from rightofway.phrases import Phrase, to_parts

__all__ = ["DemoResult", "drive_demo"]

Report = Callable[[Tick, str], None]

PAUSE = 0.1
"""Seconds between two looks at what people ask for."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DemoResult:
    """What happened when simulated robots drove a plan.

    Attributes
    ----------
    plan
        The plan.
    trace
        Where robots were, and how long each visit and drive took; None of laps, and where people
        have changed what robots were to do.
    jobs
        How many jobs each robot has done.
    laps
        How many laps each robot has made.
    now
        When the run ended [ticks].
    waits
        How often each robot stood at the end of what was released to it, until others had left.
    messages
        How many messages were sent, by the last part of their topic.
    """

    plan: Plan
    trace: ExecutionTrace | None
    jobs: tuple[int, ...]
    laps: tuple[int, ...]
    now: Tick
    waits: tuple[int, ...]
    messages: dict[str, int]

    def as_dict(self) -> dict[str, Any]:
        """Return the result as JSON has it, times in ticks."""
        names = [robot.name for robot in self.plan.scenario.robots]
        robots: list[dict[str, Any]] = [
            {"name": name, "jobs": jobs, "waits": waits}
            for name, jobs, waits in zip(names, self.jobs, self.waits, strict=True)
        ]
        if self.trace is None:
            for row, laps in zip(robots, self.laps, strict=True):
                row["laps"] = laps
        else:
            times = zip(robots, self.plan.completions, self.trace.completion, strict=True)
            for row, planned, completion in times:
                row |= {"planned": int(planned), "completion": completion}
        totals = {"jobs": sum(self.jobs), "messages": self.messages}
        duration = {"ticks": int(self.now)} if self.trace is None else {}
        return {"robots": robots, **totals, **duration}


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
    wait_until: Callable[[Tick], None] = lambda _: None,
    watch: Callable[[Letter], None] = lambda _: None,
    journal: Path | None = None,
    pace: float | None = None,
    stays: bool = False,
) -> DemoResult:
    """Have simulated robots drive a plan by right of way, until all jobs are done.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    delays
        Causes of delay, as for `rightofway.simulate`: what each robot does takes it as long as in
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
        Receives each sentence of the story, with its time.
    wait_until
        Is called before robots do something at a time.
    watch
        Receives each message as it is sent.
    journal
        A new file in which what happens is kept, with the simulated time; pages read it, and people
        ask for more in the table of commands beside it.
    pace
        How many simulated seconds `wait_until` lets pass in one, for pages; None without pauses.
    stays
        With a journal, whether to go on when all robots have come to the end of their way.

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
    repeated = None if laps is None else LapsToDrive(plan)
    durations = _Durations(plan, delays, seed, repeated)
    for name, completion in zip(names, durations.round(0).completion, strict=True):
        if completion is None:
            message = f"{name} would never complete, and a demo ends when all jobs are done"
            raise InputError.at("delays", f"{message} (give delays that end)")
    identities = identities or make_simulated_identities(names, version)
    clock = _SimulatedClock(plan)
    record = None if journal is None else _DemoRecord(journal, clock, pace, stays=stays)
    try:
        control = FleetControl(record.journal if record else _NothingKept())
        dispatcher = Dispatcher(control, plan, repeated)
        demo = _Demo(dispatcher, durations, identities, clock, record, watch=watch, report=report)
        demo.switches = switch
        return demo.run(wait_until, laps)
    finally:
        if record:
            record.close()


class _SimulatedClock:
    """The time of a demo [ticks]."""

    def __init__(self, plan: Plan) -> None:
        clock, seconds = plan.scenario.problem.clock, plan.scenario.units.seconds
        self._tick = float(clock.tick * (seconds or 1))  # [s]
        self.now = 0

    def read_seconds(self) -> float:
        """Return the time [s]."""
        return self.now * self._tick

    def to_ticks(self, seconds: float) -> int:
        """Return a time in ticks, one at least."""
        return max(round(seconds / self._tick), 1)


class _DemoRecord:
    """The journal of a demo, and what people ask for meanwhile."""

    def __init__(
        self, path: Path, clock: _SimulatedClock, pace: float | None, *, stays: bool
    ) -> None:
        self._file = SqliteJournal(path, clock.read_seconds)
        if next(iter(self._file.read_history()), None) is not None:
            self._file.close()
            message = "has a run already, and a demo begins anew (name another file)"
            raise InputError.at(str(path), message)
        self.journal, self.commands = BatchedJournal(self._file), Commands(path)
        self.step = clock.to_ticks(PAUSE * (pace or 1))  # between two looks at what people ask for
        self._pace, self.stays = pace, stays
        self.journal.commit([{"kind": "pace", "seconds": pace}])

    def write(self, entry: Entry) -> None:
        """Write an entry."""
        self.journal.commit([entry])

    def wait(self) -> None:
        """Wait for people where no pause does."""
        if self._pace is None:
            time.sleep(PAUSE)

    def close(self) -> None:
        """Give the files free."""
        self.journal.flush()
        self._file.close()
        self.commands.close()


class _NothingKept:
    """The journal of robots that end with the process: no start would read it."""

    def read_entries(self) -> Iterable[Entry]:
        """Return nothing."""
        return ()

    def commit(self, entries: Iterable[Entry]) -> None:
        """Keep nothing."""

    def begin_again(self, snapshot: Entry) -> None:
        """Keep nothing."""


class _Durations:
    """How long what robots do takes them: as planned, and longer by delays of a seed.

    Each time that robots come to the end of the plan, the next run of the seed has the delays.
    """

    def __init__(
        self, plan: Plan, delays: str | Iterable[str], seed: int, laps: LapsToDrive | None
    ) -> None:
        self._plan, self._delays, self._seed, self._laps = plan, delays, seed, laps
        self._routes, self._roadmap = make_routes_to_drive(plan), plan.scenario.roadmap
        self.round = lru_cache(maxsize=4)(self._round)

    def _round(self, number: int) -> ExecutionTrace:
        return replay(self._plan, self._delays, number, self._seed)

    def stay(self, robot: int, own: RobotLedger, visit: int) -> int:
        """Return how long a robot works and turns in a visit [ticks]."""
        number, planned = self._planned(robot, visit)
        sample, lap = self.round(number).dwell[robot], self._routes[robot]
        more = int(sample[planned]) - sum(lap.get_work(planned))
        if planned == lap.end - 1 and self._laps:  # it goes on, and turns for that
            more += self._plan.scenario.problem.itineraries[robot].stages[-1].turn
        return sum(own.route.get_work(visit)) + max(more, 0)

    def drive(self, robot: int, own: RobotLedger, visit: int) -> int:
        """Return how long a robot drives into a visit [ticks]."""
        number, planned = self._planned(robot, visit)
        sample, lap = self.round(number).drive[robot], self._routes[robot]
        more = int(sample[planned]) - self._ticks(robot, lap, planned) if planned else 0
        return self._ticks(robot, own.route, visit) + max(more, 0)

    def _ticks(self, robot: int, route: RouteToDrive, visit: int) -> int:
        """Return how long the drive into a visit lasts without delays [ticks]."""
        ends = (self._roadmap.get_vertex(route.get_place(at)) for at in (visit - 1, visit))
        itinerary = self._plan.scenario.problem.itineraries[robot]
        return drives_along(self._roadmap, itinerary, list(map(int, ends)))[0]

    def _planned(self, robot: int, visit: int) -> tuple[int, int]:
        """Return the run that has the delays of a visit, and a visit of the plan."""
        if self._laps:
            return self._laps.find_planned_visit(robot, visit)
        return divmod(visit, self._routes[robot].end)


class _Demo:
    """One run."""

    def __init__(
        self,
        dispatcher: Dispatcher,
        durations: _Durations,
        identities: Sequence[Identity],
        clock: _SimulatedClock,
        record: _DemoRecord | None,
        *,
        watch: Callable[[Letter], None],
        report: Report,
    ) -> None:
        plan, control = dispatcher.plan, dispatcher.control
        dispatcher.begin("demo")
        self._plan, self._control, self._watch = plan, control, watch
        self._clock, self._record, self._report = clock, record, report
        maps = [OrderMap(plan.scenario, *numbered) for numbered in enumerate(identities)]
        names = [robot.name for robot in plan.scenario.robots]
        notices = Notices(names, self._tell, keep=record.write if record else lambda _: None)
        self._end = ControlEnd(control, maps, self._timestamp, notices)
        stoppages = durations.round(0).stoppages or ((),) * len(identities)
        self._robots = [
            _DemoRobot(
                RobotEnd(SimulatedRobot(own.route.places[0]), number, identity, self._timestamp),
                partial(durations.stay, number, own),
                partial(durations.drive, number, own),
                stoppages[number],
                times_kept=1 if dispatcher.is_endless else None,
            )
            for number, (own, identity) in enumerate(
                zip(control.ledger.robots, identities, strict=True)
            )
        ]
        self._listens = {topic: robot for robot in self._robots for topic in robot.end.topics}
        self._story = Story(control.ledger, names)
        self._sent = Counter[str]()
        self._dispatcher, self.switches = dispatcher, False

    @property
    def _now(self) -> int:
        return self._clock.now

    def _tell(self, sentence: str) -> None:
        self._report(Tick(self._now), sentence)

    def _timestamp(self) -> str:
        """Return the simulated time as messages have it: a time unit is a second after 1970."""
        seconds = float(self._plan.scenario.problem.clock.time(self._now))
        moment = datetime.fromtimestamp(0, UTC) + timedelta(seconds=seconds)
        return f"{moment:%Y-%m-%dT%H:%M:%S}.{moment.microsecond // 1000:03d}Z"

    def run(self, wait_until: Callable[[Tick], None], laps: int | None) -> DemoResult:
        """Go from step to step until no robot has anything to do, or all laps are made."""
        robots = self._control.ledger.robots
        try:
            for _ in self._steps(wait_until):
                if laps and all(own.laps_done >= laps for own in robots if own.route.end > 1):
                    break
        except KeyboardInterrupt:
            if laps is None:
                raise
        return self._result(is_endless=laps is not None)

    def _steps(self, wait_until: Callable[[Tick], None]) -> Iterator[None]:
        """Have robots do one thing after another, as long as there is something."""
        agenda: list[tuple[int, int]] = []  # when the next step of a robot ends
        self._exchange(self._end.make_letters(self._control.start()))
        while True:
            for number, robot in enumerate(self._robots):
                if not robot.is_busy and (end := robot.begin_step(self._now)) is not None:
                    heapq.heappush(agenda, (end, number))
            if not agenda or agenda[0][0] > self._now:
                self._end_instant()
            if not agenda and not self._waits_for_people:
                return
            moment = agenda[0][0] if agenda else self._now + self._step
            if not self._come_to(moment, wait_until) or not agenda:
                continue
            moment, number = heapq.heappop(agenda)
            self._robots[number].end_step(moment)
            self._exchange([self._robots[number].end.report_state()])
            yield

    @property
    def _waits_for_people(self) -> bool:
        """Whether there may be more to do though no robot does anything."""
        if self._record is None or (self._control.is_done and not self._record.stays):
            return False
        self._record.wait()
        return True

    @property
    def _step(self) -> int:
        return self._record.step if self._record else 0

    def _end_instant(self) -> None:
        """Tell what is new; keep it."""
        for happening in self._story.go_on():
            self._tell(happening.text)
        if self._record:
            self._record.journal.flush()

    def _come_to(self, moment: int, wait_until: Callable[[Tick], None]) -> bool:
        """Let time pass until a moment; return false where people have asked for more before."""
        if moment == self._now:
            return True
        if self.switches:
            self._exchange(self._end.make_letters(self._dispatcher.switch()))
        while self._record and moment > self._now + self._step:
            if self._obey():
                return False
            wait_until(Tick(self._now + self._step))
            self._clock.now += self._step
        wait_until(Tick(moment))
        self._clock.now = moment
        return not self._obey()

    def _obey(self) -> bool:
        """Carry out what people have asked for; return whether there was anything."""
        if self._record is None:
            return False
        messages, answers = Operator(self._dispatcher).obey(self._record.commands)
        if not answers:
            return False
        for _, answer in answers:
            if text := answer["text"]:
                said = text if answer["done"] else Phrase("refused: {reason}", reason=text)
                self._tell(said)
                self._record.write(make_notice(to_parts(said)))
        self._exchange(self._end.make_letters(messages))
        self._end_instant()
        for number, answer in answers:
            self._record.commands.answer(number, answer)
        return True

    def _exchange(self, letters: list[Letter]) -> None:
        """Deliver letters, and all that is answered, in their order."""
        queue = deque(letters)
        while queue:
            letter = queue.popleft()
            self._sent[letter.name] += 1
            self._watch(letter)
            robot = self._listens.get(letter.topic)
            if robot is None:
                queue.extend(self._end.receive(letter))
            else:
                robot.end.receive(letter)
                queue.append(robot.end.report_state())

    def _result(self, *, is_endless: bool) -> DemoResult:
        robots = self._control.ledger.robots
        return DemoResult(
            plan=self._plan,
            trace=None if is_endless or not self._is_as_planned else self._trace(),
            jobs=tuple(own.jobs_done for own in robots),
            laps=tuple(own.laps_done for own in robots),
            now=Tick(self._now),
            waits=tuple(self._story.waits),
            messages=dict(sorted(self._sent.items())),
        )

    @property
    def _is_as_planned(self) -> bool:
        """Whether people have not changed what robots were to do."""
        name = self._plan.scenario.roadmap.name
        return not any(
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


class _DemoRobot:
    """A simulated robot whose steps take time.

    Parameters
    ----------
    end
        The robot with its messages.
    stay, drive_into
        How long work and turning of a visit take, and the drive into it [ticks].
    stoppages
        When it stands still, in order: first tick and length [ticks].
    times_kept
        How many visits have their times kept; None for all.
    """

    def __init__(
        self,
        end: RobotEnd,
        stay: Callable[[int], int],
        drive_into: Callable[[int], int],
        stoppages: tuple[tuple[Tick, Tick | None], ...],
        times_kept: int | None,
    ) -> None:
        self.end, self._stay, self._drive_into, self.stoppages = end, stay, drive_into, stoppages
        self.visit = 0  # the number of the last one
        self.enter = deque([0], times_kept)  # when each visit began
        self.dwell = deque([stay(0)], times_kept)
        self.drive = deque([0], times_kept)
        self.since = 0  # when its last step ended
        self.is_busy = False
        self._left = self.dwell[0]  # what is left of work and turning of this visit

    def begin_step(self, now: int) -> int | None:
        """Begin the next step, if there is one; return when it ends."""
        match self.end.robot.next_step:
            case None:
                return None
            case "arrive":
                lasts = self._drive_into(self.visit + 1)
                self.drive.append(lasts)
            case "begin work":
                lasts = 0
            case "end work" | "begin to drive":
                lasts, self._left = self._left, 0
        self.is_busy = True
        end = now + lasts
        for first, length in self.stoppages:
            assert length is not None, "a demo has no robot that breaks down for ever"
            if first < end and now < first + length:  # the rest of the step comes after it
                end += first + length - max(first, now)
        return end

    def end_step(self, now: int) -> None:
        """End the step."""
        if self.end.robot.next_step == "arrive":
            self.visit += 1
            self._left = self._stay(self.visit)
            self.enter.append(now)
            self.dwell.append(self._left)
        self.end.robot.step()
        self.is_busy, self.since = False, now
