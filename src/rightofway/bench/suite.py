"""A suite of cases: maps, fleets, counts, seeds, limits and planners, read from TOML."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.bench.fleets import Cell, draw_grid, find_largest_part, make_scenario_document
from rightofway.bench.shifts import SHIFT, read_shift_options, try_out_options
from rightofway.errors import InputError, Steps, Where, locate_faults, name_file
from rightofway.io import dump_scenario, load, parse_scenario
from rightofway.io.content import read_text
from rightofway.io.faults import Faults, validate
from rightofway.io.formats import SCENARIO_FORMAT, SUITE_FORMAT, check_format
from rightofway.io.toml_text import parse_toml
from rightofway.kinds.numbers import format_number
from rightofway.model import Rules, Scenario
from rightofway.model.robot import RULE_ATTRIBUTES
from rightofway.planners import find

if TYPE_CHECKING:
    from rightofway.io.suite import (
        MapCasesDocument,
        SuiteDocument,
        SuiteFleetDocument,
        SuitePlannerDocument,
    )

LAPS = "laps"
"""In place of a planner: the fleet repeats its work under a rule."""

SHIFT_LIMIT, LIMIT = Fraction(1), Fraction(10)
"""Default time limit of a round of a shift, and of a planner [s]."""


_Planner = tuple[str, Mapping[str, Any]]
"""A planner, or a word in place of one, with its options."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Fleet:
    """A fleet of a suite, as plain data: drawn on a map, or what it changes in a scenario."""

    name: str
    drawn: dict[str, Any]
    changes: dict[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Map:
    """A map of a suite, as plain data, with homes and targets where a .scen file has them."""

    name: str
    scen: str = ""
    counts: tuple[int, ...]
    data: Mapping[str, Any]
    ends: tuple[tuple[Cell, Cell], ...] = ()
    scenario: Scenario | None = None
    takes_fleets: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One fleet, one planner, one time limit. It needs no files, so any machine can run it.

    Attributes
    ----------
    map, scen, fleet
        Names, for people.
    robots
        How many.
    seed
        For drawing the fleet, and for the planner.
    limit
        The time limit of the planner, or of each round of a shift [s].
    planner, options
        The planner, `LAPS` or `SHIFT`, with a value for each of its options.
    problem
        ``{"random": …}``, ``{"grid": …, "ends": …}`` or ``{"scenario": …}``, as plain data.
    fleet_data
        ``speeds``, whether they are drawn ``by_seed`` or assigned in turn, least and most ``work``
        [time unit], and ``rules`` as in a scenario. For a scenario ``speeds``, ``rules`` and the
        number of ``chargers``, or None if it is taken as it is.
    key
        A hash of all this but the names: the same case has the same key in every run.
    """

    map: str
    scen: str
    fleet: str
    robots: int
    seed: int
    limit: Fraction
    planner: str
    options: Mapping[str, Any]
    problem: Mapping[str, Any] = field(repr=False)
    fleet_data: Mapping[str, Any] | None = field(repr=False)
    key: str = field(init=False)

    def __post_init__(self) -> None:
        definition = [
            self.problem, self.fleet_data, self.robots, self.seed, str(self.limit),
            self.planner, dict(self.options),
        ]  # fmt: skip
        text = json.dumps(definition, sort_keys=True, separators=(",", ":"), default=str)
        object.__setattr__(self, "key", hashlib.sha256(text.encode()).hexdigest()[:16])

    @property
    def labels(self) -> dict[str, Any]:
        """The columns of a row that identify the case."""
        return {
            "key": self.key,
            "map": self.map,
            "scen": self.scen,
            "fleet": self.fleet,
            "planner": self.planner,
            "options": " ".join(f"{name}={value}" for name, value in self.options.items()),
            "robots": self.robots,
            "seed": self.seed,
            "limit": float(self.limit),
        }

    def __str__(self) -> str:
        labels = self.labels
        names = [labels[name] for name in ("map", "scen", "fleet") if labels[name]]
        counts = [
            f"{self.robots} robot{'s' * (self.robots != 1)}",
            f"seed {self.seed}",
            f"{float(self.limit):g} s",
        ]
        return ", ".join([*names, *counts, " ".join([self.planner, labels["options"]]).strip()])

    def make_scenario(self) -> Scenario:
        """Make the scenario."""
        document = make_scenario_document(self.problem, self.fleet_data, self.robots, self.seed)
        return parse_scenario(document)


def read_suite(path: Path | str) -> tuple[Case, ...]:
    """Read a suite and every file that it names; return every combination of its lists.

    The planners of one fleet are next to each other.

    Parameters
    ----------
    path
        A TOML file; ``-`` is standard input.

    Raises
    ------
    InputError
        With every independent fault, its place, value and remedy; also if two cases are the same
        but for their names.
    """
    from rightofway.io.suite import SuiteDocument

    path = Path(path)
    with name_file(str(path)):
        if path.suffix.lower() in {".yaml", ".yml", ".json"}:
            message = f'a suite is TOML (begin it with format = "{SUITE_FORMAT}")'
            raise InputError.at("", message)
        data = check_format(parse_toml(read_text(path)), SUITE_FORMAT)
        combined = list(_combine(validate(SuiteDocument, data), path.parent))
    cases: dict[str, Case] = {}
    for case in combined:
        twin = cases.setdefault(case.key, case)
        if twin is not case:
            message = f"two cases are the same: {case}; and {twin} (take one of them out)"
            raise InputError.at("", message, path.stem)
    return tuple(cases.values())


def _combine(document: SuiteDocument, base: Path) -> Iterator[Case]:
    from rightofway.io.suite import SuiteFleetDocument

    faults = Faults()
    maps = [
        faults.attempt(("maps", index), _read_maps, group, document.counts, base)
        for index, group in enumerate(document.maps)
    ]
    planners = [
        faults.attempt(("planners", index), _read_planner, group)
        for index, group in enumerate(document.planners)
    ]
    fleets = [
        faults.attempt(("fleets", index), _read_fleet, group)
        for index, group in enumerate(document.fleets or [SuiteFleetDocument({"name": "default"})])
    ]
    _note_twins(faults, "maps", [group[0].name if group else None for group in maps])
    _note_twins(faults, "fleets", [group.name if group else None for group in fleets])
    _note_unfit(faults, maps, fleets, planners)
    faults.stop(("maps", "planners", "fleets"))
    dealt, runners = list(filter(None, fleets)), list(filter(None, planners))
    limits: Sequence[Fraction | None] = document.limits or [None]
    for spec in (spec for group in maps for spec in group or ()):
        for fleet, count in product(dealt if spec.takes_fleets else [None], spec.counts):
            ends = {"ends": spec.ends[:count]} if spec.ends else {}
            for seed, limit, planner in product(document.seeds, limits, runners):
                yield Case(
                    map=spec.name,
                    scen=spec.scen,
                    fleet=fleet.name if fleet else "",
                    robots=count,
                    seed=seed,
                    limit=limit or (SHIFT_LIMIT if planner[0] == SHIFT else LIMIT),
                    planner=planner[0],
                    options=planner[1],
                    problem={**spec.data, **ends},
                    fleet_data=(fleet.changes if spec.scenario else fleet.drawn) if fleet else None,
                )


def _note_unfit(
    faults: Faults,
    maps: Sequence[tuple[_Map, ...] | None],
    fleets: Sequence[_Fleet | None],
    planners: Sequence[_Planner | None],
) -> None:
    """Note shifts without jobs, and what does not fit a scenario."""
    shifts = [(k, own[1]) for k, own in enumerate(planners) if own and own[0] == SHIFT]
    changed = False
    for index, [spec] in ((k, group) for k, group in enumerate(maps) if group and len(group) == 1):
        if shifts and (spec.scenario is None or spec.scenario.jobs is None):
            faults.note(("maps", index), f"it has no jobs for {SHIFT} (give a scenario with jobs)")
            continue
        for number, options in shifts:
            faults.attempt(("planners", number, "options"), try_out_options, options, spec.scenario)
        if spec.scenario is not None and spec.takes_fleets:
            changed = True
            faults.attempt(("maps", index), _try_out_fleets, spec, list(filter(None, fleets)))
    for index, fleet in enumerate(fleets):
        if fleet and fleet.changes["chargers"] is not None and not changed:
            message = (
                "there is no scenario with counts, and others keep their chargers (add counts)"
            )
            faults.note(("fleets", index, "chargers"), message)


def _try_out_fleets(spec: _Map, fleets: Sequence[_Fleet]) -> None:
    """Have the reader of scenarios find faults of a scenario with another fleet."""
    for fleet, count in product(fleets, sorted({min(spec.counts), max(spec.counts)})):
        document = make_scenario_document(spec.data, fleet.changes, count, seed=0)
        try:
            parse_scenario(document)
        except InputError as error:
            words = f"with {count} robots and fleet {fleet.name}: {error.faults[0]}"
            raise InputError.at("counts", words) from None


def _note_twins(faults: Faults, key: str, names: Sequence[str | None]) -> None:
    for index, name in enumerate(names):
        first = names.index(name)
        if name is not None and first != index:
            message = f"{name!r} is the name of {{other}} already (give each its own)"
            faults.note((key, index, "name"), message, (key, first))


def _read_maps(
    document: MapCasesDocument, counts: Sequence[int] | None, base: Path
) -> tuple[_Map, ...]:
    """Read a map of a suite with each of its files; places of faults are relative to the map."""
    if document.scenario is not None:
        with locate_faults("scenario"):
            scenario = load(base / document.scenario)
        spec = _Map(
            name=document.name or Path(document.scenario).stem,
            counts=tuple(document.counts or (len(scenario.robots),)),
            data={"scenario": dump_scenario(scenario)},
            scenario=scenario,
            takes_fleets=document.counts is not None,
        )
        return (spec,)
    counts = tuple(document.counts or counts or ())
    if not counts:
        raise InputError.at("counts", "is missing (give it here, or for the whole suite)")
    if document.random is not None:
        width, height = document.random.size
        walls, seed = document.random.walls, document.random.seed
        room = len(find_largest_part(draw_grid(width=width, height=height, walls=walls, seed=seed)))
        if max(counts) > room:
            message = f"{max(counts)} is more than the {room} cells that hang together (give fewer)"
            raise InputError.at("counts", message)
        name = document.name or f"random-{width}-{height}-{walls * 100:g}"
        recipe = {"width": width, "height": height, "walls": walls, "seed": seed}
        return (_Map(name=name, counts=counts, data={"random": recipe}),)
    faults = Faults()
    specs = [
        faults.attempt("", _read_map_with_rows, document, index, counts, base)
        for index in range(len(document.scens))
    ]
    faults.stop()
    return tuple(spec for spec in specs if spec)


def _read_map_with_rows(
    document: MapCasesDocument, index: int, counts: tuple[int, ...], base: Path
) -> _Map:
    """Read a map and rows as the scenario that they are, so that its reader finds the faults."""
    scen = document.scens[index]
    whole = {
        "format": SCENARIO_FORMAT,
        "map": {"file": document.file},
        "robots": {"scen": scen, "count": max(counts)},
    }
    try:
        scenario = parse_scenario(whole, base)
    except InputError as error:
        keys: dict[Steps, Where] = {
            ("map", "file"): ("file",),
            ("robots", "scen"): ("scens", index),
            ("robots", "count"): ("counts",),
        }
        raise InputError(fault.relocate(keys) for fault in error.faults) from None
    grid = scenario.roadmap.grid
    assert grid is not None, "or its reader would have refused the rows"
    return _Map(
        name=document.name or Path(document.file).stem,
        scen=Path(scen).name,
        counts=counts,
        data={"grid": grid.as_lines()},
        ends=tuple(
            (grid.get_cell(robot.home), grid.get_cell(robot.stops[0].at))
            for robot in scenario.robots
        ),
    )


def _read_fleet(document: SuiteFleetDocument) -> _Fleet:
    """Return a fleet."""
    given = document.get_own_attributes(Rules)
    rules = {
        attribute.key: format_number(own)
        if isinstance(own := given[attribute.name], Fraction)
        else own
        for attribute in sorted(RULE_ATTRIBUTES, key=lambda attribute: attribute.key)
        if attribute.name in given
    }
    speeds = tuple(document.speeds or (Fraction(1),))
    _try_out(speeds, rules)
    drawn = {
        "speeds": [format_number(speed) for speed in speeds],
        "by_seed": document.deal == "by seed",
        "work": document.work,
        "rules": rules,
    }
    changes = {
        "speeds": drawn["speeds"] if document.speeds else [],
        "by_seed": drawn["by_seed"],
        "chargers": document.chargers,
        "rules": rules,
    }
    return _Fleet(name=document.name, drawn=drawn, changes=changes)


def _try_out(speeds: Sequence[Fraction], rules: Mapping[str, Any]) -> None:
    """Have the readers of scenarios find faults of rules and speeds taken together."""
    robots = [
        {"name": f"R{index}", "home": [0, index], "target": [0, index], "speed": speed}
        for index, speed in enumerate(speeds)
    ]
    grid = {"grid": ["." * len(robots)]}
    document = {"format": SCENARIO_FORMAT, "map": grid, "robots": robots, "rules": dict(rules)}
    try:
        parse_scenario(document)
    except InputError as error:
        first = error.faults[0]  # the robots are alike, and so are their faults
        section, *rest = first.path
        where: Where = "speeds" if section == "robots" else tuple(rest)
        raise InputError.at(where, first.message) from None


def _read_planner(document: SuitePlannerDocument) -> _Planner:
    """Return the name of a planner and a value for each of its options."""
    # Options come as on a command line: no True, but true.
    options = {
        name: str(value).lower() if isinstance(value, bool) else value
        for name, value in document.options.items()
    }
    if document.name == LAPS:
        return LAPS, _read_laps_options(options)
    if document.name == SHIFT:
        return SHIFT, read_shift_options(options)
    try:
        spec = find(document.name)
    except InputError as error:
        raise InputError(fault.relocate({("planner",): "name"}) for fault in error.faults) from None
    return spec.name, spec.settle(options)


def _read_laps_options(given: Mapping[str, Any]) -> dict[str, Any]:
    from rightofway.cyclic import ROUTES, RULES, TIMETABLE

    choices = {"rule": (*RULES, TIMETABLE), "routes": ROUTES}
    if given.get("rule") == TIMETABLE:
        del choices["routes"]  # a timetable is chosen together with its routes
    for name, value in given.items():
        if name not in choices:
            message = f"{LAPS} has no such option here (it has {', '.join(choices)})"
            raise InputError.at(("options", name), message)
        if value not in choices[name]:
            message = f"{value!r} is none of them (choose {', '.join(choices[name])})"
            raise InputError.at(("options", name), message)
    return {name: given.get(name, known[0]) for name, known in choices.items()}
