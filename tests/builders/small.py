"""Every small scenario, and every planner that has to plan them all without a fault."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from rightofway.model import Rules, Scenario
from rightofway.planners import Feature, find_all
from tests.builders.fleets import PAPER, grid_fleet, paper_scenario, random_fleet

__all__ = ["SMALL", "STRICT"]

STRICT = sorted(
    name for name, spec in find_all().items() if Feature.LEAVES_SWAPS not in spec.features
)
"""Planners whose plans keep all rules; the paper's method leaves swaps."""

RULES = {
    "paper": Rules(),
    "both": Rules(occupancy="both"),
    "headway": Rules(headway=Fraction(1)),
    "both and headway": Rules(occupancy="both", headway=Fraction(1, 2)),
    "one way": Rules(ends="none"),
    "two laps": Rules(laps=2),
    "no rotations": Rules(rotations=False),
    "no turning": Rules(turn=Fraction(0)),
    "turn rate": Rules(turn_rate=Fraction(60)),
}

SMALL: dict[str, Scenario] = {
    **{case["name"]: paper_scenario(case) for case in PAPER},
    **{
        f"random {seed}, {name}": random_fleet(seed, rules=rules)
        for seed, (name, rules) in enumerate(RULES.items())
    },
    **{
        f"{case['name']}, four laps": replace(paper_scenario(case), rules=Rules(laps=4))
        for case in PAPER
        if case["name"] in {"door-2", "door-5", "cross-2"}
    },
    "stays at home": grid_fleet(["..."], [("N0", "N0"), ("N2", "N2")], work=[3]),
}
