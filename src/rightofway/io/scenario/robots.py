"""The robots of a scenario document: listed one by one, or dealt out over the rows of a `.scen`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from rightofway.io.faults import Faults, checked
from rightofway.io.scenario.draft import DEFAULT_SPEED, Draft, laps_place
from rightofway.io.scenario.ground import Ground
from rightofway.io.scenario.places import as_place, find_place
from rightofway.io.scenario.scen_robots import dealt_fleet
from rightofway.io.words import shown
from rightofway.model import Robot, Stop

if TYPE_CHECKING:
    from rightofway.io.scenario.shape import RobotDocument

__all__ = ["Fleet", "fleet_of"]


class Fleet(Protocol):
    """Robots that are read, but not yet placed on a map."""

    def speeds(self) -> Sequence[Fraction] | None:
        """Return the speeds of all robots; None where not all could be read."""

    def drafts(self, ground: Ground, faults: Faults) -> list[Draft]:
        """Return the robots that can be placed on a map; note why others cannot."""


def fleet_of(data: Any, base: Path | None, faults: Faults) -> Fleet | None:
    """Return the fleet of a document's ``robots``, or None after noting its faults."""
    from rightofway.io.scenario.shape import FleetDocument, RobotDocument

    if isinstance(data, dict):
        document = faults.attempt("robots", checked, FleetDocument, data)
        return document and faults.attempt("robots", dealt_fleet, document, base)
    if not isinstance(data, list) or not data:
        message = f"{shown(data)} is no fleet (give a list of robots, or {{scen: a file}})"
        faults.note("robots", message)
        return None
    each = (
        faults.attempt(f"robots[{index}]", checked, RobotDocument, robot)
        for index, robot in enumerate(data)
    )
    return _Listed(written=data, robots=tuple(each))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Listed:
    """Robots written one by one; None stands for those with faults."""

    written: Sequence[Any]
    robots: Sequence[RobotDocument | None]

    def speeds(self) -> Sequence[Fraction] | None:
        speeds = [robot.speed or DEFAULT_SPEED for robot in self.robots if robot]
        return speeds if len(speeds) == len(self.robots) else None

    def drafts(self, ground: Ground, faults: Faults) -> list[Draft]:
        drafts = []
        for index, robot in enumerate(self.robots):
            place = f"robots[{index}]"
            if robot is None:
                faults.attempt(place, _check_places, self.written[index], ground)
            else:
                drafts.append(faults.attempt(place, _listed, place, robot, ground))
        return [draft for draft in drafts if draft]


def _check_places(written: Any, ground: Ground) -> None:
    """Find the places of a robot that has other faults, so that theirs are told with them."""
    faults = Faults()
    for key, value in _places(written):
        place = as_place(value)
        if place is not None:
            faults.attempt(key, find_place, place, ground)
    faults.stop()


def _places(written: Any) -> Iterator[tuple[str, Any]]:
    robot = written if isinstance(written, dict) else {}
    yield "home", robot.get("home")
    yield "target", robot.get("target")
    stops = robot.get("stops")
    for index, stop in enumerate(stops if isinstance(stops, list) else ()):
        yield f"stops[{index}].at", stop.get("at") if isinstance(stop, dict) else None


def _listed(place: str, document: RobotDocument, ground: Ground) -> Draft:
    faults = Faults()
    home = faults.attempt("home", find_place, document.home, ground)
    stops = tuple(_stops(document, ground, faults))
    faults.stop()
    assert home is not None, "or there was a fault"
    own = document.given("speed", "turn", "ends", "laps")
    robot = Robot(name=document.name, home=home, stops=stops, **own)
    return Draft(robot=robot, place=place, aliases={"laps": laps_place(document, place)})


def _stops(document: RobotDocument, ground: Ground, faults: Faults) -> Iterator[Stop]:
    if document.stops is None:
        written = [("target", document.target, document.given("work"))]
    else:
        written = [
            (f"stops[{index}].at", stop.at, stop.given("work"))
            for index, stop in enumerate(document.stops)
        ]
    for place, target, work in written:
        at = faults.attempt(place, find_place, target, ground)
        if at is not None:
            yield Stop(at=at, **work)
