"""``rightofway plan``: a scenario in, a checked plan out."""

from __future__ import annotations

from typing import Any

import click

from rightofway.cli.planning import (
    SECONDS_PER_VISIT,
    Asked,
    PlanningCommand,
    hand_over,
    planning_options,
)
from rightofway.cli.terminal import progress, read_scenario
from rightofway.planners import DEFAULT

__all__ = ["plan"]

EXAMPLES = """\b
Examples:
  rightofway plan examples/door.yaml --show door.html
  rightofway plan examples/warehouse.yaml -o plan.json --log
  rightofway plan examples/door.yaml --planner two-level --option swaps=leave
"""


@click.command(cls=PlanningCommand, epilog=EXAMPLES)
@click.argument("scenario", type=click.Path())
@planning_options(DEFAULT)
def plan(*, scenario: str, **given: Any) -> int:
    """Plan a SCENARIO (YAML, JSON or .scen) and check the plan.

    Prints the costs of the plan, and which robots wait for which others. A SCENARIO of - is
    standard input.
    """
    from rightofway.solve import solve

    asked = Asked(**given)
    asked.refuse_outputs(scenario)
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
