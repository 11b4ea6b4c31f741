"""Tours and unserved jobs of plan documents, read and written."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputError, Steps, find_nearest, quote
from rightofway.io.faults import Faults, validate
from rightofway.io.formats import PLAN_FORMAT, PLAN_OF_JOBS_FORMAT
from rightofway.kinds.table import require_index
from rightofway.model import (
    Job,
    Plan,
    PlannedItem,
    PlannedTour,
    Scenario,
    Tick,
    Track,
    UnservedReason,
)

if TYPE_CHECKING:
    from rightofway.io.plan.shape import TourItemDocument


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadRobot:
    """The part of a plan document on one robot: its track, and its tour where it has one."""

    name: str
    track: Track
    tour: Sequence[TourItemDocument] | None


def read_work_of_plan(
    document: Mapping[str, Any], scenario: Scenario, robots: Sequence[ReadRobot]
) -> dict[str, Any]:
    """Return tours and unserved jobs of a plan document by name; empty without jobs.

    Raises
    ------
    InputError
        For a document in the format of another kind of scenario, and with all faults of its tours.
    """
    wanted = PLAN_FORMAT if scenario.jobs is None else PLAN_OF_JOBS_FORMAT
    if document["format"] != wanted:
        which = "without jobs" if scenario.jobs is None else "with jobs"
        message = f"{quote(document['format'])} is not for a scenario {which} (give {wanted})"
        raise InputError.at("format", message)
    faults, written = Faults(), document.get("robots")
    places: dict[str, Steps] = {
        str(robot.get("name")): ("robots", index, "tour")
        for index, robot in enumerate(written if isinstance(written, list) else ())
        if isinstance(robot, dict)
    }
    if scenario.jobs is None:
        wrong = [places[robot.name] for robot in robots if robot.tour is not None]
        wrong += [("unserved",)] if "unserved" in document else []
        for place in wrong:
            faults.note(place, "is for a scenario with jobs (take it out)")
        faults.stop()
        return {}
    tours = [
        faults.attempt(places[robot.name], _read_tour, robot, scenario.jobs) for robot in robots
    ]
    unserved = _read_unserved(document.get("unserved", []), scenario.jobs, faults)
    faults.stop()
    return {"tours": tours, "unserved": unserved}


def _read_tour(robot: ReadRobot, jobs: Sequence[Job]) -> PlannedTour:
    if robot.tour is None:
        raise InputError.at(
            "", "is missing (give a list of what the robot does, that may be empty)"
        )
    faults = Faults()
    items = [
        faults.attempt(index, _read_item, item, jobs, len(robot.track))
        for index, item in enumerate(robot.tour)
    ]
    faults.stop()
    return tuple(item for item in items if item is not None)


def _read_item(document: TourItemDocument, jobs: Sequence[Job], n_visits: int) -> PlannedItem:
    require_index("visit", document.visit, n_visits)
    job = None if document.job is None else _find_job(document.job, jobs)
    if job is not None and document.stop is not None:
        require_index("stop", document.stop, len(jobs[job].stops))
    return PlannedItem(
        visit=document.visit,
        begin=Tick(document.begin),
        end=Tick(document.end),
        job=job,
        stop=document.stop,
    )


def _find_job(name: str, jobs: Sequence[Job]) -> int:
    names = [job.name for job in jobs]
    if name not in names:
        near = find_nearest(name, names)
        hint = f"did you mean {near!r}?" if near else "name one of the scenario's jobs"
        raise InputError.at("job", f"no job is named {quote(name)} ({hint})")
    return names.index(name)


def _read_unserved(
    data: Any, jobs: Sequence[Job], faults: Faults
) -> Sequence[tuple[int, UnservedReason]]:
    from rightofway.io.plan.shape import UnservedDocument

    if not isinstance(data, list):
        faults.note("unserved", f"{quote(data)} is not a list (give one of {{job, reason}})")
        return ()
    unserved = list[tuple[int, Any]]()
    for index, entry in enumerate(data):
        document = faults.attempt(("unserved", index), validate, UnservedDocument, entry)
        if document is not None:
            job = faults.attempt(("unserved", index), _find_job, document.job, jobs)
            unserved.append((job or 0, document.reason))
    return tuple(unserved)


def dump_tours(plan: Plan) -> Iterator[dict[str, Any]]:
    """Yield the tour of each robot under its key; nothing under it without jobs."""
    if plan.tours is None:
        yield from ({} for _ in plan.tracks)
        return
    for tour in plan.tours:
        yield {"tour": [_dump_item(item, plan.scenario) for item in tour]}


def dump_unserved(plan: Plan) -> dict[str, Any]:
    """Return the unserved jobs under their key; nothing without jobs."""
    if plan.tours is None:
        return {}
    jobs = plan.scenario.jobs or ()
    return {
        "unserved": [{"job": jobs[job].name, "reason": reason} for job, reason in plan.unserved]
    }


def _dump_item(item: PlannedItem, scenario: Scenario) -> dict[str, Any]:
    jobs = scenario.jobs or ()
    work: dict[str, Any] = {"charge": True}
    if item.job is not None:
        work = {"job": jobs[item.job].name, "stop": item.stop}
    return {"visit": item.visit, **work, "begin": item.begin, "end": item.end}
