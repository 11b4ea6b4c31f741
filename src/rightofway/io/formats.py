"""The formats of our documents: names with versions, and their shapes as JSON Schema."""

from __future__ import annotations

from typing import Any, Literal

from rightofway.errors import InputError, find_nearest, quote
from rightofway.kinds.table import make_words

SCENARIO_FORMAT = "rightofway-scenario/1"
PLAN_FORMAT = "rightofway-plan/1"
PLAN_OF_JOBS_FORMAT = "rightofway-plan/2"
SUITE_FORMAT = "rightofway-suite/1"
SHIFT_FORMAT = "rightofway-shift/1"


def check_format(document: Any, known: str, *others: str) -> dict[str, Any]:
    """Return a document of a known format; InputError, and no other fault, for one that is not.

    A document whose key ``format`` is misspelt counts as one of the known format.
    """
    line = f'format = "{known}"' if known == SUITE_FORMAT else f"format: {known}"
    if not isinstance(document, dict):
        kind = known.removeprefix("rightofway-").partition("/")[0]
        fault = "nothing is in it" if document is None else f"{quote(document)} is no {kind}"
        raise InputError.at("", f"{fault} (begin with {line})")
    if "format" not in document:
        if any(find_nearest(str(key).lower(), ["format"]) for key in document):
            return {**document, "format": known}  # the misspelt key is reported with all else
        if known == SCENARIO_FORMAT and not {"map", "robots"} & set(document):
            message = f"this is no scenario and no known layout (a scenario begins with {line})"
            raise InputError.at("", message)
        raise InputError.at("format", f"is missing (put {line} at the top)")
    name = document["format"]
    if name not in (known, *others):  # it may be a list or a mapping
        raise InputError.at("format", f"{quote(name)} is {_describe_unwanted(name, known)}")
    return document


def _describe_unwanted(value: object, known: str) -> str:
    if value in (PLAN_FORMAT, PLAN_OF_JOBS_FORMAT) and known == SCENARIO_FORMAT:
        return "a plan, not a scenario (its scenario is in it; check or show it as it is)"
    if value == SCENARIO_FORMAT and known == PLAN_FORMAT:
        return "a scenario, not a plan (plan it first)"
    return f"not known here (give {known}, or update)"


def make_schema(kind: Literal["scenario", "plan", "shift", "suite"]) -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of a kind of document.

    Parameters
    ----------
    kind
        Which documents.

    Raises
    ------
    InputError
        For any other kind.

    Notes
    -----
    Every document that is accepted fits its schema. A schema cannot express all rules: the readers
    check, for example, that homes are free cells and that names are unique.
    """
    from pydantic import TypeAdapter

    from rightofway.io.fields import Document
    from rightofway.io.plan.shape import PlanDocument
    from rightofway.io.scenario.shape import ScenarioDocument
    from rightofway.io.shift import ShiftDocument
    from rightofway.io.suite import SuiteDocument

    models: dict[str, type[Document]] = {
        "scenario": ScenarioDocument,
        "plan": PlanDocument,
        "shift": ShiftDocument,
        "suite": SuiteDocument,
    }
    model = models[make_words(*sorted(models)).read_at("kind", kind)]
    dialect = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {**dialect, **_remove_titles(TypeAdapter(model).json_schema())}


def _remove_titles(node: Any) -> Any:
    """Leave out the titles, which only repeat the names of keys and classes."""
    if isinstance(node, dict):
        return {key: _remove_titles(item) for key, item in node.items() if key != "title"}
    return [_remove_titles(item) for item in node] if isinstance(node, list) else node
