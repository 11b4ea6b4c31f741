"""Runs: plans that are queued, made by workers, watched, stopped and kept."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import AsyncGenerator, Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal

from rightofway.facts import Fact
from rightofway.report.facts import pack_note
from rightofway.studio.crew import Crew, WorkerCall
from rightofway.studio.errors import Busy, Refused, StudioError
from rightofway.studio.events import Event, Listeners
from rightofway.studio.messages import as_error
from rightofway.studio.store import Store

MAX_QUEUED = 100
"""Runs that may wait."""

MAX_KEPT = 1000
"""Runs that are kept."""

MAX_POINTS = 500
"""Points of the curve of flowtime over time; of more, every second one is left out."""

GRACE = 10.0
"""A worker that was asked to stop is killed after that time [s]."""

QUICK = 2.0
"""A run of at most that time limit is not queued behind long ones [s]."""

SPARE = 30.0
"""A worker is killed that long after half as much again as its time limit [s]."""

State = Literal["queued", "running", "done", "stopped", "cancelled", "failed", "interrupted"]
Kind = Literal["plan", "improve", "laps", "simulate", "flip", "opened"]

OVER = {"done", "stopped", "cancelled", "failed", "interrupted"}
"""States that are not left any more."""


@dataclass(slots=True, kw_only=True)
class Run:
    """A run, without its blobs.

    Attributes
    ----------
    number, name, kind, state
        Its identity and state.
    request
        The settings of its task: planner, options, time limit, seed.
    source
        The file or the draft that it was made from, for people and for the command line.
    based_on
        The run that it was made from, if it was.
    created, started, ended
        Seconds since 1970.
    status
        The status of the planner, for people: kind and values.
    figures
        The costs of its plan.
    error
        Why it failed.
    points
        Seconds since the start, and the flowtime that was reached then [ticks].
    revision
        How many plans there have been; 0 without one.
    has_report, has_payload
        Whether there is a report, and something to play that is not the plan alone.
    """

    number: int = 0
    name: str = ""
    kind: Kind = "plan"
    state: State = "queued"
    request: dict[str, Any] = field(default_factory=dict)
    source: str = ""
    based_on: int | None = None
    created: float = field(default_factory=time.time)
    started: float | None = None
    ended: float | None = None
    status: list[Any] | None = None
    figures: dict[str, Any] | None = None
    error: dict[str, Any] | None = None
    points: list[tuple[float, int]] = field(default_factory=list)
    revision: int = 0
    has_report: bool = False
    has_payload: bool = False

    def add_point(self, seconds: float, flowtime: int) -> None:
        """Add a point of the curve."""
        if len(self.points) >= MAX_POINTS:
            del self.points[1:-1:2]
        self.points.append((seconds, flowtime))


@dataclass(slots=True, kw_only=True)
class _Work:
    """The parts of a run while it is worked on."""

    job: WorkerCall | None = None
    wants: Literal["", "stopped", "cancelled"] = ""  # how the user has it end
    is_saving: asyncio.Lock = field(default_factory=asyncio.Lock)
    plan: tuple[bytes, dict[str, Any]] | None = None  # that waits to be saved, with its figures
    tasks: set[asyncio.Task[None]] = field(default_factory=set)


class Runs:
    """The runs of a studio.

    Parameters
    ----------
    store
        Where they are kept.
    crew
        Who works on them.
    desk
        Who works on quick ones, such as a change that somebody tries.
    """

    def __init__(self, store: Store, crew: Crew, desk: Crew) -> None:
        self._store = store
        self._crew = crew
        self._desk = desk
        self._runs: dict[int, Run] = {}
        self._work: dict[int, _Work] = {}
        self._queue: asyncio.Queue[int] = asyncio.Queue()
        self._quick: asyncio.Queue[int] = asyncio.Queue()
        self._listeners = Listeners()
        self._consumers: list[asyncio.Task[None]] = []
        self._adding = asyncio.Lock()
        self._saving = asyncio.Lock()

    async def start(self) -> None:
        """Resume the runs that were open when the server went down, and begin to work."""
        known = {run_field.name for run_field in fields(Run)}
        for number, data in await asyncio.to_thread(self._store.list_runs):
            run = Run(**{key: value for key, value in data.items() if key in known})
            run.number = number
            self._runs[number] = run
            if run.state == "running":
                run.state, run.ended = "interrupted", time.time()
                run.status = pack_note(Fact("studio went down"))
                await self._save(run)
            elif run.state == "queued":
                self._get_queue(run).put_nowait(number)
        works = [self._run_queue(self._queue, self._crew) for _ in range(self._crew.size)]
        works.append(self._run_queue(self._quick, self._desk))
        self._consumers = [asyncio.create_task(work) for work in works]

    def _get_queue(self, run: Run) -> asyncio.Queue[int]:
        limit = run.request.get("time_limit")
        return self._quick if limit is not None and limit <= QUICK else self._queue

    async def close(self) -> None:
        """End all work; runs that are running become interrupted when the studio starts again."""
        self.hang_up()
        for consumer in self._consumers:
            consumer.cancel()
        await asyncio.gather(*self._consumers, return_exceptions=True)

    def hang_up(self) -> None:
        """End all streams of events."""
        self._listeners.hang_up()

    def list_all(self) -> list[Run]:
        """Return all runs, the latest first."""
        return [self._runs[number] for number in sorted(self._runs, reverse=True)]

    def get(self, number: int) -> Run:
        """Return a run; `Refused` if there is none of that number."""
        if number not in self._runs:
            raise Refused(f"there is no run {number} (see the list of runs)", 404)
        return self._runs[number]

    async def read_blob(self, number: int, kind: str) -> bytes:
        """Return the ``plan``, the ``report``, the ``payload`` or the ``document`` of a run."""
        run = self.get(number)
        blob = await asyncio.to_thread(self._store.read_blob, number, kind)
        if blob is None:
            raise Refused(f"run {number} is {run.state} and has no {kind}", 404)
        return blob

    async def submit(
        self, run: Run, arguments: Mapping[str, Any], blobs: Mapping[str, bytes] | None = None
    ) -> Run:
        """Queue a run; its arguments beyond the request, a document for example, are kept beside.

        Raises
        ------
        Busy
            If too many runs wait, or are kept.
        """
        async with self._adding:
            waiting = sum(run.state == "queued" for run in self._runs.values())
            if waiting >= MAX_QUEUED:
                raise Busy(f"{waiting} runs are queued already (cancel some, or wait)")
            await self._add(run, {"arguments": json.dumps(arguments).encode(), **(blobs or {})})
        self._get_queue(run).put_nowait(run.number)
        return run

    async def repeat(self, number: int) -> Run:
        """Queue the same as a new run.

        Raises
        ------
        Refused
            For a plan that was opened, or made by a question.
        Busy
            As `submit`.
        """
        old = self.get(number)
        if old.kind in {"opened", "flip"}:
            raise Refused(f"run {number} was not planned here (improve it instead)", 409)
        arguments = json.loads(await self.read_blob(number, "arguments"))
        given = await asyncio.to_thread(self._store.read_blob, number, "given")
        run = Run(
            name=old.name,
            kind=old.kind,
            request=old.request,
            source=old.source,
            based_on=old.based_on,
        )
        return await self.submit(run, arguments, None if given is None else {"given": given})

    async def add_done(self, run: Run, plan: bytes) -> Run:
        """Keep a plan that was made elsewhere as a run that is done."""
        run.state = "done"
        run.started = run.ended = run.created
        async with self._adding:
            await self._add(run, {"plan": plan})
        return run

    async def _add(self, run: Run, blobs: Mapping[str, bytes]) -> None:
        if len(self._runs) >= MAX_KEPT:
            raise Busy(f"{len(self._runs)} runs are kept already (delete some)")
        # At once: a studio that goes down in between must not keep a run without its arguments.
        run.revision += "plan" in blobs
        run.number = await asyncio.to_thread(self._store.add_run, asdict(run), tuple(blobs.items()))
        self._runs[run.number] = run
        self._listeners.tell(run.number, "run", self.data(run))

    async def rename(self, number: int, name: str) -> Run:
        """Give a run a name."""
        run = self.get(number)
        run.name = name
        await self._save(run)
        self._listeners.tell(number, "run", self.data(run))
        return run

    async def stop(self, number: int) -> Run:
        """End a run with the best plan that there is."""
        return await self._end(number, "stopped")

    async def cancel(self, number: int) -> Run:
        """End a run immediately."""
        return await self._end(number, "cancelled")

    async def _end(self, number: int, wanted: Literal["stopped", "cancelled"]) -> Run:
        run, work = self.get(number), self._work.get(number)
        if run.state == "queued":
            run.state = wanted
            await self._finish_run(run)
        elif work is not None:
            work.wants = wanted
            if work.job is not None and wanted == "stopped":
                work.job.stop()
                asyncio.get_running_loop().call_later(GRACE, work.job.kill)
            elif work.job is not None:
                work.job.kill()
        return run

    async def delete(self, number: int) -> None:
        """Cancel a run, and forget it."""
        await self.cancel(number)
        self._runs.pop(number, None)
        await asyncio.to_thread(self._store.delete_run, number)
        self._listeners.tell(number, "deleted", {})

    @staticmethod
    def data(run: Run) -> dict[str, Any]:
        """Return a run as the API describes it."""
        return {**asdict(run), "has_plan": run.revision > 0}

    async def _run_queue(self, queue: asyncio.Queue[int], crew: Crew) -> None:
        while True:
            run = self._runs.get(await queue.get())
            if run is None or run.state != "queued":
                continue
            try:
                await self._run_one(run, crew)
            except Exception as error:  # noqa: BLE001 (not even its end can be kept: go on)
                run.state, run.error = "failed", as_error(error)
                self._listeners.tell(run.number, "run", self.data(run))
                self._listeners.end(run.number)

    async def _run_one(self, run: Run, crew: Crew) -> None:
        work = self._work[run.number] = _Work()
        try:
            run.state, run.started = "running", time.time()
            await self._save(run)
            self._listeners.tell(run.number, "run", self.data(run))
            await self._finish(run, work, crew)
        except StudioError as failed:
            await asyncio.gather(*work.tasks)
            is_wanted = work.wants == "cancelled" or (work.wants and run.revision)
            run.state, run.error = work.wants or "failed", None if is_wanted else failed.error
            run.status = pack_note(Fact("best plan kept")) if run.revision else None
        except Exception as error:  # noqa: BLE001 (the other runs go on)
            run.state, run.error = "failed", as_error(error)
        finally:
            self._work.pop(run.number, None)
        await self._finish_run(run)

    async def _finish_run(self, run: Run) -> None:
        """Keep how a run ended, and hang up."""
        run.ended = time.time()
        await self._save(run)
        self._listeners.tell(run.number, "run", self.data(run))
        self._listeners.end(run.number)

    async def _finish(self, run: Run, work: _Work, crew: Crew) -> None:
        """Have the task of a run done, and note how it ended."""
        arguments = json.loads(await self.read_blob(run.number, "arguments"))
        given = await asyncio.to_thread(self._store.read_blob, run.number, "given")
        limit = run.request.get("time_limit") or 0.0
        work.job = WorkerCall(
            run.kind,
            {**run.request, **arguments},
            [] if given is None else [given],
            limit=1.5 * limit + SPARE,
            on_event=lambda event, blobs: self._note(run, work, event, blobs),
        )
        if work.wants:
            run.state = work.wants
            return
        result, blobs = await crew.do(work.job)
        await asyncio.gather(*work.tasks)
        await self._keep(run, result, blobs)
        run.state = work.wants or "done"

    async def _keep(self, run: Run, result: dict[str, Any], blobs: list[bytes]) -> None:
        """Keep the result of a task: a report, something to play, a plan."""
        kept_blobs, left = dict[str, bytes](), list(blobs)
        if "report" in result:
            kept_blobs["report"] = json.dumps(result["report"]).encode()
            run.has_report = True
        if result.get("has_payload"):
            kept_blobs["payload"] = left.pop(0)
            run.has_payload = True
        if left:
            kept_blobs["plan"] = left.pop(0)
        figures = result.get("figures")
        run.status = result.get("status") or run.status
        if run.kind in {"plan", "improve"} and figures and run.started:
            run.add_point(round(time.time() - run.started, 3), figures["flowtime"])
        await self._save(run, kept_blobs, figures)

    def _note(self, run: Run, work: _Work, event: dict[str, Any], blobs: list[bytes]) -> None:
        """Note progress, and tell listeners."""
        if "flowtime" in event:
            run.add_point(event["seconds"], event["flowtime"])
        progress = {key: event[key] for key in event if key != "figures"}
        self._listeners.tell(run.number, "progress", progress)
        if blobs:
            work.plan = blobs[0], event["figures"]
            saving = asyncio.create_task(self._save_plan(run, work))
            work.tasks.add(saving)
            saving.add_done_callback(work.tasks.discard)

    async def _save_plan(self, run: Run, work: _Work) -> None:
        async with work.is_saving:
            unsaved, work.plan = work.plan, None
            if unsaved is None:
                return  # a later one is saved already
            plan, figures = unsaved
            try:
                await self._save(run, {"plan": plan}, figures)
            except StudioError:
                return  # a later one may find room; the last one says why there is none
        event = {"revision": run.revision, "figures": figures}
        self._listeners.tell(run.number, "plan", event)

    async def _save(
        self,
        run: Run,
        blobs: Mapping[str, bytes] | None = None,
        figures: dict[str, Any] | None = None,
    ) -> None:
        """Keep a run, one after the other; with a plan it has a new revision from then on."""
        async with self._saving:
            run.figures = figures or run.figures
            revision = run.revision + ("plan" in (blobs or {}))
            data, listed = {**asdict(run), "revision": revision}, list((blobs or {}).items())
            await asyncio.to_thread(self._store.put_run, run.number, data, listed)
            run.revision = revision

    def listen(self, number: int) -> AsyncGenerator[Event | None]:
        """Yield the events of a run until it is over: first all that is known.

        Raises
        ------
        Refused
            If there is none of that number.
        Busy
            If too many listen already.
        """
        run = self.get(number)
        is_over = run.state in OVER and number not in self._work
        return self._listeners.listen(number, ("run", self.data(run)), is_over=is_over)

    def listen_to_all(self) -> AsyncGenerator[Event | None]:
        """Yield the events of all runs for ever: first the list of runs."""
        return self._listeners.listen(
            None, ("runs", {"runs": list(map(self.data, self.list_all()))})
        )
