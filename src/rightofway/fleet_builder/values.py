"""Values as users of Python write them, and the place of a fault in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from fractions import Fraction
from typing import Any

from rightofway.errors import InputError, quote
from rightofway.kinds.numbers import Number
from rightofway.kinds.table import POSITIVE, tuple_of
from rightofway.model import Rules
from rightofway.model.resources import circumscribe
from rightofway.site.places import is_cell
from rightofway.units import Units


def read_rules(given: dict[str, Any]) -> Rules:
    """Return the rules of a fleet by their names; ``rules="classic"`` is those of classic MAPF."""
    from rightofway.io.scenario.reader import CLASSIC

    known, own = [field.name for field in fields(Rules)], dict(given)
    base = own.pop("rules", None)
    if base is not None and base != "classic":
        remedy = 'give "classic", or each rule by its name, like headway=1'
        raise InputError.at("rules", f"{quote(base)} is no name of rules ({remedy})")
    for name in own:
        if name == "return":
            remedy = 'give ends="none" or ends="home"'
            raise InputError.at(name, f"is called ends in Python ({remedy})")
        if name not in known:
            raise InputError.at(name, f"is unknown to FleetBuilder (rules are {', '.join(known)})")
    return replace(CLASSIC, **own) if base else Rules(**own)


def read_units(given: Units | Mapping[str, Any] | None) -> Units:
    """Return units; none by default."""
    if given is None or isinstance(given, Units):
        return given or Units()
    if not (isinstance(given, Mapping) and given.keys() <= {"length", "time"}):
        remedy = 'give {"length": "m", "time": "s"}'
        raise InputError.at("units", f"{quote(given)} are no units ({remedy})")
    return Units(**given)


def read_radius(radius: Number | None, size: tuple[Number, Number] | None) -> Fraction:
    """Return the radius of a robot, or of the circle around its sides [length unit]."""
    if size is None:
        return Fraction(0) if radius is None else radius  # type: ignore[return-value]
    long, wide = tuple_of(POSITIVE, "length", "width").read_at("size", size)
    return circumscribe(long, wide)


def split_stop(stop: Any) -> tuple[Any, Number, Any]:
    """Return the place of a stop, the work and the actions there.

    The place may be alone. A pair of whole numbers is (row, column).
    """
    if not isinstance(stop, list | tuple) or len(stop) not in {2, 3} or is_cell(stop):
        return stop, 0, ()
    place, work, *actions = stop
    return place, work, actions[0] if actions else ()
