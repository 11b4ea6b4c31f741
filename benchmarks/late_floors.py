"""Plans of every planner on late floors: what collides, how late robots are, and how fast it runs.

``python -m benchmarks.late_floors`` measures and writes the tables of docs/results/late-floors.md
and the plot of docs/execution.md: how soon a plan collides by the clock, and how late its fleet is
with its order kept, switched, or replanned. Arguments (``runs``, ``policies``, ``plot``) choose
parts.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from fractions import Fraction
from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

import rightofway
from benchmarks.common import IMAGES, RESULTS, plain_axes, save_figure, table, write_tables
from rightofway.model import Plan, Rules
from rightofway.planners import Feature, find_all
from tests.builders.fleets import random_fleet

RUNS, POLICY_RUNS = 10_000, 20
"""Runs of each plan with each kind of delay, and with an execution policy."""

LIMIT, NEIGHBOURHOODS = 2, 3000
"""Time for each plan [s]; what plans under a policy are made with, the same on any machine."""

DELAYS = {
    "noise": "exponential:0.2",
    "stops": "chance:0.02x20",
    "breakdowns": "breaks:0.05,uniform:0..0.5",
}
POLICY_DELAYS = {
    "noise": DELAYS["noise"],
    "stops": DELAYS["stops"],
    "slow robot": "slow:R3x2,exponential:0.1",
}
POLICIES = {"switched": (True, False), "replanned": (False, True), "both": (True, True)}
FLEETS = {
    "10 robots, 12 x 12": random_fleet(1, size=12, robots=10),
    "10 robots, 12 x 12, `both`": random_fleet(
        1, size=12, robots=10, rules=Rules(occupancy="both")
    ),
    "30 robots, 20 x 20, `both`, headway 1": random_fleet(
        2, size=20, robots=30, rules=Rules(occupancy="both", headway=Fraction(1))
    ),
    "30 robots, 20 x 20, two laps": random_fleet(3, size=20, robots=30, rules=Rules(laps=2)),
}

MEANS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2)
COLOURS = ("#56b4e9", "#0b4f8a", "#d55e00", "#8a8a8a")
PLOT_RUNS, PLOT_POLICY_RUNS = 1000, 50


@cache
def make_plan(fleet: str, planner: str) -> Plan:
    """Return a plan; the same one for each kind of delay."""
    return rightofway.solve(FLEETS[fleet], planner, time_limit=LIMIT)


def runs_table() -> str:
    """Return a line for each planner: the sum of all its runs."""
    lines = []
    for planner in sorted(
        name for name, spec in find_all().items() if Feature.LEAVES_SWAPS not in spec.features
    ):
        found, seconds = [], 0.0
        for fleet in FLEETS:
            plan = make_plan(fleet, planner)
            began = time.perf_counter()
            found += [rightofway.simulate(plan, delays, RUNS) for delays in DELAYS.values()]
            seconds += time.perf_counter() - began
        runs = sum(outcome.runs for outcome in found)
        late = sum(outcome.lateness.all.mean or 0 for outcome in found) / len(found)
        by_clock = sum(outcome.by_clock.runs for outcome in found) / runs
        counts = (
            sum(outcome.collisions for outcome in found),
            sum(outcome.deadlocks for outcome in found),
        )
        figures = (f"{by_clock:.1%}", f"{late:.1f}", f"{runs / seconds:.0f}")
        lines.append((planner, str(runs), *map(str, counts), *figures))
    heads = ("planner", "runs", "collisions", "deadlocks", "by clock", "late", "runs/s")
    return table(heads, lines)


def policies_table() -> str:
    """Return how much switching and replanning win over keeping the order."""
    lines = []
    for fleet, scenario in FLEETS.items():
        plan = rightofway.solve(scenario, "auto", None, options={"iterations": NEIGHBOURHOODS})
        for name, delays in POLICY_DELAYS.items():
            for policy, (switch, replan) in POLICIES.items():
                began = time.perf_counter()
                outcome = rightofway.simulate(
                    plan, delays, POLICY_RUNS, switch=switch, replan=replan
                )
                seconds, gain = time.perf_counter() - began, outcome.gain
                assert gain is not None
                assert not outcome.collisions + outcome.deadlocks
                late, saved = outcome.lateness.flowtime.mean, gain.flowtime.mean
                assert late is not None
                assert saved is not None
                order = late + saved
                changes = (outcome.switches + outcome.replans) / POLICY_RUNS
                lines.append(
                    (
                        fleet, name, policy, f"{order:.0f} → {late:.0f}",
                        f"{saved / order:.1%}", f"{gain.earlier}, {gain.later}",
                        f"{changes:.1f}", f"{POLICY_RUNS / seconds:.1f}",
                    )
                )  # fmt: skip
    heads = (
        "fleet", "delays", "policy", "late", "won", "runs earlier, later", "changes a run",
        "runs/s",
    )  # fmt: skip
    return table(heads, lines)


def plot() -> Figure:
    """Return the plot of docs/execution.md."""
    plans = [make_plan(fleet, "local-search") for fleet in FLEETS]
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    _draw_collisions(left, plans)
    _draw_lateness(right, plans[2])
    for axes in (left, right):
        axes.xaxis.set_major_formatter(PercentFormatter(1, decimals=1 if axes is left else None))
        axes.yaxis.set_major_formatter(PercentFormatter(1))
        plain_axes(axes)
    left.legend(frameon=False, fontsize=8, loc="lower right", bbox_to_anchor=(1, 0.04))
    right.legend(frameon=False, fontsize=8)
    return figure


def _draw_collisions(axes: Axes, plans: Sequence[Plan]) -> None:
    """Draw which part of all runs collides, by how late robots are."""
    for fleet, plan, colour in zip(FLEETS, plans, COLOURS, strict=True):
        found = [rightofway.simulate(plan, f"exponential:{mean}", PLOT_RUNS) for mean in MEANS]
        assert not any(outcome.collisions for outcome in found)
        share = [outcome.by_clock.runs / PLOT_RUNS for outcome in found]
        axes.plot(MEANS, share, "o-", color=colour, markersize=4, label=fleet.replace("`", ""))
    axes.plot(MEANS, [0] * len(MEANS), "k-", linewidth=2, label="by right of way, all fleets")
    axes.set(xscale="log", xlabel="mean delay, as a part of what things take", ylim=(-0.03, 1.03))
    axes.set_title("runs that collide by the clock", loc="left", fontsize=10)


def _draw_lateness(axes: Axes, plan: Plan) -> None:
    """Draw how the lateness of a fleet is spread: order kept, switched, replanned."""
    planned = sum(int(track.enter[-1]) for track in plan.tracks)
    policies = {
        "order kept": (False, False),
        **{name: POLICIES[name] for name in ("switched", "replanned")},
    }
    colours = ("#d55e00", "#0b4f8a", "#56b4e9")
    for (label, (switch, replan)), colour in zip(policies.items(), colours, strict=True):
        outcome = rightofway.simulate(
            plan, DELAYS["stops"], PLOT_POLICY_RUNS, switch=switch, replan=replan
        )
        late = np.sort(outcome.completion.sum(axis=1) - planned) / planned
        axes.step(late, np.linspace(0, 1, len(late)), color=colour, label=label)
    axes.set(xlabel="flowtime above the plan, at most", ylim=(0, 1.02))
    axes.set_title(f"runs of 30 robots, {DELAYS['stops']}", loc="left", fontsize=10)


def main(*parts: str) -> None:
    """Measure, and write what was measured."""
    for name, made in (("runs", runs_table), ("policies", policies_table)):
        if not parts or name in parts:
            write_tables(RESULTS / "late-floors.md", "late floors", {name: made()})
    if not parts or "plot" in parts:
        save_figure(plot(), IMAGES / "late-floors.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
