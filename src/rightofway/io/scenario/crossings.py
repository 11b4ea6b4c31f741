"""Lanes of a drawn roadmap that cross where no vertex is.

Robots with a radius book such a crossing, and robots without one if a zone holds both lanes. A
reader warns of the other crossings.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from rightofway.facts import Fact
from rightofway.model import Scenario
from rightofway.model.resources import close_pairs

MAX_EDGES = 10_000
"""Larger roadmaps are not searched."""


def note_crossings(scenario: Scenario) -> Iterator[Fact]:
    """Yield a note on lanes that cross without a vertex or a zone, if no robot has a size."""
    roadmap = scenario.roadmap
    if roadmap.grid is not None or any(robot.radius for robot in scenario.robots):
        return
    if roadmap.n_edges > MAX_EDGES:
        return
    crossings = sorted(close_pairs(roadmap, Fraction(0)).crossings)
    if crossings:
        lane, other = (
            Fact("ends of lane", tail=roadmap.name(tail), head=roadmap.name(head))
            for tail, head in crossings[0]
        )
        pairs = len(crossings) - 1
        fact = Fact("drawn lanes cross", lane=lane, other=other)
        if pairs:
            fact = Fact("more pairs cross", fact=fact, more=pairs)
        yield Fact("crossing unguarded", fact=fact)
