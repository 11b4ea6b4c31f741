"""The page on the paper says what decides the eight published cases; so does the planner."""

from __future__ import annotations

import re
from typing import Any

import rightofway
from rightofway.model import Decision, Plan
from tests.builders.fleets import PAPER, paper_scenario
from tests.builders.pages import DOCS


def written_rows() -> list[list[str]]:
    page = (DOCS / "paper.md").read_text(encoding="utf-8")
    table = re.search(r"^\| case \|.*\n\|[- |]*\n((?:\|.*\n)+)", page, re.MULTILINE)
    assert table is not None
    lines = table[1].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def pair(numbers: tuple[int | None, int | None] | None) -> str:
    return "" if numbers is None else f"{numbers[0]}, {numbers[1]}"


def row(case: dict[str, Any], plan: Plan, decision: Decision) -> list[str]:
    robots = [f"{1 / robot.speed}, {robot.stops[0].work}" for robot in plan.scenario.robots]
    about = [case["name"], str(case["table"]), *robots]
    sums = decision.completion_sums
    tie = " (tie)" if sums is not None and sums[0] == sums[1] else ""
    return [
        *(about if decision is plan.run.decisions[0] else [""] * len(about)),
        f"{plan.scenario.roadmap.name(decision.vertices[0])} at {decision.tick}",
        decision.level + tie,
        pair(decision.conflicts_left),
        pair(sums),
        plan.scenario.robots[decision.waits].name,
    ]


def test_the_table_of_cases_is_what_the_published_method_decides() -> None:
    decided = []
    for case in PAPER:
        plan = rightofway.solve(paper_scenario(case), "paper")
        decided += [row(case, plan, decision) for decision in plan.run.decisions]
    assert written_rows() == decided
