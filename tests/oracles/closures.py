"""What is closed for whom, the slow way: every closure, every shape, every tick."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor

from rightofway.model import Closure, Plan, Scenario, Track
from tests.oracles.space import FAR_AWAY, Shape, drive, square_between


def shuts(scenario: Scenario, closure: Closure, robot: int, shape: Shape) -> bool:
    """Tell whether a closure of a vertex or of an edge in one piece closes a shape for a robot."""
    own: Shape = (closure.at,) if closure.edge is None else closure.edge  # type: ignore[assignment]
    if sorted(own) == sorted(shape):
        return True
    if closure.radius is None:
        return False
    if len(own) > 1 and set(own) & set(shape):
        return False
    reach = scenario.robots[robot].radius + closure.radius + scenario.rules.clearance
    return square_between(scenario.roadmap, own, shape) < reach**2


def begins(scenario: Scenario, closure: Closure) -> int:
    """Return the tick at which a closure begins."""
    return floor(closure.from_ / scenario.problem.clock.tick)


def ends(scenario: Scenario, closure: Closure) -> int | None:
    """Return the tick at which a closure ends, None for never."""
    return None if closure.until is None else ceil(closure.until / scenario.problem.clock.tick)


def is_shut(scenario: Scenario, robot: int, shape: Shape, start: Fraction, end: Fraction) -> bool:
    """Tell whether a shape is closed for a robot at some instant of a time [ticks]."""
    return any(
        begins(scenario, closure) < end
        and ((until := ends(scenario, closure)) is None or start < until)
        and shuts(scenario, closure, robot, shape)
        for closure in scenario.closures
    )


def breaks_a_closure(plan: Plan) -> bool:
    """Tell whether a robot books something while it is closed."""
    scenario = plan.scenario
    return any(
        is_shut(scenario, robot, shape, start, end)
        for robot, track in enumerate(plan.tracks)
        for shape, start, end in _booked(scenario, robot, track)
    )


def _booked(
    scenario: Scenario, robot: int, track: Track
) -> Iterator[tuple[Shape, Fraction, Fraction]]:
    """Yield vertices, with an approach if robots book ahead, and edges; headway included."""
    headway, ahead = scenario.problem.headway, scenario.rules.occupancy == "both"
    vertices, enter = track.vertices.tolist(), [Fraction(tick) for tick in track.enter.tolist()]
    ends = [*(tick + headway for tick in enter[1:]), FAR_AWAY]
    yield (vertices[0],), enter[0], ends[0]
    for k in range(1, len(vertices)):
        ticks = drive(scenario, robot, vertices[k - 1], vertices[k])
        yield (vertices[k],), enter[k] - ticks * ahead, ends[k]
        yield (vertices[k - 1], vertices[k]), enter[k] - ticks, ends[k - 1]
