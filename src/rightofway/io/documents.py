"""Documents whose format is recognized by the file's name, else by its start; lists of delays."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, name_file
from rightofway.io.content import read_text
from rightofway.io.json_text import parse_json
from rightofway.io.yaml_text import parse_yaml

DELAY_FILES = (".yaml", ".yml", ".json")
"""Suffixes of files of delays."""

_BEGIN = re.compile(r"(\s*#[^\n]*\n)*\s*format\s*:")


def parse_document(text: str, path: Path) -> Any:
    """Return the data of a YAML or JSON file, recognized by its name, else by its start.

    A file that is named otherwise, is no YAML and does not begin with a format is plain text, and
    returned as it is: its reader says which document it wants.
    """
    suffix = path.suffix.lower()
    if suffix == ".map":
        message = "a map has no robots (write a scenario with map: {file: ...}, or give a .scen)"
        raise InputError.at("", message)
    if suffix == ".toml":
        message = "TOML is for the suites of benchmarks (write scenarios and plans as YAML or JSON)"
        raise InputError.at("", message)
    if suffix == ".csv":
        remedy = f"write a scenario with robots: {{table: {path.name}}}"
        raise InputError.at("", f"a table of robots has no map ({remedy})")
    looks_like_json = text.lstrip().startswith(("{", "["))
    is_json = suffix == ".json" or (suffix not in {".yaml", ".yml"} and looks_like_json)
    if is_json:
        return parse_json(text)
    try:
        return parse_yaml(text)
    except InputError:
        if suffix in {".yaml", ".yml", ""} or _BEGIN.match(text):
            raise
        return text


def load_delays(path: Path | str) -> tuple[str, ...]:
    """Return the lines of a YAML or JSON file with a list of delays, or one under ``delays``.

    Parameters
    ----------
    path
        A name that ends in .yaml, .yml or .json.

    Raises
    ------
    InputError
        If there is no such file, or no list of texts in it.
    """
    with name_file(str(path)):
        causes = parse_document(read_text(Path(path)), Path(path))
        if isinstance(causes, dict) and list(causes) == ["delays"]:
            causes = causes["delays"]
        if not (isinstance(causes, list) and all(isinstance(cause, str) for cause in causes)):
            message = "is no list of delays (write lines like - exponential:0.2)"
            raise InputError.at("", message)
        return tuple(causes)
