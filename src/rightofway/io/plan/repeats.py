"""Where a plan document says that it repeats itself, read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError
from rightofway.io.faults import Faults, checked, under
from rightofway.io.plan.names import Names
from rightofway.io.words import shown
from rightofway.model import SteadyState, Tick

if TYPE_CHECKING:
    from rightofway.io.plan.shape import SteadyDocument

__all__ = ["steady_of"]


def steady_of(data: Any, names: Names | None) -> tuple[SteadyState, ...]:
    """Return where a plan repeats itself; without names, only look for faults of shape.

    Raises
    ------
    InputError
        With every fault, its place, value and remedy.
    """
    from rightofway.io.plan.shape import SteadyDocument

    if not isinstance(data, list):
        raise InputError.at("", f"{shown(data)} is not a list (give one entry for each group)")
    faults, groups = Faults(), []
    for index, written in enumerate(data):
        document = faults.attempt(f"[{index}]", checked, SteadyDocument, written)
        if document and names:
            groups.append(faults.attempt(f"[{index}]", _group, document, names))
    faults.stop()
    return tuple(group for group in groups if group)


def _group(document: SteadyDocument, names: Names) -> SteadyState:
    robots, critical = [], []
    for index, name in enumerate(document.robots):
        with under(f"robots[{index}]"):
            robots.append(names.robot(name))
    for index, visit in enumerate(document.critical):
        with under(f"critical[{index}].robot"):
            robot = names.robot(visit.robot)
            if robot not in robots:
                message = f"{shown(visit.robot)} is not of this group (name one of its robots)"
                raise InputError.at("", message)
            critical.append((robot, visit.visit))
    return SteadyState(
        robots=tuple(robots),
        start=Tick(document.start),
        period=Tick(document.period),
        critical=tuple(critical),
    )
