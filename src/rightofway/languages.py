"""Sentences in other languages than English: a file for each language, named by its code.

English is written where a sentence is made (`phrases`). ``texts/de.json`` has the name of the
language and, in ``library``, its own template for each English one. Another language is another
file there.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from rightofway.phrases import Phrase

__all__ = ["ENGLISH", "find_languages", "read_tables", "translate"]

ENGLISH = "en"
"""The language of all templates."""


@cache
def find_languages() -> Mapping[str, Mapping[str, Any]]:
    """Return the files of languages other than English by their codes."""
    from importlib.resources import files

    folder = files("rightofway").joinpath("texts")
    names = sorted(file.name for file in folder.iterdir() if file.name.endswith(".json"))
    names.remove("en.json")  # the templates of facts
    return {
        name.removesuffix(".json"): json.loads(folder.joinpath(name).read_text("utf-8"))
        for name in names
    }


@cache
def read_tables() -> Mapping[str, Mapping[str, str]]:
    """Return, for each language, its own template of each English one."""
    return {code: language["library"] for code, language in find_languages().items()}


def translate(text: str, language: str = ENGLISH) -> str:
    """Return a text in a language; English where it has no translation.

    Parameters
    ----------
    text
        Text for people.
    language
        The code of a known language.

    Examples
    --------
    >>> translate(Phrase("{number} done", number="2"), "de")
    '2 erledigt'
    """
    if language == ENGLISH or not isinstance(text, Phrase):
        return str(text)
    template = read_tables()[language].get(text.template, text.template)
    return template.format(
        **{name: translate(value, language) for name, value in text.values.items()}
    )
