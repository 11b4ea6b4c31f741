"""Scenario documents, read: every fault at once, or a scenario that is valid by construction."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, InputFault
from rightofway.io.faults import Faults, blaming, checked, checked_format
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.io.scenario.classic import classic_document, classic_fault
from rightofway.io.scenario.draft import Draft
from rightofway.io.scenario.ground import Ground
from rightofway.io.scenario.maps import ground_of
from rightofway.io.scenario.robots import fleet_of
from rightofway.io.text.documents import read_document
from rightofway.io.words import shown
from rightofway.model import Robot, Rules, Scenario
from rightofway.model.units import MAX_TICKS_OF_SHORTEST

__all__ = ["MAX_STAGES", "Loaded", "load", "read", "read_scenario", "scenario_of"]

MAX_STAGES = 1_000_000
"""Stops and ways home of a whole fleet, laps unrolled, at most."""

MAX_TICKS = 2**40
"""The longest duration of a scenario; routes of any length then stay within 64 bits."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Loaded:
    """A scenario, and what its reader has to say about it.

    Attributes
    ----------
    scenario
        The scenario.
    notes
        Sentences for the user: what a floor was cut into, whether durations are rounded.
    """

    scenario: Scenario
    notes: tuple[str, ...] = ()


def load(path: Path | str) -> Scenario:
    """Return the scenario of a file; see `read`."""
    return read(path).scenario


def read(path: Path | str) -> Loaded:
    """Read a scenario file.

    Parameters
    ----------
    path
        A scenario as YAML or JSON; or a `.scen` file, which is classic MAPF: unit speeds, no work,
        no turning, no way back, the map beside it or in ``../maps``.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    path = Path(path)
    if path.suffix.lower() == ".scen":
        return _read_classic(path)
    with blaming(str(path)):
        return read_scenario(read_document(path), path.parent)


def _read_classic(path: Path) -> Loaded:
    document = classic_document(path)
    try:
        return read_scenario(document, path.parent)
    except InputError as error:
        faults = (classic_fault(fault, path) for fault in error.faults)
        raise InputError(faults, str(path)) from None


def scenario_of(document: dict[str, Any], base: Path | None = None, source: str = "") -> Scenario:
    """Return the scenario of a document.

    Parameters
    ----------
    document
        Plain data, as a YAML or JSON file would hold. A float counts as the shortest decimal that
        stands for it.
    base
        The directory that files in it are relative to; None if it may name none.
    source
        What faults are said to be in.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    with blaming(source):
        return read_scenario(document, base).scenario


def read_scenario(document: Any, base: Path | None) -> Loaded:
    """Return a scenario and notes on it: the work behind `read` and `scenario_of`."""
    from rightofway.io.scenario.shape import ScenarioFrame

    document = checked_format(document, SCENARIO_FORMAT)
    faults = Faults()
    faults.attempt("", checked, ScenarioFrame, document)
    rules = faults.part(document, "rules", _rules) or Rules()
    fleet = fleet_of(document["robots"], base, faults) if "robots" in document else None
    speeds = fleet.speeds() if fleet else None
    ground = faults.part(document, "map", _ground, speeds, base)
    drafts = fleet.drafts(ground, faults) if fleet and ground else []
    scenario = _assembled(ground, drafts, rules, faults) if drafts and ground else None
    faults.stop(document)
    assert scenario is not None, "or there was a fault"
    assert ground is not None, "or there was a fault"
    return Loaded(scenario=scenario, notes=(*ground.notes(), *_clock_notes(scenario)))


def _rules(data: Any) -> Rules:
    from rightofway.io.scenario.shape import RulesDocument

    document = checked(RulesDocument, data)
    return Rules(**document.given("occupancy", "headway", "turn", "ends", "laps", "rotations"))


def _ground(data: Any, speeds: Sequence[Fraction] | None, base: Path | None) -> Ground | None:
    from rightofway.io.scenario.shape import MapDocument

    return ground_of(checked(MapDocument, data), speeds, base)


def _assembled(
    ground: Ground, drafts: Sequence[Draft], rules: Rules, faults: Faults
) -> Scenario | None:
    """Return the scenario, or None after noting what the model finds wrong."""
    try:
        _check_stages([draft.robot for draft in drafts], rules)
        robots = tuple(draft.robot for draft in drafts)
        scenario = Scenario(roadmap=ground.roadmap, robots=robots, rules=rules)
        _check_ticks(scenario)
    except InputError as error:
        for fault in error.faults:
            faults.note(*_in_document(fault, drafts))
        return None
    return scenario


def _check_stages(robots: Sequence[Robot], rules: Rules) -> None:
    stages = sum((len(robot.stops) + 1) * (robot.laps or rules.laps) for robot in robots)
    if stages > MAX_STAGES:
        message = (
            f"{stages} stops and ways home in all laps, more than {MAX_STAGES} (give fewer laps)"
        )
        raise InputError.at("robots", message)


def _check_ticks(scenario: Scenario) -> None:
    problem = scenario.problem
    longest = max(
        problem.headway,
        *(max(itinerary.edge_ticks, default=0) for itinerary in problem.itineraries),
        *(stage.work + stage.turn for it in problem.itineraries for stage in it.stages),
    )
    if longest > MAX_TICKS:
        ticks = f"{shown(longest)} ticks of {shown(problem.clock.tick)}"
        message = f"a duration of {ticks} is too long (bring speeds and times closer together)"
        raise InputError.at("robots", message)


def _in_document(fault: InputFault, drafts: Sequence[Draft]) -> tuple[str, str]:
    """Return place and message of a model's problem as the document has them.

    The model numbers the robots it was given, which lack those with faults of their own.
    """
    found = re.fullmatch(r"robots\[(\d+)\]\.(.*)", fault.place)
    if not found:
        return fault.place, fault.message
    draft, key = drafts[int(found[1])], found[2]
    other = re.match(r"(.*) of robots\[(\d+)\] already", fault.message)
    message = fault.message
    if other:
        twin = drafts[int(other[2])].place
        message = f"{other[1]} of {twin} already{message[other.end() :]}"
    return draft.aliases.get(key, f"{draft.place}.{key}"), message


def _clock_notes(scenario: Scenario) -> Iterator[str]:
    if not scenario.problem.clock.exact:
        yield (
            f"durations are rounded up to 1/{MAX_TICKS_OF_SHORTEST} of the shortest;"
            " give speeds with smaller denominators to be exact"
        )
