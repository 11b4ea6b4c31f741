"""Runs: queued, listed, named, stopped; and their events."""

from __future__ import annotations

import json
from collections.abc import AsyncGenerator, AsyncIterator
from contextlib import aclosing
from typing import Annotated, Any

from fastapi import APIRouter, Body
from fastapi.responses import StreamingResponse
from starlette.types import Receive, Scope, Send

from rightofway.planners import DEFAULT_PLANNER, IMPROVER, find
from rightofway.studio.events import Event
from rightofway.studio.routes.models import (
    InStudio,
    NewImprovement,
    NewLaps,
    NewPlan,
    NewRun,
    NewSimulation,
    Rename,
    RunNumber,
)
from rightofway.studio.runs import Run, Runs
from rightofway.studio.session import check_json

router = APIRouter()


@router.get("/runs", tags=["runs"])
async def list_runs(studio: InStudio) -> dict[str, Any]:
    """List the runs, the latest first."""
    return {
        "runs": [Runs.data(run) for run in studio.runs.list_all()],
        "are_kept": studio.store.is_kept,
    }


@router.post("/runs", tags=["runs"], status_code=202)
async def create_run(studio: InStudio, new: Annotated[NewRun, Body()]) -> dict[str, Any]:
    """Queue a run: a plan, an improvement, laps, or a simulation."""
    match new:
        case NewPlan():
            request = new.list_settings()
            if new.start is not None:
                request["start"] = new.start
            run = Run(kind="plan", source=new.source, based_on=new.based_on, request=request)
        case NewImprovement():
            run = Run(kind="improve", based_on=new.based_on, request=new.list_settings())
        case NewLaps():
            request = new.model_dump(include={"rule", "routes", "time_limit", "seed"})
            run = Run(kind="laps", source=new.source, request=request)
        case NewSimulation():
            keys = {"delays", "runs", "run", "seed", "switch", "replan", "time_limit"}
            run = Run(kind="simulate", based_on=new.based_on, request=new.model_dump(include=keys))
    run.name = new.name
    if isinstance(new, NewPlan | NewImprovement):
        default = DEFAULT_PLANNER if isinstance(new, NewPlan) else IMPROVER
        find(new.planner or default).settle(new.options)
    arguments: dict[str, Any] = {}
    given_by = new.start if isinstance(new, NewPlan) else None
    if isinstance(new, NewPlan | NewLaps):
        arguments = {"document": new.document, "folder": studio.place(new.folder)}
        check_json(arguments)
    else:
        given_by = new.based_on
    blobs = {} if given_by is None else {"given": await studio.runs.read_blob(given_by, "plan")}
    return Runs.data(await studio.runs.submit(run, arguments, blobs))


@router.get("/runs/{number}", tags=["runs"])
async def get_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return a run."""
    return Runs.data(studio.runs.get(number))


@router.patch("/runs/{number}", tags=["runs"])
async def rename_run(studio: InStudio, number: RunNumber, rename: Rename) -> dict[str, Any]:
    """Name a run."""
    return Runs.data(await studio.runs.rename(number, rename.name))


@router.delete("/runs/{number}", tags=["runs"])
async def delete_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Cancel a run if it has not ended, and delete it."""
    await studio.runs.delete(number)
    return {"number": number}


@router.post("/runs/{number}/stop", tags=["runs"])
async def stop_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """End a run with its best plan so far; its state changes when it has ended."""
    return Runs.data(await studio.runs.stop(number))


@router.post("/runs/{number}/cancel", tags=["runs"])
async def cancel_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """End a run immediately."""
    return Runs.data(await studio.runs.cancel(number))


@router.post("/runs/{number}/again", tags=["runs"], status_code=202)
async def repeat_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Queue the same as a new run, for example after the studio went down."""
    return Runs.data(await studio.runs.repeat(number))


@router.get("/runs/{number}/events", tags=["runs"], response_class=StreamingResponse)
async def stream_run_events(studio: InStudio, number: RunNumber) -> StreamingResponse:
    """Send the events of a run as they come, as server-sent events.

    ``run``: the run, at first and whenever its state changes. ``progress``: seconds, flowtime,
    lower bound or a message. ``plan``: there is a better plan so far; get its payload. The stream
    ends when the run is over.
    """
    return await _make_stream(studio.runs.listen(number))


@router.get("/events", tags=["runs"], response_class=StreamingResponse)
async def stream_all_events(studio: InStudio) -> StreamingResponse:
    """Send the events of all runs, each with the ``number`` of its run, permanently.

    First come ``runs``, the list; then ``run``, ``progress`` and ``plan`` as for one run, and
    ``deleted``. A page needs no other stream: browsers have six connections to a server.
    """
    return await _make_stream(studio.runs.listen_to_all())


class _Stream(StreamingResponse):
    """Events as lines; their listener is free as soon as nothing more can be sent."""

    def __init__(self, first: Event | None, events: AsyncGenerator[Event | None]) -> None:
        super().__init__(self._yield_lines(first), media_type="text/event-stream")
        self._events = events

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async with aclosing(self._events):
            await super().__call__(scope, receive, send)

    async def _yield_lines(self, first: Event | None) -> AsyncIterator[str]:
        yield _write_line(first)
        async for event in self._events:
            yield _write_line(event)


async def _make_stream(events: AsyncGenerator[Event | None]) -> StreamingResponse:
    return _Stream(await anext(events), events)


def _write_line(event: Event | None) -> str:
    return ":\n\n" if event is None else f"event: {event[0]}\ndata: {json.dumps(event[1])}\n\n"
