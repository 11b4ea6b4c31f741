"""``rightofway improve``: a plan in, a better one out."""

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
from rightofway.cli.terminal import progress, read_plan
from rightofway.planners import IMPROVER, PlannerSpec

__all__ = ["improve"]

EXAMPLE = """\b
Examples:
  rightofway improve plan.json -o better.json
  rightofway improve plan.json --planner local-search --option rounds=1000
"""


class _ImproveCommand(PlanningCommand):
    def can_use(self, spec: PlannerSpec) -> bool:
        return spec.improves


@click.command(cls=_ImproveCommand, epilog=EXAMPLE)
@click.argument("plan", type=click.Path())
@options_of_planning(IMPROVER)
def improve(*, plan: str, asked: Asked) -> int:
    """Make a PLAN better, whoever made it, and check the result.

    The result is never worse. A PLAN of - is standard input.
    """
    from rightofway.solve import improve as make_better

    refuse_bad_outputs(plan, asked.output, log=asked.log, table=asked.table, as_json=asked.as_json)
    first = read_plan(plan)
    with progress() as report:
        found = make_better(
            first,
            asked.planner,
            asked.time_left,
            asked.seed,
            options=asked.options,
            report=report,
            keep_best=True,
            seconds_per_visit=SECONDS_PER_VISIT,
        )
    return hand_over(found, asked)
