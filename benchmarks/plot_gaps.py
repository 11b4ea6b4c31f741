"""The plot of `docs/improvement.md`: which part of the fleets has a gap of at most so much."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import PercentFormatter

Gaps = Mapping[str, Sequence[float]]
"""The gap of each fleet that a method solves; ``optimum`` solves all that have a plan."""

STYLES = {
    "published rule": ("#8a8a8a", "--"),
    "`two-level`": ("#d55e00", "-"),
    "`local-search`, `rounds=0`": ("#56b4e9", "-"),
    "`local-search`": ("#0b4f8a", "-"),
}
"""Colour and line; of other methods they are matplotlib's choice."""


def plot(gaps: Mapping[str, Gaps], path: Path) -> None:
    """Draw a panel for each kind of routes, and write a PNG."""
    widest = max(gap for methods in gaps.values() for each in methods.values() for gap in each)
    figure, panels = plt.subplots(1, len(gaps), sharex=True, sharey=True, figsize=(9, 3.6), dpi=120)
    for axes, (kind, methods) in zip(panels, gaps.items(), strict=True):
        _draw(axes, methods, widest)
        axes.set_title(f"on {kind} routes", loc="left", fontsize=10)
    panels[0].set_ylabel("share of the fleets with a plan")
    panels[0].legend(loc="lower right", frameon=False, fontsize=9)
    figure.tight_layout()
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)


def _draw(axes: Axes, methods: Gaps, widest: float) -> None:
    for label in methods:
        if label != "optimum" and methods[label]:
            gaps, count = np.unique(methods[label], return_counts=True)
            share = np.cumsum(count) / len(methods["optimum"])
            colour, line = STYLES.get(label, (None, "-"))
            steps = [*gaps, widest], [*share, share[-1]]
            axes.step(*steps, line, where="post", color=colour, label=label.replace("`", ""))
    axes.set(xlabel="gap to the optimum on the same routes, at most", ylim=(0, 1.02))
    axes.xaxis.set_major_formatter(PercentFormatter(1))
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.grid(alpha=0.25)
    axes.spines[["top", "right"]].set_visible(False)
