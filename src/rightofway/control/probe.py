"""A probe of one robot: a conversation that finds out how the robot speaks VDA 5050.

The robot is asked for its state and its factsheet. Then it gets orders of a single node, the one
where it is, so it does not move: an order, an update, the update again, an update that does not
fit, a withdrawal, and another order. `MessageAudit` compares each of its messages with the norm.
"""

from __future__ import annotations

import asyncio
import json
import secrets
import time
from collections.abc import Callable, Iterator, Mapping
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from rightofway.control.broker import Broker
from rightofway.control.conformance import (
    MessageAudit,
    choose_version,
    get_list,
    get_mapping,
    read_position,
)
from rightofway.control.endpoints import Letter, LetterWriter, make_timestamp
from rightofway.control.identities import Identity
from rightofway.control.messages import InstantAction
from rightofway.control.plan_fit import PlanFit
from rightofway.control.vda5050 import Body, InstantActions, OrderMessage
from rightofway.errors import InputError, escape_text, quote
from rightofway.execution.probe_result import ProbeFinding, ProbeResult, Verdict
from rightofway.facts import Fact

if TYPE_CHECKING:
    import aiomqtt

__all__ = ["ACTIONS", "Probe"]

SILENCE = 35.0
"""Seconds in which a robot has to send a state: the norm asks for one every 30 seconds."""

ANSWER = 10.0
"""Seconds in which a robot has to answer."""

SETTLE = 2.0
"""Seconds after which a message counts as left without consequences."""

ACTIONS = (
    "cancelOrder",
    "stateRequest",
    "factsheetRequest",
    "startPause",
    "stopPause",
    "startCharging",
    "stopCharging",
    "pick",
    "drop",
)
"""Actions that the control uses, or that plans often need."""

GRAVE = frozenset({"CRITICAL", "FATAL"})
"""Levels of errors with which the control releases nothing."""

DRIVING_MODES = frozenset({"AUTOMATIC", "SEMIAUTOMATIC"})
"""Operating modes in which a robot takes orders."""

FULL = 100
"""A full battery [%]."""

MOST_ROBOTS = 20
"""Robots of a broker that a finding names."""

_Any = TypeVar("_Any")
State = Mapping[str, Any]


class Probe:
    """A probe of one robot at a broker.

    Parameters
    ----------
    manufacturer, serial_number
        The robot, as topics have it.
    ask
        Is called with the node of the first order; returns whether the order may be sent.
    node
        The node of the orders; None for the last node that the robot reports.
    fit
        A robot of a plan, with which the real one is compared.
    silence, answer, settle
        How long to wait for a message of the robot, for an answer, and for consequences [s].
    """

    def __init__(
        self,
        manufacturer: str,
        serial_number: str,
        *,
        ask: Callable[[str], bool],
        node: str | None = None,
        fit: PlanFit | None = None,
        silence: float = SILENCE,
        answer: float = ANSWER,
        settle: float = SETTLE,
    ) -> None:
        self._names = manufacturer, serial_number
        self._ask, self._node, self._fit = ask, node, fit
        self._silence, self._answer, self._settle = silence, answer, settle
        self._findings: list[ProbeFinding] = []
        self._heard = dict[str, dict[str, Any]]()  # the latest message of each topic
        self._others = set[str]()  # robots of the broker
        self._strange = set[str]()  # further topics of this name
        self._absent: tuple[list[str], bytes, aiomqtt.Message] | None = None
        self._news = asyncio.Event()
        self._identity: Identity | None = None
        self._audit: MessageAudit | None = None
        self._writer = LetterWriter(make_timestamp)
        self._token = secrets.token_hex(4)

    async def run(self, broker: Broker) -> ProbeResult:
        """Talk to the robot; return the findings.

        Parameters
        ----------
        broker
            Where the robot is.

        Raises
        ------
        InputError
            If the broker cannot be reached.
        """
        import aiomqtt

        try:
            async with broker.open_client("rightofway-probe") as client:
                reader = asyncio.create_task(self._read(client))
                try:
                    await self._talk(client)
                finally:
                    reader.cancel()
                    await asyncio.gather(reader, return_exceptions=True)
        except aiomqtt.MqttError as error:
            message = f"{broker.address} cannot be reached: {error} (start it, or correct the URL)"
            raise InputError.at("broker", message) from error
        return self._make_result()

    async def _talk(self, client: aiomqtt.Client) -> None:
        """Take one step after the other, as far as the robot can."""
        robot = "/".join(("+", "+", *self._names, "+"))
        await client.subscribe([(robot, 1), ("+/+/+/+/connection", 1)])
        await self._wait(lambda: self._audit, self._silence)
        if self._audit is None and self._absent is not None:
            self._take(*self._absent, decides=True)
            self._note_connection(self._heard.get("connection"))
            return
        if self._audit is None:
            others = tuple(sorted(self._others))[:MOST_ROBOTS]
            fact = Fact("robots heard", names=others) if others else Fact("no robot heard")
            silent = Fact("nothing heard", topic=robot, seconds=round(self._silence), others=fact)
            self._note("connection", "blocks", silent)
            return
        await self._listen(client)
        await self._ask_for_factsheet(client)
        state = self._heard.get("state")
        if state is None:
            return
        if self._fit is not None:
            self._findings += self._fit.compare(state, self._heard.get("factsheet"))
        node = state.get("lastNodeId") if self._node is None else self._node
        if not isinstance(node, str) or not node:
            self._note("order", "note", Fact("no node for an order"))
        elif self._is_busy(state):
            self._note("order", "note", Fact("no order while busy"))
        elif not self._ask(node):
            self._note("order", "note", Fact("no order sent"))
        else:
            await self._give_orders(client, node, state)

    async def _read(self, client: aiomqtt.Client) -> None:
        """Take in messages; the first one of the robot shows its interface and its version."""
        async for message in client.messages:
            parts = str(message.topic).split("/")
            payload = message.payload if isinstance(message.payload, bytes) else b""
            if tuple(parts[2:4]) != self._names:
                self._others.add("/".join(parts[2:4]))
            elif parts[4] in {"state", "connection", "factsheet"} and payload:
                self._take(parts, payload, message)
            self._news.set()

    def _take(
        self, parts: list[str], payload: bytes, message: aiomqtt.Message, *, decides: bool = False
    ) -> None:
        """Take in a message of the robot.

        A robot that has changed its version leaves the end of its old connection at the broker, so
        such a message decides on interface and version only if nothing else comes.
        """
        if self._audit is None:
            if not decides and message.retain and b"ONLINE" not in payload:
                self._absent = (parts, payload, message)
                return
            version = choose_version(_find_version(payload), parts[1])
            self._identity = Identity(
                manufacturer=self._names[0],
                serial_number=self._names[1],
                version=version,
                interface=parts[0],
            )
            self._audit = MessageAudit(*self._names, version)
        assert self._identity is not None, "made with the audit"
        name, is_retained = parts[4], bool(message.retain)
        if str(message.topic) != self._identity.get_topic(name):
            self._strange.add("/".join(parts[:2]))
            return
        now = datetime.now(UTC)
        document = self._audit.take(name, payload, now=now, is_retained=is_retained)
        if document is not None:
            self._heard[name] = {**document, "is retained": is_retained}

    async def _wait(self, find: Callable[[], _Any], seconds: float) -> _Any:
        """Return the first true value of a function within a time, or its last value."""
        end = time.monotonic() + seconds
        while not (result := find()) and (left := end - time.monotonic()) > 0:
            self._news.clear()
            try:
                async with asyncio.timeout(left):
                    await self._news.wait()
            except TimeoutError:
                return find()
        return result

    async def _send(self, client: aiomqtt.Client, name: str, body: Body) -> None:
        assert self._identity is not None, "a robot that is asked was heard"
        letter: Letter = self._writer.make_letter(self._identity, name, body)
        await client.publish(letter.topic, letter.payload, qos=0)

    async def _act(
        self,
        client: aiomqtt.Client,
        kind: Literal["stateRequest", "factsheetRequest", "cancelOrder"],
    ) -> str:
        """Ask for an instant action; return its id."""
        action_id = f"probe-{self._token}-{kind}"
        action = InstantAction(robot=0, action_id=action_id, kind=kind)
        await self._send(client, "instantActions", InstantActions.of(action))
        return action_id

    def _note(self, step: str, verdict: Verdict, fact: Fact) -> None:
        self._findings.append(ProbeFinding(step, verdict, fact))

    async def _listen(self, client: aiomqtt.Client) -> None:
        """Note the connection and the state, and whether a state request is answered."""
        await self._wait(lambda: "connection" in self._heard, self._settle)
        self._note_connection(self._heard.get("connection"))
        began = time.monotonic()
        action_id = await self._act(client, "stateRequest")
        status = await self._wait(lambda: self._find_action(action_id), self._answer)
        if status:
            seconds = time.monotonic() - began
            self._note(
                "state", "ok", Fact("request answered", status=status, seconds=round(seconds, 1))
            )
        else:
            self._note("state", "departs", Fact("request not answered"))
            await self._wait(lambda: "state" in self._heard, self._silence)
        if "state" in self._heard:
            self._note_state(self._heard["state"])
        else:
            self._note("state", "blocks", Fact("no state heard", seconds=round(self._silence)))

    def _note_connection(self, document: dict[str, Any] | None) -> None:
        if document is None:
            self._note("connection", "departs", Fact("no connection message"))
            return
        state = str(document.get("connectionState"))
        verdict: Verdict = "ok" if state == "ONLINE" else "blocks"
        self._note("connection", verdict, Fact("connection reported", state=escape_text(state)))
        if not document["is retained"]:
            self._note("connection", "departs", Fact("connection not retained"))

    def _note_state(self, state: State) -> None:
        """Note where the robot is, and all that keeps it from taking orders."""
        place = state.get("lastNodeId")
        known = Fact("last node reported", node=escape_text(place)) if place else None
        self._note("state", "ok" if known else "note", known or Fact("no last node"))
        position = read_position(state)
        if position is None:
            self._note("state", "note", Fact("no position"))
        else:
            fact = Fact(
                "position reported", x=position["x"], y=position["y"], map=position["mapId"]
            )
            self._note("state", "ok", fact)
        mode = state.get("operatingMode")
        if mode not in DRIVING_MODES:
            self._note("state", "blocks", Fact("mode without orders", mode=escape_text(str(mode))))
        safety = get_mapping(state, "safetyState")
        stop = safety.get("eStop", safety.get("activeEmergencyStop", "NONE"))
        if stop not in {"NONE", None}:
            self._note("state", "blocks", Fact("in emergency stop", stop=escape_text(str(stop))))
        if state.get("paused") is True:
            self._note("state", "blocks", Fact("is paused"))
        for kind, level in _list_errors(state):
            verdict: Verdict = "blocks" if level in GRAVE else "note"
            self._note("state", verdict, Fact("error reported", error=kind, level=level))
        self._note_charge(state)

    def _note_charge(self, state: State) -> None:
        battery = get_mapping(state, "batteryState", "powerSupply")
        charge = battery.get("batteryCharge", battery.get("stateOfCharge"))
        if not isinstance(charge, int | float) or isinstance(charge, bool):
            self._note("state", "note", Fact("no charge"))
        elif not 0 <= charge <= FULL:
            self._note("state", "departs", Fact("impossible charge", charge=charge))
        else:
            self._note("state", "ok", Fact("charge reported", charge=charge))

    async def _ask_for_factsheet(self, client: aiomqtt.Client) -> None:
        """Note the factsheet: size, speed, actions and limits of orders."""
        self._heard.pop("factsheet", None)  # a retained one is no answer
        await self._act(client, "factsheetRequest")
        sheet = await self._wait(lambda: self._heard.get("factsheet"), self._answer)
        if sheet is None:
            self._note("factsheet", "departs", Fact("no factsheet"))
            return
        for verdict, fact in _read_sheet(sheet):
            self._note("factsheet", verdict, fact)

    def _is_busy(self, state: State) -> bool:
        return bool(state.get("nodeStates") or state.get("driving") is True)

    def _find_action(self, action_id: str) -> str | None:
        """Return the status of an action in the latest state."""
        state = self._heard.get("state", {})
        for key in ("actionStates", "instantActionStates"):
            for action in get_list(state, key):
                if action.get("actionId") == action_id:
                    return escape_text(str(action.get("actionStatus")))
        return None

    def _has(self, order: OrderMessage) -> bool:
        """Return whether the latest state has an order with its update."""
        state = self._heard.get("state", {})
        given = state.get("orderId"), state.get("orderUpdateId")
        return given == (order.orderId, order.orderUpdateId)

    async def _give_orders(self, client: aiomqtt.Client, node: str, state: State) -> None:
        """Give orders of the node where the robot is, and note how it takes them."""
        first = _make_order(f"probe-{self._token}-1", 0, 0, node, state)
        before = set(_list_errors(state))
        if not await self._give_order(client, first, "order", before):
            return
        await self._note_arrival(node)
        update = _make_order(first.orderId, 1, 0, node, state)
        if await self._give_order(client, update, "update", before):
            await self._repeat_update(client, update)
            await self._send_misfit(client, _make_order(first.orderId, 2, 4, node, state))
        await self._withdraw(client)
        last = _make_order(f"probe-{self._token}-2", 0, 0, node, state)
        await self._give_order(client, last, "next order", set(_list_errors(self._heard["state"])))

    async def _give_order(
        self,
        client: aiomqtt.Client,
        order: OrderMessage,
        step: str,
        before: set[tuple[str, str]],
    ) -> bool:
        """Send an order; return whether the robot reports it, and note that."""
        began = time.monotonic()
        await self._send(client, "order", order)
        if await self._wait(lambda: self._has(order), self._answer):
            self._note(step, "ok", Fact("order taken", seconds=round(time.monotonic() - began, 1)))
            return True
        self._note(step, "blocks", Fact("order not taken"))
        self._note_errors(step, before)
        return False

    def _note_errors(self, step: str, before: set[tuple[str, str]]) -> None:
        """Note errors that have come since."""
        for kind, level in _list_errors(self._heard["state"]):
            if (kind, level) not in before:
                self._note(step, "note", Fact("error reported", error=kind, level=level))

    async def _note_arrival(self, node: str) -> None:
        """Note what keeps the states under the first order from proving the arrival at its node."""
        wanted = {
            "lastNodeId": node,
            "lastNodeSequenceId": 0,
            "nodeStates": [],
            "edgeStates": [],
            "driving": False,
        }

        def list_lacking() -> list[str]:
            state = self._heard["state"]
            return [key for key, value in wanted.items() if state.get(key) != value]

        await self._wait(lambda: not list_lacking(), self._settle)
        for key in list_lacking():
            given = quote(self._heard["state"].get(key))
            self._note("order", "departs", Fact("arrival not shown", key=key, given=given))

    async def _repeat_update(self, client: aiomqtt.Client, update: OrderMessage) -> None:
        """Send the same update again, as the control does until it is acknowledged."""
        before = set(_list_errors(self._heard["state"]))
        await self._send(client, "order", update)
        await asyncio.sleep(self._settle)
        grave = [error for error in _list_errors(self._heard["state"]) if error[1] in GRAVE]
        if not self._has(update) or set(grave) - before:
            self._note("update", "departs", Fact("repeated update not ignored"))
        else:
            self._note("update", "ok", Fact("repeated update ignored"))

    async def _send_misfit(self, client: aiomqtt.Client, misfit: OrderMessage) -> None:
        """Send an update that does not begin where the base ends: the robot has to refuse it."""
        before = set(_list_errors(self._heard["state"]))
        await self._send(client, "order", misfit)
        errors = await self._wait(
            lambda: set(_list_errors(self._heard["state"])) - before, self._settle
        )
        if self._has(misfit):
            self._note("update", "departs", Fact("wrong update taken"))
        elif errors:
            self._note("update", "ok", Fact("wrong update refused", error=min(errors)[0]))
        else:
            self._note("update", "departs", Fact("wrong update unreported"))

    async def _withdraw(self, client: aiomqtt.Client) -> None:
        """Withdraw the order, which is finished already."""
        before = set(_list_errors(self._heard["state"]))
        action_id = await self._act(client, "cancelOrder")
        ended = {"FINISHED", "FAILED"}
        status = await self._wait(
            lambda: (seen := self._find_action(action_id)) in ended and seen, self._answer
        )
        if not status:
            self._note("cancel", "departs", Fact("cancel without end"))
            self._note_errors("cancel", before)
            return
        self._note("cancel", "ok", Fact("cancel ended", status=status))
        if self._is_busy(self._heard["state"]):
            self._note("cancel", "departs", Fact("busy after cancel"))

    def _name_strange(self) -> Iterator[ProbeFinding]:
        """Yield a finding if the robot, or another one of its name, uses further topics."""
        if self._strange:
            fact = Fact("further topics", topics=tuple(sorted(self._strange)))
            yield ProbeFinding("topics", "note", fact)

    def _make_result(self) -> ProbeResult:
        identity, audit = self._identity, self._audit
        position = read_position(self._heard.get("state", {}))
        return ProbeResult(
            manufacturer=self._names[0],
            serial_number=self._names[1],
            interface=identity.interface if identity else None,
            version=identity.version if identity else None,
            map_id=None if position is None else position["mapId"],
            messages=dict(audit.counts) if audit else {},
            findings=(*self._findings, *(audit.findings if audit else ()), *self._name_strange()),
        )


def _find_version(payload: bytes) -> object:
    """Return the version in the header of a message, None without one."""
    try:
        document = json.loads(payload)
    except (ValueError, RecursionError):
        return None
    return document.get("version") if isinstance(document, dict) else None


def _make_order(
    order_id: str, update_id: int, sequence_id: int, node: str, state: State
) -> OrderMessage:
    """Return an order of a single node, at the position that the robot reports."""
    position = read_position(state)
    place = position and {**position, "allowedDeviationXY": 1.0}
    only = {"nodeId": node, "sequenceId": sequence_id, "released": True, "actions": []}
    document = {
        "orderId": order_id,
        "orderUpdateId": update_id,
        "nodes": [{**only, "nodePosition": place} if place else only],
        "edges": [],
    }
    return OrderMessage.model_validate(document)


def _list_errors(state: State) -> list[tuple[str, str]]:
    """Return type and level of each error of a state."""
    return [
        (escape_text(str(error.get("errorType"))), escape_text(str(error.get("errorLevel"))))
        for error in get_list(state, "errors")
    ]


def _read_sheet(sheet: State) -> Iterator[tuple[Verdict, Fact]]:
    """Yield the findings in a factsheet."""
    physical = get_mapping(sheet, "physicalParameters")
    speed = physical.get("speedMax", physical.get("maximumSpeed"))
    sizes = [physical.get("length"), physical.get("width"), speed]
    if all(isinstance(size, int | float) for size in sizes):
        fact = Fact("size reported", length=sizes[0], width=sizes[1], speed=sizes[2])
        yield "ok", fact
    else:
        yield "note", Fact("no size")
    features = get_mapping(sheet, "protocolFeatures")
    names = "agvActions" if "agvActions" in features else "mobileRobotActions"
    known = {escape_text(str(action.get("actionType"))) for action in get_list(features, names)}
    if known:
        yield "ok", Fact("actions known", names=tuple(sorted(known)))
    if missing := [name for name in ACTIONS if name not in known]:
        yield "note", Fact("actions not listed", names=tuple(missing))
    limits = get_mapping(
        get_mapping(sheet, "protocolLimits"), "maxArrayLens", "maximumArrayLengths"
    )
    longest = limits.get("order.nodes")
    if isinstance(longest, int) and longest > 0:
        yield "note", Fact("longest order", nodes=longest)
