"""A scenario in ticks: the trip of each robot, how fast it crosses edges, how it books."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, groupby
from math import gcd, lcm
from operator import attrgetter
from typing import Any

from rightofway.deadline import DERIVING, limit_loop
from rightofway.errors import InputError, InputFault, Steps, quote
from rightofway.model.booking_rules import BookingRules
from rightofway.model.closures import Closure, Closures, book_closures
from rightofway.model.itinerary import Arc, Itinerary, Stage
from rightofway.model.resources import Resources, bind_resources, make_points
from rightofway.model.robot import Robot, Rules
from rightofway.model.stop_directions import choose_directions, list_directions
from rightofway.model.turning import (
    Turning,
    compute_stop_turn,
    compute_turnings,
    find_heading_on_map,
)
from rightofway.model.units import Clock, Tick, choose_clock
from rightofway.model.work import Job, Work
from rightofway.site import Roadmap, VertexId

MAX_TICKS = 2**40
"""Longest duration of a scenario [ticks]; routes of any length then stay within 64 bits."""

MAX_DRIVE = 2**31 - 1
"""Longest drive along one edge [ticks]."""

HEAVIEST = 10**6
"""The largest weight of a robot in whole numbers, so that weighted costs fit 64 bits."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Problem:
    """A scenario in ticks, computed once; two problems are equal only if they are the same object.

    Attributes
    ----------
    roadmap
        The graph that robots drive on.
    clock
        The length of a tick.
    booking_rules
        When visits book.
    itineraries
        One for each robot.
    resources
        Which bookings exclude each other.
    closures
        The bookings of nobody, or None where nothing is closed.
    work
        Jobs, batteries and states, or None for a scenario without jobs.
    after
        Stages that end before stages of other robots begin, by jobs that follow each other.
    """

    roadmap: Roadmap
    clock: Clock
    booking_rules: BookingRules
    itineraries: tuple[Itinerary, ...]
    resources: Resources
    closures: Closures | None = None
    work: Work | None = None
    after: tuple[Arc, ...] = ()

    @property
    def has_times(self) -> bool:
        """Whether stages have times, and robots begin with a state: in a scenario with jobs."""
        return self.work is not None

    @property
    def minimizes_service(self) -> bool:
        """Whether ends of stages count more than completions of robots."""
        is_service = self.work is not None and self.work.objective == "service"
        return is_service and any(
            stage.weight for robot in self.itineraries for stage in robot.stages
        )

    @property
    def is_barred(self) -> bool:
        """Whether some robot may not drive along some edge."""
        return any(min(itinerary.edge_ticks, default=1) < 0 for itinerary in self.itineraries)

    @property
    def is_open(self) -> bool:
        """Whether there is no closure, and every robot may drive along every edge."""
        return self.closures is None and not self.is_barred

    @property
    def has_other_directions(self) -> bool:
        """Whether some stop could be in another direction than the chosen one."""
        return bool(self.roadmap.originals) and any(
            len(list_directions(self.roadmap, stage.vertex)) > 1
            for itinerary in self.itineraries
            for stage in itinerary.stages
        )

    @property
    def turns(self) -> bool:
        """Whether a change of heading takes time for some robot."""
        return any(itinerary.turning is not None for itinerary in self.itineraries)

    @property
    def weights(self) -> list[int]:
        """The weight of each robot: how often a tick of it counts."""
        return [itinerary.weight for itinerary in self.itineraries]

    def as_steps(self) -> Problem:
        """Return the problem in steps of a tick: in a step, a robot drives along an edge or stays.

        Nothing else takes time, robots are points, and nothing is closed. Every robot can wait, so
        where points have a plan without closures, they have one in steps, and the other way round;
        robots rotate in steps only where bookings allow it. Its order of visits at each vertex is
        that of a plan for any speeds, work times and headways.
        """
        return replace(
            self,
            booking_rules=BookingRules(rotations=self.booking_rules.may_rotate),
            itineraries=tuple(itinerary.as_steps() for itinerary in self.itineraries),
            resources=make_points(self.roadmap, len(self.itineraries)),
            closures=None,
            after=(),
        )


def bind_problem(
    roadmap: Roadmap,
    robots: Sequence[Robot],
    rules: Rules,
    *,
    clock: Clock | None = None,
    closures: Sequence[Closure] = (),
    durations: Iterable[Fraction] = (),
) -> Problem:
    """Express a valid scenario in ticks, of a clock that is given or else chosen.

    ``durations`` are those of the work of jobs, for the choice of the clock [time unit].
    """
    radii = [robot.radius for robot in robots]
    if clock is None:
        alike = {_make_ticks_key(robot): robot for robot in robots}.values()
        driven = (_drive_times(roadmap, robot) for robot in alike)
        spent = (_stop_times(roadmap, robot, rules) for robot in robots)
        clock = choose_clock(chain([rules.headway], durations, *driven, *spent))
    rates = [turn_rate(robot, rules) for robot in robots]
    surcharges = tuple(
        clock.count_ticks(edge_class.surcharge)
        for edge_class in (roadmap.edge_classes if roadmap.has_surcharges else ())
    )
    edge_ticks: dict[tuple[Any, ...], tuple[Tick, ...]] = {}
    for robot in robots:
        if _make_ticks_key(robot) not in edge_ticks:  # robots of one kind have the same
            edge_ticks[_make_ticks_key(robot)] = _compute_edge_ticks(roadmap, robot, clock)
    problem = Problem(
        roadmap=roadmap,
        clock=clock,
        booking_rules=BookingRules(
            headway=clock.count_ticks(rules.headway),
            books_ahead=rules.occupancy == "both",
            rotations=rules.rotations,
        ),
        itineraries=tuple(
            _make_itinerary(
                roadmap,
                robot,
                rules,
                clock,
                edge_ticks=edge_ticks[_make_ticks_key(robot)],
                surcharges=surcharges,
                turning=turning,
                weight=weight,
            )
            for robot, turning, weight in zip(
                robots, compute_turnings(roadmap, rates, clock), scale_weights(robots), strict=True
            )
        ),
        resources=bind_resources(roadmap, radii, rules.clearance),
        closures=book_closures(closures, roadmap, radii, rules.clearance, clock),
    )
    longest = {id(ticks): max(ticks, default=Tick(0)) for ticks in edge_ticks.values()}
    faults = list(_find_long_times(problem, longest))
    if faults:
        raise InputError(faults)
    return problem


def _find_long_times(problem: Problem, longest: Mapping[int, int]) -> Iterator[InputFault]:
    """Yield the times that do not fit the integers of the native core.

    ``longest`` is the longest drive along an edge, by the identity of the ticks of all edges.
    """
    limits: list[tuple[Steps, str, int, int]] = [
        (("rules", "headway"), "it", problem.booking_rules.headway, MAX_TICKS),
        (("map",), "a surcharge", max(problem.itineraries[0].surcharges, default=0), MAX_TICKS),
    ]
    for index, itinerary in enumerate(problem.itineraries):
        where: Steps = ("robots", index)
        drive = longest[id(itinerary.edge_ticks)]
        if drive > MAX_DRIVE:
            limits.append((where, "a drive along an edge", drive, MAX_DRIVE))
        if sum(stage.work + stage.turn for stage in itinerary.stages) + drive > MAX_TICKS:
            stays = groupby(itinerary.stages, attrgetter("vertex"))
            busy = max(sum(stage.work + stage.turn for stage in stay) for _, stay in stays)
            limits.append((where, "work, turning and a drive", busy + drive, MAX_TICKS))
    for where, cause, ticks, most in limits:
        if ticks > most:
            message = f"{cause} takes {quote(ticks)} ticks of {quote(problem.clock.tick)}"
            remedy = "bring speeds, lengths and times closer together"
            yield InputFault(where, f"{message}, more than {most} ({remedy})")


def compute_turning_time(roadmap: Roadmap, robot: Robot, rules: Rules) -> Fraction:
    """Return how long a robot turns at a stop [time unit]."""
    turn = robot.turn if robot.turn is not None else rules.turn
    if turn is None:
        is_by_cell = roadmap.grid is not None and turn_rate(robot, rules) is None
        turn = "cell" if is_by_cell else Fraction(0)
    if turn == "cell":
        assert roadmap.grid is not None, "the scenario has refused this"
        return roadmap.grid.cell_size / robot.speed
    return turn


def turn_rate(robot: Robot, rules: Rules) -> Fraction | None:
    """Return how fast a robot turns on the spot [degrees per time unit]; None: in no time."""
    return robot.turn_rate if robot.turn_rate is not None else rules.turn_rate


def _make_ticks_key(robot: Robot) -> tuple[Any, ...]:
    """Return what the drives of a robot depend on."""
    return robot.speed, robot.type, robot.radius


def _drive_times(roadmap: Roadmap, robot: Robot) -> Iterator[Fraction]:
    for edge_class in limit_loop(roadmap.edge_classes, DERIVING):
        if not edge_class.is_barred(robot.type, robot.radius):
            yield edge_class.compute_duration(robot.speed, robot.type)


def _stop_times(roadmap: Roadmap, robot: Robot, rules: Rules) -> Iterator[Fraction]:
    yield compute_turning_time(roadmap, robot, rules)
    yield from (stop.work for stop in robot.stops)


def _compute_edge_ticks(roadmap: Roadmap, robot: Robot, clock: Clock) -> tuple[Tick, ...]:
    """Return the ticks for an edge of each class; -1 where it is barred."""
    return tuple(
        Tick(-1)
        if edge_class.is_barred(robot.type, robot.radius)
        else clock.count_ticks(edge_class.compute_duration(robot.speed, robot.type))
        for edge_class in limit_loop(roadmap.edge_classes, DERIVING)
    )


def scale_weights(owners: Sequence[Robot] | Sequence[Job]) -> list[int]:
    """Return the least whole numbers in the ratio of the weights of robots or jobs."""
    weights = [owner.weight for owner in owners]
    common = lcm(*(weight.denominator for weight in weights))
    whole = [int(weight * common) for weight in weights]
    divisor = gcd(*whole)
    return [weight // divisor for weight in whole]


def _make_itinerary(
    roadmap: Roadmap,
    robot: Robot,
    rules: Rules,
    clock: Clock,
    *,
    edge_ticks: tuple[Tick, ...],
    surcharges: tuple[Tick, ...],
    turning: Turning | None,
    weight: int,
) -> Itinerary:
    turn = clock.count_ticks(compute_turning_time(roadmap, robot, rules))
    headings = dict(roadmap.drawing.headings) if turning is not None else {}
    given = robot.turn if robot.turn is not None else rules.turn
    visits = [(stop.at, clock.count_ticks(stop.work)) for stop in robot.stops]
    after: list[VertexId | None] = [stop.at for stop in robot.stops[1:]]
    if (robot.ends or rules.ends) == "home":
        visits.append((robot.home, Tick(0)))
        after += [robot.home, robot.stops[0].at] if robot.stops else [None]  # the next lap follows
    elif robot.stops:
        after.append(None)
    turns = [
        compute_stop_turn(roadmap, turning, at, find_heading_on_map(headings.get(at), roadmap))
        if given is None and number < len(robot.stops)
        else Tick(0)
        for number, (at, _) in enumerate(visits)
    ]
    lap = [
        Stage(vertex=at, work=work, turn=Tick(0 if at == following else turn + more))
        for (at, work), following, more in zip(visits, after, turns, strict=True)
    ]
    itinerary = Itinerary(
        home=robot.home,
        stages=tuple(lap * (robot.laps or rules.laps)),
        edge_ticks=edge_ticks,
        surcharges=surcharges,
        turning=turning,
        weight=weight,
    )
    return choose_directions(roadmap, itinerary, robot.home)
