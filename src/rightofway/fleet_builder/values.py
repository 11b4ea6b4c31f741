"""Values as users of Python write them, and the place of a fault in them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields, replace
from fractions import Fraction
from typing import Any

from rightofway.errors import InputError, Where, quote
from rightofway.model import Rules
from rightofway.model.resources import circumscribe
from rightofway.site import Point
from rightofway.site.places import is_cell
from rightofway.units import Units
from rightofway.values import (
    Number,
    TypeSpeeds,
    read_at,
    read_coordinate,
    read_length,
    read_names,
    read_number,
    read_type_speeds,
)


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


def read_types(place: Where, given: Iterable[str]) -> frozenset[str]:
    """Return types of robots; a text alone is no list of them."""
    try:
        return read_names(given if isinstance(given, str) else list(given))
    except (TypeError, ValueError):
        message = f"{quote(given)} are no types of robots (give a list of texts)"
        raise InputError.at(place, message) from None


def read_type_limits(place: Where, given: Mapping[str, Number]) -> TypeSpeeds:
    """Return speed limits by types of robots, each above 0 [length unit per time unit]."""
    limits = read_at(place, read_type_speeds, given)
    for name, speed in limits:
        if speed <= 0:
            message = f"{quote(name)}: {speed} is not positive (give a speed above 0)"
            raise InputError.at(place, message)
    return limits


def read_surcharge(place: Where, given: Number) -> Fraction:
    """Return a surcharge, which is not negative [time unit]."""
    surcharge = read_at(place, read_number, given)
    if surcharge < 0:
        raise InputError.at(place, f"{quote(given)} is negative (give 0 or more)")
    return surcharge


def read_pair(place: Where, given: Any) -> tuple[Any, Any]:
    """Return both parts of (x, y)."""
    if not isinstance(given, list | tuple) or len(given) != 2:  # noqa: PLR2004 (x and y)
        raise InputError.at(place, f"{quote(given)} is no point (give (x, y))")
    return given[0], given[1]


def read_ends(place: Where, given: Any) -> tuple[Any, Any]:
    """Return both ends of an edge."""
    if not isinstance(given, list | tuple) or len(given) != 2:  # noqa: PLR2004 (tail and head)
        raise InputError.at(place, f"{quote(given)} is no edge (give (tail, head))")
    return given[0], given[1]


def read_point(place: Where, x: Number, y: Number) -> Point:
    """Return a point, exactly [length unit]."""
    return read_at(place, read_coordinate, x), read_at(place, read_coordinate, y)


def read_radius(radius: Number | None, size: tuple[Number, Number] | None) -> Fraction:
    """Return the radius of a robot, or of the circle around its sides [length unit]."""
    if size is None:
        return Fraction(0) if radius is None else radius  # type: ignore[return-value]
    long, wide = (read_length(side, ("size", k)) for k, side in enumerate(size))
    return circumscribe(long, wide)


def place_and_work(stop: Any) -> tuple[Any, Number]:
    """Return the place of a stop and the work there: of (place, work), or of a place alone.

    A pair of whole numbers is (row, column).
    """
    is_pair = isinstance(stop, list | tuple) and len(stop) == 2  # noqa: PLR2004 (place and work)
    return (stop[0], stop[1]) if is_pair and not is_cell(stop) else (stop, 0)
