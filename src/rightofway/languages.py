"""Sentences of pages in other languages than English: a file for each language.

English is written where a sentence is made (`phrases`). ``texts/de.json`` has, in ``library``, a
German template for each English one that a page, the studio or the live view shows. Another
language is another file there.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache

__all__ = ["read_tables"]


@cache
def read_tables() -> Mapping[str, Mapping[str, str]]:
    """Return, for each language by its code, its own template of each English one."""
    from importlib.resources import files

    folder = files("rightofway").joinpath("texts")
    names = sorted(file.name for file in folder.iterdir() if file.name.endswith(".json"))
    names.remove("en.json")  # the templates of facts
    return {
        name.removesuffix(".json"): json.loads(folder.joinpath(name).read_text("utf-8"))["library"]
        for name in names
    }
