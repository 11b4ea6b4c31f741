"""Simulated robots at a broker: hundreds in one process, each with a connection of its own.

They read how long and how fast an edge is from their orders, as real robots do, and drive on while
their connection is broken. By a seed they are late, stop, report errors, lose their connections and
forget their orders.
"""

from __future__ import annotations

import asyncio
import contextlib
import random
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from socket import SHUT_RDWR
from typing import TYPE_CHECKING, Any

from rightofway.control.broker import Broker, check_cancellation
from rightofway.control.endpoints import Letter, RobotEnd, make_timestamp
from rightofway.control.identities import Identity
from rightofway.control.messages import Condition, RobotError
from rightofway.control.order_map import OrderLane
from rightofway.control.simulated_battery import make_simulated_battery
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.control.stop_actions import is_further_action
from rightofway.errors import InputError, quote
from rightofway.model import Plan, Scenario

if TYPE_CHECKING:
    import aiomqtt

__all__ = ["TROUBLES", "Trouble", "parse_troubles", "run_robots"]

TROUBLES = {
    "late": "each drive and each work lasts longer, on average by this share",
    "stop": "the share of drives in which the robot stands for a while",
    "error": "the share of drives in which it stands and reports an error",
    "offline": "the share of drives in which its connection breaks for a while",
    "reset": "the share of places at which it forgets its order",
}
"""Kinds of trouble that simulated robots can have."""

WHILE = 10.0
"""Mean duration of trouble [s of robot time]."""

STATES = 1.0
"""Seconds between two states of a robot in which nothing happens."""

Trouble = Mapping[str, float]
"""Kinds of `TROUBLES` with their shares."""


def parse_troubles(texts: Iterable[str]) -> dict[str, float]:
    """Return kinds of trouble that a user wrote as ``kind:share``.

    Parameters
    ----------
    texts
        Such as ``stop:0.02``.

    Raises
    ------
    InputError
        If a kind is unknown, or its share is not one.
    """
    troubles = {}
    for text in texts:
        kind, _, share = text.partition(":")
        try:
            value = float(share)
        except ValueError:
            value = -1.0
        if kind not in TROUBLES or not 0 <= value <= (100 if kind == "late" else 1):
            known = ", ".join(TROUBLES)
            message = f"{quote(text)} is no trouble (give kind:share; kinds are {known})"
            raise InputError.at("trouble", message)
        troubles[kind] = value
    return troubles


@dataclass(slots=True, kw_only=True)
class _NetworkRobot:
    """A robot at a broker.

    Attributes
    ----------
    end
        The robot with its messages.
    identity
        As messages name it.
    scenario
        Of the plan.
    works
        How long work lasts at places [s of robot time].
    time_scale
        Seconds of robot time in a second.
    draw
        Draws its trouble.
    trouble
        Possible faults.
    """

    end: RobotEnd
    identity: Identity
    scenario: Scenario
    works: Mapping[str, float]
    time_scale: float
    draw: random.Random
    trouble: Trouble
    asked: asyncio.Event = field(default_factory=asyncio.Event)  # something came for it
    changed: asyncio.Event = field(default_factory=asyncio.Event)  # a state is due
    client: aiomqtt.Client | None = None
    offline: float = 0.0  # how long it is to stay away [s of robot time]

    async def pause(self, seconds: float) -> None:
        """Wait for some seconds of robot time."""
        await asyncio.sleep(seconds / self.time_scale)

    def happens(self, kind: str) -> bool:
        """Return whether trouble of a kind happens now."""
        return self.draw.random() < self.trouble.get(kind, 0.0)

    def draw_while(self) -> float:
        """Return how long trouble lasts [s of robot time]."""
        return self.draw.expovariate(1 / WHILE)

    async def carry_out_orders(self) -> None:
        """Carry out orders, one step after the other, connected or not."""
        robot = self.end.robot
        while True:
            step = robot.next_step
            if step is None:
                await self.asked.wait()
                self.asked.clear()
                continue
            if step == "begin to drive":
                await self.have_trouble()
            lane = self.find_lane() if step == "arrive" else None
            await self.pause(self.draw_duration())
            if lane is not None and self.end.battery is not None:
                metre = float(self.scenario.units.metres or 1)
                self.end.battery.drive(lane.length / metre)
            if robot.step():
                self.changed.set()
            if step == "arrive" and self.happens("reset") and robot.forget():
                self.changed.set()

    def find_lane(self) -> OrderLane | None:
        """Return the lane to the next node, as the order has it."""
        robot = self.end.robot
        return self.end.lanes.get((robot.place, robot.ahead[0].place))

    async def use_battery(self) -> None:
        """Let the battery fall, or rise in a charge, as time passes."""
        robot, battery = self.end.robot, self.end.battery
        second = float(self.scenario.units.seconds or 1)
        while battery is not None:
            await self.pause(STATES)
            works = robot.next_step == "end work"
            battery.pass_time(STATES / second, is_charging=robot.is_charging, works=works)

    def draw_duration(self) -> float:
        """Return how long the next step lasts [s of robot time]."""
        robot = self.end.robot
        match robot.next_step:
            case "arrive":
                lane = self.find_lane()
                lasts = 1.0 if lane is None else lane.length / lane.max_speed
            case "end work" if is_further_action(robot.next_action or ""):
                return 0.0  # the first action of a stop takes its whole time
            case "end work" if robot.next_action not in robot.charging:
                lasts = self.works.get(robot.place, max(self.works.values(), default=0.0))
            case _:
                return 0.0
        late = self.trouble.get("late", 0.0)
        return lasts * (1 + (self.draw.expovariate(1 / late) if late else 0.0))

    async def have_trouble(self) -> None:
        """Have trouble before a drive, perhaps."""
        if self.happens("offline") and self.client is not None:
            self.offline = self.draw_while()
            if hang_up := self.client._client.socket():  # noqa: SLF001 (a cable that is cut)
                with contextlib.suppress(OSError):
                    hang_up.shutdown(SHUT_RDWR)  # type: ignore[attr-defined]
        if self.happens("stop"):
            await self.pause(self.draw_while())
        if self.happens("error"):
            error = RobotError(kind="obstacle", level="FATAL", description="the way is blocked")
            self.end.condition = replace(self.end.condition, errors=(error,))
            self.changed.set()
            await self.pause(self.draw_while())
            self.end.condition = Condition()
            self.changed.set()

    async def connect(self, broker: Broker, arrivals: _Arrivals) -> None:
        """Keep a connection: listen to orders, send states."""
        import aiomqtt

        will = self.end.report_connection("CONNECTION_BROKEN")
        while True:
            try:
                async with broker.open_client(self.identity.serial_number, will) as client:
                    self.client = client
                    await client.subscribe([(topic, 0) for topic in self.end.topics])
                    await _publish(client, self.end.report_connection("ONLINE"))
                    arrivals.note(self.identity.serial_number)
                    async with asyncio.TaskGroup() as tasks:
                        tasks.create_task(self.speak(client))
                        await self.listen(client)  # not as a task: see check_cancellation
            except* aiomqtt.MqttError as errors:
                self.client = None
                arrivals.note_failure(self.identity.serial_number, errors.exceptions[0])
            await self.pause(self.offline)
            await asyncio.sleep(STATES * self.draw.random())  # not all at once
            self.offline = 0.0

    async def listen(self, client: aiomqtt.Client) -> None:
        """Take in messages."""
        async for message in client.messages:
            payload = message.payload if isinstance(message.payload, bytes) else b""
            with contextlib.suppress(InputError):  # real robots report what they cannot read
                for letter in self.end.receive(Letter(str(message.topic), payload)):
                    await _publish(client, letter)
            self.asked.set()
            self.changed.set()

    async def speak(self, client: aiomqtt.Client) -> None:
        """Send the state when something happens, and every now and then."""
        while True:
            self.changed.clear()
            await _publish(client, self.end.report_state())
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(STATES):
                    await self.changed.wait()


@dataclass(slots=True, kw_only=True)
class _Arrivals:
    """Which robots have not been connected yet; a connection that is lost later is trouble."""

    missing: set[str]
    is_up: Callable[[], None]
    on_failure: Callable[[BaseException], None]
    has_failed: bool = False

    def note(self, name: str) -> None:
        """Take in that a robot is connected."""
        if name in self.missing:
            self.missing.remove(name)
            if not self.missing:
                self.is_up()

    def note_failure(self, name: str, error: BaseException) -> None:
        """Take in that a robot is not connected."""
        if name in self.missing and not self.has_failed:
            self.has_failed = True
            self.on_failure(error)


def _skip_cut_cables(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Report errors in the loop, but for sockets that `have_trouble` has shut down."""
    if not isinstance(context.get("exception"), OSError):
        loop.default_exception_handler(context)


async def _publish(client: aiomqtt.Client, letter: Letter) -> None:
    is_kept = letter.name == "connection"
    await client.publish(letter.topic, letter.payload, qos=int(is_kept), retain=is_kept)
    check_cancellation()


def _list_works(plan: Plan, number: int) -> dict[str, float]:
    """Return how long a robot works at each of its stops [s]."""
    scenario = plan.scenario
    second = scenario.units.seconds or 1
    stops = [stop for job in scenario.jobs or () for stop in job.stops]
    return {
        scenario.roadmap.name(stop.at): float(stop.work * second)
        for stop in stops or scenario.robots[number].stops
    }


async def run_robots(
    plan: Plan,
    identities: Sequence[Identity],
    broker: Broker,
    *,
    trouble: Trouble | None = None,
    seed: int = 0,
    time_scale: float = 1.0,
    begin: int = 0,
    is_up: Callable[[], None] = lambda: None,
    on_failure: Callable[[BaseException], None] = lambda _error: None,
) -> None:
    """Run robots that stand at the homes of a plan, until cancelled.

    Parameters
    ----------
    plan
        The plan; only the homes and the times of work are taken from it.
    identities
        The robots, in the order of the plan.
    broker
        Where they are asked.
    trouble
        Which faults occur, and how often.
    seed
        Of the trouble; each robot draws its own.
    time_scale
        Seconds of robot time in a second.
    begin
        The number of the first robot that is run; those before it are left out.
    is_up
        Is called once all robots have been connected.
    on_failure
        Is called with the reason where the first robot is not let in, and tries again.
    """
    robots = [
        _NetworkRobot(
            end=RobotEnd(
                SimulatedRobot(plan.scenario.roadmap.name(int(track.vertices[0]))),
                number,
                identity,
                make_timestamp,
                make_simulated_battery(plan.scenario, number),
            ),
            scenario=plan.scenario,
            identity=identity,
            works=_list_works(plan, number),
            time_scale=time_scale,
            draw=random.Random(f"{seed} {number}"),  # noqa: S311 (a simulation)
            trouble=trouble or {},
        )
        for number, (track, identity) in enumerate(zip(plan.tracks, identities, strict=True))
        if number >= begin
    ]
    names = {robot.identity.serial_number for robot in robots}
    arrivals = _Arrivals(missing=names, is_up=is_up, on_failure=on_failure)
    asyncio.get_running_loop().set_exception_handler(_skip_cut_cables)
    async with asyncio.TaskGroup() as tasks:
        for robot in robots:
            tasks.create_task(robot.carry_out_orders())
            tasks.create_task(robot.use_battery())
            tasks.create_task(robot.connect(broker, arrivals))
