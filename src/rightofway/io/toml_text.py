"""TOML, read strictly to plain data. Only suites of benchmarks need it."""

from __future__ import annotations

import re
from typing import Any

from rightofway.errors import InputError, Location
from rightofway.io.plain_data import read_decimal

_TOML_PLACE = re.compile(r"(?P<what>.*) \(at line (?P<line>\d+), (?P<column>.*)\)", re.DOTALL)


def parse_toml(text: str) -> dict[str, Any]:
    """Return the data of a TOML text."""
    import tomllib  # here: few commands read TOML

    try:
        return tomllib.loads(text, parse_float=read_decimal)
    except RecursionError:
        raise InputError.at("", "it is nested too deeply (make it flatter)") from None
    except ValueError as error:
        match = _TOML_PLACE.fullmatch(str(error))
        fault = match["what"] if match else str(error)
        message = f"this is no TOML: {fault[:1].lower()}{fault[1:]} (mend it)"
        where = Location(line=int(match["line"]), path=(match["column"],)) if match else ""
        raise InputError.at(where, message) from None
