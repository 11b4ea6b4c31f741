"""Many robots with own speeds on little room: where time is lost, and what the order gains.

``python -m benchmarks.little_room [FOLDER]`` draws fleets of the speeds 1, 1/2, 1/3 and 1/5 in
turn that book ahead, on floors where robots take a third of the places or more. With a folder of
the MovingAI benchmark, with ``maps`` and ``scens`` in it, rows of that are measured, too. One
thread, CPU time; each fleet is planned by prioritized planning with robots in several orders.
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.common import movingai_fleet, table
from rightofway.bench.fleets import draw_grid, find_largest_part
from rightofway.io import parse_scenario
from rightofway.io.formats import SCENARIO_FORMAT
from rightofway.model import Scenario, Track
from rightofway.search import FleetSearch

SPEEDS = ("1", "1/2", "1/3", "1/5")
POWERS = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0)
"""Robots queue by time alone * speed ** power: 0 is the quickest trip, 1 that of fewest lanes."""

LIMIT, SEARCHES = 300, 4
SEEDS = (11, 12, 13)
ROWS = (("empty-48-48", 1000), ("warehouse-10-20-10-2-1", 1000))


def draw_floors(seed: int) -> dict[str, tuple[list[str], int]]:
    """Return floors and how many robots they get."""
    aisles = [
        "".join("." if row % 3 == 0 or c % 12 < 2 or not 6 <= c < 66 else "@" for c in range(72))
        for row in range(42)
    ]
    return {
        "open, 40 x 40": (["." * 40] * 40, 700),
        "10 % walls, 44 x 44": (draw_grid(width=44, height=44, walls=0.1, seed=seed), 700),
        "aisles, 72 x 42": (aisles, 500),
    }


def draw_fleet(lines: Sequence[str], robots: int, seed: int) -> Scenario:
    """Return robots between random places of a floor."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    places = find_largest_part(lines)
    homes, targets = (draw.sample(places, robots) for _ in range(2))
    documents = [
        {
            "name": f"R{index}",
            "home": list(home),
            "target": list(target),
            "speed": SPEEDS[index % 4],
        }
        for index, (home, target) in enumerate(zip(homes, targets, strict=True))
    ]
    rules = {"occupancy": "both", "return": "none", "turn": 0}
    return parse_scenario(
        {"format": SCENARIO_FORMAT, "map": {"grid": lines}, "robots": documents, "rules": rules}
    )


def deal_speeds(whole: Scenario) -> Scenario:
    """Return a fleet of the MovingAI benchmark with own speeds."""
    robots = tuple(
        replace(robot, speed=Fraction(SPEEDS[index % 4]))
        for index, robot in enumerate(whole.robots)
    )
    return replace(whole, robots=robots, rules=replace(whole.rules, occupancy="both"))


def plan_in_order(
    scenario: Scenario, power: float, seed: int
) -> tuple[FleetSearch, NDArray[np.int64], float]:
    """Return the fleet with its tracks, what robots need alone [ticks], and CPU time [s]."""
    search = FleetSearch(scenario.problem, seed=seed, threads=1)
    alone = search.compute_alone()
    speeds = np.array([float(robot.speed) for robot in scenario.robots])
    order = np.argsort(alone * speeds**power, kind="stable").tolist()
    began = time.process_time()
    is_complete = search.prioritize(order, searches=SEARCHES * len(order), time_limit=LIMIT)
    if not is_complete:
        raise SystemExit(f"no plan after {LIMIT} s")
    return search, alone, time.process_time() - began


class Losses:
    """Where robots lose time, and behind whom: ticks, summed over robots of one speed."""

    def __init__(self, scenario: Scenario, tracks: Sequence[Track]) -> None:
        self.drives = np.array(
            [scenario.problem.clock.count_ticks(1 / robot.speed) for robot in scenario.robots]
        )
        self._stays: dict[int, list[tuple[int, int, int, int]]] = {}
        for robot, track in enumerate(tracks):
            enter = track.enter.tolist()
            leave = [*enter[1:], FOREVER]
            for vertex, first, last in zip(track.vertices.tolist(), enter, leave, strict=True):
                self._stays.setdefault(vertex, []).append((last, first, robot, vertex))
        self._blockers = {
            (vertex, last): (robot, first)
            for stays in self._stays.values()
            for last, first, robot, vertex in stays
        }

    def split(self, robot: int, track: Track, alone: int) -> dict[str, int]:
        """Return what one robot loses: by detours, at home, and behind other robots."""
        drive, enter = int(self.drives[robot]), track.enter.tolist()
        parts = dict.fromkeys(PARTS, 0)
        parts["detour"] = drive * (len(enter) - 1) - alone
        for k, vertex in enumerate(track.vertices.tolist()[1:], 1):
            start = enter[k] - drive
            wait = start - enter[k - 1]
            if wait <= 0:
                continue
            blocker, entered = self._blockers.get((vertex, start), (robot, start))
            if blocker == robot:
                parts["no robot"] += wait
                continue
            other = int(self.drives[blocker])
            driving = min(wait, other) + max(
                0, min(wait, start - entered + other) - (start - entered)
            )
            pace = "slower" if other > drive else "as fast" if other == drive else "faster"
            parts[f"{pace}, drives"] += min(wait, driving)
            parts[f"{pace}, stands"] += wait - min(wait, driving)
        return parts


PARTS = (
    "detour", "no robot", "slower, drives", "slower, stands", "as fast, drives",
    "as fast, stands", "faster, drives", "faster, stands",
)  # fmt: skip
FOREVER = 2**62


def list_losses(
    name: str, scenario: Scenario, search: FleetSearch, alone: NDArray[np.int64]
) -> list[tuple[str, ...]]:
    """Return a line for each speed: how late robots are, and shares of all that is lost."""
    tracks, lines = search.list_tracks(), []
    losses = Losses(scenario, tracks)
    completions = np.array([int(track.enter[-1]) for track in tracks])
    lost = int((completions - alone).sum())
    for drive in sorted(set(losses.drives.tolist())):
        robots = np.flatnonzero(losses.drives == drive).tolist()
        parts = [losses.split(robot, tracks[robot], int(alone[robot])) for robot in robots]
        ratio = completions[robots].sum() / alone[robots].sum()
        shares = [f"{100 * sum(part[kind] for part in parts) / lost:.0f}" for kind in PARTS]
        lines.append((name, str(drive), f"{ratio:.2f}", *shares))
    return lines


def main() -> None:
    """Print both tables."""
    fleets = []
    for seed in SEEDS:
        for name, (lines, robots) in draw_floors(seed).items():
            fleets.append((name, draw_fleet(lines, robots, seed), seed))
    for folder in map(Path, sys.argv[1:]):
        for name, robots in ROWS:
            whole = deal_speeds(movingai_fleet(folder, name, robots, 1))
            fleets.append((name, whole, 1))
    orders, losses = [], []
    for name, scenario, seed in fleets:
        figures = []
        for power in POWERS:
            search, alone, seconds = plan_in_order(scenario, power, seed)
            figures.append(f"{search.cost / alone.sum():.2f} ({seconds:.1f} s)")
            if power == 0 and seed in (1, SEEDS[0]):
                losses += list_losses(name, scenario, search, alone)
        orders.append((name, str(seed), *figures))
        print(orders[-1], file=sys.stderr)  # noqa: T201
    print(table(("floor", "seed", *map(str, POWERS)), orders))  # noqa: T201
    print(table(("floor", "ticks an edge", "ratio", *PARTS), losses))  # noqa: T201


if __name__ == "__main__":
    main()
