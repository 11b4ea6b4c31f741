"""Fleets that are driven: their pages, their events, orders of people."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Path, Request, Response
from fastapi.responses import HTMLResponse, StreamingResponse

from rightofway.studio.errors import Refused
from rightofway.studio.routes.models import InStudio, NewDrive, RunNumber
from rightofway.studio.titles import describe_shown
from rightofway.studio.watching import Watched

router = APIRouter(include_in_schema=False)
"""The pages of drives."""

api = APIRouter(tags=["drives"])
"""Requests for the drives of a studio."""

DriveNumber = Annotated[int, Path(ge=1, le=2**53, description="number of a drive")]


@api.get("/drives")
async def list_drives(studio: InStudio) -> dict[str, Any]:
    """List the plans that simulated robots drive or have driven, the latest first."""
    return {"drives": [drive.describe() for drive in studio.drives.list_all()]}


@api.post("/runs/{number}/drives", status_code=201)
async def start_drive(studio: InStudio, number: RunNumber, new: NewDrive) -> dict[str, Any]:
    """Drive simulated robots along the plan of a run by right of way, like `drive --demo`.

    ``page`` is where to watch them, to hold them and to give other orders.
    """
    plan = await studio.runs.read_blob(number, "plan")
    (shown,) = describe_shown([studio.runs.get(number)])
    drive = await studio.drives.start(number, plan, shown["title"], new.model_dump())
    return drive.describe()


@api.get("/drives/{number}")
async def get_drive(studio: InStudio, number: DriveNumber) -> dict[str, Any]:
    """Return whether robots still drive, and why not if they failed."""
    return studio.drives.get(number).describe()


@api.post("/drives/{number}/stop")
async def stop_drive(studio: InStudio, number: DriveNumber) -> dict[str, Any]:
    """End a drive immediately; its page plays the past."""
    return (await studio.drives.stop(number)).describe()


def _find_watched(request: Request, number: int) -> Watched:
    state = request.app.state
    is_alone = hasattr(state, "drives")  # the page of one fleet, without a studio
    drives: dict[int, Watched] = state.drives if is_alone else state.studio.drives.pages
    if number not in drives:
        raise Refused(f"no fleet {number} is driven here (open the page of one that is)", 404)
    return drives[number]


def make_jobs_router(prefix: str) -> APIRouter:
    """Return the addresses on the jobs of a fleet, below a prefix with its ``number``, or none."""
    jobs = APIRouter(prefix=prefix, tags=["jobs"])

    def find(request: Request) -> Watched:
        return _find_watched(request, int(request.path_params.get("number", 0)))

    @jobs.get("/jobs")
    def list_jobs(request: Request) -> dict[str, Any]:
        """List the jobs that are known and not finished, each with its state and its robot."""
        return {"jobs": find(request).ask_on_jobs({"kind": "list"})["jobs"]}

    @jobs.post("/jobs", status_code=201)
    def add_job(
        request: Request, response: Response, job: Annotated[dict[str, Any], Body()]
    ) -> dict[str, Any]:
        """Add a job; one whose name is known already is not added again (status 200)."""
        answer = find(request).ask_on_jobs({**job, "kind": "add"})
        if answer["fact"]["kind"] == "job known already":
            response.status_code = 200
        return {"name": answer["name"]}

    @jobs.patch("/jobs/{name:path}")
    def change_job(
        request: Request, name: str, job: Annotated[dict[str, Any], Body()]
    ) -> dict[str, Any]:
        """Change the given keys of a job that is not begun; null removes one."""
        answer = find(request).ask_on_jobs({**job, "kind": "change", "name": name})
        return {"name": answer["name"]}

    @jobs.delete("/jobs/{name:path}")
    def withdraw_job(request: Request, name: str) -> dict[str, Any]:
        """Withdraw a job that is not begun; withdrawn already, it stays so."""
        return {"name": find(request).ask_on_jobs({"kind": "withdraw", "name": name})["name"]}

    return jobs


@router.get("/drives/{number}/")
async def get_page(request: Request, number: int) -> HTMLResponse:
    """Return the page of a fleet."""
    page = await _find_watched(request, number).make_page_aside()
    policy = page.partition('http-equiv="Content-Security-Policy" content="')[2].partition('"')[0]
    return HTMLResponse(page, headers={"content-security-policy": policy})


@router.get("/drives/{number}/stream")
async def get_stream(request: Request, number: int) -> StreamingResponse:
    """Send events as server-sent events, from the last one on that the page has."""
    known = request.headers.get("last-event-id", request.query_params.get("known", ""))
    frames = _find_watched(request, number).stream_frames(known)
    return StreamingResponse(frames, media_type="text/event-stream")


@router.post("/drives/{number}/orders")
def give_order(
    request: Request, number: int, order: Annotated[dict[str, Any], Body()]
) -> dict[str, Any]:
    """Ask the control of a fleet for something."""
    return dict(_find_watched(request, number).give_order(order))
