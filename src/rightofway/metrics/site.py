"""A site as it is inspected, and what an inspection finds: facts with places and remedies."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Literal

from rightofway.arguments import checks_arguments
from rightofway.errors import join_names
from rightofway.model import Robot, Rules
from rightofway.model.place_names import describe_middle
from rightofway.phrases import Phrase, say_count
from rightofway.quantities import Units, format_decimal
from rightofway.site import Roadmap
from rightofway.site.scale import compute_extent

Severity = Literal["error", "warning", "note"]
"""``error``: some work cannot be done; ``warning``: robots will wait; ``note``: good to know."""

Kind = Literal[
    "trip", "trap", "unreachable", "cut off", "too near", "crossing", "through way", "corridor",
    "bottleneck", "scale",
]  # fmt: skip
"""What a finding is about."""

SEVERITY_NAMES: dict[Severity, str] = {
    "error": Phrase("Errors"),
    "warning": Phrase("Warnings"),
    "note": Phrase("Notes"),
}
"""What findings of each severity are called, the worst first."""

HEADINGS: dict[Severity, str] = SEVERITY_NAMES | {
    "error": Phrase(
        "{severity} ({effect})",
        severity=SEVERITY_NAMES["error"],
        effect=Phrase("some work cannot be done"),
    ),
    "warning": Phrase(
        "{severity} ({effect})",
        severity=SEVERITY_NAMES["warning"],
        effect=Phrase("robots will wait"),
    ),
}
"""The same with what they mean for the work."""

SEVERITIES = tuple(HEADINGS)

LISTED_PARTS = 8
"""Sizes of strongly connected parts that a report lists."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One thing on a site that will hurt.

    Attributes
    ----------
    kind
        What it is about.
    severity
        How much it hurts.
    fact
        Where and what, as the beginning of a sentence.
    remedy
        What to do.
    vertices
        Names of the vertices that it concerns.
    robots
        Names of the robots that it concerns.
    """

    kind: Kind
    severity: Severity
    fact: str
    remedy: str
    vertices: tuple[str, ...] = ()
    robots: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.fact} ({self.remedy})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Inspection:
    """How large a site is, and what will hurt on it.

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
        What will hurt, the worst first.
    """

    vertices: int
    edges: int
    one_way: int
    places: int
    parts: tuple[int, ...]
    sampled: tuple[int, int] | None
    findings: tuple[Finding, ...]


@dataclass(frozen=True, kw_only=True)
class Site:
    """What is inspected: a roadmap, its places, and the fleet if there is one.

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
    """

    roadmap: Roadmap
    units: Units = field(default_factory=Units)
    stations: Mapping[str, int] = field(default_factory=dict)
    parking: Mapping[str, int] = field(default_factory=dict)
    robots: Sequence[Robot] = ()
    rules: Rules = field(default_factory=Rules)

    def __post_init__(self) -> None:
        object.__setattr__(self, "roadmap", self.roadmap.fold())

    @cached_property
    def homes(self) -> dict[int, str]:
        """Vertices that robots stand on without work, with what they are."""
        if not self.robots:
            return dict.fromkeys(self.parking.values(), Phrase("parking"))
        return {
            int(robot.home): Phrase("home of {robot}", robot=robot.name) for robot in self.robots
        }

    @cached_property
    def places(self) -> dict[int, str]:
        """Vertices that robots stay at, with what they are."""
        if not self.robots:
            stations = {
                vertex: Phrase("station {name}", name=name)
                if name != self.roadmap.name(vertex)
                else Phrase("station")
                for name, vertex in self.stations.items()
            }
            return stations | self.homes
        stops: dict[int, list[str]] = defaultdict(list)
        for robot in self.robots:
            for stop in robot.stops:
                stops[int(stop.at)].append(robot.name)
        names = {
            at: Phrase("stop of {robots}", robots=join_names(sorted(set(of))))
            for at, of in stops.items()
        }
        return names | self.homes

    @cached_property
    def trips(self) -> Counter[tuple[int, int]]:
        """How many drives of the fleet lead from a place to another."""
        counts = Counter[tuple[int, int]]()
        for robot in self.robots:
            counts.update(pairwise(list_trip(robot, self.rules)))
        return Counter({ends: count for ends, count in counts.items() if ends[0] != ends[1]})

    @property
    def gist(self) -> Hashable:
        """All that findings depend on: two sites with the same gist have the same findings."""
        robots = [
            (robot.name, robot.radius, *list_trip(robot, self.rules)) for robot in self.robots
        ]
        named = (*self.stations.items(), None, *self.parking.items())
        rules = self.rules.walls, self.rules.clearance
        return (self.roadmap, self.units, named, tuple(robots), rules)

    @property
    def radii(self) -> tuple[Fraction, Fraction]:
        """The radii of the two largest robots, the larger first [length unit]."""
        radii = sorted((robot.radius for robot in self.robots), reverse=True) or [Fraction(0)]
        return radii[0], radii[min(1, len(radii) - 1)]

    @property
    def room(self) -> Fraction:
        """The distance that the two largest robots need; 0 for points [length unit]."""
        return sum(self.radii) + self.rules.clearance if self.radii[0] else Fraction(0)

    def name(self, vertex: int) -> str:
        """Return the name of a vertex with what it is: ``D1 (station Press)``.

        A cell where lengths have a unit goes by its middle: ``(2.25, 0.75, home of R1)``.
        """
        place = self.places.get(vertex)
        if self.roadmap.has_cells and self.units.length:
            at = describe_middle(self.roadmap, vertex)
            return Phrase("({middle}, {what})", middle=at, what=place) if place else f"({at})"
        name = self.roadmap.name(vertex)
        return Phrase("{name} ({what})", name=name, what=place) if place else name

    def list_names(self, vertices: Iterable[int]) -> tuple[str, ...]:
        """Return the names of vertices."""
        return tuple(map(self.roadmap.name, vertices))


@checks_arguments
def describe_site(site: Site, inspection: Inspection) -> tuple[str, ...]:
    """Return how large a site is and how it hangs together, in whole sentences.

    Parameters
    ----------
    site
        The site.
    inspection
        What was found on it.
    """
    edges = say_count(inspection.edges, "directed edge", "directed edges")
    if inspection.one_way:
        number = str(inspection.one_way)
        edges = Phrase("{edges}, {number} of them one-way", edges=edges, number=number)
    across, down = compute_extent(site.roadmap)
    size = Phrase(
        "{vertices}, {edges}, {width} x {height}; {places}.",
        vertices=say_count(inspection.vertices, "vertex", "vertices"),
        edges=edges,
        width=format_decimal(across),
        height=site.units.format_length(down),
        places=say_count(inspection.places, "place", "places"),
    )
    sentences = [size]
    if len(inspection.parts) == 1:
        sentences.append(Phrase("All vertices reach each other."))
    else:
        sizes = [str(part) for part in inspection.parts[:LISTED_PARTS]]
        more = len(inspection.parts) - len(sizes)
        cut = [*sizes, Phrase("{number} more", number=str(more))] if more else sizes
        sentences.append(
            Phrase(
                "{number} strongly connected parts, of {sizes} vertices.",
                number=str(len(inspection.parts)),
                sizes=join_names(cut),
            )
        )
    if inspection.sampled:
        some, all_of = map(str, inspection.sampled)
        sentences.append(
            Phrase(
                "Shortest routes are counted from {some} of {all_of} vertices only.",
                some=some,
                all_of=all_of,
            )
        )
    return tuple(sentences)


def list_trip(robot: Robot, rules: Rules) -> list[int]:
    """Return home, stops and, if it returns, home of a robot."""
    stops = [int(stop.at) for stop in robot.stops]
    returns = (robot.ends or rules.ends) == "home"
    return [int(robot.home), *stops, *([int(robot.home)] if returns else [])]
