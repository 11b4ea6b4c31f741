"""Files of jobs, recognized by content: CSV, documents of jobs, and orders of other programs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, Location, Steps, name_file
from rightofway.io.content import read_text
from rightofway.io.documents import parse_document
from rightofway.io.layouts.xml_tree import parse_xml
from rightofway.io.locations import add_lines
from rightofway.io.orders import open_rmf, opentcs
from rightofway.io.orders.draft import OrderFile, locate_file, make_documents, read_instant
from rightofway.io.source import Source
from rightofway.io.tables import CellDocument, read_csv, read_jobs_of_rows

KINDS = (
    "a .csv file, a list of jobs as YAML or JSON, transport orders of openTCS as JSON or XML, or "
    "task requests of Open-RMF as JSON"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class OrderTimes:
    """How orders of other programs become times of a scenario.

    Attributes
    ----------
    begin
        The instant of time 0, as written; None for `start`.
    start
        The start of the scenario; None for the first instant of the file.
    work
        The work time at stops without one [time unit]; None for none.
    second
        A second [time unit].
    """

    begin: str | None = None
    start: str | None = None
    work: Fraction | None = None
    second: Fraction = Fraction(1)


def read_jobs_of_file(
    path: Path, times: OrderTimes, known: Iterable[str], names_it: Steps
) -> CellDocument:
    """Return the jobs of a file that a document names.

    Raises
    ------
    InputError
        If it has no kind that is known, or orders that cannot be read, each with its place.
    """
    if path.suffix.lower() == ".csv":
        _refuse_times(times)
        rows, cell = read_csv(path, names_it)
        return read_jobs_of_rows(rows, cell, known)
    with name_file(str(path)):
        text = read_text(path)
        if text.lstrip().startswith("<"):
            return _place(_read_xml(text), times, path, "", names_it)
        with add_lines(text):
            data = parse_document(text, path)
            orders = _read_orders(data, path)
            if orders is not None:
                return _place(orders, times, path, text, names_it)
            return _read_own(data, times, path, text, names_it)


def _refuse_times(times: OrderTimes) -> None:
    for key in ("begin", "work"):
        if getattr(times, key) is not None:
            message = "is for orders of openTCS and Open-RMF (write it into the jobs)"
            raise InputError.at(key, message)


def _read_xml(text: str) -> OrderFile:
    root = parse_xml(text)
    if not opentcs.recognizes_xml(root):
        raise root.make_fault(f"<{root.name}> has no jobs (give a tcsOrderSet of openTCS)")
    return opentcs.read_xml(root)


def _read_orders(data: Any, path: Path) -> OrderFile | None:
    """Return the orders of plain data, or None if they are of no other program."""
    if opentcs.recognizes(data):
        return opentcs.read_json(data, path.stem)
    return open_rmf.read_json(data) if open_rmf.recognizes(data) else None


def _read_own(data: Any, times: OrderTimes, path: Path, text: str, names_it: Steps) -> CellDocument:
    """Return a list of jobs, or those of a document."""
    _refuse_times(times)
    steps = ("jobs",) if isinstance(data, dict) and "jobs" in data else ()
    jobs = data["jobs"] if steps else data
    if not isinstance(jobs, list):
        raise InputError.at("", f"has no list of jobs (give {KINDS})")
    location = Location(file=str(path), path=steps).nest(names_it)
    return CellDocument(part=jobs, cells={("jobs",): location}, text=text)


def _place(
    orders: OrderFile, times: OrderTimes, path: Path, text: str, names_it: Steps
) -> CellDocument:
    """Return orders as jobs, with the places of their values in the file."""
    orders.faults.stop()
    given = times.begin or times.start
    begin = None if given is None else read_instant(Source(given, ("begin",)))
    work = (times.work or Fraction(0)) / times.second
    jobs, places = make_documents(orders, begin, work, times.second)
    return CellDocument(
        part=jobs,
        cells=locate_file(places, str(path), names_it),
        text=text,
        notes=tuple(orders.list_notes()),
    )
