"""Both ends of the wire: messages of control and robots as topics and payloads of VDA 5050.

No network is here: an end takes a topic and a payload in and gives letters out, whatever carries
them.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from rightofway.control import vda5050
from rightofway.control.fleet_control import FleetControl
from rightofway.control.messages import Message, Order
from rightofway.control.simulated_robot import SimulatedRobot
from rightofway.errors import InputError, shown

__all__ = ["ControlEnd", "Identity", "Letter", "RobotEnd"]

FORBIDDEN = frozenset("/+#$")
"""Characters that may not be in a part of a topic."""


class Letter(NamedTuple):
    """A message on its way."""

    topic: str
    payload: bytes


@dataclass(frozen=True, slots=True, kw_only=True)
class Identity:
    """A robot as messages name it.

    Attributes
    ----------
    manufacturer, serial_number
        Which robot it is; neither has ``/``, ``+``, ``#`` or ``$``, because topics have both.
    version
        Of the norm, one of `vda5050.VERSIONS`.
    interface
        The first part of its topics; by default ``uagv``, from 3.0 on ``vda5050``.

    Raises
    ------
    InputError
        If a part of a topic is empty or has a forbidden character, or the version is unknown.
    """

    manufacturer: str
    serial_number: str
    version: str = "2.1.0"
    interface: str = ""

    def __post_init__(self) -> None:
        if self.version not in vda5050.VERSIONS:
            known = ", ".join(vda5050.VERSIONS)
            message = f"{shown(self.version)} is no version of VDA 5050 (one of {known})"
            raise InputError.at("version", message)
        if not self.interface:
            object.__setattr__(self, "interface", "uagv" if self.version < "3" else "vda5050")
        for key in ("interface", "manufacturer", "serial_number"):
            value = getattr(self, key)
            if not value or FORBIDDEN & set(value):
                message = f"{shown(value)} cannot be part of a topic (leave out / + # $)"
                raise InputError.at(key, message)

    def topic(self, name: str) -> str:
        """Return a topic of this robot.

        Parameters
        ----------
        name
            Its last part: ``order``, ``instantActions``, ``state``.
        """
        major = f"v{self.version[0]}"
        return f"{self.interface}/{major}/{self.manufacturer}/{self.serial_number}/{name}"


class _Writer:
    """Writes messages of one end with their heads; `now` gives timestamps."""

    def __init__(self, now: Callable[[], str]) -> None:
        self._now, self._sent = now, Counter[str]()

    def letter(
        self, identity: Identity, name: str, written: Callable[[vda5050.Header], dict[str, Any]]
    ) -> Letter:
        topic = identity.topic(name)
        header = vda5050.Header(
            headerId=self._sent[topic],
            timestamp=self._now(),
            version=identity.version,  # type: ignore[arg-type]  # an identity has a known one
            manufacturer=identity.manufacturer,
            serialNumber=identity.serial_number,
        )
        self._sent[topic] += 1
        return Letter(topic, json.dumps(written(header), separators=(",", ":")).encode())


class ControlEnd:
    """The end of the control.

    Parameters
    ----------
    control
        Takes states and returns what is to be sent.
    identities
        The robots, in the order of the plan.
    now
        Returns the time as messages have it.
    report
        Receives a sentence on each kind of state that cannot be read, once for a robot.
    """

    def __init__(
        self,
        control: FleetControl,
        identities: Sequence[Identity],
        now: Callable[[], str],
        report: Callable[[str], None] = lambda _: None,
    ) -> None:
        self.control = control
        self._identities, self._report, self._reported = identities, report, set[str]()
        self._writer = _Writer(now)
        self._robots = {one.topic("state"): robot for robot, one in enumerate(identities)}

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics of the states of all robots."""
        return tuple(self._robots)

    def receive(self, letter: Letter) -> list[Letter]:
        """Take a state in; return what is to be sent because of it.

        Parameters
        ----------
        letter
            A state of a robot, which may be broken: then it proves nothing.
        """
        robot = self._robots[letter.topic]
        try:
            state = vda5050.read_state(_document(letter.payload))
        except InputError as error:
            sentence = f"robot {robot}: {error}"
            if sentence not in self._reported:
                self._reported.add(sentence)
                self._report(sentence)
            return []
        return self.letters(self.control.receive(robot, state))

    def letters(self, messages: Iterable[Message]) -> list[Letter]:
        """Return messages of the control as they are sent.

        Parameters
        ----------
        messages
            Orders and instant actions.
        """
        letters = []
        for message in messages:
            name = "order" if isinstance(message, Order) else "instantActions"
            identity = self._identities[message.robot]

            def written(header: vda5050.Header, message: Message = message) -> dict[str, Any]:
                return vda5050.written(message, header)

            letters.append(self._writer.letter(identity, name, written))
        return letters


class RobotEnd:
    """The end of a simulated robot.

    Parameters
    ----------
    robot
        Takes orders and instant actions.
    number
        Its number in the plan.
    identity
        As messages name it.
    now
        Returns the time as messages have it.
    """

    def __init__(
        self, robot: SimulatedRobot, number: int, identity: Identity, now: Callable[[], str]
    ) -> None:
        self.robot, self._number, self._identity = robot, number, identity
        self._writer = _Writer(now)

    @property
    def topics(self) -> tuple[str, str]:
        """The topics that it listens to."""
        return self._identity.topic("order"), self._identity.topic("instantActions")

    def receive(self, letter: Letter) -> None:
        """Take an order or instant actions in.

        Parameters
        ----------
        letter
            What was sent to it.

        Raises
        ------
        InputError
            If it is not as the norm has it.
        """
        document = _document(letter.payload)
        if letter.topic == self._identity.topic("order"):
            self.robot.take_order(vda5050.read_order(document, self._number))
        else:
            for action in vda5050.read_instant_actions(document, self._number):
                self.robot.take_action(action)

    def state(self) -> Letter:
        """Return its state as it is sent."""
        return self._writer.letter(
            self._identity, "state", lambda header: vda5050.written_state(self.robot, header)
        )


def _document(payload: bytes) -> dict[str, Any]:
    """Return a payload as JSON has it."""
    try:
        document = json.loads(payload)
    except ValueError as error:
        message = (
            f"{shown(payload.decode(errors='replace'))} is no JSON (the sender has to send it)"
        )
        raise InputError.at("message", message) from error
    if not isinstance(document, dict):
        message = f"{shown(document)} is no JSON object (the sender has to send one)"
        raise InputError.at("message", message)
    return document
