"""The official schemas of VDA 5050, which the package carries."""

from __future__ import annotations

from jsonschema import Draft202012Validator

from rightofway.control.conformance import find_schema

__all__ = ["validator"]


def validator(version: str, topic: str) -> Draft202012Validator:
    """Return the official schema of a topic."""
    schema = find_schema(version, topic)
    assert schema is not None
    return schema
