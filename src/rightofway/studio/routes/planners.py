"""Planners with their options, and what laps, delays and exports can be."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter

from rightofway.planners import DEFAULT, IMPROVER, registered
from rightofway.studio.routes.models import (
    InStudio,
)

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
