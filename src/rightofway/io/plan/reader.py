"""Plan documents, read. Wrong routes and times pass: a plan is a claim, and the judge judges it."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError
from rightofway.io.faults import Faults, blaming, checked, checked_format, under
from rightofway.io.formats import PLAN_FORMAT
from rightofway.io.plan.names import Names
from rightofway.io.plan.repeats import steady_of
from rightofway.io.scenario.reader import Loaded, read, read_scenario
from rightofway.io.text.documents import read_document
from rightofway.io.words import shown
from rightofway.model import (
    Decision,
    Plan,
    PlannerRun,
    Reroute,
    Scenario,
    Tick,
    Track,
    VertexId,
)

if TYPE_CHECKING:
    from rightofway.io.plan.shape import DecisionDocument, RerouteDocument, TrackDocument

__all__ = ["load_plan", "plan_of", "read_either"]


def load_plan(path: Path | str) -> Plan:
    """Return the plan of a file.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy. A plan that breaks rules is
        none: `rightofway.check` judges that.
    """
    path = Path(path)
    with blaming(str(path)):
        return plan_of(read_document(path))


def read_either(path: Path | str) -> Plan | Loaded:
    """Return the plan of a file, or the scenario if it is one; its ``format`` tells.

    Raises
    ------
    InputError
        As `load_plan` and `read` do.
    """
    path = Path(path)
    if path.suffix.lower() == ".scen":
        return read(path)
    with blaming(str(path)):
        document = read_document(path)
        kind = document.get("format") if isinstance(document, dict) else None
        is_plan = isinstance(kind, str) and kind.startswith("rightofway-plan/")
        return plan_of(document) if is_plan else read_scenario(document, path.parent)


def plan_of(document: Any, source: str = "") -> Plan:
    """Return the plan of a document.

    Parameters
    ----------
    document
        Plain data, as a plan file would hold.
    source
        What faults are said to be in.

    Raises
    ------
    InputError
        As `load_plan` does.
    """
    with blaming(source):
        return _read(checked_format(document, PLAN_FORMAT))


def _read(document: dict[str, Any]) -> Plan:
    from rightofway.io.plan.shape import PlanFrame

    faults = Faults()
    frame = faults.attempt("", checked, PlanFrame, document)
    loaded = faults.part(document, "scenario", read_scenario, None)
    names = Names.of(loaded.scenario) if loaded else None
    run = faults.part(document, "planner", _run, names)
    tracks = faults.part(document, "robots", _tracks, names)
    steady = faults.part(document, "steady", steady_of, names) or ()
    if frame and loaded:
        faults.attempt("tick", _check_tick, frame.tick, loaded.scenario)
    faults.stop(document)
    assert loaded is not None, "or there was a fault"
    assert run is not None, "or there was a fault"
    assert tracks is not None, "or there was a fault"
    return Plan(scenario=loaded.scenario, tracks=tracks, run=run, steady=steady)


def _check_tick(tick: Fraction, scenario: Scenario) -> None:
    own = scenario.problem.clock.tick
    if tick != own:
        remedy = "plan the scenario again; these times mean something else"
        raise InputError.at("", f"{shown(tick)}, but the scenario's is {own} ({remedy})")


def _tracks(data: Any, names: Names | None) -> tuple[Track, ...]:
    """Return the tracks in the scenario's order; without names, only look for faults of shape."""
    from rightofway.io.plan.shape import TrackDocument

    if not isinstance(data, list):
        raise InputError.at("", f"{shown(data)} is not a list (give one track for each robot)")
    faults, tracks = Faults(), dict[int, Track]()
    for index, written in enumerate(data):
        document = faults.attempt(f"[{index}]", checked, TrackDocument, written)
        if document and names:
            faults.attempt(f"[{index}]", _place_track, document, names, tracks)
    faults.stop()
    missing = [name for name, robot in names.robots.items() if robot not in tracks] if names else []
    if missing:
        raise InputError.at("", f"{shown(missing[0])} has no track (give one for each robot)")
    return tuple(tracks[robot] for robot in sorted(tracks))


def _place_track(document: TrackDocument, names: Names, tracks: dict[int, Track]) -> None:
    with under("name"):
        robot = names.robot(document.name)
        if robot in tracks:
            message = f"{shown(document.name)} has a track already (take one out)"
            raise InputError.at("", message)
    tracks[robot] = Track.of(_vertices(document.vertices, names), document.enter)


def _vertices(written: list[str], names: Names) -> list[VertexId]:
    for index, name in enumerate(written):
        if name not in names.vertices:
            with under(f"vertices[{index}]"):
                names.vertex(name)
    return [names.vertices[name] for name in written]


def _run(data: Any, names: Names | None) -> PlannerRun | None:
    """Return how the plan came about; without names, only look for faults of shape."""
    from rightofway.io.plan.shape import PlannerDocument

    document = checked(PlannerDocument, data)
    if names is None:
        return None
    faults = Faults()
    decisions = [
        faults.attempt(f"decisions[{index}]", _decision, written, names)
        for index, written in enumerate(document.decisions)
    ]
    reroutes = [
        faults.attempt(f"reroutes[{index}]", _reroute, written, names)
        for index, written in enumerate(document.reroutes)
    ]
    faults.stop()
    return PlannerRun(
        name=document.name,
        options={key: _plain(value) for key, value in document.options.items()},
        seed=document.seed,
        status=document.status,
        seconds=None if document.seconds is None else float(document.seconds),
        decisions=tuple(decision for decision in decisions if decision),
        reroutes=tuple(reroute for reroute in reroutes if reroute),
    )


def _decision(document: DecisionDocument, names: Names) -> Decision:
    with under("vertices"):
        vertices = tuple(map(names.vertex, document.vertices))
    with under("waits_at"):
        waits_at = names.vertex(document.waits_at)
    with under("robots"):
        one, other = map(names.robot, document.robots)
    with under("waits"):
        waits = names.robot(document.waits)
        if waits not in {one, other}:
            message = f"{shown(document.waits)} is none of the two robots (name one of them)"
            raise InputError.at("", message)
    sums = document.completion_sums
    return Decision(
        tick=Tick(document.tick),
        kind=document.kind,
        vertices=vertices,
        robots=(one, other),
        waits=waits,
        waits_at=waits_at,
        ticks=Tick(document.ticks),
        level=document.level,
        conflicts_left=_pair(document.conflicts_left),
        completion_sums=None if sums is None else _pair(sums),
    )


def _pair(numbers: list[int | None]) -> tuple[int | None, int | None]:
    first, second = numbers
    return first, second


def _reroute(document: RerouteDocument, names: Names) -> Reroute:
    with under("robot"):
        return Reroute(robot=names.robot(document.robot), because=document.because)


def _plain(value: Any) -> Any:
    """Return an option's value with floats, as planners have them, in the place of decimals."""
    if isinstance(value, Decimal):
        return float(value)
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, list) else value
