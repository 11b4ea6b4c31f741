"""Classic MAPF: a `.scen` file by itself, as the scenario document that it stands for."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, InputFault
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.movingai import read_scen

__all__ = ["classic_document", "classic_fault"]


def classic_document(path: Path) -> dict[str, Any]:
    """Return the scenario of all rows of a `.scen` file: no work, no turning, no way back.

    Raises
    ------
    InputError
        If the file cannot be read, or its map is neither beside it nor in ``../maps``.
    """
    return {
        "format": SCENARIO_FORMAT,
        "map": {"file": str(_map_beside(path))},
        "robots": {"scen": path.name},
        "rules": {"turn": 0, "return": "none"},
    }


def _map_beside(path: Path) -> Path:
    name = re.split(r"[\\/]", read_scen(path)[0].map_name)[-1]
    for relative in (Path(name), Path("..", "maps", name)):
        if (path.parent / relative).is_file():
            return relative
    message = f"its map {name!r} is neither beside it nor in ../maps (put it there)"
    raise InputError.at("", message, str(path))


def classic_fault(fault: InputFault, path: Path) -> InputFault:
    """Return a problem of that document as one of the `.scen` file."""
    if fault.place != "robots.scen":
        return fault
    return InputFault("", fault.message.removeprefix(f"{path}: "))
