"""How good a right of way is on fixed routes: the gaps of planners to the proven optimum.

`just gaps` writes the tables between the markers in `docs/improvement.md`, and the plot in it.
They do not depend on the machine.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import PercentFormatter

import rightofway
from rightofway.errors import GaveUp
from rightofway.metrics import measure
from rightofway.metrics.alone import alone_completions
from rightofway.model import Plan, Route, Rules, Scenario
from rightofway.planners.routing import clear_routes, shortest_routes
from rightofway.search import Distances
from tests.fleets import random_fleet
from tests.oracles.fixed_routes import Optimum, best_on, routes_of

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "improvement.md"
PLOT = DOCS / "images" / "gaps.png"
BEGIN, END = "<!-- written by `just gaps`: -->\n", "<!-- up to here -->\n"

FLEETS = range(300)
"""Their seeds."""

TIME_LIMIT = 300
"""More than any plan here takes, so that none depends on the machine [s]."""

ROUTES: dict[str, Callable[[Scenario, Distances], list[Route]]] = {
    "shortest": shortest_routes,
    "clear": clear_routes,
}


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
    """What one method made of one fleet; the optimum and the bound are those of its routes."""

    label: str
    routes: str
    seed: int
    flowtime: int
    optimum: int
    lower_bound: int

    @property
    def gap(self) -> float:
        """By which part the flowtime exceeds the optimum on the same routes."""
        return self.flowtime / self.optimum - 1


def fleet(seed: int) -> Scenario:
    """Return 4 to 8 robots on 6 x 6 to 10 x 10 cells, of which one or two tenths are walls."""
    draw = random.Random(seed)  # noqa: S311 (no secret depends on it)
    return random_fleet(
        seed,
        size=draw.randint(6, 10),
        robots=draw.randint(4, 8),
        walls=draw.choice([0.1, 0.15, 0.2]),
        rules=Rules(occupancy=draw.choice(["one", "both"])),
    )


def compare(methods: Sequence[Method], seeds: Iterable[int]) -> tuple[list[Case], int]:
    """Plan fleets by all methods, and find the optimum on the routes of each plan.

    Returns
    -------
    list of Case
        By optimum where any order works on the routes of a kind, and by each method that keeps
        them; without those whose optimum is not proven.
    int
        On how many routes of fleets it was not proven.
    """
    cases, unproven = [], 0
    for seed in seeds:
        scenario = fleet(seed)
        best = _Optima(scenario)
        cases += _cases(scenario, seed, methods, best)
        unproven += len(best.unproven)
    return cases, unproven


class _Optima:
    """The proven optimum on any routes of one fleet; each is looked for once."""

    def __init__(self, scenario: Scenario) -> None:
        self.unproven: set[tuple[Route, ...]] = set()
        self.on = cache(lambda routes: self._on(scenario, routes))

    def _on(self, scenario: Scenario, routes: tuple[Route, ...]) -> int | None:
        best = best_on(scenario, routes)
        if not isinstance(best, Optimum):
            return None
        if not best.proven:
            self.unproven.add(routes)
            return None
        return best.flowtime


def _cases(
    scenario: Scenario, seed: int, methods: Sequence[Method], best: _Optima
) -> Iterator[Case]:
    bound = sum(alone_completions(scenario))
    for kind, choose in ROUTES.items():
        least = best.on(tuple(choose(scenario, Distances(scenario.roadmap))))
        if least is not None:
            yield Case("optimum", kind, seed, least, least, bound)
    for method in methods:
        plan = plan_on_routes(scenario, method)
        least = None if plan is None else best.on(tuple(routes_of(plan)))
        if plan is not None and least is not None:
            flowtime = measure(plan).flowtime
            yield Case(method.label, method.routes, seed, flowtime, least, bound)


def plan_on_routes(scenario: Scenario, method: Method) -> Plan | None:
    """Return the plan of a method; None if it gives up, leaves a swap or re-routes anybody."""
    try:
        plan = rightofway.solve(scenario, method.planner, TIME_LIMIT, options=method.options)
    except GaveUp:
        return None
    return plan if rightofway.check(plan).ok and not plan.run.reroutes else None


def by_label(cases: Iterable[Case], routes: str) -> dict[str, list[Case]]:
    """Sort the cases on routes of one kind by method."""
    found: dict[str, list[Case]] = {}
    for case in cases:
        if case.routes == routes:
            found.setdefault(case.label, []).append(case)
    return found


def where_all_solve(cases: Iterable[Case], routes: str) -> dict[str, list[Case]]:
    """Sort the cases of those fleets that every method keeps on its routes."""
    found = by_label(cases, routes)
    seeds = set.intersection(*({case.seed for case in each} for each in found.values()))
    return {label: [c for c in each if c.seed in seeds] for label, each in found.items()}


HEADS = (
    "routes",
    "right of way by",
    "solved",
    "optimal",
    "mean gap",
    "median",
    "90 %",
    "worst",
    "flowtime / lower bound",
)


def table(groups: Mapping[str, Mapping[str, Sequence[Case]]]) -> Iterator[str]:
    """Yield a line for each method on each kind of routes."""
    yield "| " + " | ".join(HEADS) + " |"
    yield "|" + " --- |" * 2 + " ---: |" * (len(HEADS) - 2)
    for routes, methods in groups.items():
        for label, cases in methods.items():
            yield "| " + " | ".join((routes, label, *figures(cases))) + " |"


def figures(cases: Sequence[Case]) -> Iterator[str]:
    """Yield what the table says of a method."""
    gaps = np.array([case.gap for case in cases])
    yield str(len(cases))
    yield f"{np.mean(gaps == 0):.0%}".replace("%", " %")
    for gap in (gaps.mean(), np.median(gaps), np.quantile(gaps, 0.9), gaps.max()):
        yield f"{gap:.1%}".replace("%", " %")
    yield f"{np.mean([case.flowtime / case.lower_bound for case in cases]):.3f}"


def report(cases: Sequence[Case], unproven: int) -> str:
    """Return what the page says of all methods."""
    count = len({case.seed for case in cases})
    common = {f"{kind}": where_all_solve(cases, kind) for kind in ROUTES}
    return "\n".join(
        (
            f"{len(FLEETS)} fleets, of which {count} can keep the routes of at least one kind."
            f" Optima that were not proven: {unproven}.",
            "",
            *table({kind: by_label(cases, kind) for kind in ROUTES}),
            "",
            "The same on those fleets only that all methods on these routes solve:",
            "",
            *table(common),
            "",
        )
    )


STYLES = {
    "published rule": ("#8a8a8a", "--"),
    "`two-level`": ("#d55e00", "-"),
    "`local-search`, `rounds=0`": ("#56b4e9", "-"),
    "`local-search`": ("#0b4f8a", "-"),
}


def plot(cases: Sequence[Case], path: Path) -> None:
    """Draw which part of the fleets that can keep their routes has a gap of at most so much."""
    figure, panels = plt.subplots(1, len(ROUTES), sharey=True, figsize=(9, 3.6), dpi=120)
    for axes, kind in zip(panels, ROUTES, strict=True):
        _draw(axes, by_label(cases, kind))
        axes.set_title(f"on {kind} routes", loc="left", fontsize=10)
    panels[0].set_ylabel("fleets solved within this gap")
    panels[-1].legend(loc="lower right", frameon=False, fontsize=9)
    figure.tight_layout()
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)


def _draw(axes: Axes, methods: Mapping[str, Sequence[Case]]) -> None:
    feasible = len(methods["optimum"])
    widest = max(case.gap for cases in methods.values() for case in cases)
    for label, cases in methods.items():
        if label != "optimum":
            gaps = np.sort([case.gap for case in cases])
            steps = np.concatenate((np.arange(1, len(gaps) + 1), [len(gaps)])) / feasible
            colour, line = STYLES.get(label, (None, "-"))
            name = label.replace("`", "")
            axes.step([*gaps, widest], steps, line, where="post", color=colour, label=name)
    axes.set(xlabel="flowtime / optimum on the same routes - 1", ylim=(0, 1.02))
    axes.xaxis.set_major_formatter(PercentFormatter(1))
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.grid(alpha=0.25)
    axes.spines[["top", "right"]].set_visible(False)


def main() -> None:
    """Write the page's tables and plot anew."""
    cases, unproven = compare(METHODS, FLEETS)
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    text = f"{before}{BEGIN}\n{report(cases, unproven)}\n{END}{after}"
    PAGE.write_text(text, encoding="utf-8")
    plot(cases, PLOT)


if __name__ == "__main__":
    main()
