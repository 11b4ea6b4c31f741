"""Shifts: a small one with four jobs, and random ones; jobs become known one after another."""

from __future__ import annotations

from typing import Any

from rightofway.dispatch import Reveal, ShiftRecord, ShiftRules, run_shift
from rightofway.execution.delays import delay_model_of, read_delays
from rightofway.io.scenario.reader import parse_scenario
from rightofway.io.yaml_text import parse_yaml
from rightofway.model import Scenario, Tick
from tests.builders.work_scenarios import draw_work_document

SHIFT = """
format: rightofway-scenario/1
map: {grid: ["......", "......"]}
units: {time: s}
robots:
  - {name: R1, home: N0, battery: tank}
  - {name: R2, home: N6, battery: tank}
batteries: {tank: {drive: 1/50, charge: 1/20, reserve: 1/10}}
charging: [N0, N6]
rules: {turn: 0}
jobs:
  - {name: J1, pickup: N5, dropoff: N1, pickup_work: 2, due: 60}
  - {name: J2, at: N11, work: 3, earliest: 4}
  - {name: J3, pickup: N4, dropoff: N9, earliest: 30, due: 31}
  - {name: J4, at: N3, latest: 2}
"""
"""J3 is known at 30 and due at 31; nobody is at N3 by 2."""

LONG = Tick(3000)
"""The end of shifts that should be over long before [ticks]."""


def make_shift(until: int = LONG) -> ShiftRecord:
    """Return the record of the small shift."""
    return hold_shift(parse_scenario(parse_yaml(SHIFT)), until=Tick(until))


def draw_shift(
    seed: int, *, n_robots: int = 3, n_jobs: int = 8, windows: bool = True, lead: int = 0
) -> ShiftRecord:
    """Return the record of a shift on a scenario that is drawn, without delays."""
    document = draw_work_document(seed, n_robots=n_robots, n_jobs=n_jobs, windows=windows)
    document["rules"] |= {"headway": seed % 2, "turn": seed // 2 % 2, "rotations": False}
    scenario = parse_scenario(document)
    return hold_shift(scenario, seed=seed, first=seed % 4 or None, lead=lead)


def hold_shift(
    scenario: Scenario,
    *,
    seed: int = 0,
    first: int | None = None,
    lead: int = 0,
    delays: str = "",
    until: Tick = LONG,
) -> ShiftRecord:
    """Return the record of a shift without a time limit: it depends on the seed alone."""
    rules = ShiftRules(
        until=until, step=Tick(max(1, lead)), lead=Tick(lead), time_limit=None, seed=seed
    )
    model = delay_model_of(read_delays(delays, scenario), scenario) if delays else None
    reveal = Reveal(scenario.jobs or (), scenario.problem.clock, first=first)
    return run_shift(scenario, reveal, rules, delays=model)


def make_scenario(grid: list[str], robots: dict[str, Any], **others: Any) -> Scenario:
    """Return a scenario on a grid: the homes of robots, or their documents, by name."""
    fleet = [
        {"name": name, **(own if isinstance(own, dict) else {"home": own})}
        for name, own in robots.items()
    ]
    rules = {"turn": 0, **others.pop("rules", {})}
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": grid},
            "robots": fleet,
            "rules": rules,
            **others,
        }
    )
