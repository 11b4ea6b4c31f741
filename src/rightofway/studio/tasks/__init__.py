"""What workers can do, by name: a task takes ``emit``, blobs and arguments, and returns a result.

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
    editing,
    glancing,
    planning,
    studies,
    views,
)

Task = Callable[..., tuple[Any, ...]]

TASKS: dict[str, Task] = {
    "open": documents.opened,
    "validate": documents.validated,
    "inspect": documents.inspected,
    "glance": glancing.glanced,
    "example": glancing.example,
    "survey": editing.surveyed,
    "inline": editing.inlined,
    "write": documents.written,
    "deal": dealing.dealt,
    "plan": planning.plan,
    "improve": planning.improve,
    "laps": studies.laps,
    "laps_if": studies.laps_if,
    "simulate": studies.simulate,
    "replay": studies.replayed,
    "choices": planning.choices,
    "payload": views.payload,
    "page": views.page,
    "export": views.exported,
    "summary": views.summary,
    "compare": views.compared,
    "changes": views.changed,
    "losses": asking.losses,
    "flip": asking.flip,
}
"""Every task by name."""
