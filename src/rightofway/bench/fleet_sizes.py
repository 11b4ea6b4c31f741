"""Shifts of fleets of several sizes: throughput and service times, and the least fleet."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from statistics import median
from typing import Any

from rightofway.bench.results import Row
from rightofway.bench.shifts import SHIFT, USES
from rightofway.bench.summary import group_rows, name_planners
from rightofway.units import SECONDS, write_decimal

HOUR = 3600
"""Seconds of an hour."""

PER = 1000
"""Time units of a rate where their length is not known."""

SHOWN_USES = {"waiting": "wait", "idle": "idle"}
"""Uses of time in tables, with their headings: they rise when there are too many robots."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetSize:
    """Shifts of fleets with the same number of robots; medians over the shifts that were run.

    Attributes
    ----------
    robots
        How many.
    cases, solved
        Numbers of shifts, and of shifts that were simulated to their end.
    known, done
        Jobs that became known and that ended, of all shifts.
    in_time
        The least share of known jobs that were in time, of one shift.
    rate
        Jobs in an hour, or in 1000 time units where their length is not known.
    service_median, service_p95
        Service times [time unit]; None where no job has ended.
    uses
        Shares of the time in which robots drive, wait, work, charge and are idle.
    """

    robots: int
    cases: int
    solved: int
    known: int
    done: int
    in_time: float
    rate: float | None
    service_median: float | None
    service_p95: float | None
    uses: Mapping[str, float]

    @classmethod
    def of(cls, rows: Sequence[Row]) -> FleetSize:
        """Summarise the rows of one number of robots, at least one of them solved."""
        figures = [json.loads(row["figures"]) for row in rows if row["solved"]]
        return cls(
            robots=rows[0]["robots"],
            cases=len(rows),
            solved=len(figures),
            known=sum(own["known"] for own in figures),
            done=sum(own["done"] for own in figures),
            in_time=min(own["in_time"] / own["known"] if own["known"] else 1.0 for own in figures),
            rate=_find_median(_measure_rate(own) for own in figures),
            service_median=_find_median(own["service_median"] for own in figures),
            service_p95=_find_median(own["service_p95"] for own in figures),
            uses={part: round(median(own[part] for own in figures), 4) for part in USES},
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetSizes:
    """Shifts that differ in their numbers of robots and seeds only.

    Attributes
    ----------
    map, fleet, planner
        Names; the planner with the options that tell it from others.
    time_unit
        The unit of times; None where it is not known.
    sizes
        The smallest fleet first; without those of which no shift was simulated.
    """

    map: str
    fleet: str
    planner: str
    time_unit: str | None
    sizes: tuple[FleetSize, ...]

    @property
    def title(self) -> str:
        """The names, without that of shifts."""
        options = self.planner.removeprefix(SHIFT).strip()
        return ", ".join(filter(None, (self.map, self.fleet, options)))

    @property
    def rate_unit(self) -> str:
        """The unit of rates."""
        return "jobs/h" if self.time_unit else f"jobs in {PER}"

    def find_least(self, in_time: Fraction) -> FleetSize | None:
        """Return the smallest fleet with a share of jobs in time, in each of its shifts."""
        fit = (size for size in self.sizes if size.solved == size.cases)
        return next((size for size in fit if size.in_time >= in_time), None)

    def describe_least(self, in_time: Fraction) -> str:
        """Return a sentence on the smallest fleet with a share of jobs in time."""
        share = f"{write_decimal(100 * in_time)} % of jobs in time"
        least = self.find_least(in_time)
        if least is None:
            best = max(self.sizes, key=lambda size: size.in_time)
            percent = _write_number(100 * best.in_time)
            most = f"the most is {percent} %, with {_count_robots(best.robots)}"
            return f"{self.title}: no fleet has {share}; {most}."
        smaller = [size.robots for size in self.sizes if size.robots < least.robots]
        verb = "is" if smaller[-1:] == [1] else "are"
        others = f"{smaller[-1]} {verb} too few" if smaller else "no fewer were tried"
        return f"{self.title}: {_count_robots(least.robots)} for {share}; {others}."

    def list_cells(self) -> list[Sequence[str]]:
        """Return a table of the fleets: the headings, then a row for each size."""
        unit = f" [{self.time_unit}]" if self.time_unit else ""
        head = [
            "robots",
            "shifts",
            "done",
            "in time",
            self.rate_unit,
            f"median{unit}",
            f"95 %{unit}",
        ]
        rows = [
            [
                str(size.robots),
                f"{size.solved}/{size.cases}",
                f"{size.done}/{size.known}",
                f"{_write_number(100 * size.in_time)} %",
                *map(_write_number, (size.rate, size.service_median, size.service_p95)),
                *(f"{_write_number(100 * size.uses[part], 0)} %" for part in SHOWN_USES),
            ]
            for size in self.sizes
        ]
        return [[*head, *SHOWN_USES.values()], *rows]


def _count_robots(number: int) -> str:
    return "1 robot" if number == 1 else f"{number} robots"


def _write_number(number: float | None, digits: int = 1) -> str:
    return "-" if number is None else f"{number:.{digits}f}"


def _measure_rate(figures: Mapping[str, Any]) -> float | None:
    """Return the jobs in an hour, or in 1000 time units."""
    throughput: float | None = figures["throughput"]
    unit = figures["time_unit"]
    if throughput is None:
        return None
    return round(throughput * (float(HOUR / SECONDS[unit]) if unit else PER), 3)


def _find_median(values: Iterable[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return round(median(known), 3) if known else None


def compare_fleet_sizes(rows: Iterable[Row]) -> list[FleetSizes]:
    """Return the shifts among some rows, by map, fleet and options.

    Parameters
    ----------
    rows
        Results of cases; those of planners are left out.
    """
    shifts = [row for row in rows if row["planner"] == SHIFT]
    names = name_planners(shifts)
    named = [{**row, "planner": names[row["key"]]} for row in shifts]
    return [
        FleetSizes(
            map=place,
            fleet=fleet,
            planner=planner,
            time_unit=json.loads(solved[0]["figures"])["time_unit"],
            sizes=tuple(
                FleetSize.of(own)
                for _, own in sorted(group_rows(group, "robots").items())
                if any(row["solved"] for row in own)
            ),
        )
        for (place, fleet, planner), group in group_rows(named, "map", "fleet", "planner").items()
        if (solved := [row for row in group if row["solved"]])
    ]
