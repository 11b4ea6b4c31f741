"""Results of a run: playback, pages, files, the document; and plans compared."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Sequence
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response

from rightofway.io import FOREIGN_FORMATS
from rightofway.metrics import MAX_COMPARED
from rightofway.studio.errors import Refused
from rightofway.studio.routes.models import (
    InStudio,
    RunNumber,
    answer_zipped,
)
from rightofway.studio.runs import Run
from rightofway.studio.session import Studio
from rightofway.studio.titles import describe_shown, make_command, make_file_name

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

ALONE = "sandbox allow-scripts allow-downloads; frame-ancestors 'self'"
"""Beside the page's own policy: it is an origin of its own, so its scripts cannot use the API."""

Others = Annotated[
    list[int],
    Query(max_length=MAX_COMPARED - 1, description="runs to show beside it, at most seven"),
]
"""Runs beside another one; each is a parameter of its own: `?other=2&other=3`."""


router = APIRouter()


@router.get("/runs/{number}/payload", tags=["plans"], response_class=Response)
async def get_run_payload(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    other: Others = [],  # noqa: B006 (FastAPI copies it)
    replay: Annotated[
        int | None, Query(ge=0, description="run of a simulation to play, from 0")
    ] = None,
) -> Response:
    """Return the playback of the viewer: the plan, or the plan so far, perhaps next to others."""
    run = studio.runs.get(number)
    if replay is not None:
        content = await _make_replay(studio, run, replay)
    elif run.has_payload and not other:
        content = await studio.runs.read_blob(number, "payload")
    else:
        content = await _make_played(studio, "payload", run, other)
    return answer_zipped(request, content)


async def _make_replay(studio: Studio, run: Run, replay: int) -> bytes:
    """Return the playback of one run of a simulation."""
    most = run.request.get("runs", 0)
    if replay >= most:
        raise Refused(f"run {run.number} has no run {replay} to play (it made {most})", 404)
    plan = await studio.runs.read_blob(run.number, "plan")
    asked = {key: run.request[key] for key in ("delays", "seed", "switch", "replan")}
    _, blobs = await studio.ask("replay", plan, run=replay, **asked)
    return blobs[0]


@router.get("/runs/{number}/page", tags=["plans"], response_class=Response)
async def get_run_page(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    other: Others = [],  # noqa: B006 (FastAPI copies it)
) -> Response:
    """Return the page of the plan, perhaps next to others, as `rightofway show` writes it."""
    content = await _make_played(studio, "page", studio.runs.get(number), other)
    headers = {"content-security-policy": ALONE}
    return answer_zipped(request, content, "text/html; charset=utf-8", headers)


async def _make_played(studio: Studio, task: str, run: Run, others: Sequence[int]) -> bytes:
    """Return the payload or the page of the plan that a run has now, perhaps next to others."""
    runs = [run, *map(studio.runs.get, others)]
    shown = describe_shown(runs)

    async def make() -> bytes:
        plans = [await studio.runs.read_blob(run.number, "plan") for run in runs]
        origins = [await find_origin(studio, run) for run in runs]
        drawn = [{**data, "origin": origin} for data, origin in zip(shown, origins, strict=True)]
        _, blobs = await studio.ask(task, *plans, shown=drawn)
        return blobs[0]

    titles = [data["title"] for data in shown]
    key = (task, *((run.number, run.revision) for run in runs), *titles)
    return await studio.played.get(key, make)


async def find_origin(studio: Studio, run: Run) -> dict[str, Any] | None:
    """Return the document that a plan was made from, where it draws more than a plan file does."""
    while run.kind not in {"plan", "laps"}:
        if run.based_on is None:
            return None
        try:
            run = studio.runs.get(run.based_on)
        except Refused:  # it was deleted
            return None
    arguments = json.loads(await studio.runs.read_blob(run.number, "arguments"))
    shape = arguments["document"].get("map")
    if not isinstance(shape, dict) or not shape.keys() & DRAWN_BY:
        return None
    return {"document": arguments["document"], "folder": arguments["folder"]}


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
        content = await _make_played(studio, "page", studio.runs.get(number), other)
    else:
        plan = await studio.runs.read_blob(number, "plan")
        origin = await find_origin(studio, studio.runs.get(number))
        content = (await studio.ask("export", plan, form=form, origin=origin))[1][0]
    runs = list(map(studio.runs.get, [number, *other]))
    name = make_file_name(runs, form if form in EXPORTS else f"{form}.txt")
    headers = {
        "content-disposition": f'attachment; filename="{name}"',
        "content-security-policy": ALONE,
    }
    media = EXPORTS.get(form, "text/plain; charset=utf-8")
    return answer_zipped(request, content, media, headers)


@router.get("/runs/{number}/document", tags=["plans"])
async def get_run_document(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return the document that a run was made from, so that it can be changed."""
    if studio.runs.get(number).kind in {"plan", "laps"}:
        arguments = json.loads(await studio.runs.read_blob(number, "arguments"))
    else:  # made from a plan, in which the scenario is whole
        plan = json.loads(await studio.runs.read_blob(number, "plan"))
        arguments = {"document": plan["scenario"], "folder": "."}
    return {"document": arguments["document"], "folder": arguments["folder"].removeprefix(".")}


@router.get("/runs/{number}/report", tags=["plans"], response_class=Response)
async def get_run_report(studio: InStudio, number: RunNumber) -> Response:
    """Return the report of `plan`, `laps` or `simulate` with ``--json``."""
    run = studio.runs.get(number)
    if run.has_report:
        content = await studio.runs.read_blob(number, "report")
    else:
        result, _ = await studio.ask("summary", await studio.runs.read_blob(number, "plan"))
        content = json.dumps(result).encode()
    return Response(content, media_type="application/json")


@router.get("/runs/{number}/command", tags=["plans"])
async def get_run_command(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return the command line that gives the same."""
    return {"command": make_command(studio.runs.get(number))}


@router.get("/compare", tags=["plans"])
async def compare(
    studio: InStudio, run: Annotated[list[int], Query(min_length=2, max_length=MAX_COMPARED)]
) -> dict[str, Any]:
    """Compare plans: their costs, when each robot completes, changes of their scenarios.

    Robots are the same where their names are. ``comparison`` counts all times in one tick.
    """
    runs = list(map(studio.runs.get, run))
    plans = await asyncio.gather(*(studio.runs.read_blob(number, "plan") for number in run))
    result, _ = await studio.ask("compare", *plans, shown=describe_shown(runs))
    return {"runs": run, **result}


@router.get("/runs/{number}/changes", tags=["plans"])
async def get_run_changes(studio: InStudio, number: RunNumber) -> dict[str, Any]:
    """Return the differences of the scenario of a run from that of the run ``before``.

    That is the run that it was made from, or the last one before it of the same file; null without
    one.
    """
    run = studio.runs.get(number)
    before = _find_before(studio, run)
    if before is None or not run.revision:
        return {"before": None, "changes": []}

    async def make() -> bytes:
        plans = [
            await studio.runs.read_blob(run_number, "plan")
            for run_number in (before.number, number)
        ]
        result, _ = await studio.ask("changes", *plans)
        return json.dumps({"before": before.number, **result}).encode()

    return dict(json.loads(await studio.played.get(("changes", before.number, number), make)))


def _find_before(studio: Studio, run: Run) -> Run | None:
    earlier = [
        other for other in studio.runs.list_all() if other.number < run.number and other.revision
    ]
    made_from = [other for other in earlier if other.number == run.based_on]
    same_file = [other for other in earlier if other.source == run.source]
    return next(iter([*made_from, *same_file]), None)
