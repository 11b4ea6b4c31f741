"""Files of shifts: the scenario, what robots have done, jobs, rounds and facts, as JSON."""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.dispatch.pool import PoolEvent
from rightofway.dispatch.record import (
    DoneStep,
    JobRecord,
    RobotRecord,
    RoundRecord,
    ShiftRecord,
)
from rightofway.errors import InputError, name_file
from rightofway.facts import read_fact
from rightofway.io.collector import pause_garbage_collection
from rightofway.io.content import read_text
from rightofway.io.faults import validate
from rightofway.io.formats import SHIFT_FORMAT, check_format
from rightofway.io.json_text import parse_json
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.reader import parse_scenario
from rightofway.io.scenario.work import read_job
from rightofway.io.scenario.work_writer import dump_job
from rightofway.io.scenario.writer import dump_scenario
from rightofway.kinds.numbers import format_number
from rightofway.model import Job, Scenario, Tick
from rightofway.site import Roadmap

__all__ = ["dump_shift", "load_shift", "parse_shift"]


def dump_shift(record: ShiftRecord) -> dict[str, Any]:
    """Return the document of a shift; times are in ticks, vertices are names.

    Parameters
    ----------
    record
        The shift.
    """
    scenario = record.scenario
    roadmap = scenario.roadmap
    return {
        "format": SHIFT_FORMAT,
        "scenario": dump_scenario(scenario),
        "tick": format_number(scenario.problem.clock.tick),
        "until": record.until,
        "robots": [
            {"name": robot.name, **_dump_robot(own, roadmap)}
            for robot, own in zip(scenario.robots, record.robots, strict=True)
        ],
        "jobs": [_dump_job(own, roadmap) for own in record.jobs.values()],
        "rounds": [
            {
                "begin": own.begin,
                "takeover": own.takeover,
                "seconds": round(own.seconds, 3),
                "jobs": own.jobs,
                "stands": own.stands,
                "facts": [fact.as_dict() for fact in own.facts],
                "reasons": [fact.as_dict() for fact in own.reasons],
            }
            for own in record.rounds
        ],
        "events": [event.to_document(roadmap) for event in record.events],
        "facts": [{"at": tick, **fact.as_dict()} for tick, fact in record.facts],
    }


def _dump_robot(own: RobotRecord, roadmap: Roadmap) -> dict[str, Any]:
    names = {at: roadmap.name(at) for at in set(own.vertices)}
    return {
        "vertices": [names[at] for at in own.vertices],
        "enter": own.enter.tolist(),
        "tour": [
            {"visit": step.visit, "begin": step.begin, "end": step.end, **_dump_work(step)}
            for step in own.steps
        ],
        "soc": [[tick, format_number(soc)] for tick, soc in own.soc],
        "drives": own.drives,
        "turns": own.turns,
        "waits": [list(pair) for pair in own.waits.most_common()],
        "waits_at": [[roadmap.name(at), ticks] for at, ticks in own.waits_at.most_common()],
        "lost": own.lost,
    }


def _dump_work(step: DoneStep) -> dict[str, Any]:
    return {"job": step.job, "stop": step.stop} if step.job else {"charge": True}


def _dump_job(own: JobRecord, roadmap: Roadmap) -> dict[str, Any]:
    return {
        "job": dump_job(own.job, roadmap),
        "known": own.known,
        "robot": own.robot,
        "begun": own.begun,
        "ended": own.ended,
        "reason": own.reason,
    }


def parse_shift(document: Mapping[str, Any]) -> ShiftRecord:
    """Return the shift of a document that `dump_shift` has made.

    Parameters
    ----------
    document
        The document.

    Raises
    ------
    InputError
        If it is of another format, or with every key that is missing or has another kind of value.
    """
    from rightofway.io.shift import ShiftFrame

    document = check_format(document, SHIFT_FORMAT)
    validate(ShiftFrame, document)
    try:
        return _parse(document)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        if isinstance(error, InputError):
            raise
        message = f"is no whole record of a shift ({error}; write it again with shift -o)"
        raise InputError.at("", message) from error


def _parse(document: Mapping[str, Any]) -> ShiftRecord:
    scenario = parse_scenario(document["scenario"])
    roadmap = scenario.roadmap
    on, read = LoadedMap(roadmap=roadmap), _JobReader(scenario, document["scenario"]).read
    jobs = {}
    for own in document["jobs"]:
        job = read(own["job"], on)
        values = {key: own[key] for key in ("robot", "begun", "ended", "reason")}
        jobs[job.name] = JobRecord(job=job, known=Tick(own["known"]), **values)
    return ShiftRecord(
        scenario=scenario,
        until=Tick(document["until"]),
        robots=tuple(_parse_robot(own, roadmap) for own in document["robots"]),
        jobs=jobs,
        rounds=tuple(
            RoundRecord(
                **{
                    **own,
                    "seconds": float(own["seconds"]),
                    "facts": tuple(map(read_fact, own["facts"])),
                    "reasons": tuple(map(read_fact, own["reasons"])),
                }
            )
            for own in document["rounds"]
        ),
        events=tuple(PoolEvent.of_document(event, roadmap, read) for event in document["events"]),
        facts=tuple((Tick(own["at"]), read_fact(own, scenario)) for own in document["facts"]),
    )


class _JobReader:
    """A reader of jobs that reads each document once: files have those of a scenario thrice."""

    def __init__(self, scenario: Scenario, document: Mapping[str, Any]) -> None:
        documents = document.get("jobs") or ()
        pairs = zip(documents, scenario.jobs or (), strict=True)
        self._known = {job.name: (own, job) for own, job in pairs}

    def read(self, document: Any, on: LoadedMap) -> Job:
        """Return the job of a document, as `read_job`."""
        name = document.get("name") if isinstance(document, dict) else None
        known = self._known.get(name) if isinstance(name, str) else None
        return known[1] if known and known[0] == document else read_job(document, on)


def _read_share(text: int | str) -> Fraction:
    """Return a fraction as `format_number` writes it."""
    numerator, _, denominator = str(text).partition("/")
    return Fraction(int(numerator), int(denominator or 1))


def _parse_robot(own: Mapping[str, Any], roadmap: Roadmap) -> RobotRecord:
    vertices = {name: roadmap.get_vertex(name) for name in set(own["vertices"])}
    return RobotRecord(
        vertices=array("i", map(vertices.__getitem__, own["vertices"])),
        enter=array("q", own["enter"]),
        steps=[
            DoneStep(
                step["visit"], step["begin"], step["end"], step.get("job", ""), step.get("stop", 0)
            )
            for step in own["tour"]
        ],
        soc=[(tick, _read_share(soc)) for tick, soc in own["soc"]],
        drives=own["drives"],
        turns=own["turns"],
        waits=Counter(dict(own["waits"])),
        waits_at=Counter({roadmap.get_vertex(at): ticks for at, ticks in own["waits_at"]}),
        lost=own["lost"],
    )


def load_shift(path: Path | str) -> ShiftRecord:
    """Return the shift of a file.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    InputError
        As `parse_shift`, with the file.
    """
    with name_file(str(path)), pause_garbage_collection():
        return parse_shift(parse_json(read_text(Path(path))))
