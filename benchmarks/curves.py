"""Quality of plans by the time limit: the curve must fall without a cliff.

``python -m benchmarks.curves FOLDER [LIMIT ...]`` wants a folder of the MovingAI benchmark. Figures
are flowtime / flowtime of the robots alone. Besides public fleets it plans fleets with homes and
targets drawn at random. It lists each plan that is worse than one of a shorter limit by more than
`SLACK`, which is the noise of runs that the clock ends; then the exit code is 1.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np

import rightofway
from benchmarks.common import movingai_fleet, table
from rightofway.model import Robot, Scenario, Stop

LIMITS = (1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 15.0, 20.0)
SLACK = 0.01
PUBLIC = (("warehouse-10-20-10-2-1", 1000), ("random-64-64-10", 1000), ("random-32-32-20", 400))
DRAWN = (("warehouse-10-20-10-2-1", 700), ("room-64-64-16", 500), ("den312d", 400))


def draw_fleet(folder: Path, name: str, robots: int) -> Scenario:
    """Return a fleet of two speeds on a public map, with homes and targets drawn at random."""
    public = movingai_fleet(folder, name, 1, 1)
    draw = np.random.default_rng(robots)
    ends = [draw.permutation(public.roadmap.n_vertices)[:robots].tolist() for _ in range(2)]
    fleet = tuple(
        Robot(name=f"R{k}", home=home, stops=(Stop(at=target),), speed=Fraction(1, 1 + k % 2))
        for k, (home, target) in enumerate(zip(*ends, strict=True), 1)
    )
    return replace(public, robots=fleet, rules=replace(public.rules, occupancy="both"))


def main() -> int:
    """Print the curve of each fleet."""
    folder = Path(sys.argv[1])
    limits = [float(limit) for limit in sys.argv[2:]] or list(LIMITS)
    fleets = {
        **{f"{name}, {robots}": movingai_fleet(folder, name, robots, 1) for name, robots in PUBLIC},
        **{f"{name}, {robots} drawn": draw_fleet(folder, name, robots) for name, robots in DRAWN},
    }
    rows, rises = [], []
    for name, scenario in fleets.items():
        ratios = []
        for limit in limits:
            plan = rightofway.solve(scenario, time_limit=limit)
            ratios.append(plan.flowtime / sum(plan.run.alone or ()))
        rises += [
            f"{name}: {worse:.3f} at {limits[k]:g} s, {min(ratios[:k]):.3f} before"
            for k, worse in enumerate(ratios)
            if k and worse > (1 + SLACK) * min(ratios[:k])
        ]
        rows.append((name, *(f"{ratio:.3f}" for ratio in ratios)))
    print(table(("fleet", *(f"{limit:g} s" for limit in limits)), rows))  # noqa: T201
    for rise in rises:
        print("rises:", rise)  # noqa: T201
    return int(bool(rises))


if __name__ == "__main__":
    sys.exit(main())
