"""The answer: routes and times for all robots, and why they wait."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from rightofway.errors import InputError
from rightofway.model.scenario import Scenario
from rightofway.model.steady_state import SteadyState, refuse_unknown_robots
from rightofway.model.units import Tick, VertexId

T = TypeVar("T")

__all__ = ["Decision", "Plan", "PlannerRun", "Reroute", "Track"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Track:
    """Where one robot is, when: its route with the times.

    Attributes
    ----------
    vertices
        The route; int32, shape (n,), at least one.
    enter
        When each visit begins [ticks]; int64, shape (n,). A visit's leave is the next one's enter;
        the last visit has none.
    """

    vertices: NDArray[np.int32]
    enter: NDArray[np.int64]

    def __post_init__(self) -> None:
        if len(self.vertices) != len(self.enter) or not len(self.vertices):
            counts = f"{len(self.vertices)} vertices and {len(self.enter)} times"
            raise InputError.at("", f"{counts} (give as many of both, at least one)")
        self.vertices.flags.writeable = self.enter.flags.writeable = False

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Track):
            return NotImplemented
        return np.array_equal(self.vertices, other.vertices) and np.array_equal(
            self.enter, other.enter
        )

    def __hash__(self) -> int:
        return hash((self.vertices.tobytes(), self.enter.tobytes()))

    def __len__(self) -> int:
        return len(self.vertices)

    @classmethod
    def of(cls, vertices: Sequence[int], enter: Sequence[int]) -> Track:
        """Make a track from any sequences."""
        return cls(vertices=np.array(vertices, np.int32), enter=np.array(enter, np.int64))


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """Who got the right of way where two robots would have met, and why.

    Attributes
    ----------
    tick
        When they would have met [ticks].
    kind
        ``vertex`` (both at one vertex), or both in one segment: ``head-on`` (in opposite ways) or
        ``following`` (the same way).
    vertices
        The vertex; or the segment, in the order of the robot that goes first.
    robots
        The two robots (i, j), i < j, by index.
    waits
        Which of the two waits.
    waits_at
        The vertex it waits in.
    ticks
        How much later it leaves there by this decision [ticks]. Who follows another robot may have
        to wait again on the way.
    level
        ``node``: fewer conflicts were left in the whole system. ``robot``: as many were left, but
        both achieve their work sooner. ``settled``: the other choice would have met robots that
        are settled already. ``priority``: the robot of higher priority goes first. ``only``: the
        other choice was impossible.
    conflicts_left
        Conflicts left in the system if i waits, and if j waits; None where that was impossible, or
        played no part.
    completion_sums
        Sum of both completion times if ties let i wait, and if ties let j wait [ticks]; None where
        no tie came up, and in the place of a group that found no way.
    """

    tick: Tick
    kind: Literal["vertex", "head-on", "following"]
    vertices: tuple[VertexId, ...]
    robots: tuple[int, int]
    waits: int
    waits_at: VertexId
    ticks: Tick
    level: Literal["node", "robot", "settled", "priority", "only"]
    conflicts_left: tuple[int | None, int | None]
    completion_sums: tuple[int | None, int | None] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Reroute:
    """A robot that was sent another way, because waiting could not open a deadlock.

    Attributes
    ----------
    robot
        Its index.
    because
        What made it necessary, for people.
    """

    robot: int
    because: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerRun:
    """How a plan came about.

    Attributes
    ----------
    name, options, seed
        The planner, the options it was given and the seed.
    status
        What it did, for people: ``waits only``, ``re-routed R3, R7``, ``optimal``, …
    seconds
        How long it took [s], or None where that was not kept.
    first_plan_seconds
        How long it took until there was a plan to improve on [s], or None where that was not kept.
        Files do not keep it.
    decisions
        Rights of way in the order they were decided, by planners that can tell.
    reroutes
        Robots that were sent another way.
    alone
        The least completion of each robot without the others [ticks], or None where planning did
        not compute it. Files do not keep it.
    """

    name: str
    options: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    status: str = ""
    seconds: float | None = None
    first_plan_seconds: float | None = None
    decisions: tuple[Decision, ...] = ()
    reroutes: tuple[Reroute, ...] = ()
    alone: tuple[Tick, ...] | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """Routes and times for all robots of a scenario.

    Attributes
    ----------
    scenario
        The problem it answers.
    tracks
        One for each robot, in the scenario's order.
    run
        How it came about.
    steady
        From when on it repeats itself, where somebody knows; for the eye, nobody judges it.

    Raises
    ------
    InputError
        If there is not a track for each robot, or ``steady`` is not of this plan.

    Notes
    -----
    A plan is what somebody claims; whether it keeps the rules is for `rightofway.check` to say.
    """

    scenario: Scenario
    tracks: tuple[Track, ...]
    run: PlannerRun
    steady: tuple[SteadyState, ...] = ()
    _figures: dict[str, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        robots, tracks = len(self.scenario.robots), len(self.tracks)
        if robots != tracks:
            raise InputError.at(
                "robots", f"{tracks} tracks for {robots} robots (give one for each)"
            )
        names = [robot.name for robot in self.scenario.robots]
        refuse_unknown_robots(self.steady, names, list(map(len, self.tracks)))

    def once(self, figure: str, compute: Callable[[], T]) -> T:
        """Return a figure of this plan; it is computed at the first request and kept by name."""
        if figure not in self._figures:
            self._figures[figure] = compute()
        kept: T = self._figures[figure]
        return kept
