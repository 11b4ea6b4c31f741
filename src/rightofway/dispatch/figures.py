"""Figures of a shift: jobs and their service times over time, the use of robots, bottlenecks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np

from rightofway.dispatch.record import JobRecord, RobotRecord, ShiftRecord
from rightofway.execution.statistics import Quantiles
from rightofway.model import Tick, UnservedReason
from rightofway.site import VertexId

__all__ = ["RobotUse", "ShiftFigures", "ShiftSlice", "measure_shift"]

SLICES = 8
"""Parts of equal length into which a shift is cut."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ShiftSlice:
    """A part of a shift.

    Attributes
    ----------
    begin, end
        The part [ticks].
    done, late
        Jobs that ended in it, and those of them that ended after `due`.
    service
        Their service times [ticks].
    """

    begin: Tick
    end: Tick
    done: int
    late: int
    service: Quantiles


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotUse:
    """The time use of one robot [ticks].

    Attributes
    ----------
    jobs
        Jobs that it has ended.
    driving, waiting, working, charging
        How long it drove, waited for others, worked and charged.
    idle
        The rest: nothing to do, turns, and waits for the clock and for other jobs.
    waits_for
        The robots that it has waited for, with ticks, the longest waits first.
    least_soc, last_soc
        The lowest and the last known state of charge; None without a battery.
    lost
        Since when it does not go on; None if it does.
    """

    jobs: int
    driving: int
    waiting: int
    working: int
    charging: int
    idle: int
    waits_for: tuple[tuple[int, int], ...]
    least_soc: Fraction | None
    last_soc: Fraction | None
    lost: Tick | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ShiftFigures:
    """The figures of a shift.

    Attributes
    ----------
    known, done, late
        Jobs that became known, that ended, and that ended after `due`.
    under_way
        Jobs that were begun and had not ended at the end of the shift.
    unserved
        The other jobs by the reason of the last round; ``not yet`` for those in tours.
    service
        Service times of the jobs that ended [ticks].
    slices
        The same in parts of the shift.
    robots
        The use of each robot.
    bottlenecks
        Where robots waited longest, with ticks, the longest first.
    rounds, stood
        Rounds, and those after which the old plan stood.
    seconds
        The time of a round on average, and of the longest one [s].
    reasons
        The kinds of the reasons of rounds, with their numbers, the most frequent first.
    """

    known: int
    done: int
    late: int
    under_way: int
    unserved: tuple[tuple[UnservedReason | str, int], ...]
    service: Quantiles
    slices: tuple[ShiftSlice, ...]
    robots: tuple[RobotUse, ...]
    bottlenecks: tuple[tuple[VertexId, int], ...]
    rounds: int
    stood: int
    seconds: tuple[float, float]
    reasons: tuple[tuple[str, int], ...]


def measure_shift(record: ShiftRecord, *, slices: int = SLICES) -> ShiftFigures:
    """Return the figures of a shift.

    Parameters
    ----------
    record
        The shift.
    slices
        Into how many parts of equal length it is cut.
    """
    jobs = list(record.jobs.values())
    done = [own for own in jobs if own.ended is not None]
    left = [own for own in jobs if own.begun is None]
    places = Counter[int]()
    for robot in record.robots:
        places.update(robot.waits_at)
    seconds = [planned.seconds for planned in record.rounds] or [0.0]
    return ShiftFigures(
        known=len(jobs),
        done=len(done),
        late=sum(_is_late(own, record) for own in done),
        under_way=len(jobs) - len(done) - len(left),
        unserved=tuple(Counter(own.reason or "not yet" for own in left).most_common()),
        service=_measure_service(done, record),
        slices=tuple(_cut_slices(done, record, slices)),
        robots=tuple(
            _measure_use(robot, own, jobs, record.until) for robot, own in enumerate(record.robots)
        ),
        bottlenecks=tuple((VertexId(at), ticks) for at, ticks in places.most_common()),
        rounds=len(record.rounds),
        stood=sum(planned.stands for planned in record.rounds),
        seconds=(sum(seconds) / len(seconds), max(seconds)),
        reasons=tuple(
            Counter(
                fact.kind for planned in record.rounds for fact in planned.reasons
            ).most_common()
        ),
    )


def _is_late(own: JobRecord, record: ShiftRecord) -> bool:
    due, tick = own.job.due, record.scenario.problem.clock.tick
    return due is not None and own.ended is not None and own.ended * tick > due


def _measure_service(done: Sequence[JobRecord], record: ShiftRecord) -> Quantiles:
    count = record.scenario.problem.clock.count_ticks
    times = [(own.ended or 0) - count(own.job.earliest) for own in done]
    return Quantiles.of(np.array(times, np.int64))


def _cut_slices(
    done: Sequence[JobRecord], record: ShiftRecord, slices: int
) -> Iterator[ShiftSlice]:
    """Yield the parts of a shift; one that is shorter than their number has fewer."""
    bounds = sorted({record.until * k // slices for k in range(slices + 1)})
    for begin, end in pairwise(bounds):
        is_last = end == record.until
        own = [
            job for job in done if begin <= (job.ended or 0) < end or (is_last and job.ended == end)
        ]
        yield ShiftSlice(
            begin=Tick(begin),
            end=Tick(end),
            done=len(own),
            late=sum(_is_late(job, record) for job in own),
            service=_measure_service(own, record),
        )


def _measure_use(robot: int, own: RobotRecord, jobs: Sequence[JobRecord], until: Tick) -> RobotUse:
    working = sum(min(step.end, until) - min(step.begin, until) for step in own.steps if step.job)
    charging = sum(
        min(step.end, until) - min(step.begin, until) for step in own.steps if not step.job
    )
    waiting = sum(own.waits.values())
    levels = [soc for _, soc in own.soc]
    return RobotUse(
        jobs=sum(job.robot == robot and job.ended is not None for job in jobs),
        driving=own.drives,
        waiting=waiting,
        working=working,
        charging=charging,
        idle=max(0, until - own.drives - waiting - working - charging),
        waits_for=tuple(own.waits.most_common()),
        least_soc=min(levels, default=None),
        last_soc=levels[-1] if levels else None,
        lost=None if own.lost is None else Tick(own.lost),
    )
