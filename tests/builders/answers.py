"""Answers to commands as sentences."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rightofway.facts import Fact


def tell_answer(answer: Mapping[str, Any] | None) -> tuple[bool, str]:
    """Return whether a command was carried out, and the English sentence of its answer."""
    assert answer is not None
    return answer["done"], str(Fact.from_dict(answer["fact"]))
