"""The view of a document in an editor after each change, faults or not."""

from __future__ import annotations

import contextlib
from collections import OrderedDict
from collections.abc import Hashable, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, InputFault
from rightofway.facts import Fact
from rightofway.io import Loaded, dump_scenario
from rightofway.io.faults import list_keys, validate
from rightofway.io.scenario.loaded_map import FleetTraits
from rightofway.io.scenario.maps import map_of
from rightofway.io.scenario.picture import add_picture
from rightofway.io.sites import make_sites
from rightofway.io.tables import read_jobs_of_rows, split_rows
from rightofway.metrics import Inspection, Site, inspect
from rightofway.metrics.site import Finding
from rightofway.report.facts import write_notes
from rightofway.report.inspection import describe_finding, describe_site, export_finding
from rightofway.report.phrases import to_parts
from rightofway.studio.messages import Blobs, Emit, as_fault_data, zip_text
from rightofway.studio.tasks.documents import as_plain, compute_digest, load_document
from rightofway.units import Units
from rightofway.viz import make_site_data
from rightofway.viz.page.background import find_background, place_background
from rightofway.viz.page.document import as_compact_json
from rightofway.viz.page.map_data import mark_charging_places
from rightofway.viz.page.payload import make_closure_data
from rightofway.viz.page.schema import ClosureData, SiteData
from rightofway.viz.palette import choose_colours

Result = tuple[Any, ...]

SHOWN = (".png", ".jpg", ".jpeg", ".webp", ".bmp")
"""Endings of pictures that a browser shows as they are."""

KEPT = 8
"""Sites whose findings a worker keeps: a change of a speed or of a work time changes none."""

_findings: OrderedDict[Hashable, Inspection] = OrderedDict()


def survey_document(
    _emit: Emit,
    _blobs: Blobs,
    *,
    document: dict[str, Any],
    folder: str,
    inspects: bool = True,
    identifies: bool = False,
) -> Result:
    """Return faults, notes, the map with all robots that have no fault, and its weaknesses.

    A robot of the site has the `index` that it has in the document. The site is null where the map
    itself has faults. With `identifies`, ``scenario`` is the digest that plans of this scenario
    have among their figures; null where the document has faults.
    """
    notes = tuple[str | Fact, ...]()
    site, closures = None, list[ClosureData]()
    loaded, kept_robots, faults = read_readable(document, folder)
    if loaded is not None:
        scenario, notes = loaded.scenario, loaded.notes
        ((_, site),) = make_sites(scenario, notes).sites
        closures = [make_closure_data(closure, scenario) for closure in scenario.closures]
    else:
        site = read_map(document, folder)
    answer: dict[str, Any] = {
        "ok": not faults,
        "faults": [as_fault_data(fault) for fault in faults],
        "notes": to_parts(write_notes(notes)),
        "site": None,
        "findings": [],
        "sentences": [],
        "phrases": [],
    }
    if identifies:
        answer["scenario"] = None if loaded is None or faults else compute_digest(loaded.scenario)
    if site is not None:
        drawn = _draw_site(site)
        work = None if loaded is None else loaded.scenario.problem.work
        if work is not None:
            mark_charging_places(drawn["map"], work)
        colours = choose_colours(1 + max(kept_robots, default=0))
        for robot, index in zip(drawn["robots"], kept_robots, strict=False):
            robot |= {"index": index, "colour": colours[index]}
        answer["site"] = {**drawn, "closures": closures}
    if site is not None and inspects:
        inspection = _get_inspection(site)
        said = describe_site(site, inspection)
        answer |= {
            "findings": [_make_finding_data(site, finding) for finding in inspection.findings],
            "sentences": list(said),
            "phrases": [to_parts(sentence) for sentence in said],
        }
    return (None, zip_text(as_compact_json(answer)))


def _make_finding_data(site: Site, finding: Finding) -> dict[str, Any]:
    fact, remedy = describe_finding(site, finding)
    phrases = {"fact": to_parts(fact), "remedy": to_parts(remedy)}
    return {**export_finding(site, finding), "phrases": phrases}


def _get_inspection(site: Site) -> Inspection:
    """Inspect a site; the findings of the latest ones are kept."""
    gist = site.gist
    if gist not in _findings:
        _findings[gist] = inspect(site)
    _findings.move_to_end(gist)
    if len(_findings) > KEPT:
        _findings.popitem(last=False)
    return _findings[gist]


def read_readable(
    document: dict[str, Any], folder: str
) -> tuple[Loaded | None, list[int], Sequence[InputFault]]:
    """Return the scenario of a document, which robots it has, and the faults of the document.

    It is without the parts that have faults, and None where the map has some.
    """
    try:
        return load_document(document, folder), list(_list_robots(document)), ()
    except InputError as error:
        return *_read_without(document, folder, error.faults), error.faults


def _draw_site(site: Site) -> SiteData:
    """Return a site for the editor, which has the picture of a scenario in its own memory."""
    roadmap = site.roadmap
    picture, background = roadmap.drawing.picture, find_background(roadmap)
    if background is None or picture is None or not picture.name.lower().endswith(SHOWN):
        return make_site_data(site)
    bare = replace(roadmap, drawing=replace(roadmap.drawing, picture=None))
    drawn = make_site_data(replace(site, roadmap=bare))
    drawn["map"]["background"] = place_background(roadmap, background)
    return drawn


def _list_robots(document: dict[str, Any]) -> range:
    robots = document.get("robots")
    return range(len(robots) if isinstance(robots, list) else 0)


def _read_without(
    document: dict[str, Any], folder: str, faults: Sequence[InputFault]
) -> tuple[Loaded | None, list[int]]:
    """Return the scenario without its faulty parts, and which robots it has; or None, and none.

    A robot whose home is right stays, without the keys that have faults: it is seen where it is.
    """
    wrong: dict[int, set[str]] = {}
    for fault in faults:
        section, index, key = (*fault.path, "", "", "")[:3]
        if section == "robots" and isinstance(index, int):
            wrong.setdefault(index, set()).add(str(key))
    sections = {str(fault.path[0]) for fault in faults if fault.path}
    if "batteries" in sections:
        for at in _list_robots(document):
            wrong.setdefault(at, set()).add("battery")
    rest = _leave_out(document, sections)
    drawn = [
        _make_mended(document["robots"][at], wrong.get(at, set()), has_trips="jobs" not in document)
        for at in _list_robots(document)
    ]
    whole = [None if at in wrong else document["robots"][at] for at in _list_robots(document)]
    for robots in (drawn, whole):
        kept_robots = [index for index, robot in enumerate(robots) if robot is not None]
        if kept_robots:
            try:
                return load_document(
                    {**rest, "robots": [robots[at] for at in kept_robots]}, folder
                ), kept_robots
            except InputError:
                pass
    return None, []


def _leave_out(document: dict[str, Any], sections: set[str]) -> dict[str, Any]:
    """Return a document without sections that have faults; robots without trips keep no jobs."""
    rest = {
        key: value
        for key, value in document.items()
        if key not in sections or key not in {"closures", "rules", "batteries", "charging"}
    }
    return {**rest, "jobs": []} if sections & {"jobs", "batteries", "charging"} else rest


def _make_mended(robot: Any, wrong: set[str], *, has_trips: bool) -> Any:
    """Return a robot without the keys that are wrong; it stays at home without a stop."""
    if not isinstance(robot, dict) or wrong & {"name", "home"}:
        return robot if not wrong else None
    read_values = {key: value for key, value in robot.items() if key not in wrong}
    if "" in wrong:  # the keys do not fit each other
        read_values = {key: value for key, value in read_values.items() if key in {"name", "home"}}
    if has_trips and wrong and not read_values.keys() & {"target", "stops"}:
        read_values = {key: value for key, value in read_values.items() if key != "work"}
        read_values["target"] = read_values.get("home")
    return read_values


def read_map(document: dict[str, Any], folder: str) -> Site | None:
    """Return the map of a document whose robots cannot be read; None if it cannot either.

    A picture that has a fault is left out.
    """
    from rightofway.io.scenario.shape import MapDocument, PictureDocument, UnitsDocument

    drawn = document.get("map")
    picture = drawn.get("picture") if isinstance(drawn, dict) else None
    if isinstance(drawn, dict):
        drawn = {key: value for key, value in drawn.items() if key != "picture"}
    try:
        given = validate(UnitsDocument, document.get("units") or {}).get_given("length", "time")
        shape = validate(MapDocument, drawn)
        loaded = map_of(shape, Path(folder), Units(**given), FleetTraits(speeds=[Fraction(1)]))
    except InputError:
        return None
    if loaded is None:
        return None
    if picture is not None:
        with contextlib.suppress(InputError):
            loaded = add_picture(loaded, validate(PictureDocument, picture), Path(folder))
    units = loaded.units if loaded.units.length else Units(**given)
    return Site(roadmap=loaded.roadmap, units=units)


def inline_document(_emit: Emit, _blobs: Blobs, *, document: dict[str, Any], folder: str) -> Result:
    """Return a document whose map and robots are in it, not in other files; a map may be alone."""
    site = read_map(document, folder) if document.get("robots") == [] else None
    if site is None:
        return ({"document": as_plain(dump_scenario(load_document(document, folder).scenario))},)
    place = site.roadmap.name(0)  # a scenario has a robot; this one stands there until it is dumped
    stands = {**document, "robots": [{"name": "R1", "home": place, "target": place}]}
    whole = as_plain(dump_scenario(load_document(stands, folder).scenario))
    return ({"document": {**whole, "robots": []}},)


def read_pasted_jobs(_emit: Emit, _blobs: Blobs, *, text: str) -> Result:
    """Return the jobs of rows that were copied from a spreadsheet, as the reader of files does.

    Raises
    ------
    InputError
        With every fault of the rows.
    """
    from rightofway.io.scenario.work_shape import JobDocument

    rows, cell = split_rows(text, ("jobs",))
    table = read_jobs_of_rows(rows, cell, list_keys(JobDocument))
    with table.locate():
        return ({"jobs": table.part},)
