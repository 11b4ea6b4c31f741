"""From a file to plain data: YAML or JSON, by its name or else by its content."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.io.text.files import read_text
from rightofway.io.text.json_text import parse_json
from rightofway.io.text.yaml_text import parse_yaml

__all__ = ["read_document"]


def read_document(path: Path) -> Any:
    """Return the data of a YAML or JSON file: mappings, lists, text, exact numbers.

    Raises
    ------
    InputError
        If the file cannot be read, or is neither.
    """
    text = read_text(path)
    suffix = path.suffix.lower()
    if suffix == ".map":
        message = "a map has no robots (write a scenario with map: {file: ...}, or give a .scen)"
        raise InputError.at("", message)
    if suffix == ".toml":
        message = "TOML is for the suites of benchmarks (write scenarios and plans as YAML or JSON)"
        raise InputError.at("", message)
    looks_like_json = text.lstrip().startswith(("{", "["))
    is_json = suffix == ".json" or (suffix not in {".yaml", ".yml"} and looks_like_json)
    return parse_json(text) if is_json else parse_yaml(text)
