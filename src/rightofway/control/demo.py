"""A plan driven by simulated robots in one process: control, robots and their messages.

All that control and robots say to each other is JSON of VDA 5050, written and read at both ends; it
arrives at once and nothing is lost. Simulated time goes from one step of a robot to the next.
"""

from __future__ import annotations

import heapq
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np

from rightofway.check import check
from rightofway.control.endpoints import ControlEnd, Letter, RobotEnd
from rightofway.control.fleet_control import FleetControl
from rightofway.control.identities import Identity, simulated_identities
from rightofway.control.journal import Entry
from rightofway.control.notices import Notices
from rightofway.control.order_map import OrderMap
from rightofway.control.routes import routes_to_drive
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.control.story import Story
from rightofway.errors import InputError
from rightofway.execution import replay
from rightofway.model import ExecutionTrace, Plan, Tick, Track
from rightofway.precedence import ReleaseGraph

__all__ = ["DemoResult", "drive_demo"]

Report = Callable[[Tick, str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class DemoResult:
    """What happened when simulated robots drove a plan.

    Attributes
    ----------
    plan
        The plan.
    trace
        Where robots were, and how long each visit and drive took.
    jobs
        How many jobs each robot has done.
    waits
        How often each robot stood at the end of what was released to it, until others had left.
    messages
        How many messages were sent, by the last part of their topic.
    """

    plan: Plan
    trace: ExecutionTrace
    jobs: tuple[int, ...]
    waits: tuple[int, ...]
    messages: dict[str, int]

    def as_dict(self) -> dict[str, Any]:
        """Return the result as JSON has it, times in ticks."""
        planned, actual = self.plan.completions, self.trace.completion
        robots = [
            {
                "name": robot.name,
                "jobs": jobs,
                "waits": waits,
                "planned": int(expected),
                "completion": completion,
            }
            for robot, jobs, waits, expected, completion in zip(
                self.plan.scenario.robots, self.jobs, self.waits, planned, actual, strict=True
            )
        ]
        return {"robots": robots, "jobs": sum(self.jobs), "messages": self.messages}


def drive_demo(
    plan: Plan,
    delays: str | Iterable[str] = (),
    seed: int = 0,
    *,
    version: str = "2.1.0",
    identities: Sequence[Identity] = (),
    report: Report = lambda *_: None,
    wait_until: Callable[[Tick], None] = lambda _: None,
    watch: Callable[[Letter], None] = lambda _: None,
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
    report
        Receives each sentence of the story, with its time.
    wait_until
        Is called before robots do something at a time.
    watch
        Receives each message as it is sent.

    Raises
    ------
    InputError
        If the plan has faults or rotations, the delays cannot be read, or a robot would break down
        for ever.
    """
    judged = check(plan)
    if not judged.ok:
        raise InputError.at("", f"the plan has {judged.summary} (only one without can be driven)")
    durations = replay(plan, delays, 0, seed)
    names = [robot.name for robot in plan.scenario.robots]
    for name, completion in zip(names, durations.completion, strict=True):
        if completion is None:
            message = f"{name} would never complete, and a demo ends when all jobs are done"
            raise InputError.at("delays", f"{message} (give delays that end)")
    control = FleetControl(_NothingKept())
    identities = identities or simulated_identities(names, version)
    return _Demo(plan, durations, control, identities, watch=watch, report=report).run(wait_until)


class _NothingKept:
    """The journal of robots that end with the process: no start would read it."""

    def entries(self) -> Iterable[Entry]:
        """Return nothing."""
        return ()

    def commit(self, entries: Iterable[Entry]) -> None:
        """Keep nothing."""

    def begin_again(self, snapshot: Entry) -> None:
        """Keep nothing."""


class _Demo:
    """One run."""

    def __init__(
        self,
        plan: Plan,
        durations: ExecutionTrace,
        control: FleetControl,
        identities: Sequence[Identity],
        *,
        watch: Callable[[Letter], None],
        report: Report,
    ) -> None:
        routes = routes_to_drive(plan)
        control.begin("demo", routes, ReleaseGraph.of(plan.scenario, plan.tracks))
        self._plan, self._control, self._watch = plan, control, watch
        self._now, self._report = 0, report
        maps = [OrderMap(plan.scenario, *numbered) for numbered in enumerate(identities)]
        names = [robot.name for robot in plan.scenario.robots]
        notices = Notices(names, lambda sentence: self._report(Tick(self._now), sentence))
        self._end = ControlEnd(control, maps, self._timestamp, notices)
        self._robots = [
            _DemoRobot(
                RobotEnd(SimulatedRobot(route.places[0]), number, identity, self._timestamp),
                durations.dwell[number].tolist(),
                durations.drive[number].tolist(),
                durations.stoppages[number] if durations.stoppages else (),
            )
            for number, (route, identity) in enumerate(zip(routes, identities, strict=True))
        ]
        self._listens = {topic: robot for robot in self._robots for topic in robot.end.topics}
        self._story = Story(control.ledger, names)
        self._sent = Counter[str]()

    def _timestamp(self) -> str:
        """Return the simulated time as messages have it: a time unit is a second after 1970."""
        seconds = float(self._plan.scenario.problem.clock.time(self._now))
        moment = datetime.fromtimestamp(0, UTC) + timedelta(seconds=seconds)
        return f"{moment:%Y-%m-%dT%H:%M:%S}.{moment.microsecond // 1000:03d}Z"

    def run(self, wait_until: Callable[[Tick], None]) -> DemoResult:
        """Go from step to step until no robot has anything to do."""
        agenda: list[tuple[int, int]] = []  # when the next step of a robot ends
        self._exchange(self._end.letters(self._control.start()))
        while True:
            for number, robot in enumerate(self._robots):
                if not robot.is_busy and (end := robot.begin_step(self._now)) is not None:
                    heapq.heappush(agenda, (end, number))
            if not agenda or agenda[0][0] > self._now:
                for sentence in self._story.go_on():
                    self._report(Tick(self._now), sentence)
            if not agenda:
                return self._result()
            moment, number = heapq.heappop(agenda)
            if moment > self._now:
                wait_until(Tick(moment))
            self._now = moment
            self._robots[number].end_step(moment)
            self._exchange([self._robots[number].end.state()])

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
                queue.append(robot.end.state())

    def _result(self) -> DemoResult:
        for own in self._control.ledger.robots:
            assert own.arrived == own.route.end - 1, "a robot has not arrived"
            assert own.finished == own.route.all_jobs(), "a job is not done"
        tracks = tuple(
            Track.of(track.vertices.tolist(), robot.enter)
            for track, robot in zip(self._plan.tracks, self._robots, strict=True)
        )
        trace = ExecutionTrace(
            tracks=tracks,
            dwell=tuple(np.array(robot.dwell, np.int64) for robot in self._robots),
            drive=tuple(np.array(robot.drive, np.int64) for robot in self._robots),
            completion=tuple(Tick(robot.since) for robot in self._robots),
            stoppages=tuple(robot.stoppages for robot in self._robots),
        )
        return DemoResult(
            plan=self._plan,
            trace=trace,
            jobs=tuple(own.jobs_done for own in self._control.ledger.robots),
            waits=tuple(self._story.waits),
            messages=dict(sorted(self._sent.items())),
        )


class _DemoRobot:
    """A simulated robot whose steps take time.

    Parameters
    ----------
    end
        The robot with its messages.
    dwell, drive
        How long work and turning of each visit take, and the drive into it [ticks].
    stoppages
        When it stands still, in order: first tick and length [ticks].
    """

    def __init__(
        self,
        end: RobotEnd,
        dwell: list[int],
        drive: list[int],
        stoppages: tuple[tuple[Tick, Tick | None], ...],
    ) -> None:
        self.end, self.dwell, self.drive, self.stoppages = end, dwell, drive, stoppages
        self.enter = [0]  # when each visit began
        self.since = 0  # when its last step ended
        self.is_busy = False
        self._left = dwell[0]  # what is left of work and turning of this visit

    def begin_step(self, now: int) -> int | None:
        """Begin the next step, if there is one; return when it ends."""
        match self.end.robot.next_step:
            case None:
                return None
            case "arrive":
                lasts = self.drive[len(self.enter)]
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
            self._left = self.dwell[len(self.enter)]
            self.enter.append(now)
        self.end.robot.step()
        self.is_busy, self.since = False, now
