"""What a plan of a changed scenario gains by starting from the old plan.

``python -m benchmarks.warm_start`` plans three fleets, changes one thing, and plans again from the
old plan and without it. It writes a table of docs/results/fleets.md: how soon there is a
first valid plan, and how far from the lower bound the plan is after a second. Seconds are those of
the processor, of all threads, so a busy machine gives the same figures.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import rightofway
from benchmarks.common import DOCS, RESULTS, table, write_tables
from rightofway.io import parse_scenario
from rightofway.model import Closure, Plan, Robot, Scenario
from rightofway.site import VertexId

LIMIT, CUT = 10, 1.0
"""The limit for each plan [s], and the processor time after which plans are compared [s]."""

WAREHOUSE = DOCS.parent / "examples" / "maps" / "warehouse-10-20-10-2-1-random-1.scen"
SPEEDS = (Fraction(1), Fraction(1, 2), Fraction(3, 4))
COLUMNS, ROWS, LANE = 12, 9, 3
"""Size of the roadmap in crossings, and how long each lane is [length unit]."""


def warehouse(robots: int) -> Scenario:
    """Return round trips with work in the warehouse of the MovingAI benchmark."""
    whole = rightofway.load(WAREHOUSE)
    fleet = tuple(
        replace(
            robot,
            speed=SPEEDS[index % len(SPEEDS)],
            stops=tuple(replace(stop, work=Fraction(index % 20)) for stop in robot.stops),
        )
        for index, robot in enumerate(whole.robots[: robots + 1])
    )
    rules = replace(whole.rules, ends="home", turn=Fraction(1))
    return replace(whole, robots=fleet, rules=rules)


def lanes(robots: int) -> Scenario:
    """Return robots with a size on a roadmap of crossing lanes."""
    at = {f"{x}.{y}": [LANE * x, LANE * y] for x in range(COLUMNS) for y in range(ROWS)}
    rows = [[f"{x}.{y}" for x in range(COLUMNS)] for y in range(ROWS)]
    ways = [*rows, *(list(column) for column in zip(*rows, strict=True))]
    edges = [[one, other] for way in ways for one, other in pairwise(way)]
    places = sorted(at)
    return parse_scenario(
        {
            "format": "rightofway-scenario/1",
            "map": {"roadmap": {"vertices": at, "edges": edges}},
            "robots": [
                {
                    "name": f"R{index + 1}",
                    "home": places[index * 3],
                    "target": places[-1 - index * 3],
                    "work": index % 10,
                    "radius": "0.6",
                }
                for index in range(robots + 1)
            ],
        }
    )


FLEETS: dict[str, Callable[[], Scenario]] = {
    "50 robots, warehouse": lambda: warehouse(50),
    "200 robots, warehouse": lambda: warehouse(200),
    "30 robots with a size, roadmap": lambda: lanes(30),
}
"""Each has one robot more than its name says: the one that is added."""


def _with(scenario: Scenario, robot: Robot) -> Scenario:
    robots = (robot if each.name == robot.name else each for each in scenario.robots)
    return replace(scenario, robots=tuple(robots))


def changed(plan: Plan, new: Robot) -> dict[str, Scenario]:
    """Return the scenario of a plan with one change each."""
    scenario = plan.scenario
    robot, vertices = scenario.robots[7], plan.tracks[7].vertices.tolist()
    longer = replace(robot.stops[0], work=Fraction(60))
    tail, head = (VertexId(vertex) for vertex in vertices[len(vertices) // 4 :][:2])
    return {
        "a home": _with(scenario, replace(robot, home=new.home)),
        "a stop": _with(scenario, replace(robot, stops=new.stops)),
        "a speed": _with(scenario, replace(robot, speed=robot.speed / 2)),
        "a work time": _with(scenario, replace(robot, stops=(longer,))),
        "a robot more": replace(scenario, robots=(*scenario.robots, new)),
        "a lane closed": replace(scenario, closures=(Closure(edge=(tail, head)),)),
    }


def measured(scenario: Scenario, start: Plan | None) -> tuple[float, float, str]:
    """Return the processor time to the first plan [s], flowtime / bound then, and after `CUT`."""
    began, found = time.process_time(), list[tuple[float, float]]()

    def on_plan(plan: Plan) -> None:
        found.append((time.process_time() - began, plan.flowtime / plan.lower_bound))

    rightofway.solve(scenario, time_limit=LIMIT, start=start, on_plan=on_plan)
    after = [ratio for seconds, ratio in found if seconds <= CUT]
    return *found[0], f"{after[-1]:.3f}" if after else "none"


def warm_start_table() -> str:
    """Return a line for each fleet and change."""
    lines = []
    for fleet, make in FLEETS.items():
        whole = make()
        old = rightofway.solve(replace(whole, robots=whole.robots[:-1]), time_limit=2 * LIMIT)
        for change, scenario in changed(old, whole.robots[-1]).items():
            (soon, first, warm), (later, raw, cold) = (
                measured(scenario, start) for start in (old, None)
            )
            seconds = (f"{soon:.2f}", f"{later:.2f}")
            lines.append((fleet, change, *seconds, f"{first:.3f}", f"{raw:.3f}", warm, cold))
    heads = (
        "fleet", "change", "first [s]", "new plan", "its flowtime", "new plan",
        "after 1 s", "new plan",
    )  # fmt: skip
    return table(heads, lines)


if __name__ == "__main__":
    write_tables(RESULTS / "fleets.md", "warm start", {"changes": warm_start_table()})
