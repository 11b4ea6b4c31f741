"""Glances at files in a list, and the examples of the package."""

from __future__ import annotations

import base64
import json
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Query, Response

from rightofway.report.examples import find_examples_folder, list_example_names, read_first_sentence
from rightofway.studio.errors import Refused, TaskFailed
from rightofway.studio.routes.models import InStudio
from rightofway.studio.session import Studio

router = APIRouter()

Source = Literal["files", "drafts", "examples"]
Named = Annotated[str, Path(description="path of a file, name of a draft or of an example")]


def list_scenario_examples() -> dict[str, str]:
    """Return the examples to begin with, and those of the paper: names, and a sentence on each."""
    names = [name for name in list_example_names() if "/" not in name or name.startswith("paper/")]
    files = {name: find_examples_folder() / f"{name}.yaml" for name in names}
    return {name: read_first_sentence(file) for name, file in files.items() if file.is_file()}


@router.get("/examples", tags=["files"])
def list_examples() -> dict[str, Any]:
    """List the examples of the package."""
    examples = list_scenario_examples()
    return {"examples": [{"name": name, "sentence": text} for name, text in examples.items()]}


@router.get("/examples/{name:path}", tags=["files"])
async def get_example(studio: InStudio, name: Named) -> dict[str, Any]:
    """Return an example as a document that names no other file."""
    result, _ = await studio.ask("example", name=_require_known(name))
    return {"kind": "scenario", **result}


@router.get("/glances/{source}/{name:path}", tags=["files"], response_class=Response)
async def get_glance(
    studio: InStudio,
    source: Source,
    name: Named,
    dark: Annotated[bool, Query(description="whether the picture is for a dark page")] = False,
) -> Response:
    """Return a glance at a file, draft or example: kind, robots, extent, and a picture of its map.

    Of a file that cannot be read, ``trouble`` says why; a list has no such faults. The answer is
    kept until the file changes.
    """
    arguments, revision = _read_question(studio, source, name)

    async def make() -> bytes:
        try:
            async with studio.glancing:
                about, blobs = await studio.ask("glance", dark=dark, **arguments)
        except TaskFailed as failed:
            if failed.error["kind"] != "input":
                raise
            return json.dumps({"trouble": failed.error["message"]}).encode()
        picture = "data:image/png;base64," + base64.b64encode(blobs[0]).decode()
        return json.dumps({**about, "picture": picture}).encode()

    content = await studio.glanced.get((source, name, revision, dark), make)
    return Response(content, media_type="application/json")


def _read_question(studio: Studio, source: Source, name: str) -> tuple[dict[str, Any], object]:
    """Return the arguments of the task, and a mark of the version that is looked at."""
    if source == "files":
        stat = studio.workspace.find_existing(name).stat()
        return {"path": name}, (stat.st_mtime_ns, stat.st_size)
    if source == "drafts":
        draft = studio.store.read_draft(name)
        if draft is None:
            raise Refused(f"there is no draft {name!r} (see the list of drafts)", 404)
        return {"document": draft["document"]}, draft["saved"]
    return {"path": str(find_examples_folder() / f"{_require_known(name)}.yaml")}, None


def _require_known(name: str) -> str:
    known = list_scenario_examples()
    if name not in known:
        raise Refused(f"there is no example {name!r} (there are {', '.join(known)})", 404)
    return name
