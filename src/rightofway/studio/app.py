"""The server: version 1 of the API, the page, and one form for all errors."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any, get_args

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException

from rightofway import __version__
from rightofway.errors import InputError
from rightofway.io.faults import validate
from rightofway.studio.errors import StudioError
from rightofway.studio.guard import Access, Guard, make_error_body
from rightofway.studio.messages import as_error
from rightofway.studio.routes import (
    documents,
    drives,
    glances,
    pages,
    planners,
    plans,
    questions,
    runs,
)
from rightofway.studio.routes.models import get_kind
from rightofway.studio.session import Studio
from rightofway.studio.watching import Watched

API = "/api/v1"

WATCH = "/drives/0/"
"""Where the page of a fleet is that is watched without a studio."""

DESCRIPTION = """Plans for fleets of mobile robots: documents, runs, plans, questions.

Errors have one form: `{"error": {"status", "kind", "message", "faults"}}`. Each fault has the
`place` in the document, a `message` with what is wrong and what to do, and `named`, the place with
the names of its list items. Times in plans are ticks unless a key says otherwise.
"""


def create_app(studio: Studio, access: Access, *, has_page: bool = True) -> FastAPI:
    """Return the server of a studio."""

    @asynccontextmanager
    async def life(_app: FastAPI) -> AsyncIterator[None]:
        await studio.start()
        try:
            yield
        finally:
            await studio.close()

    app = FastAPI(
        title="rightofway studio",
        version=__version__,
        description=DESCRIPTION,
        openapi_url=f"{API}/openapi.json",
        docs_url=None,  # their pages load scripts from elsewhere
        redoc_url=None,
        redirect_slashes=False,
        lifespan=life,
    )
    app.state.studio = studio
    app.include_router(pages.about, prefix=API)
    for routes in (documents, glances, planners, runs, plans, questions):
        app.include_router(routes.router, prefix=API)
    app.include_router(drives.api, prefix=API)
    app.include_router(drives.router)
    app.include_router(drives.make_jobs_router("/drives/{number}"), prefix=API)
    if has_page:
        app.include_router(pages.router)
    return _add_guard(app, access)


def create_watch(watched: Watched, access: Access) -> FastAPI:
    """Return the server of the page of one fleet that is driven, at `WATCH` and at the top."""
    app = FastAPI(title="rightofway drive", openapi_url=None, docs_url=None, redoc_url=None)
    app.state.drives = {0: watched}
    app.include_router(drives.router)
    app.include_router(drives.make_jobs_router(""))

    @app.get("/")
    async def get_page(request: Request) -> Response:
        return await drives.get_page(request, 0)

    return _add_guard(app, access)


def _add_guard(app: FastAPI, access: Access) -> FastAPI:
    """Return an application with the guard and the one form of errors."""
    app.add_exception_handler(StudioError, _return_refused)
    app.add_exception_handler(InputError, _return_faulty)
    app.add_exception_handler(RequestValidationError, _return_unfitting)
    app.add_exception_handler(HTTPException, _return_http)
    app.add_middleware(Guard, access=access)
    return app


def _make_answer(status: int, error: dict[str, Any]) -> Response:
    return Response(make_error_body(status, error), status, media_type="application/json")


def _return_refused(_request: Request, error: Exception) -> Response:
    assert isinstance(error, StudioError), "it is registered for these"
    return _make_answer(error.status, error.error)


def _return_faulty(_request: Request, error: Exception) -> Response:
    return _make_answer(422, as_error(error))


def _return_http(_request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException), "it is registered for these"
    return _make_answer(error.status_code, {"message": str(error.detail)})


def _return_unfitting(request: Request, error: Exception) -> Response:
    """Name the faults of a body in the words that those of a file have."""
    assert isinstance(error, RequestValidationError), "it is registered for these"
    faults = error.errors()
    if any(fault["type"] == "json_invalid" for fault in faults):
        where = faults[0]["loc"][-1]
        message = f"the body is no JSON: character {where} does not fit (send JSON)"
        return _make_answer(400, {"kind": "input", "message": message})
    model = _find_model(request, error.body)
    if model is not None and isinstance(error.body, dict):
        try:
            validate(model, error.body)
        except InputError as found:
            return _make_answer(422, as_error(found))
    place = ".".join(str(part) for part in faults[0]["loc"])
    message = f"{place}: {faults[0]['msg']} (see {API}/openapi.json)"
    return _make_answer(422, {"kind": "input", "message": message})


def _find_model(request: Request, body: Any) -> Any:
    """Return the model that a body is to fit, of several the one of its kind; None without one."""
    parameters = request.scope["route"].dependant.body_params
    wanted = parameters[0].field_info.annotation if parameters else None
    if wanted is not None and hasattr(wanted, "model_fields"):
        return wanted
    for kind in map(get_args, get_args(wanted)):  # each is annotated with the kind that it is for
        if kind and kind[1].tag == get_kind(body):
            return kind[0]
    return None
