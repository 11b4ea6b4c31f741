"""Names of robots and vertices in a plan document, found in its scenario."""

from __future__ import annotations

from dataclasses import dataclass, field

from rightofway.errors import InputError
from rightofway.io.scenario.ground import Ground
from rightofway.io.scenario.places import find_place
from rightofway.io.words import nearest, shown
from rightofway.model import Scenario, VertexId

__all__ = ["Names"]


@dataclass(slots=True, kw_only=True)
class Names:
    """What the names in a plan stand for.

    Attributes
    ----------
    robots
        The index of each robot.
    ground
        The map.
    vertices
        The vertices looked up so far: a long plan asks for each of them many times.
    """

    robots: dict[str, int]
    ground: Ground
    vertices: dict[str, VertexId] = field(default_factory=dict)

    @classmethod
    def of(cls, scenario: Scenario) -> Names:
        """Return the names of a scenario."""
        grid = scenario.roadmap.grid
        return cls(
            robots={robot.name: index for index, robot in enumerate(scenario.robots)},
            ground=Ground(roadmap=scenario.roadmap, lines=grid.lines() if grid else ()),
        )

    def robot(self, name: str) -> int:
        """Return the index of a robot; InputError if there is none."""
        if name not in self.robots:
            near = nearest(name, self.robots)
            hint = f"did you mean {near!r}?" if near else "name one of the scenario's robots"
            raise InputError.at("", f"no robot is named {shown(name)} ({hint})")
        return self.robots[name]

    def vertex(self, name: str) -> VertexId:
        """Return the vertex of a name; InputError if there is none."""
        if name not in self.vertices:
            self.vertices[name] = find_place(name, self.ground)
        return self.vertices[name]
