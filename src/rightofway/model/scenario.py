"""The problem: a roadmap, robots, rules."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from rightofway.errors import InputError, Problem
from rightofway.model.itinerary import Timing, timing_of
from rightofway.model.roadmap import Roadmap
from rightofway.model.robot import Robot, Turn
from rightofway.model.rules import Rules
from rightofway.model.units import Clock

__all__ = ["Scenario"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fleet, where it drives and by which rules; valid by construction.

    Attributes
    ----------
    roadmap
        The graph that robots drive on.
    robots
        At least one, each with a name and a home of its own.
    rules
        What holds for the whole fleet.
    clock
        The clock to keep, where this is what is left of another scenario; else one is chosen.
    timing
        The same in ticks; derived.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """

    roadmap: Roadmap
    robots: tuple[Robot, ...]
    rules: Rules = field(default_factory=Rules)
    clock: Clock | None = None
    timing: Timing = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        problems = [*_rule_problems(self), *_fleet_problems(self)]
        if problems:
            raise InputError(problems)
        object.__setattr__(
            self, "timing", timing_of(self.roadmap, self.robots, self.rules, self.clock)
        )


def _rule_problems(scenario: Scenario) -> Iterator[Problem]:
    rules = scenario.rules
    if rules.headway < 0:
        yield Problem("rules.headway", f"{rules.headway} is negative (give 0 or more)")
    if rules.laps < 1:
        yield Problem("rules.laps", f"{rules.laps} is less than one lap (give 1 or more)")
    yield from _turn_problems(rules.turn, "rules.turn", scenario.roadmap)


def _turn_problems(turn: Turn | None, place: str, roadmap: Roadmap) -> Iterator[Problem]:
    if turn == "cell":
        if roadmap.grid is None:
            yield Problem(place, "'cell' needs a grid (give a time, like 0 or 1/2)")
    elif turn is not None and turn < 0:
        yield Problem(place, f"{turn} is negative (give 0 or more, or 'cell')")


def _fleet_problems(scenario: Scenario) -> Iterator[Problem]:
    if not scenario.robots:
        yield Problem("robots", "there is none (give at least one)")
    for index, robot in enumerate(scenario.robots):
        yield from (
            problem.within(f"robots[{index}]") for problem in _robot_problems(robot, scenario)
        )
    name = scenario.roadmap.name
    yield from _twice("name", [robot.name for robot in scenario.robots], "give each its own")
    homes = [robot.home for robot in scenario.robots]
    if all(0 <= home < scenario.roadmap.n_vertices for home in homes):
        remedy = "a vertex holds one robot; move one of them"
        yield from _twice("home", [name(home) for home in homes], remedy)


def _twice(key: str, values: list[str], remedy: str) -> Iterator[Problem]:
    first: dict[str, int] = {}
    for index, value in enumerate(values):
        earlier = first.setdefault(value, index)
        if earlier != index:
            message = f"{value} is the {key} of robots[{earlier}] already ({remedy})"
            yield Problem(f"robots[{index}].{key}", message)


def _robot_problems(robot: Robot, scenario: Scenario) -> Iterator[Problem]:
    yield from _number_problems(robot)
    yield from _turn_problems(robot.turn, "turn", scenario.roadmap)
    yield from _place_problems(robot, scenario.roadmap.n_vertices)
    laps = scenario.rules.laps if robot.laps is None else robot.laps
    if (robot.ends or scenario.rules.ends) == "none" and laps > 1:
        message = f"{laps} laps need a way back (set return: home, or laps: 1)"
        yield Problem("laps", message)


def _number_problems(robot: Robot) -> Iterator[Problem]:
    if not robot.name:
        yield Problem("name", "is empty (give the robot a name)")
    if robot.speed <= 0:
        yield Problem(
            "speed", f"{robot.speed} is not positive (give a speed above 0, like 1 or 1/2)"
        )
    if robot.laps is not None and robot.laps < 1:
        yield Problem("laps", f"{robot.laps} is less than one lap (give 1 or more)")
    if not robot.stops:
        yield Problem("stops", "there is none (give at least one place to work at)")
    for index, stop in enumerate(robot.stops):
        if stop.work < 0:
            yield Problem(f"stops[{index}].work", f"{stop.work} is negative (give 0 or more)")


def _place_problems(robot: Robot, n_vertices: int) -> Iterator[Problem]:
    places: Iterable[tuple[str, int]] = [
        ("home", robot.home),
        *((f"stops[{index}].at", stop.at) for index, stop in enumerate(robot.stops)),
    ]
    for place, vertex in places:
        if not 0 <= vertex < n_vertices:
            yield Problem(
                place, f"vertex {vertex} is not on the roadmap (give 0 to {n_vertices - 1})"
            )
