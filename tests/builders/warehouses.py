"""A small warehouse: aisles between shelves, robots that fetch something and come home."""

from __future__ import annotations

import random

import rightofway
from rightofway.io import parse_scenario
from rightofway.model import Plan

__all__ = ["warehouse"]


def warehouse(robots: int, seed: int = 0, planner: str = "prioritized") -> Plan:
    """Return a plan of robots that stand in the row below the aisles, one stop each."""
    width = max(2 * robots + 1, 21)
    shelves = "".join("." if column % 5 == 0 else "@" for column in range(width))
    rows = ["." * width]
    for _ in range(4):
        rows += [shelves, shelves, "." * width]
    rows += ["." * width, "." * width]
    draw = random.Random(seed)  # noqa: S311
    places = [
        (row, column)
        for row, line in enumerate(rows[:-3])
        for column, cell in enumerate(line)
        if cell == "."
    ]
    stops = draw.sample(places, robots)
    scenario = parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"grid": rows},
            "rules": {"rotations": False},
            "robots": [
                {
                    "name": f"R{k}",
                    "home": [len(rows) - 1, 2 * k],
                    "stops": [{"at": list(stop), "work": 2}],
                }
                for k, stop in enumerate(stops)
            ],
        }
    )
    return rightofway.solve(scenario, planner, seed=seed)
