"""Gain of each option of `cbs`, on drawn fleets of many kinds.

``python -m benchmarks.switches [--write]`` prints two tables of `docs/results/choices.md`, or
writes them there: the nodes until the proof with one option changed at a time, and the optima
that are proven within some processor seconds on each kind of fleet. The tree alone is measured,
without a first plan. Nodes are the same on every machine.
"""

from __future__ import annotations

import argparse
import random
import time
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any, NamedTuple

from benchmarks.common import DOCS, table, write_tables
from benchmarks.proofs import deal, fleet
from rightofway.model import Rules, Scenario
from rightofway.search import ConflictBasedSearch
from tests.builders.fleets import fleet_on, random_fleet
from tests.builders.tiny import KINDS as TINY

PAGE = DOCS / "results" / "choices.md"

NODES_PER_RUN = 50
"""Nodes from one look at the processor's time to the next."""


class Family(NamedTuple):
    """A kind of fleets, drawn by seed, and how many of them are drawn."""

    name: str
    draw: Callable[[int], Scenario]
    fleets: int

    def draw_all(self) -> list[Scenario]:
        """Return the fleets of the seeds from 1 on."""
        return [self.draw(seed) for seed in range(1, self.fleets + 1)]


def draw_rooms(side: int) -> list[str]:
    """Return rooms of 5 x 5 cells, as many in a row as in a column, with doors of one cell."""
    width = 6 * side + 1
    rows = [["@" if 0 in {row % 6, column % 6} else "." for column in range(width)]
            for row in range(width)]  # fmt: skip
    for wall in range(6, width - 1, 6):
        for middle in range(3, width, 6):
            rows[wall][middle] = rows[middle][wall] = "."
    return ["".join(row) for row in rows]


def draw_aisles(count: int, length: int) -> list[str]:
    """Return parallel aisles of one cell, and a lane of one cell across both their ends."""
    across = "." * (2 * count - 1)
    return [across, *([".@" * (count - 1) + "."] * length), across]


def trips(rows: Sequence[str], robots: int, seed: int, *, classic: bool = False) -> Scenario:
    """Return one way trips between cells of a grid, with speeds and rules as of `proofs`."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    return deal(fleet_on(rows, draw, robots=robots, work=0), classic=classic)


def round_trips(robots: int, seed: int) -> Scenario:
    """Return robots that work and come home."""
    return random_fleet(seed, size=7, robots=robots, rules=Rules(occupancy="both"))


def grids(name: str, robots: int, seed: int, *, classic: bool = False) -> Scenario:
    """Return one way trips on a drawn grid, as `proofs` has them."""
    return fleet(None, name, robots, seed, classic=classic)


SWITCHES = (
    "", "clear=no", "bypass=no", "targets=no", "disjoint=no", "pairs=yes", "joint_states=0",
    "targets=no joint_states=0", "pair_nodes=0 joint_states=0", "cardinal=any",
)  # fmt: skip

NODES_OF = (
    Family("own speeds", partial(grids, "24x20", 20), 3),
    Family("classic", partial(grids, "24x20", 30, classic=True), 3),
)
FEW = Family("few robots", TINY["three"], 20)

COLUMNS = ("", "disjoint=no", "pairs=yes", "pair_nodes=0", "targets=no")

FAMILIES = (
    Family("round trips, 7 x 7 cells, 6 robots", partial(round_trips, 6), 24),
    Family("the same, 8 robots", partial(round_trips, 8), 12),
    Family("24 x 24 cells, 20 % walls, 30 robots", partial(grids, "24x20", 30), 6),
    Family("the same, classic", partial(grids, "24x20", 30, classic=True), 6),
    Family("hall, 14 x 14 cells, 5 % walls, 24 robots", partial(grids, "14x5", 24), 6),
    Family("9 x 9 cells, 25 % walls, 10 robots", partial(grids, "9x25", 10), 6),
    Family("2 x 2 rooms, classic, 12 robots", partial(trips, draw_rooms(2), 12, classic=True), 8),
    Family("3 x 3 rooms, 12 robots", partial(trips, draw_rooms(3), 12), 6),
    Family("aisles, 6 robots", partial(trips, draw_aisles(5, 7), 6), 8),
    Family("long aisles, 4 robots", partial(trips, draw_aisles(3, 20), 4), 6),
)  # fmt: skip


class Proof(NamedTuple):
    """What a search of one fleet took."""

    is_proven: bool
    nodes: int
    seconds: float  # of the processor


def prove(scenario: Scenario, options: str, *, seconds: float, nodes: int = 2**62) -> Proof:
    """Search for the optimum of a fleet, with options as of the planner in place of its own."""
    values: dict[str, Any] = {"yes": True, "first": True, "no": False, "any": False}
    given = (option.split("=") for option in options.split())
    switches = {name: values.get(value, value) for name, value in given}
    counts = {name: int(value) for name, value in switches.items() if isinstance(value, str)}
    search = ConflictBasedSearch(scenario.problem, **{**switches, **counts})
    began = time.process_time()
    spent = 0.0
    while not search.is_proven and spent < seconds and search.n_nodes < nodes:
        most = min(NODES_PER_RUN, nodes - search.n_nodes)
        search.run(nodes=most, time_limit=seconds - spent)
        spent = time.process_time() - began
    return Proof(search.is_proven, search.n_nodes, spent)


def name_options(options: str) -> str:
    """Return options as code; none are the defaults."""
    return f"`{options}`" if options else "as they are"


def make_nodes_table(
    families: Iterable[Family] = NODES_OF, few: Family = FEW, *, seconds: float = 10.0
) -> str:
    """Return the nodes until the proof for each of `SWITCHES`, and how many of few are decided."""
    drawn, tiny = [family.draw_all() for family in families], few.draw_all()
    lines = []
    for options in SWITCHES:
        proofs = [[prove(one, options, seconds=seconds) for one in fleets] for fleets in drawn]
        nodes = [
            ", ".join(str(one.nodes) if one.is_proven else "-" for one in row) for row in proofs
        ]
        decided = sum(prove(one, options, seconds=seconds, nodes=1000).is_proven for one in tiny)
        lines.append((name_options(options), *nodes, str(decided)))
    return table(("options", *(family.name for family in families), few.name), lines)


def make_families_table(families: Iterable[Family] = FAMILIES, *, seconds: float = 0.5) -> str:
    """Return how many optima are proven, and the seconds of all fleets of a row."""
    lines = []
    for name, fleets in [(family.name, family.draw_all()) for family in families]:
        cells = []
        for options in COLUMNS:
            proofs = [prove(one, options, seconds=seconds) for one in fleets]
            proven, spent = sum(one.is_proven for one in proofs), sum(one.seconds for one in proofs)
            cells.append(f"{proven} of {len(proofs)}, {spent:.2f} s")
        lines.append((name, *cells))
    return table(("fleets, all drawn at random", *map(name_options, COLUMNS)), lines)


def main() -> None:
    """Print the tables, or put them on the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.switches")
    parser.add_argument("--write", action="store_true", help="put the tables on the page")
    given = parser.parse_args()
    tables = {"nodes": make_nodes_table(), "families": make_families_table()}
    if given.write:
        write_tables(PAGE, "switches", tables)
    print(*tables.values(), sep="\n")  # noqa: T201


if __name__ == "__main__":
    main()
