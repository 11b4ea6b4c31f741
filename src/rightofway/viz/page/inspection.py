"""The page of an inspection: a site drawn, its weaknesses as a list. Nothing is planned."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import cast

from rightofway.facts import Fact
from rightofway.files import write_whole
from rightofway.metrics import Inspection, Site
from rightofway.report.facts import write_note, write_notes
from rightofway.report.inspection import (
    SEVERITIES,
    describe_finding,
    describe_site,
    name_severity,
    write_heading,
)
from rightofway.report.phrases import to_parts
from rightofway.viz.page.background import Background
from rightofway.viz.page.document import make_document
from rightofway.viz.page.map_data import map_data
from rightofway.viz.page.schema import InspectionPayload, LevelData, SiteData, UnitsData
from rightofway.viz.palette import choose_colours

Inspected = tuple[str, Site, Inspection]
"""The name of a level, empty where there is only one, the site, and what was found."""


def make_inspection_page(
    levels: Sequence[Inspected],
    *,
    title: str,
    description: str | Fact = "",
    notes: Sequence[str | Fact] = (),
    background: Background | None = None,
) -> str:
    """Return a page that shows an inspection, as one HTML document.

    Parameters
    ----------
    levels
        The inspected sites.
    title
        The subject of the page, usually the name of the file.
    description
        Kind and size of the file.
    notes
        Pieces that its reader mended or left out, and warnings.
    background
        A picture under the map; by default that of the layout.

    Returns
    -------
    str
        HTML. Its content security policy forbids any connection, and any script but our own.

    Raises
    ------
    InputError
        If a picture cannot be read.
    """
    text = write_note(description)
    payload: InspectionPayload = {
        "title": title,
        "description": to_parts(text),
        "notes": to_parts(write_notes(notes)),
        "names": {severity: to_parts(name_severity(severity)) for severity in SEVERITIES},
        "headings": {severity: to_parts(write_heading(severity)) for severity in SEVERITIES},
        "levels": [_make_level(*level, background) for level in levels],
    }
    about = f"{title}: {text}" if text else title
    return make_document(about, payload, "inspect_main")


def write_inspection(
    levels: Sequence[Inspected],
    path: str | os.PathLike[str],
    *,
    title: str,
    description: str | Fact = "",
    notes: Sequence[str | Fact] = (),
    background: Background | None = None,
) -> None:
    """Write the page of an inspection; the file is complete, or not written.

    Parameters
    ----------
    levels, title, description, notes, background
        As for `make_inspection_page`.
    path
        Where, usually ``….html``.

    Raises
    ------
    InputError
        As for `make_inspection_page`, or if the file cannot be written.
    """
    page = make_inspection_page(
        levels, title=title, description=description, notes=notes, background=background
    )
    write_whole(path, page)


def make_site_data(site: Site, background: Background | None = None) -> SiteData:
    """Return a site as plain data for JSON: the map, and robots at their homes.

    Parameters
    ----------
    site
        The roadmap, its places, and the fleet if there is one.
    background
        A picture under the map; by default that of the roadmap's drawing.

    Raises
    ------
    InputError
        If the picture cannot be read.
    """
    colours = choose_colours(len(site.robots))
    return {
        "units": cast("UnitsData", site.units.to_document()),
        "tick": (1, 1),
        "clearance": float(site.rules.clearance),
        "map": map_data(site.roadmap, room=site.room, background=background),
        "robots": [
            {
                "name": robot.name,
                "colour": colour,
                "speed": str(robot.speed),
                "radius": float(robot.radius),
                "vertices": [int(robot.home)],
                "enter": [0],
                "drive": [0],
                "stages": [(int(stop.at), 0, 0, -1) for stop in robot.stops],
                "completion": 0,
                "alone": 0,
                "lost": (0, 0, 0),
            }
            for robot, colour in zip(site.robots, colours, strict=True)
        ],
    }


def _make_level(
    name: str, site: Site, inspection: Inspection, background: Background | None
) -> LevelData:
    robot_of = {robot.name: index for index, robot in enumerate(site.robots)}
    described = ((finding, describe_finding(site, finding)) for finding in inspection.findings)
    return {
        "name": name,
        "sentences": [to_parts(sentence) for sentence in describe_site(site, inspection)],
        **make_site_data(site, background),
        "findings": [
            {
                "severity": finding.severity,
                "kind": finding.kind,
                "fact": to_parts(fact),
                "remedy": to_parts(remedy),
                "vertices": [int(site.roadmap.get_vertex(vertex)) for vertex in finding.vertices],
                "robots": [robot_of[robot] for robot in finding.robots],
            }
            for finding, (fact, remedy) in described
        ],
    }
