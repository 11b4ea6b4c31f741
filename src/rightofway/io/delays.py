"""Files with a list of what makes robots late; what a line means, `rightofway.execution` says."""

from __future__ import annotations

from pathlib import Path

from rightofway.errors import InputError
from rightofway.io.faults import blaming
from rightofway.io.text import read_document

__all__ = ["DELAY_FILES", "load_delays"]

DELAY_FILES = (".yaml", ".yml", ".json")
"""How the names of such files end."""


def load_delays(path: Path | str) -> tuple[str, ...]:
    """Return the lines of a YAML or JSON file with a list of delays, or one under ``delays``.

    Raises
    ------
    InputError
        If there is no such file, or no list of texts in it.
    """
    with blaming(str(path)):
        found = read_document(Path(path))
        if isinstance(found, dict) and list(found) == ["delays"]:
            found = found["delays"]
        if not (isinstance(found, list) and all(isinstance(one, str) for one in found)):
            message = "is no list of delays (write lines like - exponential:0.2)"
            raise InputError.at("", message)
        return tuple(found)
