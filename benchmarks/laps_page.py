"""The tables of the page on laps, from what was measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from benchmarks.laps_rows import Row
from benchmarks.marked import write_tables
from rightofway.cyclic import CyclicResult, LapWait, run_laps
from tests.builders.fleets import PAPER, paper_scenario

PAGE = Path(__file__).parents[1] / "docs" / "laps.md"

RULES = ("first-come", "fixed-order", "two-level")


def write_page(rows: Sequence[Row], page: Path = PAGE) -> None:
    """Put the tables between their marks."""
    write_tables(page, "table", tables(rows))


def tables(rows: Sequence[Row]) -> dict[str, str]:
    """Return every table by its name in the page."""
    return {
        "paper": "".join(_paper()),
        "how long": "".join(_table(rows, _how_long, HOW_LONG)),
        "where": "".join(_table(rows, _where, WHERE)),
    }


HOW_LONG = (
    "groups", "repeat", "standstill", "open", "somebody starves",
    "transient [laps]", "period [laps]",
)  # fmt: skip
WHERE = (
    "pairs and places in first laps", "in each period", "first ones that come again",
    "periodic ones that are new", "no wait at all", "waiting",
)  # fmt: skip


def _paper() -> Iterator[str]:
    """Yield what becomes of the paper's cases on its own routes."""
    yield _line(
        "case", "laps alone", "from", "period", "laps", "waits in the first laps",
        "waits in each period", *(f"mean laps, `{rule}`" for rule in RULES),
    )  # fmt: skip
    yield _line(*["---"] * (7 + len(RULES)))
    for case in PAPER:
        runs = [run_laps(paper_scenario(case), rule, routes="shortest") for rule in RULES]
        run, group = runs[0], runs[0].groups[0]
        pattern = group.pattern
        assert pattern is not None, "every case repeats"
        yield _line(
            case["name"],
            ", ".join(str(lap.duration) for lap in group.context.laps),
            str(pattern.transient),
            str(pattern.period),
            ", ".join(map(str, pattern.counts)),
            _told(run, group.first_waits()),
            _told(run, group.waits()),
            *(_means(one) for one in runs),
        )


def _told(run: CyclicResult, conflicts: Sequence[LapWait]) -> str:
    name, robots = run.scenario.roadmap.name, run.scenario.robots
    told = Counter(f"{robots[one.waits].name} for {name(one.vertex)}" for one in conflicts)
    times = (f"{wait}, {n} times" if n > 1 else wait for wait, n in told.items())
    return "; ".join(times) or "none"


def _means(run: CyclicResult) -> str:
    means = run.groups[0].mean_laps()
    return ", ".join("never home" if mean is None else str(mean) for mean in means)


def _table(
    rows: Sequence[Row], cells: Callable[[Sequence[Row]], Iterator[str]], heads: Sequence[str]
) -> Iterator[str]:
    yield _line("fleet", "rule", *heads)
    yield _line(*["---"] * (len(heads) + 2))
    kinds = sorted({(row.size, row.robots, row.speeds) for row in rows})
    for size, robots, speeds in kinds:
        for rule in RULES:
            mine = [
                row
                for row in rows
                if (row.size, row.robots, row.speeds, row.rule) == (size, robots, speeds, rule)
            ]
            name = f"{robots} robots, {size} x {size}, {speeds} speeds"
            yield _line(name, f"`{rule}`", *cells(mine))


def _how_long(rows: Sequence[Row]) -> Iterator[str]:
    yield str(len(rows))
    for end in ("repeats", "deadlock", "open"):
        yield _percent([row.ends == end for row in rows])
    repeating = repeats(rows)
    yield _percent([bool(row.standing) for row in repeating])
    yield _spread([in_laps(row, row.transient) for row in repeating])
    yield _spread([in_laps(row, row.period) for row in repeating])


def _where(rows: Sequence[Row]) -> Iterator[str]:
    repeating = repeats(rows)
    first, steady, same = (
        np.array([getattr(row, key) for row in repeating], float)
        for key in ("first", "steady", "same")
    )
    yield f"{first.mean():.1f}"
    yield f"{steady.mean():.1f}"
    yield _share(same.sum(), first.sum())
    yield _share((steady - same).sum(), steady.sum())
    yield _percent([row.steady == 0 for row in repeating])
    yield _percent([float(row.waiting) for row in repeating if row.waiting != ""])


def repeats(rows: Sequence[Row]) -> list[Row]:
    """Return the groups whose pattern is known."""
    return [row for row in rows if row.ends == "repeats"]


def in_laps(row: Row, ticks: int | str) -> float:
    """Return a time in laps of the slowest robot of a group, driving alone."""
    return float(ticks) / row.longest_lap


def _spread(values: Sequence[float]) -> str:
    if not values:
        return "—"
    middle, most = np.quantile(values, (0.5, 0.9))
    return f"{middle:.1f} ({most:.1f})"


def _share(part: float, whole: float) -> str:
    return f"{100 * part / whole:.0f} %" if whole else "—"


def _percent(claims: Sequence[float]) -> str:
    return f"{100 * float(np.mean(claims)):.0f} %" if claims else "—"


def _line(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |\n"
