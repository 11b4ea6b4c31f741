"""Sites that are inspected, and findings: facts with places and remedies."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Literal

from rightofway.facts import Fact
from rightofway.model import Robot, Rules, Scenario
from rightofway.site import Roadmap
from rightofway.units import Units

Severity = Literal["error", "warning", "note"]
"""``error``: some work cannot be done; ``warning``: robots will wait; ``note``: good to know."""

Kind = Literal[
    "trip", "trap", "unreachable", "cut off", "too near", "crossing", "through way", "corridor",
    "bottleneck", "scale", "job",
]  # fmt: skip
"""Kinds of findings."""

SEVERITIES: tuple[Severity, ...] = ("error", "warning", "note")
"""The severities, the worst first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A problem of a site.

    Attributes
    ----------
    kind
        Its kind.
    severity
        The severity of the problem.
    fact
        The finding, and its place.
    remedy
        The remedy.
    vertices
        Names of the vertices that it concerns.
    robots
        Names of the robots that it concerns.
    """

    kind: Kind
    severity: Severity
    fact: Fact
    remedy: Fact
    vertices: tuple[str, ...] = ()
    robots: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.fact} ({self.remedy})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspection:
    """The size and the findings of a site.

    Attributes
    ----------
    vertices, edges, one_way
        Vertices, directed edges, and those of them without an edge back; a lane that was split into
        pieces is one edge.
    places
        Stations, parking places, homes and stops.
    parts
        Sizes of the strongly connected parts, the largest first.
    sampled
        From how many of how many places shortest routes were counted; None for all.
    findings
        Weaknesses, the worst first.
    well_formed
        Whether the fleet of a scenario with jobs is well formed; None without jobs.
    """

    vertices: int
    edges: int
    one_way: int
    places: int
    parts: tuple[int, ...]
    sampled: tuple[int, int] | None
    findings: tuple[Finding, ...]
    well_formed: bool | None = None


@dataclass(frozen=True, kw_only=True)
class Site:
    """The subject of an inspection: a roadmap, its places, and the fleet if there is one.

    Attributes
    ----------
    roadmap
        The roadmap, as it is drawn.
    units
        Units of its lengths.
    stations, parking
        Names of stations, and of parking or charging places, with the vertex of each.
    robots
        The fleet; if there is one, only its homes and stops count as places.
    rules
        The rules of the fleet.
    scenario
        A scenario whose jobs are inspected, with the robots; None without jobs.
    """

    roadmap: Roadmap
    units: Units = field(default_factory=Units)
    stations: Mapping[str, int] = field(default_factory=dict)
    parking: Mapping[str, int] = field(default_factory=dict)
    robots: Sequence[Robot] = ()
    rules: Rules = field(default_factory=Rules)
    scenario: Scenario | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "roadmap", self.roadmap.fold())

    @cached_property
    def homes(self) -> dict[int, Fact]:
        """Vertices where robots are without work, each with its use."""
        if not self.robots:
            return dict.fromkeys(self.parking.values(), Fact("parking"))
        return {
            int(robot.home): Fact("home of", robot=index) for index, robot in enumerate(self.robots)
        }

    @cached_property
    def places(self) -> dict[int, Fact]:
        """Vertices where robots stop or stay, each with its use."""
        if self.scenario is not None and self.scenario.jobs is not None:
            uses = {
                int(stop.at): Fact("place of job", job=job.name)
                for job in reversed(self.scenario.jobs)
                for stop in job.stops
            }
            return uses | self.homes
        if not self.robots:
            stations = {
                vertex: Fact("named station", name=name)
                if name != self.roadmap.name(vertex)
                else Fact("station")
                for name, vertex in self.stations.items()
            }
            return stations | self.homes
        stops: dict[int, set[int]] = defaultdict(set)
        for index, robot in enumerate(self.robots):
            for stop in robot.stops:
                stops[int(stop.at)].add(index)

        def sort_by_name(robots: set[int]) -> tuple[int, ...]:
            return tuple(sorted(robots, key=lambda robot: self.robots[robot].name))

        uses = {at: Fact("stop of", robots=sort_by_name(of)) for at, of in stops.items()}
        return uses | self.homes

    @cached_property
    def trips(self) -> Counter[tuple[int, int]]:
        """Numbers of drives of the fleet from one place to another."""
        counts = Counter[tuple[int, int]]()
        for robot in self.robots:
            counts.update(pairwise(list_trip(robot, self.rules)))
        return Counter({ends: count for ends, count in counts.items() if ends[0] != ends[1]})

    @property
    def has_trips(self) -> bool:
        """Whether robots have trips of their own."""
        return bool(self.robots) and self.scenario is None

    @property
    def gist(self) -> Hashable:
        """All that findings depend on: two sites with the same gist have the same findings."""
        robots = [
            (robot.name, robot.radius, *list_trip(robot, self.rules)) for robot in self.robots
        ]
        named = (*self.stations.items(), None, *self.parking.items())
        rules = self.rules.walls, self.rules.clearance
        work: Hashable = None
        if self.scenario is not None:
            own = self.scenario
            work = own.robots, own.rules, own.jobs, own.batteries, own.charging, own.closures
        return (self.roadmap, self.units, named, tuple(robots), rules, work)

    @property
    def radii(self) -> tuple[Fraction, Fraction]:
        """The radii of the two largest robots, the larger first [length unit]."""
        radii = sorted((robot.radius for robot in self.robots), reverse=True) or [Fraction(0)]
        return radii[0], radii[min(1, len(radii) - 1)]

    @property
    def room(self) -> Fraction:
        """The distance that the two largest robots need; 0 for points [length unit]."""
        return sum(self.radii) + self.rules.clearance if self.radii[0] else Fraction(0)

    def list_names(self, vertices: Iterable[int]) -> tuple[str, ...]:
        """Return the names of vertices."""
        return tuple(map(self.roadmap.name, vertices))


def list_trip(robot: Robot, rules: Rules) -> list[int]:
    """Return home, stops and, if it returns, home of a robot."""
    stops = [int(stop.at) for stop in robot.stops]
    returns = (robot.ends or rules.ends) == "home"
    return [int(robot.home), *stops, *([int(robot.home)] if returns else [])]
