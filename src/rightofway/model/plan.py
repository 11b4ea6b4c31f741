"""The answer: routes and times for all robots, its figures, and why robots wait."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Literal, TypeVar

from rightofway.errors import InputError, find_nearest, quote
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import (
    ANYTHING,
    WHOLE,
    Kind,
    allow_none,
    coerce_fields,
    list_of,
    make_class,
    make_words,
    tuple_of,
)
from rightofway.model.figures import get_figures
from rightofway.model.kept_facts import RerouteReason, Status
from rightofway.model.lost_time import LostTime, Wait
from rightofway.model.outcome import ForcedLoss, Objective, Outcome
from rightofway.model.passing import unfold_tracks
from rightofway.model.planned_tour import PlannedItem, PlannedTour
from rightofway.model.planned_work import (
    assign_plan,
    compute_service_cost,
    refuse_wrong_tours,
    time_tours,
)
from rightofway.model.robot import Robot
from rightofway.model.route import Track
from rightofway.model.scenario import Scenario
from rightofway.model.stays import Stays, find_stays
from rightofway.model.steady_state import SteadyState, refuse_unknown_robots
from rightofway.model.units import Tick
from rightofway.model.work import UnservedReason
from rightofway.site import VertexId

T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """The right of way between two robots that would have met, with its reason.

    Attributes
    ----------
    tick
        When they would have met [ticks].
    kind
        ``vertex`` (both at one vertex), or both in one segment: ``head-on`` (in opposite ways) or
        ``following`` (the same way); ``crossing`` for robots with a size whose ways cross.
    vertices
        The vertex; or the segment, in the order of the robot that goes first: robots with a size
        may be in one segment at different vertices.
    robots
        The two robots (i, j), i < j, by index.
    waits
        Which of the two waits.
    waits_at
        The vertex it waits in.
    ticks
        The delay of its departure by this decision [ticks]. A robot that follows another one may
        have to wait again on the way.
    level
        ``node``: fewer conflicts were left in the whole system. ``robot``: as many were left, but
        both achieve their work sooner. ``settled``: the other choice would have met robots that
        are settled already. ``priority``: the robot of higher priority goes first. ``only``: the
        other choice was impossible.
    conflicts_left
        Conflicts left in the system if i waits, and if j waits; None where that was impossible or
        not counted.
    completion_sums
        Sum of both completion times if ties let i wait, and if ties let j wait [ticks]; None where
        there was no tie, and for a movement group that found no way.
    """

    tick: Tick
    kind: Literal["vertex", "head-on", "following", "crossing"]
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
    """A robot that was rerouted, because waiting could not resolve a deadlock.

    Attributes
    ----------
    robot
        Its index.
    because
        The reason.
    """

    robot: int
    because: RerouteReason


@dataclass(frozen=True, slots=True, kw_only=True)
class Improvement:
    """The gain of a planner by changing its first plan, or the plan it was given.

    Attributes
    ----------
    saved
        The reduction of the flowtime from that of the first plan [ticks].
    tries
        The number of tried changes, or None if they were not counted.
    interrupted
        Whether an interrupt ended the search.
    """

    saved: Tick
    tries: int | None = None
    interrupted: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class StartPlan:
    """The routes and tracks that a plan has kept from the plan of an earlier scenario.

    Attributes
    ----------
    routes
        How many robots have the same route.
    tracks
        How many of these have it at the same times.
    """

    routes: int
    tracks: int


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerRun:
    """The origin of a plan.

    Attributes
    ----------
    name, options, seed
        The planner, the options it was given and the seed; ``unknown`` for a plan from elsewhere.
    status
        The method that found the plan, or None where it is unknown.
    seconds
        The time that it took [s], or None if it was not stored.
    first_plan_seconds
        The time until the first plan [s], or None if it was not stored. Files do not keep it.
    decisions
        Rights of way in the order they were decided, from planners that record them.
    reroutes
        Robots that were rerouted.
    improvement
        The gain of changes of the first plan, or None where there were none. Files do not keep it.
    start
        The routes and tracks that were kept from the plan at the start, or None without such a
        plan.
    forced_losses
        Of an optimal plan: groups of robots that lose time to each other in every plan, those that
        lose most first. A robot may be in several groups, so that losses do not add up.
    alone
        The least completion of each robot without the others [ticks], or None where planning did
        not compute it. Files do not keep it.
    outcome
        The proof of the plan, or None where its maker gives none.
    """

    name: str = "unknown"
    options: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    status: Status | None = None
    seconds: float | None = None
    first_plan_seconds: float | None = None
    decisions: tuple[Decision, ...] = ()
    reroutes: tuple[Reroute, ...] = ()
    improvement: Improvement | None = field(default=None, compare=False)
    start: StartPlan | None = None
    forced_losses: tuple[ForcedLoss, ...] = ()
    alone: tuple[Tick, ...] | None = field(default=None, repr=False, compare=False)
    outcome: Outcome | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotPlan:
    """The part of a plan that concerns one robot: ``plan["R1"]``.

    Attributes
    ----------
    robot
        The robot.
    track
        Its vertices and times, by vertex number.
    vertices
        The names of the vertices that it visits, in order.
    enter
        When each visit begins [ticks].
    completion
        When it has done its work and is at its last vertex [ticks].
    waits
        Its waits with place, duration and the robot waited for, in order.
    """

    robot: Robot
    track: Track
    vertices: tuple[str, ...]
    enter: tuple[Tick, ...]
    completion: Tick
    waits: tuple[Wait, ...]

    def __repr__(self) -> str:
        trip = f"{len(self.vertices)} visits from {self.vertices[0]} to {self.vertices[-1]}"
        return f"RobotPlan({self.robot.name!r}, {trip}, completed at tick {self.completion})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """Routes and times for all robots of a scenario; ``plan["R1"]`` is the part of one robot.

    Attributes
    ----------
    scenario
        The problem it answers.
    tracks
        One for each robot, in the scenario's order.
    run
        The origin of the plan.
    steady
        From when on the plan repeats itself, where that is known; shown, not judged.
    tours
        Of a scenario with jobs: the items of each robot, with their visits. Where the scenario has
        tours, they follow from its tours and the tracks unless they are given.
    unserved
        Of a scenario with jobs: indices of the jobs that no robot does, each with the reason.

    Raises
    ------
    InputError
        If there is not a track for each robot, or ``steady``, tours or unserved jobs are not of
        this plan.

    Notes
    -----
    A plan is a claim; `rightofway.check` finds out whether it keeps the rules. Figures of a plan
    that breaks them are the claims of its tracks.
    """

    scenario: Scenario
    tracks: tuple[Track, ...]
    run: PlannerRun
    steady: tuple[SteadyState, ...] = ()
    tours: tuple[PlannedTour, ...] | None = None
    unserved: tuple[tuple[int, UnservedReason], ...] = ()
    _figures: dict[str, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        kinds: dict[str, Kind[Any]] = {
            "scenario": make_class(Scenario),
            "tracks": list_of(make_class(Track)),
            "run": make_class(PlannerRun),
            "steady": list_of(make_class(SteadyState)),
            "tours": allow_none(list_of(list_of(make_class(PlannedItem)))),
            "unserved": list_of(tuple_of((WHOLE, ANYTHING), "index of the job", "reason")),
        }
        coerce_fields(self, "", **kinds)
        robots, tracks = len(self.scenario.robots), len(self.tracks)
        if robots != tracks:
            raise InputError.at(
                "robots", f"{tracks} tracks for {robots} robots (give one for each)"
            )
        object.__setattr__(self, "tracks", unfold_tracks(self.scenario.roadmap, self.tracks))
        names = [robot.name for robot in self.scenario.robots]
        refuse_unknown_robots(self.steady, names, list(map(len, self.tracks)))
        if self.tours is None and self.scenario.tours is not None:
            object.__setattr__(self, "tours", time_tours(self.scenario, self.tracks))
            return  # its itineraries follow these tours
        refuse_wrong_tours(self.scenario, self.tracks, self.tours, self.unserved)
        if self.tours is not None:
            scenario = assign_plan(self.scenario, self.tracks, self.tours)
            object.__setattr__(self, "scenario", scenario)

    def __repr__(self) -> str:
        count = len(self.tracks)
        robots = "1 robot" if count == 1 else f"{count} robots"
        until = max(int(track.enter[-1]) for track in self.tracks)
        return f"Plan({robots} by {self.run.name}, tick 0 to {until})"

    def _repr_html_(self) -> str:
        """Return the page of the plan in a frame, for notebooks."""
        return get_figures().draw_plan_html(self)

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        """Return the page of the plan as a live part of a notebook that has anywidget."""
        return get_figures().bundle_plan(self)

    @checks_arguments
    def compute_once(self, figure: str, compute: Callable[[], T]) -> T:
        """Return a figure of this plan; it is computed at the first request and kept by name."""
        if figure not in self._figures:
            self._figures[figure] = compute()
        figure_value: T = self._figures[figure]
        return figure_value

    @property
    def stays(self) -> tuple[Stays, ...]:
        """The parts of each robot's visits: waits, work, turns; computed once."""
        return self.compute_once(
            "stays", lambda: find_stays(self.scenario, self.tracks, self.tours)
        )

    @property
    def completions(self) -> tuple[Tick, ...]:
        """When each robot has done its work and is at its last vertex [ticks]."""
        return tuple(stay.completion for stay in self.stays)

    @property
    def flowtime(self) -> Tick:
        """The sum of the completion times [ticks]."""
        return Tick(sum(self.completions))

    @property
    def makespan(self) -> Tick:
        """The latest completion time [ticks]."""
        return max(self.completions)

    @checks_arguments
    def compute_value(self, objective: Objective) -> Tick:
        """Return the value of this plan [ticks]; it is computed once for each objective."""
        if objective is Objective.FLOWTIME:
            return self.flowtime
        work = self.scenario.problem.work
        if objective is Objective.SERVICE and work is not None and self.tours is not None:
            return compute_service_cost(work, self.tours)
        return self.compute_once(
            objective.value, lambda: objective.compute_cost(self.scenario, self.tracks)
        )

    @property
    def lower_bound(self) -> Tick:
        """The sum of the completion times of robots that are alone: no plan is below it [ticks].

        A planner may have proven a larger bound: ``plan.run.outcome.bound``.

        Raises
        ------
        NoPlanExists
            If no way leads from one place of a robot's trip to the next.
        """
        alone = self.run.alone or get_figures().compute_alone_completions(self.scenario)
        return Tick(sum(alone))

    @property
    def waits(self) -> tuple[Wait, ...]:
        """Every wait of every robot, by tick, then by robot."""
        return get_figures().list_waits(self)

    @property
    def lost_time(self) -> tuple[LostTime, ...]:
        """The losses of each robot to others: how much, where and for which robot.

        Raises
        ------
        NoPlanExists
            If no way leads from one place of a robot's trip to the next.
        """
        return get_figures().compute_lost_time(self)

    @checks_arguments
    def __getitem__(self, name: str) -> RobotPlan:
        """Return the part of one robot.

        Raises
        ------
        InputError
            If no robot has that name; with the nearest one.
        """
        names = [robot.name for robot in self.scenario.robots]
        if name not in names:
            near = find_nearest(name, names)
            hint = f"did you mean {near!r}?" if near else f"the first is {names[0]!r}"
            raise InputError.at("robots", f"no robot is named {quote(name)} ({hint})")
        robot = names.index(name)
        track, vertex = self.tracks[robot], self.scenario.roadmap.name
        return RobotPlan(
            robot=self.scenario.robots[robot],
            track=track,
            vertices=tuple(map(vertex, track.vertices.tolist())),
            enter=tuple(track.enter.tolist()),
            completion=self.completions[robot],
            waits=tuple(wait for wait in self.waits if wait.robot == robot),
        )

    def to_dataframe(self, library: str | None = None) -> Any:
        """Return the visits of all robots as a table.

        Parameters
        ----------
        library
            ``pandas``, ``polars`` or ``pyarrow``; by default the first of these that is installed.

        Returns
        -------
        pandas.DataFrame, polars.DataFrame or pyarrow.Table
            A row for each visit, by robot and in order: ``robot``, ``visit`` (its number, from 0),
            ``vertex``, ``purpose``, ``enter``, ``leave`` and ``waits`` [time unit], ``waits_for``
            (a robot) ``to_leave`` (a vertex), and exactly ``enter_tick``, ``leave_tick`` and
            ``wait_ticks`` [ticks]. A last visit has no ``leave``.

        Raises
        ------
        InputError
            If the library is not installed, or another one is named.
        """
        wanted = FRAME_LIBRARIES if library is None else (library,)
        allow_none(make_words(*FRAME_LIBRARIES)).read_at("library", library)
        for name in wanted:
            try:
                module = import_module(name)
            except ImportError:
                continue
            columns = get_figures().make_event_columns(self)
            return getattr(module, "table" if name == "pyarrow" else "DataFrame")(columns)
        which = f"none of {', '.join(wanted)} is" if library is None else f"{library} is not"
        raise InputError.at("library", f"{which} installed (run: pip install {wanted[0]})")


FRAME_LIBRARIES = ("pandas", "polars", "pyarrow")
"""Packages that a table can be made with, the first choice first."""
