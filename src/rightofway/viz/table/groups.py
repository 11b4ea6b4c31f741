"""Both movement groups of a decision (List 1 and List 2 of the paper): their table and sums."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rightofway.errors import InputError
from rightofway.model import Plan, Tick
from rightofway.planners.two_level import MovementGroup, replay_movement_groups
from rightofway.report.phrases import Phrase
from rightofway.report.quantities import Quantities
from rightofway.viz.table.timespace import TimeSpaceTable, choose_robots, make_table_of_groups


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionTable:
    """Both movement groups of a decision.

    Attributes
    ----------
    table
        Planned rows of the robots, then their rows in each group that found a way.
    completions
        W(i) and W(j) of each group [ticks]; None for a group that found no way.
    sums
        W(i) + W(j) of each group, in a sentence.
    """

    table: TimeSpaceTable
    completions: tuple[tuple[Tick, Tick] | None, ...]
    sums: tuple[Phrase, ...]


def make_decision_table(
    plan: Plan,
    number: int,
    *,
    robots: Sequence[str] | None = None,
    first_tick: int = 0,
    last_tick: int | None = None,
    quantities: Quantities | None = None,
    step: int = 1,
) -> DecisionTable:
    """Return the table and the sums of both movement groups of a decision, counted from 1.

    It shows ``robots``, by name, those of the decision by default; the rest is as in `make_table`.

    Raises
    ------
    InputError
        For a number that no decision has, a planner without movement groups, or a wrong window.
    """
    decisions = plan.run.decisions
    if not 0 < number <= len(decisions):
        last = f"the last one is {len(decisions)}" if decisions else "the plan has no decisions"
        remedy = "rightofway collisions PLAN lists them"
        raise InputError.at("--decision", f"{number} is not there, {last} ({remedy})")
    decision, quantities = decisions[number - 1], quantities or Quantities.of(plan.scenario)
    groups = replay_movement_groups(plan, decision)
    table = make_table_of_groups(
        plan,
        decision.robots if robots is None else choose_robots(plan.scenario, robots),
        [None if group is None else group.tracks for group in groups],
        first_tick=first_tick,
        last_tick=last_tick,
        quantities=quantities,
        step=step,
    )
    i, j = (plan.scenario.robots[robot].name for robot in decision.robots)
    return DecisionTable(
        table=table,
        completions=tuple(None if group is None else group.completions for group in groups),
        sums=tuple(
            _describe_sum(group, str(list_number), f"W({i}) + W({j})", quantities)
            for list_number, group in enumerate(groups, 1)
        ),
    )


def _describe_sum(
    group: MovementGroup | None, number: str, term: str, quantities: Quantities
) -> Phrase:
    if group is None:
        return Phrase("list without way", number=number)
    first, other = map(quantities.format_cell, group.completions)
    total = quantities.format_duration(sum(group.completions))
    values = {"number": number, "sum": f"{term} = {first} + {other}", "total": total}
    return Phrase("sum of list", **values)
