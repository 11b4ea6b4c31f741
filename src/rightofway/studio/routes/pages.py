"""The page of the studio: its markup, its modules, and the modules of the viewer.

Addresses are paths below the package, so that the imports between the two folders of modules are
paths of files, too: an editor and a type checker follow them as a browser does.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from pathlib import PurePosixPath
from typing import Any
from zlib import crc32

from fastapi import APIRouter, Request, Response

from rightofway import __version__
from rightofway.io import make_schema
from rightofway.languages import LANGUAGES, read_texts
from rightofway.studio.errors import Refused
from rightofway.studio.guard import MAX_BODY
from rightofway.studio.routes.models import MAX_SECONDS, InStudio
from rightofway.viz.page.document import as_compact_json, make_style_sheet
from rightofway.viz.page.scripts import order_scripts

MEDIA = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".json": "application/json",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
"""Media types of assets, by ending."""

FOLDERS = {"studio/assets": "rightofway.studio", "viz/page/assets": "rightofway.viz.page"}
"""Folders of assets as addresses name them, and the packages that they are in."""

STYLE = "viz/page/assets/viewer.css"
"""The address of the viewer's style with the colours of the palette, which is no file."""

router = APIRouter(include_in_schema=False)
about = APIRouter()


@router.get("/")
async def get_index(request: Request) -> Response:
    """Return the page."""
    return _send_file(request, "studio/assets/index.html")


@router.get("/studio/assets/{path:path}")
async def get_asset(request: Request, path: str) -> Response:
    """Return a file of the page."""
    return _send_file(request, f"studio/assets/{path}")


@router.get("/viz/page/assets/{path:path}")
async def get_viewer_asset(request: Request, path: str) -> Response:
    """Return a file of the viewer."""
    return _send_file(request, f"viz/page/assets/{path}")


@router.get("/texts.json")
async def send_texts(request: Request) -> Response:
    """Return the texts of all languages."""
    return _send_file(request, "texts.json")


def _send_file(request: Request, path: str) -> Response:
    """Return a file, or that the browser has it already."""
    content = read_page_file(path)
    headers = {"cache-control": "no-cache", "etag": f'"{crc32(content):08x}-{__version__}"'}
    if request.headers.get("if-none-match") == headers["etag"]:
        return Response(status_code=304, headers=headers)
    return Response(content, media_type=MEDIA[PurePosixPath(path).suffix], headers=headers)


@cache
def read_page_file(path: str) -> bytes:
    """Return a file of the page; `Refused` if there is none."""
    if path == STYLE:
        return make_style_sheet("work").encode()
    if path == "texts.json":
        return as_compact_json({code: read_texts(code) for code in LANGUAGES}).encode()
    text = _read_text(path)
    if path == "studio/assets/index.html":  # else a browser asks for modules one after another
        modules = order_scripts("studio/assets/main", _read_text)
        links = (f'<link rel="modulepreload" href="/{module}.js">' for module in modules)
        text = text.replace("</head>", "\n".join([*links, "</head>"]))
    return text.encode()


def _read_text(path: str) -> str:
    folder = next(name for name in FOLDERS if path.startswith(f"{name}/"))
    parts = path.removeprefix(f"{folder}/").split("/")
    asset_file = files(FOLDERS[folder]).joinpath("assets", *parts)
    is_asset = PurePosixPath(path).suffix in MEDIA and not {"", ".", ".."} & {*parts}
    if not is_asset or not asset_file.is_file():
        raise Refused(f"there is no asset {path[:100]!r} (open the studio at /)", 404)
    return asset_file.read_text("utf-8")


@about.get("", tags=["studio"])
@about.get("/", include_in_schema=False)
def describe(studio: InStudio) -> dict[str, Any]:
    """Describe this studio: its version, its folder, the file to open first, its limits."""
    return {
        "version": __version__,
        "folder": studio.workspace.folder.name,
        "file": studio.file,
        "keeps": studio.store.is_kept,
        "limits": {
            "body": MAX_BODY,
            "seconds": MAX_SECONDS,
            "runs_at_once": studio.planners.size,
        },
    }


@about.get("/schema", tags=["studio"])
def get_scenario_make_schema() -> dict[str, Any]:
    """Return the JSON Schema of scenarios, as `rightofway schema scenario` prints it."""
    return make_schema("scenario")
