"""A robot on its way from a document to the model, and where the document speaks of it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from rightofway.model import Robot, Stop

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import TripDocument

__all__ = ["DEFAULT_SPEED", "DEFAULT_WORK", "Draft", "laps_place"]


def _default(model: Any, name: str) -> Any:
    return next(each.default for each in dataclasses.fields(model) if each.name == name)


DEFAULT_SPEED: Fraction = _default(Robot, "speed")
DEFAULT_WORK: Fraction = _default(Stop, "work")


@dataclass(frozen=True, slots=True, kw_only=True)
class Draft:
    """A robot on a map, and where the document speaks of it.

    Attributes
    ----------
    robot
        The robot.
    place
        Its place in the document: ``robots[3]``.
    aliases
        Places in the document of what the model finds at the robot, but stands elsewhere.
    """

    robot: Robot
    place: str
    aliases: Mapping[str, str]


def laps_place(document: TripDocument, place: str) -> str:
    """Return where it stands that a robot makes laps without a way back."""
    if document.laps is not None:
        return f"{place}.laps"
    return "rules.laps" if document.ends is None else f"{place}.return"
