"""``rightofway bench``: a suite of cases in, a row of results for each out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import complete_files
from rightofway.cli.options import Whole, as_json_option, require_writable
from rightofway.cli.terminal import put_json, put_report, say, say_written
from rightofway.report.lines import Part, Table

if TYPE_CHECKING:
    from rightofway.bench import Case, FleetSizes, Results, Row

EXAMPLES = """\b
Examples:
  rightofway bench examples/suite.toml -o results.csv --report report.html
  rightofway bench examples/suite.toml --dask tcp://host:8786
  rightofway bench shifts.toml --in-time 95% --report fleets.html
"""


def _read_share(
    _context: click.Context, _parameter: click.Parameter, given: str | None
) -> Fraction | None:
    from rightofway.kinds.table import NOT_NEGATIVE, SHARE

    if given is None:
        return None
    try:
        if given.endswith("%"):
            return SHARE.read(NOT_NEGATIVE.read(given[:-1].strip()) / 100)
        return SHARE.read(given)
    except ValueError as error:
        raise click.BadParameter(f"{given!r} is no share: {error}") from None


@click.command(epilog=EXAMPLES)
@click.argument("suite", type=click.Path(), shell_complete=complete_files(".toml"))
@click.option("-o", "--output", metavar="RESULTS", default="results.csv", show_default=True,
              callback=require_writable(".csv", stdout=False),
              help="Add rows to this file; cases with a row in it are not run again.")  # fmt: skip
@click.option("--report", metavar="REPORT", callback=require_writable(".html", ".md", stdout=False),
              help="Write a report with plots (HTML or Markdown) at the end.")  # fmt: skip
@click.option("--in-time", callback=_read_share, metavar="SHARE",
              help="In suites of shifts, report the smallest number of robots with this share of"
              " jobs in time, like 95%.")  # fmt: skip
@click.option("--jobs", type=Whole(1), metavar="N",
              help="Number of cases that run at a time; by default one for each core.")  # fmt: skip
@click.option("--dask", metavar="ADDRESS",
              help="Run on a cluster: the address of a Dask scheduler.")  # fmt: skip
@as_json_option("summary")
def bench(
    *,
    suite: str,
    output: str,
    report: str | None,
    in_time: Fraction | None,
    jobs: int | None,
    dask: str | None,
    as_json: bool,
) -> int:
    """Run every case of a SUITE (TOML), each in a process of its own.

    Prints for each planner the number of solved cases, the cost and the time, and for shifts the
    throughput and service times of each number of robots. The same command continues an
    interrupted run. Exit code 1 if a plan has faults.
    """
    from rightofway.bench import Results, read_suite, write_report
    from rightofway.extras import need

    if dask and jobs:
        raise click.UsageError("--jobs is for this machine, --dask for a cluster: choose one")
    if report:
        need("matplotlib", "a report")
    if dask:
        need("distributed", "a cluster")
    cases = read_suite(suite)
    with Results(output) as results:
        try:
            _run(cases, results, jobs=jobs, dask=dask)
        except KeyboardInterrupt:
            done = sum(case.key in results.rows for case in cases)
            say(f"{output} has {done} of {len(cases)} cases; the same command goes on from here")
            raise
        rows = [results.rows[case.key] for case in cases]
    say_written(output)
    _summarize(rows, output, in_time, as_json=as_json)
    if report:
        title = f"Benchmark results: {Path(suite).name}"
        write_report(rows, report, title, in_time=in_time)
        say_written(report)
    return 1 if any(row["valid"] is False for row in rows) else 0


def _run(cases: Sequence[Case], results: Results, *, jobs: int | None, dask: str | None) -> None:
    """Run the cases that have no row yet."""
    from rightofway.bench import describe_machine, run_here, run_on_cluster

    left = {case.key: case for case in cases if case.key not in results.rows}
    done = len(cases) - len(left)
    if done:
        say(f"{done} of {len(cases)} cases are there already")
        commit = describe_machine()["commit"]
        earlier = [results.rows[case.key]["commit"] for case in cases if case.key not in left]
        others = sum(known != commit for known in earlier)
        if others:
            text = f"{others} of them by another commit (give another -o to run them again)"
            say(text)
    if not left:
        return
    rows = (
        run_on_cluster(left.values(), dask, report=say)
        if dask
        else run_here(left.values(), jobs=jobs)
    )
    for number, row in enumerate(rows, start=done + 1):
        results.add(row)
        say(f"[{number}/{len(cases)}] {left[row['key']]}: {_describe_ending(row)}")


def _describe_ending(row: Row) -> str:
    from rightofway.bench import SHIFT

    if row["solved"]:
        ratio = "" if row["ratio"] is None else f"flowtime / bound {row['ratio']:.3f} in "
        text = f"{row['message']}, in " if row["planner"] == SHIFT else ratio
        return f"{text}{row['wall_seconds']:.2f} s"
    return f"{row['status']}: {row['message']}"


def _summarize(
    rows: Sequence[Row], output: str, in_time: Fraction | None, *, as_json: bool
) -> None:
    from rightofway.bench import SHIFT, Group, compare_fleet_sizes, group_by_planner

    planned = group_by_planner([row for row in rows if row["planner"] != SHIFT])
    groups = {name: Group.of(own) for name, own in planned.items()}
    shifts = compare_fleet_sizes(rows)
    if as_json:
        planners = [{"planner": name, **asdict(group)} for name, group in groups.items()]
        data = {"results": output, "cases": len(rows), "planners": planners}
        put_json({**data, "shifts": [_export_sizes(sizes, in_time) for sizes in shifts]})
        return
    lines = []
    for name, group in groups.items():
        ratio = f"{group.ratio.median:.3f}" if group.ratio else ""
        seconds = f"{group.seconds.median:.2f}" if group.seconds else ""
        lines.append((name, f"{group.solved}/{group.cases}", ratio, seconds))
    parts: list[Part] = []
    if groups:
        parts.append(Table(("planner", "solved", "ratio", "first plan [s]"), lines))
    for sizes in shifts:
        heads, *cells = sizes.list_cells()
        parts += [*[""] * bool(parts), sizes.title, Table(heads, cells)]
    if shifts and in_time is not None:
        parts += ["", *(sizes.describe_least(in_time) for sizes in shifts)]
    put_report(parts)


def _export_sizes(sizes: FleetSizes, in_time: Fraction | None) -> dict[str, Any]:
    data = asdict(sizes)
    if in_time is not None:
        least = sizes.find_least(in_time)
        data["least_robots"] = least and least.robots
    return data
