"""The three doors of a control: messages of robots, commands of operators, orders of pages.

Whatever comes in, of any size, is answered or reported, and the control goes on.
"""

from __future__ import annotations

import asyncio
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

import httpx
from hypothesis import strategies as st

from rightofway.control import Entry, FleetControl, SqliteJournal
from rightofway.control.commands import NAMED, Commands
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.endpoints import ControlEnd, Letter
from rightofway.control.identities import make_simulated_identities
from rightofway.control.notices import Notices
from rightofway.control.operator import OPERATIONS, Operator
from rightofway.control.order_map import make_order_maps
from rightofway.studio import watching
from rightofway.studio.app import WATCH, create_watch
from rightofway.studio.guard import Access
from tests.builders.chaos import MemoryJournal
from tests.builders.laws import law
from tests.builders.plans import door
from tests.campaigns.states import draw_large, refuse_endless, write_large

KINDS = (*NAMED, *OPERATIONS, "list", "add", "replan", "else")
"""Kinds of commands."""

KNOWN = ("R1", "R2", "R1/job0", "R2/job7", "N0", "N1", "N6", "N7", "N9", "1/2", "3", "0", "-1", "")
"""Texts that mean something to a control of the door, or nearly."""

large = st.randoms(use_true_random=False).map(draw_large)
"""Values of any size; `write_large` writes them."""

values = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(),
        st.sampled_from(KNOWN),
        large,
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=3), inner, max_size=3)
    ),
    max_leaves=4,
)
"""Any JSON."""


def mostly(usual: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Draw usual values fifteen times of sixteen, else any."""
    return st.integers(0, 15).flatmap(lambda draw: usual if draw else values)


@st.composite
def commands_of_people(draw: st.DrawFn) -> Any:
    """Draw commands that are mostly well-formed, or anything."""
    texts = mostly(st.sampled_from(KNOWN))
    known = {"kind": mostly(st.sampled_from(KINDS))}
    more = dict.fromkeys(("name", "at", "to", "work", "robot", "after"), texts)
    return draw(mostly(st.fixed_dictionaries(known, optional=more)))


@contextmanager
def opened_control() -> Iterator[tuple[Path, Dispatcher]]:
    """Yield the journal of a control of the door, and its dispatcher."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "door.journal")
        journal = SqliteJournal(path)
        dispatcher = Dispatcher(FleetControl(journal), door(), time_limit=0.05)
        dispatcher.begin("run")
        try:
            yield path, dispatcher
        finally:
            journal.close()


def refuse_shared_places(control: FleetControl) -> None:
    """Fail if two robots hold a place."""
    held = Counter(place for own in control.ledger.robots for place in set(own.held))
    assert max(held.values()) == 1, held.most_common(1)


TOPICS = ("state", "connection", "factsheet")
STATE = {
    "orderId": mostly(
        st.one_of(
            st.sampled_from(("", "run-0-0", "run-1-0", "run-0-9", "others")),
            st.integers(1, 100_000).map(lambda size: "run-0-" + "1" * size),
        )
    ),
    "orderUpdateId": mostly(st.integers(0, 3)),
    "lastNodeId": mostly(st.sampled_from(KNOWN)),
    "lastNodeSequenceId": mostly(st.integers(0, 9)),
    "nodeStates": mostly(st.just([])),
    "edgeStates": mostly(st.just([])),
    "actionStates": mostly(
        st.lists(
            st.fixed_dictionaries(
                {
                    "actionId": mostly(st.sampled_from(("run-0-job0-1", "run-1-job0-1", "a"))),
                    "actionStatus": mostly(st.sampled_from(("FINISHED", "FAILED", "RUNNING"))),
                }
            ),
            max_size=2,
        )
    ),
    "driving": mostly(st.booleans()),
}
"""The keys of a state that count."""

messages_of_robots = st.tuples(
    st.integers(0, 1),
    st.sampled_from(TOPICS),
    st.one_of(
        st.binary(),
        values.map(write_large),
        st.fixed_dictionaries(
            STATE, optional=dict.fromkeys(("errors", "agvPosition", "safetyState"), values)
        ).map(write_large),
        st.fixed_dictionaries({"connectionState": mostly(st.just("ONLINE"))}).map(write_large),
        st.fixed_dictionaries(
            {"physicalParameters": st.dictionaries(st.sampled_from(("speedMax", "length")), values)}
        ).map(write_large),
    ),
)


@law(st.lists(messages_of_robots, max_size=20))
def test_no_message_ends_a_control(messages: list[tuple[int, str, bytes]]) -> None:
    plan, kept = door(), list[Entry]()
    names = [robot.name for robot in plan.scenario.robots]
    notices = Notices(names, lambda _: None, lambda: 0.0, keep=kept.append)
    control = FleetControl(MemoryJournal(), report=notices.report_on)
    Dispatcher(control, plan).begin("run")
    identities = make_simulated_identities(names)
    end = ControlEnd(control, make_order_maps(plan.scenario, identities), lambda: "now", notices)
    control.start()
    for robot, name, payload in messages:
        for letter in end.receive(Letter(identities[robot].get_topic(name), payload)):
            assert letter.payload
        refuse_shared_places(control)
    refuse_endless(kept, len(names))
    assert not [entry for entry in kept if "message with defect" in str(entry["fact"])]


@law(st.lists(commands_of_people(), max_size=6))
def test_no_command_ends_a_control_or_its_next_start(given: list[Any]) -> None:
    """Each is answered, and done once: a start that finds no answers does nothing."""
    with opened_control() as (path, dispatcher):
        commands = Commands(path)
        for command in given:
            text = write_large(command).decode()
            commands._database.execute("INSERT INTO commands (command) VALUES (?)", (text,))
        numbers = [number for number, _ in commands.list_unanswered()]
        _, answers = Operator(dispatcher).obey(commands)
        assert [number for number, _ in answers] == numbers
        assert not [answer for _, answer in answers if "unexpected" in str(answer["fact"])]
        refuse_shared_places(dispatcher.control)
        for number, answer in answers:
            commands.answer(number, answer)
        assert commands.list_unanswered() == []
        commands.close()


@law(st.lists(commands_of_people(), max_size=6))
def test_no_order_of_a_page_is_a_defect_of_its_server_or_of_the_control(given: list[Any]) -> None:
    """A body is refused with a status of 400 to 499, or the control answers it."""
    with opened_control() as (path, dispatcher), patch.object(watching, "PATIENCE", 0.0):
        watched = watching.Watched(door(), path, title="door", takes_orders=True)
        app = create_watch(watched, Access(hosts=None))

        async def send() -> None:
            transport = httpx.ASGITransport(app)
            async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
                for body in given:
                    answer = await client.post(
                        f"{WATCH}orders",
                        content=write_large(body),
                        headers={"content-type": "application/json"},
                    )
                    assert answer.status_code == 200 or 400 <= answer.status_code < 500, answer.text
                    if answer.status_code >= 400:
                        assert answer.json()["error"]["message"]

        asyncio.run(send())
        commands = Commands(path)
        _, answers = Operator(dispatcher).obey(commands)
        assert not [answer for _, answer in answers if "unexpected" in str(answer["fact"])]
        commands.close()
