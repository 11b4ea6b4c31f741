"""``rightofway convert`` and ``rightofway schema``: the file formats."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from rightofway.cli.completion import PLANS, SCENARIOS, complete_files, complete_words
from rightofway.cli.inputs import add_foreign_options, count_option, read_either
from rightofway.cli.options import ListingCommand, choose_quantities, require_writable
from rightofway.cli.outputs import put_text, write
from rightofway.cli.terminal import put_json, say, say_of, say_written
from rightofway.errors import InputError, find_nearest

if TYPE_CHECKING:
    from rightofway.model import Plan, Scenario

EXAMPLES = """\b
Examples:
  rightofway convert examples/warehouse.yaml -o warehouse.json
  rightofway convert maze.scen -k 50 -o maze.yaml
  rightofway convert hall.yaml -o hall.scen
  rightofway convert paths.txt --map hall.map -o plan.json
  rightofway convert plan.json --to lns2 -o paths.txt
  rightofway convert plan.json --to nav2 -o paths.json
  rightofway convert shift.json --to planviz -o result.json
  rightofway convert hall.lif.json -o hall.yaml
  rightofway convert room.yaml --radius 0.3 -o hall.yaml
  rightofway convert hall.lif.json -o hall.geojson
"""

ENDINGS = {".geojson": "nav2", ".graphml": "graphml", ".lif.json": "lif"}
"""Endings of files that say in which format a layout is written, without ``--to``."""

BEGIN = 200
"""Characters of a file in which its format is looked for."""

SUFFIXES = (".yaml", ".yml", ".json", ".xlsx", ".scen")


def _list_formats(formatter: click.HelpFormatter) -> None:
    from rightofway.io import FOREIGN_FORMATS, LAYOUT_WRITERS, SITE_PLAN_FORMATS

    with formatter.section("Formats of plans for programs on the site (metres, seconds)"):
        formatter.write_dl([(name, writer.summary) for name, writer in SITE_PLAN_FORMATS.items()])
    with formatter.section("Formats of plans of other programs"):
        formatter.write_dl([(name, writer.summary) for name, writer in FOREIGN_FORMATS.items()])
    with formatter.section("Formats of layouts of other programs"):
        formatter.write_dl([(name, writer.summary) for name, writer in LAYOUT_WRITERS.items()])


def _list_names() -> Iterable[str]:
    from rightofway.io import FOREIGN_FORMATS, LAYOUT_WRITERS, SITE_PLAN_FORMATS

    return dict.fromkeys((*SITE_PLAN_FORMATS, *FOREIGN_FORMATS, *LAYOUT_WRITERS))


def _read_radius(
    _context: click.Context, _parameter: click.Parameter, given: str | None
) -> Fraction | None:
    """Return the radius as an exact number."""
    from rightofway.kinds.table import POSITIVE, allow_none

    try:
        return allow_none(POSITIVE).read(given)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


@click.command(
    cls=ListingCommand,
    listing=_list_formats,
    epilog=EXAMPLES,
    short_help="Write a scenario or a plan in another format.",
)
@click.argument("source", type=click.Path(), shell_complete=complete_files(*SCENARIOS, *PLANS))
@click.argument("target", type=click.Path(), required=False, callback=require_writable())
@click.option("-o", "--output", metavar="TARGET", callback=require_writable(),
              help="File to write, the same as the argument TARGET; - for standard output.",
              )  # fmt: skip
@click.option("--to", "name", metavar="FORMAT", shell_complete=complete_words(_list_names),
              help="Write a plan or a layout for another program; see below.")  # fmt: skip
@click.option("--radius", metavar="LENGTH", callback=_read_radius,
              help="Radius of the robots of the scenario that is written for a layout [m].",
              )  # fmt: skip
@count_option
@add_foreign_options
def convert(
    *,
    source: str,
    target: str | None,
    output: str | None,
    name: str | None,
    radius: Fraction | None,
    count: int | None,
) -> None:
    """Write the scenario, plan or layout SOURCE in another format.

    A scenario is written as .yaml, .json, .xlsx, or .scen with its .map. A .yaml, .json or .xlsx
    file contains the map. A .scen file has no speeds, work times, turning times and ways home;
    the command reports the omitted ones. A plan is written as .json, or with --to for a
    program on the site or another planner. A shift is written as the plan that its robots have
    driven. A layout of another program (LIF, Nav2, Open-RMF, ROS map, openTCS, GraphML, CSV) is
    converted into a scenario (.yaml or .json) with the layout as its map and a few robots. With
    --to, or to a file that ends in .geojson (Nav2), .graphml or .lif.json, it is written for
    another program, and a message names the parts that its format cannot contain.
    """
    from rightofway.model import Plan

    _check_format(name)
    if (target is None) == (output is None):
        raise click.UsageError("give one file to write: convert SOURCE -o TARGET")
    path = target or output or ""
    ending = _find_layout_ending(path) if name is None else None
    if name is None and ending is None:
        _check_ending(path)
    if _is_layout(source):
        _write_layout(source, path, name or ENDINGS.get(ending or ""), radius)
        return
    if ending in ENDINGS and ending != ".lif.json":
        raise click.UsageError(f"{path!r} ends as layouts do, and {source} is none")
    if radius is not None:
        raise click.UsageError(f"--radius is for layouts, and {source} is none")
    _refuse_layout_format(source, name)
    opened = _read_shift(source) or read_either(source, count)
    if isinstance(opened, Plan):
        _write_plan(opened, path, name)
    elif name:
        raise click.UsageError(f"--to is for plans, and {source} is a scenario (plan it first)")
    else:
        _write_scenario(opened, path)


def _read_shift(source: str) -> Plan | None:
    """Return what robots have done in a shift as a plan, or None for any other file."""
    from rightofway.dispatch.record_file import parse_shift
    from rightofway.errors import name_file
    from rightofway.io.collector import pause_garbage_collection
    from rightofway.io.content import read_text
    from rightofway.io.formats import SHIFT_FORMAT
    from rightofway.io.json_text import parse_json

    if not source.lower().endswith(".json"):
        return None
    with name_file(source), pause_garbage_collection():
        text = read_text(Path(source))
        if f'"{SHIFT_FORMAT}"' not in text[:BEGIN]:
            return None
        return parse_shift(parse_json(text)).make_plan()


def _check_format(name: str | None) -> None:
    """Refuse, before any work, a format that is not known."""
    known = tuple(_list_names())
    if name is not None and name not in known:
        meant = find_nearest(name, known)
        hint = f"did you mean {meant}?" if meant else f"give one of {', '.join(known)}"
        raise click.BadParameter(f"{name!r} is no format ({hint})", param_hint="--to")


def _find_layout_ending(path: str) -> str | None:
    """Return the ending of a file that only a layout of another program has."""
    return next((ending for ending in ENDINGS if path.lower().endswith(ending)), None)


def _check_ending(path: str) -> None:
    """Refuse, before any work, an ending that is not known."""
    if path != "-" and Path(path).suffix.lower() not in SUFFIXES:
        endings = f"{', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}"
        remedy = "give a name that does, or with --to the format of another program"
        raise click.UsageError(f"{path!r} does not end in {endings} ({remedy})")


def _is_layout(source: str) -> bool:
    """Return whether a file is a layout, or would be one but for its faults."""
    from rightofway.io import is_layout

    return source != "-" and is_layout(source)


def _refuse_layout_format(source: str, name: str | None) -> None:
    from rightofway.io import LAYOUT_WRITERS, SITE_PLAN_FORMATS

    if name in LAYOUT_WRITERS and name not in SITE_PLAN_FORMATS:
        raise click.UsageError(f"--to {name} is for layouts, and {source} is none")


def _write_layout(source: str, path: str, name: str | None, radius: Fraction | None) -> None:
    """Write a layout in another format, or without one a scenario that has it as its map."""
    from rightofway.io import LAYOUT_WRITERS, format_layout, read_layout
    from rightofway.report.facts import write_notes
    from rightofway.site.layout import Layout

    if name is None:
        _write_example(source, path, radius or Fraction(0))
        return
    if radius is not None:
        raise click.UsageError(f"--radius is for a scenario, and --to {name} writes none")
    layout = read_layout(source)
    if name not in LAYOUT_WRITERS or not isinstance(layout, Layout):
        kind = "a layout" if isinstance(layout, Layout) else "a map in cells or pixels"
        remedy = "give a name that ends in .yaml for a scenario"
        raise click.UsageError(f"{source} is {kind}, which is not written as {name} ({remedy})")
    try:
        text, losses = format_layout(layout, name)
    except InputError as error:
        raise InputError(fault.name_file(source) for fault in error.faults) from None
    put_text(text, path)
    for note in write_notes((*layout.notes, *losses)):
        say_of(path, note)


def _write_example(source: str, path: str, radius: Fraction) -> None:
    from rightofway.files import write_whole
    from rightofway.io import make_example
    from rightofway.report.facts import write_notes

    if path != "-" and not path.lower().endswith((".yaml", ".yml", ".json")):
        raise click.UsageError(f"{source} is a layout (give a name that ends in .yaml or .json)")
    example = make_example(source, path, radius)
    if path == "-":
        click.echo(example.text, nl=False)
    else:
        write_whole(path, example.text)
        say_written(path)
    for note in write_notes(example.notes):
        say_of(source, note)


def _write_plan(plan: Plan, path: str, name: str | None) -> None:
    from rightofway.io import SITE_PLAN_FORMATS, format_foreign, format_site_plan

    if name in SITE_PLAN_FORMATS:
        text, notes = format_site_plan(plan, name)
        put_text(text, path)
        for note in notes:
            say_of(path, note)
    elif name is not None:
        put_text(format_foreign(plan, name), path)
        for note in _list_losses(plan, name):
            say_of(path, note)
    elif path == "-" or path.lower().endswith((".json", ".xlsx")):
        write(plan, path)
    else:
        _write_scenario(plan.scenario, path)


def _list_losses(plan: Plan, name: str) -> Iterator[str]:
    """Yield what a plan for another program leaves out, a sentence each."""
    from rightofway.io.foreign.planviz_writer import count_missed_errands, has_turns

    stages = [itinerary.stages for itinerary in plan.scenario.problem.itineraries]
    keeps_all = name == "planviz" and has_turns(plan.scenario)
    if not keeps_all and any(len(own) > 1 or own[0].work for own in stages):
        yield "work, turning and ways back are left out, only cells and steps are kept"
    missed = count_missed_errands(plan) if keeps_all else 0
    if missed:
        rule = "the League counts one errand of an agent in a step"
        yield f"stops that are not finished there: {missed}, because {rule}"
    if plan.scenario.problem.clock.tick != 1:
        step = choose_quantities(plan.scenario).format_duration(1)
        yield f"a step lasts {step}"


def _write_scenario(scenario: Scenario, path: str) -> None:
    from rightofway.io import format_scenario, write_scenario

    if path == "-":
        click.echo(format_scenario(scenario), nl=False)
    elif path.lower().endswith(".scen"):
        _write_pair(scenario, Path(path))
    else:
        write_scenario(scenario, path)
        if path.lower().endswith(".xlsx") and scenario.roadmap.obstacles:
            text = "the names of obstacles are left out (a map sheet has no place for them)"
            say_of(path, text)
        say_written(path)


def _write_pair(scenario: Scenario, path: Path) -> None:
    from rightofway.io import write_map, write_scen

    map_path = path.with_suffix(".map")
    try:
        losses = write_scen(scenario, path, map_name=map_path.name)
    except InputError as error:
        raise InputError(error.faults, error.source or str(path)) from None
    write_map(scenario.roadmap, map_path)
    for loss in losses:
        say_of(path, loss)
    say(f"wrote {path} and {map_path}")


@click.command(epilog="Example:  rightofway schema scenario > scenario.schema.json")
@click.argument("kind", type=click.Choice(["scenario", "plan", "shift", "suite"]))
def schema(kind: Literal["scenario", "plan", "shift", "suite"]) -> None:
    """Print the JSON Schema of scenario, plan, shift or suite files."""
    from rightofway.io import make_schema

    put_json(make_schema(kind))
