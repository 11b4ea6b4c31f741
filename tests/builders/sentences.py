"""Facts as English sentences."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rightofway.facts import read_fact
from rightofway.report.facts import write_notes


def tell_answer(answer: Mapping[str, Any] | None) -> tuple[bool, str]:
    """Return whether a command was carried out, and the English sentence of its answer."""
    assert answer is not None
    return answer["done"], str(read_fact(answer["fact"]))


def tell_notes(found: Any) -> tuple[str, ...]:
    """Return the notes of a layout, a map, a scenario or an example as sentences."""
    return tuple(write_notes(found.notes))
