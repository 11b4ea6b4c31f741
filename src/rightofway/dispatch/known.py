"""When jobs of a shift become known: at their `earliest`, sooner, or at random times."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

from rightofway.errors import InputError, quote
from rightofway.io.tables import read_csv
from rightofway.kinds.table import NOT_NEGATIVE, POSITIVE
from rightofway.model import Job, Scenario

__all__ = ["ARRIVALS", "plan_arrivals"]

Times = Mapping[str, Fraction]
"""When jobs become known, by their names [time unit]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Arrivals:
    """A distribution of times at which jobs arrive.

    Attributes
    ----------
    draw
        Yields the times in order [time unit], from a generator, the number after the colon and
        how many jobs there are.
    example, meaning
        For people.
    """

    draw: Callable[[random.Random, Fraction, int], Iterator[float]]
    example: str
    meaning: str


def _draw_poisson(generator: random.Random, rate: Fraction, count: int) -> Iterator[float]:
    time = 0.0
    for _ in range(count):
        time -= math.log(1 - generator.random()) / rate
        yield time


def _draw_uniform(generator: random.Random, end: Fraction, count: int) -> Iterator[float]:
    yield from sorted(float(end) * generator.random() for _ in range(count))


ARRIVALS = {
    "poisson": _Arrivals(
        draw=_draw_poisson,
        example="poisson:1/30",
        meaning="a Poisson process: jobs for each time unit, here one in 30 on average",
    ),
    "uniform": _Arrivals(
        draw=_draw_uniform,
        example="uniform:3600",
        meaning="any time from 0 to this one, all equally likely",
    ),
}
"""The distributions of ``known``."""


def plan_arrivals(given: str, scenario: Scenario, seed: int = 0) -> tuple[Scenario, Times]:
    """Return when the jobs of a scenario become known, and the scenario with these jobs.

    Parameters
    ----------
    given
        A CSV file with the columns ``name`` and ``known``; how long before their `earliest` jobs
        become known [time unit]; or a distribution, such as ``poisson:1/30``. With a distribution
        jobs arrive at random times in the order of the scenario. Then each job is moved in
        time as a whole: its `earliest` is when it becomes known, and other times keep their
        distance from it.
    scenario
        A scenario with jobs.
    seed
        For the times that are drawn.

    Raises
    ------
    InputError
        If the text cannot be read or the file has a fault, with its place, value and remedy.
    """
    jobs = scenario.jobs or ()
    if given.lower().endswith(".csv"):
        return scenario, _read_times(Path(given), [job.name for job in jobs])
    name, colon, number = (part.strip() for part in given.partition(":"))
    try:
        if not colon:
            before = NOT_NEGATIVE.read(given)
            return scenario, {job.name: max(job.earliest - before, Fraction(0)) for job in jobs}
        arrivals, parameter = ARRIVALS[name], POSITIVE.read(number)
    except (KeyError, ValueError):
        examples = [arrivals.example for arrivals in ARRIVALS.values()]
        remedy = f"write it like 600, {', '.join(examples)} or known.csv"
        raise InputError.at("known", f"{quote(given)} cannot be read ({remedy})") from None
    clock = scenario.problem.clock
    generator = random.Random(f"known {seed}")  # noqa: S311 (no secret depends on it)
    times = arrivals.draw(generator, parameter, len(jobs))
    moved = tuple(
        _move_job(job, clock.convert_to_time(clock.count_ticks(Fraction(time))))
        for job, time in zip(jobs, times, strict=True)
    )
    return replace(scenario, jobs=moved, clock=clock), {}


def _move_job(job: Job, earliest: Fraction) -> Job:
    """Return a job that begins later or sooner as a whole."""
    by, due = earliest - job.earliest, job.due
    stops = tuple(
        replace(
            stop,
            earliest=max(stop.earliest + by, earliest),
            latest=None if stop.latest is None else stop.latest + by,
        )
        for stop in job.stops
    )
    if due is not None:
        due = max(due + by, Fraction(0))
    return replace(job, stops=stops, due=due)


def _read_times(path: Path, names: Sequence[str]) -> Times:
    rows, locate = read_csv(path, ("known",))
    columns = {text.lower(): column for column, text in next(rows, (1, {}))[1].items()}
    if set(columns) != {"name", "known"}:
        raise InputError.at("known", f"{path} has not the headings name and known (give both)")
    times = {}
    for number, row in rows:
        name = row.get(columns["name"], "")
        if name not in names:
            message = f"{quote(name)} is no job of the scenario (take the row out)"
            raise InputError.at(locate(number, columns["name"]), message)
        at = locate(number, columns["known"])
        times[name] = NOT_NEGATIVE.read_at(at, row.get(columns["known"], ""))
    return times
