"""What was measured for the page on priorities, and the file that keeps it."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Literal

FIGURES = Path(__file__).with_name("priorities.csv")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fleet:
    """One random fleet: where, how many, and under which conditions."""

    ground: str
    robots: int
    speeds: str
    work: int
    occupancy: Literal["one", "both"]
    seed: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Row(Fleet):
    """What one planner made of one fleet; no flowtime where time ran out.

    ``decisions`` counts the rights of way between robots on their routes; ``node``, ``robot``,
    ``settled`` and ``only`` those of them that each level decided, and ``rerouted`` the robots that
    were sent another way.
    ``seconds`` is the time of the processor, which others on the machine prolong the least.
    """

    planner: str
    routes: str
    flowtime: int | None
    lower_bound: int
    decisions: int
    node: int
    robot: int
    settled: int
    only: int
    rerouted: int
    seconds: float

    @property
    def ratio(self) -> float:
        """Flowtime / lower bound."""
        return self.flowtime / self.lower_bound if self.flowtime else float("inf")


def fleet_of(row: Row) -> Fleet:
    """Return the fleet that a row is about."""
    return Fleet(**{field.name: getattr(row, field.name) for field in fields(Fleet)})


def save(rows: Iterable[Row]) -> None:
    """Keep the figures."""
    with FIGURES.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Row)], lineterminator="\n")
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)


def load() -> list[Row]:
    """Return what was kept."""
    with FIGURES.open(encoding="utf-8", newline="") as file:
        return [_row(texts) for texts in csv.DictReader(file)]


def _row(texts: dict[str, str]) -> Row:
    return Row(
        ground=texts["ground"],
        robots=int(texts["robots"]),
        speeds=texts["speeds"],
        work=int(texts["work"]),
        occupancy="one" if texts["occupancy"] == "one" else "both",
        seed=int(texts["seed"]),
        planner=texts["planner"],
        routes=texts["routes"],
        flowtime=int(texts["flowtime"]) if texts["flowtime"] else None,
        lower_bound=int(texts["lower_bound"]),
        decisions=int(texts["decisions"]),
        node=int(texts["node"]),
        robot=int(texts["robot"]),
        settled=int(texts["settled"]),
        only=int(texts["only"]),
        rerouted=int(texts["rerouted"]),
        seconds=float(texts["seconds"]),
    )
