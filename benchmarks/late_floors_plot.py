"""The plot of ``docs/execution.md``: ``python -m benchmarks.late_floors_plot`` writes it.

How soon a plan collides by the clock, and how late its fleet is by right of way: order kept,
switched, or planned anew.
"""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import PercentFormatter

import rightofway
from benchmarks.late_floors import CARES, FLEETS, PAGE, plan_of
from rightofway.model import Plan

PLOT = PAGE.parents[1] / "docs" / "images" / "late-floors.png"
MEANS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2)
COLOURS = ("#56b4e9", "#0b4f8a", "#d55e00", "#8a8a8a")
RUNS, CARED = 1000, 50
STOPS = "chance:0.02x20"


def collisions(axes: Axes, plans: Sequence[Plan]) -> None:
    """Draw which part of all runs collides, by how late robots are."""
    for (fleet, plan), colour in zip(zip(FLEETS, plans, strict=True), COLOURS, strict=True):
        found = [rightofway.simulate(plan, f"exponential:{mean}", RUNS) for mean in MEANS]
        assert not any(outcome.collisions for outcome in found)
        share = [outcome.by_clock.runs / RUNS for outcome in found]
        axes.plot(MEANS, share, "o-", color=colour, markersize=4, label=fleet.replace("`", ""))
    axes.plot(MEANS, [0] * len(MEANS), "k-", linewidth=2, label="by right of way, all fleets")
    axes.set(xscale="log", xlabel="mean delay, as a part of what things take", ylim=(-0.03, 1.03))
    axes.xaxis.set_major_formatter(PercentFormatter(1, decimals=1))
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.set_title("runs that collide by the clock", loc="left", fontsize=10)


def lateness(axes: Axes, plan: Plan) -> None:
    """Draw how the lateness of a fleet is spread: order kept, switched, planned anew."""
    planned = sum(int(track.enter[-1]) for track in plan.tracks)
    for label, (switch, replan), colour in (
        ("order kept", (False, False), "#d55e00"),
        ("switched", CARES["switched"], "#0b4f8a"),
        ("planned anew", CARES["planned anew"], "#56b4e9"),
    ):
        outcome = rightofway.simulate(plan, STOPS, CARED, switch=switch, replan=replan)
        late = np.sort(outcome.completion.sum(axis=1) - planned) / planned
        axes.step(late, np.linspace(0, 1, len(late)), color=colour, label=label)
    axes.set(xlabel="flowtime above the plan, at most", ylim=(0, 1.02))
    axes.xaxis.set_major_formatter(PercentFormatter(1))
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.set_title(f"runs of 30 robots, `{STOPS}`".replace("`", ""), loc="left", fontsize=10)


def main() -> None:
    """Draw both panels."""
    plans = [plan_of(fleet, "local-search") for fleet in FLEETS]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), dpi=120)
    collisions(left, plans)
    lateness(right, plans[2])
    for axes in (left, right):
        axes.grid(alpha=0.25)
        axes.spines[["top", "right"]].set_visible(False)
    left.legend(frameon=False, fontsize=8, loc="lower right", bbox_to_anchor=(1, 0.04))
    right.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(PLOT, metadata={"Software": None})


if __name__ == "__main__":
    main()
