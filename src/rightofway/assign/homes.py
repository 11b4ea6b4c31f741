"""Homes for robots that have none: the parking and charging places of a map.

Files and builders hand over robots without a home. Before a scenario is made of these robots, homes
are dealt out here: a free place with a way to the work and back is searched for each.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from rightofway.errors import InputError, join_names
from rightofway.facts import Fact
from rightofway.model import Robot, Rules, Tick
from rightofway.site import Roadmap, VertexId, measure_squared_distance

if TYPE_CHECKING:
    from rightofway.search import Distances

__all__ = ["HOMELESS", "deal_homes"]

HOMELESS = VertexId(-1)
"""The home of a robot without an assigned home."""

NAMED = 6
"""The most robots whose dealt homes a note names."""

FAR = 2**31 - 1
"""No way is longer [steps]."""


def deal_homes(
    robots: Sequence[Robot], roadmap: Roadmap, rules: Rules
) -> tuple[list[Robot], tuple[Fact, ...]]:
    """Return the robots, each with a home, and a note on the homes assigned to `HOMELESS` ones.

    In the order of the robots, each gets the free place that has the shortest way to its first
    stop, and a way back from its last one unless it stays there; one without a trip, which is for
    jobs, any free place. Of equals the place of least
    number is taken. Places are not free where a robot works, and where another robot starts: there,
    in the same zone, or too near for the sizes of both.

    Parameters
    ----------
    robots
        The robots, in the order of the file.
    roadmap
        The map, with its parking and charging places.
    rules
        The rules: whether robots return home, and their clearance.

    Raises
    ------
    InputError
        If there are too few places, with their numbers and the remedy.
    """
    places = {*roadmap.drawing.parking, *roadmap.drawing.charging}
    parking = sorted(place for place in places if not roadmap.is_passed(place))
    homeless = [robot for robot in robots if robot.home == HOMELESS]
    if homeless and not parking:
        message = "the map has no parking or charging place (give each robot a home)"
        raise InputError.at("homes", message)
    if not homeless:
        return list(robots), ()
    from rightofway.search import Distances  # here: it loads the native core

    distances, steps = Distances(roadmap), _whole_lengths(roadmap)
    stops = {stop.at for robot in robots for stop in robot.stops}
    free = [place for place in parking if place not in stops]
    placed = [robot for robot in robots if robot.home != HOMELESS]
    written, dealt = {robot.home for robot in placed}, list[Robot]()
    for robot in robots:
        if robot.home != HOMELESS:
            dealt.append(robot)
            continue
        fitting = [
            place
            for place in free
            if all(
                _apart(roadmap, replace(robot, home=place), at, rules.clearance) for at in placed
            )
        ]
        home = next(_rank_places(robot, fitting, distances, steps, rules), None)
        if home is None:
            used = len(written.intersection(parking)), len(stops.intersection(parking))
            message = _no_way(robot) if fitting else _too_few(homeless, robot, len(parking), *used)
            raise InputError.at("homes", message)
        dealt.append(replace(robot, home=home))
        placed.append(dealt[-1])
    return dealt, tuple(_note(homeless, dealt, roadmap, len(parking)))


def _rank_places(
    robot: Robot, places: Sequence[int], distances: Distances, steps: tuple[Tick, ...], rules: Rules
) -> Iterator[VertexId]:
    """Yield the places with a way to the trip of a robot and back, the nearest first.

    A robot without a trip may begin anywhere: it is for jobs.
    """
    if not robot.stops:
        yield from map(VertexId, places)
        return
    out = distances.to(robot.stops[0].at, steps)
    returns = (robot.ends or rules.ends) == "home"
    for place in sorted(places, key=lambda at: out[at]):
        back = not returns or distances.to(VertexId(place), steps)[robot.stops[-1].at] >= 0
        if out[place] >= 0 and back:
            yield VertexId(place)


def _whole_lengths(roadmap: Roadmap) -> tuple[Tick, ...]:
    """Return the length of each class in whole steps, as fine as 31 bits for any way allow."""
    longest = max(roadmap.lengths, default=Fraction(1))
    steps = FAR // (roadmap.n_vertices + 1)
    return tuple(Tick(max(1, int(length * steps / longest))) for length in roadmap.lengths)


def _apart(roadmap: Roadmap, first: Robot, other: Robot, clearance: Fraction) -> bool:
    """Return whether two robots may stay at their homes at one time."""
    places = {first.home, other.home}
    if len(places) == 1 or any(places <= set(zone.vertices) for zone in roadmap.zones):
        return False
    if not first.radius and not other.radius:
        return True
    square = measure_squared_distance(*map(roadmap.get_point, places))
    return square >= (first.radius + other.radius + clearance) ** 2


def _no_way(robot: Robot) -> str:
    return (
        f"no free parking or charging place has a way to the stops of {robot.name} and back"
        " (give that robot a home, or join the parts of the map)"
    )


def _too_few(homeless: Sequence[Robot], robot: Robot, places: int, homes: int, stops: int) -> str:
    """Return how many robots need a home, and how many places there are."""
    used = [
        f"{count} {'is a' if count == 1 else 'are'} {noun}{'s' * (count > 1)}"
        for count, noun in ((homes, "written home"), (stops, "stop"))
        if count
    ]
    why = f", of which {join_names(used)}" if used else ""
    needing = f"{len(homeless)} robots need" if len(homeless) > 1 else "1 robot needs"
    has = "1 parking or charging place" if places == 1 else f"{places} parking and charging places"
    near = " that are far enough from each other" if robot.radius else ""
    return f"{needing} a home, and the map has {has}{near}{why} (give the other robots homes)"


def _note(
    homeless: Sequence[Robot], dealt: Sequence[Robot], roadmap: Roadmap, places: int
) -> Iterator[Fact]:
    names = {robot.name for robot in homeless}
    if len(names) > NAMED:
        yield Fact("many homes dealt out", number=len(names), places=places)
    elif names:
        homes = [
            Fact("dealt home", robot=robot.name, place=roadmap.name(robot.home))
            for robot in dealt
            if robot.name in names
        ]
        yield Fact("homes dealt out", homes=tuple(homes))
