"""Fleets that are driven, for pages that watch them: a page, a stream of frames, orders of people.

Pages get rows of the journal of a control, in this process or in another one. Commands of
people go into the table of commands beside it.
"""

from __future__ import annotations

import asyncio
import json
import secrets
from collections.abc import AsyncGenerator, Mapping
from pathlib import Path
from typing import Any

from rightofway.control.commands import Answer, Commands
from rightofway.control.journal import JournalReader
from rightofway.control.recording import Recording
from rightofway.errors import InputError
from rightofway.facts import Fact, read_fact
from rightofway.model import Plan
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import to_parts
from rightofway.studio.errors import Busy, Refused
from rightofway.viz.page.document import as_compact_json, make_document
from rightofway.viz.page.payload import make_payload
from rightofway.viz.page.schema import FeedData, Payload

__all__ = ["ORDERS", "Watched"]

EVERY = 0.25
"""Seconds between two frames."""

HEARTBEAT = 15.0
"""So often a page hears something of a run that has ended [s]."""

MAX_PAGES = 64
"""Pages that may watch a fleet at once."""

PATIENCE = 10.0
"""Time for which a page waits for the answer to an order [s]."""

ORDERS = ("hold", "stop", "go", "clear", "remove", "place", "close", "open", "seen")
"""Commands that pages may send to a control."""


class Watched:
    """A fleet that is driven, or was.

    Parameters
    ----------
    plan
        The plan with which its journal begins.
    journal
        The file of the journal.
    title
        The subject of its page.
    address
        Where its page is, as other addresses begin with it.
    takes_orders
        Whether pages may ask the control for something.
    """

    def __init__(
        self, plan: Plan, journal: Path, *, title: str, address: str = "/", takes_orders: bool
    ) -> None:
        self._journal, self._title = journal, title
        self._address, self._takes_orders = address, takes_orders
        self._recording = Recording(plan, JournalReader(journal))
        self._token = secrets.token_hex(4)  # of this reading: rows have their numbers in it
        self._payload: tuple[Plan, Payload] | None = None  # of the robots that have joined, too
        self._pages = 0
        self._is_over = False

    def hang_up(self) -> None:
        """End all streams."""
        self._is_over = True

    def make_page(self, *, is_whole: bool = False) -> str:
        """Return the page.

        Parameters
        ----------
        is_whole
            Whether it has all that has happened, and asks for no more.
        """
        return self._write_page(self._make_feed(is_whole=is_whole), is_whole=is_whole)

    async def make_page_aside(self) -> str:
        """Return the page, written in a thread: of a large fleet that takes a while."""
        return await asyncio.to_thread(self._write_page, self._make_feed(is_whole=False))

    def _make_feed(self, *, is_whole: bool) -> FeedData:
        """Return the events so far, or their source."""
        self._recording.read_on()
        frame = self._recording.take_frame()
        frame["ends"] = self._recording.measure_ends()
        feed: FeedData = {"frame": frame}
        if not is_whole:
            feed["frame"]["rows"] = []  # they come with the first frame
            feed["stream"] = f"{self._address}stream"
            if self._takes_orders:
                feed["orders"] = f"{self._address}orders"
        return feed

    def _write_page(self, feed: FeedData, *, is_whole: bool = False) -> str:
        """Return the page of the plan with a feed."""
        plan = self._recording.plan
        if self._payload is None or self._payload[0] is not plan:
            self._payload = plan, self._make_payload(plan)
        payload = self._payload[1].copy()
        payload["driven"] = feed
        about = f"{self._title}: {len(plan.scenario.robots)} robots"
        return make_document(about, payload, "watch_main", connects=not is_whole)

    def _make_payload(self, plan: Plan) -> Payload:
        """Return the plan as all pages get it, without its jobs."""
        payload = make_payload(plan, title=self._title)
        if self._recording.has_grown:  # robots that have joined are in no plan: none is judged
            payload["faults"] = {"count": 0, "kinds": [], "listed": []}
        payload.pop("work", None)
        return payload

    async def stream_frames(self, known: str) -> AsyncGenerator[str]:
        """Yield events as server-sent events.

        Parameters
        ----------
        known
            The id of the last event that the page has; empty for none.

        Raises
        ------
        Busy
            If too many pages watch already.
        """
        if self._pages >= MAX_PAGES:
            raise Busy(f"{MAX_PAGES} pages watch this fleet already (close some)")
        token, _, number = known.partition("-")
        after = int(number) if token == self._token and number.isdecimal() else 0
        self._pages += 1
        try:
            last, known_ends, silence = None, None, 0.0
            while not self._is_over:
                self._recording.read_on()
                frame = self._recording.take_frame(after)
                ends = self._recording.measure_ends()
                if ends is not known_ends:
                    frame["ends"] = ends
                said = frame["number"], frame["now"], frame["runs"]
                silence += EVERY
                if said != last or "ends" in frame or silence > HEARTBEAT:
                    known_ends = ends
                    yield f"id: {self._token}-{frame['number']}\ndata: {as_compact_json(frame)}\n\n"
                    last, after, silence = said, frame["number"], 0.0
                await asyncio.sleep(EVERY)
        finally:
            self._pages -= 1

    def give_order(self, order: Mapping[str, Any]) -> Mapping[str, Any]:
        """Ask the control for something; return its answer.

        Parameters
        ----------
        order
            Its ``kind``, the ``name`` of a robot or place, ``at`` or ``to`` another place, and the
            ``person`` who gives it.

        Raises
        ------
        Refused
            If this page takes no orders.
        InputError
            If it is none of those that pages may give.
        """
        if not self._takes_orders:
            raise Refused("this page only watches (open that of the control)", 403)
        kind = order.get("kind")
        if kind not in ORDERS:
            message = (
                f"{json.dumps(kind)[:40]} is no order of a page (give one of {', '.join(ORDERS)})"
            )
            raise InputError.at("kind", message)
        command: dict[str, Any] = {"kind": kind}
        for key in ("name", "at", "to", "person"):
            given = order.get(key)
            if given is not None and not isinstance(given, str):
                raise InputError.at(key, f"{json.dumps(given)[:40]} is no name (give text)")
            if given is not None:
                command[key] = given
        answer = self._ask(command)
        if answer is None:
            refusal = Fact("refused", reason=Fact("no control"))
            answer = {"done": False, "fact": refusal.as_dict()}
        return _write_answer(answer)

    def _ask(self, command: Mapping[str, Any]) -> Answer | None:
        """Give a command to the control; return its answer, None if none came in time."""
        commands = Commands(self._journal)
        try:
            return commands.wait_for(commands.ask(command), PATIENCE)
        finally:
            commands.close()

    def ask_on_jobs(self, command: Mapping[str, Any]) -> Answer:
        """Ask the control of a plan with jobs for something on them; return its answer.

        Parameters
        ----------
        command
            Its ``kind``, and the keys of a job as scenario files have them.

        Raises
        ------
        Refused
            If this page takes no orders, the plan has no jobs, the control does not answer in time,
            or it refuses: then with its reason.
        """
        if not self._takes_orders:
            raise Refused("this page only watches (open that of the control)", 403)
        if self._recording.plan.scenario.jobs is None:
            raise Refused("the plan has no jobs (drive one of a scenario with jobs)", 409)
        answer = self._ask(command)
        if answer is None:
            message = f"no answer within {PATIENCE:g} s: it is carried out when the control runs"
            raise Refused(message, 503)
        if not answer["done"]:
            reason = read_fact(answer["fact"]).values["reason"]
            raise Refused(FactWriter(None).write(reason), 409)
        return answer


def _write_answer(answer: Answer) -> dict[str, Any]:
    """Return an answer as pages show it: a refusal with its reason."""
    if answer["done"]:
        return {"done": True}
    refusal = read_fact(answer["fact"])
    return {"done": False, "text": to_parts(FactWriter(None).write(refusal.values["reason"]))}
