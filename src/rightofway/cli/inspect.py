"""``rightofway inspect``: kind and size of a layout, map or scenario, and its weaknesses."""

from __future__ import annotations

from dataclasses import asdict, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import SCENARIOS, complete_files
from rightofway.cli.inputs import jobs_option
from rightofway.cli.options import Whole, as_json_option
from rightofway.cli.outputs import make_output_option, make_page_option, put_text, refuse_outputs
from rightofway.cli.terminal import (
    format_json,
    make_title,
    put_json,
    put_report,
    say_written,
)
from rightofway.report.lines import lay_out

if TYPE_CHECKING:
    from rightofway.io.sites import Sites
    from rightofway.metrics import Inspection, Site

EXAMPLES = """\b
Examples:
  rightofway inspect hall.lif.json
  rightofway inspect hall.lif.json --robots fleet.csv
  rightofway inspect hall.lif.json --page hall.html
  rightofway inspect examples/door.yaml --json
"""


@click.command(epilog=EXAMPLES, short_help="Report problems of a layout, map or scenario.")
@click.argument(
    "source",
    type=click.Path(),
    metavar="FILE",
    shell_complete=complete_files(*SCENARIOS, ".xml", ".graphml", ".geojson", ".csv", ".map"),
)
@click.option(
    "--robots",
    "fleet",
    metavar="FILE",
    type=click.Path(),
    shell_complete=complete_files(".yaml", ".yml", ".json", ".csv"),
    help="Inspect the site for the robots of this file: a scenario, a list of robots, or a CSV.",
)
@jobs_option
@click.option("--level", metavar="NAME", help="Inspect only this level of a layout.")
@click.option("--vehicle-type", metavar="NAME", help="Inspect the lanes of this vehicle type.")
@click.option(
    "--cell-size",
    metavar="SIZE",
    callback=lambda _c, _p, given: _read_size(given),
    help="Side of the cells that a map in pixels is cut into [m]; 0.5 by default.",
)
@click.option(
    "--limit",
    type=Whole(1),
    default=5,
    show_default=True,
    metavar="N",
    help="Findings to list of each kind; all are counted.",
)
@make_output_option("the report", ".json", ".txt")
@make_page_option("the findings on the map", "shows")
@as_json_option("report")
def inspect(
    *,
    source: str,
    fleet: str | None,
    jobs: str | None,
    level: str | None,
    vehicle_type: str | None,
    cell_size: Fraction | None,
    limit: int,
    output: str | None,
    page: str | None,
    as_json: bool,
) -> None:
    """Report the kind and size of FILE, repairs made while reading, and problems.

    FILE is a scenario, a map, or a layout of another program. Each finding has a place and a
    remedy: places that cannot be reached or left, vertices and lanes that are too near for the
    robots, lanes that cross without a vertex, places on the only way to others, corridors without
    a passing place, bottlenecks, and jobs that no robot can do alone. Nothing is planned.
    """
    from rightofway.io.sites import Choice, read_sites
    from rightofway.metrics import inspect as inspected
    from rightofway.report.inspection import report_inspection

    refuse_outputs(source, output, as_json=as_json)
    choice = Choice(level=level, vehicle_type=vehicle_type, cell_size=cell_size)
    sites = read_sites(source, choice, fleet, jobs)
    results = [(name, site, inspected(site)) for name, site in sites.sites]
    data = _make_data(source, sites, results)
    if page is not None:
        from rightofway.viz import write_inspection

        title = make_title(source)
        write_inspection(
            results, page, title=title, description=sites.description, notes=sites.notes
        )
        say_written(page)
    if as_json or (output or "").lower().endswith(".json"):
        if as_json:
            put_json(data)
        if output not in (None, "-"):
            put_text(f"{format_json(data)}\n", output)
        return
    report = report_inspection(source, sites.description, sites.notes, results, limit)
    if output not in (None, "-"):
        put_text(f"{lay_out(report)}\n", output)
    else:
        put_report(report)


def _read_size(given: str | None) -> Fraction | None:
    if given is None:
        return None
    try:
        size = Fraction(given)
    except (ValueError, ZeroDivisionError):
        size = Fraction(0)
    if size <= 0:
        raise click.BadParameter(f"{given!r} is no length (give metres, like 0.5)")
    return size


def _make_data(
    source: str, sites: Sites, results: list[tuple[str, Site, Inspection]]
) -> dict[str, Any]:
    """Return the report for programs."""
    from rightofway.report.facts import export_note
    from rightofway.report.inspection import export_finding

    return {
        "file": source,
        "what": export_note(sites.description),
        "notes": list(map(export_note, sites.notes)),
        "levels": [
            {
                "level": name or None,
                "units": site.units.to_document(),
                **asdict(replace(result, findings=())),
                "findings": [export_finding(site, finding) for finding in result.findings],
            }
            for name, site, result in results
        ],
    }
