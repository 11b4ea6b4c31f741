"""TOML, read strictly: exact numbers, faults with their place."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from rightofway.errors import InputError
from rightofway.io.text.exact import decimal

__all__ = ["parse_toml"]

_PLACE = re.compile(r"(?P<what>.*) \((?P<place>at .*)\)", re.DOTALL)


def parse_toml(text: str) -> dict[str, Any]:
    """Return the data of a TOML text: mappings, lists, text, exact numbers.

    Raises
    ------
    InputError
        If it is no TOML.
    """
    try:
        return tomllib.loads(text, parse_float=decimal)
    except RecursionError:
        raise InputError.at("", "it is nested too deeply (make it flatter)") from None
    except ValueError as error:
        raise _no_toml(str(error)) from None


def _no_toml(reason: str) -> InputError:
    found = _PLACE.fullmatch(reason)
    what, place = (found["what"], found["place"].removeprefix("at ")) if found else (reason, "")
    return InputError.at(place, f"this is no TOML: {what[:1].lower()}{what[1:]} (mend it)")
