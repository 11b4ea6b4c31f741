"""The scripts of pages: modules as a browser imports them, and in one piece for a single file.

The files under ``assets/`` are ECMAScript modules, one concept each, and under ``assets/texts/`` a
file of texts for each language; every import is a line of its own at the top. A page that needs no
other file has them as classic scripts that share one scope, so names are unique among all modules.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from importlib.resources import files
from posixpath import dirname, join, normpath

IMPORT = re.compile(r'^import [^;]*? from "((?:\.{1,2}/)+[\w/-]+)\.js";\n', re.MULTILINE)
EXPORT = re.compile(r"^export (?!default)", re.MULTILINE)
NOTES = re.compile(r"(?ms)^\s*((/\*\*.*?\*/|//[^\n]*)\s*)*")
"""Comments that fill lines, and indentation: a fifth of a script."""
ASIDES = re.compile(r"(?m)(?<=[;,{}()\]]) // .*$")
"""Comments at the ends of lines."""


@cache
def read_asset(name: str) -> str:
    """Return the text of a file under ``assets/``."""
    return files(__package__).joinpath("assets", name).read_text("utf-8")


@cache
def order_scripts(entry: str, text_of: Callable[[str], str] = read_asset) -> tuple[str, ...]:
    """Return a module and its imports in the order in which a browser runs them: imports first."""
    modules: dict[str, None] = {}
    entered = set[str]()

    def enter(name: str) -> None:
        if name not in entered:
            entered.add(name)
            for imported in IMPORT.findall(text_of(f"{name}.js")):
                enter(normpath(join(dirname(name), imported)))
            modules[name] = None

    enter(entry)
    return tuple(modules)


@cache
def make_classic_script(name: str) -> str:
    """Return a module as a classic script, without notes."""
    text = EXPORT.sub("", IMPORT.sub("", read_asset(f"{name}.js")))
    return f'"use strict";\n{ASIDES.sub("", NOTES.sub("", text))}'
