"""A control at a broker: receives messages, decides, commits once, then sends; for ever.

The connection may come and go. After each one robots are asked for their states, and each message
that is not acknowledged is sent again.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import secrets
import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from datetime import datetime
from typing import TYPE_CHECKING

from rightofway.control.broker import Broker, check_cancellation
from rightofway.control.commands import Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.driven_ends import list_driven_jobs
from rightofway.control.endpoints import ControlEnd, Letter, make_timestamp
from rightofway.control.fleet_control import FleetControl
from rightofway.control.identities import Identity
from rightofway.control.joins import Joins, grow_identities, grow_plan
from rightofway.control.journal import BatchedJournal, Entry, Journal, JournalFailed
from rightofway.control.laps import LapsToDrive
from rightofway.control.messages import LOOK_AHEAD, Message
from rightofway.control.notices import EVERY_KIND, Notices
from rightofway.control.order_map import OrderMap, make_order_maps
from rightofway.control.round_worker import ProcessRounds
from rightofway.control.story import Story
from rightofway.control.supervisor import Supervisor
from rightofway.errors import InputError
from rightofway.execution.drive_result import DriveResult
from rightofway.facts import Fact
from rightofway.io import format_plan
from rightofway.model import Plan, Tick
from rightofway.units import write_start

if TYPE_CHECKING:
    import aiomqtt

    from rightofway.control.metrics import FleetMetrics

__all__ = ["Driver"]

REMIND = 1.0
"""Seconds between two reminders of what is not acknowledged."""

SILENCE = 35.0
"""Seconds without a state after which a robot is lost: it has to send one every 30 seconds."""

BROKER, JOURNAL = "broker", "journal"
"""Kinds of trouble that are not of a robot."""

LONGEST_TURN = 30.0
"""Seconds without a turn or a try to connect after which the control is not alive."""

RETRY = (0.2, 5.0)
"""Seconds until the next try to connect: the first time, and at most."""


class Driver:
    """A plan that is driven by robots at a broker.

    Parameters
    ----------
    plan
        A plan that keeps the rules.
    identities
        The robots, in the order of the plan.
    journal
        Empty, or of an earlier start with the same plan and identities.
    laps
        How often each robot makes the laps of the plan, 0 for ever; None: the plan is driven once.
    commands
        Where people ask for more: jobs, closures, holds.
    switch
        Whether rights of way are switched where robots have come so far that another order is
        better.
    report
        Receives each fact of the story, and of trouble.
    alarm
        Receives trouble that begins, in place of `report`.
    watch
        Receives each message, and whether it was sent.
    metrics
        Counts messages and robots, if that is wanted.
    began
        When the run began, as the clock of the machine has it [s]: closures of the scenario count
        from then on; None for now.
    look_ahead
        The largest number of edges that are released ahead of a robot.

    Attributes
    ----------
    is_stopped
        Whether the run was ended by `stop`.

    Raises
    ------
    InputError
        If robots of the plan move round a circle at one instant, or the journal is of another plan
        or other identities; with laps, also if robots do not return home.
    """

    def __init__(
        self,
        plan: Plan,
        identities: Sequence[Identity],
        journal: Journal,
        *,
        laps: int | None = None,
        commands: Commands | None = None,
        switch: bool = False,
        report: Callable[[Fact], None],
        alarm: Callable[[Fact], None] | None = None,
        watch: Callable[[Letter, bool], None] | None = None,
        metrics: FleetMetrics | None = None,
        began: float | None = None,
        look_ahead: int = LOOK_AHEAD,
    ) -> None:
        self._given, self._journal = (plan, identities), BatchedJournal(journal)
        self._report, self._alarm, self._watch, self._metrics = report, alarm, watch, metrics
        self._laps, self._commands, self._look_ahead = laps, commands, look_ahead
        self._task: asyncio.Task[None] | None = None  # of the run
        self.is_stopped, self._is_connected = False, False
        self._turned = time.monotonic()  # when the last turn began, or a connection failed
        start = plan.scenario.units.start  # without an offset in the zone of this machine
        begin = None if start is None else start.timestamp()
        self._began = next(given for given in (began, begin, time.time()) if given is not None)
        self._tick = float(plan.scenario.problem.clock.tick * (plan.scenario.units.seconds or 1))
        self._switches = switch
        self._digest = _compute_digest(plan, make_order_maps(plan.scenario, identities))
        self._inbox: dict[str, tuple[float, Letter]] = {}  # the latest of each topic
        self._outbox: list[Letter] = []
        self._news = asyncio.Event()
        self._fails = False
        self._sent = Counter[str]()  # messages of both sides
        self._ends: dict[int, Tick] = {}  # when robots came to the end of their routes
        self._build(begin)

    def _build(self, begin: float | None = None) -> None:
        """Build all that depends on the fleet, of the plan and of the robots that have joined."""
        plan, identities = self._given
        names, scenario = [robot.name for robot in plan.scenario.robots], plan.scenario
        self.control = FleetControl(
            self._journal, look_ahead=self._look_ahead, report=self._report_on,
            roadmap=scenario.roadmap,
        )  # fmt: skip
        ledger = self.control.ledger
        if ledger.run and not ledger.run.startswith(f"{self._digest}-"):
            message = "is of another plan, or of other identities (give those, or another journal)"
            raise InputError.at("journal", message)
        if ledger.grows:
            self.control.commit({"kind": "fleet grown"})
        if ledger.joined:
            plan = grow_plan(plan, ledger.joined.values())
            identities = grow_identities(names, identities, ledger.joined.values())
            names = [*ledger.names]
        self._plan = plan
        self._notices = Notices(names, self._report, keep=self._keep, alarm=self._alarm)
        laps = None if self._laps is None else LapsToDrive(plan, self._laps)
        rounds = None if scenario.jobs is None else ProcessRounds()
        self._dispatcher = Dispatcher(self.control, plan, laps, rounds=rounds)
        joins = None if rounds is None else Joins(*self._given, self._dispatcher)
        self._supervisor = Supervisor(
            self._dispatcher, self._notices, self._read_ticks, self._commands, joins
        )
        self.operator = self._supervisor.operator
        if not ledger.run:
            self._begin(begin)
        else:  # trouble of before is reported again if it lasts
            self._notices.report(None, EVERY_KIND, is_over=True)
        maps = make_order_maps(plan.scenario, identities)
        self.end = ControlEnd(self.control, maps, make_timestamp, self._notices)
        self._story = Story(ledger, names)
        self._heard = [time.monotonic()] * len(names)
        if self._metrics is not None:
            self._metrics.take_names(names)

    def _begin(self, begin: float | None) -> None:
        """Give the plan to an empty journal."""
        self._dispatcher.begin(f"{self._digest}-{secrets.token_hex(4)}", begin)
        start = self._plan.scenario.units.start
        if start is not None:
            now = datetime.now(start.tzinfo).replace(microsecond=0)
            self._report(Fact("clock of run", start=write_start(start), now=write_start(now)))
        self._journal.flush()

    def _build_again(self) -> None:
        """Build all anew with the robots that have joined, as a start after a kill does."""
        self._journal.begin_again(self.control.ledger.make_snapshot())  # it counts waits, too
        if self._flush():
            self._close_rounds()
            self._build()

    def _close_rounds(self) -> None:
        if self._dispatcher.rounds is not None:
            self._dispatcher.rounds.rounds.close()

    def _report_on(self, robot: int, fact: Fact) -> None:
        """Report a fact about a robot."""
        self._notices.report_on(robot, fact)

    def _keep(self, entry: Entry) -> None:
        """Write the messages to people into the journal."""
        self._journal.commit([entry])

    async def run(self, broker: Broker, *, stays: bool = False) -> None:
        """Drive over any number of connections, until robots are at the ends of their ways.

        Parameters
        ----------
        broker
            Where robots are.
        stays
            Whether to go on for ever.
        """
        self._task = asyncio.current_task()
        try:
            await self._run(broker, stays=stays)
        except asyncio.CancelledError:
            if not self.is_stopped:
                raise
        finally:
            if self.is_stopped:
                self._notices.report(Fact("control ended"))
                self._flush()
            self._close_rounds()

    def stop(self) -> None:
        """End the run in order: nothing more is released, and the journal is whole.

        A turn that has begun is committed and sent to its end. Robots drive to the end of their
        released parts; the next start with the same journal goes on.
        """
        self.is_stopped = True
        self._news.set()
        if not self._is_connected and self._task is not None:
            self._task.cancel()  # it waits for a broker: there is no turn to end

    def report_health(self) -> dict[str, bool | float]:
        """Return whether the control is alive and ready, with the reasons.

        It is alive if its last turn, or its last try to connect, is not long ago; it is ready if it
        is connected to the broker and the journal can be written. Any thread may call it.
        """
        age = time.monotonic() - self._turned
        return {
            "alive": age < LONGEST_TURN,
            "ready": age < LONGEST_TURN and self._is_connected and not self._fails,
            "broker": self._is_connected,
            "journal": not self._fails,
            "seconds": round(age, 3),
        }

    async def _run(self, broker: Broker, *, stays: bool) -> None:
        import aiomqtt

        wait, is_lost = RETRY[0], False
        while (stays or not self.is_done) and not self.is_stopped:
            try:
                async with broker.open_client("rightofway", takes_latest=True) as client:
                    connected = Fact("broker connected", broker=broker.address)
                    self._notices.report(connected, BROKER, is_over=True)
                    wait, is_lost, self._is_connected = RETRY[0], False, True
                    while await self._serve(client, stays=stays):
                        self._build_again()
            except* aiomqtt.MqttError as errors:
                self._is_connected, self._turned = False, time.monotonic()
                if not is_lost:
                    reason = str(errors.exceptions[0])
                    lost = Fact("broker lost", broker=broker.address, reason=reason)
                    self._notices.report(lost, BROKER)
                    self._flush()
                is_lost = True
                await asyncio.sleep(wait)
                wait = min(2 * wait, RETRY[1])

    @property
    def is_done(self) -> bool:
        """Whether robots have come to the end of their way, or of all laps that are wanted.

        With jobs, no round is wanted or under way any more, too.
        """
        rounds = self._dispatcher.rounds
        return self.control.is_done and (rounds is None or rounds.is_over)

    def _read_ticks(self) -> Tick:
        """Return the time since the run began; 0 before the start of the scenario."""
        return Tick(max(int((time.time() - self._began) / self._tick), 0))

    @property
    def result(self) -> DriveResult:
        """The result so far; messages and ends are those since the start."""
        robots, now = self.control.ledger.robots, self._read_ticks()
        ends = tuple(map(self._ends.get, range(len(robots))))
        return DriveResult(
            plan=self._plan,
            trace=None,
            completion=ends if self._laps is None else None,
            jobs=self.control.ledger.count_jobs(),
            ends=list_driven_jobs(self.control.ledger, self._plan.scenario, now),
            laps=tuple(own.laps_done for own in robots),
            now=now,
            waits=tuple(own.waits for own in robots),
            messages=dict(sorted(self._sent.items())),
        )

    def send(self, messages: Iterable[Message]) -> None:
        """Send messages of the control in the next turn.

        Parameters
        ----------
        messages
            The result of a call of the control.
        """
        self._outbox += self.end.make_letters(messages)
        self._news.set()

    async def _serve(self, client: aiomqtt.Client, *, stays: bool) -> bool:
        """Take turns as long as the connection lasts; return whether a robot has joined."""
        self._inbox.clear()
        self._outbox.clear()
        await client.subscribe(
            [(topic, int(topic.endswith("/connection"))) for topic in self.end.topics]
        )
        check_cancellation()
        self._heard = [time.monotonic()] * len(self._heard)
        async with asyncio.TaskGroup() as tasks:
            reader = tasks.create_task(self._read(client))
            begun = [*self._supervisor.obey(), *self.control.start()]  # a hold counts at once
            fresh = [*self.end.make_letters(begun), *self.end.ask_for_factsheets()]
            await self._turn(client, fresh)
            reminded = time.monotonic()
            while (stays or not self.is_done) and not self.is_stopped and not self._has_joined:
                try:
                    async with asyncio.timeout(max(reminded + REMIND - time.monotonic(), 0)):
                        await self._news.wait()
                    fresh = []
                except TimeoutError:
                    reminded, fresh = (
                        time.monotonic(),
                        [*self._run_round(), *self._list_reminders()],
                    )
                if self.is_stopped:
                    break
                self._news.clear()
                await self._turn(client, fresh)
            reader.cancel()
        return self._has_joined and not self.is_stopped

    @property
    def _has_joined(self) -> bool:
        """Whether a robot has joined that is on the disk, and is not in the fleet yet."""
        return self.control.ledger.grows and not self._fails

    async def _read(self, client: aiomqtt.Client) -> None:
        async for message in client.messages:
            payload = message.payload if isinstance(message.payload, bytes) else b""
            letter = Letter(str(message.topic), payload)
            self._inbox[letter.topic] = (time.perf_counter(), letter)
            self._news.set()

    def _run_round(self) -> list[Letter]:
        """Keep closures, pass robots that are stuck, switch rights of way, carry out commands."""
        changes = self._supervisor.take_turn()
        if self._switches:
            changes = [*changes, *self._dispatcher.switch()]
        return self.end.make_letters([*changes, *self._supervisor.obey()])

    def _list_reminders(self) -> list[Letter]:
        """Return the messages to send again; robots that are silent are lost."""
        if self._metrics is not None:
            self._metrics.survey(self.control)
        letters = self.end.make_letters(self.control.remind())
        now = time.monotonic()
        for robot, heard in enumerate(self._heard):
            if now - heard > SILENCE:
                why = Fact("silent", seconds=SILENCE)
                letters += self.end.connect(robot, is_connected=False, why=why)
        return letters

    async def _turn(self, client: aiomqtt.Client, fresh: list[Letter]) -> None:
        """Take in all messages; commit the consequences, once; then send them."""
        inbox, self._inbox = [*self._inbox.values()], {}
        self._turned = time.monotonic()
        self._outbox += fresh
        for _, letter in inbox:
            robot = self.end.find_robot(letter.topic)
            if robot is None:
                continue
            self._outbox += self.end.receive(letter)
        for robot in self.end.take_heard():
            self._heard[robot] = time.monotonic()
        if not self._flush():
            return
        self._supervisor.answer()
        sent, self._outbox = self._outbox, []
        # All go to the client at once and in their order; then their sending is awaited together.
        await asyncio.gather(
            *(client.publish(letter.topic, letter.payload, qos=0) for letter in sent)
        )
        check_cancellation()
        self._sent.update(letter.name for letter in (*(row[1] for row in inbox), *sent))
        if self._watch is not None:
            for _, letter in inbox:
                self._watch(letter, False)
            for letter in sent:
                self._watch(letter, True)
        self._report_story()
        if self._metrics is not None:
            waits = [own.waits for own in self.control.ledger.robots]
            self._metrics.turn(inbox, sent, waits)

    def _report_story(self) -> None:
        """Report what is new, and keep when robots came to the end of their routes."""
        for happening in self._story.go_on():
            self._report(happening.fact)
            if happening.kind == "end":
                self._ends[happening.robot] = self._read_ticks()
            else:
                self._ends.pop(happening.robot, None)  # it was given more to do

    def _flush(self) -> bool:
        """Bring the journal to the disk; return whether that was possible."""
        try:
            self._journal.flush()
        except JournalFailed as error:
            if not self._fails:
                self._notices.report(Fact("journal lost", error=str(error)), JOURNAL)
            self._fails = True
            return False
        if self._fails:
            self._notices.report(Fact("journal written"), JOURNAL, is_over=True)
        self._fails = False
        return True


def _compute_digest(plan: Plan, maps: Sequence[OrderMap]) -> str:
    """Return a name of all that decides on the content of orders."""
    document = json.dumps([order_map.to_document() for order_map in maps], sort_keys=True)
    return hashlib.sha256(f"{format_plan(plan)}\n{document}".encode()).hexdigest()[:12]
