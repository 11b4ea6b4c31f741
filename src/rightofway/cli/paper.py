"""``rightofway paper``: the tables of the paper beside those of our planner of that method."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from rightofway.cli.options import Whole, as_json_option, choose_quantities
from rightofway.cli.terminal import put_json, put_report
from rightofway.report.examples import find_examples_folder, read_first_sentence

if TYPE_CHECKING:
    from rightofway.model import Plan

PAPER_EXAMPLES = """\b
Examples:
  rightofway paper
  rightofway paper 8 --log
"""

TABLES = 11
"""Tables of the paper."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """A row of a table; ``published`` is None where the paper does not print it."""

    robot: str
    kind: str
    published: list[int | str] | None
    ours: list[int | str]

    @property
    def verdict(self) -> str:
        if self.published is None:
            return ""
        return "equal" if self.published == self.ours else "differs"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Table:
    """A table of the paper and our plan of its scenario."""

    number: int
    scenario: str
    first_tick: int
    plan: Plan
    rows: list[_Row]


@click.command(epilog=PAPER_EXAMPLES, short_help="Compare the tables of the paper with ours.")
@click.argument("tables", nargs=-1, type=Whole(1, TABLES), metavar="[NUMBERS]")
@click.option("--log", is_flag=True, help="Print the decisions below each table.")
@as_json_option("rows")
def paper(tables: tuple[int, ...], *, log: bool, as_json: bool) -> int:
    """Print the tables of the paper next to ours; exit code 1 if a row differs.

    Each scenario is planned with the planner paper. NUMBERS choose tables from 1 to 11. Tables 2
    and 3 are planned for two targets of R2: P3 as in Figure 1, and P2 as in the columns of the
    tables. A row counts as equal if it is equal for one of the two.
    """
    path = find_examples_folder() / "paper" / "tables.json"
    entries = json.loads(path.read_text(encoding="utf-8"))["tables"]
    compared = [_make_table(entry) for entry in entries if not tables or entry["table"] in tables]
    verdicts = _list_verdicts(compared)
    equal = sum(verdicts)
    if as_json:
        put_json({"tables": [_make_data(table) for table in compared],
                  "rows": len(verdicts), "equal": equal})  # fmt: skip
    else:
        for table in compared:
            _print(table, log=log)
        rows = str(len(verdicts))
        put_report(f"{equal} of {rows} published rows equal")
    return 0 if equal == len(verdicts) else 1


def _list_verdicts(tables: Sequence[_Table]) -> list[bool]:
    """Return for each published row whether it is equal, in one of the readings of its table."""
    verdicts: dict[tuple[int, str, str], bool] = {}
    for table in tables:
        for row in table.rows:
            key = table.number, row.robot, row.kind
            if row.published is not None:
                verdicts[key] = verdicts.get(key, False) or row.published == row.ours
    return list(verdicts.values())


def _make_table(entry: dict[str, Any]) -> _Table:
    from rightofway.io import load
    from rightofway.solve import solve
    from rightofway.viz.table import make_table

    plan = solve(load(find_examples_folder() / "paper" / f"{entry['name']}.yaml"), "paper")
    first, table = entry.get("first_tick", 0), make_table(plan)
    rows = []
    for row in table.rows:
        published = entry.get(row.kind, {}).get(row.robot)
        last = table.last_tick if published is None else first + len(published) - 1
        ours = [cell.place for cell in row.list_cells(first, last)]
        rows.append(_Row(robot=row.robot, kind=row.kind, published=published, ours=ours))
    return _Table(
        number=entry["table"],
        scenario=f"paper/{entry['name']}",
        first_tick=first,
        plan=plan,
        rows=rows,
    )


def _print(table: _Table, *, log: bool) -> None:
    from rightofway.check import check
    from rightofway.report.judgement import write_fault
    from rightofway.report.plan import report_decisions

    title = read_first_sentence(find_examples_folder() / f"{table.scenario}.yaml")
    ticks = range(table.first_tick, table.first_tick + max(len(row.ours) for row in table.rows))
    cells = [str(cell) for row in table.rows for cell in row.ours]
    width = 1 + max(len(cell) for cell in [*cells, str(ticks[-1])])
    put_report([f"{title} ({table.scenario}).", ""])
    put_report(_write_line("tick", "", ticks, width))
    for row in table.rows:
        head = f"{row.robot} {row.kind}"
        if row.published is not None:
            put_report(_write_line(head, "published", row.published, width))
            head = ""
        put_report(f"{_write_line(head, 'ours', row.ours, width)}  {row.verdict}".rstrip())
    for fault in check(table.plan).faults:
        text = f"The published method leaves this: {write_fault(fault)}."
        put_report(["", text])
    if log:
        put_report(
            "\n"
            + report_decisions(table.plan, choose_quantities(table.plan.scenario, in_ticks=True))
        )
    put_report("")


def _write_line(head: str, whose: str, cells: Sequence[object], width: int) -> str:
    return f"{head:10}  {whose:9}" + "".join(f"{cell!s:>{width}}" for cell in cells)


def _make_data(table: _Table) -> dict[str, Any]:
    return {
        "table": table.number,
        "scenario": table.scenario,
        "first_tick": table.first_tick,
        "rows": [
            {
                "robot": row.robot,
                "kind": row.kind,
                "published": row.published,
                "ours": row.ours,
                "equal": None if row.published is None else row.published == row.ours,
            }
            for row in table.rows
        ],
    }
