"""Texts for people in each language: a file of templates for each, ``texts/en.json`` and others.

A file has the templates of facts, and the labels of the page and of the studio. A template is text
with ``{name}`` or ``{name:form}`` in the places of values. A form that begins with ``n_`` is the
kind of another template, which gets the value as its ``number`` (``{lanes:n_lanes}``); the others
are ways to write a value that `rightofway.report.facts` has. Where the text depends on a value, a
template is a table: ``by`` is the name of that value (``number`` if there is none), and each other
key a value with its text; ``other`` is the text for all other values. Pages fill the same templates
(``templates.js``).
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

__all__ = [
    "LANGUAGES",
    "VALUE",
    "choose_text",
    "find_text",
    "list_names",
    "list_values",
    "read_texts",
]

TEXTS = Path(__file__).with_name("texts")
"""The folder of texts: `importlib.resources` would import zipfile at each start."""

LANGUAGES = ("en", "de")
"""Codes of the languages of pages; the command line speaks the first."""

Template: TypeAlias = str | Mapping[str, str]

VALUE = re.compile(r"\{(\w+)(?::(\w+))?\}")
"""A value of a template: its name, and the form in which it is shown."""


@cache
def read_texts(language: str = "en") -> Mapping[str, Any]:
    """Return the texts of a language: its name, templates of facts by kind, labels of pages."""
    text = (TEXTS / f"{language}.json").read_text("utf-8")
    texts: Mapping[str, Any] = json.loads(text)
    return texts


def choose_text(template: Template, values: Mapping[str, Any]) -> str:
    """Return the text of a template for some values."""
    if isinstance(template, str):
        return template
    value = str(values.get(template.get("by", "number"), ""))
    return template.get(value, template["other"])


@cache
def find_text(kind: str, number: str = "") -> str:
    """Return the English text of a kind of fact, for a number of things."""
    return choose_text(read_texts()["facts"][kind], {"number": number})


def list_names(template: Template) -> list[str]:
    """Return the names of the values of a template in alphabetical order."""
    if isinstance(template, str):
        return sorted({name for name, _ in VALUE.findall(template)})
    texts = [text for key, text in template.items() if key != "by"]
    return sorted({template.get("by", "number"), *(n for text in texts for n in list_names(text))})


@cache
def list_values(kind: str) -> list[str]:
    """Return the names of the values of a kind of fact in alphabetical order."""
    return list_names(read_texts()["facts"][kind])
