"""What robots with a size cost: whole lanes or pieces, and against points on the same trips.

``python -m benchmarks.sizes`` alone draws random geometric graphs of 10^3 to 10^5 lanes, on which
most lanes cross others, and plans discs on them with whole lanes and with pieces. *Ratio* is
flowtime / every robot alone; discs that move in exact time lose something, too, so what booking
space costs is at most the ratio less 1. *Rows* are the lists of excluded rows that were found, of
all there are.

``python -m benchmarks.sizes rules`` plans on such graphs with other rules for pieces, each by 1000
neighbourhoods, without a clock: the figures of `docs/space.md`.

``python -m benchmarks.sizes ccbs FOLDER [ROBOTS ...]`` plans tasks of Continuous-CBS (Andreychuk et
al., 2019), whose roadmaps are at github.com/PathPlanning/Continuous-CBS: a folder with map.xml and
1_task.xml.

``python -m benchmarks.sizes FOLDER [SCENARIO ...]`` wants a folder of the MovingAI benchmark, with
``maps`` and ``scens`` in it. SCENARIO is a file with a real layout, as ``rightofway convert``
writes it; its robots are replaced by a fleet of three sizes. Times are CPU seconds of one thread,
medians of runs that take turns; only the first plan and the ratio on a layout are those of the
default planner, by the clock on the wall.
"""

from __future__ import annotations

import gc
import random
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from math import nan
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

import numpy as np

import rightofway
from benchmarks.common import SEEDS, movingai_fleet, table
from rightofway.io import parse_scenario
from rightofway.io.layouts.xml_tree import parse_xml
from rightofway.metrics import measure
from rightofway.model import Robot, Scenario, Stop
from rightofway.model.problem import bind_problem
from rightofway.native import bind_lists
from rightofway.search import FleetSearch, plan_by_lacam
from rightofway.site import VertexId
from rightofway.site import spacing as spacings

MAP, ROBOTS, RADIUS = "warehouse-10-20-10-2-1", 1000, Fraction("0.45")
RUNS, NEIGHBOURHOODS, EFFORT = 3, 1000, 10**12

LAYOUT_ROBOTS, SECONDS = (100, 200), 10
RADII = [Fraction(2, 10), Fraction(3, 10), Fraction(4, 10)]
SPEEDS = [Fraction(1), Fraction(3, 2), Fraction(1, 2)]

Times = dict[str, float]


def seconds(work: Callable[[], Any]) -> tuple[float, Any]:
    """Return the CPU time of some work, and its result."""
    began = time.process_time()
    found = work()
    return time.process_time() - began, found


def by_lacam(scenario: Scenario) -> None:
    """Plan by the native search of `lacam`."""
    assert plan_by_lacam(scenario.problem, most_effort=EFFORT) is not None


def in_turn(scenario: Scenario) -> FleetSearch:
    """Return the search with a plan of robots one after another, shortest trips first."""
    search = FleetSearch(scenario.problem, threads=1)
    order = np.argsort(search.compute_alone(), kind="stable").tolist()
    assert search.prioritize(order, searches=30 * len(order), time_limit=None)
    return search


def times_of(scenario: Scenario) -> Times:
    """Return how long each part of planning takes [s]."""
    roadmap, robots, rules = scenario.roadmap, scenario.robots, scenario.rules
    found: Times = {}
    found["problem in ticks"], _ = seconds(lambda: bind_problem(roadmap, robots, rules))
    found["LaCAM"], _ = seconds(lambda: by_lacam(scenario))
    found["one after another"], search = seconds(lambda: in_turn(scenario))
    found[f"{NEIGHBOURHOODS} neighbourhoods of LNS"], _ = seconds(
        lambda: search.improve(NEIGHBOURHOODS, patience=10**9)
    )
    plan = rightofway.solve(scenario, "lacam", time_limit=None)
    found["judge"], _ = seconds(lambda: rightofway.check(plan))
    return found


def cost_of_sizes(folder: Path) -> str:
    """Return the table: points, robots with a radius, and how much longer these take."""
    whole = movingai_fleet(folder, MAP, ROBOTS, 1)
    points = replace(whole, rules=replace(whole.rules, occupancy="both"))
    sized = replace(points, robots=tuple(replace(one, radius=RADIUS) for one in whole.robots))
    runs = [(times_of(points), times_of(sized)) for _ in range(RUNS)]
    lines = []
    for name in runs[0][0]:
        before, after = (median(run[column][name] for run in runs) for column in (0, 1))
        lines.append((name, f"{before:.2f}", f"{after:.2f}", f"{after / before:.2f}"))
    return table(("work", "points [s]", "radius 0.45 [s]", "ratio"), lines)


def fleet_on(layout: Scenario, robots: int, seed: int) -> Scenario:
    """Return robots of three sizes at random places of a layout, apart at start and end."""
    draw, roadmap = random.Random(seed), layout.roadmap  # noqa: S311 (no secret depends on it)
    radii = [RADII[k % len(RADII)] for k in range(robots)]
    middle = roadmap.n_vertices // 2
    inside = _reached(roadmap.indptr, roadmap.heads, middle)

    def places() -> list[VertexId]:
        taken: list[int] = []
        for vertex in draw.sample(inside, len(inside)):
            there = roadmap.positions[vertex]
            apart = np.hypot(*(roadmap.positions[taken] - there).T)
            needed = [float(radii[k] + radii[len(taken) % robots]) for k in range(len(taken))]
            if len(taken) < robots and (apart > needed).all():
                taken.append(vertex)
        assert len(taken) == robots, "the layout is too small"
        return [VertexId(vertex) for vertex in taken]

    trips = zip(places(), places(), strict=True)
    return replace(
        layout,
        robots=tuple(
            Robot(
                name=f"R{k}",
                home=home,
                stops=(Stop(at=target),),
                speed=SPEEDS[k // len(RADII) % len(SPEEDS)],
                radius=radii[k],
            )
            for k, (home, target) in enumerate(trips)
        ),
        rules=replace(layout.rules, occupancy=None, ends="none"),
        clock=None,
    )


def _reached(indptr: Any, heads: Any, start: int) -> list[int]:
    """Return the vertices that a robot can reach and come back from, where lanes lead both ways."""
    seen, waiting = {start}, [start]
    while waiting:
        vertex = waiting.pop()
        new = set(heads[indptr[vertex] : indptr[vertex + 1]].tolist()) - seen
        seen |= new
        waiting += new
    return sorted(seen)


def on_a_layout(path: Path) -> str:
    """Return the table of a real layout: first plan of `auto`, and flowtime / lower bound."""
    layout, lines = rightofway.load(path), []
    for robots in LAYOUT_ROBOTS:
        found = []
        for seed in SEEDS:
            plan = rightofway.solve(fleet_on(layout, robots, seed), time_limit=SECONDS)
            metrics = measure(plan)
            first = plan.run.first_plan_seconds
            assert first is not None
            found.append((first, metrics.flowtime / metrics.lower_bound))
        first, ratio = map(median, zip(*found, strict=True))
        lines.append((str(layout.roadmap.n_vertices), str(robots), f"{first:.2f}", f"{ratio:.3f}"))
    return table(("vertices", "robots", "first plan [s]", f"ratio after {SECONDS} s"), lines)


@dataclass(frozen=True, slots=True)
class Graph:
    """A random geometric graph: vertices anywhere, a lane between all that are near."""

    vertices: int
    degree: float  # lanes at a vertex
    lane: float  # length of a lane in distances of two robots, in the mean
    robots: int
    radius: str = "1/2"


GRAPH_SEEDS = (1, 2)
GRAPHS = (
    Graph(250, 8, 15, 20),
    Graph(500, 16, 15, 20),
    Graph(500, 16, 15, 40),
    Graph(500, 10, 7, 40),
    Graph(500, 16, 4, 40),
    Graph(2000, 16, 15, 40),
    Graph(5000, 20, 8, 40),
)


def document_of(graph: Graph, seed: int, spacing: str) -> dict[str, Any]:
    """Return a scenario of discs on a random geometric graph."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    least = 2 * float(Fraction(graph.radius))  # distance of two robots
    reach = 1.5 * graph.lane * least  # the mean distance of points in a disc is 2/3 of its radius
    side = reach * (graph.vertices * np.pi / graph.degree) ** 0.5
    at = np.array([[draw.uniform(0, side) for _ in "xy"] for _ in range(graph.vertices)]).round(4)
    lanes = [
        (one, int(other))
        for one in range(graph.vertices)
        for other in one + 1 + np.flatnonzero(np.hypot(*(at[one + 1 :] - at[one]).T) < reach)
    ]
    joined: dict[int, list[int]] = {}
    for one, other in lanes:
        joined.setdefault(one, []).append(other)
        joined.setdefault(other, []).append(one)
    inside = _largest_part(joined)

    def places() -> list[int]:
        taken: list[int] = []
        for vertex in draw.sample(inside, len(inside)):
            if (np.hypot(*(at[taken] - at[vertex]).T) > least).all():
                taken.append(vertex)
            if len(taken) == graph.robots:
                return taken
        raise ValueError("the graph is too small")

    return {
        "format": "rightofway-scenario/1",
        "map": {
            "roadmap": {
                "vertices": {f"v{k}": point for k, point in enumerate(at.tolist())},
                "edges": [[f"v{one}", f"v{other}"] for one, other in lanes],
            },
            "spacing": spacing,
        },
        "robots": [
            {"name": f"R{k}", "home": f"v{home}", "target": f"v{target}", "radius": graph.radius}
            for k, (home, target) in enumerate(zip(places(), places(), strict=True))
        ],
        "rules": {"return": "none"},
    }


def _largest_part(joined: dict[int, list[int]]) -> list[int]:
    left, largest = set(joined), list[int]()
    while left:
        part, waiting = set[int](), [left.pop()]
        while waiting:
            vertex = waiting.pop()
            part.add(vertex)
            new = left & set(joined[vertex])
            left -= new
            waiting += new
        largest = max(largest, sorted(part), key=len)
    return largest


def on_random_graphs() -> str:
    """Return the table of whole lanes and pieces on random geometric graphs."""
    lines = []
    for graph in GRAPHS:
        for spacing in ("whole", "auto"):
            rows = [_on_random_graph(document_of(graph, seed, spacing)) for seed in GRAPH_SEEDS]
            lanes, edges, reading, first, ratio, found = map(median, zip(*rows, strict=True))
            lines.append((
                f"{lanes:.0f}", f"{graph.lane:g}", str(graph.robots), spacing, f"{edges:.0f}",
                f"{reading:.1f}", f"{first:.2f}", f"{ratio:.4f}", f"{found:.1%}",
            ))  # fmt: skip
    heads = ("lanes", "long [D]", "robots", "spacing", "edges", "reading [s]", "first plan [s]",
             f"ratio after {SECONDS} s", "rows")  # fmt: skip
    return table(heads, lines)


def _on_random_graph(document: dict[str, Any]) -> tuple[float, ...]:
    reading, scenario = seconds(lambda: parse_scenario(document))
    lanes, edges = 2 * len(document["map"]["roadmap"]["edges"]), scenario.roadmap.n_edges
    try:
        plan = rightofway.solve(scenario, time_limit=SECONDS)
    except rightofway.GaveUp:
        return lanes, edges, reading, nan, nan, nan
    metrics = measure(plan)
    lists = bind_lists(scenario.problem.resources)
    first = plan.run.first_plan_seconds
    assert lists is not None, "discs have a size"
    assert first is not None, "there is a plan"
    return (
        lanes,
        edges,
        reading,
        first,
        metrics.flowtime / metrics.lower_bound,
        lists.n_found / lists.n_rows,
    )


RULES: dict[str, tuple[str, int, int]] = {
    "whole": ("whole", 3, 8),
    "auto: 3 D, at most 8": ("auto", 3, 8),
    "2 D": ("auto", 2, 8),
    "4 D": ("auto", 4, 8),
    "at most 4": ("auto", 3, 4),
}
"""Spacing, length of pieces in least distances of two robots, and pieces of a lane at most."""

RULE_GRAPHS = (GRAPHS[0], *GRAPHS[2:5])
RULE_SEEDS = (1, 2, 3)


def by_rules() -> str:
    """Return the table of other rules for pieces: the median flowtime / that of robots alone."""
    lines = []
    for graph in RULE_GRAPHS:
        ratios, lanes = list[str](), 0
        for spacing, distances, most in RULES.values():
            with (
                patch.object(spacings, "PIECE_IN_DISTANCES", distances),
                patch.object(spacings, "MOST_PIECES", most),
            ):
                documents = [document_of(graph, seed, spacing) for seed in RULE_SEEDS]
                lanes = int(median(2 * len(one["map"]["roadmap"]["edges"]) for one in documents))
                ratios.append(f"{median(map(_ratio, documents)):.4f}")
        lines.append((str(lanes), f"{graph.lane:g}", str(graph.robots), *ratios))
    return table(("lanes", "long [D]", "robots", *RULES), lines)


def _ratio(document: dict[str, Any]) -> float:
    plan = rightofway.solve(
        parse_scenario(document), "lns", time_limit=None, iterations=NEIGHBOURHOODS
    )
    metrics = measure(plan)
    return metrics.flowtime / metrics.lower_bound


CCBS_ROBOTS, CCBS_TASKS, CCBS_RADIUS = (20, 40), (1, 2), 0.354


def on_a_public_roadmap(folder: Path, counts: Sequence[int]) -> str:
    """Return the table of tasks of Continuous-CBS, its discs at speed 1, by the default planner."""
    lines = []
    for robots in counts:
        for task in CCBS_TASKS:
            text = (folder / f"{task}_task.xml").read_text(encoding="utf-8")
            agents = [agent.value for agent in parse_xml(text).list_descendants("agent")]
            document = {
                "format": "rightofway-scenario/1",
                "map": {"layout": "map.xml"},
                "robots": [
                    {"name": f"R{k}", "radius": CCBS_RADIUS,
                     "home": f"n{agent['start_id']}", "target": f"n{agent['goal_id']}"}
                    for k, agent in enumerate(agents[:robots])
                ],
                "rules": {"return": "none"},
            }  # fmt: skip
            reading, scenario = seconds(partial(parse_scenario, document, folder))
            plan = rightofway.solve(scenario, time_limit=SECONDS)
            metrics = measure(plan)
            first = plan.run.first_plan_seconds
            assert first is not None, "there is a plan"
            lines.append((
                str(robots), str(task), str(scenario.roadmap.n_edges), f"{reading:.1f}",
                f"{first:.1f}", f"{metrics.flowtime / metrics.lower_bound:.4f}",
            ))  # fmt: skip
    heads = ("robots", "task", "edges", "reading [s]", "first plan [s]", f"ratio after {SECONDS} s")
    return table(heads, lines)


def main() -> None:
    """Print the tables."""
    gc.set_threshold(50_000, *gc.get_threshold()[1:])  # as commands do
    if len(sys.argv) == 1:
        print(on_random_graphs())  # noqa: T201
        return
    if sys.argv[1:] == ["rules"]:
        print(by_rules())  # noqa: T201
        return
    if sys.argv[1] == "ccbs":
        counts = [int(count) for count in sys.argv[3:]] or CCBS_ROBOTS
        print(on_a_public_roadmap(Path(sys.argv[2]), counts))  # noqa: T201
        return
    print(cost_of_sizes(Path(sys.argv[1])))  # noqa: T201
    for path in sys.argv[2:]:
        print(on_a_layout(Path(path)))  # noqa: T201


if __name__ == "__main__":
    main()
