"""How long ``rightofway plan`` takes as a whole process, and how late after its time limit it ends.

``python -m benchmarks.limits FOLDER [CASE ...]`` wants a folder of the MovingAI benchmark with
``maps`` in it. Each case draws its robots itself, with a fixed seed, since the files of the
benchmark hold at most 1000: homes and targets are distinct cells of the largest open area.
*Late* is what the process takes beyond its limit; at most 0.5 s and 5 % of the limit is allowed.
"""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

GRACE, SHARE = 0.5, 0.05
"""Allowed lateness: seconds, and part of the limit."""


@dataclass(frozen=True, slots=True)
class Case:
    """A fleet on a map, the arguments of ``plan``, and its time limit [s]."""

    map: str
    robots: int
    limit: float
    arguments: tuple[str, ...] = ()


CASES = (
    Case("Berlin_1_256", 500, 5),
    Case("Berlin_1_256", 2000, 10),
    Case("Berlin_1_256", 2000, 60, ("--planner", "lacam")),
    Case("orz900d", 2000, 60, ("--planner", "lacam")),
    Case("orz900d", 5000, 10),
    Case("orz900d", 5000, 30),
    Case("warehouse-20-40-10-2-2", 10000, 10),
)


def largest_area(rows: list[str]) -> np.ndarray:
    """Return (row, column) of each cell of the largest connected area of a map."""
    free = {(i, j) for i, row in enumerate(rows) for j, cell in enumerate(row) if cell in ".GS"}
    largest: list[tuple[int, int]] = []
    while free:
        area = [free.pop()]
        for row, column in area:
            for cell in (
                (row - 1, column),
                (row + 1, column),
                (row, column - 1),
                (row, column + 1),
            ):
                if cell in free:
                    free.remove(cell)
                    area.append(cell)
        largest = max(largest, area, key=len)
    return np.array(sorted(largest))


def scen_text(map_file: Path, robots: int, seed: int = 1) -> str:
    """Return a .scen file of robots drawn at random."""
    rows = map_file.read_text().split("map\n", 1)[1].split()
    cells, size = largest_area(rows), f"{len(rows[0])}\t{len(rows)}"
    draw = np.random.default_rng(seed)
    homes, targets = (cells[draw.permutation(len(cells))[:robots]] for _ in range(2))
    lines = ["version 1"]
    for home, target in zip(homes.tolist(), targets.tolist(), strict=True):
        lines.append(
            f"0\t{map_file.name}\t{size}\t{home[1]}\t{home[0]}\t{target[1]}\t{target[0]}\t0"
        )
    return "\n".join(lines) + "\n"


def run(case: Case, maps: Path, folder: Path) -> str:
    """Plan a case as a process of its own; return its row."""
    map_file = shutil.copy(maps / f"{case.map}.map", folder)
    scen, plan = folder / f"{case.map}-{case.robots}.scen", folder / "plan.json"
    scen.write_text(scen_text(Path(map_file), case.robots))
    command = [
        *(sys.executable, "-m", "rightofway", "plan", str(scen), "-o", str(plan)),
        *("--time-limit", f"{case.limit:g}", *case.arguments),
    ]
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    ended = subprocess.run(command, check=False, capture_output=True, text=True)
    seconds, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    late = seconds - case.limit
    verdict = "ok" if late <= GRACE + SHARE * case.limit else "LATE"
    arguments = " ".join(case.arguments) or "auto"
    return (
        f"| {case.map} | {case.robots} | {arguments} | {case.limit:g} | {busy:.2f} |"
        f" {seconds:.2f} | {late:+.2f} {verdict} | {ended.returncode} |"
    )


def rows(maps: Path, wanted: list[str]) -> Iterator[str]:
    """Yield the table; only cases whose map or number of robots is wanted, if any are named."""
    yield "| map | robots | planner | limit [s] | processor [s] | process [s] | late [s] | exit |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            if not wanted or {case.map, str(case.robots)} & set(wanted):
                yield run(case, maps, Path(folder))


def main() -> None:
    """Print the table."""
    for line in rows(Path(sys.argv[1]).resolve() / "maps", sys.argv[2:]):
        print(line, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
