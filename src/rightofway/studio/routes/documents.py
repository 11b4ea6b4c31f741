"""Files of the folder, documents in them, drafts of documents."""

from __future__ import annotations

import asyncio
import os
from dataclasses import asdict
from itertools import chain
from itertools import count as count_from
from pathlib import PurePosixPath
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Request, Response

from rightofway.errors import InputError
from rightofway.studio.errors import Busy, Refused
from rightofway.studio.routes.models import (
    Deal,
    DraftBody,
    FilePath,
    InStudio,
    Placed,
    Rows,
    Save,
    Survey,
    ToText,
    answer_zipped,
)
from rightofway.studio.runs import Run, Runs
from rightofway.studio.session import Studio, check_json
from rightofway.studio.workspace import KINDS, LONGEST_NAME, compute_revision, make_portable

MAX_DRAFTS = 200
"""Drafts that are kept."""

LONGEST_STEM = LONGEST_NAME - 20
"""Bytes of a name that is suggested, without a number and an ending."""

router = APIRouter()
SAVED = {".yaml", ".yml", ".json", ".xlsx"}
"""Endings of files that documents are saved in."""

MEDIA = {
    ".json": "application/json",
    ".xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
}


def free_name(studio: Studio, path: str) -> str:
    """Return the name of a scenario beside a file: one that no other file has."""
    given = PurePosixPath(path)
    stem = make_portable(os.fsencode(given.stem)[:LONGEST_STEM].decode("utf-8", "ignore"))
    names = (f"{stem}{number}.yaml" for number in chain([""], count_from(2)))
    paths = (given.with_name(name).as_posix() for name in names)
    return next(path for path in paths if not os.path.lexists(studio.workspace.folder / path))


def find_folder(path: str) -> str:
    """Return the folder of a path, empty for the studio's own."""
    parent = PurePosixPath(path).parent.as_posix()
    return "" if parent == "." else parent


@router.get("/files", tags=["files"])
def list_files(studio: InStudio) -> dict[str, Any]:
    """List the files that may be opened."""
    entries, is_whole = studio.workspace.list_files()
    return {"files": [asdict(entry) for entry in entries], "is_whole": is_whole}


@router.get("/files/{path:path}", tags=["files"], response_class=Response)
def download(studio: InStudio, path: FilePath) -> Response:
    """Return a file as it is."""
    headers = {"content-disposition": "attachment"}
    return Response(
        studio.workspace.read(path), media_type="application/octet-stream", headers=headers
    )


@router.put("/files/{path:path}", tags=["files"])
def upload(
    studio: InStudio,
    path: FilePath,
    content: Annotated[bytes, Body(media_type="application/octet-stream")],
    replace: Annotated[bool, Query(description="whether a file of that name is replaced")] = False,
) -> dict[str, Any]:
    """Put a file into the folder, as drag and drop does; the body is its content."""
    if PurePosixPath(path).suffix.lower() not in KINDS:
        raise Refused(
            f"{path[:100]!r} is no file to open (give one that ends in {', '.join(KINDS)})"
        )
    revision = studio.workspace.write(path, content, revision=None if replace else "")
    return {"path": path, "revision": revision}


@router.get("/documents/{path:path}", tags=["documents"])
async def open_document(
    studio: InStudio,
    path: FilePath,
    count: Annotated[
        int | None, Query(ge=1, description="robots to take from a .scen file")
    ] = None,
) -> dict[str, Any]:
    """Open any file that the library reads: a scenario, a layout, a workbook, or a plan.

    A layout becomes the map of a new scenario. A plan becomes a run that is done. ``save_as`` and
    ``revision`` are for saving: other files than scenarios are saved beside their file.
    """
    content = studio.workspace.read(path)
    result, blobs = await studio.ask("open", path=path, count=count)
    answer = {"path": path, "folder": find_folder(path), **result}
    if result["kind"] == "scenario" and PurePosixPath(path).suffix.lower() in SAVED:
        return {**answer, "save_as": path, "revision": compute_revision(content)}
    if result["kind"] != "plan":
        return {**answer, "save_as": free_name(studio, path), "revision": ""}
    name = PurePosixPath(path).name
    request = {"revision": compute_revision(content)}
    for run in studio.runs.list_all():
        if run.kind == "opened" and run.source == path and run.request == request:
            return {**answer, "run": Runs.data(run)}
    run = Run(kind="opened", name=name, source=path, request=request, figures=result["figures"])
    return {**answer, "run": Runs.data(await studio.runs.add_done(run, blobs[0]))}


@router.put("/documents/{path:path}", tags=["documents"])
async def save_document(studio: InStudio, path: FilePath, save: Save) -> dict[str, Any]:
    """Save a document as a .yaml, .yml, .json or .xlsx file; .yaml and .json also with faults."""
    studio.workspace.find_path(path)
    _, blobs = await studio.ask(
        "write", document=save.document, folder=studio.place(save.folder), name=path
    )
    write = studio.workspace.write
    revision = await asyncio.to_thread(write, path, blobs[0], revision=save.revision)
    return {"path": path, "revision": revision}


@router.post("/validate", tags=["documents"])
async def validate(studio: InStudio, placed: Placed) -> dict[str, Any]:
    """List the faults of a document, each with its place, or the notes of the reader."""
    result, _ = await studio.ask(
        "validate", document=placed.document, folder=studio.place(placed.folder)
    )
    return dict(result)


@router.post("/inspect", tags=["documents"])
async def inspect(studio: InStudio, placed: Placed) -> dict[str, Any]:
    """List the weaknesses of the floor of a document, as `rightofway inspect --json` does."""
    result, _ = await studio.ask(
        "inspect", document=placed.document, folder=studio.place(placed.folder)
    )
    return dict(result)


@router.post("/survey", tags=["documents"], response_class=Response)
async def survey(studio: InStudio, request: Request, survey: Survey) -> Response:
    """Return the view of an editor after each change: faults, notes, map, robots, findings."""
    arguments = survey.model_dump() | {"folder": studio.place(survey.folder)}
    _, blobs = await studio.ask("survey", **arguments)
    return answer_zipped(request, blobs[0])


@router.post("/inline", tags=["documents"])
async def inline(studio: InStudio, placed: Placed) -> dict[str, Any]:
    """Return a document whose map and robots are in it, not in other files."""
    folder = studio.place(placed.folder)
    result, _ = await studio.ask("inline", document=placed.document, folder=folder)
    return dict(result)


@router.post("/deal", tags=["documents"])
async def deal(studio: InStudio, deal: Deal) -> dict[str, Any]:
    """Return robots at random places that reach each other; the same seed gives the same."""
    least, most = deal.work
    if not 0 <= least <= most:
        message = f"{least} to {most} is no range of work (give the least first, from 0 on)"
        raise InputError.at("work", message)
    arguments = deal.model_dump() | {"folder": studio.place(deal.folder)}
    result, _ = await studio.ask("deal", **arguments)
    return dict(result)


@router.post("/rows", tags=["documents"])
async def read_jobs(studio: InStudio, rows: Rows) -> dict[str, Any]:
    """Return the jobs of rows that were copied from a spreadsheet; headings are keys of a job."""
    result, _ = await studio.ask("paste", text=rows.text)
    return dict(result)


@router.post("/convert", tags=["documents"], response_class=Response)
async def convert(studio: InStudio, text: ToText) -> Response:
    """Return a document as the content of a file; the ending of the name decides the format."""
    folder = studio.place(text.folder)
    _, blobs = await studio.ask("write", document=text.document, folder=folder, name=text.name)
    kind = MEDIA.get(PurePosixPath(text.name).suffix.lower(), "application/yaml")
    return Response(blobs[0], media_type=kind, headers={"content-disposition": "attachment"})


@router.get("/drafts", tags=["drafts"])
def list_drafts(studio: InStudio) -> dict[str, Any]:
    """List the drafts, the latest first."""
    return {"drafts": studio.store.list_drafts(), "are_kept": studio.store.is_kept}


@router.get("/drafts/{name:path}", tags=["drafts"])
def get_draft(studio: InStudio, name: str) -> dict[str, Any]:
    """Return a draft."""
    draft = studio.store.read_draft(name)
    if draft is None:
        raise Refused(f"there is no draft {name!r} (see the list of drafts)", 404)
    return draft


@router.put("/drafts/{name:path}", tags=["drafts"])
def put_draft(studio: InStudio, name: str, draft: DraftBody) -> dict[str, Any]:
    """Keep a drawing; when the answer comes, it is on the disk."""
    if not (0 < len(name) <= 500 and name.isprintable()):  # noqa: PLR2004
        remedy = "give from 1 to 500 characters that can be printed"
        raise Refused(f"{name[:50]!r} is no name of a draft ({remedy})")
    known = studio.store.list_drafts()
    if len(known) >= MAX_DRAFTS and all(draft["name"] != name for draft in known):
        raise Busy(f"{len(known)} drafts are kept already (delete some)")
    check_json(draft.document)
    saved, revision = studio.store.put_draft(name, draft.document, revision=draft.revision)
    return {"name": name, "saved": saved, "revision": revision}


@router.delete("/drafts/{name:path}", tags=["drafts"])
def delete_draft(
    studio: InStudio,
    name: str,
    revision: Annotated[str | None, Query(description="revision that the draft must have")] = None,
) -> dict[str, Any]:
    """Delete a draft."""
    if not studio.store.delete_draft(name, revision=revision):
        raise Refused(f"there is no draft {name!r} (see the list of drafts)", 404)
    return {"name": name}
