"""How good a right of way is on fixed routes: the gaps of planners to the proven optimum.

`just gaps` writes the tables between the markers in `docs/improvement.md`, and the plot in it.
They do not depend on the machine.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import rightofway
from benchmarks.plot_gaps import plot
from rightofway.errors import GaveUp
from rightofway.metrics import alone_completions, measure
from rightofway.model import Plan, Route, Rules, Scenario
from rightofway.planners.routing import clear_routes, shortest_routes
from rightofway.search import Distances
from tests.builders.fleets import random_fleet
from tests.oracles.fixed_routes import Optimum, best_on, routes_of

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "improvement.md"
PLOT = DOCS / "images" / "gaps.png"
BEGIN, END = "<!-- written by `just gaps`: -->\n", "<!-- up to here -->\n"

TIME_LIMIT = 300
"""More than any plan here takes, so that none depends on the machine [s]."""

ROUTES: dict[str, Callable[[Scenario, Distances], list[Route]]] = {
    "shortest": shortest_routes,
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
    """A planner with its options, and what its routes are called."""

    label: str
    routes: str
    planner: str
    options: Mapping[str, Any]


PUBLISHED = Method("published rule", "shortest", "two-level", {"swaps": "leave"})

METHODS = (
    PUBLISHED,
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


class Case(NamedTuple):
    """What one method made of one fleet.

    ``optimum`` and ``alone`` are the least flowtime on its routes, and what it would be if nobody
    had to wait; ``lower_bound`` is that of all routes.
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


def compare(methods: Sequence[Method], family: Family) -> tuple[list[Case], int]:
    """Plan fleets by all methods, and find the optimum on the routes of each plan.

    Returns
    -------
    list of Case
        By optimum where any order works on the routes of a kind, and by each method that keeps
        them; without those whose optimum is not proven.
    int
        On how many routes of fleets it was not proven.
    """
    cases: list[Case] = []
    unproven = 0
    for seed in family.seeds:
        one = _Fleet(fleet(family, seed), seed)
        cases += chain(one.optima(), *map(one.cases, methods))
        unproven += len(one.unproven)
    return cases, unproven


class _Fleet:
    """A fleet, and the optimum on any of its routes; each is looked for once."""

    def __init__(self, scenario: Scenario, seed: int) -> None:
        self.scenario = scenario
        self.seed = seed
        self.lower_bound = sum(alone_completions(self.scenario))
        self.unproven: set[tuple[Route, ...]] = set()
        self.best = cache(self._best)

    def _best(self, routes: tuple[Route, ...]) -> int | None:
        """Return the optimum if there is one, and it is proven."""
        found = best_on(self.scenario, routes)
        if isinstance(found, Optimum) and not found.proven:
            self.unproven.add(routes)
        return found.flowtime if isinstance(found, Optimum) and found.proven else None

    def optima(self) -> Iterator[Case]:
        """Yield the optimum on the routes of each kind."""
        for kind, choose in ROUTES.items():
            routes = choose(self.scenario, Distances(self.scenario.roadmap))
            yield from self._cases("optimum", kind, routes, self.best(tuple(routes)))

    def cases(self, method: Method) -> Iterator[Case]:
        """Yield what a method made of it, if it kept the routes."""
        plan = plan_on_routes(self.scenario, method)
        if plan is not None:
            flowtime = measure(plan).flowtime
            yield from self._cases(method.label, method.routes, routes_of(plan), flowtime)

    def _cases(
        self, label: str, kind: str, routes: Sequence[Route], flowtime: int | None
    ) -> Iterator[Case]:
        least = self.best(tuple(routes))
        if flowtime is not None and least is not None:
            alone = sum(route.least(visit) for route in routes for visit in range(len(route)))
            yield Case(label, kind, self.seed, flowtime, least, alone, self.lower_bound)


def plan_on_routes(scenario: Scenario, method: Method) -> Plan | None:
    """Return the plan of a method; None if it gives up, leaves a swap or re-routes anybody."""
    try:
        plan = rightofway.solve(scenario, method.planner, TIME_LIMIT, options=method.options)
    except GaveUp:
        return None
    return plan if rightofway.check(plan).ok and not plan.run.reroutes else None


Groups = dict[str, list[Case]]
"""The cases of each method on routes of one kind, the optimum first."""


def by_method(cases: Sequence[Case], methods: Sequence[Method], kind: str) -> Groups:
    """Sort the cases on routes of one kind."""
    labels = ["optimum", *(method.label for method in methods if method.routes == kind)]
    here = [case for case in cases if case.routes == kind]
    return {label: [case for case in here if case.label == label] for label in labels}


def where_all_solve(groups: Groups) -> Groups:
    """Keep the cases of those fleets that every method solves."""
    seeds = set.intersection(*({case.seed for case in cases} for cases in groups.values()))
    return {
        label: [case for case in cases if case.seed in seeds] for label, cases in groups.items()
    }


PERCENT = "\N{NO-BREAK SPACE}%"

HEADS = (
    "routes",
    "right of way by",
    "solved",
    "optimal",
    "mean gap",
    "median",
    f"90{PERCENT}",
    "worst",
    "flowtime / lower bound",
)


def table(kinds: Mapping[str, Groups]) -> Iterator[str]:
    """Yield a line for each method on each kind of routes."""
    yield "| " + " | ".join(HEADS) + " |"
    yield "|" + " --- |" * 2 + " ---: |" * (len(HEADS) - 2)
    for kind, groups in kinds.items():
        for label, cases in groups.items():
            yield "| " + " | ".join((kind, label, str(len(cases)), *figures(cases))) + " |"


def figures(cases: Sequence[Case]) -> Sequence[str]:
    """Return what the table says of a method that solves any fleet."""
    if not cases:
        return [""] * (len(HEADS) - 3)
    gaps = np.array([case.gap for case in cases])
    shares = gaps.mean(), np.median(gaps), np.quantile(gaps, 0.9), gaps.max()
    ratio = np.mean([case.flowtime / case.lower_bound for case in cases])
    optimal = sum(case.flowtime == case.optimum for case in cases)
    return [f"{optimal}", *(f"{100 * share:.1f}{PERCENT}" for share in shares), f"{ratio:.3f}"]


def report(family: Family, kinds: Mapping[str, Groups], unproven: int) -> str:
    """Return what the page says of a family of fleets."""
    robots, cells = (" to ".join(map(str, dict.fromkeys(each))) for each in family[1::-1])
    lines = [
        f"### {robots} robots, grids {cells} cells wide",
        "",
        f"{len(family.seeds)} fleets; optima that were not proven: {unproven}.",
        *(some_plan(kind, groups["optimum"]) for kind, groups in kinds.items()),
        "",
        *table(kinds),
        "",
        "The same on those fleets only that all methods on these routes solve:",
        "",
        *table({kind: where_all_solve(groups) for kind, groups in kinds.items()}),
    ]
    return "\n".join(lines)


def some_plan(kind: str, optima: Sequence[Case]) -> str:
    """Say on how many fleets there is anything to find."""
    easy = sum(case.optimum == case.alone for case in optima)
    return (
        f"On {kind} routes {len(optima)} of them have a plan; in {easy} of these nobody has to"
        " wait in the best one."
    )


def gaps_of(kinds: Mapping[str, Groups]) -> dict[str, dict[str, list[float]]]:
    """Keep nothing but the gaps."""
    return {
        kind: {label: [case.gap for case in cases] for label, cases in groups.items()}
        for kind, groups in kinds.items()
    }


def main() -> None:
    """Write the page's tables and plot anew."""
    reports = []
    for family in (SMALL, LARGER):
        cases, unproven = compare(METHODS, family)
        kinds = {kind: by_method(cases, METHODS, kind) for kind in ROUTES}
        reports.append(report(family, kinds, unproven))
        if family is SMALL:
            plot(gaps_of(kinds), PLOT)
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    text = "\n\n".join(reports)
    PAGE.write_text(f"{before}{BEGIN}\n{text}\n\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
