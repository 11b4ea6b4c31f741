"""What `inspect`, `bound` and `collisions` take for fleets of thousands of robots.

``python -m benchmarks.large_fleets MAP [ROBOTS]`` draws robots at random cells of a MovingAI map,
20 000 by default, with speeds 1, 1/2, 1/3 and 1/5 in turn and one way trips: as points, and as
discs of radius 0.45. Each command runs in a process of its own.
"""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.common import table

ROBOTS, SPEEDS, RADIUS, SEED = 20_000, ("1", "1/2", "1/3", "1/5"), "0.45", 1
COMMANDS = (["inspect"], ["bound"], ["collisions", "--time-limit", "inf"])


def draw_robots(cells: Path, count: int) -> list[dict[str, Any]]:
    """Return robots with homes and targets of their own at free cells of a map."""
    draw = random.Random(SEED)  # noqa: S311 (no secret depends on it)
    rows = cells.read_text(encoding="utf-8").splitlines()[4:]
    free = [
        [row, column]
        for row, line in enumerate(rows)
        for column, cell in enumerate(line)
        if cell in ".G"
    ]
    trips = zip(draw.sample(free, count), draw.sample(free, count), strict=True)
    return [
        {"name": f"R{k}", "home": home, "target": target, "speed": SPEEDS[k % len(SPEEDS)]}
        for k, (home, target) in enumerate(trips)
    ]


def measure_command(words: list[str]) -> tuple[float, float]:
    """Return the CPU time of a command [s], and its peak memory [GB]."""
    process = subprocess.Popen(
        [sys.executable, "-m", "rightofway", *words], stdout=subprocess.DEVNULL
    )
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, words
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e6


def list_rows(cells: Path, count: int, folder: Path) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the table: a fleet, a command, its time and its memory."""
    robots = draw_robots(cells, count)
    for fleet, own in (("points", {}), (f"discs of radius {RADIUS}", {"radius": RADIUS})):
        path = folder / "fleet.json"
        document = {
            "format": "rightofway-scenario/1",
            "map": {"file": str(cells.resolve())},
            "robots": [robot | own for robot in robots],
            "rules": {"return": "none"},
        }
        path.write_text(json.dumps(document), encoding="utf-8")
        for words in COMMANDS:
            seconds, memory = measure_command([*words, str(path)])
            yield fleet, words[0], f"{seconds:.1f}", f"{memory:.2f}"


def main() -> None:
    """Print the table."""
    count = int(sys.argv[2]) if len(sys.argv) > 2 else ROBOTS
    with tempfile.TemporaryDirectory() as folder:
        rows = list(list_rows(Path(sys.argv[1]), count, Path(folder)))
    print(table(("fleet", "command", "CPU [s]", "peak memory [GB]"), rows))  # noqa: T201


if __name__ == "__main__":
    main()
