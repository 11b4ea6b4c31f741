"""Planners with their options, and the choices for laps, delays and exports."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from fastapi import APIRouter

from rightofway.kinds.numbers import format_number
from rightofway.planners import DEFAULT_PLANNER, IMPROVER, find_all
from rightofway.report.facts import pack_summary
from rightofway.studio.routes.models import (
    InStudio,
)

router = APIRouter()


@router.get("/planners", tags=["planners"])
def list_planners() -> dict[str, Any]:
    """List the planners and their options, those of other packages too."""
    return {
        "default": DEFAULT_PLANNER,
        "improver": IMPROVER,
        "planners": [
            {
                "name": spec.name,
                "summary": pack_summary(spec.summary, f"planner {spec.name}"),
                "features": sorted(spec.features),
                "options": [
                    {
                        "name": option.name,
                        "default": _convert_to_plain(option.default),
                        "summary": pack_summary(
                            option.summary,
                            f"option {option.name} of {spec.name}",
                            f"option {option.name}",
                        ),
                        "choices": list(option.choices),
                        "least": option.kind.bounds[0] or 0,
                        "most": option.kind.bounds[1],
                        "whole": option.kind.schema.get("type") == "integer",
                    }
                    for option in spec.options
                ],
            }
            for spec in find_all().values()
        ],
    }


def _convert_to_plain(value: str | int | Fraction) -> str | int:
    """Return the value of an option as JSON has it."""
    return format_number(value) if isinstance(value, Fraction) else value


@router.get("/choices", tags=["planners"])
async def list_choices(studio: InStudio) -> dict[str, Any]:
    """List rules of laps, notations of delays, and formats of other programs for exports."""
    result, _ = await studio.ask("choices")
    return dict(result)
