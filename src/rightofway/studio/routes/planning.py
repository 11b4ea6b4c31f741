"""Planners, runs with their events, exports, comparison, and questions about plans."""

from __future__ import annotations

import asyncio
import json
import re
import shlex
from collections.abc import AsyncGenerator, AsyncIterator, Sequence
from contextlib import aclosing
from pathlib import PurePosixPath
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Request, Response
from fastapi.responses import StreamingResponse

from rightofway.io import FOREIGN_FORMATS
from rightofway.metrics import MAX_COMPARED
from rightofway.planners import DEFAULT, IMPROVER, find, registered
from rightofway.studio.errors import Refused
from rightofway.studio.events import Event
from rightofway.studio.routes.models import (
    Flip,
    InStudio,
    NewImprovement,
    NewLaps,
    NewPlan,
    NewRun,
    NewSimulation,
    OtherLaps,
    Rename,
    RunNumber,
    unzipped,
)
from rightofway.studio.runs import Run, Runs
from rightofway.studio.session import Studio, checked_json

EXPORTS = {
    "json": "application/json",
    "xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    "html": "text/html; charset=utf-8",
    "png": "image/png",
    "gif": "image/gif",
}
"""Endings of exports, and their media types."""

DRAWN_BY = {"layout", "picture"}
"""Keys of a map whose picture and curves a plan file has not, or in another folder."""

NAME_IN_FILE = 40
"""Characters of a run's name in the name of a file."""

ALONE = "sandbox allow-scripts allow-downloads; frame-ancestors 'self'"
"""Beside the page's own policy: it is an origin of its own, so its scripts cannot use the API."""

Others = Annotated[
    list[int],
    Query(max_length=MAX_COMPARED - 1, description="runs to show beside it, at most seven"),
]
"""Runs beside another one; each is a parameter of its own: `?other=2&other=3`."""

router = APIRouter()


@router.get("/planners", tags=["planners"])
def list_planners() -> dict[str, Any]:
    """List the planners and their options, those of other packages too."""
    return {
        "default": DEFAULT,
        "improver": IMPROVER,
        "planners": [
            {
                "name": spec.name,
                "summary": spec.summary,
                "improves": spec.improves,
                "knows_sizes": spec.knows_sizes,
                "options": [
                    {
                        "name": option.name,
                        "default": option.default,
                        "summary": option.summary,
                        "choices": list(option.choices),
                        "least": option.least,
                    }
                    for option in spec.options
                ],
            }
            for spec in registered().values()
        ],
    }


@router.get("/choices", tags=["planners"])
async def list_choices(studio: InStudio) -> dict[str, Any]:
    """List rules of laps, notations of delays, and formats of other programs for exports."""
    result, _ = await studio.ask("choices")
    return dict(result)


@router.get("/runs", tags=["runs"])
async def list_runs(studio: InStudio) -> dict[str, Any]:
    """List the runs, the latest first."""
    return {"runs": [Runs.data(run) for run in studio.runs.all()], "are_kept": studio.store.is_kept}


@router.post("/runs", tags=["runs"], status_code=202)
async def create_run(studio: InStudio, new: Annotated[NewRun, Body()]) -> dict[str, Any]:
    """Queue a run: a plan, an improvement, laps, or a simulation."""
    match new:
        case NewPlan():
            request = new.settings()
            if new.start is not None:
                request["start"] = new.start
            run = Run(kind="plan", source=new.source, based_on=new.based_on, request=request)
        case NewImprovement():
            run = Run(kind="improve", based_on=new.based_on, request=new.settings())
        case NewLaps():
            request = new.model_dump(include={"rule", "routes", "time_limit", "seed"})
            run = Run(kind="laps", source=new.source, request=request)
        case NewSimulation():
            keys = {"delays", "runs", "run", "seed", "switch", "replan", "time_limit"}
            run = Run(kind="simulate", based_on=new.based_on, request=new.model_dump(include=keys))
    run.name = new.name
    if isinstance(new, NewPlan | NewImprovement):
        default = DEFAULT if isinstance(new, NewPlan) else IMPROVER
        find(new.planner or default).settle(new.options)
    arguments: dict[str, Any] = {}
    given_by = new.start if isinstance(new, NewPlan) else None
    if isinstance(new, NewPlan | NewLaps):
        arguments = {"document": new.document, "folder": studio.place(new.folder)}
        checked_json(arguments)
    else:
        given_by = new.based_on
    blobs = {} if given_by is None else {"given": await studio.runs.blob(given_by, "plan")}
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
    """Cancel a run where it is not over, and forget it."""
    await studio.runs.delete(number)
    return {"number": number}


@router.post("/runs/{number}/stop", tags=["runs"])
async def stop_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Ask a run to end with the best plan that it has; its state changes when it has."""
    return Runs.data(await studio.runs.stop(number))


@router.post("/runs/{number}/cancel", tags=["runs"])
async def cancel_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """End a run at once."""
    return Runs.data(await studio.runs.cancel(number))


@router.post("/runs/{number}/again", tags=["runs"], status_code=202)
async def repeat_run(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Queue the same as a new run, for example after the studio went down."""
    return Runs.data(await studio.runs.again(number))


@router.get("/runs/{number}/events", tags=["runs"], response_class=StreamingResponse)
async def run_events(studio: InStudio, number: RunNumber) -> StreamingResponse:
    """Send the events of a run as they come, as server-sent events.

    ``run``: the run, at first and whenever its state changes. ``progress``: seconds, flowtime,
    lower bound or a message. ``plan``: there is a better plan so far; get its payload. The stream
    ends when the run is over.
    """
    return await _stream(studio.runs.listen(number))


@router.get("/events", tags=["runs"], response_class=StreamingResponse)
async def all_events(studio: InStudio) -> StreamingResponse:
    """Send the events of all runs, each with the ``number`` of its run, for ever.

    First come ``runs``, the list; then ``run``, ``progress`` and ``plan`` as for one run, and
    ``deleted``. A page needs no other stream: browsers have six connections to a server.
    """
    return await _stream(studio.runs.listen_to_all())


async def _stream(events: AsyncGenerator[Event | None]) -> StreamingResponse:
    first = await anext(events)

    async def lines() -> AsyncIterator[str]:
        async with aclosing(events):
            yield _line(first)
            async for event in events:
                yield _line(event)

    return StreamingResponse(lines(), media_type="text/event-stream")


def _line(event: Event | None) -> str:
    return ":\n\n" if event is None else f"event: {event[0]}\ndata: {json.dumps(event[1])}\n\n"


@router.get("/runs/{number}/payload", tags=["plans"], response_class=Response)
async def run_payload(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    other: Others = [],  # noqa: B006 (FastAPI copies it)
    replay: Annotated[
        int | None, Query(ge=0, description="run of a simulation to play, from 0")
    ] = None,
) -> Response:
    """Return what the viewer plays: the plan, or the plan so far, perhaps beside others."""
    run = studio.runs.get(number)
    if replay is not None:
        content = await _replayed(studio, run, replay)
    elif run.has_payload and not other:
        content = await studio.runs.blob(number, "payload")
    else:
        content = await _played(studio, "payload", run, other)
    return unzipped(request, content)


async def _replayed(studio: Studio, run: Run, replay: int) -> bytes:
    """Return what the viewer plays of one run of a simulation."""
    most = run.request.get("runs", 0)
    if replay >= most:
        raise Refused(f"run {run.number} has no run {replay} to play (it made {most})", 404)
    plan = await studio.runs.blob(run.number, "plan")
    asked = {key: run.request[key] for key in ("delays", "seed", "switch", "replan")}
    _, blobs = await studio.ask("replay", plan, run=replay, **asked)
    return blobs[0]


@router.get("/runs/{number}/page", tags=["plans"], response_class=Response)
async def run_page(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    other: Others = [],  # noqa: B006 (FastAPI copies it)
) -> Response:
    """Return the page of the plan, perhaps beside others, as `rightofway show` writes it."""
    content = await _played(studio, "page", studio.runs.get(number), other)
    headers = {"content-security-policy": ALONE}
    return unzipped(request, content, "text/html; charset=utf-8", headers)


async def _played(studio: Studio, task: str, run: Run, others: Sequence[int]) -> bytes:
    """Return the payload or the page of the plan that a run has now, perhaps beside others."""
    runs = [run, *map(studio.runs.get, others)]
    shown = shown_of(runs)

    async def make() -> bytes:
        plans = [await studio.runs.blob(each.number, "plan") for each in runs]
        origins = [await origin_of(studio, each) for each in runs]
        drawn = [{**each, "origin": it} for each, it in zip(shown, origins, strict=True)]
        _, blobs = await studio.ask(task, *plans, shown=drawn)
        return blobs[0]

    titles = [each["title"] for each in shown]
    key = (task, *((each.number, each.revision) for each in runs), *titles)
    return await studio.played.get(key, make)


async def origin_of(studio: Studio, run: Run) -> dict[str, Any] | None:
    """Return the document that a plan was made from, where it draws more than a plan file does."""
    while run.kind not in {"plan", "laps"}:
        if run.based_on is None:
            return None
        try:
            run = studio.runs.get(run.based_on)
        except Refused:  # it was deleted
            return None
    found = json.loads(await studio.runs.blob(run.number, "arguments"))
    shape = found["document"].get("map")
    if not isinstance(shape, dict) or not shape.keys() & DRAWN_BY:
        return None
    return {"document": found["document"], "folder": found["folder"]}


def shown_of(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """Return what a page says of runs: titles, different for each of several, and seconds."""
    if len(runs) == 1:
        titles = [runs[0].name or f"{file_of(runs[0])} #{runs[0].number}".lstrip()]
    else:
        titles = [run.name or f"#{run.number}" for run in runs]
        if len(set(titles)) < len(titles):
            titles = [f"#{run.number} {run.name}".rstrip() for run in runs]
    return [
        {"title": title, "seconds": seconds_of(run)}
        for title, run in zip(titles, runs, strict=True)
    ]


def file_of(run: Run) -> str:
    """Return the file that a run was made from; empty for a draft, whose name has no ending."""
    return run.source if PurePosixPath(run.source).suffix else ""


def file_name(runs: Sequence[Run], ending: str) -> str:
    """Return how a file of plans is called: ``floor-plan-3-first-try.html``."""
    stem = PurePosixPath(file_of(runs[0])).name.split(".")[0]
    numbers = "-".join(str(run.number) for run in runs)
    name = runs[0].name if len(runs) == 1 else ""
    words = (re.sub(r"[^A-Za-z0-9_]+", "-", part).strip("-") for part in (stem, name))
    first, last = words
    parts = [first, f"plan-{numbers}", last[:NAME_IN_FILE]]
    return f"{'-'.join(filter(None, parts))}.{ending}"


def seconds_of(run: Run) -> float | None:
    """Return how long a run took; None for what was not planned here."""
    if run.started is None or run.ended is None or run.ended <= run.started:
        return None
    return round(run.ended - run.started, 3)


@router.get("/runs/{number}/export/{form}", tags=["plans"], response_class=Response)
async def export_run(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    form: str,
    other: Others = [],  # noqa: B006 (FastAPI copies it)
) -> Response:
    """Return the plan as a file: json, xlsx, html, png, gif, or a format of another program.

    The page (html) may have other plans beside it.
    """
    if form not in EXPORTS and form not in FOREIGN_FORMATS:
        known = ", ".join([*EXPORTS, *FOREIGN_FORMATS])
        raise Refused(f"{form[:50]!r} is no format (give one of: {known})", 404)
    if other and form != "html":
        raise Refused(f"plans are compared on a page (ask for html, not {form})", 422)
    if form == "html":
        content = await _played(studio, "page", studio.runs.get(number), other)
    else:
        plan = await studio.runs.blob(number, "plan")
        origin = await origin_of(studio, studio.runs.get(number))
        content = (await studio.ask("export", plan, form=form, origin=origin))[1][0]
    runs = list(map(studio.runs.get, [number, *other]))
    name = file_name(runs, form if form in EXPORTS else f"{form}.txt")
    headers = {
        "content-disposition": f'attachment; filename="{name}"',
        "content-security-policy": ALONE,
    }
    media = EXPORTS.get(form, "text/plain; charset=utf-8")
    return unzipped(request, content, media, headers)


@router.get("/runs/{number}/document", tags=["plans"])
async def run_document(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return the document that a run was made from, so that it can be changed."""
    if studio.runs.get(number).kind in {"plan", "laps"}:
        found = json.loads(await studio.runs.blob(number, "arguments"))
    else:  # made from a plan, in which the scenario is whole
        plan = json.loads(await studio.runs.blob(number, "plan"))
        found = {"document": plan["scenario"], "folder": "."}
    return {"document": found["document"], "folder": found["folder"].removeprefix(".")}


@router.get("/runs/{number}/report", tags=["plans"], response_class=Response)
async def run_report(studio: InStudio, number: RunNumber) -> Response:
    """Return the report of `plan`, `laps` or `simulate` with ``--json``."""
    run = studio.runs.get(number)
    if run.has_report:
        content = await studio.runs.blob(number, "report")
    else:
        result, _ = await studio.ask("summary", await studio.runs.blob(number, "plan"))
        content = json.dumps(result).encode()
    return Response(content, media_type="application/json")


@router.get("/runs/{number}/command", tags=["plans"])
async def run_command(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return the command line that gives the same."""
    return {"command": command_of(studio.runs.get(number))}


def command_of(run: Run) -> str:
    """Return the command line of a run."""
    request, words = run.request, ["rightofway", run.kind]
    if run.kind in {"opened", "flip"}:
        raise Refused(f"run {run.number} was not made by a command (export its plan)", 404)
    unnamed = "scenario.yaml" if run.kind in {"plan", "laps"} else "plan.json"
    source = file_of(run) or unnamed
    words.append(f"./{source}" if source.startswith("-") else source)
    if run.kind in {"plan", "improve"}:
        default = DEFAULT if run.kind == "plan" else IMPROVER
        words += ["--planner", request.get("planner", default)]
        for name, value in request["options"].items():
            words += ["--option", f"{name}={value}"]
    if "start" in request:
        words += ["--start", f"run-{request['start']}.json"]
    for key in ("rule", "routes", "runs", "run", "seed"):
        if request.get(key) not in {None, "typical", "worst"}:
            words += [f"--{key}", str(request[key])]
    for delay in request.get("delays", ()):
        words += ["--delays", delay]
    words += [f"--{key}" for key in ("switch", "replan") if request.get(key)]
    if run.kind != "simulate":
        words += ["--time-limit", f"{request['time_limit']:g}"]
    return shlex.join(words)


@router.get("/compare", tags=["plans"])
async def compare(
    studio: InStudio, run: Annotated[list[int], Query(min_length=2, max_length=MAX_COMPARED)]
) -> dict[str, Any]:
    """Compare plans: what each costs, when each robot completes, what their scenarios change.

    Robots are the same where their names are. ``comparison`` counts all times in one tick.
    """
    runs = list(map(studio.runs.get, run))
    plans = await asyncio.gather(*(studio.runs.blob(number, "plan") for number in run))
    result, _ = await studio.ask("compare", *plans, shown=shown_of(runs))
    return {"runs": run, **result}


@router.get("/runs/{number}/changes", tags=["plans"])
async def run_changes(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return in what the scenario of a run differs from that of the run ``before``.

    That is the run that it was made from, or the last one before it of the same file; null without
    one.
    """
    run = studio.runs.get(number)
    before = _before(studio, run)
    if before is None or not run.revision:
        return {"before": None, "changes": []}

    async def make() -> bytes:
        plans = [await studio.runs.blob(each, "plan") for each in (before.number, number)]
        result, _ = await studio.ask("changes", *plans)
        return json.dumps({"before": before.number, **result}).encode()

    return dict(json.loads(await studio.played.get(("changes", before.number, number), make)))


def _before(studio: Studio, run: Run) -> Run | None:
    earlier = [each for each in studio.runs.all() if each.number < run.number and each.revision]
    made_from = [each for each in earlier if each.number == run.based_on]
    same_file = [each for each in earlier if each.source == run.source]
    return next(iter([*made_from, *same_file]), None)


@router.get("/runs/{number}/losses", tags=["questions"], response_class=Response)
async def run_losses(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    robot: Annotated[str | None, Query(max_length=200)] = None,
) -> Response:
    """Tell why robots lose time: each wait in a sentence, with the decision behind it."""
    plan = await studio.runs.blob(number, "plan")
    _, blobs = await studio.ask("losses", plan, robot=robot)
    return unzipped(request, blobs[0])


@router.post("/runs/{number}/laps", tags=["questions"])
async def other_laps(studio: InStudio, number: RunNumber, asked: OtherLaps) -> dict[str, Any]:
    """Let robots repeat their trips in a new order, with another speed, work time or headway."""
    run = studio.runs.get(number)
    if run.kind != "laps":
        raise Refused(f"run {number} has no laps (queue a run of the kind laps)", 404)
    arguments = json.loads(await studio.runs.blob(number, "arguments"))
    settings = {**run.request, **arguments, **asked.model_dump(), "value": str(asked.value)}
    result, _ = await studio.ask("laps_if", **settings)
    return dict(result)


@router.post("/runs/{number}/flip", tags=["questions"])
async def flip(studio: InStudio, number: RunNumber, flipped: Flip) -> dict[str, Any]:
    """Let a robot that waits go first, and keep the timetable that follows as a run."""
    plan = await studio.runs.blob(number, "plan")
    request = flipped.model_dump(exclude={"name"})
    result, blobs = await studio.ask("flip", plan, **request)
    name = flipped.name or f"{flipped.waits} before {flipped.goes_first}"
    run = Run(kind="flip", name=name, based_on=number, request=request)
    run.figures, run.status = result["figures"], result["status"]
    return {"before": result["before"], "run": Runs.data(await studio.runs.add_done(run, blobs[0]))}
