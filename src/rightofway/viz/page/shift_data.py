"""A shift as its page reads it: the plan of what robots have done, its figures and its rounds."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator

from rightofway.dispatch import ShiftRecord
from rightofway.dispatch.figures import RobotUse, ShiftFigures, measure_shift
from rightofway.facts import Fact
from rightofway.files import write_whole
from rightofway.kinds.table import TEXT
from rightofway.model import Plan, Tick
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import PhraseBook
from rightofway.report.quantities import Quantities
from rightofway.report.shift import describe_unserved
from rightofway.viz.motion import make_trips
from rightofway.viz.page.background import Background
from rightofway.viz.page.document import make_document
from rightofway.viz.page.payload import add_names, make_bare_payload, trace_line
from rightofway.viz.page.schema import Payload, ShiftData, SliceRow, UseRow, WorkData
from rightofway.viz.page.work_data import make_work_data

SLICES = 32
"""Parts of a shift in the curves over time; more would be narrower than their marks."""

SHOWN_WAITS, SHOWN_PLACES = 5, 20
"""Robots that one robot waited for, and places where robots waited."""

MOST_IN_LINE = 4
"""Robots up to which places are drawn over time; the lines of more hide each other in a shift."""


def make_shift_payload(
    record: ShiftRecord, *, title: str = "", background: Background | None = None
) -> Payload:
    """Return the content of the page of a shift, as plain data for JSON; times are ticks.

    All that robots have done is a plan that nobody has made: it has no planner, no bound and no
    faults.
    """
    plan, figures = record.make_plan(), measure_shift(record, slices=SLICES)
    book = PhraseBook()
    payload = make_bare_payload(plan, make_trips(plan), book, title=title, background=background)
    payload["end"] = max(record.until, 1)
    for robot in payload["robots"]:
        robot["idles"] = True
    if len(payload["robots"]) <= MOST_IN_LINE:
        payload["line"] = trace_line(plan, ())
    add_names(plan.scenario, payload, book)
    payload["work"] = _make_work(record, plan, book)
    payload["shift"] = _make_shift(record, plan, figures, book)
    return payload


def make_shift_page(
    record: ShiftRecord, *, title: str = "", background: Background | None = None
) -> str:
    """Return a page that plays a shift, as one HTML document.

    Parameters
    ----------
    record
        The shift.
    title, background
        As for `make_page`.

    Returns
    -------
    str
        HTML. Its content security policy forbids any connection, and any script but our own.
    """
    title = TEXT.read_at("title", title)
    count = len(record.scenario.robots)
    robots = f"{count} robot{'s' * (count != 1)}"
    about = f"{title}: a shift of {robots}" if title else f"a shift of {robots}"
    payload = make_shift_payload(record, title=title, background=background)
    return make_document(about, payload, "shift_main")


def write_shift_page(
    record: ShiftRecord,
    path: str | os.PathLike[str],
    *,
    title: str = "",
    background: Background | None = None,
) -> None:
    """Write a page that plays a shift; the file is complete, or not written.

    Parameters
    ----------
    record, title, background
        As for `make_shift_page`.
    path
        Where, usually ``….html``.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    write_whole(path, make_shift_page(record, title=title, background=background))


def _make_work(record: ShiftRecord, plan: Plan, book: PhraseBook) -> WorkData:
    """Return jobs and tours; a job has its robot once it is begun, and its times once it ended."""
    measured = [[(Tick(at), soc) for at, soc in own.soc] for own in record.robots]
    data = make_work_data(plan, book, measured=measured)
    for job, own in zip(data["jobs"], record.jobs.values(), strict=True):
        if own.ended is None:
            job.pop("times", None)
            if own.robot is not None:
                job["robot"] = own.robot
            if own.reason is None:
                job.pop("reason", None)
    return data


def _make_shift(
    record: ShiftRecord, plan: Plan, figures: ShiftFigures, book: PhraseBook
) -> ShiftData:
    writer = FactWriter(plan.scenario, Quantities.of(plan.scenario))
    drawn = plan.scenario.roadmap.get_drawn
    places = Counter[int]()
    for vertex, ticks in figures.bottlenecks:
        places[drawn(vertex)] += ticks
    data: ShiftData = {
        "until": record.until,
        "done": figures.done,
        "late": figures.late,
        "underWay": figures.under_way,
        "unserved": [
            (book.add(writer.write(describe_unserved(reason))), count)
            for reason, count in figures.unserved
        ],
        "slices": list(_list_slices(figures)),
        "known": [own.known for own in record.jobs.values()],
        "robots": [_make_use(own) for own in figures.robots],
        "waits": [list(own.waits_for[:SHOWN_WAITS]) for own in figures.robots],
        "bottlenecks": places.most_common(SHOWN_PLACES),
        "rounds": [
            (own.begin, own.takeover, round(1000 * own.seconds), own.jobs, int(own.stands))
            for own in record.rounds
        ],
        "told": [
            (index, book.add(writer.write(fact)))
            for index, own in enumerate(record.rounds)
            for fact in (*own.reasons, *own.facts)
        ],
        "happened": [(tick, book.add(writer.write(fact))) for tick, fact in _list_events(record)],
    }
    service = figures.service
    if service.median is not None and service.p95 is not None and service.max is not None:
        data["service"] = (service.median, service.p95, service.max)
    return data


def _list_slices(figures: ShiftFigures) -> Iterator[SliceRow]:
    for part in figures.slices:
        yield part.end, part.done, part.late, part.service.median, part.service.p95


def _make_use(own: RobotUse) -> UseRow:
    return own.jobs, own.driving, own.waiting, own.working, own.charging, own.idle


def _list_events(record: ShiftRecord) -> Iterator[tuple[int, Fact]]:
    """Yield what the shift has to tell, and when robots stop for good, in order."""
    lost = [
        (own.lost, Fact("robot does not go on", record.scenario, robot=robot))
        for robot, own in enumerate(record.robots)
        if own.lost is not None
    ]
    yield from sorted([*record.facts, *lost], key=lambda event: event[0])
