"""``rightofway check`` and ``show``: what is in a plan."""

from __future__ import annotations

from fractions import Fraction
from math import floor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import PLANS, SCENARIOS, complete_files
from rightofway.cli.inputs import (
    add_foreign_options,
    count_option,
    list_own,
    read_either,
    read_plan,
)
from rightofway.cli.options import (
    Time,
    Whole,
    as_json_option,
    choose_quantities,
    require_writable,
    ticks_option,
)
from rightofway.cli.outputs import PAGE_SUFFIXES, complain_of_faults, make_page_option, put_page
from rightofway.cli.terminal import (
    complain,
    make_title,
    put_json,
    put_report,
    say,
    say_written,
    show_progress,
)
from rightofway.errors import InputError

if TYPE_CHECKING:
    from rightofway.check import Report
    from rightofway.model import Plan
    from rightofway.report.quantities import Quantities
    from rightofway.viz import Background

LAYOUTS_WITH_PICTURES = (".yaml", ".yml")
"""How the names of layouts end that may name a picture: ROS maps, buildings of Open-RMF."""

LIMIT = 10
"""Time limit of planning a scenario that is to be shown [s]."""

SHOW_EXAMPLES = """\b
Examples:
  rightofway show plan.json --page plan.html
  rightofway show plan.json -o moment.png --at 12
  rightofway show plan.json --page plan.html --background hall.yaml
  rightofway show examples/door.yaml -o door.gif
"""


CHECK_EXAMPLES = """\b
Examples:
  rightofway check plan.json
  rightofway check runs/*.json --limit 3
"""


@click.command(epilog=CHECK_EXAMPLES)
@click.argument("plans", type=click.Path(), nargs=-1, required=True, metavar="PLAN...",
                shell_complete=complete_files(*PLANS))  # fmt: skip
@add_foreign_options
@click.option("--limit", type=Whole(0), default=1000, show_default=True, metavar="N",
              help="Faults to list for each plan; all are counted.")  # fmt: skip
@ticks_option
@as_json_option("report")
def check(*, plans: tuple[str, ...], limit: int, in_ticks: bool, as_json: bool) -> int:
    """Check plans; exit code 1 if one breaks a rule.

    The check shares no code with the planners. It finds jumps, drives that are too fast, work cut
    short, missed stops, wrong homes and ends, vertex and swap conflicts, headways that are too
    short and, where they are forbidden, rotations. A PLAN of - is standard input. With several
    plans, --json prints a list. If a plan cannot be read (exit code 2), the others are checked
    all the same.
    """
    from rightofway.check import check as judge
    from rightofway.report.plan import report_check

    code, reports, own = 0, [], list_own(plans)
    for path in plans:
        try:
            opened = read_plan(path, own)
        except InputError as error:  # the other plans are checked all the same
            complain(str(error))
            code = 2
            continue
        quantities = choose_quantities(opened.scenario, in_ticks=in_ticks)
        report = judge(opened, limit=limit)
        code = code or int(not report.ok)
        if as_json:
            reports.append({"plan": path, **_report_data(opened, report, quantities)})
        else:
            put_report(report_check(path, opened, report, quantities))
    if as_json and reports:
        put_json(reports if len(plans) > 1 else reports[0])
    return code


def _report_data(plan: Plan, report: Report, quantities: Quantities) -> dict[str, Any]:
    from rightofway.report.judgement import write_fault_message

    return {
        "ok": report.ok,
        "counts": dict(report.counts),
        "faults": [
            {
                "kind": fault.kind,
                "robots": [plan.scenario.robots[robot].name for robot in fault.robots],
                "vertices": [plan.scenario.roadmap.name(vertex) for vertex in fault.vertices],
                "tick": fault.tick,
                "message": write_fault_message(fault, quantities),
            }
            for fault in report.faults
        ],
    }


@click.command(epilog=SHOW_EXAMPLES, short_help="Show a plan as a page, a picture or a film.")
@click.argument("plan", type=click.Path(), metavar="PLAN_OR_SCENARIO",
                shell_complete=complete_files(*SCENARIOS))  # fmt: skip
@click.argument("others", type=click.Path(), nargs=-1, metavar="[OTHER_PLAN]...",
                shell_complete=complete_files(*PLANS))  # fmt: skip
@count_option
@add_foreign_options
@click.option("-o", "--output", metavar="FILE",
              callback=require_writable(*PAGE_SUFFIXES, ".png", ".gif"),
              help="Write a page (.html), picture (.png) or film (.gif); - prints the page.",
              )  # fmt: skip
@make_page_option("the plan")
@click.option("--at", type=Time(), metavar="TIME",
              help="Time that the picture shows, in the scenario's unit; the start by default.",
              )  # fmt: skip
@click.option("--tick", type=Whole(0), metavar="TICK", help="The same as a tick.")
@click.option("--background", type=click.Path(), metavar="FILE",
              help="Picture under the map of the page: a ROS map or a building (.yaml) with its own"
              " position, or a picture whose lower left corner is that of the map.",
              )  # fmt: skip
@click.option("--background-scale", type=float, metavar="LENGTH",
              help="Length of a pixel of a picture; by default it is as wide as the map.",
              )  # fmt: skip
def show(
    *,
    plan: str,
    others: tuple[str, ...],
    count: int | None,
    output: str | None,
    page: str | None,
    at: Fraction | None,
    tick: int | None,
    background: str | None,
    background_scale: float | None,
) -> None:
    """Write a plan as a page that plays it, a picture or a film.

    A scenario is planned first, as by `rightofway plan`. With other plans, up to eight in all, the
    page shows them side by side: figures, maps, diagrams, and which robots gain or lose. Robots are
    compared by their names, so the plans may be of different scenarios.
    """
    from rightofway.metrics import MAX_COMPARED
    from rightofway.model import Scenario
    from rightofway.report.plan import describe_planning
    from rightofway.solve import solve

    if not (output or page):
        raise click.UsageError("nothing to write (give --page FILE, or -o FILE for a picture)")
    is_picture = Path(output or "").suffix.lower() == ".png"
    _check_picture(is_picture, at, tick)
    if others and output not in (None, "-") and not output.lower().endswith(PAGE_SUFFIXES):
        raise click.UsageError("plans are compared on a page (give --page FILE)")
    if len(others) >= MAX_COMPARED:
        message = f"{len(others) + 1} plans are too many to compare"
        raise click.UsageError(f"{message} (give at most {MAX_COMPARED})")
    _check_background(background, background_scale, [page, output])
    own = list_own([plan, *others])
    opened = read_either(plan, count, own)
    if isinstance(opened, Scenario):
        with show_progress(LIMIT) as report:
            opened = solve(opened, time_limit=LIMIT, report=report)
        text = describe_planning(opened, choose_quantities(opened.scenario))
        say(f"{plan}: {text}")
    first, *titles = _choose_titles([plan, *others])
    extras: dict[str, Any] = {
        "title": first,
        "background": _read_background(background, background_scale, opened),
        "others": list(zip((read_plan(path, own) for path in others), titles, strict=True)),
    }
    if page:
        _write(opened, page, extras)
    if output == "-":
        from rightofway.viz import make_page

        click.echo(make_page(opened, **extras), nl=False)
        complain_of_faults(opened, output)
    elif is_picture:
        from rightofway.viz import write_png

        if at is not None:
            tick = floor(at / opened.scenario.problem.clock.tick)
        write_png(opened, output or "", tick)
        say_written(output)
    elif output:
        _write(opened, output, extras)


def _choose_titles(paths: list[str]) -> list[str]:
    """Return the names of files; the whole paths where two have one name."""
    titles = list(map(make_title, paths))
    return titles if len(set(titles)) == len(titles) else paths


def _check_picture(is_picture: bool, at: Fraction | None, tick: int | None) -> None:
    """Refuse options of pictures where none is written, and two moments."""
    if not is_picture and (at is not None or tick is not None):
        raise click.UsageError("--at and --tick are for pictures (end the file in .png)")
    if at is not None and tick is not None:
        raise click.UsageError("--at and --tick say the same: choose one")


def _check_background(picture: str | None, scale: float | None, outputs: list[str | None]) -> None:
    """Refuse options of a background where there is no page, and a scale that is not needed."""
    if picture is None:
        if scale is not None:
            raise click.UsageError("--background-scale needs --background PICTURE")
        return
    if not any(
        output and (output == "-" or output.lower().endswith(PAGE_SUFFIXES)) for output in outputs
    ):
        raise click.UsageError("--background is for pages (give --page FILE)")
    if scale is not None and picture.lower().endswith(LAYOUTS_WITH_PICTURES):
        raise click.UsageError(f"--background-scale is for pictures; {picture} says its own scale")


def _read_background(path: str | None, scale: float | None, plan: Plan) -> Background | None:
    """Return a picture, or where a layout says that its picture lies."""
    from rightofway.viz import Background

    if path is None:
        return None
    if not path.lower().endswith(LAYOUTS_WITH_PICTURES):
        return Background(picture=path, scale=scale)
    from rightofway.io import read_layout
    from rightofway.site.layout import Layout, Level
    from rightofway.site.occupancy import Occupancy

    layout = read_layout(path)
    owners = layout.levels if isinstance(layout, Layout) else (layout,)
    pictures = [
        owner.picture for owner in owners if isinstance(owner, Level | Occupancy) and owner.picture
    ]
    if len(pictures) != 1:
        message = f"names {len(pictures)} pictures (give a ROS map, or a building of one level)"
        raise InputError.at("", message, path)
    return Background.of(pictures[0].scale(1 / (plan.scenario.units.metres or Fraction(1))))


def _write(plan: Plan, path: str, extras: dict[str, Any]) -> None:
    """Write a film or a page."""
    from rightofway.viz import write_gif

    if path.lower().endswith(".gif"):
        film = write_gif(plan, path)
        apart = choose_quantities(plan.scenario).format_duration(film.ticks_per_frame)
        say(f"{film.frames} frames, {apart} apart")
        say_written(path)
    else:
        put_page(plan, path, **extras)
