"""What is closed for whom, the slow way: every closure, every shape, every tick."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import accumulate, chain, product
from math import ceil, floor

from rightofway.model import Closure, Plan, Route, Scenario, Track
from tests.oracles.space import FAR_AWAY, Shape, are_one_place, drive, square_between

LATE = 100_000
"""No closure ends so late, but for those that never do [ticks]."""


def shuts(scenario: Scenario, closure: Closure, robot: int, shape: Shape) -> bool:
    """Tell whether a closure of a vertex or of an edge in one piece closes a shape for a robot."""
    own: Shape = (closure.at,) if closure.edge is None else closure.edge  # type: ignore[assignment]
    places = [_list_place(scenario, vertex) for vertex in own]
    if tuple(sorted(shape)) in {tuple(sorted(ends)) for ends in product(*places)}:
        return True
    if closure.radius is None:
        return False
    if len(own) > 1 and set(chain(*places)) & set(shape):
        return False
    reach = scenario.robots[robot].radius + closure.radius + scenario.rules.clearance
    return square_between(scenario.roadmap, own, shape) < reach**2


def _list_place(scenario: Scenario, vertex: int) -> list[int]:
    """Return the vertices of all directions at the place of a vertex."""
    every = range(scenario.roadmap.n_vertices)
    return [vertex, *(other for other in every if are_one_place(scenario, vertex, other))]


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
    headway, ahead = scenario.problem.booking_rules.headway, scenario.rules.occupancy == "both"
    vertices, enter = track.vertices.tolist(), [Fraction(tick) for tick in track.enter.tolist()]
    ends = [*(tick + headway for tick in enter[1:]), FAR_AWAY]
    yield (vertices[0],), enter[0], ends[0]
    for k in range(1, len(vertices)):
        ticks = drive(scenario, robot, vertices[k - 1], vertices[k])
        yield (vertices[k],), enter[k] - ticks * ahead, ends[k]
        yield (vertices[k - 1], vertices[k]), enter[k] - ticks, ends[k - 1]


def earliest_times(
    scenario: Scenario, routes: Sequence[Route], rights: Iterable[tuple[int, int]], headway: int
) -> list[int] | None:
    """Return the earliest enter of each visit, None where there is none; by repeated raising.

    Visits are numbered robot by robot; each right of way is (first, second).
    """
    first = [0, *accumulate(map(len, routes))]
    robot_of = [robot for robot, route in enumerate(routes) for _ in range(len(route))]
    enter, ahead = [0] * first[-1], scenario.rules.occupancy == "both"
    given, before = list(rights), list[int]()
    while enter != before:
        before = list(enter)
        for visit, robot in enumerate(robot_of):
            index, route = visit - first[robot], routes[robot]
            if index:
                enter[visit] = max(enter[visit], enter[visit - 1] + route.compute_least(index - 1))
            gap = headway + (route.drive[index] if ahead else 0)
            enter[visit] = max(
                [enter[visit], *(enter[a + 1] + gap for a, b in given if b == visit)]
            )
            leave = FAR_AWAY if index == len(route) - 1 else Fraction(enter[visit + 1])
            stay = {"index": index, "leave": leave, "headway": headway}
            while not _is_free(scenario, robot, route, enter=enter[visit], **stay):  # type: ignore[arg-type]
                enter[visit] += 1
                if not index or enter[visit] > LATE:
                    return None
    return enter


def _is_free(
    scenario: Scenario,
    robot: int,
    route: Route,
    *,
    index: int,
    enter: int,
    leave: Fraction,
    headway: int,
) -> bool:
    """Tell whether a visit's vertex and the edge driven in are open while they are booked."""
    at, drive = route.vertices[index], route.drive[index]
    start = Fraction(enter - drive if scenario.rules.occupancy == "both" else enter)
    if is_shut(scenario, robot, (at,), start, max(leave, Fraction(enter)) + headway):
        return False
    edge, begin, end = (route.vertices[index - 1], at), Fraction(enter - drive), enter + headway
    return not index or not is_shut(scenario, robot, edge, begin, Fraction(end))
