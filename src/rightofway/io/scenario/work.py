"""Jobs, batteries and states of scenario documents, read: with places as vertices of the map."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rightofway.errors import InputFault, Steps, Where, locate_faults, quote
from rightofway.io.faults import Faults, list_keys, validate
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.maps import find_file_beside
from rightofway.model import Battery, Job, JobStop, RobotState
from rightofway.site import VertexId
from rightofway.units import Units, write_start

if TYPE_CHECKING:
    from rightofway.io.scenario.work_shape import JobDocument, StateDocument
    from rightofway.io.tables import CellDocument

JOBS = "give a list of {name, at or pickup and dropoff or stops, …}, or {table: file}"

CROSS_REFERENCES = ("no robot is named ", "no job is named ", "no battery is named ")
"""The begin of faults that follow from other faults where the document has the name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadWork:
    """Jobs and batteries of a document, and where they are in it.

    Attributes
    ----------
    jobs
        Those without faults; None for a document without jobs.
    batteries, charging
        The batteries without faults, and more places to charge at.
    starts
        For places of the model those of the document, where they differ.
    names
        The names of robots, jobs and batteries in the document, also of those with faults.
    """

    jobs: tuple[Job, ...] | None = None
    batteries: tuple[tuple[str, Battery], ...] = ()
    charging: tuple[VertexId, ...] = ()
    starts: Mapping[Steps, Where] = field(default_factory=dict)
    names: frozenset[str] = frozenset()

    def drop_followers(self, faults: Sequence[InputFault]) -> Iterator[InputFault]:
        """Yield faults, without those on names that belong to other parts with faults."""
        for fault in faults:
            begin = next((text for text in CROSS_REFERENCES if fault.words.startswith(text)), "")
            names = (fault.words.startswith(begin + repr(name)) for name in self.names)
            if not begin or not any(names):
                yield fault


def read_jobs_in_table(data: dict[str, Any], base: Path | None, units: Units) -> CellDocument:
    """Return the jobs of a file that the document names."""
    from rightofway.io.orders.formats import OrderTimes, read_jobs_of_file
    from rightofway.io.scenario.work_shape import JobDocument, JobTableDocument

    with locate_faults("jobs"):
        document = validate(JobTableDocument, data)
        # Instants of orders are in UTC: a start without an offset does not say which one it is.
        start = units.start if units.start is not None and units.start.tzinfo else None
        times = OrderTimes(
            second=1 / (units.seconds or Fraction(1)),
            start=None if start is None else write_start(start),
            **document.get_given("begin", "work"),
        )
        with locate_faults("table"):
            file = find_file_beside(base, document.table)
            return read_jobs_of_file(file, times, list_keys(JobDocument), ("jobs", "table"))


def read_work(document: Mapping[str, Any], on: LoadedMap | None, faults: Faults) -> ReadWork:
    """Return the work of a scenario document, or what of it has no faults."""
    jobs, starts = list[Job](), dict[Steps, Steps]()
    for index, job_data in enumerate(_read_list(document, "jobs", JOBS, faults)):
        place = ("jobs", index)
        read = faults.attempt(place, _read_job, job_data, on)
        if read is not None:
            own = "jobs", len(jobs)  # the model numbers the jobs that have no faults
            starts[own] = place
            starts |= {(*own, *steps): (*place, *where) for steps, where in read[1].items()}
            jobs.append(read[0])
    places = _read_list(document, "charging", "give a list of places", faults)
    charging = [
        faults.attempt(("charging", index), on.find, place) if on else None
        for index, place in enumerate(places)
    ]
    return ReadWork(
        jobs=tuple(jobs) if "jobs" in document else None,
        batteries=tuple(_read_batteries(document, faults)),
        charging=tuple(place for place in charging if place is not None),
        starts=starts,
        names=frozenset(_list_names(document)),
    )


def _read_list(document: Mapping[str, Any], key: str, remedy: str, faults: Faults) -> Sequence[Any]:
    data = document.get(key, [])
    if isinstance(data, list):
        return data
    faults.note(key, f"{quote(data)} is no list ({remedy})")
    return []


def _read_batteries(document: Mapping[str, Any], faults: Faults) -> Iterator[tuple[str, Battery]]:
    from rightofway.io.scenario.work_shape import BatteryDocument

    data = document.get("batteries", {})
    if not isinstance(data, dict):
        remedy = "give for each battery its name and {drive, on, work, charge, reserve}"
        faults.note("batteries", f"{quote(data)} is no mapping of names to batteries ({remedy})")
        return
    for name, battery_data in data.items():
        battery = faults.attempt(("batteries", name), validate, BatteryDocument, battery_data)
        if battery is not None:
            yield str(name), Battery(**battery.get_given(*BatteryDocument.fields))


def read_job(data: Any, on: LoadedMap) -> Job:
    """Return the job of a document on a map.

    Raises
    ------
    InputError
        With every fault of the document.
    """
    read = _read_job(data, on)
    assert read is not None, "there is a map"
    return read[0]


def _read_job(data: Any, on: LoadedMap | None) -> tuple[Job, dict[Steps, Steps]] | None:
    """Return a job, and for places of its stops those of the document; without a map, None."""
    from rightofway.io.scenario.work_shape import JobDocument

    document: JobDocument = validate(JobDocument, data, on)
    if on is None:
        return None
    stops, starts = list[JobStop](), dict[Steps, Steps]()
    for keys, values in _list_stops(document):
        starts |= {("stops", len(stops), name): key for name, key in keys.items()}
        stops.append(JobStop(**values))
    job = Job(
        name=document.name,
        stops=tuple(stops),
        types=tuple(document.types or ()),
        after=tuple(document.after or ()),
        **document.get_given("weight", "due", "robot", "load_id", "load_type"),
    )
    return job, starts


def _list_stops(document: JobDocument) -> Iterator[tuple[dict[str, Steps], dict[str, Any]]]:
    """Yield where values of each stop of a job are in the job's document, and the values."""
    if document.stops is not None:
        last = len(document.stops) - 1
        for number, stop in enumerate(document.stops):
            ends = document.get_given(
                *(("earliest",) if number == 0 else ()), *(("latest",) if number == last else ())
            )
            values = stop.get_given("at", "work", "load", "earliest", "latest", "actions")
            yield {key: (key,) for key in ends}, values | ends
    elif document.at is not None:
        given = document.get_given("work", "earliest", "latest", "actions")
        yield {key: (key,) for key in ("at", *given)}, {"at": document.at, **given}
    else:
        load = 1 if document.load is None else document.load
        for place, sign, time in (("pickup", 1, "earliest"), ("dropoff", -1, "latest")):
            given, work = document.get_given(time), getattr(document, f"{place}_work")
            values = {"at": getattr(document, place), "load": sign * load, **given}
            if work is not None:
                values["work"] = work
            if actions := getattr(document, f"{place}_actions"):
                values["actions"] = actions
            keys: dict[str, Steps] = {key: (key,) for key in (time, "load")}
            of_place = {key: (f"{place}_{key}",) for key in ("work", "actions")}
            yield keys | {"at": (place,), **of_place}, values


def read_state(
    document: StateDocument | None, places: Mapping[Steps, VertexId], home: VertexId
) -> RobotState | None:
    """Return the state of a robot whose places were found; None for none."""
    if document is None:
        return None
    return RobotState(
        at=places.get(("start", "at"), home),
        begun=tuple((document.begun or {}).items()),
        **document.get_given("ready", "heading", "soc"),
    )


def _list_names(document: Mapping[str, Any]) -> Iterator[str]:
    """Yield the names of robots, jobs and batteries, also of those with faults."""
    for key in ("robots", "jobs"):
        parts = document.get(key)
        for part in parts if isinstance(parts, list) else ():
            if isinstance(part, dict):
                yield str(part.get("name"))
    batteries = document.get("batteries")
    yield from map(str, batteries if isinstance(batteries, dict) else ())
