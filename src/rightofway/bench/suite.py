"""What a benchmark is to run: maps, fleets, counts, seeds, limits, planners; read from TOML."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.bench.grounds import Ground, ground_of
from rightofway.errors import InputError, InputFault
from rightofway.io import scenario_of
from rightofway.io.faults import Faults, blaming, checked
from rightofway.io.formats import SCENARIO_FORMAT, SUITE_FORMAT, checked_format
from rightofway.io.text import parse_toml, read_text
from rightofway.model.values import written
from rightofway.planners import find

if TYPE_CHECKING:
    from rightofway.io.suite import PlannerDocument, SuiteDocument, SuiteFleetDocument

__all__ = ["Contender", "Fleet", "Suite", "read_suite"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Fleet:
    """What the robots of a case are like.

    Attributes
    ----------
    name
        In results.
    speeds
        Dealt round robin, or drawn by the seed.
    by_seed
        Whether they are drawn.
    work
        Least and most work time, drawn by the seed [time unit].
    rules
        The rules of its scenarios, as a scenario document has them.
    """

    name: str
    speeds: tuple[Fraction, ...] = (Fraction(1),)
    by_seed: bool = False
    work: tuple[int, int] = (0, 0)
    rules: Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Contender:
    """A planner by name, with a value for each of its options."""

    planner: str
    options: Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Suite:
    """Every combination of these is a case.

    Attributes
    ----------
    name
        That of its file.
    grounds
        Where fleets drive, each with how many robots.
    fleets
        What robots are like; a ground that is a whole scenario has its own.
    seeds
        For drawing fleets, and for planners.
    limits
        Time limits [s].
    contenders
        Planners with their options.
    """

    name: str
    grounds: tuple[Ground, ...]
    fleets: tuple[Fleet, ...]
    seeds: tuple[int, ...]
    limits: tuple[Fraction, ...]
    contenders: tuple[Contender, ...]


def read_suite(path: Path | str) -> Suite:
    """Read a suite and every file that it names.

    Parameters
    ----------
    path
        A TOML file; ``-`` is standard input.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy.
    """
    from rightofway.io.suite import SuiteDocument

    path = Path(path)
    with blaming(str(path)):
        data = checked_format(parse_toml(read_text(path)), SUITE_FORMAT)
        return _suite_of(checked(SuiteDocument, data), path)


def _suite_of(document: SuiteDocument, path: Path) -> Suite:
    faults = Faults()
    grounds = [
        faults.attempt(f"maps[{index}]", ground_of, each, document.counts, path.parent)
        for index, each in enumerate(document.maps)
    ]
    contenders = [
        faults.attempt(f"planners[{index}]", _contender, each)
        for index, each in enumerate(document.planners)
    ]
    fleets = [
        faults.attempt(f"fleets[{index}]", _fleet, each)
        for index, each in enumerate(document.fleets or ())
    ]
    found = [ground for ground in grounds if ground]
    _note_twins(faults, "maps", [each.name if each else None for each in grounds])
    _note_twins(faults, "fleets", [each.name if each else None for each in fleets])
    faults.stop(("maps", "planners", "fleets"))
    return Suite(
        name=path.stem,
        grounds=tuple(found),
        fleets=tuple(fleet for fleet in fleets if fleet) or (Fleet(name="default", rules={}),),
        seeds=tuple(document.seeds),
        limits=tuple(document.limits or (Fraction(10),)),
        contenders=tuple(each for each in contenders if each),
    )


def _note_twins(faults: Faults, key: str, names: Sequence[str | None]) -> None:
    for index, name in enumerate(names):
        first = names.index(name)
        if name is not None and first != index:
            message = f"{name!r} is the name of {key}[{first}] already (give each its own)"
            faults.note(f"{key}[{index}].name", message)


def _fleet(document: SuiteFleetDocument) -> Fleet:
    given = document.given("occupancy", "headway", "turn", "laps", "rotations")
    if document.ends is not None:
        given["return"] = document.ends
    fleet = Fleet(
        name=document.name,
        speeds=tuple(document.speeds or (Fraction(1),)),
        by_seed=document.deal == "by seed",
        work=document.work,
        rules={
            key: written(value) if isinstance(value, Fraction) else value
            for key, value in sorted(given.items())
        },
    )
    _try_out(fleet)
    return fleet


def _try_out(fleet: Fleet) -> None:
    """Have the readers of scenarios find what is wrong with rules and speeds taken together."""
    robots = [
        {"name": f"R{index}", "home": [0, index], "target": [0, index], "speed": speed}
        for index, speed in enumerate(fleet.speeds)
    ]
    grid = ["." * len(robots)]
    try:
        scenario_of(
            {
                "format": SCENARIO_FORMAT,
                "map": {"grid": grid},
                "robots": robots,
                "rules": dict(fleet.rules),
            }
        )
    except InputError as error:
        first = error.faults[0]  # the robots are alike, and so are their faults
        key = first.place.removeprefix("rules.")
        raise InputError.at("speeds" if key == "robots" else key, first.message) from None


def _contender(document: PlannerDocument) -> Contender:
    try:
        spec = find(document.name)
        options = spec.settle(_plain(document.options))
    except InputError as error:
        raise InputError(
            InputFault(_place(fault.place), fault.message) for fault in error.faults
        ) from None
    return Contender(planner=spec.name, options=options)


def _place(place: str) -> str:
    """Return where a suite has what the registry, which knows of no document, speaks of."""
    _, _, option = place.partition(" ")
    return f"options.{option}" if option else "name"


def _plain(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of options as a command line would give them: no ``True``, but true."""
    return {
        name: str(value).lower() if isinstance(value, bool) else value
        for name, value in options.items()
    }
