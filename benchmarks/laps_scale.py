"""A thousand robots that repeat their work: in rooms of a few, and all on one floor.

``python -m benchmarks.laps_scale`` prints what becomes of each fleet in ten seconds.
"""

from __future__ import annotations

import random
import time
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction

from rightofway.cyclic import run_laps
from rightofway.model import Robot, Scenario, Stop, VertexId, roadmap_of_grid

ROBOTS = 1000
ROOM = 8
ROOMS_IN_A_ROW = 25


def in_rooms(each: int) -> Scenario:
    """Return rooms of 8 x 8 cells with so many robots in each, of equal speed, work 0 to 5."""
    rooms = ROBOTS // each
    width, height = (ROOM + 1) * ROOMS_IN_A_ROW, (ROOM + 1) * -(-rooms // ROOMS_IN_A_ROW)
    grid = [
        "".join("@" if ROOM in (x % (ROOM + 1), y % (ROOM + 1)) else "." for x in range(width))
        for y in range(height)
    ]
    draw, cells = random.Random(0), list[VertexId]()  # noqa: S311 (no secret depends on it)
    roadmap = roadmap_of_grid(grid)
    for room in range(rooms):
        down, right = ((ROOM + 1) * part for part in divmod(room, ROOMS_IN_A_ROW))
        for cell in draw.sample(range(ROOM * ROOM), 2 * each):
            y, x = divmod(cell, ROOM)
            cells.append(roadmap.vertex(f"N{(down + y) * width + right + x}"))
    return Scenario(roadmap=roadmap, robots=tuple(_robots(cells, draw)))


def on_one_floor(size: int) -> Scenario:
    """Return all robots on one open square floor, of equal speed, work 0 to 5."""
    draw = random.Random(0)  # noqa: S311 (no secret depends on it)
    cells = [VertexId(cell) for cell in draw.sample(range(size * size), 2 * ROBOTS)]
    return Scenario(
        roadmap=roadmap_of_grid(["." * size] * size), robots=tuple(_robots(cells, draw))
    )


def _robots(cells: list[VertexId], draw: random.Random) -> Iterator[Robot]:
    for number, (home, work) in enumerate(zip(cells[::2], cells[1::2], strict=True)):
        stop = Stop(at=work, work=Fraction(draw.randint(0, 5)))
        yield Robot(name=f"R{number + 1}", home=home, stops=(stop,))


def main() -> None:
    """Print a line for each fleet."""
    fleets = {
        "250 rooms of 4": in_rooms(4),
        "125 rooms of 8": in_rooms(8),
        "one floor, 200 x 200": on_one_floor(200),
        "one floor, 100 x 100": on_one_floor(100),
    }
    for name, scenario in fleets.items():
        began = time.perf_counter()
        run = run_laps(scenario, time_limit=10)
        seconds = time.perf_counter() - began
        ends = Counter[str]()
        for group in run.groups:
            ends[group.ends] += len(group.robots)
        laps = sum(sum(group.laps_made()) for group in run.groups) / ROBOTS
        hour = float(3600 * run.throughput())
        told = ", ".join(f"{number} robots {end}" for end, number in sorted(ends.items()))
        print(f"{name}: {seconds:.1f} s: {told}; {laps:.1f} laps each, {hour:.0f} in 3600")  # noqa: T201


if __name__ == "__main__":
    main()
