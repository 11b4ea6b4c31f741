"""Who waits for which arrival, from the definition: all pairs of what robots use, in fractions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache, partial
from itertools import combinations, product
from typing import NamedTuple

from rightofway.model import Scenario, Track
from tests.oracles.space import Shape, drive, incompatible, zones_of

__all__ = ["Floor"]


class Use(NamedTuple):
    """A resource of a part: a vertex, an edge, or a zone by its negative number."""

    shape: Shape
    begin: Fraction
    part: int
    left: int  # the arrival that ends it


class Floor:
    """The tracks of a plan, and all that their parts use.

    Attributes
    ----------
    waits
        For each robot and part the arrivals (robot, index) that it waits for.
    """

    def __init__(self, scenario: Scenario, tracks: Sequence[Track]) -> None:
        self._excludes = cache(partial(incompatible, scenario))
        self._uses = [list(uses_of(scenario, k, track)) for k, track in enumerate(tracks)]
        self.waits: dict[tuple[int, int], set[tuple[int, int]]] = {}
        for (robot, own), (other, theirs) in product(enumerate(self._uses), repeat=2):
            for use, earlier in product(own, theirs) if robot != other else ():
                if earlier.begin < use.begin and self._excludes(
                    robot, use.shape, other, earlier.shape
                ):
                    self.waits.setdefault((robot, use.part), set()).add((other, earlier.left))

    def may_go(self, robot: int, part: int, arrived: Sequence[int]) -> bool:
        """Return whether all that is incompatible with a part and used first has been left."""
        return all(arrived[other] >= k for other, k in self.waits.get((robot, part), ()))

    def held_together(
        self, arrived: Sequence[int], released: Sequence[int]
    ) -> list[tuple[int, int]]:
        """Return pairs of robots that hold incompatible resources."""
        held = [
            {use.shape for use in own if use.part <= released[k] and use.left > arrived[k]}
            for k, own in enumerate(self._uses)
        ]
        return [
            (i, j)
            for i, j in combinations(range(len(held)), 2)
            if any(self._excludes(i, one, j, two) for one, two in product(held[i], held[j]))
        ]


def uses_of(scenario: Scenario, robot: int, track: Track) -> Iterator[Use]:
    """Yield what each part uses: its vertex, its edge, and the zones of both."""
    vertices, enter = track.vertices.tolist(), [Fraction(tick) for tick in track.enter.tolist()]
    for k, vertex in enumerate(vertices):
        yield Use((vertex,), enter[k], k, k + 1)
        for zone in zones_of(scenario.roadmap, (vertex,)):
            yield Use((-1 - zone,), enter[k], k, k + 1)
        if k:
            edge = (vertices[k - 1], vertex)
            begin = enter[k] - drive(scenario, robot, *edge)
            yield Use(edge, begin, k, k)
            for zone in zones_of(scenario.roadmap, edge):
                yield Use((-1 - zone,), begin, k, k)
