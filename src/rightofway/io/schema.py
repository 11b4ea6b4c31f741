"""The shape of our documents as JSON Schema, for editors and other programs."""

from __future__ import annotations

from typing import Any, Literal

from rightofway.errors import InputError

__all__ = ["SCHEMAS", "schema"]

SCHEMAS = ("scenario", "plan", "suite")


def schema(kind: Literal["scenario", "plan", "suite"]) -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of a kind of document.

    Notes
    -----
    Every document that is accepted fits its schema. The schema cannot say everything: that a home
    is free, that names are unique and the like is for the readers.

    Raises
    ------
    InputError
        For a kind that there is none of.
    """
    from pydantic import BaseModel

    from rightofway.io.plan.shape import PlanDocument
    from rightofway.io.scenario.shape import ScenarioDocument
    from rightofway.io.suite.shape import SuiteDocument

    models: dict[str, type[BaseModel]] = {
        "scenario": ScenarioDocument,
        "plan": PlanDocument,
        "suite": SuiteDocument,
    }
    if kind not in models:
        message = f"{kind!r} is no kind of document (give one of: {', '.join(SCHEMAS)})"
        raise InputError.at("", message)
    dialect = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {**dialect, **_without_titles(models[kind].model_json_schema())}


def _without_titles(node: Any) -> Any:
    """Leave out the titles: they only repeat the names of keys, and of our classes."""
    if isinstance(node, dict):
        return {key: _without_titles(item) for key, item in node.items() if key != "title"}
    return [_without_titles(item) for item in node] if isinstance(node, list) else node
