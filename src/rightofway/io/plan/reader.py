"""Plan documents, read. Wrong routes and times pass: a plan is a claim, and the judge judges it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from rightofway.errors import InputError, Where, find_nearest, locate_faults, name_file, quote
from rightofway.io.faults import Faults, validate
from rightofway.io.formats import PLAN_FORMAT, PLAN_OF_JOBS_FORMAT, check_format
from rightofway.io.plan.work import ReadRobot, read_work_of_plan
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.reader import Loaded, read_scenario
from rightofway.model import (
    Decision,
    ForcedLoss,
    Objective,
    Outcome,
    OutcomeKind,
    Plan,
    PlannerRun,
    Reroute,
    RerouteReason,
    Scenario,
    StartPlan,
    Status,
    SteadyState,
    Tick,
    Track,
)
from rightofway.site import VertexId

if TYPE_CHECKING:
    from rightofway.io.fields import Document
    from rightofway.io.plan.shape import (
        DecisionDocument,
        ForcedLossDocument,
        OutcomeDocument,
        StatusDocument,
        SteadyDocument,
        TrackDocument,
    )

D = TypeVar("D", bound="Document")
T = TypeVar("T")


def parse_plan(document: Any, source: str = "", pictures: Path | None = None) -> Plan:
    """Return the plan of a document.

    Parameters
    ----------
    document
        Plain data, as a plan file would hold.
    source
        The name of the document in messages.
    pictures
        The directory of the picture that its map was drawn over.

    Raises
    ------
    InputError
        As `load_plan` does.
    """
    from rightofway.io.plan.shape import PlanFrame

    with name_file(source):
        document = check_format(document, PLAN_FORMAT, PLAN_OF_JOBS_FORMAT)
        faults = Faults()
        frame = faults.attempt("", validate, PlanFrame, document)
        loaded = faults.read_part(document, "scenario", _read_planned, pictures)
        names = _Names.of(loaded.scenario) if loaded else None
        run = faults.read_part(document, "planner", _run, names)
        tracks = faults.read_part(document, "robots", _read_tracks, names)
        work = (
            faults.attempt("", read_work_of_plan, document, loaded.scenario, tracks or ())
            if loaded
            else {}
        )
        steady = faults.read_part(document, "steady", _read_steady, names) or ()
        tick = loaded and loaded.scenario.problem.clock.tick
        if frame and tick and frame.tick != tick:
            remedy = "plan the scenario again; these times mean something else"
            faults.note("tick", f"{quote(frame.tick)}, but the scenario's is {tick} ({remedy})")
        faults.stop(document)
    assert loaded is not None, "or there was a fault"
    assert tracks is not None, "or there was a fault"
    with name_file(source):
        return Plan(
            scenario=loaded.scenario,
            tracks=tuple(robot.track for robot in tracks),
            run=run or PlannerRun(),
            steady=steady,
            **work or {},
        )


def _read_planned(data: Any, pictures: Path | None) -> Loaded:
    """Return the scenario of a plan, whose lanes are split as they were when it was planned."""
    drawn = data.get("map") if isinstance(data, dict) else None
    if isinstance(drawn, dict) and "roadmap" in drawn:
        data = {**data, "map": {"spacing": "whole", **drawn}}
    return read_scenario(data, None, pictures)


@dataclass(slots=True, kw_only=True)
class _Names:
    """Robots by name, and vertices by the names that were looked up so far."""

    robots: Mapping[str, int]
    on: LoadedMap
    vertices: dict[str, VertexId] = field(default_factory=dict)

    @classmethod
    def of(cls, scenario: Scenario) -> _Names:
        """Return the names of a scenario."""
        grid = scenario.roadmap.grid
        return cls(
            robots={robot.name: index for index, robot in enumerate(scenario.robots)},
            on=LoadedMap(roadmap=scenario.roadmap, lines=grid.as_lines() if grid else ()),
        )

    def find_robot(self, place: Where, name: str) -> int:
        """Return the index of a robot; InputError if there is none."""
        if name not in self.robots:
            near = find_nearest(name, self.robots)
            hint = f"did you mean {near!r}?" if near else "name one of the scenario's robots"
            raise InputError.at(place, f"no robot is named {quote(name)} ({hint})")
        return self.robots[name]

    def find_vertex(self, place: Where, name: str) -> VertexId:
        """Return the vertex of a name; InputError if there is none."""
        if name not in self.vertices:
            with locate_faults(place):
                self.vertices[name] = self.on.find(name)
        return self.vertices[name]


def _read_each(
    data: Any, shape: type[D], read: Callable[[D, _Names], T], names: _Names | None, item: str
) -> list[T]:
    """Return the items of a list; without names, only look for faults of shape."""
    if not isinstance(data, list):
        raise InputError.at("", f"{quote(data)} is not a list (give one {item})")
    faults, parts = Faults(), list[T | None]()
    for index, part in enumerate(data):
        document = faults.attempt(index, validate, shape, part)
        if document is not None and names:
            parts.append(faults.attempt(index, read, document, names))
    faults.stop()
    return [part for part in parts if part is not None]


def _read_tracks(data: Any, names: _Names | None) -> tuple[ReadRobot, ...]:
    """Return the tracks and tours in the scenario's order."""
    from rightofway.io.plan.shape import TrackDocument

    tracks = dict[int, ReadRobot]()

    def read(document: TrackDocument, names: _Names) -> None:
        robot = names.find_robot("name", document.name)
        if robot in tracks:
            message = f"{quote(document.name)} has a track already (take one out)"
            raise InputError.at("name", message)
        vertices = [
            names.vertices[name]
            if name in names.vertices  # most are, and this loop is a large plan's reading time
            else names.find_vertex(("vertices", index), name)
            for index, name in enumerate(document.vertices)
        ]
        track = Track.of(vertices, document.enter)
        tracks[robot] = ReadRobot(name=document.name, track=track, tour=document.tour)

    _read_each(data, TrackDocument, read, names, "track for each robot")
    missing = [name for name, robot in names.robots.items() if robot not in tracks] if names else []
    if missing:
        raise InputError.at("", f"{quote(missing[0])} has no track (give one for each robot)")
    return tuple(tracks[robot] for robot in sorted(tracks))


def _run(data: Any, names: _Names | None) -> PlannerRun | None:
    """Return how the plan came about; without names, only look for faults of shape."""
    from rightofway.io.plan.shape import PlannerDocument

    document = validate(PlannerDocument, data)
    if names is None:
        return None
    faults, decisions, reroutes = Faults(), list[Decision | None](), list[Reroute]()
    for index, decision in enumerate(document.decisions):
        decisions.append(faults.attempt(("decisions", index), _read_decision, decision, names))
    for index, reroute in enumerate(document.reroutes):
        robot = faults.attempt(("reroutes", index), names.find_robot, "robot", reroute.robot)
        place, data = ("reroutes", index, "because"), reroute.because.get_all()
        if because := faults.attempt(place, RerouteReason.read, data):
            reroutes.append(Reroute(robot=robot or 0, because=because))
    losses = [
        faults.attempt(("forced_losses", index), _read_forced_loss, loss, names)
        for index, loss in enumerate(document.forced_losses)
    ]
    status = faults.attempt(("status",), _read_status, document.status)
    faults.stop()
    return PlannerRun(
        name=document.name,
        options={key: _convert_to_floats(value) for key, value in document.options.items()},
        seed=document.seed,
        status=status,
        seconds=None if document.seconds is None else float(document.seconds),
        decisions=tuple(decision for decision in decisions if decision),
        reroutes=tuple(reroutes),
        start=None if document.start is None else StartPlan(**document.start.get_all()),
        outcome=None if document.outcome is None else _read_outcome(document.outcome),
        forced_losses=tuple(loss for loss in losses if loss),
    )


def _read_status(document: StatusDocument | None) -> Status | None:
    return None if document is None else Status.read(document.get_all())


def _read_forced_loss(document: ForcedLossDocument, names: _Names) -> ForcedLoss:
    robots = {names.find_robot("robots", name) for name in document.robots}
    if len(robots) < len(document.robots):
        raise InputError.at("robots", "a robot is named twice (name different robots)")
    objective = Objective(document.objective)
    if len(robots) == 1 and objective is not Objective.MAKESPAN:
        message = f"{quote(*document.robots)} loses no time to itself (name another robot, too)"
        raise InputError.at("robots", message)
    vertex = names.find_vertex("vertex", document.vertex)
    return ForcedLoss(
        robots=tuple(sorted(robots)),
        ticks=Tick(document.ticks),
        vertex=vertex,
        objective=objective,
    )


def _read_outcome(document: OutcomeDocument) -> Outcome:
    bound, factor = document.bound, document.factor
    return Outcome(
        kind=OutcomeKind(document.kind),
        objective=Objective(document.objective),
        bound=None if bound is None else Tick(bound),
        factor=None if factor is None else Fraction(factor),
    )


def _read_decision(document: DecisionDocument, names: _Names) -> Decision:
    vertices = tuple(names.find_vertex("vertices", name) for name in document.vertices)
    waits_at = names.find_vertex("waits_at", document.waits_at)
    robot, other = (names.find_robot("robots", name) for name in document.robots)
    waits = names.find_robot("waits", document.waits)
    if waits not in {robot, other}:
        message = f"{quote(document.waits)} is none of the two robots (name one of them)"
        raise InputError.at("waits", message)
    sums = document.completion_sums
    return Decision(
        tick=Tick(document.tick),
        kind=document.kind,
        vertices=vertices,
        robots=(robot, other),
        waits=waits,
        waits_at=waits_at,
        ticks=Tick(document.ticks),
        level=document.level,
        conflicts_left=_read_pair(document.conflicts_left),
        completion_sums=None if sums is None else _read_pair(sums),
    )


def _read_pair(numbers: Sequence[int | None]) -> tuple[int | None, int | None]:
    first, second = numbers
    return first, second


def _read_steady(data: Any, names: _Names | None) -> tuple[SteadyState, ...]:
    """Return the steady states of groups of robots."""
    from rightofway.io.plan.shape import SteadyDocument

    return tuple(
        _read_each(data, SteadyDocument, _read_steady_state, names, "entry for each group")
    )


def _read_steady_state(document: SteadyDocument, names: _Names) -> SteadyState:
    robots = tuple(
        names.find_robot(("robots", index), name) for index, name in enumerate(document.robots)
    )
    critical = []
    for index, visit in enumerate(document.critical):
        place = ("critical", index, "robot")
        robot = names.find_robot(place, visit.robot)
        if robot not in robots:
            message = f"{quote(visit.robot)} is not of this group (name one of its robots)"
            raise InputError.at(place, message)
        critical.append((robot, visit.visit))
    return SteadyState(
        robots=robots,
        start=Tick(document.start),
        period=Tick(document.period),
        critical=tuple(critical),
    )


def _convert_to_floats(value: Any) -> Any:
    """Return the value of an option with floats, as planners have them, for decimals."""
    if isinstance(value, Decimal):
        return float(value)
    if isinstance(value, dict):
        return {key: _convert_to_floats(item) for key, item in value.items()}
    return [_convert_to_floats(item) for item in value] if isinstance(value, list) else value
