"""The pool of jobs: a fold over events, which a journal may repeat."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest

from rightofway.dispatch import Pool, PoolEvent, Reveal
from rightofway.errors import InputError
from rightofway.model import Clock, Job, JobStop, Tick
from rightofway.site import VertexId, make_grid_roadmap

ROADMAP = make_grid_roadmap(["....", "...."])

TRANSPORT = Job(
    name="J1",
    stops=(
        JobStop(at=VertexId(1), load=1, work=Fraction(1, 3)),
        JobStop(at=VertexId(6), load=-1, latest=Fraction(40)),
    ),
    due=Fraction(30),
)
VISIT = Job(name="J2", stops=(JobStop(at=VertexId(3), earliest=Fraction(5)),), after=("J1",))


def happen(kind: str, at: int = 0, name: str = "J1", **values: object) -> PoolEvent:
    """Return an event."""
    return PoolEvent(kind=kind, at=Tick(at), name=name, **values)  # type: ignore[arg-type]


KNOWN = happen("job known", 2, job=TRANSPORT)
BEGUN = happen("stop begun", 4, robot=1, stop=0)
DONE = happen("stop done", 6, robot=1, stop=0)


def fold(*events: PoolEvent) -> Pool:
    """Return the pool after some events."""
    pool = Pool()
    for event in events:
        pool.apply(event)
    return pool


def test_a_job_is_begun_by_the_robot_to_which_its_first_work_is_released() -> None:
    own = fold(KNOWN, BEGUN).jobs["J1"]
    assert (own.robot, own.begun, own.done, own.known) == (1, 1, 0, 2)
    assert [begun.job.name for begun in fold(KNOWN, BEGUN).list_begun(1)] == ["J1"]


def test_a_job_leaves_with_its_last_stop() -> None:
    pool = fold(KNOWN, BEGUN, DONE, happen("stop done", 9, robot=1, stop=1))
    assert not pool.jobs
    assert pool.left == {"J1": "done"}


def test_the_end_of_a_job_is_noted_once_and_kept() -> None:
    last = happen("stop done", 0, robot=1, stop=1)
    pool = fold(KNOWN, BEGUN, last)
    assert (pool.unnoted, pool.ends["J1"].at) == ({"J1"}, None)
    pool = fold(KNOWN, BEGUN, last, happen("job ended", 9), happen("job ended", 12))
    end = pool.ends["J1"]
    assert (end.robot, end.earliest, end.due, end.at) == (1, Fraction(0), Fraction(30), Tick(9))
    again = Pool.of_document(json.loads(json.dumps(pool.to_document(ROADMAP))), ROADMAP)
    assert (again.ends, again.unnoted) == (pool.ends, set())


def test_a_job_keeps_its_first_planned_end_and_the_latest_one_until_it_is_changed() -> None:
    plans = happen("job planned", 3, end=Tick(20)), happen("job planned", 5, end=Tick(26))
    own = fold(KNOWN, *plans).jobs["J1"]
    assert (own.planned, own.expected) == (20, 26)
    last = happen("stop done", 0, robot=1, stop=1)
    end = fold(KNOWN, *plans, BEGUN, last).ends["J1"]
    assert (end.planned, end.expected) == (20, 26)
    changed = happen("job changed", 6, job=replace(TRANSPORT, weight=Fraction(7)))
    own = fold(KNOWN, *plans, changed).jobs["J1"]
    assert (own.planned, own.expected) == (None, None)
    pool = fold(KNOWN, *plans)
    again = Pool.of_document(json.loads(json.dumps(pool.to_document(ROADMAP))), ROADMAP)
    assert again.jobs == pool.jobs


def test_a_begun_job_is_neither_changed_nor_withdrawn_nor_begun_by_another_robot() -> None:
    pool = fold(KNOWN, BEGUN)
    changed = replace(TRANSPORT, weight=Fraction(7))
    assert not pool.apply(happen("job changed", 5, job=changed))
    assert not pool.apply(happen("job withdrawn", 5))
    assert not pool.apply(happen("stop begun", 5, robot=0, stop=0))
    assert pool.jobs["J1"].job == TRANSPORT


def test_a_job_that_nobody_has_begun_may_change_and_be_withdrawn() -> None:
    changed = replace(TRANSPORT, weight=Fraction(7))
    pool = fold(KNOWN, happen("job changed", 3, job=changed))
    assert pool.jobs["J1"].job.weight == 7
    pool.apply(happen("job withdrawn", 4))
    assert pool.left == {"J1": "withdrawn"}


def test_a_job_that_has_left_does_not_come_back() -> None:
    pool = fold(KNOWN, happen("job unserved", 3, reason="latest"))
    assert not pool.apply(KNOWN)
    assert pool.left == {"J1": "latest"}
    assert pool.is_over("J1")


def test_events_that_are_applied_again_in_any_number_change_nothing() -> None:
    events = [
        KNOWN,
        happen("job known", 3, "J2", job=VISIT),
        BEGUN,
        DONE,
        happen("stop done", 9, robot=1, stop=1),
        happen("job withdrawn", 9, "J2"),
    ]
    random = Random(1)  # noqa: S311 (no secret depends on it)
    for _ in range(50):
        pool, applied = Pool(), list[PoolEvent]()
        for event in events:
            pool.apply(event)
            applied.append(event)
            before = pool.to_document(ROADMAP)
            for again in random.choices(applied, k=3):
                assert not pool.apply(again)
            assert pool.to_document(ROADMAP) == before


def test_events_and_pools_survive_json() -> None:
    events = (KNOWN, happen("job known", 3, "J2", job=VISIT), BEGUN, DONE)
    read = [
        PoolEvent.of_document(json.loads(json.dumps(event.to_document(ROADMAP))), ROADMAP)
        for event in events
    ]
    assert tuple(read) == events
    pool = fold(*events)
    again = Pool.of_document(json.loads(json.dumps(pool.to_document(ROADMAP))), ROADMAP)
    assert (again.jobs, again.left) == (pool.jobs, pool.left)


def test_an_unknown_event_is_refused_with_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"'job lost' is no event of a job .give job known"):
        PoolEvent.of_document({"kind": "job lost", "at": 0}, ROADMAP)


CLOCK = Clock(tick=Fraction(1, 2))


def test_jobs_become_known_at_their_earliest_or_at_times_that_are_given() -> None:
    reveal = Reveal([TRANSPORT, VISIT], CLOCK, known={"J2": Fraction(3)})
    assert [job.name for job in reveal.take(Tick(0))] == ["J1"]
    assert reveal.next == 6  # 3 time units in halves
    assert [job.name for job in reveal.take(Tick(6))] == ["J2"]
    assert reveal.is_over


def test_no_job_becomes_known_after_its_earliest() -> None:
    reveal = Reveal([VISIT], CLOCK, known={"J2": Fraction(8)})
    assert reveal.next == 10


def test_jobs_become_known_as_others_of_their_robot_are_finished() -> None:
    jobs = [replace(VISIT, name=f"{robot}{k}", robot=robot) for k in range(2) for robot in "ab"]
    reveal = Reveal(jobs, CLOCK, first=1)
    first = list(reveal.take(Tick(0)))
    assert [job.name for job in first] == ["a0", "b0"]
    assert not list(reveal.take(Tick(4)))
    reveal.finish(first[1])
    (job,) = reveal.take(Tick(30))
    assert (job.name, job.earliest) == ("b1", Fraction(15))
    assert not reveal.is_over


def test_the_first_unfinished_jobs_without_robot_are_known() -> None:
    jobs = [replace(TRANSPORT, name=f"J{k}") for k in range(5)]
    reveal = Reveal(jobs, CLOCK, first=2)
    assert [job.name for job in reveal.take(Tick(0))] == ["J0", "J1"]
    reveal.finish(jobs[1])
    assert [job.name for job in reveal.take(Tick(7))] == ["J2"]
