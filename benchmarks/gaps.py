"""How good a right of way is on fixed routes: the gaps of planners to the proven optimum.

`just gaps` writes the tables between the marks in `docs/results/improvement.md`, and the plot in
it: which part of the fleets has a gap of at most a given size. They do not depend on the machine.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

import rightofway
from benchmarks.common import IMAGES, RESULTS, plain_axes, save_figure
from rightofway.errors import GaveUp
from rightofway.metrics import compute_alone_completions, measure
from rightofway.model import Plan, Route, Rules, Scenario
from rightofway.repair.routing import clear_routes, find_shortest_routes
from rightofway.search import Distances
from tests.builders.fleets import random_fleet
from tests.oracles.fixed_routes import Optimum, best_on, routes_of

PAGE = RESULTS / "improvement.md"
BEGIN, END = "<!-- written by `just gaps`: -->\n", "<!-- up to here -->\n"

TIME_LIMIT = 300
"""More than any plan here takes, so that none depends on the machine [s]."""

ROUTES: dict[str, Callable[[Scenario, Distances], list[Route]]] = {
    "shortest": find_shortest_routes,
    "clear": clear_routes,
}


class Family(NamedTuple):
    """Random fleets of a size; from, to."""

    size: tuple[int, int]
    robots: tuple[int, int]
    seeds: range


SMALL = Family(size=(6, 10), robots=(4, 8), seeds=range(300))
LARGER = Family(size=(12, 12), robots=(12, 12), seeds=range(60))


class Method(NamedTuple):
    """A planner with its options, and the name of its routes."""

    label: str
    routes: str
    planner: str
    options: Mapping[str, Any]


METHODS = (
    Method("published rule", "shortest", "two-level", {"swaps": "leave"}),
    *(
        Method(label, kind, planner, {"routes": kind, **options})
        for kind in ROUTES
        for label, planner, options in (
            ("`two-level`", "two-level", {}),
            ("`local-search`, `rounds=0`", "local-search", {"rounds": 0}),
            ("`local-search`", "local-search", {}),
        )
    ),
)

STYLES = {
    "published rule": ("#8a8a8a", "--"),
    "`two-level`": ("#d55e00", "-"),
    "`local-search`, `rounds=0`": ("#56b4e9", "-"),
    "`local-search`": ("#0b4f8a", "-"),
}
"""Colour and line of each method."""


class Case(NamedTuple):
    """The outcome of one method for one fleet.

    ``optimum`` and ``alone`` are the least flowtime on its routes, and the flowtime there if no
    robot had to wait; ``lower_bound`` is that of all routes.
    """

    label: str
    routes: str
    seed: int
    flowtime: int
    optimum: int
    alone: int
    lower_bound: int

    @property
    def gap(self) -> float:
        """By which part the flowtime exceeds the optimum on the same routes."""
        return self.flowtime / self.optimum - 1


Groups = dict[str, list[Case]]
"""The cases of each method on routes of one kind, the optimum first."""


def fleet(family: Family, seed: int) -> Scenario:
    """Return a fleet on a grid of which one or two tenths are walls."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    return random_fleet(
        seed,
        size=draw.randint(*family.size),
        robots=draw.randint(*family.robots),
        walls=draw.choice([0.1, 0.15, 0.2]),
        rules=Rules(occupancy=draw.choice(["one", "both"])),
    )


def cases_of(family: Family, seed: int) -> tuple[list[Case], int]:
    """Plan a fleet by all methods, and find the optimum on the routes of each plan.

    Returns
    -------
    list of Case
        The optimum on the routes of each kind, and each method that keeps these routes; without
        those whose optimum is not proven.
    int
        On how many sets of routes it was not proven.
    """
    scenario = fleet(family, seed)
    lower_bound, unproven = sum(compute_alone_completions(scenario)), set()

    @cache
    def best(routes: tuple[Route, ...]) -> int | None:
        found = best_on(scenario, routes)
        if isinstance(found, Optimum) and not found.proven:
            unproven.add(routes)
        return found.flowtime if isinstance(found, Optimum) and found.proven else None

    def cases(label: str, kind: str, routes: Sequence[Route], flowtime: int | None) -> list[Case]:
        least = best(tuple(routes))
        if flowtime is None or least is None:
            return []
        alone = sum(route.compute_least(visit) for route in routes for visit in range(len(route)))
        return [Case(label, kind, seed, flowtime, least, alone, lower_bound)]

    found: list[Case] = []
    for kind, choose in ROUTES.items():
        routes = choose(scenario, Distances(scenario.roadmap))
        found += cases("optimum", kind, routes, best(tuple(routes)))
    for method in METHODS:
        plan = plan_on_routes(scenario, method)
        if plan is not None:
            found += cases(method.label, method.routes, routes_of(plan), measure(plan).flowtime)
    return found, len(unproven)


def plan_on_routes(scenario: Scenario, method: Method) -> Plan | None:
    """Return the plan of a method; None if it gives up, leaves a swap or re-routes a robot."""
    try:
        plan = rightofway.solve(scenario, method.planner, TIME_LIMIT, options=method.options)
    except GaveUp:
        return None
    return plan if rightofway.check(plan).ok and not plan.run.reroutes else None


def by_method(cases: Sequence[Case], kind: str) -> Groups:
    """Return the cases on routes of one kind."""
    labels = ["optimum", *(method.label for method in METHODS if method.routes == kind)]
    here = [case for case in cases if case.routes == kind]
    return {label: [case for case in here if case.label == label] for label in labels}


def where_all_solve(groups: Groups) -> Groups:
    """Return the cases of those fleets that every method solves."""
    seeds = set.intersection(*({case.seed for case in cases} for cases in groups.values()))
    return {
        label: [case for case in cases if case.seed in seeds] for label, cases in groups.items()
    }


PERCENT = "\N{NO-BREAK SPACE}%"
HEADS = (
    "routes", "right of way by", "solved", "optimal", "mean gap", "median", f"90{PERCENT}",
    "worst", "flowtime / lower bound",
)  # fmt: skip


def lines_of(kinds: Mapping[str, Groups]) -> Iterator[str]:
    """Yield a table: a line for each method on each kind of routes."""
    yield "| " + " | ".join(HEADS) + " |"
    yield "|" + " --- |" * 2 + " ---: |" * (len(HEADS) - 2)
    for kind, groups in kinds.items():
        for label, cases in groups.items():
            cells = [""] * (len(HEADS) - 3)
            if cases:
                gaps = np.array([case.gap for case in cases])
                shares = gaps.mean(), np.median(gaps), np.quantile(gaps, 0.9), gaps.max()
                ratio = np.mean([case.flowtime / case.lower_bound for case in cases])
                optimal = sum(case.flowtime == case.optimum for case in cases)
                texts = (f"{100 * share:.1f}{PERCENT}" for share in shares)
                cells = [f"{optimal}", *texts, f"{ratio:.3f}"]
            yield "| " + " | ".join((kind, label, str(len(cases)), *cells)) + " |"


def report(family: Family, kinds: Mapping[str, Groups], unproven: int) -> str:
    """Return the part of the page on a family of fleets."""
    robots, cells = (" to ".join(map(str, dict.fromkeys(each))) for each in family[1::-1])
    lines = [
        f"### {robots} robots, grids {cells} cells wide",
        "",
        f"{len(family.seeds)} fleets; optima that were not proven: {unproven}.",
    ]
    for kind, groups in kinds.items():
        optima = groups["optimum"]
        easy = sum(case.optimum == case.alone for case in optima)
        lines.append(
            f"On {kind} routes {len(optima)} of them have a plan; in {easy} of these no robot"
            " has to wait in the best plan."
        )
    everywhere = {kind: where_all_solve(groups) for kind, groups in kinds.items()}
    also = "The same on those fleets only that all methods on these routes solve:"
    return "\n".join([*lines, "", *lines_of(kinds), "", also, "", *lines_of(everywhere)])


def plot(kinds: Mapping[str, Groups]) -> Figure:
    """Return a figure with a panel for each kind of routes."""
    gaps = {
        kind: {label: [case.gap for case in cases] for label, cases in groups.items()}
        for kind, groups in kinds.items()
    }
    widest = max(gap for methods in gaps.values() for each in methods.values() for gap in each)
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    panels = figure.subplots(1, len(gaps), sharex=True, sharey=True)
    for axes, (kind, methods) in zip(panels, gaps.items(), strict=True):
        for label, (colour, line) in STYLES.items():
            if methods.get(label):
                values, count = np.unique(methods[label], return_counts=True)
                share = np.cumsum(count) / len(methods["optimum"])
                steps = [*values, widest], [*share, share[-1]]
                axes.step(*steps, line, where="post", color=colour, label=label.replace("`", ""))
        axes.set(xlabel="gap to the optimum on the same routes, at most", ylim=(0, 1.02))
        axes.xaxis.set_major_formatter(PercentFormatter(1))
        axes.yaxis.set_major_formatter(PercentFormatter(1))
        axes.set_title(f"on {kind} routes", loc="left", fontsize=10)
        plain_axes(axes)
    panels[0].set_ylabel("share of the fleets with a plan")
    panels[0].legend(loc="lower right", frameon=False, fontsize=9)
    return figure


def main() -> None:
    """Write the page's tables and plot."""
    reports = []
    for family in (SMALL, LARGER):
        found = [cases_of(family, seed) for seed in family.seeds]
        cases = [case for some, _ in found for case in some]
        kinds = {kind: by_method(cases, kind) for kind in ROUTES}
        reports.append(report(family, kinds, sum(unproven for _, unproven in found)))
        if family is SMALL:
            save_figure(plot(kinds), IMAGES / "gaps.png")
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    text = "\n\n".join(reports)
    PAGE.write_text(f"{before}{BEGIN}\n{text}\n\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
