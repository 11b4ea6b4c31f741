"""When jobs of a scenario become known: at given times, or as others are finished."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from heapq import heapify, heappop

from rightofway.model import Job, Tick
from rightofway.model.units import Clock

__all__ = ["Reveal"]


class Reveal:
    """Jobs that become known one after another.

    Parameters
    ----------
    jobs
        The jobs of a scenario, in its order.
    clock
        The clock of the scenario.
    known
        When jobs become known, by name [time unit]; at most and by default their `earliest`.
    first
        With n, a job is known from when it is among the first n unfinished jobs, and
        `earliest` of its first stop is then when it became known, or later. Jobs with `robot` are
        counted for each robot, the others together.
    """

    def __init__(
        self,
        jobs: Sequence[Job],
        clock: Clock,
        *,
        known: Mapping[str, Fraction] | None = None,
        first: int | None = None,
    ) -> None:
        self._clock, self._first = clock, first
        self._queues: dict[str | None, deque[Job]] = defaultdict(deque)
        self._open: dict[str | None, int] = defaultdict(int)
        self._timed: list[tuple[Tick, int, Job]] = []
        if first is not None:
            for job in jobs:
                self._queues[job.robot].append(job)
            return
        times = known or {}
        for number, job in enumerate(jobs):
            time = min(times.get(job.name, job.earliest), job.earliest)
            self._timed.append((clock.count_ticks(time), number, job))
        heapify(self._timed)

    @property
    def next(self) -> Tick | None:
        """When the next job becomes known by its time [ticks]; None if none does."""
        return self._timed[0][0] if self._timed else None

    @property
    def is_over(self) -> bool:
        """Whether all jobs are known."""
        return not self._timed and not any(self._queues.values())

    def take(self, now: Tick) -> Iterator[Job]:
        """Yield the jobs that become known until an instant, each once.

        Parameters
        ----------
        now
            The instant [ticks].
        """
        while self._timed and self._timed[0][0] <= now:
            yield heappop(self._timed)[2]
        if self._first is None:
            return
        for group, waiting in self._queues.items():
            while waiting and self._open[group] < self._first:
                self._open[group] += 1
                yield _make_later(waiting.popleft(), self._clock.convert_to_time(now))

    def finish(self, job: Job) -> None:
        """Count a job that has left the pool, so that another one may become known."""
        self._open[job.robot] -= 1


def _make_later(job: Job, known: Fraction) -> Job:
    """Return a job that begins when it becomes known, or later, as far as `latest` allows it."""
    first = job.stops[0]
    if first.latest is not None:
        known = min(known, first.latest - first.work)
    first = replace(first, earliest=max(first.earliest, known))
    return replace(job, stops=(first, *job.stops[1:]))
