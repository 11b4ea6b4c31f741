"""Every fact of the package has a template with its values; none is a sentence itself."""

import ast
import json
import re
from collections.abc import Iterator
from typing import get_args

import pytest

from rightofway.control.operator import OPERATIONS
from rightofway.cyclic import RULES, TIMETABLE
from rightofway.facts import Fact
from rightofway.io import FOREIGN_FORMATS
from rightofway.languages import LANGUAGES, find_text, read_texts
from rightofway.model import RerouteReason, UnservedReason
from rightofway.planners.registry import PLANNERS
from rightofway.report.facts import FactWriter
from tests.builders.fleets import grid_fleet
from tests.builders.languages import translate
from tests.builders.sources import SOURCES, parse_modules

TEMPLATES = json.loads((SOURCES / "texts" / "en.json").read_text("utf-8"))["facts"]
STARTS = ("planner ", "option ")
PAIR = grid_fleet(["...."], [("N0", "N1"), ("N3", "N2")])
VALUE = re.compile(r"\{(\w+)(?::\w+)?\}")


def list_facts() -> Iterator[tuple[str, set[str] | None]]:
    """Yield the kind and the names of the values of each fact; None where they are not listed."""
    for module in parse_modules().values():
        for node in ast.walk(module):
            match node:
                case ast.Call(func=ast.Name(id="Fact"), args=[ast.Constant(value=str(kind)), *_]):
                    names = {keyword.arg for keyword in node.keywords if keyword.arg}
                    yield kind, names if all(it.arg for it in node.keywords) else None


def test_every_kind_of_fact_has_a_template() -> None:
    assert {kind for kind, _ in list_facts()} - set(TEMPLATES) == set()


def test_every_fact_has_the_values_of_its_template() -> None:
    lacking = [
        (kind, text, names)
        for kind, names in list_facts()
        for texts in [TEMPLATES[kind]]
        for text in ([texts] if isinstance(texts, str) else texts.values())
        if names is not None and not set(VALUE.findall(text)) <= names
    ]
    assert lacking == []


REASONS = (*get_args(UnservedReason), "not yet")

FILLED = {
    "unserved {}": REASONS,
    "place {}": ("open", "closed", "opened"),
    "lane {}": ("open", "closed", "opened"),
    "{} in one zone": ("start", "end"),
    "{} too near": ("start", "end"),
    "{} elsewhere": ("start", "end"),
    "purpose {}": (
        "home",
        "start",
        "charge",
        "turn",
        "wait",
        "make room",
        "drive through",
    ),
    "rule {}": (*RULES, TIMETABLE),
    "operation {}": tuple(OPERATIONS),
    "format {}": tuple(FOREIGN_FORMATS),
}
"""Kinds that are made of a word, with all words."""


def list_made_kinds() -> Iterator[str]:
    """Yield the kinds of facts that are no constants, with braces for what is filled in."""
    for module in parse_modules().values():
        for node in ast.walk(module):
            match node:
                case ast.Call(func=ast.Name(id="Fact"), args=[ast.JoinedStr(values=parts), *_]):
                    yield "".join(
                        str(part.value) if isinstance(part, ast.Constant) else "{}"
                        for part in parts
                    )


def test_every_kind_that_is_made_of_a_word_has_a_template() -> None:
    assert set(list_made_kinds()) == set(FILLED)
    made = {kind.replace("{}", word) for kind, words in FILLED.items() for word in words}
    assert made - set(TEMPLATES) == set()


@pytest.mark.parametrize("reason", REASONS)
def test_the_reasons_of_a_standstill_are_sentences_in_each_language(reason: str) -> None:
    fact = Fact("nothing moves", PAIR, jobs=2, reasons=(Fact(f"unserved {reason}"),))
    sentence = FactWriter(PAIR).write(fact)
    why = {code: read_texts(code)["facts"][f"unserved {reason}"] for code in LANGUAGES}
    assert sentence == f"nothing moves, and 2 jobs are known: {why['en']}"
    assert translate(sentence) == f"nichts bewegt sich, und 2 Aufträge sind bekannt: {why['de']}"


ABOVE = {"bench", "cli", "control", "figures.py", "report", "studio", "viz"}
"""Rooms that may have sentences."""

GIVEN_TO = {"GaveUp", "NoPlanExists", "check", "check_work", "limit_loop", "make_check", "report"}
"""Calls that take a fact in rooms below `report`."""


def test_rooms_below_report_raise_and_report_facts() -> None:
    sentences = [
        f"{path.relative_to(SOURCES)}:{node.lineno}"
        for path, module in parse_modules().items()
        if path.relative_to(SOURCES).parts[0] not in ABOVE
        for node in ast.walk(module)
        if isinstance(node, ast.Call)
        and getattr(node.func, "id", getattr(node.func, "attr", "")) in GIVEN_TO
        and any(
            isinstance(it, ast.JoinedStr) or isinstance(getattr(it, "value", 0), str)
            for it in node.args
            if isinstance(it, ast.Constant | ast.JoinedStr)
        )
    ]
    assert sentences == []


IN_THE_WAY = Fact("starts in its way", robot=1)


@pytest.mark.parametrize(
    ("fact", "sentence"),
    [
        (
            Fact("time over", doing=Fact("reading the map")),
            "time ran out while reading the map (give a longer time limit)",
        ),
        (
            Fact("time over", doing="counting sheep"),
            "time ran out while counting sheep (give a longer time limit)",
        ),
        (
            Fact("part done", doing=Fact("finding incompatible bookings"), done=3, parts=8),
            (
                "finding vertices and lanes that two robots may not book at once, 3 of 8 parts of"
                " the roadmap done"
            ),
        ),
        (
            Fact("plan with faults", faults=1),
            (
                "the plan has 1 fault: no right of way can be flipped"
                " (plan again with a planner that leaves none)"
            ),
        ),
        (
            Fact("never waits for", PAIR, waits=0, goes_first=1),
            "R1 never waits for R2 (choose another wait)",
        ),
        (
            Fact("cannot go before", PAIR, waits=0, goes_first=1, why=IN_THE_WAY),
            (
                "R1 cannot go before R2: R2 starts in its way, and no other way brings R1 home"
                " sooner (try another wait, or move a home or a stop)"
            ),
        ),
        (
            Fact("method is stuck", reason=RerouteReason("rotation", robots=["R1", "R2", "R3"])),
            (
                "R1, R2, R3 would move round in a circle at one instant"
                " (the published method is stuck here; try two-level)"
            ),
        ),
        (
            Fact("time over for an optimal plan", nodes=2),
            (
                "time ran out in the search for an optimal plan, after 2 nodes"
                " (give a longer time limit, or take another planner)"
            ),
        ),
        (
            Fact("value and gap reached", PAIR, objective="flowtime", value=7, gap=0.125, rate=80),
            "flowtime 7 time units, 12.5% above the bound, 80 attempts per s",
        ),
        (
            Fact("value reached", PAIR, objective="makespan", value=1, rate=80),
            "makespan 1 time unit, 80 attempts per s",
        ),
        (
            Fact("value of order", PAIR, order=3, objective="flowtime", value=7),
            "order 3: flowtime 7 time units",
        ),
    ],
)
def test_a_fact_of_planners_is_a_sentence(fact: Fact, sentence: str) -> None:
    assert str(fact) == sentence


def test_summaries_of_planners_in_the_table_are_those_of_the_registry() -> None:
    """The studio shows them in its language, the command line in English."""
    summaries = {f"planner {spec.name}": {spec.summary} for spec in PLANNERS}
    for spec in PLANNERS:
        for option in spec.options:
            for kind in (f"option {option.name} of {spec.name}", f"option {option.name}"):
                summaries.setdefault(kind, set()).add(option.summary)
    in_table = {kind: text for kind, text in TEMPLATES.items() if kind.startswith(STARTS)}
    assert {kind for kind, text in in_table.items() if summaries.get(kind) != {text}} == set()


def test_summaries_of_rules_and_formats_are_in_the_table() -> None:
    for rule, summary in RULES.items():
        assert find_text(f"rule {rule}") == summary
    for name, form in FOREIGN_FORMATS.items():
        assert find_text(f"format {name}") == form.summary
