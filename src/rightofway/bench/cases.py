"""The cases of a suite: what each one is, and the key it is known by."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from typing import Any

from rightofway.bench.fleets import scenario_document
from rightofway.bench.suite import Fleet, Suite
from rightofway.errors import InputError
from rightofway.io import scenario_of
from rightofway.model import Scenario
from rightofway.model.values import written

__all__ = ["Case", "cases_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One fleet, one planner, one time limit. It needs no files, so it can go anywhere.

    Attributes
    ----------
    map, scen, fleet
        Names, for people.
    robots
        How many.
    seed
        For drawing the fleet, and for the planner.
    limit
        The time limit [s].
    planner, options
        The planner, with a value for each of its options.
    problem
        The map, as plain data; see `rightofway.bench.grounds.Source`.
    fleet_data
        Speeds, work and rules, as plain data; None if the problem is a whole scenario.
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
        text = json.dumps(definition, sort_keys=True, separators=(",", ":"))
        object.__setattr__(self, "key", hashlib.sha256(text.encode()).hexdigest()[:16])

    @property
    def labels(self) -> dict[str, Any]:
        """What a row says of the case."""
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
        counts = [f"{self.robots} robots", f"seed {self.seed}", f"{float(self.limit):g} s"]
        return ", ".join([*names, *counts, " ".join([self.planner, labels["options"]]).strip()])

    def scenario(self) -> Scenario:
        """Make the scenario."""
        document = scenario_document(self.problem, self.fleet_data, self.robots, self.seed)
        return scenario_of(document)


def cases_of(suite: Suite) -> tuple[Case, ...]:
    """Return every case of a suite, the planners of one fleet next to each other.

    Raises
    ------
    InputError
        If two cases are the same but for their names.
    """
    cases: dict[str, Case] = {}
    for case in _combinations(suite):
        twin = cases.setdefault(case.key, case)
        if twin is not case:
            message = f"two cases are the same: {case}; and {twin} (take one of them out)"
            raise InputError.at("", message, suite.name)
    return tuple(cases.values())


def _combinations(suite: Suite) -> Iterator[Case]:
    for ground in suite.grounds:
        fleets: tuple[Fleet | None, ...] = (None,) if ground.has_fleet else suite.fleets
        for source, fleet, count in product(ground.sources, fleets, ground.counts):
            problem, data = source.fault(count), _data(fleet) if fleet else None
            for seed, limit, contender in product(suite.seeds, suite.limits, suite.contenders):
                yield Case(
                    map=ground.name,
                    scen=source.scen,
                    fleet=fleet.name if fleet else "",
                    robots=count,
                    seed=seed,
                    limit=limit,
                    planner=contender.planner,
                    options=contender.options,
                    problem=problem,
                    fleet_data=data,
                )


def _data(fleet: Fleet) -> dict[str, Any]:
    return {
        "speeds": [written(speed) for speed in fleet.speeds],
        "by_seed": fleet.by_seed,
        "work": fleet.work,
        "rules": dict(fleet.rules),
    }
