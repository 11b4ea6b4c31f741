"""``rightofway inspect``: what a layout, a map or a scenario is, and what will hurt on it."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import SCENARIOS, files
from rightofway.cli.inputs import point_to_examples
from rightofway.cli.options import as_json_option
from rightofway.cli.terminal import counted, put_json, put_report, wrapped
from rightofway.errors import listed
from rightofway.model.quantities import decimal

if TYPE_CHECKING:
    from rightofway.io.sites import Sites
    from rightofway.metrics import Inspection, Site

EXAMPLES = """\b
Examples:
  rightofway inspect hall.lif.json
  rightofway inspect hall.lif.json --robots fleet.csv
  rightofway inspect examples/door.yaml --json
"""

HEADINGS = {
    "error": "Errors (some work cannot be done)",
    "warning": "Warnings (robots will wait)",
    "note": "Notes",
}

LISTED_PARTS = 8
"""Sizes of strongly connected parts that a report lists."""


@click.command(epilog=EXAMPLES, short_help="List what will hurt on a layout, map or scenario.")
@click.argument(
    "source",
    type=click.Path(),
    metavar="FILE",
    shell_complete=files(*SCENARIOS, ".xml", ".graphml", ".geojson", ".csv", ".map"),
)
@click.option(
    "--robots",
    "fleet",
    metavar="FILE",
    type=click.Path(),
    shell_complete=files(".yaml", ".yml", ".json", ".csv"),
    help="Judge the robots of this file: a scenario, a list of robots, or a CSV.",
)
@click.option("--level", metavar="NAME", help="Inspect only this level of a layout.")
@click.option("--vehicle-type", metavar="NAME", help="Inspect the lanes of this vehicle type.")
@click.option(
    "--cell-size",
    metavar="SIZE",
    callback=lambda _c, _p, given: _size(given),
    help="Side of the cells that a map in pixels is cut into [m]; 0.5 by default.",
)
@click.option(
    "--limit",
    type=click.IntRange(1),
    default=5,
    show_default=True,
    metavar="N",
    help="Findings to list of each kind; all are counted.",
)
@as_json_option("report")  # fmt: skip
def inspect(
    *,
    source: str,
    fleet: str | None,
    level: str | None,
    vehicle_type: str | None,
    cell_size: Fraction | None,
    limit: int,
    as_json: bool,
) -> None:
    """Say what FILE is, how large, what was repaired in it, and what will hurt.

    FILE is a layout of another program in any format that is known, a map or a scenario. Each
    finding has a place and a remedy: places that cannot be reached or left, vertices and lanes that
    are too near for the robots, lanes that cross without a vertex, places on the only way to
    others, corridors without a passing place, and bottlenecks. Nothing is planned.
    """
    from rightofway.io.sites import Choice, read_sites
    from rightofway.metrics import inspect as inspected

    point_to_examples(source)
    choice = Choice(level=level, vehicle_type=vehicle_type, cell_size=cell_size)
    found = read_sites(source, choice, fleet)
    results = [(name, site, inspected(site)) for name, site in found.sites]
    if as_json:
        put_json(_data(source, found, results))
        return
    lines = wrapped(f"{source}: {found.what}")
    for note in found.notes:
        lines += wrapped(note, "  ")
    for name, site, result in results:
        lines += ["", *([f"Level {name}"] if name else []), *_report(site, result, limit)]
    put_report("\n".join(lines))


def _size(given: str | None) -> Fraction | None:
    if given is None:
        return None
    try:
        size = Fraction(given)
    except (ValueError, ZeroDivisionError):
        size = Fraction(0)
    if size <= 0:
        raise click.BadParameter(f"{given!r} is no length (give metres, like 0.5)")
    return size


def _report(site: Site, result: Inspection, limit: int) -> list[str]:
    one_way = f", {result.one_way} of them one-way" if result.one_way else ""
    vertices = "1 vertex" if result.vertices == 1 else f"{result.vertices} vertices"
    size = f"{vertices}, {counted(result.edges, 'directed edge')}{one_way}"
    lines = wrapped(f"{size}, {_extent(site)}; {counted(result.places, 'place')}.")
    if len(result.parts) == 1:
        lines += wrapped("All vertices reach each other.")
    else:
        sizes = [str(part) for part in result.parts[:LISTED_PARTS]]
        more = len(result.parts) - len(sizes)
        cut = [*sizes, f"{more} more"] if more else sizes
        lines += wrapped(
            f"{len(result.parts)} strongly connected parts, of {listed(cut)} vertices."
        )
    if result.sampled:
        some, all_of = result.sampled
        lines += wrapped(f"Shortest routes are counted from {some} of {all_of} vertices only.")
    if not result.findings:
        return [*lines, "Nothing was found that will hurt."]
    shown: Counter[tuple[str, str]] = Counter()
    severity = ""
    for each in result.findings:
        if each.severity != severity:
            severity = each.severity
            number = sum(one.severity == severity for one in result.findings)
            lines += ["", f"{HEADINGS[severity]}: {number}"]
        shown[severity, each.kind] += 1
        if shown[severity, each.kind] <= limit:
            lines += wrapped(str(each), "  ")
        elif shown[severity, each.kind] == limit + 1:
            more = sum((one.severity, one.kind) == (severity, each.kind) for one in result.findings)
            lines += wrapped(f"and {more - limit} more: {each.kind} (see --limit)", "  ")
    return lines


def _extent(site: Site) -> str:
    """Return width and height of a site."""
    roadmap = site.roadmap
    spans = (roadmap.positions.max(axis=0) - roadmap.positions.min(axis=0)).tolist()
    width, height = (Fraction(repr(span)) for span in spans)
    return f"{decimal(width)} x {site.units.written_length(height)}"


def _data(source: str, found: Sites, results: list[tuple[str, Site, Inspection]]) -> dict[str, Any]:
    """Return the report for programs."""
    return {
        "file": source,
        "what": found.what,
        "notes": list(found.notes),
        "levels": [
            {
                "level": name or None,
                "units": asdict(site.units),
                **{key: value for key, value in asdict(result).items() if key != "findings"},
                "findings": [{**asdict(each), "sentence": str(each)} for each in result.findings],
            }
            for name, site, result in results
        ],
    }
