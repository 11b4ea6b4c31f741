"""The pool: jobs that are known and not finished, a fold over events.

A journal keeps the events; the pool follows from them. An event that is applied twice changes
nothing, because each names its job, and a job that has left the pool never comes back.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Literal, get_args

from rightofway.errors import InputError, quote
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.work import read_job
from rightofway.io.scenario.work_writer import dump_job
from rightofway.kinds.numbers import format_number
from rightofway.model import Job, Tick, UnservedReason
from rightofway.site import Roadmap

__all__ = ["EventKind", "JobEnd", "Pool", "PoolEvent", "PooledJob"]

EventKind = Literal[
    "job known", "job changed", "job withdrawn", "job planned", "stop begun", "stop done",
    "job unserved", "job ended",
]  # fmt: skip
"""Kinds of events of a job; `job unserved` is final. `job ended` adds the time to a job that is
done, `job planned` that at which it ends in the plan.
"""

KEYS: dict[EventKind, tuple[str, ...]] = {
    "job known": ("job",),
    "job changed": ("job",),
    "job withdrawn": ("name",),
    "job planned": ("name", "end"),
    "stop begun": ("name", "robot", "stop"),
    "stop done": ("name", "robot", "stop"),
    "job unserved": ("name", "reason"),
    "job ended": ("name",),
}
"""The fields of each kind of event in a document, beside `kind` and `at`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PoolEvent:
    """An event of a job.

    Attributes
    ----------
    kind
        The event.
    at
        When, from the start of the shift [ticks].
    name
        The name of the job.
    job
        The job, of `job known` and `job changed`.
    robot, stop
        Index of the robot, and of the stop among all stops of the job, of `stop begun` and
        `stop done`. A stop is begun when its work is released to the robot.
    reason
        Why no robot does the job, of `job unserved`.
    end
        When the job ends in the plan, of `job planned`, from the start of the shift [ticks].
    """

    kind: EventKind
    at: Tick
    name: str
    job: Job | None = None
    robot: int | None = None
    stop: int | None = None
    reason: UnservedReason | None = None
    end: Tick | None = None

    def to_document(self, roadmap: Roadmap) -> dict[str, Any]:
        """Return the event as JSON has it, with the job as scenario files have it."""
        document: dict[str, Any] = {"kind": self.kind, "at": self.at}
        for key in KEYS[self.kind]:
            value = getattr(self, key)
            document[key] = dump_job(value, roadmap) if isinstance(value, Job) else value
        return document

    @classmethod
    def of_document(
        cls,
        document: Mapping[str, Any],
        roadmap: Roadmap,
        read: Callable[[Any, LoadedMap], Job] = read_job,
    ) -> PoolEvent:
        """Return the event of a document; ``read`` returns the job of one.

        Raises
        ------
        InputError
            For an unknown kind, and for a job that scenario files may not have either.
        """
        kind: Any = document.get("kind")
        if kind not in get_args(EventKind):
            message = f"{quote(kind)} is no event of a job (give {', '.join(get_args(EventKind))})"
            raise InputError.at("kind", message)
        values = {key: document[key] for key in KEYS[kind]}
        if "job" in values:
            values["job"] = read(values["job"], LoadedMap(roadmap=roadmap))
            values["name"] = values["job"].name
        return cls(kind=kind, at=Tick(document["at"]), **values)


@dataclass(frozen=True, slots=True, kw_only=True)
class PooledJob:
    """A job of the pool.

    Attributes
    ----------
    job
        The job; its times count from the start of the shift.
    known
        When it became known [ticks].
    robot
        Index of the robot that has begun it; None before.
    begun, done
        The numbers of its first stops that are begun, and that are done.
    planned
        When it ends in the first plan that has it [ticks]: that of the begin or of a round, since
        the job became known or was changed; None before.
    expected
        The same in the latest plan.
    """

    job: Job
    known: Tick
    robot: int | None = None
    begun: int = 0
    done: int = 0
    planned: Tick | None = None
    expected: Tick | None = None

    @property
    def is_begun(self) -> bool:
        """Whether its first work is released: from then on only one robot may finish it."""
        return self.robot is not None


@dataclass(frozen=True, slots=True, kw_only=True)
class JobEnd:
    """The end of a job that is done.

    Attributes
    ----------
    robot
        Index of the robot that has done it.
    earliest, due
        Those of the job.
    at
        When it ended [ticks]; None until that is noted.
    planned, expected
        Those of `PooledJob`, at its end.
    """

    robot: int
    earliest: Fraction
    due: Fraction | None
    at: Tick | None = None
    planned: Tick | None = None
    expected: Tick | None = None

    def to_document(self) -> list[Any]:
        """Return the end as JSON has it."""
        due = None if self.due is None else format_number(self.due)
        times = self.at, self.planned, self.expected
        return [self.robot, format_number(self.earliest), due, *times]

    @classmethod
    def of_document(cls, document: Sequence[Any]) -> JobEnd:
        """Return the end of a document."""
        robot, earliest, due, at, planned, expected = document
        return cls(
            robot=robot,
            earliest=Fraction(earliest),
            due=None if due is None else Fraction(due),
            at=at,
            planned=planned,
            expected=expected,
        )


class Pool:
    """The jobs that are known and not finished, in the order in which they became known.

    Attributes
    ----------
    jobs
        The jobs by name.
    left
        How each job has left the pool, by name: ``done``, ``withdrawn``, or a reason of
        `rightofway.model.work.UnservedReason`.
    ends
        The ends of the jobs that are done, by name.
    unnoted
        The jobs that are done and have no time of their end yet.
    counts
        The number of effective events of each kind since this pool was made.
    """

    def __init__(self) -> None:
        self.jobs: dict[str, PooledJob] = {}
        self.left: dict[str, str] = {}
        self.ends: dict[str, JobEnd] = {}
        self.unnoted = set[str]()
        self.counts = Counter[EventKind]()

    def apply(self, event: PoolEvent) -> bool:
        """Apply an event; return whether it has changed anything.

        A job that is begun is neither changed nor withdrawn. Events of unknown jobs, of jobs that
        have left, and of another robot than the one that has begun the job change nothing.

        Parameters
        ----------
        event
            The event.
        """
        has_changed = self._apply(event)
        self.counts[event.kind] += has_changed
        return has_changed

    def _apply(self, event: PoolEvent) -> bool:
        own = self.jobs.get(event.name)
        if event.kind == "job ended":
            return self._note_end(event)
        if own is None:
            is_new = event.kind == "job known" and event.name not in self.left
            if is_new and event.job is not None:
                self.jobs[event.name] = PooledJob(job=event.job, known=event.at)
            return is_new
        later = _advance_job(own, event)
        if isinstance(later, str):
            del self.jobs[event.name]
            self.left[event.name] = later
            if later == "done" and event.robot is not None:
                self.ends[event.name] = JobEnd(
                    robot=event.robot,
                    earliest=own.job.earliest,
                    due=own.job.due,
                    planned=own.planned,
                    expected=own.expected,
                )
                self.unnoted.add(event.name)
            return True
        self.jobs[event.name] = later
        return later != own

    def _note_end(self, event: PoolEvent) -> bool:
        end = self.ends.get(event.name)
        if end is None or end.at is not None:
            return False
        self.ends[event.name] = replace(end, at=event.at)
        self.unnoted.discard(event.name)
        return True

    def list_begun(self, robot: int) -> Iterator[PooledJob]:
        """Yield the jobs that a robot has begun."""
        return (own for own in self.jobs.values() if own.robot == robot)

    def is_over(self, name: str) -> bool:
        """Return whether a job has left the pool."""
        return name in self.left

    def to_document(self, roadmap: Roadmap) -> dict[str, Any]:
        """Return the pool as JSON has it."""
        jobs = [
            {
                "job": dump_job(own.job, roadmap),
                "known": own.known,
                "robot": own.robot,
                "begun": own.begun,
                "done": own.done,
                "planned": own.planned,
                "expected": own.expected,
            }
            for own in self.jobs.values()
        ]
        ends = {name: end.to_document() for name, end in self.ends.items()}
        return {"jobs": jobs, "left": dict(self.left), "ends": ends}

    @classmethod
    def of_document(cls, document: Mapping[str, Any], roadmap: Roadmap) -> Pool:
        """Return the pool of a document.

        Raises
        ------
        InputError
            For a job that scenario files may not have either.
        """
        pool, on = cls(), LoadedMap(roadmap=roadmap)
        for own in document["jobs"]:
            job = read_job(own["job"], on)
            pool.jobs[job.name] = PooledJob(
                job=job,
                known=Tick(own["known"]),
                robot=own["robot"],
                begun=own["begun"],
                done=own["done"],
                planned=own["planned"],
                expected=own["expected"],
            )
        pool.left.update(document["left"])
        for name, end in document["ends"].items():
            pool.ends[name] = JobEnd.of_document(end)
        pool.unnoted = {name for name, end in pool.ends.items() if end.at is None}
        return pool


def _advance_job(own: PooledJob, event: PoolEvent) -> PooledJob | str:
    """Return a job after an event, or how it has left the pool."""
    match event.kind:
        case "job changed" if event.job is not None and not own.is_begun:
            return replace(own, job=event.job, planned=None, expected=None)
        case "job planned":
            first = event.end if own.planned is None else own.planned
            return replace(own, planned=first, expected=event.end)
        case "job withdrawn" if not own.is_begun:
            return "withdrawn"
        case "job unserved":
            return event.reason or "not found"
        case "stop begun" | "stop done" if event.robot is not None and event.stop is not None:
            return _count_stop(own, event.robot, event.stop, is_done=event.kind == "stop done")
    return own


def _count_stop(own: PooledJob, robot: int, stop: int, *, is_done: bool) -> PooledJob | str:
    """Return a job whose stops up to one are begun, or done."""
    if own.robot not in {None, robot} or not 0 <= stop < len(own.job.stops):
        return own
    done = max(own.done, stop + 1) if is_done else own.done
    if done == len(own.job.stops):
        return "done"
    return replace(own, robot=robot, begun=max(own.begun, stop + 1), done=done)
