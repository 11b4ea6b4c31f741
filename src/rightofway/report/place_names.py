"""Names of the vertices of a scenario for people: names, or positions of cells."""

from __future__ import annotations

from collections import Counter
from functools import cached_property

from rightofway.model.scenario import Scenario
from rightofway.report.phrases import Phrase
from rightofway.report.quantities import format_decimal
from rightofway.site import Roadmap

DECIMALS = 3
"""Decimal places of the middle of a cell."""


def describe_middle(roadmap: Roadmap, vertex: int) -> str:
    """Return the middle of a cell in the site's frame: ``7.25, 4.75``."""
    x, y = (format_decimal(part, DECIMALS) for part in roadmap.get_point(vertex))
    return Phrase("point", x=x, y=y)


class PlaceNames:
    """Names of places in reports; JSON and files have those of the roadmap.

    Cells have numbers in files. Where lengths have a unit, people look for metres: a cell goes by
    its station, by the robot that it belongs to, or by its middle.

    Parameters
    ----------
    scenario
        The scenario.
    numbered
        Whether each of these names comes with the number of the cell, as in tables:
        ``N24 (3.5, 3.5)``, ``Press (N24)``, ``the home of R1 (N24)``.
    """

    def __init__(self, scenario: Scenario, *, numbered: bool = False) -> None:
        self.scenario = scenario
        self.numbered = numbered
        self.is_measured = scenario.roadmap.has_cells and bool(scenario.units.length)

    def describe_place(self, vertex: int) -> str:
        """Return where a vertex is, in a list: ``Press``, ``(7.25, 4.75)``, ``N5``."""
        roadmap = self.scenario.roadmap
        if not self.is_measured:
            return roadmap.name(vertex)
        if vertex in self._stations:
            return self._add_number(self._stations[vertex], vertex)
        middle = Phrase("middle", middle=describe_middle(roadmap, vertex))
        if not self.numbered:
            return middle
        return Phrase("two sentences", first=roadmap.name(vertex), second=middle)

    def __call__(self, vertex: int) -> str:
        """Return what a sentence calls a vertex: ``the home of R1``, else where it is."""
        if not self.is_measured or vertex in self._stations:
            return self.describe_place(vertex)
        if vertex in self.of_robots:
            return self._add_number(self.of_robots[vertex], vertex)
        return self.describe_place(vertex)

    def _add_number(self, name: str, vertex: int) -> str:
        if not self.numbered:
            return name
        return Phrase("name with detail", name=name, what=self.scenario.roadmap.name(vertex))

    @cached_property
    def _stations(self) -> dict[int, str]:
        names: dict[int, str] = {}
        for name, at in self.scenario.roadmap.drawing.stations:
            names[at] = f"{names[at]} · {name}" if at in names else name
        return names

    @cached_property
    def of_robots(self) -> dict[int, str]:
        """Names of cells by robots: homes, and stops of a single robot."""
        robots = self.scenario.robots
        stops = [{int(stop.at) for stop in robot.stops} - {int(robot.home)} for robot in robots]
        count = Counter(at for vertices in stops for at in vertices)
        names: dict[int, str] = {
            at: Phrase("the stop of", robot=robot.name)
            for robot, vertices in zip(robots, stops, strict=True)
            for at in vertices
            if len(vertices) == count[at] == 1
        }
        homes = {int(robot.home): Phrase("the home of", robot=robot.name) for robot in robots}
        return {**names, **homes}
