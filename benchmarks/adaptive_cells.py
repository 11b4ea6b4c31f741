"""What adaptive cells save on a real map, and what they cost in quality.

`python -m benchmarks.adaptive_cells` plans random fleets on the warehouse map of Nav2, cut into
cells of one size and into squares of a quadtree, and writes the table and the picture of
`docs/layouts/ros-map.md`. Flowtimes do not depend on the machine; seconds do.
"""

from __future__ import annotations

import random
import time
from collections import deque
from collections.abc import Mapping, Sequence
from fractions import Fraction
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import PercentFormatter

import rightofway
from benchmarks.common import DOCS, IMAGES, plain_axes, save_figure, table, write_tables
from rightofway.io import parse_scenario
from rightofway.metrics import measure
from rightofway.model import Scenario
from rightofway.site import Roadmap
from rightofway.site.places import Spot, find_vertex_at

MAPS = DOCS.parent / "examples" / "maps"
PAGE = DOCS / "layouts" / "ros-map.md"

RADIUS, CELL = Fraction("0.12"), Fraction("0.25")
"""Of the robots, and the side of the smallest cells [m]."""

START = (Fraction(1), Fraction(1))
"""A point of the part of the map that robots work in."""

ROBOTS, SEEDS = (10, 20, 50, 100, 150, 200), range(5)

CUTS: Mapping[str, Mapping[str, Any]] = {
    "cells of 0.25 m": {"cell_size": str(CELL)},
    "squares to 0.5 m": {"cell_size": "adaptive", "smallest": str(CELL), "largest": "0.5"},
    "squares to 1 m": {"cell_size": "adaptive", "smallest": str(CELL), "largest": 1},
    "squares to 2 m": {"cell_size": "adaptive", "smallest": str(CELL), "largest": 2},
}
FINE, *COARSER = CUTS
COLOURS = dict(zip(CUTS, ("#d55e00", "#8a8a8a", "#56b4e9", "#0b4f8a"), strict=True))

Ends = Sequence[tuple[Spot, Spot]]


class Case(NamedTuple):
    """The outcome for one fleet on one cut of the map; times in seconds."""

    cut: str
    robots: int
    vertices: int
    planning: float
    flowtime: float


def scenario(cut: str, ends: Ends) -> Scenario:
    """Return a fleet with these homes and targets on a cut of the map."""
    robots = [
        {
            "name": f"R{number}",
            "home": {"x": str(home.x), "y": str(home.y)},
            "target": {"x": str(target.x), "y": str(target.y)},
            "work": 5,
            "radius": str(RADIUS),
        }
        for number, (home, target) in enumerate(ends, start=1)
    ]
    document = {
        "format": "rightofway-scenario/1",
        "map": {"layout": "nav2-warehouse.yaml", **CUTS[cut]},
        "robots": robots,
        "rules": {"turn": 0},
    }
    return parse_scenario(document, MAPS)


def points() -> tuple[list[Spot], Roadmap]:
    """Return the middles of the fine cells that robots reach, and the coarsest roadmap."""
    start = Spot(*START)
    fine = scenario(FINE, [(start, start)])
    roadmap, home = fine.roadmap, int(fine.robots[0].home)
    reached, ahead = {home}, deque([home])
    while ahead:
        vertex = ahead.popleft()
        heads = roadmap.heads[roadmap.indptr[vertex] : roadmap.indptr[vertex + 1]].tolist()
        ahead.extend(head for head in heads if head not in reached)
        reached.update(heads)
    return [Spot(*roadmap.get_point(each)) for each in sorted(reached)], scenario(
        COARSER[-1], [(start, start)]
    ).roadmap


def fleet(spots: Sequence[Spot], coarse: Roadmap, robots: int, seed: int) -> Ends:
    """Return homes and targets, no two of them in one square of the coarsest roadmap."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    taken: dict[int, Spot] = {}
    for spot in draw.sample(spots, len(spots)):
        taken.setdefault(find_vertex_at(coarse, spot), spot)
        if len(taken) == 2 * robots:
            break
    chosen = list(taken.values())
    return list(zip(chosen[::2], chosen[1::2], strict=True))


def measured() -> list[Case]:
    """Plan every fleet on every cut."""
    spots, coarse = points()
    cases = []
    for robots in ROBOTS:
        for seed in SEEDS:
            ends = fleet(spots, coarse, robots, seed)
            for cut in CUTS:
                made = scenario(cut, ends)
                assert made.problem  # bound once, and no part of planning
                begin = time.perf_counter()
                plan = rightofway.solve(made, "prioritized", time_limit=None)
                seconds = time.perf_counter() - begin
                flowtime = float(measure(plan).flowtime * made.problem.clock.tick)
                cases.append(Case(cut, robots, made.roadmap.n_vertices, seconds, flowtime))
    return cases


def of(cases: Sequence[Case], cut: str, robots: int) -> list[Case]:
    """Return the cases of a cut and a number of robots, by seed."""
    return [case for case in cases if (case.cut, case.robots) == (cut, robots)]


def changes(cases: Sequence[Case], cut: str, robots: int) -> list[float]:
    """Return by which share the flowtime of each fleet is above that on fine cells."""
    pairs = zip(of(cases, cut, robots), of(cases, FINE, robots), strict=True)
    return [mine.flowtime / fine.flowtime - 1 for mine, fine in pairs]


def savings(cases: Sequence[Case]) -> str:
    """Return a line for each cut: vertices, seconds of planning, flowtime against fine cells."""
    few, many = ROBOTS[1], ROBOTS[-1]
    lines = []
    for cut in CUTS:
        seconds = [median(case.planning for case in of(cases, cut, n)) for n in (few, many)]
        change = [median(changes(cases, cut, n)) for n in (few, many)]
        lines.append(
            (
                cut,
                str(of(cases, cut, few)[0].vertices),
                *(f"{each:.2f} s" for each in seconds),
                *("" if cut == FINE else f"{each:+.1%}" for each in change),
            )
        )
    heads = (
        "map",
        "vertices",
        f"planning, {few} robots",
        f"{many} robots",
        f"flowtime, {few} robots",
        f"{many} robots",
    )
    return table(heads, lines)


def draw_squares(axes: Axes) -> None:
    """Draw the squares over the map."""
    start = Spot(*START)
    roadmap = scenario(COARSER[-1], [(start, start)]).roadmap
    x, y = (roadmap.positions * (1, -1)).T
    low = np.column_stack((x, y)) - roadmap.drawn_sides[:, None] / 2
    squares = [
        Rectangle((left, bottom), side, side)
        for (left, bottom), side in zip(low.tolist(), roadmap.drawn_sides.tolist(), strict=True)
    ]
    axes.add_collection(
        PatchCollection(squares, facecolor="white", edgecolor="#7a8794", linewidth=0.25)
    )
    axes.set_facecolor("#cfccc4")
    axes.set(xlim=(-15.1, 15.1), ylim=(-25, 25.2), aspect="equal", xlabel="x [m]", ylabel="y [m]")
    axes.set_title(f"{len(squares)} squares of 0.25 to 2 m", loc="left", fontsize=10)


def draw_costs(axes: Axes, cases: Sequence[Case]) -> None:
    """Draw the flowtime above that on fine cells, by the number of robots."""
    for cut in COARSER:
        found = np.array([changes(cases, cut, robots) for robots in ROBOTS])
        middle = np.median(found, axis=1)
        axes.plot(ROBOTS, middle, "o-", color=COLOURS[cut], markersize=4, label=cut)
        ends = found.min(axis=1), found.max(axis=1)
        axes.fill_between(ROBOTS, *ends, color=COLOURS[cut], alpha=0.2, linewidth=0)
    axes.axhline(0, color="#444444", linewidth=1)
    axes.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    axes.set(xlabel="robots")
    axes.set_title("flowtime against cells of 0.25 m", loc="left", fontsize=10)
    axes.legend(frameon=False, fontsize=8, loc="upper left")
    plain_axes(axes)


def draw_seconds(axes: Axes, cases: Sequence[Case]) -> None:
    """Draw the seconds of planning, by the number of robots."""
    for cut in CUTS:
        middle = [median(case.planning for case in of(cases, cut, robots)) for robots in ROBOTS]
        axes.plot(ROBOTS, middle, "o-", color=COLOURS[cut], markersize=4, label=cut)
    axes.set(xlabel="robots", ylim=(0, None))
    axes.set_title("seconds of planning", loc="left", fontsize=10)
    axes.legend(frameon=False, fontsize=8, loc="upper left")
    plain_axes(axes)


def plot(cases: Sequence[Case]) -> Figure:
    """Return the picture of the page."""
    figure = Figure(figsize=(9, 6), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1, 1.1))
    draw_squares(figure.add_subplot(grid[:, 0]))
    draw_costs(figure.add_subplot(grid[0, 1]), cases)
    draw_seconds(figure.add_subplot(grid[1, 1]), cases)
    return figure


def main() -> None:
    """Measure, and write what was measured."""
    cases = measured()
    save_figure(plot(cases), IMAGES / "adaptive-cells.png")
    write_tables(PAGE, "adaptive cells", {"savings": savings(cases)})


if __name__ == "__main__":
    main()
