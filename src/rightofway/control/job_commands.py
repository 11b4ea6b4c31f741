"""Commands of people on the jobs of a plan with jobs: into the pool, and out of it.

A job is given as in scenario files, but its times count from now on. A command is idempotent by the
name of its job: asked for again, it changes nothing and is answered as before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from rightofway.control.commands import read_duration
from rightofway.control.journal import Entry
from rightofway.control.ledger import Ledger
from rightofway.control.work_items import find_stop
from rightofway.dispatch import PooledJob, PoolEvent
from rightofway.errors import InputError, find_nearest, quote
from rightofway.facts import Fact
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.work import read_job
from rightofway.io.scenario.work_writer import dump_job
from rightofway.model import Job, Scenario, Tick, UnservedReason
from rightofway.units import is_clock_time

__all__ = ["JobCommands", "list_pooled_jobs"]

MOMENTS = ("earliest", "latest", "due")
DURATIONS = ("work", "pickup_work", "dropoff_work")

STATES_OF_LEFT = {"done": "is done already", "withdrawn": "is withdrawn already"}
"""Why a job that has left the pool cannot be changed; others have a reason not to be done."""


class JobCommands:
    """The commands on the jobs of a pool; each returns its entries and a fact that answers it.

    Parameters
    ----------
    scenario
        The scenario of the plan.
    ledger
        Has the pool.
    """

    def __init__(self, scenario: Scenario, ledger: Ledger) -> None:
        self._scenario, self._ledger = scenario, ledger
        self._map = LoadedMap(roadmap=scenario.roadmap, units=scenario.units)

    def add(self, given: Mapping[str, Any], now: int) -> tuple[list[Entry], Fact]:
        """Take a job into the pool.

        Parameters
        ----------
        given
            The job as a document; its times count from now on, and times of day are the next ones.
            `urgent` means due at once. Without a name it gets one.
        now
            The time since the run began [ticks].

        Raises
        ------
        InputError
            With every fault of the job.
        """
        document = {**given, "name": str(given.get("name") or self._find_new_name())}
        name, pool = document["name"], self._ledger.pool
        if name in pool.jobs or name in pool.left:
            return [], Fact("job known already", job=name)
        job = self._read(document, now)
        return [self._make_event("job known", job, now)], Fact("job known", job=name)

    def change(self, given: Mapping[str, Any], now: int) -> tuple[list[Entry], Fact]:
        """Change a job that is not begun: the given keys replace those of before.

        Parameters
        ----------
        given, now
            As for `add`: its name, and the keys that change.

        Raises
        ------
        InputError
            If there is no such job, or it is begun, or with every fault of the changed job.
        """
        own = self._find_open(str(given["name"]))
        before = dump_job(own.job, self._scenario.roadmap)
        unchanged = {key: value for key, value in before.items() if not _is_replaced(key, given)}
        job = self._read({**given, "name": own.job.name}, now, unchanged)
        if job == own.job:
            return [], Fact("job changed", job=job.name)
        return [self._make_event("job changed", job, now)], Fact("job changed", job=job.name)

    def withdraw(self, name: str, now: int) -> tuple[list[Entry], Fact]:
        """Take a job back that is not begun.

        Parameters
        ----------
        name
            Of the job.
        now
            The time since the run began [ticks].

        Raises
        ------
        InputError
            If there is no such job, or it is begun or done.
        """
        if self._ledger.pool.left.get(name) == "withdrawn":
            return [], Fact("job withdrawn", job=name)
        self._find_open(name)
        event = PoolEvent(kind="job withdrawn", at=Tick(now), name=name)
        return [event.to_document(self._scenario.roadmap)], Fact("job withdrawn", job=name)

    def give_up(self, name: str, now: int) -> tuple[list[Entry], Fact]:
        """Give up a job of which a stop has failed: its robot goes on without it.

        Parameters
        ----------
        name, now
            As for `withdraw`.
        """
        entries: list[Entry] = [
            {"kind": "skipped", "robot": robot, "job": item}
            for robot, own in enumerate(self._ledger.robots)
            for item in sorted(own.route.all_jobs - own.finished)
            if (find_stop(item) or ("", 0))[0] == name
        ]
        event = PoolEvent(kind="job unserved", at=Tick(now), name=name, reason="not found")
        return [*entries, event.to_document(self._scenario.roadmap)], Fact("job skipped", job=name)

    def _find_open(self, name: str) -> PooledJob:
        pool = self._ledger.pool
        if name not in pool.jobs:
            state = STATES_OF_LEFT.get(pool.left.get(name, ""), "is given up already")
            near = None
            if name not in pool.left:
                state, near = "is no job", find_nearest(name, pool.jobs)
            remedy = f"did you mean {near}?" if near else "see rightofway jobs list"
            raise InputError.at("job", f"{quote(name)} {state} ({remedy})")
        if pool.jobs[name].is_begun:
            raise InputError.at("job", f"{quote(name)} is begun already (it cannot be changed)")
        return pool.jobs[name]

    def _find_new_name(self) -> str:
        pool = self._ledger.pool
        number = len(pool.jobs) + len(pool.left) + 1
        while f"job{number}" in pool.jobs or f"job{number}" in pool.left:
            number += 1
        return f"job{number}"

    def _make_event(self, kind: Any, job: Job, now: int) -> Entry:
        event = PoolEvent(kind=kind, at=Tick(now), name=job.name, job=job)
        return event.to_document(self._scenario.roadmap)

    def _read(
        self, given: Mapping[str, Any], now: int, unchanged: Mapping[str, Any] | None = None
    ) -> Job:
        """Return the job of a document whose times count from now; keys may be kept as they are."""
        passed = self._scenario.problem.clock.convert_to_time(now)
        document = self._shift_times(given, passed)
        if document.pop("urgent", False):
            document["due"] = passed
        job = read_job({**(unchanged or {}), **document}, self._map)
        first = replace(job.stops[0], earliest=max(job.stops[0].earliest, passed))
        job = replace(job, stops=(first, *job.stops[1:]))
        names = [robot.name for robot in self._scenario.robots]
        if job.robot is not None and job.robot not in names:
            near = find_nearest(job.robot, names) or names[0]
            raise InputError.at("robot", f"{quote(job.robot)} is no robot (for example {near})")
        pool = self._ledger.pool
        for before in job.after:
            if (before not in pool.jobs and before not in pool.left) or before == job.name:
                remedy = "name a job that is known"
                raise InputError.at("after", f"{quote(before)} is no other job ({remedy})")
        for number, stop in enumerate(job.stops):
            if self._scenario.roadmap.is_passed(stop.at):
                place = self._scenario.roadmap.name(stop.at)
                message = f"{place} is driven through only (name a vertex without pass)"
                raise InputError.at(("stops", number), message)
        return job

    def _shift_times(self, given: Mapping[str, Any], passed: Fraction) -> dict[str, Any]:
        """Return a document with times from the start of the run, as scenario files have them."""
        seconds = self._scenario.units.seconds
        document = {key: value for key, value in given.items() if value is not None}
        for key in (*MOMENTS, *DURATIONS):
            if key not in document:
                continue
            if key in MOMENTS and is_clock_time(document[key]):
                document[key] = self._read_clock_time(key, document[key], passed)
                continue
            time = read_duration(document[key], seconds)
            document[key] = time + (passed if key in MOMENTS else 0)
        if isinstance(document.get("stops"), list):
            document["stops"] = [
                self._shift_times(stop, passed) if isinstance(stop, dict) else stop
                for stop in document["stops"]
            ]
        return document

    def _read_clock_time(self, key: str, text: str, passed: Fraction) -> Fraction:
        """Return the time of a time of day: the next one from now on."""
        try:
            return self._scenario.units.read_clock_time(text, not_before=passed)
        except ValueError as error:
            raise InputError.at(key, str(error)) from None


def _is_replaced(key: str, given: Mapping[str, Any]) -> bool:
    """Return whether a key of a job has no effect beside the given ones."""
    forms = {"at", "work", "pickup", "dropoff", "pickup_work", "dropoff_work", "load", "stops"}
    places = ("at", "pickup", "stops")
    if not any(place in given for place in places):
        return key in given
    return key in given or key in forms


def list_pooled_jobs(
    ledger: Ledger, planned: Mapping[str, int], reasons: Mapping[str, UnservedReason | None]
) -> list[dict[str, Any]]:
    """Return the jobs of a pool in the order in which they became known: name, place, state, robot.

    Parameters
    ----------
    ledger
        Has the pool.
    planned
        The number of the robot that has each job in its tour, by name.
    reasons
        Why jobs are in no tour, by name.
    """
    failed = {stop[0] for own in ledger.robots for item in own.failed if (stop := find_stop(item))}
    rows = []
    for name, own in ledger.pool.jobs.items():
        number = planned.get(name) if own.robot is None else own.robot
        state = "begun" if own.is_begun else "waiting" if number is None else "planned"
        next_stop = own.job.stops[min(own.done, len(own.job.stops) - 1)]
        rows.append(
            {
                "name": name,
                "at": ledger.roadmap.name(next_stop.at),
                "state": "failed" if name in failed else state,
                "robot": None if number is None else ledger.names[number],
                "reason": reasons.get(name) if number is None else None,
            }
        )
    return rows
