"""``rightofway plan``: a scenario in, a checked plan out."""

from __future__ import annotations

import click

from rightofway.cli.planning import (
    SECONDS_PER_VISIT,
    Asked,
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
def plan(*, scenario: str, asked: Asked) -> int:
    """Plan a SCENARIO (YAML, JSON or .scen) and check the plan.

    Prints what the plan costs and who waits for whom. A SCENARIO of - is standard input.
    """
    from rightofway.solve import solve

    refuse_bad_outputs(
        scenario, asked.output, log=asked.log, table=asked.table, as_json=asked.as_json
    )
    problem = read_scenario(scenario)
    with progress() as report:
        found = solve(
            problem,
            asked.planner,
            asked.time_left,
            asked.seed,
            options=asked.options,
            report=report,
            keep_best=True,
            seconds_per_visit=SECONDS_PER_VISIT,
        )
    return hand_over(found, asked)
