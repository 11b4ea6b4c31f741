"""Questions about a plan: why robots wait, what if one went first, what if a value were another."""

from __future__ import annotations

import json
from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Request, Response

from rightofway.studio.errors import Refused
from rightofway.studio.routes.models import (
    Flip,
    InStudio,
    OtherLaps,
    RunNumber,
    answer_zipped,
)
from rightofway.studio.runs import Run, Runs

router = APIRouter()


@router.get("/runs/{number}/losses", tags=["questions"], response_class=Response)
async def get_run_losses(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    robot: Annotated[str | None, Query(max_length=200)] = None,
) -> Response:
    """List the lost time of robots: each wait in a sentence, with its decision."""
    plan = await studio.runs.read_blob(number, "plan")
    _, blobs = await studio.ask("losses", plan, robot=robot)
    return answer_zipped(request, blobs[0])


@router.get("/runs/{number}/decisions/{decision}", tags=["questions"], response_class=Response)
async def get_run_decision(
    studio: InStudio,
    request: Request,
    number: RunNumber,
    decision: Annotated[int, Path(ge=1, description="number of the decision, from 1")],
) -> Response:
    """Show both movement groups of a decision of `paper`, `two-level` or `auto`, with their sums.

    They are the paper's List 1 and List 2.
    """
    plan = await studio.runs.read_blob(number, "plan")
    _, blobs = await studio.ask("groups", plan, decision=decision)
    return answer_zipped(request, blobs[0])


@router.post("/runs/{number}/laps", tags=["questions"])
async def change_laps(studio: InStudio, number: RunNumber, asked: OtherLaps) -> dict[str, Any]:
    """Compute laps with another speed, work time or headway, in a new order."""
    run = studio.runs.get(number)
    if run.kind != "laps":
        raise Refused(f"run {number} has no laps (queue a run of the kind laps)", 404)
    arguments = json.loads(await studio.runs.read_blob(number, "arguments"))
    settings = {**run.request, **arguments, **asked.model_dump(), "value": str(asked.value)}
    result, _ = await studio.ask("laps_if", **settings)
    return dict(result)


@router.post("/runs/{number}/flip", tags=["questions"])
async def flip(studio: InStudio, number: RunNumber, flipped: Flip) -> dict[str, Any]:
    """Let a waiting robot go first, and keep the resulting timetable as a run."""
    plan = await studio.runs.read_blob(number, "plan")
    request = flipped.model_dump(exclude={"name"})
    result, blobs = await studio.ask("flip", plan, **request)
    name = flipped.name or f"{flipped.waits} before {flipped.goes_first}"
    run = Run(kind="flip", name=name, based_on=number, request=request)
    run.figures, run.status = result["figures"], result["status"]
    return {"before": result["before"], "run": Runs.data(await studio.runs.add_done(run, blobs[0]))}
