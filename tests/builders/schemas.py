"""The official schemas of VDA 5050, which are in the tests' data."""

from __future__ import annotations

import json
from pathlib import Path

from jsonschema import Draft202012Validator

__all__ = ["validator"]

SCHEMAS = Path(__file__).parents[1] / "data" / "vda5050"


def validator(version: str, topic: str) -> Draft202012Validator:
    """Return the official schema of a topic."""
    text = (SCHEMAS / version / f"{topic}.schema").read_text(encoding="utf-8-sig")
    return Draft202012Validator(json.loads(text))
