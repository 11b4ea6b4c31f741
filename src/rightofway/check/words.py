"""Names and numbers as they stand in messages."""

from __future__ import annotations

from dataclasses import dataclass

from rightofway.model import Scenario

__all__ = ["Words", "ticks"]


@dataclass(frozen=True, slots=True)
class Words:
    """The names of a scenario."""

    scenario: Scenario

    def robot(self, index: int) -> str:
        """Return a robot's name."""
        return self.scenario.robots[index].name

    def vertex(self, vertex: int) -> str:
        """Return a vertex's name, whether the roadmap has it or not."""
        if 0 <= vertex < self.scenario.roadmap.n_vertices:
            return self.scenario.roadmap.name(vertex)
        return f"vertex {vertex}"


def ticks(number: int) -> str:
    """Return a duration in words."""
    return f"{number} tick" if number == 1 else f"{number} ticks"
