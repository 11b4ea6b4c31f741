"""Shifts on small random scenarios with jobs that become known one after another."""

from __future__ import annotations

from typing import Any

from rightofway.dispatch import Reveal, ShiftRecord, ShiftRules, run_shift
from rightofway.execution.delays import delay_model_of, read_delays
from rightofway.io.scenario.reader import parse_scenario
from rightofway.model import Scenario, Tick
from tests.builders.work_scenarios import draw_work_document

LONG = Tick(3000)
"""The end of shifts that should be over long before [ticks]."""


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
