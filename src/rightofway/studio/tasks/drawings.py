"""The drawing below a plan: the picture and the curves of the map that it was made from.

A plan file has its map whole, but no picture or curve of a layout. The studio knows the document
behind a plan, and draws the map as that has it.
"""

from __future__ import annotations

import json
from dataclasses import replace
from functools import lru_cache

from typing_extensions import TypedDict

from rightofway.errors import InputError
from rightofway.model import Plan
from rightofway.site import Roadmap
from rightofway.studio.tasks.documents import load_document


class Origin(TypedDict):
    """The document that a plan was made from, and its folder."""

    document: dict[str, object]
    folder: str


def as_drawn(plan: Plan, origin: Origin | None) -> Plan:
    """Return a plan on the map of the document that it was made from.

    Notes
    -----
    A plan whose map is another one by now stays as it is.
    """
    if origin is None:
        return plan
    roadmap = _read_roadmap(json.dumps(origin["document"]), origin["folder"])
    if roadmap is None or roadmap != plan.scenario.roadmap:
        return plan
    drawn = replace(plan.scenario.roadmap, drawing=roadmap.drawing)
    return replace(plan, scenario=replace(plan.scenario, roadmap=drawn))


@lru_cache(maxsize=4)
def _read_roadmap(document: str, folder: str) -> Roadmap | None:
    try:
        return load_document(json.loads(document), folder).scenario.roadmap
    except InputError:  # a file that it names is gone
        return None
