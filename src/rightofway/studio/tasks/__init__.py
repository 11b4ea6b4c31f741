"""Tasks of workers, by name: a task takes ``emit``, blobs and arguments, and returns a result.

The result is plain data, with blobs after it where there are some. Faults are raised as everywhere
in the library; `rightofway.studio.messages` turns them into data.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rightofway.studio.tasks import (
    asking,
    dealing,
    documents,
    driving,
    editing,
    glancing,
    planning,
    studies,
    views,
)

Task = Callable[..., tuple[Any, ...]]

TASKS: dict[str, Task] = {
    "open": documents.open_file,
    "validate": documents.validate_document,
    "inspect": documents.inspect_document,
    "glance": glancing.glance_at,
    "example": glancing.read_example,
    "survey": editing.survey_document,
    "inline": editing.inline_document,
    "paste": editing.read_pasted_jobs,
    "write": documents.write_document,
    "deal": dealing.deal_robots,
    "plan": planning.plan,
    "improve": planning.improve,
    "laps": studies.make_laps,
    "laps_if": studies.make_laps_if,
    "simulate": studies.simulate,
    "replay": studies.replay_run,
    "drive": driving.drive_plan,
    "choices": planning.list_choices,
    "payload": views.make_plan_payload,
    "page": views.make_plan_page,
    "export": views.export_plan,
    "summary": views.summarize_plan,
    "compare": views.compare_plans,
    "changes": views.list_changes,
    "losses": asking.explain_losses,
    "groups": asking.show_groups,
    "flip": asking.flip,
}
"""Every task by name."""
