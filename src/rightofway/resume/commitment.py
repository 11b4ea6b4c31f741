"""The remaining work of robots: where each is free to take a new route, and what is left to do.

A robot keeps what it has begun, its *commitment*. A plan of the rest starts at the end of it: the
robot is busy there until the commitment is done, and makes the stops that are left behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from rightofway.model import Closure, Robot, RobotState, Scenario, Stage, Stop, Tick
from rightofway.site import Roadmap, VertexId

Stages = tuple[Stage, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Commitment:
    """The kept part of a robot's route, and its remaining work."""

    visit: int  # the last one that it has booked; index in its route
    vertex: VertexId  # of that visit
    busy: Tick  # until that visit is expected to be done, from now
    drives_to: VertexId | None = None  # without having booked it (``occupancy: one``)
    begun: Stages = ()  # served until that visit is done
    left: Stages = ()

    @property
    def free_from(self) -> VertexId:
        """The vertex from which the robot can take a new route."""
        return self.vertex if self.drives_to is None else self.drives_to


def make_robot_of_rest(
    robot: Robot, state: RobotState, stops: Sequence[Stop], home: VertexId | None = None
) -> Robot:
    """Return a robot that starts from a state and makes some stops on one way.

    Its first stop is where it is free, and lasts until it is ready; ``home`` is where it comes from
    if it is still on its way there. Turning is left to the work of the stops, since a turn may have
    begun.
    """
    return replace(
        robot,
        home=state.at if home is None else home,
        stops=(Stop(at=state.at, work=state.ready), *stops),
        turn=Fraction(0),
        ends="none",
        laps=1,
    )


def make_rest(scenario: Scenario, roadmap: Roadmap, commitments: Sequence[Commitment]) -> Scenario:
    """Return the scenario of the rest, with a commitment for each robot."""
    time = scenario.problem.clock.convert_to_time

    def start(robot: Robot, commitment: Commitment) -> Robot:
        stops = [] if commitment.drives_to is None else [Stop(at=commitment.drives_to)]
        for number, stage in enumerate(commitment.left, 1):
            turn = stage.turn if number < len(commitment.left) else 0
            stops.append(Stop(at=stage.vertex, work=time(Tick(stage.work + turn))))
        if not commitment.left:  # the robot may make room and come back
            stops.append(Stop(at=commitment.free_from))
        state = RobotState(at=commitment.vertex, ready=time(commitment.busy))
        return make_robot_of_rest(robot, state, stops)

    robots = tuple(map(start, scenario.robots, commitments))
    return replace(scenario, roadmap=roadmap, robots=robots, clock=scenario.problem.clock)


def list_closures_after(
    scenario: Scenario, roadmap: Roadmap, now: Tick
) -> tuple[Closure, ...] | None:
    """Return the closures that are not over, from an instant on.

    None where broken robots have taken the edges of a closed lane, and the radius of its closure
    reaches farther: its place is no part of the roadmap that is left.
    """
    passed = scenario.problem.clock.convert_to_time(now)
    after = []
    for closure in scenario.closures:
        until = None if closure.until is None else closure.until - passed
        if until is not None and until <= 0:
            continue
        if closure.edge is not None and not roadmap.find_ways_along(closure.edge):
            if closure.radius is not None:
                return None
            continue
        after.append(replace(closure, from_=max(closure.from_ - passed, Fraction(0)), until=until))
    return tuple(after)
