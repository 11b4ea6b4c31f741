"""``rightofway plan``: a scenario in, a checked plan out."""

from __future__ import annotations

import click

from rightofway.cli.planning import (
    PlanningCommand,
    hand_over,
    options_of_planning,
    refuse_bad_outputs,
)
from rightofway.cli.terminal import progress, read_scenario
from rightofway.planners import DEFAULT

__all__ = ["plan"]

EXAMPLE = """\b
Examples:
  rightofway plan examples/door.yaml --show door.html
  rightofway plan examples/warehouse.yaml -o plan.json --log
  rightofway plan examples/door.yaml --planner two-level --option swaps=leave
"""


@click.command(cls=PlanningCommand, epilog=EXAMPLE)
@click.argument("scenario", type=click.Path())
@options_of_planning(DEFAULT)
def plan(
    *,
    scenario: str,
    output: str | None,
    planner: str,
    options: dict[str, str],
    time_limit: float | None,
    seed: int,
    page: str | None,
    log: bool,
    table: bool,
    as_json: bool,
) -> int:
    """Plan a SCENARIO (YAML, JSON or .scen) and check the plan.

    Prints what the plan costs and who waits for whom. A SCENARIO of - is standard input.
    """
    from rightofway.solve import solve

    refuse_bad_outputs(scenario, output, log=log, table=table, as_json=as_json)
    problem = read_scenario(scenario)
    with progress() as report:
        found = solve(
            problem, planner, options=options, time_limit=time_limit, seed=seed, report=report
        )
    return hand_over(found, output, page, log=log, table=table, as_json=as_json)
