"""``rightofway collisions``: where free-running robots meet, and conflicts left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.completion import SCENARIOS, complete_files, complete_planners
from rightofway.cli.inputs import add_foreign_options, count_option, read_either
from rightofway.cli.options import (
    as_json_option,
    choose_quantities,
    require_writable,
    ticks_option,
    time_limit_option,
)
from rightofway.cli.tables import describe_clock, put_lists
from rightofway.cli.terminal import choose_deadline, put_json, show_progress
from rightofway.errors import InputError
from rightofway.report.phrases import say_count

if TYPE_CHECKING:
    from rightofway.metrics import NamedCollision, NamedCollisions
    from rightofway.model import Plan
    from rightofway.report.quantities import Quantities
    from rightofway.viz.table import Listing

EXAMPLES = """\b
Examples:
  rightofway collisions door.yaml
  rightofway collisions door.yaml --each-tick -o collisions.csv
  rightofway collisions plan.json
"""


LEGEND = (
    "before, left: conflicts of the whole fleet before and after the decision, counted tick by"
    " tick\nif i, if j: conflicts left if robot i waits, and if robot j waits"
)
"""Contents of the columns of decisions."""


@click.command(epilog=EXAMPLES, short_help="List where robots would meet if none of them waited.")
@click.argument("source", type=click.Path(), metavar="SCENARIO_OR_PLAN",
                shell_complete=complete_files(*SCENARIOS))  # fmt: skip
@count_option
@add_foreign_options
@click.option("-o", "--output", metavar="FILE", callback=require_writable(".txt", ".csv", ".xlsx"),
              help="Write .txt, .csv or .xlsx; - writes CSV to standard output.")  # fmt: skip
@click.option("--each-tick", is_flag=True,
              help="List Collision(i, j, t) = n tick by tick, as the paper does.")  # fmt: skip
@click.option("--planner", metavar="NAME", shell_complete=complete_planners(improving=False),
              help="Plan a scenario first, and list each decision too.")  # fmt: skip
@time_limit_option
@ticks_option
@as_json_option("list")
def collisions(
    *,
    source: str,
    count: int | None,
    output: str | None,
    each_tick: bool,
    planner: str | None,
    time_limit: float | None,
    in_ticks: bool,
    as_json: bool,
) -> None:
    """List the collisions and swaps of free-running robots, which never wait for another robot.

    Robots that are too near for their sizes are listed, too. The robots of a scenario drive their
    shortest routes, those of a plan the routes of the plan. For a plan, the decisions of its
    planner follow, with the conflicts before and after each. A file of - is standard input.
    """
    from rightofway.deadline import limit_work
    from rightofway.metrics import free_running, name_collisions
    from rightofway.model import Scenario, compute_completions
    from rightofway.repair.routing import free_running_tracks
    from rightofway.solve import solve
    from rightofway.viz.table import (
        tabulate_collision_ticks,
        tabulate_collisions,
        tabulate_decisions,
    )

    deadline = choose_deadline(time_limit)
    with limit_work(deadline):
        opened = read_either(source, count)
        if isinstance(opened, Scenario) and planner:
            with show_progress(time_limit) as report:
                left = deadline.measure_seconds_left()
                opened = solve(opened, planner, left, report=report)
        plan = None if isinstance(opened, Scenario) else opened
        scenario = opened if isinstance(opened, Scenario) else opened.scenario
        tracks = free_running_tracks(scenario) if plan is None else free_running(plan)
        quantities = choose_quantities(scenario, in_ticks=in_ticks)
        listed = name_collisions(scenario, tracks)
        if output or as_json:
            _refuse_length(listed)
        if each_tick:
            end = max(compute_completions(scenario, tracks))
            lists = [tabulate_collision_ticks(listed, quantities, end)]
        else:
            lists = [tabulate_collisions(listed, quantities)]
        if plan is not None and plan.run.decisions:
            lists.append(tabulate_decisions(plan, quantities))
        if output:
            put_lists(lists, output)
        if as_json:
            put_json(_make_collision_data(listed, plan, quantities))
    if not output and not as_json:
        ticks = len(lists[0]) if each_tick else 0
        parts = [_write_headline(listed, ticks, is_planned=plan is not None), *_write_texts(lists)]
        if len(lists) > 1:
            parts.append(LEGEND)
        if plan is not None:
            remaining = name_collisions(scenario, plan.tracks)
            parts.append(f"Left in the plan: {_write_counts(remaining)}.")
            parts += _write_texts([tabulate_collisions(remaining, quantities)])
        click.echo("\n\n".join(parts))


def _refuse_length(listed: NamedCollisions) -> None:
    """Refuse to write a list that is too long for a file."""
    from rightofway.viz.table import MAX_ROWS

    if len(listed) > MAX_ROWS:
        message = f"{len(listed)} collisions and swaps are more than {MAX_ROWS} rows"
        raise InputError.at("-o, --json", f"{message} (leave both out, or take fewer robots)")


def _write_headline(listed: NamedCollisions, ticks: int, *, is_planned: bool) -> str:
    number = _write_counts(listed)
    if ticks and listed:
        number += f", in {say_count(ticks, 'tick', 'ticks')}"
    if is_planned:
        return f"On the routes of the plan, without waits: {number}."
    return f"On the shortest routes, without waits: {number}."


def _write_texts(lists: Sequence[Listing]) -> list[str]:
    return [listing.as_text() for listing in lists if len(listing)]


def _write_counts(listed: NamedCollisions) -> str:
    kinds = listed.count_kinds()
    collisions = say_count(kinds["collision"], "collision", "collisions")
    swaps = say_count(kinds["swap"], "swap", "swaps")
    text = f"{collisions} and {swaps}"
    near = say_count(kinds["too near"], "near miss", "near misses")
    return f"{text}, {near}" if kinds["too near"] else text


def _make_collision_data(
    listed: NamedCollisions, plan: Plan | None, quantities: Quantities
) -> dict[str, Any]:
    """Return collisions and decisions for programs; times in ticks."""
    from rightofway.metrics import name_collisions
    from rightofway.viz.table import count_conflicts_before

    data = {
        **describe_clock(quantities),
        "collisions": [_make_pair_data(collision) for collision in listed],
    }
    if plan is not None:
        names, place = [robot.name for robot in plan.scenario.robots], plan.scenario.roadmap.name
        data["decisions"] = [
            {
                "tick": collision.tick,
                "kind": collision.kind,
                "vertices": list(map(place, collision.vertices)),
                "robots": [names[robot] for robot in collision.robots],
                "waits": names[collision.waits],
                "level": collision.level,
                "conflicts_before": before,
                "conflicts_left": collision.conflicts_left,
                "completion_sums": collision.completion_sums,
            }
            for collision, before in zip(
                plan.run.decisions, count_conflicts_before(plan), strict=True
            )
        ]
        left = name_collisions(plan.scenario, plan.tracks)
        data["left"] = [_make_pair_data(collision) for collision in left]
    return data


def _make_pair_data(collision: NamedCollision) -> dict[str, Any]:
    return {
        "robots": [collision.i, collision.j],
        "vertices": collision.places,
        "start": collision.start,
        "end": collision.until,
        "kind": collision.kind,
    }
