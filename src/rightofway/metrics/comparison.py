"""Plans side by side: their costs, when each robot completes, changes of their scenarios.

Robots are the same where their names are. Times of all plans are counted in one tick, which divides
the ticks of all of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from rightofway.errors import InputError
from rightofway.metrics.changes import Change, find_changes, find_job_changes
from rightofway.metrics.measure import measure
from rightofway.model import Plan

MAX_COMPARED = 8
"""The largest number of plans in one comparison."""

SMALLER_IS_BETTER = ("flowtime", "makespan", "gap", "seconds")
"""The figures of which the best ones are marked."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """A comparison of plans.

    Attributes
    ----------
    plans
        The plans.
    tick
        The tick in which times are counted [time unit of the first plan].
    scales
        The length of a tick of each plan in these ticks.
    robots
        The names of all robots, those of the first plan first.
    changes
        Differences of the scenario of each plan from that of the first one, and of what both do
        with jobs.
    """

    plans: tuple[Plan, ...]
    tick: Fraction
    scales: tuple[int, ...]
    robots: tuple[str, ...]
    changes: tuple[tuple[Change, ...], ...]

    def as_dict(self) -> dict[str, Any]:
        """Return figures and completion times as plain data; times in `tick`.

        A robot that a plan does not have completes at None there. ``best`` has the places of the
        plans with the smallest figures; sums over different robots have no best one.
        """
        units, fleets = self.plans[0].scenario.units, [_list_names(plan) for plan in self.plans]
        plans = list(map(self._list_figures, self.plans, self.scales))
        is_one_fleet = all(fleet == fleets[0] for fleet in fleets)
        return {
            "tick": [self.tick.numerator, self.tick.denominator],
            "units": units.to_document(),
            "scales": list(self.scales),
            "plans": plans,
            "best": {
                key: _find_best(plans, key) if is_one_fleet or key == "seconds" else []
                for key in SMALLER_IS_BETTER
            },
            "robots": [
                {"name": name, "completion": row}
                for name, row in zip(self.robots, self._list_completions(), strict=True)
            ],
        }

    @staticmethod
    def _list_figures(plan: Plan, scale: int) -> dict[str, Any]:
        metrics, run = measure(plan), plan.run
        costs = {
            "flowtime": metrics.flowtime,
            "makespan": metrics.makespan,
            "lower_bound": metrics.lower_bound,
            "alone": metrics.flowtime_alone,
        }
        return {
            "planner": run.name,
            "seed": run.seed,
            "seconds": None if run.seconds is None else round(run.seconds, 6),
            **{key: scale * ticks for key, ticks in costs.items()},
            "gap": metrics.gap,
            "robots": len(plan.scenario.robots),
        }

    def _list_completions(self) -> Iterator[list[int | None]]:
        """Yield the completion of each robot in each plan."""
        columns = [
            dict(
                zip(
                    _list_names(plan),
                    (scale * int(ticks) for ticks in plan.completions),
                    strict=True,
                )
            )
            for plan, scale in zip(self.plans, self.scales, strict=True)
        ]
        for name in self.robots:
            yield [column.get(name) for column in columns]


def compare(plans: Sequence[Plan], titles: Sequence[str] = ()) -> Comparison:
    """Compare plans; their scenarios may differ.

    Parameters
    ----------
    plans
        Two or more plans; robots are compared by their names.
    titles
        Their names in errors.

    Raises
    ------
    InputError
        If there are too many, or one counts its times in a unit and another one in none.
    """
    if not plans:
        raise InputError.at("plans", "there are none (give two or more)")
    if len(plans) > MAX_COMPARED:
        message = f"{len(plans)} plans are too many to compare (give at most {MAX_COMPARED})"
        raise InputError.at("", message)
    first, ticks = plans[0].scenario, []
    for place, plan in enumerate(plans):
        tick, units = plan.scenario.problem.clock.tick, plan.scenario.units
        if (units.seconds is None) != (first.units.seconds is None):
            own, other = units.time or "no unit", first.units.time or "no unit"
            message = (
                f"its times are in {own}, those of the first plan in {other},"
                " so they cannot be compared (give both scenarios a unit of time, or none)"
            )
            raise InputError.at((titles[place] if titles else "") or f"plan {place + 1}", message)
        ticks.append(tick * (units.seconds or 1) / (first.units.seconds or 1))
    whole = lcm(*(tick.denominator for tick in ticks))
    common = Fraction(gcd(*(int(tick * whole) for tick in ticks)), whole)
    return Comparison(
        plans=tuple(plans),
        tick=common,
        scales=tuple(int(tick / common) for tick in ticks),
        robots=tuple(dict.fromkeys(name for plan in plans for name in _list_names(plan))),
        changes=tuple(
            (*find_changes(first, plan.scenario), *find_job_changes(plans[0], plan))
            for plan in plans
        ),
    )


def _list_names(plan: Plan) -> tuple[str, ...]:
    return tuple(robot.name for robot in plan.scenario.robots)


def _find_best(plans: Sequence[dict[str, Any]], key: str) -> list[int]:
    """Return where a figure is smallest; nowhere if it is the same everywhere."""
    values = {place: plan[key] for place, plan in enumerate(plans) if plan[key] is not None}
    least = min(values.values(), default=None)
    places_of_least = [place for place, value in values.items() if value == least]
    return places_of_least if len(places_of_least) < len(plans) else []
