"""Homes dealt out: robots without a home start from the parking and charging places of a layout."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rightofway.errors import InputError, listed
from rightofway.model import Roadmap, Tick, VertexId, squared_distance
from rightofway.search import Distances

NAMED = 6
"""The most robots whose dealt homes a note names."""

FAR = 2**31 - 1
"""No way is longer [steps]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """A robot that needs a home.

    Attributes
    ----------
    name
        Its name.
    first_stop, last_stop
        Where it goes from home, and where it comes home from; None if it does not.
    radius
        Its radius [length unit].
    """

    name: str
    first_stop: VertexId
    last_stop: VertexId | None
    radius: Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class Fixed:
    """What the rest of the scenario says.

    Attributes
    ----------
    homes
        Homes that are written, and the radius of the robot of each [length unit].
    stops
        Vertices where robots work, which are nobody's home.
    clearance
        Least distance between two robots of which one has a radius [length unit].
    """

    homes: tuple[tuple[VertexId, Fraction], ...]
    stops: frozenset[VertexId]
    clearance: Fraction


def dealt_homes(
    robots: Sequence[Wanted], roadmap: Roadmap, parking: Sequence[VertexId], fixed: Fixed
) -> list[VertexId]:
    """Return a home for each robot: in order, the free place with the shortest way to its stop.

    Parameters
    ----------
    robots
        The robots, in the order of the file.
    roadmap
        The map.
    parking
        Its parking and charging places, in the order of the file, which decides between equals.
    fixed
        Homes and stops that are written: their places are taken. Places too near to another home
        for the sizes of both robots are taken, too, and places that share a zone with one.

    Raises
    ------
    InputError
        If there are too few places, with their numbers and what to do.
    """
    if robots and not parking:
        message = "the map has no parking or charging place (give each robot a home)"
        raise InputError.at("homes", message)
    distances = Distances(roadmap)
    steps = _whole_lengths(roadmap)
    free = [place for place in parking if place not in fixed.stops]
    taken, found = list(fixed.homes), list[VertexId]()
    for robot in robots:
        fitting = [
            place
            for place in free
            if all(_apart(roadmap, (place, robot.radius), at, fixed.clearance) for at in taken)
        ]
        out, back = distances.to(robot.first_stop, steps), robot.last_stop
        reaching = sorted((place for place in fitting if out[place] >= 0), key=lambda at: out[at])
        home = next(
            (place for place in reaching if back is None or distances.to(place, steps)[back] >= 0),
            None,
        )
        if home is None:
            raise InputError.at("homes", _too_few(robots, robot, parking, fixed, bool(fitting)))
        found.append(home)
        taken.append((home, robot.radius))
    return found


def _whole_lengths(roadmap: Roadmap) -> tuple[Tick, ...]:
    """Return the length of each class in whole steps, as fine as 31 bits for any way allow."""
    longest = max(roadmap.lengths, default=Fraction(1))
    steps = FAR // (roadmap.n_vertices + 1)
    return tuple(Tick(max(1, int(length * steps / longest))) for length in roadmap.lengths)


def _apart(
    roadmap: Roadmap, one: tuple[int, Fraction], other: tuple[int, Fraction], clearance: Fraction
) -> bool:
    """Return whether robots may stay at two places at one time; each is a vertex and a radius."""
    places = {one[0], other[0]}
    if len(places) == 1 or any(places <= set(zone.vertices) for zone in roadmap.zones):
        return False
    if not one[1] and not other[1]:
        return True
    square = squared_distance(*map(roadmap.point, places))
    return square >= (one[1] + other[1] + clearance) ** 2


def _too_few(
    robots: Sequence[Wanted],
    robot: Wanted,
    parking: Sequence[VertexId],
    fixed: Fixed,
    are_left: bool,
) -> str:
    if are_left:
        return (
            f"no free parking or charging place has a way to the stops of {robot.name} and back"
            " (give that robot a home, or join the parts of the map)"
        )
    places = "1 parking or charging place" if len(parking) == 1 else (
        f"{len(parking)} parking and charging places"
    )  # fmt: skip
    used = {
        "a written home": len({home for home, _ in fixed.homes} & set(parking)),
        "a stop": len(fixed.stops & set(parking)),
    }
    less = [f"{number} {'is' if number == 1 else 'are'} {what}{'s' * (number > 1)}"
            for what, number in used.items() if number]  # fmt: skip
    why = f", of which {listed(less)}" if less else ""
    needing = f"{len(robots)} robots need a home" if len(robots) > 1 else "1 robot needs a home"
    near = " that are far enough from each other" if robot.radius else ""
    return f"{needing}, and the map has {places}{near}{why} (give the other robots homes)"


def note_of_homes(robots: Sequence[Wanted], homes: Sequence[str], parking: int) -> Iterator[str]:
    """Yield a note on who starts where.

    Parameters
    ----------
    robots, homes
        The robots, and the name of the home of each.
    parking
        Number of parking and charging places.
    """
    if len(robots) > NAMED:
        yield f"homes dealt out: {len(robots)} of {parking} parking and charging places"
    elif robots:
        pairs = (f"{robot.name} at {home}" for robot, home in zip(robots, homes, strict=True))
        yield f"homes dealt out: {listed(list(pairs))}"
