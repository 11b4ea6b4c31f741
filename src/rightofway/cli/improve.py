"""``rightofway improve``: a plan in, a better one out."""

from __future__ import annotations

from typing import Any

import click

from rightofway.cli.planning import Asked, PlanningCommand, hand_over, planning_options
from rightofway.cli.terminal import progress, read_plan
from rightofway.planners import IMPROVER

__all__ = ["improve"]

EXAMPLES = """\b
Examples:
  rightofway improve plan.json -o better.json
  rightofway improve plan.json --planner local-search --option rounds=1000
"""


@click.command(cls=PlanningCommand, only_improvers=True, epilog=EXAMPLES)
@click.argument("plan", type=click.Path())
@planning_options(IMPROVER)
def improve(*, plan: str, **given: Any) -> int:
    """Improve a PLAN of any planner, and check the result.

    The result is never worse than the PLAN. A PLAN of - is standard input.
    """
    from rightofway.solve import improve as improved

    asked = Asked(**given)
    asked.refuse_outputs(plan)
    first = read_plan(plan)
    with progress() as report:
        found = improved(
            first,
            asked.planner,
            asked.time_limit,
            asked.seed,
            options=asked.options,
            report=report,
            keep_best=True,
        )
    return hand_over(found, asked)
